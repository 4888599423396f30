// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// yaml-cpp's events -> YamlNode.
#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/utf8.h"
#include "io/yaml_node.h"

namespace lightstripe::detail {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{16} << 20;
constexpr std::size_t kMaxDepth = 64;
// The parser takes a second for a megabyte: what is no settings file by far ends before.
constexpr std::size_t kMaxValues = 200000;
constexpr std::size_t kMaxLineBytes = std::size_t{256} << 10;  // it looks ahead to the end of a line
constexpr const char* kCheckFile = "check that it is the right file";
constexpr const char* kCheckSyntax = "correct the YAML syntax there";

/// A trouble found while the tree grows; the dotted key is not known yet.
struct Refusal {
  int line;
  std::string what_is_wrong, what_to_do;
};

int line_of(const YAML::Mark& mark) { return mark.is_null() ? 0 : mark.line + 1; }

class TreeBuilder : public YAML::EventHandler {
 public:
  YamlNode root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { add(YamlNode::Kind::kNull, mark, "", ""); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw Refusal{line_of(mark), "an alias (*name) is not supported",
                  "write the part out, or put a text that begins with * in quotes"};
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                const std::string& value) override {
    add(YamlNode::Kind::kScalar, mark, tag, value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::kSequence, mark, tag);
  }
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::kMap, mark, tag);
  }
  void OnMapEnd() override { open_.pop_back(); }

 private:
  struct Level {
    YamlNode* node;  // stable: a parent's items do not grow while one of them is open
    std::optional<YamlNode> key;
  };
  std::vector<Level> open_;
  std::size_t num_values_ = 0;

  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag) {
    if (open_.size() >= kMaxDepth)
      throw Refusal{line_of(mark), "is nested deeper than " + std::to_string(kMaxDepth) + " levels",
                    kCheckSyntax};
    open_.push_back({add(kind, mark, tag, ""), std::nullopt});
  }

  YamlNode* add(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
                const std::string& value) {
    if (!tag.empty() && tag != "?" && tag != "!")
      throw Refusal{line_of(mark), "tags (!name) are not supported", "leave the tag out"};
    if (++num_values_ > kMaxValues)
      throw Refusal{line_of(mark), fmt::format("has more than {} values", kMaxValues), kCheckFile};
    YamlNode node;
    node.kind = kind;
    node.line = line_of(mark);
    node.quoted = tag == "!";
    node.text = value;
    if (kind == YamlNode::Kind::kScalar && !node.quoted && (value.empty() || value == "null" || value == "~"))
      node.kind = YamlNode::Kind::kNull;
    if (open_.empty()) return &(root = std::move(node));
    return add_to(open_.back(), std::move(node));
  }

  static YamlNode* add_to(Level& level, YamlNode node) {
    if (level.node->kind == YamlNode::Kind::kMap && !level.key) {
      if (node.kind != YamlNode::Kind::kScalar)
        throw Refusal{node.line, "a key has to be a text", kCheckSyntax};
      level.key = std::move(node);
      return nullptr;
    }
    if (level.key) {
      node.key = level.key->text;
      node.line = level.key->line;
      level.key.reset();
    }
    level.node->items.push_back(std::move(node));
    return &level.node->items.back();
  }
};

void check_repeated_keys(const YamlNode& node, const YamlPlace& place) {
  const bool is_map = node.kind == YamlNode::Kind::kMap;
  std::unordered_map<std::string_view, int> line_of_key;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const YamlNode& item = node.items[i];
    const YamlPlace at = is_map ? place.child(item.key) : place.item(i);
    if (is_map) {
      const auto [first, is_new] = line_of_key.emplace(item.key, item.line);
      if (!is_new) {
        fail_at(at, item.line, "given twice, first in line " + std::to_string(first->second),
                "keep one of the two");
      }
    }
    if (!item.items.empty()) check_repeated_keys(item, at);
  }
}

/// Whether the line (from 1) is indented by a tab.
bool is_indented_by_tab(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string found;
  for (int i = 0; i < line; ++i) std::getline(lines, found);
  const std::size_t first = found.find_first_not_of(' ');
  return first != std::string::npos && found[first] == '\t';
}

[[noreturn]] void fail_syntax(const YamlPlace& place, const std::string& text, const YAML::Exception& error) {
  const bool looks_like_pattern = error.msg.find("alias") != std::string::npos ||
                                  error.msg.find("referenced anchor") != std::string::npos;
  const int line = line_of(error.mark);
  const char* what_to_do = kCheckSyntax;
  if (looks_like_pattern) what_to_do = "put a text that begins with * in quotes";
  if (is_indented_by_tab(text, line)) what_to_do = "indent by blanks, not by tabs";
  fail_at(place, line, "is not valid YAML (" + error.msg + ")", what_to_do);
}

/// Number of the first line that is too long, 0 without one.
int too_long_line(const std::string& text) {
  int line = 1;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > kMaxLineBytes) return line;
    begin = end + 1;
  }
  return 0;
}

}  // namespace

YamlNode parse_yaml(const std::string& text, const YamlPlace& place) {
  if (text.find('\0') != std::string::npos || !is_utf8(text))
    fail_at(place, 0, "is not a text file in UTF-8", "check the path, or save it as UTF-8");
  if (const int line = too_long_line(text))
    fail_at(place, line, fmt::format("is longer than {} bytes", kMaxLineBytes), kCheckFile);
  TreeBuilder tree, beyond;
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(tree))
      fail_at(place, 0, "is empty", "fill it in, see configs/ for examples");
    if (parser.HandleNextDocument(beyond)) fail_at(place, 0, "holds more than one YAML document", "keep one");
  } catch (const YAML::Exception& error) {
    fail_syntax(place, text, error);
  } catch (const Refusal& refusal) {
    fail_at(place, refusal.line, refusal.what_is_wrong, refusal.what_to_do);
  }
  check_repeated_keys(tree.root, place);
  return std::move(tree.root);
}

YamlNode parse_yaml_file(const std::filesystem::path& path) {
  return parse_yaml(read_file(path, kMaxFileBytes), {path.string(), ""});
}

}  // namespace lightstripe::detail
