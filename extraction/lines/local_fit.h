// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Least-squares parabolas through the neighbours of every point of a line, at a cost that does not grow with
// their number.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/stripe.h"

namespace lightstripe {

struct LocalFitPoint {
  double x = 0, y = 0;  ///< px
};

/// The parabola x(k), y(k) of the points i - reach ... i + reach by their number k = -reach ... reach.
struct LocalFit {
  double x = 0, y = 0;                      ///< at the point itself, px
  double slope_x = 0, slope_y = 0;          ///< px a point: along the line
  double curvature_x = 0, curvature_y = 0;  ///< vector to the centre of curvature, 1 / px
  double second_x = 0, second_y = 0;        ///< second derivatives by the point's number
  double squared_step = 1;                  ///< slope's squared length
};

/// Gains of a parabola over 2 reach + 1 values: standard deviations for values of independent unit noise.
struct LocalFitGains {
  double centre = 1;     ///< of the value at the middle
  double curvature = 1;  ///< of the second derivative
};
LocalFitGains local_fit_gains(std::size_t reach);
/// Variance of the parabola's value `offset` points beside the middle, for values of independent unit noise.
double local_fit_variance(std::size_t reach, double offset);

/// Sums that slide along a line. Windows must lie inside `points`.
class LocalFitter {
 public:
  explicit LocalFitter(std::span<const LocalFitPoint> points) : points_(points) {}
  /// The fit around point i; costs little where i follows the last i closely, at the same reach.
  LocalFit at(std::size_t i, std::size_t reach);

 private:
  struct Sums {
    double s0 = 0, s1 = 0, s2 = 0;  ///< of value, k value, k^2 value
    void add(double k, double value) {
      s0 += value;
      s1 += k * value;
      s2 += k * k * value;
    }
    /// The window moves on by one: every k falls by one, `left` leaves, `right` comes in at k = reach.
    void slide(double left, double right, double reach) {
      add(-reach, -left);
      s2 += s0 - 2 * s1;
      s1 -= s0;
      add(reach, right);
    }
  };
  struct Factors {
    double mean_square = 0, scale = 0, inverse_n = 0, inverse_s2 = 0;
  };
  void start(std::size_t i, std::size_t reach);
  void slide_to(std::size_t i);

  std::span<const LocalFitPoint> points_;
  std::size_t last_ = 0, reach_ = 0;  ///< reach_ = 0: no window yet
  std::size_t slides_ = 0;
  double origin_x_ = 0, origin_y_ = 0;  ///< subtracted, so that the sums keep their digits
  Factors f_;                           ///< of the window's size
  Sums x_, y_;
};

/// The end of the stretch of points that begins at `begin` and is joined without a gap or a bridge.
std::size_t joined_end(std::span<const StripePoint> points, std::size_t begin);

}  // namespace lightstripe
