// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/border_ends.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "extraction/lines/end_view.h"
#include "extraction/lines/local_fit.h"

namespace lightstripe {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Sigma: from there on the kernels hardly see the border; the stretch that tells how the line runs; and a
/// longer one, which tells whether a parabola is enough.
constexpr double kSeen = 1.5, kTelling = 4, kLonger = 6;
constexpr std::size_t kFewestTelling = 8;

/// The line near one end in its own frame: `along` it and across, from the first undisturbed point on.
struct EndFrame {
  const StripePoint& origin;
  double along_x, along_y;

  double along(const StripePoint& p) const { return (p.x - origin.x) * along_x + (p.y - origin.y) * along_y; }
  double across(const StripePoint& p) const {
    return (p.y - origin.y) * along_x - (p.x - origin.x) * along_y;
  }
};

/// A parabola across the line, and its covariance.
struct EndParabola {
  Vector3d terms;
  Matrix3d covariance;

  static Vector3d powers(double along) { return {1, along, along * along}; }
  double at(double along) const { return terms.dot(powers(along)); }
  double variance(double along) const { return powers(along).dot(covariance * powers(along)); }
};

/// Through the points [first, count) from the end on; `shared`: points that share one error.
EndParabola parabola_through(const EndView& end, const EndFrame& frame, std::size_t first, std::size_t count,
                             double shared) {
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (std::size_t i = first; i < count; ++i) {
    const Vector3d powers = EndParabola::powers(frame.along(end[i]));
    const double weight = 1 / std::max(1e-12, end[i].sigma_px * end[i].sigma_px);
    normal += weight * powers * powers.transpose();
    right += weight * frame.across(end[i]) * powers;
  }
  const Matrix3d inverse = normal.ldlt().solve(Matrix3d::Identity());
  return {inverse * right, shared * inverse};
}

template <class T>
void find_at_end(ImageView<T> image, const EndView& end, double sigma, double shared_px,
                 std::span<float> errors) {
  std::size_t seen = 0;
  while (seen < end.size() && is_near_border(image, end[seen], kSeen * sigma)) ++seen;
  const std::size_t telling = std::max(kFewestTelling, static_cast<std::size_t>(kTelling * sigma)),
                    count = seen + telling;
  if (seen == 0 || count > end.size() || joined_end(end.stretch(count), 0) < count) return;
  const StripePoint &origin = end[seen], &inside = end[count - 1];
  const double dx = inside.x - origin.x, dy = inside.y - origin.y, length = std::hypot(dx, dy);
  if (length < 1e-9) return;
  const EndFrame frame{origin, dx / length, dy / length};
  const double shared = std::max(1.0, shared_px * static_cast<double>(telling) / length);
  const EndParabola parabola = parabola_through(end, frame, seen, count, shared);
  const std::size_t longer = seen + static_cast<std::size_t>(kLonger * sigma);
  const bool goes_on = longer <= end.size() && joined_end(end.stretch(longer), 0) >= longer;
  const EndParabola by_longer = goes_on ? parabola_through(end, frame, seen, longer, shared) : parabola;
  for (std::size_t i = 0; i < seen; ++i) {
    const double along = frame.along(end[i]), off = frame.across(end[i]) - parabola.at(along);
    // Where the bend changes, the parabola misses the line about half as far as the two differ.
    const double change = 0.5 * (parabola.at(along) - by_longer.at(along));
    const double explained = parabola.variance(along) + change * change + end[i].sigma_px * end[i].sigma_px;
    float& error = errors[end.index(i)];
    error = std::hypot(error, static_cast<float>(std::sqrt(std::max(0.0, off * off - explained))));
  }
}

}  // namespace

template <class T>
void find_border_errors(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines) {
  lines.systematic.resize(lines.points.size(), 0.0F);
  for (const LineRange& r : lines.lines) {
    const std::span<StripePoint> line(lines.points.data() + r.begin, r.size());
    for (const bool from_back : {false, true})
      find_at_end(image, {line, from_back}, kernels.sigma, r.shared_px,
                  std::span(lines.systematic).subspan(r.begin, r.size()));
  }
}

template void find_border_errors<std::uint8_t>(ImageView8, const DerivativeKernels&, LineSet&);
template void find_border_errors<std::uint16_t>(ImageView16, const DerivativeKernels&, LineSet&);

}  // namespace lightstripe
