// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// features.yaml: which features of a section a user names, and what is measured between them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/fields.h"

namespace lightstripe {

enum class FeatureType { kLine, kArc, kMax, kMin, kIntersection, kKnee, kLeftEnd, kRightEnd };
constexpr std::array<EnumName<FeatureType>, 8> enum_names(FeatureType) {
  return {{{FeatureType::kLine, "line"},
           {FeatureType::kArc, "arc"},
           {FeatureType::kMax, "max"},
           {FeatureType::kMin, "min"},
           {FeatureType::kIntersection, "intersection"},
           {FeatureType::kKnee, "knee"},
           {FeatureType::kLeftEnd, "left_end"},
           {FeatureType::kRightEnd, "right_end"}}};
}

struct FeatureRecipe {
  std::string name;
  FeatureType type = FeatureType::kLine;
  std::vector<double> u;  ///< from, to, mm; empty: everywhere. Relative to the anchor's place
  std::vector<double> v;
  std::string anchor;           ///< a feature named before; empty: the section's own coordinates
  std::vector<std::string> of;  ///< intersection: its two lines
  double half_width_mm = 1.5;   ///< max, min: of the parabola
};
template <class V>
void visit_fields(V&& v, FeatureRecipe& o) {
  v("name", o.name), v("type", o.type, "line, arc, max, min, intersection, knee, left_end, right_end");
  v("u", o.u, "[from, to], mm"), v("v", o.v, "[from, to], mm");
  v("anchor", o.anchor, "feature that u and v count from"), v("of", o.of, "intersection: its two lines");
  v("half_width_mm", o.half_width_mm, "max, min: of the parabola about it");
}

enum class QuantityType {
  kStepHeight,
  kGap,
  kFlush,
  kAngle,
  kRadius,
  kDistance,
  kWidth,
  kArea,
  kFlatness,
  kPositionU,
  kPositionV
};
constexpr std::array<EnumName<QuantityType>, 11> enum_names(QuantityType) {
  return {{{QuantityType::kStepHeight, "step_height"},
           {QuantityType::kGap, "gap"},
           {QuantityType::kFlush, "flush"},
           {QuantityType::kAngle, "angle"},
           {QuantityType::kRadius, "radius"},
           {QuantityType::kDistance, "distance"},
           {QuantityType::kWidth, "width"},
           {QuantityType::kArea, "area"},
           {QuantityType::kFlatness, "flatness"},
           {QuantityType::kPositionU, "position_u"},
           {QuantityType::kPositionV, "position_v"}}};
}

struct QuantityRecipe {
  std::string name;
  QuantityType type = QuantityType::kDistance;
  std::vector<std::string> of;  ///< features
  std::vector<double> u;        ///< area: from, to along the first feature's line, from its middle
  std::optional<double> min, max;
};
template <class V>
void visit_fields(V&& v, QuantityRecipe& o) {
  v("name", o.name);
  v("type", o.type,
    "step_height, gap, flush, angle, radius, distance, width, area, flatness, position_u, position_v");
  v("of", o.of, "features"), v("u", o.u, "area: [from, to] along the line, mm from its middle");
  v("min", o.min), v("max", o.max);
}

enum class AlongType { kFlatness, kStraightness, kParallelism };
constexpr std::array<EnumName<AlongType>, 3> enum_names(AlongType) {
  return {{{AlongType::kFlatness, "flatness"},
           {AlongType::kStraightness, "straightness"},
           {AlongType::kParallelism, "parallelism"}}};
}
struct AlongRecipe {
  std::string name;
  AlongType type = AlongType::kFlatness;
  std::vector<std::string> of;  ///< one feature; parallelism: two lines
};
template <class V>
void visit_fields(V&& v, AlongRecipe& o) {
  v("name", o.name), v("type", o.type, "flatness, straightness, parallelism"), v("of", o.of, "features");
}

/// features.yaml
struct FeatureFile {
  std::vector<FeatureRecipe> features;
  std::vector<QuantityRecipe> measurements;
  std::vector<AlongRecipe> along;

  /// An Error (subject `origin`) for doubled or unknown names and for features that do not fit their use.
  void check(const std::string& origin) const;
};
template <class V>
void visit_fields(V&& v, FeatureFile& o) {
  v("features", o.features), v("measurements", o.measurements), v("along", o.along, "over the whole scan");
}

}  // namespace lightstripe
