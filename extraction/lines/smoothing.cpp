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
using Band = std::vector<std::array<double, 4>>;

/// Nodes in the length along which neighbours share their error; more tell nothing new.
constexpr double kNodesPerShared = 3;
/// Longest bridge inside a stretch, in those lengths.
constexpr double kLongestBridge = 6;
constexpr std::size_t kFewestNodes = 8;
/// Near the ends of a stretch, over the line's own sigma: what the end has drawn aside goes its own way.
constexpr double kMostDoubtful = 1.3;
/// Steps of the estimate are longer than plain expectation maximisation takes, in logarithms: it creeps.
constexpr int kPasses = 10;
constexpr double kStride = 1.7;
/// A curve that looks over r nodes has a noise of about r^6 changes. The first ones are alike all along the
/// stretch; the last one looks over 15 nodes, and beyond it double precision would end.
constexpr std::array<double, 6> kFirstRatios{64, 1e3, 1e4, 1e5, 1e6, 1e7};
/// Neighbouring places expect about the same, over half the length of shared errors to both sides.
constexpr std::array<double, 5> kPooled{1.0 / 12, 3.0 / 12, 4.0 / 12, 3.0 / 12, 1.0 / 12};

void place_nodes(std::span<const StripePoint> points, std::size_t step, double shared,
                 std::vector<Node>& nodes) {
  nodes.clear();
  for (std::size_t i = (points.size() - 1) % step / 2; i < points.size(); i += step) {
    const StripePoint& p = points[i];
    const double weight = static_cast<double>(step) / (shared * p.sigma_px * p.sigma_px);
    nodes.push_back({p.x, p.y, p.normal_x, p.normal_y, weight});
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

/// The normal equations' matrix, the row's entries from the diagonal on; right-hand sides go to `aside`.
void set_up(std::span<const Change> changes, std::vector<Node>& nodes, Band& matrix) {
  matrix.assign(nodes.size(), {});
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    matrix[i][0] = nodes[i].weight;
    nodes[i].aside = 0;
  }
  for (std::size_t j = 0; j < changes.size(); ++j) {
    const Change& c = changes[j];
    const double weight = 1 / c.variance;
    for (std::size_t m = 0; m < 4; ++m) {
      const double weighed = weight * c.factors.at(m);
      nodes[j + m].aside -= weighed * c.seen;
      for (std::size_t k = m; k < 4; ++k) matrix[j + m].at(k - m) += weighed * c.factors.at(k);
    }
  }
}

/// L D L^T in the matrix's place: [0] is D, [m] is L of the row m further on.
void factorise(Band& a) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::array<double, 4> row = a[i];
    const std::size_t reach = std::min<std::size_t>(3, a.size() - 1 - i);
    for (std::size_t m = 1; m <= reach; ++m) {
      const double l = row.at(m) / row[0];
      for (std::size_t k = m; k <= reach; ++k) a[i + m].at(k - m) -= l * row.at(k);
      a[i].at(m) = l;
    }
  }
}

void solve(const Band& factor, std::vector<Node>& nodes) {
  const std::size_t n = nodes.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t m = 1; m < 4 && i + m < n; ++m) nodes[i + m].aside -= factor[i].at(m) * nodes[i].aside;
  for (std::size_t i = n; i-- > 0;) {
    nodes[i].aside /= factor[i][0];
    for (std::size_t m = 1; m < 4 && i + m < n; ++m) nodes[i].aside -= factor[i].at(m) * nodes[i + m].aside;
  }
}

/// The inverse's entries within the band, from the last row on (Takahashi's equations).
void invert(const Band& factor, Band& inverse) {
  const std::size_t n = factor.size();
  inverse.assign(n, {});
  const auto at = [&](std::size_t i, std::size_t j) {
    return inverse[std::min(i, j)].at(std::max(i, j) - std::min(i, j));
  };
  for (std::size_t i = n; i-- > 0;) {
    const std::size_t reach = std::min<std::size_t>(3, n - 1 - i);
    for (std::size_t k = reach + 1; k-- > 0;) {
      double value = k == 0 ? 1 / factor[i][0] : 0.0;
      for (std::size_t m = 1; m <= reach; ++m) value -= factor[i].at(m) * at(i + m, i + k);
      inverse[i].at(k) = value;
    }
  }
}

/// Of the curve.
double change_of(const Change& c, std::span<const Node, 4> nodes) {
  double change = c.seen;
  for (std::size_t m = 0; m < 4; ++m) change += c.factors.at(m) * nodes[m].aside;
  return change;
}

/// Mean square of the changes, given the points.
void find_squares(std::span<const Node> nodes, const Band& inverse, std::span<Change> changes) {
  for (std::size_t j = 0; j < changes.size(); ++j) {
    Change& c = changes[j];
    const double mean = change_of(c, nodes.subspan(j).first<4>());
    double variance = 0;
    for (std::size_t m = 0; m < 4; ++m) {
      variance += c.factors.at(m) * c.factors.at(m) * inverse[j + m][0];
      for (std::size_t k = m + 1; k < 4; ++k)
        variance += 2 * c.factors.at(m) * c.factors.at(k) * inverse[j + m].at(k - m);
    }
    c.square = mean * mean + std::max(variance, 0.0);
  }
}

void expect_what_is_seen(double least, std::span<Change> changes) {
  const auto last = static_cast<std::ptrdiff_t>(changes.size()) - 1;
  for (std::ptrdiff_t j = 0; j <= last; ++j) {
    double square = 0;
    for (std::ptrdiff_t m = 0; m < 5; ++m)
      square += kPooled.at(static_cast<std::size_t>(m)) *
                changes[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(j + m - 2, 0, last))].square;
    double& variance = changes[static_cast<std::size_t>(j)].variance;
    variance = std::max(least, variance * std::pow(square / variance, kStride));
  }
}

/// The third-degree polynomial through four values at 0, 1, 2, 3.
std::array<double, 4> cubic_weights(double t) {
  const double a = t, b = t - 1, c = t - 2, d = t - 3;
  return {-b * c * d / 6, a * c * d / 2, -a * b * d / 2, a * b * c / 6};
}

void move_points(std::span<const Node> nodes, std::size_t step, std::span<StripePoint> points) {
  const std::size_t first = (points.size() - 1) % step / 2;
  for (std::size_t i = 0; i < points.size(); ++i) {
    StripePoint& p = points[i];
    const double place = (static_cast<double>(i) - static_cast<double>(first)) / static_cast<double>(step);
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

/// The likeliest curve, where it stands.
void fit_curve(SmoothingWorkspace& w) {
  set_up(w.changes, w.nodes, w.factor);
  factorise(w.factor);
  solve(w.factor, w.nodes);
}

/// -2 log of the points' probability, all changes expected to be as large as `variance`, less a constant.
double surprise_by(double variance, SmoothingWorkspace& w) {
  for (Change& c : w.changes) c.variance = variance;
  fit_curve(w);
  double surprise = static_cast<double>(w.changes.size()) * std::log(variance);
  for (std::size_t i = 0; i < w.nodes.size(); ++i)
    surprise += std::log(w.factor[i][0]) + w.nodes[i].weight * w.nodes[i].aside * w.nodes[i].aside;
  for (std::size_t j = 0; j < w.changes.size(); ++j) {
    const double change = change_of(w.changes[j], std::span(w.nodes).subspan(j).first<4>());
    surprise += change * change / variance;
  }
  return surprise;
}

/// One size of all changes along the stretch, to begin with.
void expect_alike(double noise, SmoothingWorkspace& w) {
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (const double ratio : kFirstRatios) {
    const double surprise = surprise_by(noise / ratio, w);
    if (surprise < least) {
      least = surprise;
      best = noise / ratio;
    }
  }
  for (Change& c : w.changes) c.variance = best;
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
  const double shared = std::max(1.0, shared_px / mean_distance(points));
  const auto step = static_cast<std::size_t>(std::max(1.0, shared / kNodesPerShared));
  place_nodes(points, step, shared, w.nodes);
  if (w.nodes.size() < kFewestNodes) return;
  const double noise = shared * sigma * sigma / static_cast<double>(step);
  find_changes(w.nodes, w.changes);
  expect_alike(noise, w);
  for (int pass = 0;; ++pass) {
    fit_curve(w);
    invert(w.factor, w.inverse);
    if (pass == kPasses) break;
    find_squares(w.nodes, w.inverse, w.changes);
    expect_what_is_seen(noise / kFirstRatios.back(), w.changes);
  }
  for (std::size_t i = 0; i < w.nodes.size(); ++i) w.nodes[i].variance = w.inverse[i][0];
  move_points(w.nodes, step, points);
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
