// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/compare/link_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "extraction/follow/line_point.h"

namespace lightstripe {
namespace {

struct Pixel {
  int x = 0, y = 0;
};

class Linker {
 public:
  explicit Linker(const LinePointMap& map) : map_(map), used_(map.strength.size(), 0) {}

  bool is_free(std::size_t i) const { return used_[i] == 0; }

  StripePoint point(Pixel p) const {
    const std::size_t i = map_.index(p.x, p.y);
    StripePoint out;
    out.x = p.x + static_cast<double>(map_.offset_x[i]);
    out.y = p.y + static_cast<double>(map_.offset_y[i]);
    // Kept in single precision: made a unit vector again.
    const double length = std::hypot(map_.normal_x[i], map_.normal_y[i]);
    out.normal_x = map_.normal_x[i] / length;
    out.normal_y = map_.normal_y[i] / length;
    out.strength = map_.strength[i];
    return out;
  }

  /// From `start` in the direction (dx, dy); appends points with normals that turn with the direction.
  void follow(Pixel start, double dx, double dy, std::vector<StripePoint>& out) {
    Pixel at = start;
    StripePoint last = point(start);
    while (const auto next = best_neighbour(at, last, dx, dy)) {
      StripePoint p = point(*next);
      double tx = p.normal_y, ty = -p.normal_x;
      if (tx * dx + ty * dy < 0) {
        p.normal_x = -p.normal_x;
        p.normal_y = -p.normal_y;
        tx = -tx;
        ty = -ty;
      }
      dx = tx;
      dy = ty;
      take(*next, p);
      out.push_back(p);
      at = *next;
      last = p;
    }
  }

  /// Marks the pixel and its response on both sides of the line, which is the same line seen once more.
  void take(Pixel at, const StripePoint& p) {
    for (int k = -1; k <= 1; ++k) {
      const int x = at.x + static_cast<int>(std::lround(k * p.normal_x));
      const int y = at.y + static_cast<int>(std::lround(k * p.normal_y));
      if (x >= 0 && y >= 0 && x < map_.width && y < map_.height) used_[map_.index(x, y)] = 1;
    }
  }

 private:
  std::optional<Pixel> best_neighbour(Pixel at, const StripePoint& last, double dx, double dy) const {
    constexpr std::array<Pixel, 8> kAround{
        {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    const auto octant = static_cast<int>(std::lround(std::atan2(dy, dx) / (std::numbers::pi / 4)));
    std::optional<Pixel> best;
    double least = 1e9;
    for (int k = -1; k <= 1; ++k) {
      const Pixel step = kAround[static_cast<std::size_t>((octant + k + 8) % 8)];
      const Pixel next{at.x + step.x, at.y + step.y};
      if (next.x < 0 || next.y < 0 || next.x >= map_.width || next.y >= map_.height) continue;
      const std::size_t i = map_.index(next.x, next.y);
      if (map_.strength[i] <= 0 || used_[i] != 0) continue;
      const StripePoint p = point(next);
      const double cosine = std::min(1.0, std::abs(p.normal_y * dx - p.normal_x * dy));
      const double cost = std::hypot(p.x - last.x, p.y - last.y) + std::acos(cosine);
      if (cosine < 0.5 || cost >= least) continue;
      least = cost;
      best = next;
    }
    return best;
  }

  const LinePointMap& map_;
  std::vector<std::uint8_t> used_;
};

}  // namespace

void LinePointMap::reset(int w, int h) {
  width = w;
  height = h;
  const std::size_t size = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  strength.assign(size, 0.0F);
  for (auto* v : {&offset_x, &offset_y, &normal_x, &normal_y}) v->resize(size);
}

void LinePointMap::test_pixel(int x, int y, const Derivatives& d, double least_strength) {
  const HessianAxes axes = hessian_axes(d);
  if (-axes.across < least_strength) return;
  const double t = ridge_offset(d, axes.normal_x, axes.normal_y, axes.across);
  // Steger's half pixel and a little: on a line that runs along a pixel border both sides may miss it
  // otherwise.
  constexpr double kHalf = 0.6;
  if (std::abs(t * axes.normal_x) > kHalf || std::abs(t * axes.normal_y) > kHalf) return;
  const std::size_t i = index(x, y);
  strength[i] = static_cast<float>(-axes.across);
  offset_x[i] = static_cast<float>(t * axes.normal_x);
  offset_y[i] = static_cast<float>(t * axes.normal_y);
  normal_x[i] = static_cast<float>(axes.normal_x);
  normal_y[i] = static_cast<float>(axes.normal_y);
}

void link_points(const LinePointMap& map, double start_strength, LineSet& lines) {
  constexpr std::size_t kLeastPoints = 5;
  std::vector<std::uint32_t> starts;
  for (std::size_t i = 0; i < map.strength.size(); ++i)
    if (map.strength[i] >= start_strength) starts.push_back(static_cast<std::uint32_t>(i));
  std::stable_sort(starts.begin(), starts.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return map.strength[a] > map.strength[b]; });
  Linker linker(map);
  std::vector<StripePoint> backward;
  for (const std::uint32_t i : starts) {
    if (!linker.is_free(i)) continue;
    const Pixel start{static_cast<int>(i) % map.width, static_cast<int>(i) / map.width};
    const StripePoint p = linker.point(start);
    linker.take(start, p);
    const std::size_t begin = lines.points.size();
    backward.clear();
    linker.follow(start, -p.normal_y, p.normal_x, backward);
    for (StripePoint& b : backward) {
      b.normal_x = -b.normal_x;
      b.normal_y = -b.normal_y;
    }
    lines.points.insert(lines.points.end(), backward.rbegin(), backward.rend());
    lines.points.push_back(p);
    linker.follow(start, p.normal_y, -p.normal_x, lines.points);
    if (lines.points.size() - begin >= kLeastPoints)
      lines.lines.push_back({begin, lines.points.size()});
    else
      lines.points.resize(begin);
  }
}

template <class T>
void refine_points(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines) {
  std::vector<T> border_window;
  for (StripePoint& p : lines.points) {
    const PhasedPosition x = to_phase(p.x), y = to_phase(p.y);
    const Derivatives d = evaluate_derivatives(image, x, y, kernels, p.normal_y, -p.normal_x, border_window);
    const double curvature = second_derivative(d, p.normal_x, p.normal_y);
    if (curvature >= 0) continue;
    const double t = ridge_offset(d, p.normal_x, p.normal_y, curvature);
    if (std::abs(t) > 0.5) continue;
    p.x = x.value() + t * p.normal_x;
    p.y = y.value() + t * p.normal_y;
    p.strength = -curvature;
  }
}

template void refine_points<std::uint8_t>(ImageView8, const DerivativeKernels&, LineSet&);
template void refine_points<std::uint16_t>(ImageView16, const DerivativeKernels&, LineSet&);

}  // namespace lightstripe
