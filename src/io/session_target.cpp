// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/session_target.h"

#include <algorithm>
#include <cmath>

#include "io/yaml_binding.h"

namespace lightstripe {

void read_field(const detail::YamlNode& node, SquareSize& size, const detail::YamlPlace& place) {
  std::array<double, 2> sides{};
  if (node.kind == detail::YamlNode::Kind::kSequence) {
    detail::read_field(node, sides, place);
  } else {
    detail::read_field(node, sides[0], place);
    sides[1] = sides[0];
  }
  size = {sides[0], sides[1]};
}

void write_field(detail::YamlNode& node, const SquareSize& size) {
  if (size.x == size.y) {
    detail::write_field(node, size.x);
  } else {
    detail::write_field(node, std::array<double, 2>{size.x, size.y});
  }
}

namespace {

constexpr int kMaxCorners = 1000;  // a side

/// Kalibr's description of an AprilGrid; its lengths are metres.
struct AprilgridFields {
  std::optional<std::string> target_type;
  std::optional<int> tagCols, tagRows;
  std::optional<double> tagSize, tagSpacing;
  std::optional<int> codeOffset;
};
template <class V>
void visit_fields(V&& v, AprilgridFields& o) {
  v("target_type", o.target_type);
  v("tagCols", o.tagCols);
  v("tagRows", o.tagRows);
  v("tagSize", o.tagSize);
  v("tagSpacing", o.tagSpacing);
  v("codeOffset", o.codeOffset);
}

/// Corners or circles along one side.
void check_count(int count, const std::string& key, const std::string& what, const Checker& check) {
  check.require(count >= 2 && count <= kMaxCorners, key, "is out of range",
                "count the " + what + " along each side, 2 to " + std::to_string(kMaxCorners));
}

/// Checkerboard and ChArUco.
Target target_of_squares(const TargetFields& given, const Checker& check) {
  const auto [columns, rows] = check.given(given.inner_corners, "target.inner_corners",
                                           "inner_corners: [11, 8] for a board of 12 x 9 squares");
  for (const int corners : {columns, rows})
    check_count(corners, "target.inner_corners", "corners between the squares", check);
  const SquareSize square = check.given(given.square, "target.square", "square: 10.0 for 10 mm");
  check.require(square.x > 0 && square.y > 0, "target.square", "is not positive",
                "give the side of a square in mm");
  check.require(!given.grid && !given.pitch && !given.diameter && !given.file, "target",
                "has grid, pitch, diameter or file, which a board of squares has not", "leave them out");
  Target target{given.type, columns, rows, square.x, square.y};
  if (given.type == TargetType::kCheckerboard) {
    check.require(!given.marker && !given.dictionary, "target",
                  "has marker or dictionary, which a checkerboard has not",
                  "say type: charuco, or leave them out");
    return target;
  }
  target.marker_mm = check.given(given.marker, "target.marker");
  check.require(target.marker_mm > 0 && target.marker_mm < std::min(square.x, square.y), "target.marker",
                "is no side of a marker within a square", "give it in mm, smaller than square");
  if (given.dictionary) target.dictionary = *given.dictionary;
  return target;
}

Target target_of_circles(const TargetFields& given, const Checker& check) {
  check.require(!given.inner_corners && !given.square && !given.marker && !given.dictionary && !given.file,
                "target", "has keys of another type of board", "circles have grid, pitch and diameter");
  const auto [columns, rows] =
      check.given(given.grid, "target.grid", "grid: [7, 7] for 7 x 7 circles (asymmetric: [4, 11])");
  for (const int circles : {columns, rows}) check_count(circles, "target.grid", "circles", check);
  check.require(columns >= 3 && rows >= 3, "target.grid", "is too small", "3 x 3 circles at least");
  const double pitch = check.given(given.pitch, "target.pitch", "pitch: 37.5, as OpenCV's squareSize, mm");
  check.require(pitch > 0, "target.pitch", "is not positive", "give the circles' distance in mm");
  Target target{given.type, columns, rows, pitch, pitch};
  if (!given.diameter) return target;
  const double neighbours = given.type == TargetType::kCircles ? pitch : pitch * std::sqrt(2.0);
  check.require(*given.diameter > 0 && *given.diameter < neighbours, "target.diameter",
                "is no diameter of circles that stand apart", "give it in mm, or leave it out");
  target.circle_mm = *given.diameter;
  return target;
}

Target target_of_tags(const TargetFields& given, const std::filesystem::path& folder, const Checker& check) {
  check.require(!given.inner_corners && !given.square && !given.marker && !given.dictionary && !given.grid &&
                    !given.pitch && !given.diameter,
                "target", "has keys of another type of board", "an aprilgrid has file, Kalibr's own");
  const auto path = folder / check.text(given.file, "target.file");
  AprilgridFields tags;
  read_yaml(path, tags);
  const Checker inside{path.string()};
  inside.require(!tags.target_type || *tags.target_type == "aprilgrid", "target_type", "is not aprilgrid",
                 "give the file of an AprilGrid");
  const int columns = inside.given(tags.tagCols, "tagCols"), rows = inside.given(tags.tagRows, "tagRows");
  for (const int count : {columns, rows})
    inside.require(count >= 2 && count <= 30, "tagCols, tagRows", "are out of range", "2 to 30");
  const double size = inside.given(tags.tagSize, "tagSize"),
               gap = inside.given(tags.tagSpacing, "tagSpacing");
  inside.require(size > 0 && size < 1, "tagSize", "is no side of a tag in metres (Kalibr's unit)",
                 "give e.g. 0.088 for 88 mm");
  inside.require(gap > 0 && gap < 2, "tagSpacing", "is no share of the tag's side", "give e.g. 0.3");
  inside.require(tags.codeOffset.value_or(0) == 0, "codeOffset", "is not 0", "print the board from tag 0 on");
  Target target{TargetType::kAprilgrid, 2 * columns, 2 * rows};
  target.marker_mm = 1000 * size;
  target.tag_gap_mm = gap * target.marker_mm;
  target.pitch_x = target.pitch_y = 0.5 * (target.marker_mm + target.tag_gap_mm);
  return target;
}

}  // namespace

Target checked_target(const std::optional<TargetFields>& fields, const std::filesystem::path& folder,
                      const Checker& check) {
  const TargetFields given =
      check.given(fields, "target", "target: {type: checkerboard, inner_corners: [11, 8], square: 10.0}");
  const bool circles = given.type == TargetType::kCircles || given.type == TargetType::kAsymmetricCircles;
  Target target = circles                                ? target_of_circles(given, check)
                  : given.type == TargetType::kAprilgrid ? target_of_tags(given, folder, check)
                                                         : target_of_squares(given, check);
  if (!given.rim_mm) return target;
  check.require(*given.rim_mm >= 0, "target.rim_mm", "is negative", "give the width of the plain rim in mm");
  target.rim_mm = *given.rim_mm;
  return target;
}

TargetFields target_fields(const Target& target, const std::string& aprilgrid_file) {
  TargetFields fields;
  fields.type = target.type;
  if (target.rim_mm >= 0) fields.rim_mm = target.rim_mm;
  if (target.type == TargetType::kAprilgrid) {
    fields.file = aprilgrid_file;
    return fields;
  }
  const std::array<int, 2> size{target.columns, target.rows};
  if (target.has_circles()) {
    fields.grid = size;
    fields.pitch = target.pitch_x;
    if (target.circle_mm > 0) fields.diameter = target.circle_mm;
    return fields;
  }
  fields.inner_corners = size;
  fields.square = SquareSize{target.pitch_x, target.pitch_y};
  if (target.type != TargetType::kCharuco) return fields;
  fields.marker = target.marker_mm;
  fields.dictionary = target.dictionary;
  return fields;
}

}  // namespace lightstripe
