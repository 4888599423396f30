// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/tables.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "io/csv_reader.h"
#include "io/number_text.h"

namespace lightstripe {

namespace {

/// Whether a spreadsheet would take the text for a formula and run it.
bool is_formula(std::string_view text) {
  if (text.empty()) return false;
  if (text.front() == '=' || text.front() == '@') return true;
  return (text.front() == '+' || text.front() == '-') && text.find_first_of("(|!") != std::string_view::npos;
}

}  // namespace

std::string csv_cell(std::string_view text) {
  if (is_formula(text)) return csv_cell("'" + std::string(text));  // spreadsheets show it as a text
  const bool plain = text.find_first_of(",\"\r\n") == std::string_view::npos && !text.empty() &&
                     text.front() != '#' && text.front() != ' ' && text.back() != ' ';
  if (plain) return std::string(text);
  std::string cell = "\"";
  for (char c : text) {
    if (c == '"') cell.push_back('"');
    cell.push_back(c == '\n' || c == '\r' ? ' ' : c);
  }
  return cell + '"';
}

namespace {

constexpr double kQuaternionTolerance = 1e-3;

/// Each cell but the last of a row: number and comma.
void append_cell(std::string& out, double value, int decimals) {
  append_decimals(out, value, decimals);
  out.push_back(',');
}

void append_cell(std::string& out, std::int64_t value) {
  append_integer(out, value);
  out.push_back(',');
}

int small_integer(const CsvReader& table, std::size_t column) {
  const std::int64_t value = table.integer(column);
  if (value < 0 || value > std::numeric_limits<int>::max())
    table.fail("sensor and line are counted from 0", "give a whole number that is not negative");
  return static_cast<int>(value);
}

/// The profile of this frame, a new one at the end if it is its first row.
Profile& profile_of(std::vector<Profile>& profiles, std::map<std::int64_t, std::size_t>& index,
                    std::int64_t frame, double travel, const CsvReader& table) {
  if (!profiles.empty() && profiles.back().frame == frame && profiles.back().travel == travel)
    return profiles.back();
  const auto [found, is_new] = index.emplace(frame, profiles.size());
  if (is_new) {
    profiles.emplace_back();
    profiles.back().frame = frame;
    profiles.back().travel = travel;
  }
  Profile& profile = profiles[found->second];
  if (profile.travel != travel) {
    table.fail("frame " + std::to_string(frame) + " has another travel than in the rows before",
               "give all rows of a frame the same travel");
  }
  return profile;
}

}  // namespace

std::map<std::string, double> read_image_travel(const std::filesystem::path& path, std::string_view column) {
  CsvReader table(path, {"image", column});
  std::map<std::string, double> travel;
  while (table.next()) {
    const std::string& image = table.text(0);
    if (image.empty()) table.fail("image is empty", "give a file name");
    if (!travel.emplace(image, table.number(1)).second)
      table.fail("image '" + image + "' is given twice", "keep one row");
  }
  if (travel.empty()) throw Error(path.string(), "has no rows", "give the position of each image");
  return travel;
}

std::map<std::int64_t, double> read_frame_travel(const std::filesystem::path& path, std::string_view column) {
  CsvReader table(path, {"frame", column});
  std::map<std::int64_t, double> travel;
  while (table.next()) {
    const std::int64_t frame = table.integer(0);
    if (table.text(1).empty()) continue;
    if (!travel.emplace(frame, table.number(1)).second)
      table.fail("frame " + std::to_string(frame) + " is given twice", "keep one row");
  }
  if (travel.empty())
    throw Error(path.string(), "has no rows with a position", "give the position of each frame");
  return travel;
}

namespace {

/// Columns 1 to 7 of a row: qw qx qy qz x y z.
Rigid3 pose_in_row(CsvReader& table) {
  const Eigen::Quaterniond rotation(table.number(1), table.number(2), table.number(3), table.number(4));
  if (!(std::abs(rotation.norm() - 1) <= kQuaternionTolerance))
    table.fail("the quaternion has not unit length", "give qw,qx,qy,qz of a rotation");
  return {rotation.normalized(), {table.number(5), table.number(6), table.number(7)}};
}

}  // namespace

std::map<std::int64_t, Rigid3> read_poses(const std::filesystem::path& path) {
  CsvReader table(path, {"frame", "qw", "qx", "qy", "qz", "x", "y", "z"});
  std::map<std::int64_t, Rigid3> poses;
  while (table.next()) {
    const std::int64_t frame = table.integer(0);
    if (!poses.emplace(frame, pose_in_row(table)).second)
      table.fail("frame " + std::to_string(frame) + " is given twice", "keep one row");
  }
  if (poses.empty()) throw Error(path.string(), "has no rows", "give the pose of each frame");
  return poses;
}

std::map<std::string, Rigid3> read_image_poses(const std::filesystem::path& path) {
  CsvReader table(path, {"image", "qw", "qx", "qy", "qz", "x", "y", "z"});
  std::map<std::string, Rigid3> poses;
  while (table.next()) {
    const std::string image(table.text(0));
    if (!poses.emplace(image, pose_in_row(table)).second)
      table.fail("image " + image + " is given twice", "keep one row");
  }
  if (poses.empty()) throw Error(path.string(), "has no rows", "give the tool's pose for each image");
  return poses;
}

namespace {

/// "bridged;saturated", empty where there is nothing to say.
void append_flags(std::string& out, std::uint8_t flags) {
  constexpr std::pair<StripeFlag, std::string_view> kWords[] = {
      {kStripeBridged, "bridged"}, {kStripeSaturated, "saturated"}, {kStripeAsymmetric, "asymmetric"}};
  bool first = true;
  for (const auto& [flag, word] : kWords) {
    if ((flags & flag) == 0) continue;
    if (!first) out.push_back(';');
    out.append(word);
    first = false;
  }
}

}  // namespace

void append_stripes(std::string& out, std::string_view image, const std::vector<Stripe>& stripes) {
  const std::string image_cell = csv_cell(image);
  for (std::size_t line = 0; line < stripes.size(); ++line) {
    for (const StripePoint& point : stripes[line].points) {
      out.append(image_cell).push_back(',');
      append_cell(out, static_cast<std::int64_t>(line));
      append_cell(out, point.x, 5);
      append_cell(out, point.y, 5);
      append_cell(out, point.normal_x, 7);
      append_cell(out, point.normal_y, 7);
      append_cell(out, point.width, 4);
      append_cell(out, point.strength, 4);
      append_cell(out, point.sigma_px, 5);
      append_flags(out, point.flags);
      out.push_back('\n');
    }
  }
}

void append_profile(std::string& out, const Profile& profile) {
  std::string frame_and_travel;
  append_cell(frame_and_travel, profile.frame);
  append_cell(frame_and_travel, profile.travel, 6);
  for (const ProfilePoint& point : profile.points) {
    out.append(frame_and_travel);
    append_cell(out, std::int64_t{point.sensor});
    append_cell(out, std::int64_t{point.line});
    for (const double value : {point.position.x(), point.position.y(), point.position.z(), point.u, point.v})
      append_cell(out, value, 5);
    append_decimals(out, point.sigma_mm, 6);
    out.push_back('\n');
  }
}

std::vector<Profile> read_profiles(const std::filesystem::path& path) {
  CsvReader table(path, {"frame", "travel", "sensor", "line", "x", "y", "z", "u", "v", "sigma"});
  std::vector<Profile> profiles;
  std::map<std::int64_t, std::size_t> index;
  while (table.next()) {
    ProfilePoint point;
    point.sensor = small_integer(table, 2);
    point.line = small_integer(table, 3);
    point.position = {table.number(4), table.number(5), table.number(6)};
    point.u = table.number(7);
    point.v = table.number(8);
    point.sigma_mm = table.number(9);
    if (point.sigma_mm < 0)
      table.fail("sigma is negative", "give a 1-sigma error in mm, 0 where it is not known");
    profile_of(profiles, index, table.integer(0), table.number(1), table).points.push_back(point);
  }
  return profiles;
}

}  // namespace lightstripe
