// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// YamlNode -> text.
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cctype>

#include "io/number_text.h"
#include "io/utf8.h"
#include "io/yaml_binding.h"
#include "io/yaml_node.h"

namespace lightstripe::detail {
namespace {

using Kind = YamlNode::Kind;

constexpr std::size_t kMaxLineLength = 100;

bool safe_character(char c) {
  constexpr std::string_view kSafe = " _-./*+@%=()^";
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || std::isalnum(byte) != 0 || kSafe.find(c) != std::string_view::npos;
}

/// How a character beyond ASCII has to be escaped: those that YAML takes for line breaks, control characters,
/// a byte order mark, and bytes that are no UTF-8 (by their value, since YAML has no bytes). Empty: as it
/// stands.
std::string escape_of(std::string_view character, std::size_t length) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (length == 0) return fmt::format("\\x{:02x}", byte(0));
  if (length == 2 && byte(0) == 0xC2 && byte(1) < 0xA0)
    return byte(1) == 0x85 ? "\\N" : fmt::format("\\x{:02x}", byte(1));
  if (character == "\xe2\x80\xa8") return "\\L";
  if (character == "\xe2\x80\xa9") return "\\P";
  if (character == "\xef\xbb\xbf") return "\\uFEFF";
  return {};
}

/// Whether a character beyond ASCII may not stand as it is.
bool needs_escape(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    if (length != 1 && !escape_of(text.substr(at, std::max<std::size_t>(length, 1)), length).empty())
      return true;
    at += std::max<std::size_t>(length, 1);
  }
  return false;
}

/// Whether a plain scalar can stand without quotes in flow style.
bool safe_plain(std::string_view text) {
  if (text.empty() || text.front() == ' ' || text.back() == ' ' || text == "-") return false;
  constexpr std::string_view kRiskyFirst = "*%@=-";
  if (kRiskyFirst.find(text.front()) != std::string_view::npos && !parse_number(text)) return false;
  return std::all_of(text.begin(), text.end(), safe_character) && !needs_escape(text);
}

std::string quoted_text(std::string_view text) {
  std::string out = "\"";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at), step = std::max<std::size_t>(length, 1);
    const char c = text[at];
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out.push_back('\\');
      out.push_back(c);
    } else if (c == '\n') {
      out += "\\n";
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      const std::string escape = byte < 0x80 ? "" : escape_of(text.substr(at, step), length);
      out += escape.empty() ? std::string(text.substr(at, step)) : escape;
    }
    at += step;
  }
  out.push_back('"');
  return out;
}

std::string scalar_text(const YamlNode& node) {
  if (node.kind == Kind::kNull) return "null";
  return node.quoted || !safe_plain(node.text) ? quoted_text(node.text) : node.text;
}

std::string key_text(const YamlNode& node) {
  return needs_quotes(node.key) ? quoted_text(node.key) : node.key;
}

/// Flow style; `before` is called ahead of each entry and may append line ends.
template <class Before>
void append_flow(std::string& out, const YamlNode& node, const Before& before) {
  if (node.kind == Kind::kNull || node.kind == Kind::kScalar) {
    out += scalar_text(node);
    return;
  }
  const bool is_map = node.kind == Kind::kMap;
  out.push_back(is_map ? '{' : '[');
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) out += ", ";
    before(out, node.items[i]);
    if (is_map) out += key_text(node.items[i]) + ": ";
    append_flow(out, node.items[i], before);
  }
  out.push_back(is_map ? '}' : ']');
}

bool has_comments(const YamlNode& node) {
  return std::any_of(node.items.begin(), node.items.end(),
                     [](const YamlNode& item) { return !item.comment.empty() || has_comments(item); });
}

/// A list of numbers is easier to read on one line, however long.
bool is_number_list(const YamlNode& node) {
  return node.kind == Kind::kSequence &&
         std::all_of(node.items.begin(), node.items.end(), [](const YamlNode& item) {
           return item.kind == Kind::kScalar && parse_number(item.text);
         });
}

struct BlockWriter {
  std::string out;
  bool comments = false;

  void entry(const YamlNode& node, const std::string& lead, std::size_t indent) {
    const bool as_comment = comments && node.kind == Kind::kNull;
    const std::string note = comments && !node.comment.empty() ? "  # " + node.comment : "";
    const std::string flow = emit_flow(node);
    const bool one_line = node.items.empty() || is_number_list(node) || is_number_list(node) ||
                          (lead.size() + flow.size() <= kMaxLineLength && !(comments && has_comments(node)));
    if (as_comment) {
      out += std::string(indent, ' ') + "# " + lead.substr(indent) + note + "\n";
    } else if (one_line) {
      out += lead + " " + flow + note + "\n";
    } else {
      out += lead + note + "\n";
      block(node, indent + 2);
    }
  }

  void block(const YamlNode& node, std::size_t indent) {
    const std::string margin(indent, ' ');
    for (const YamlNode& item : node.items) {
      if (node.kind == Kind::kMap) {
        entry(item, margin + key_text(item) + ":", indent);
      } else if (item.kind == Kind::kMap && emit_flow(item).size() + indent > kMaxLineLength) {
        const std::size_t start = out.size();
        block(item, indent + 2);
        out[start + indent] = '-';  // the first key of a map in a list stands behind the dash
      } else {
        entry(item, margin + "-", indent);
      }
    }
  }
};

/// Without the entries of maps that are null.
YamlNode without_nulls(YamlNode node) {
  if (node.kind == Kind::kMap)
    std::erase_if(node.items, [](const YamlNode& item) { return item.kind == Kind::kNull; });
  for (YamlNode& item : node.items) item = without_nulls(std::move(item));
  return node;
}

}  // namespace

std::string emit_flow(const YamlNode& node) {
  std::string out;
  append_flow(out, node, [](std::string&, const YamlNode&) {});
  return out;
}

bool needs_quotes(std::string_view text) {
  constexpr std::array<std::string_view, 9> kWords = {"null", "true", "false", "yes", "no",
                                                      "on",   "off",  "y",     "n"};
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) {
    return c < 0x80 ? static_cast<char>(std::tolower(c)) : static_cast<char>(c);
  });
  return !safe_plain(text) || parse_number(text) ||
         std::find(kWords.begin(), kWords.end(), lower) != kWords.end();
}

std::string emit_yaml(const YamlNode& node, bool comments) {
  const YamlNode given = comments ? node : without_nulls(node);
  if (given.items.empty()) return emit_flow(given) + "\n";
  BlockWriter writer;
  writer.comments = comments;
  writer.block(given, 0);
  return writer.out;
}

std::string emit_on_lines(const YamlNode& node) {
  std::string out;
  int line = 1;
  const auto go_to = [&line](std::string& text, const YamlNode& entry) {
    for (; line < entry.line; ++line) text.push_back('\n');
  };
  go_to(out, node);
  append_flow(out, node, go_to);
  return out;
}

}  // namespace lightstripe::detail

namespace lightstripe {

std::string yaml_text(std::string_view text) {
  return detail::needs_quotes(text) ? detail::quoted_text(text) : std::string(text);
}

}  // namespace lightstripe
