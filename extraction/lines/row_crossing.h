// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The row or column of the image that crosses a line at one of its points, and where rows see the line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <vector>

#include "extraction/follow/direction_guided_ridge.h"
#include "extraction/lines/line_set.h"

namespace lightstripe {

struct RowCrossing {
  bool is_row = false;
  int index = 0;      ///< of the row or column
  double centre = 0;  ///< px along it
  double cosine = 1;  ///< of the angle between it and the line's normal
};

inline RowCrossing row_crossing_at(const StripePoint& p) {
  const bool is_row = std::abs(p.normal_x) >= std::abs(p.normal_y);
  const double across = is_row ? p.normal_x : p.normal_y, along = is_row ? p.normal_y : p.normal_x;
  const double place = is_row ? p.y : p.x, centre = is_row ? p.x : p.y;
  const int index = nearest_pixel(place);
  // The line goes on in its own direction from the point to the row's middle.
  return {is_row, index, centre - (index - place) * along / across, std::abs(across)};
}

/// Below this radius, in sigma, a line bends too much for the scatter of its rows to be told from its shape.
inline constexpr double kStraightRadius = 40;

/// Whether the line's radius around a point is below so many sigma, by the points 8 sigma away to both sides.
inline bool bends_at(const LineSet& lines, const LineRange& r, std::size_t i, double sigma,
                     double radius_in_sigma = kStraightRadius) {
  const auto reach = std::min(static_cast<std::size_t>(8 * sigma), (r.size() - 1) / 2);
  const std::size_t middle = std::clamp(i, r.begin + reach, r.end - 1 - reach);
  const StripePoint &a = lines.points[middle - reach], &b = lines.points[middle],
                    &c = lines.points[middle + reach];
  const double along_x = c.x - a.x, along_y = c.y - a.y, square = along_x * along_x + along_y * along_y;
  // 8 * sagitta * radius > chord^2, all of it squared: the sagitta is this product over the chord.
  const double product = 8 * radius_in_sigma * sigma * ((b.x - a.x) * along_y - (b.y - a.y) * along_x);
  return product * product > square * square * square;
}

/// Offsets of a line's rows in order, px across it, as differences_of_rows() takes them: NaN where one row
/// does not follow the other.
class RowOffsets {
 public:
  /// `offsets`: what is filled.
  explicit RowOffsets(std::vector<float>& offsets) : offsets_(offsets) { offsets_.clear(); }

  void skip() { offsets_.push_back(kGap); }
  /// Whether the row was added last: two points may lie in one.
  bool has(const RowCrossing& c) const { return c.is_row == last_.is_row && c.index == last_.index; }
  void add(const RowCrossing& c, float offset) {
    if (c.is_row != last_.is_row || std::abs(c.index - last_.index) != 1) skip();
    offsets_.push_back(offset);
    cosines_ += c.cosine;
    used_ += 1;
    last_ = c;
  }
  double mean_cosine() const { return used_ > 0 ? cosines_ / used_ : 1; }

 private:
  static constexpr float kGap = std::numeric_limits<float>::quiet_NaN();
  std::vector<float>& offsets_;
  RowCrossing last_;
  double cosines_ = 0, used_ = 0;
};

}  // namespace lightstripe
