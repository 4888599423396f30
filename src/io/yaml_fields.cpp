// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/yaml_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <limits>

#include "core/error.h"
#include "io/edit_distance.h"
#include "io/number_text.h"
#include "io/yaml_binding.h"

namespace lightstripe::detail {
namespace {

using Kind = YamlNode::Kind;

/// What the node is, in a few words for a message.
std::string described(const YamlNode& node) {
  constexpr std::size_t kMaxShown = 40;
  if (node.kind == Kind::kNull) return "is empty";
  if (node.kind == Kind::kMap) return "is a map of keys";
  if (node.kind == Kind::kSequence) return fmt::format("is a list of {}", node.items.size());
  std::string shown = node.text.substr(0, kMaxShown);
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return "is '" + shown + (node.text.size() > kMaxShown ? "...'" : "'") +
         (node.quoted ? " (quoted text)" : "");
}

/// Binds a plain scalar that `parse` takes; otherwise an Error that says what is wanted.
template <class T, class Parse>
void bind_scalar(const YamlNode& node, T& value, const YamlPlace& place, const Parse& parse,
                 const std::string& wanted) {
  const auto parsed = node.kind == Kind::kScalar && !node.quoted ? parse(node.text) : std::nullopt;
  if (!parsed) fail_at(place, node.line, described(node), "give " + wanted);
  value = static_cast<T>(*parsed);
}

void write_plain(YamlNode& node, std::string text) {
  node.kind = Kind::kScalar;
  node.text = std::move(text);
}

/// "did you mean 'sigma'? allowed: ..." for a name that is none of the known.
std::string advice(std::string_view name, const std::vector<std::string_view>& known) {
  std::string text = fmt::format("allowed: {}", fmt::join(known, ", "));
  constexpr std::size_t kMaxLength = 64;  // longer names are no typing errors
  if (name.size() > kMaxLength || known.empty()) return text;
  const auto nearest =
      std::min_element(known.begin(), known.end(), [name](std::string_view a, std::string_view b) {
        return edit_distance(name, a) < edit_distance(name, b);
      });
  if (edit_distance(name, *nearest) > std::max<std::size_t>(1, name.size() / 3)) return text;
  return fmt::format("did you mean '{}'? {}", *nearest, text);
}

}  // namespace

void read_field(const YamlNode& node, bool& value, const YamlPlace& place) {
  const auto parse = [](const std::string& text) -> std::optional<bool> {
    if (text == "true" || text == "True" || text == "TRUE") return true;
    if (text == "false" || text == "False" || text == "FALSE") return false;
    return std::nullopt;
  };
  bind_scalar(node, value, place, parse, "true or false");
}

void read_field(const YamlNode& node, int& value, const YamlPlace& place) {
  std::int64_t number = 0;
  read_field(node, number, place);
  if (number < std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max())
    fail_at(place, node.line, described(node), "give a whole number of at most 9 digits");
  value = static_cast<int>(number);
}

void read_field(const YamlNode& node, std::int64_t& value, const YamlPlace& place) {
  bind_scalar(node, value, place, parse_integer, "a whole number");
}

void read_field(const YamlNode& node, std::uint64_t& value, const YamlPlace& place) {
  bind_scalar(node, value, place, parse_unsigned, "a whole number that is not negative");
}

void read_field(const YamlNode& node, double& value, const YamlPlace& place) {
  bind_scalar(node, value, place, parse_number, "a finite number");
}

void read_field(const YamlNode& node, std::string& value, const YamlPlace& place) {
  if (node.kind != Kind::kScalar) fail_at(place, node.line, described(node), "give a text");
  value = node.text;
}

void read_field(const YamlNode& node, YamlSubtree& value, const YamlPlace& place) {
  value.text = node.kind == Kind::kNull ? "" : emit_on_lines(node);
  value.origin = place.file + ": " + place.key;
}

void write_field(YamlNode& node, bool value) { write_plain(node, value ? "true" : "false"); }
void write_field(YamlNode& node, int value) { write_plain(node, std::to_string(value)); }
void write_field(YamlNode& node, std::int64_t value) { write_plain(node, std::to_string(value)); }
void write_field(YamlNode& node, std::uint64_t value) { write_plain(node, std::to_string(value)); }
void write_field(YamlNode& node, double value) { write_plain(node, shortest_text(value)); }

void write_field(YamlNode& node, const std::string& value) {
  write_plain(node, value);
  node.quoted = needs_quotes(value);
}

void write_field(YamlNode& node, const YamlSubtree& value) {
  if (value.empty()) return;
  YamlNode part = parse_yaml(value.text, place_of(value));
  part.key = node.key;
  part.comment = node.comment;
  node = std::move(part);
}

std::size_t bind_choice(const YamlNode& node, const std::vector<std::string_view>& choices,
                        const YamlPlace& place) {
  const auto found =
      node.kind == Kind::kScalar ? std::find(choices.begin(), choices.end(), node.text) : choices.end();
  if (found == choices.end()) fail_at(place, node.line, described(node), advice(node.text, choices));
  return static_cast<std::size_t>(found - choices.begin());
}

void check_list(const YamlNode& node, std::size_t length, const YamlPlace& place) {
  if (node.kind == Kind::kSequence && (length == 0 || node.items.size() == length)) return;
  fail_at(place, node.line, described(node),
          length == 0 ? "give a list [a, b, ...]" : fmt::format("give a list of {}", length));
}

void check_map(const YamlNode& node, const YamlPlace& place) {
  if (node.kind != Kind::kMap) fail_at(place, node.line, described(node), "give a map of keys and values");
}

void fail_unknown_key(const YamlPlace& place, std::string_view key, int line,
                      const std::vector<std::string_view>& known) {
  fail_at(place.child(key), line, "unknown key", advice(key, known));
}

YamlPlace place_of(const YamlSubtree& part) {
  const std::size_t colon = part.origin.rfind(": ");
  if (colon == std::string::npos) return {"", part.origin};
  return {part.origin.substr(0, colon), part.origin.substr(colon + 2)};
}

void add_entry(YamlSubtree& part, const std::string& key, const std::string& text) {
  const YamlPlace place = place_of(part);
  YamlNode map;
  if (!part.empty()) map = parse_yaml(part.text, place);
  if (map.kind == Kind::kNull) map.kind = Kind::kMap;
  check_map(map, place);
  for (const YamlNode& item : map.items)
    if (item.key == key) fail_at(place.child(key), item.line, "is given twice", "give it once");
  YamlNode entry;
  write_field(entry, text);
  entry.key = key;
  map.items.push_back(std::move(entry));
  part.text = emit_on_lines(map);
}

YamlNode parse_override(const std::string& text) {
  try {
    YamlNode node = parse_yaml(text, {});
    if (node.kind == Kind::kSequence || node.kind == Kind::kNull) return node;
  } catch (const Error&) {  // not YAML: a text all the same
  }
  YamlNode node;
  write_plain(node, text);
  return node;
}

void for_each_leaf(
    const YamlNode& node, const std::string& key,
    const std::function<void(const std::string&, const std::string&, const YamlNode&)>& visit) {
  if (node.kind != Kind::kMap) {
    const bool given = node.kind != Kind::kNull;
    std::string value = given ? emit_flow(node) : "";
    visit(key, value, node);
    return;
  }
  for (const YamlNode& item : node.items)
    for_each_leaf(item, key.empty() ? item.key : key + "." + item.key, visit);
}

}  // namespace lightstripe::detail

lightstripe::YamlSubtree lightstripe::read_entry(const std::filesystem::path& path, std::string_view key) {
  YamlSubtree out;
  for (const detail::YamlNode& entry : detail::parse_yaml_file(path).items)
    if (entry.key == key) detail::read_field(entry, out, {path.string(), std::string(key)});
  return out;
}
