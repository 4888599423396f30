// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "measure/profile_formats.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <istream>

#include "core/counted.h"
#include "core/error.h"
#include "measure/profile_orientation.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kMostPoints = 1'000'000, kLongestLine = 10'000;
constexpr double kLargest = 1e5;  // mm: anything beyond is no profile

std::string trimmed(std::string_view text) {
  const auto space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && space(text.front())) text.remove_prefix(1);
  while (!text.empty() && space(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::optional<double> number_of(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// The next text between separators from `at` on, which goes behind it; empty at the line's end.
template <class Separator>
std::string_view next_text(std::string_view line, std::size_t& at, const Separator& is_separator) {
  while (at < line.size() && is_separator(line[at])) ++at;
  const std::size_t start = at;
  while (at < line.size() && !is_separator(line[at])) ++at;
  return line.substr(start, at - start);
}

/// Numbers at the line's beginning, separated by blanks or commas; none if it does not begin with two.
/// `remark`: text may stand behind them.
std::vector<double> numbers_of(std::string_view line, bool remark = false) {
  std::vector<double> out;
  const auto separator = [](char c) { return is_blank(c) || c == ','; };
  for (std::size_t at = 0;;) {
    const std::string_view text = next_text(line, at, separator);
    if (text.empty()) break;
    const auto value = number_of(text);
    if (!value && !remark) return {};
    if (!value) break;
    out.push_back(*value);
  }
  return out.size() >= 2 ? out : std::vector<double>{};
}

/// "12,5  -3,75", also with a semicolon between: two numbers with decimal commas and no decimal point.
bool has_decimal_commas(std::string_view line) {
  const auto separator = [](char c) { return is_blank(c) || c == ';'; };
  int count = 0;
  for (std::size_t at = 0; count < 2; ++count) {
    std::string text(next_text(line, at, separator));
    if (std::count(text.begin(), text.end(), ',') != 1 || text.find('.') != std::string::npos) return false;
    if (text.front() == ',' || text.back() == ',') return false;
    std::replace(text.begin(), text.end(), ',', '.');
    if (!number_of(text)) return false;
  }
  return true;
}

void refuse_decimal_commas(std::string_view line, const std::string& name) {
  if (has_decimal_commas(line))
    throw Error(name, "has decimal commas: '" + std::string(line.substr(0, 40)) + "'",
                "write its numbers with decimal points");
}

/// The next line; a Ctrl-Z ends the text, as DOS wrote it.
bool next_line(std::istream& in, std::string& line, const std::string& name) {
  if (!std::getline(in, line)) return false;
  if (const auto end = line.find('\x1a'); end != std::string::npos) {
    line.erase(end);
    in.setstate(std::ios::eofbit);
    if (line.empty()) return false;
  }
  if (line.size() > kLongestLine || line.find('\0') != std::string::npos)
    throw Error(name, "is no text file", "give a profile as MiniProf or Simpack write it");
  return true;
}

std::string without_comment(const std::string& line, std::string_view marks) {
  return trimmed(std::string_view(line).substr(0, std::min(line.find_first_of(marks), line.size())));
}

void add_point(RecordedProfile& profile, double x, double y, const std::string& name) {
  if (std::abs(x) > kLargest || std::abs(y) > kLargest)
    throw Error(name, "has a point farther than 100 m from its origin", "give lengths in mm");
  if (profile.points.size() >= kMostPoints)
    throw Error(name, "has more than a million points", "give one profile");
  profile.points.emplace_back(x, y);
}

void check_size(const RecordedProfile& profile, const std::string& name) {
  if (profile.points.size() < 10)
    throw Error(name, "has only " + counted(profile.points.size(), "point"), "give a recorded profile");
}

/// "Key=value", or the older "Key.....: value"; false if the line is neither.
bool read_header_line(const std::string& line, RecordedProfile& profile) {
  std::string text = line;
  text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
  if (const auto equals = text.find('='); equals != std::string::npos) {
    profile.header.emplace(trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1)));
    return true;
  }
  const auto colon = text.find(':');
  if (colon == std::string::npos) return false;
  std::string key = trimmed(text.substr(0, colon));
  while (!key.empty() && key.back() == '.') key.pop_back();
  profile.header.emplace(key, trimmed(text.substr(colon + 1)));
  return true;
}

/// The older style's "32.58 37.11 14.71  (Sd/Sh/qR)".
bool read_old_wheel_figures(const std::string& line, RecordedProfile& profile) {
  const auto bracket = line.find("(Sd/Sh/qR)");
  if (bracket == std::string::npos) return false;
  const std::vector<double> figures = numbers_of(std::string_view(line).substr(0, bracket));
  const char* const keys[] = {"Sd", "Sh", "qR"};
  for (std::size_t i = 0; i < std::min<std::size_t>(3, figures.size()); ++i)
    profile.header.emplace(keys[i], std::to_string(figures[i]));
  return true;
}

}  // namespace

std::optional<double> RecordedProfile::number(const std::string& key) const {
  const auto found = header.find(key);
  return found == header.end() ? std::nullopt : number_of(found->second);
}

std::optional<ProfileFormat> profile_format(std::string_view file_name) {
  std::string end(file_name.substr(file_name.size() - std::min<std::size_t>(4, file_name.size())));
  for (char& c : end) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (end == ".ban" || end == ".whl" || end == ".mpt") return ProfileFormat::kMiniProf;
  if (end == ".prr" || end == ".prw") return ProfileFormat::kSimpack;
  return std::nullopt;
}

RecordedProfile read_miniprof(std::istream& in, const std::string& name, ObjectKind kind) {
  RecordedProfile profile;
  profile.kind = kind;
  bool in_points = true;  // an .mpt has sections, only those of points count
  bool over = false;      // what follows the first profile is not read
  for (std::string line; next_line(in, line, name);) {
    const std::string text = trimmed(line);
    if (text.empty()) continue;
    if (text.front() == '[') {
      in_points = text.find("Points]") != std::string::npos;
      over = !profile.points.empty();
      if (over && in_points) ++profile.further_profiles;
    }
    if (over || text.front() == '[') continue;
    if (read_old_wheel_figures(text, profile)) continue;
    const std::string row_text = without_comment(text, "\"!%");
    const std::vector<double> row = numbers_of(row_text, !profile.points.empty());
    if (in_points) refuse_decimal_commas(row_text, name);
    if (!row.empty() && in_points) {
      add_point(profile, row[0], row[1], name);
    } else if (profile.points.empty()) {
      read_header_line(text, profile);
    } else if (row.empty() && !row_text.empty() && text.front() != '#') {
      throw Error(name, "has a line among its points that is no point: '" + text.substr(0, 40) + "'",
                  "correct it, or take it out");
    }
  }
  check_size(profile, name);
  turn_upright(profile);
  return profile;
}

RecordedProfile read_simpack(std::istream& in, const std::string& name) {
  RecordedProfile profile;
  bool in_points = false;
  for (std::string line; next_line(in, line, name);) {
    const std::string text = without_comment(line, "!%#");
    if (text == "point.begin" || text == "point.end") {
      in_points = text == "point.begin";
    } else if (in_points && !text.empty()) {
      refuse_decimal_commas(text, name);
      const std::vector<double> row = numbers_of(text, true);
      if (row.empty())
        throw Error(name, "has no point in '" + text.substr(0, 40) + "'", "give rows of y and z");
      add_point(profile, row[0], row[1], name);
    } else if (!text.empty()) {
      read_header_line(text, profile);
    }
  }
  check_size(profile, name);
  for (const char* key : {"shift.y", "shift.z", "rotate", "mirror.y", "mirror.z", "inversion"})
    if (profile.number(key).value_or(0) != 0)
      throw Error(name, std::string("asks for ") + key + ", which is not applied here",
                  "save the profile without it");
  const double units = profile.number("units.len.f").value_or(1000);
  if (!(units > 0))
    throw Error(name, "units.len.f is not positive", "give user units per metre: 1000 for mm");
  for (Vector2d& p : profile.points) p *= 1000 / units;
  profile.kind = profile.number("type").value_or(0) == 1 ? ObjectKind::kWheel : ObjectKind::kRail;
  turn_upright(profile);
  return profile;
}

Section section_of(const RecordedProfile& profile) {
  Section section;
  for (const Vector2d& p : profile.points) section.push_back({p, 0, 0, 0, 1});
  return section;
}

}  // namespace lightstripe
