// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/nominal_outlines.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "io/embedded_profiles.h"
#include "io/yaml_binding.h"

namespace lightstripe {
namespace {

/// The file as it is written.
struct SegmentFields {
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> center;
};
template <class V>
void visit_fields(V&& v, SegmentFields& o) {
  v("to", o.to, "mm, the segment's end");
  v("center", o.center, "mm, of an arc; left out: a straight line");
}

struct OutlineFields {
  std::string format, name, kind;
  bool mirrored = false;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  std::vector<SegmentFields> segments;
};
template <class V>
void visit_fields(V&& v, OutlineFields& o) {
  v("format", o.format);
  v("name", o.name);
  v("kind", o.kind);
  v("mirrored", o.mirrored, "the other half is this one's mirror image");
  v("start", o.start, "mm");
  v("segments", o.segments);
}

void check_arc(const OutlineSegment& arc, const std::string& subject) {
  const double difference = std::abs((arc.from - arc.center).norm() - (arc.to - arc.center).norm());
  if (difference > kOutlineJointMm)
    throw Error(
        subject,
        fmt::format("the arc's ends differ by {:.3g} mm in their distance from its centre", difference),
        "correct `to` or `center`");
}

Outline outline_of(const OutlineFields& fields, const std::string& origin) {
  if (fields.format != "lightstripe-outline/1")
    throw Error(origin + ": format", "is '" + fields.format + "'", "write format: lightstripe-outline/1");
  Outline chain;
  Eigen::Vector2d from = fields.start;
  for (std::size_t i = 0; i < fields.segments.size(); ++i) {
    const SegmentFields& segment = fields.segments[i];
    if (segment.to == from)
      throw Error(fmt::format("{}: segments.{}", origin, i), "ends where it begins", "leave it out");
    chain.segments.push_back(segment.center ? arc_segment(from, segment.to, *segment.center)
                                            : line_segment(from, segment.to));
    if (segment.center) check_arc(chain.segments.back(), fmt::format("{}: segments.{}", origin, i));
    from = segment.to;
  }
  if (fields.mirrored &&
      (std::abs(fields.start.x()) > kOutlineJointMm || std::abs(from.x()) > kOutlineJointMm))
    throw Error(origin + ": mirrored", "the half does not begin and end on the axis u = 0",
                "correct `start` or the last `to`");
  const Outline whole = fields.mirrored ? mirrored(chain) : chain;
  if (!whole.closed()) throw Error(origin + ": segments", "do not close", "let the last one end at `start`");
  return section_properties(whole).area > 0 ? whole : reversed(whole);
}

bool is_path(const std::string& text) {
  return text.find('/') != std::string::npos || text.ends_with(".yaml");
}

}  // namespace

Outline read_nominal(const std::string& name_or_path) {
  OutlineFields fields;
  if (is_path(name_or_path)) {
    read_yaml(name_or_path, fields);
    return outline_of(fields, name_or_path);
  }
  for (const EmbeddedProfile& profile : kEmbeddedProfiles)
    if (profile.name == name_or_path) {
      read_subtree({std::string(profile.text), name_or_path}, fields);
      return outline_of(fields, name_or_path);
    }
  throw Error(
      name_or_path, "no nominal outline of this name is built in",
      fmt::format("use one of {}, or give the path of an outline file", fmt::join(nominal_names(), ", ")));
}

std::vector<std::string> nominal_names() {
  std::vector<std::string> names;
  for (const EmbeddedProfile& profile : kEmbeddedProfiles) names.emplace_back(profile.name);
  return names;
}

}  // namespace lightstripe
