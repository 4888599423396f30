// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/patience.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {
namespace {

/// Px: seeds lie in a grid of 2 to 8 px.
constexpr double kLeastWidth = 4;
/// Full widths: in all directions, around a corner; and aside of the straight way, which spreads.
constexpr double kCorner = 2, kAside = 0.75, kSpread = 0.3;

}  // namespace

void SearchPatience::reset(int width, int height, const FollowTuning& tuning) {
  futile_ = found_ = 0;
  shorter_ = std::min(width, height);
  const double size = width + height;
  most_ = tuning.futile_points * size;
  least_ = tuning.futile_points_with_line * size;
  beside_ends_ = tuning.futile_points_beside_ends * size;
  crowd_ = tuning.futile_points_of_crowd * size;
  along_chains_ = tuning.futile_points_along_chains * size;
  most_missing_ = tuning.missing_in_crowd;
  chains_tried_ = false;
  reach_widths_ = tuning.widths_beside_end;
  ends_.clear();
}

void SearchPatience::add_line(std::span<const StripePoint> points, double full_width) {
  if (points.empty()) return;
  found_ += static_cast<double>(points.size());
  const std::size_t inside =
      std::min(points.size() - 1, static_cast<std::size_t>(std::max(kLeastWidth, full_width)));
  const auto add_end = [&](const StripePoint& p, const StripePoint& further_in) {
    const double dx = p.x - further_in.x, dy = p.y - further_in.y,
                 length = std::max(std::hypot(dx, dy), 1e-9);
    ends_.push_back({p.x, p.y, dx / length, dy / length, std::max(kLeastWidth, full_width)});
  };
  add_end(points.front(), points[inside]);
  add_end(points.back(), points[points.size() - 1 - inside]);
}

double SearchPatience::missing() const { return std::max(0.0, 1 - found_ / shorter_); }

double SearchPatience::most() const { return least_ + missing() * (most_ - least_); }

bool SearchPatience::is_beside(const End& end, int x, int y) const {
  const double dx = x - end.x, dy = y - end.y, distance2 = dx * dx + dy * dy;
  if (distance2 > reach_widths_ * reach_widths_ * end.width * end.width) return false;
  if (distance2 < kCorner * kCorner * end.width * end.width) return true;
  const double along = dx * end.along_x + dy * end.along_y,
               aside = std::abs(dx * end.along_y - dy * end.along_x);
  return along > 0 && aside < kAside * end.width + kSpread * along;
}

bool SearchPatience::is_beside_end(int x, int y) const {
  return std::any_of(ends_.begin(), ends_.end(), [&](const End& end) { return is_beside(end, x, y); });
}

}  // namespace lightstripe
