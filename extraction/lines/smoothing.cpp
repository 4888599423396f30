// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>

#include "extraction/lines/ranked_value.h"

namespace lightstripe {
namespace {

using Node = SmoothingWorkspace::Node;
using Change = SmoothingWorkspace::Change;

/// Nodes in the length along which neighbours share their error; more tell nothing new.
constexpr double kNodesPerShared = 3;
/// Longest bridge inside a stretch, in those lengths.
constexpr double kLongestBridge = 6;
constexpr std::size_t kFewestNodes = 8;
/// Near the ends of a stretch, over the line's own sigma: what the end has drawn aside goes its own way.
constexpr double kMostDoubtful = 1.3;
/// Over a point's own sigma: where the curve lies farther off, it is not the line, as behind a hook at an
/// end.
constexpr double kFarthest = 3;
/// Steps of the estimate are longer than plain expectation maximisation takes, in logarithms: it creeps.
constexpr int kPasses = 10;
constexpr double kStride = 1.7;
/// A curve that looks over r nodes has a noise of about r^6 changes. To begin with all changes of a stretch
/// are alike, over 2 to 46 nodes; beyond that double precision would end.
constexpr std::array<double, 10> kFirstRatios{64, 400, 3e3, 2e4, 1.5e5, 1e6, 1e7, 1e8, 1e9, 1e10};
/// Neighbouring places expect about the same, over half the length of shared errors to both sides.
constexpr std::array<double, 5> kPooled{1.0 / 12, 3.0 / 12, 4.0 / 12, 3.0 / 12, 1.0 / 12};

/// How nodes stand among the points.
struct NodeSpacing {
  std::size_t first = 0, step = 1;  ///< points
  double shared = 1;                ///< points that share one error

  /// Variance of what the points around a node tell, px^2; `sigma`: of each of them.
  double noise(double sigma) const {
    return std::max(1e-12, shared * sigma * sigma / static_cast<double>(step));
  }
  /// The i-th point's, in nodes.
  double place(std::size_t i) const {
    return (static_cast<double>(i) - static_cast<double>(first)) / static_cast<double>(step);
  }
};

void place_nodes(std::span<const StripePoint> points, const NodeSpacing& spacing, std::vector<Node>& nodes) {
  nodes.clear();
  for (std::size_t i = spacing.first; i < points.size(); i += spacing.step) {
    const StripePoint& p = points[i];
    nodes.push_back({p.x, p.y, p.normal_x, p.normal_y, spacing.noise(p.sigma_px)});
  }
}

/// The kernels' normals scatter more than chords over twice the length of shared errors, and a curve that is
/// drawn from side to side by its normals would seem to bend.
void turn_to_chords(std::vector<Node>& nodes) {
  constexpr auto kReach = static_cast<std::size_t>(kNodesPerShared) + 1;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node &a = nodes[i - std::min(i, kReach)], &b = nodes[std::min(i + kReach, nodes.size() - 1)];
    const double x = b.y - a.y, y = a.x - b.x, length = std::hypot(x, y);
    if (length < 1e-9) continue;
    const double side = x * nodes[i].normal_x + y * nodes[i].normal_y < 0 ? -1 : 1;
    nodes[i].normal_x = side * x / length;
    nodes[i].normal_y = side * y / length;
  }
}

void find_changes(const std::vector<Node>& nodes, std::vector<Change>& changes) {
  constexpr std::array<double, 4> kThirdDifference{-1, 3, -3, 1};
  changes.clear();
  for (std::size_t i = 0; i + 3 < nodes.size(); ++i) {
    double x = nodes[i + 1].normal_x + nodes[i + 2].normal_x,
           y = nodes[i + 1].normal_y + nodes[i + 2].normal_y;
    const double length = std::max(std::hypot(x, y), 1e-9);
    x /= length;
    y /= length;
    Change c;
    for (std::size_t m = 0; m < 4; ++m) {
      const Node& node = nodes[i + m];
      c.factors.at(m) = kThirdDifference.at(m) * (node.normal_x * x + node.normal_y * y);
      c.seen += kThirdDifference.at(m) * (node.x * x + node.y * y);
    }
    changes.push_back(c);
  }
}

/// What the points' noise adds to the changes: its covariance.
void find_noise(std::span<const Node> nodes, std::span<const Change> changes, BandMatrix& matrix) {
  matrix.assign(changes.size(), {});
  for (std::size_t j = 0; j < changes.size(); ++j)
    for (std::size_t k = 0; k < std::min<std::size_t>(4, changes.size() - j); ++k)
      for (std::size_t m = k; m < 4; ++m)
        matrix[j].at(k) += changes[j].factors.at(m) * changes[j + k].factors.at(m - k) * nodes[j + m].noise;
}

/// Inverse covariance of the nodes' places, given the points.
void set_up_information(std::span<const Node> nodes, std::span<const Change> changes, BandMatrix& matrix) {
  matrix.assign(nodes.size(), {});
  for (std::size_t i = 0; i < nodes.size(); ++i) matrix[i][0] = 1 / nodes[i].noise;
  for (std::size_t j = 0; j < changes.size(); ++j)
    for (std::size_t m = 0; m < 4; ++m)
      for (std::size_t k = m; k < 4; ++k)
        matrix[j + m].at(k - m) += changes[j].factors.at(m) * changes[j].factors.at(k) / changes[j].expected;
}

/// The changes that are seen, weighed by their covariance: that of the curve's own, and the noise.
void weigh_changes(SmoothingWorkspace& w) {
  w.factor = w.noise;
  for (std::size_t j = 0; j < w.changes.size(); ++j) w.factor[j][0] += w.changes[j].expected;
  factorise(w.factor);
  w.solution.clear();
  for (const Change& c : w.changes) w.solution.push_back(c.seen);
  solve(w.factor, w.solution);
}

/// Mean squares of the curve's changes, given the points.
void find_squares(SmoothingWorkspace& w) {
  weigh_changes(w);
  invert(w.factor, w.inverse);
  for (std::size_t j = 0; j < w.changes.size(); ++j) {
    Change& c = w.changes[j];
    const double mean = c.expected * w.solution[j], known = c.expected * w.inverse[j][0];
    c.square = mean * mean + c.expected * std::max(0.0, 1 - known);
  }
}

void expect_what_is_seen(double least, std::span<Change> changes) {
  const auto last = static_cast<std::ptrdiff_t>(changes.size()) - 1;
  for (std::ptrdiff_t j = 0; j <= last; ++j) {
    double square = 0;
    for (std::ptrdiff_t m = 0; m < 5; ++m)
      square += kPooled.at(static_cast<std::size_t>(m)) *
                changes[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(j + m - 2, 0, last))].square;
    double& expected = changes[static_cast<std::size_t>(j)].expected;
    expected = std::max(least, expected * std::pow(square / expected, kStride));
  }
}

/// The third-degree polynomial through four values at 0, 1, 2, 3.
std::array<double, 4> cubic_weights(double t) {
  const double a = t, b = t - 1, c = t - 2, d = t - 3;
  return {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6};
}

void move_points(std::span<const Node> nodes, const NodeSpacing& spacing, std::span<StripePoint> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    StripePoint& p = points[i];
    const double place = spacing.place(i);
    const auto begin =
        static_cast<std::size_t>(std::clamp(place - 1, 0.0, static_cast<double>(nodes.size() - 4)));
    const std::array<double, 4> weights = cubic_weights(place - static_cast<double>(begin));
    double x = 0, y = 0;
    for (std::size_t m = 0; m < 4; ++m) {
      const Node& node = nodes[begin + m];
      x += weights.at(m) * (node.x + node.aside * node.normal_x);
      y += weights.at(m) * (node.y + node.aside * node.normal_y);
    }
    const double aside = (x - p.x) * p.normal_x + (y - p.y) * p.normal_y;
    if (std::abs(aside) > kFarthest * p.sigma_px) continue;
    p.x += aside * p.normal_x;
    p.y += aside * p.normal_y;
    const auto before =
        static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(nodes.size() - 2)));
    const double share = std::clamp(place - static_cast<double>(before), 0.0, 1.0);
    const double variance =
        nodes[before].variance + share * (nodes[before + 1].variance - nodes[before].variance);
    p.sigma_px = std::min(p.sigma_px, std::sqrt(variance));
  }
}

/// -2 log of the probability of what is seen, all changes expected alike, less a constant.
double surprise_by(double expected, SmoothingWorkspace& w) {
  for (Change& c : w.changes) c.expected = expected;
  weigh_changes(w);
  double surprise = 0;
  for (std::size_t j = 0; j < w.changes.size(); ++j)
    surprise += std::log(w.factor[j][0]) + w.changes[j].seen * w.solution[j];
  return surprise;
}

void expect_alike(double noise, SmoothingWorkspace& w) {
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (const double ratio : kFirstRatios) {
    const double surprise = surprise_by(noise / ratio, w);
    if (surprise < least) {
      least = surprise;
      best = noise / ratio;
    }
  }
  for (Change& c : w.changes) c.expected = best;
}

/// The curve that the points and the expected changes make likeliest.
void fit_curve(SmoothingWorkspace& w) {
  weigh_changes(w);
  for (std::size_t j = 0; j < w.changes.size(); ++j)
    for (std::size_t m = 0; m < 4; ++m)
      w.nodes[j + m].aside -= w.nodes[j + m].noise * w.changes[j].factors.at(m) * w.solution[j];
  set_up_information(w.nodes, w.changes, w.factor);
  factorise(w.factor);
  invert(w.factor, w.inverse);
  for (std::size_t i = 0; i < w.nodes.size(); ++i) w.nodes[i].variance = w.inverse[i][0];
}

/// From point to point, px; bends count, scatter does not.
double mean_distance(std::span<const StripePoint> points) {
  constexpr std::size_t kStep = 8;
  double length = 0;
  for (std::size_t i = 0; i + 1 < points.size(); i += kStep) {
    const StripePoint &a = points[i], &b = points[std::min(i + kStep, points.size() - 1)];
    length += std::hypot(b.x - a.x, b.y - a.y);
  }
  return std::max(length / static_cast<double>(points.size() - 1), 1e-3);
}

void smooth_stretch(std::span<StripePoint> points, double shared_px, double sigma, SmoothingWorkspace& w) {
  NodeSpacing spacing;
  spacing.shared = std::max(1.0, shared_px / mean_distance(points));
  spacing.step = static_cast<std::size_t>(std::max(1.0, spacing.shared / kNodesPerShared));
  spacing.first = (points.size() - 1) % spacing.step / 2;
  place_nodes(points, spacing, w.nodes);
  if (w.nodes.size() < kFewestNodes) return;
  const double noise = spacing.noise(sigma);
  turn_to_chords(w.nodes);
  find_changes(w.nodes, w.changes);
  find_noise(w.nodes, w.changes, w.noise);
  expect_alike(noise, w);
  for (int pass = 0; pass < kPasses; ++pass) {
    find_squares(w);
    expect_what_is_seen(noise / kFirstRatios.back(), w.changes);
  }
  fit_curve(w);
  move_points(w.nodes, spacing, points);
}

/// The end of the stretch that begins at `begin` without gaps and long bridges. A short bridge is a curve
/// through both sides, which a curve over them agrees with.
std::size_t stretch_end(std::span<const StripePoint> points, std::size_t begin, double longest_bridge) {
  std::size_t end = begin + 1, bridged = 0;
  for (; end < points.size(); ++end) {
    const double dx = points[end].x - points[end - 1].x, dy = points[end].y - points[end - 1].y;
    if (dx * dx + dy * dy >= 4.0) return end - bridged;
    bridged = (points[end].flags & kStripeBridged) != 0 ? bridged + 1 : 0;
    if (static_cast<double>(bridged) > longest_bridge) break;
  }
  return std::max(begin + 1, std::min(end, points.size()) - std::min(bridged, end - begin - 1));
}

/// Without the points at both ends that are clearly less sure than the line.
std::span<StripePoint> without_doubtful_ends(std::span<StripePoint> points, double sigma) {
  const auto is_sure = [&](const StripePoint& p) { return p.sigma_px <= kMostDoubtful * sigma; };
  const auto first = std::ranges::find_if(points, is_sure);
  const auto behind = std::find_if(points.rbegin(), std::make_reverse_iterator(first), is_sure).base();
  return {first, behind};
}

double typical_sigma(std::span<const StripePoint> line, std::vector<float>& scratch) {
  scratch.clear();
  for (const StripePoint& p : line) scratch.push_back(static_cast<float>(p.sigma_px));
  return std::max(1e-6, static_cast<double>(ranked_median(scratch)));
}

}  // namespace

void smooth_along_lines(LineSet& lines, SmoothingWorkspace& workspace) {
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    const double sigma = typical_sigma(line, workspace.sigmas);
    for (std::size_t begin = 0; begin < line.size();) {
      const std::size_t end = stretch_end(line, begin, kLongestBridge * r.shared_px);
      const auto stretch = without_doubtful_ends(line.subspan(begin, end - begin), sigma);
      if (stretch.size() > 2) smooth_stretch(stretch, r.shared_px, sigma, workspace);
      begin = end;
    }
  }
}

}  // namespace lightstripe
