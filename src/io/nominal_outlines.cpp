// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "io/nominal_outlines.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
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
  std::vector<double> polynomial;
};
template <class V>
void visit_fields(V&& v, SegmentFields& o) {
  v("to", o.to, "mm, the segment's end");
  v("center", o.center, "mm, of an arc; left out: a straight line");
  v("polynomial", o.polynomial, "v = c0 + c1 u + c2 u^2 + ..., between the two ends");
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

/// A published polynomial need not meet its neighbours better than this (S1002: 1.2e-4 mm).
constexpr double kPolynomialJointMm = 2e-4;

double value_of(const std::vector<double>& polynomial, double u) {
  double value = 0;
  for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) value = value * u + *c;
  return value;
}

/// The circle through three points as the arc from the first to the last; a line where they are in line.
OutlineSegment arc_through(const Eigen::Vector2d& a, const Eigen::Vector2d& middle,
                           const Eigen::Vector2d& b) {
  constexpr double kStraightMm = 1e-9;  // height of the arc over its chord
  const Eigen::Vector2d p = middle - a, q = b - a;
  const double cross = p.x() * q.y() - p.y() * q.x();
  if (std::abs(cross) < kStraightMm * q.norm()) return line_segment(a, b);
  const Eigen::Vector2d centre(q.y() * p.squaredNorm() - p.y() * q.squaredNorm(),
                               p.x() * q.squaredNorm() - q.x() * p.squaredNorm());
  return arc_segment(a, b, a + centre / (2 * cross));
}

/// As arcs a quarter of a millimetre long: what they leave out is far below the polynomials' own rounding.
void append_polynomial(Outline& chain, const Eigen::Vector2d& from, const SegmentFields& segment,
                       const std::string& subject) {
  constexpr double kArcMm = 0.25;
  const double span = segment.to.x() - from.x();
  for (const Eigen::Vector2d& end : {from, segment.to})
    if (!(std::abs(value_of(segment.polynomial, end.x()) - end.y()) <= kPolynomialJointMm))
      throw Error(subject, fmt::format("the polynomial misses the end ({}, {})", end.x(), end.y()),
                  "correct `polynomial` or `to`");
  if (!(std::abs(span) < 1e4)) throw Error(subject, "is longer than 10 m", "give lengths in mm");
  const int arcs = std::max(1, static_cast<int>(std::ceil(std::abs(span) / kArcMm)));
  const auto node = [&](double i) {
    const double u = from.x() + span * i / arcs;
    return Eigen::Vector2d(u, value_of(segment.polynomial, u));
  };
  Eigen::Vector2d at = from;
  for (int i = 0; i < arcs; ++i) {
    const Eigen::Vector2d end = i + 1 == arcs ? segment.to : node(i + 1);
    chain.segments.push_back(arc_through(at, node(i + 0.5), end));
    at = end;
  }
}

void append_segment(Outline& chain, const Eigen::Vector2d& from, const SegmentFields& segment,
                    const std::string& subject) {
  if (segment.to == from) throw Error(subject, "ends where it begins", "leave it out");
  if (segment.center && !segment.polynomial.empty())
    throw Error(subject, "has a center and a polynomial", "keep one of them");
  if (!segment.polynomial.empty()) return append_polynomial(chain, from, segment, subject);
  chain.segments.push_back(segment.center ? arc_segment(from, segment.to, *segment.center)
                                          : line_segment(from, segment.to));
  if (segment.center) check_arc(chain.segments.back(), subject);
}

constexpr double kLeastAreaMm2 = 1e-3;

Outline outline_of(const OutlineFields& fields, const std::string& origin) {
  if (fields.format != "lightstripe-outline/1")
    throw Error(origin + ": format", "is '" + fields.format + "'", "write format: lightstripe-outline/1");
  Outline chain;
  Eigen::Vector2d from = fields.start;
  for (std::size_t i = 0; i < fields.segments.size(); ++i) {
    append_segment(chain, from, fields.segments[i], fmt::format("{}: segments.{}", origin, i));
    from = fields.segments[i].to;
  }
  if (fields.mirrored &&
      (std::abs(fields.start.x()) > kOutlineJointMm || std::abs(from.x()) > kOutlineJointMm))
    throw Error(origin + ": mirrored", "the half does not begin and end on the axis u = 0",
                "correct `start` or the last `to`");
  const Outline whole = fields.mirrored ? mirrored(chain) : chain;
  if (!whole.closed()) throw Error(origin + ": segments", "do not close", "let the last one end at `start`");
  const double area = section_properties(whole).area;
  if (!(std::abs(area) > kLeastAreaMm2))
    throw Error(origin + ": segments", "enclose no area", "give the whole outline");
  return area > 0 ? whole : reversed(whole);
}

bool is_path(const std::string& text) {
  return text.find('/') != std::string::npos || text.ends_with(".yaml");
}

}  // namespace

NominalProfile read_nominal_profile(const std::string& name_or_path) {
  OutlineFields fields;
  if (is_path(name_or_path)) {
    read_yaml(name_or_path, fields);
    return {fields.name, fields.kind, outline_of(fields, name_or_path)};
  }
  for (const EmbeddedProfile& profile : kEmbeddedProfiles)
    if (profile.name == name_or_path) {
      read_subtree({std::string(profile.text), name_or_path}, fields);
      return {fields.name, fields.kind, outline_of(fields, name_or_path)};
    }
  throw Error(
      name_or_path, "no nominal outline of this name is built in",
      fmt::format("use one of {}, or give the path of an outline file", fmt::join(nominal_names(), ", ")));
}

Outline read_nominal(const std::string& name_or_path) { return read_nominal_profile(name_or_path).outline; }

std::vector<std::string> nominal_names() {
  std::vector<std::string> names;
  for (const EmbeddedProfile& profile : kEmbeddedProfiles) names.emplace_back(profile.name);
  return names;
}

}  // namespace lightstripe
