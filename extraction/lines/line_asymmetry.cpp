// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/lines/line_asymmetry.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

#include "core/robust.h"
#include "extraction/follow/direction_guided_ridge.h"

namespace lightstripe {
namespace {

constexpr double kNarrow = 0.6, kBroad = 1.5;  // times the line's own scale
/// What the two scales disagree by, times this, bounds the shift: glow of 15 to 50 % of the peak over 0.5 to
/// 6 s, steps of a quarter to half the peak within 1.5 s, computed without noise (their largest shift is 2.5
/// times as much, in most it is less).
constexpr double kShiftByDisagreement = 2;

/// Rows of one stretch, laid over each other by the pixel nearest to the line.
struct MeanProfile {
  double centre = 0;  ///< mean place of the line's centre against the middle pixel, px along the rows
  double cosine = 1;
  int rows = 0;
};

std::uint32_t sum_of(const std::uint16_t* pixels, int count) {
  std::uint32_t sum = 0;
  for (int i = 0; i < count; ++i) sum += pixels[i];
  return sum;
}

/// Eight at a time, in four sums of 16 bits: these hold 128 times as many.
std::uint32_t sum_of(const std::uint8_t* pixels, int count) {
  constexpr std::uint64_t kEven = 0x00FF00FF00FF00FF;
  constexpr int kMost = 1024;
  std::uint32_t sum = 0;
  if (count < 8) {
    for (int i = 0; i < count; ++i) sum += pixels[i];
    return sum;
  }
  for (; count > kMost; pixels += kMost, count -= kMost) sum += sum_of(pixels, kMost);
  std::uint64_t four = 0;
  int i = 0;
  for (; i + 8 <= count; i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, pixels + i, 8);
    four += (eight & kEven) + (eight >> 8 & kEven);
  }
  for (; i < count; ++i) sum += pixels[i];
  four = (four & 0x0000FFFF0000FFFF) + (four >> 16 & 0x0000FFFF0000FFFF);
  return sum + static_cast<std::uint32_t>(four) + static_cast<std::uint32_t>(four >> 32);
}

/// Columns side by side that cross the line at one row: of a line along the rows many do.
struct ColumnRun {
  int x = 0, y = 0, count = 0;
  bool forwards = true;

  bool goes_on(int next_x, int next_y, bool next_forwards) const {
    return count > 0 && next_x == x + count && next_y == y && next_forwards == forwards;
  }
};

/// The rows and columns of one stretch, laid over each other around the line's pixels. Profiles begin on the
/// side that the points' normals come from, so that rows and columns of one stretch agree. Sums of whole
/// numbers are exact in any order.
template <class T>
class ProfileSums {
 public:
  /// `sums`: scratch memory.
  ProfileSums(ImageView<T> image, int reach, std::vector<std::uint32_t>& sums)
      : image_(image), reach_(reach), size_(static_cast<std::size_t>(2 * reach + 1)), sums_(sums) {
    sums_.assign(2 * size_, 0);
  }

  void add(const StripePoint& p, MeanProfile& mean);
  /// After the last add().
  void to_profile(std::vector<float>& profile) {
    add_run();
    profile.resize(size_);
    for (std::size_t k = 0; k < size_; ++k)
      profile[k] = static_cast<float>(sums_[k]) + static_cast<float>(sums_[2 * size_ - 1 - k]);
  }

 private:
  /// Of the rows that are read forwards, or backwards.
  std::uint32_t* sums_of(bool forwards) { return sums_.data() + (forwards ? 0 : size_); }
  void add_run();

  ImageView<T> image_;
  int reach_;
  std::size_t size_;
  std::vector<std::uint32_t>& sums_;
  ColumnRun run_;
};

template <class T>
void ProfileSums<T>::add(const StripePoint& p, MeanProfile& mean) {
  const bool is_row = std::abs(p.normal_x) >= std::abs(p.normal_y);
  const int x = nearest_pixel(p.x), y = nearest_pixel(p.y);
  const int at = is_row ? x : y, count = is_row ? image_.width : image_.height;
  if (!image_.contains(x, y) || at < reach_ || at + reach_ >= count) return;
  const bool forwards = (is_row ? p.normal_x : p.normal_y) >= 0;
  if (is_row) {
    std::uint32_t* sum = sums_of(forwards);
    const T* pixel = image_.row(y) + x - reach_;
    for (int k = 0; k <= 2 * reach_; ++k) sum[k] += pixel[k];
  } else if (run_.goes_on(x, y, forwards)) {
    ++run_.count;
  } else {
    add_run();
    run_ = {x, y, 1, forwards};
  }
  const double off = is_row ? p.x - x : p.y - y;
  mean.centre += forwards ? off : -off;
  mean.cosine += std::abs(is_row ? p.normal_x : p.normal_y);
  ++mean.rows;
}

template <class T>
void ProfileSums<T>::add_run() {
  if (run_.count == 0) return;
  std::uint32_t* sum = sums_of(run_.forwards);
  const T* pixel = image_.row(run_.y - reach_) + run_.x;
  for (int k = 0; k <= 2 * reach_; ++k, pixel += image_.stride) sum[k] += sum_of(pixel, run_.count);
  run_.count = 0;
}

/// Sums of a profile under a Gaussian and its derivatives.
struct GaussianSums {
  double weight = 0, grey = 0;               ///< of the Gaussian, and with the grey values
  double slope_grey = 0;                     ///< of its first derivative
  double curvature = 0, curvature_grey = 0;  ///< of its second one

  void add(double distance, double per_sigma2, double gauss, float value) {
    const double q = (distance * distance * per_sigma2 - 1) * gauss, v = value;
    weight += gauss;
    grey += gauss * v;
    slope_grey += distance * gauss * v;
    curvature += q;
    curvature_grey += q * v;
  }
  GaussianSums operator+(const GaussianSums& o) const {
    return {weight + o.weight, grey + o.grey, slope_grey + o.slope_grey, curvature + o.curvature,
            curvature_grey + o.curvature_grey};
  }
};

/// Where a kernel of `sigma` px along the row sees the profile's centre, from `centre`; px.
double aside_at(std::span<const float> profile, double centre, double sigma) {
  const int reach = static_cast<int>(profile.size() / 2),
            middle = std::clamp(static_cast<int>(centre), -reach, reach);
  const double sigma2 = sigma * sigma, per_sigma2 = 1 / sigma2, first = middle - centre;
  // From pixel to pixel a Gaussian changes by a factor that itself changes by a constant one.
  const double turn = std::exp(-1 / sigma2), top = std::exp(-0.5 * first * first / sigma2);
  const auto value = [&](int k) { return profile[static_cast<std::size_t>(k + reach)]; };
  GaussianSums right, left;  // which do not wait for each other
  double right_gauss = top, right_factor = std::exp((-first - 0.5) / sigma2);
  double left_gauss = top, left_factor = turn / right_factor;
  const auto step = [&](double& gauss, double& factor) {
    gauss *= factor;
    factor *= turn;
  };
  right.add(first, per_sigma2, top, value(middle));
  for (int k = 1; k <= reach + std::abs(middle); ++k) {
    step(right_gauss, right_factor);
    step(left_gauss, left_factor);
    if (middle + k <= reach) right.add(first + k, per_sigma2, right_gauss, value(middle + k));
    if (middle - k >= -reach) left.add(first - k, per_sigma2, left_gauss, value(middle - k));
  }
  const GaussianSums sums = right + left;
  // The sampled second derivative of a constant must vanish.
  const double second = sums.curvature_grey - sums.curvature * sums.grey / std::max(sums.weight, 1e-9);
  return second < 0 ? -sums.slope_grey / second : 0.0;
}

/// The shift that one stretch [begin, end) points at, px across the line.
template <class T>
double shift_of(ImageView<T> image, std::span<const StripePoint> points, double sigma,
                AsymmetryWorkspace& w) {
  const int reach = static_cast<int>(std::ceil(3 * kBroad * sigma)) + 1;
  ProfileSums<T> sums(image, reach, w.sums);
  MeanProfile mean{0, 0, 0};
  for (const StripePoint& p : points)
    if ((p.flags & kStripeBridged) == 0) sums.add(p, mean);
  if (mean.rows < 4) return 0;
  sums.to_profile(w.profile);
  const double scale = sigma * mean.rows / mean.cosine, centre = mean.centre / mean.rows;
  const double own = aside_at(w.profile, centre, scale);
  const double narrow = aside_at(w.profile, centre, kNarrow * scale),
               broad = aside_at(w.profile, centre, kBroad * scale);
  return (broad - own) - (narrow - own);
}

double median_magnitude(std::vector<double>& values) {
  for (double& v : values) v = std::abs(v);
  return upper_median(values);
}

/// 1-sigma scatter of the shifts from stretch to stretch, px.
double scatter_of(const std::vector<double>& asides, std::vector<double>& scratch) {
  scratch.clear();
  for (std::size_t i = 1; i < asides.size(); ++i) scratch.push_back(asides[i] - asides[i - 1]);
  return scratch.size() < 3 ? 0 : median_magnitude(scratch) * (kMadToSigma / 1.4142135624);
}

/// What stands out of the scatter: of the median of five stretches, or of one together with a neighbour.
double clear_shift(const std::vector<double>& asides, std::size_t i, double scatter,
                   std::vector<double>& scratch) {
  const std::size_t first = i < 2 ? 0 : i - 2, last = std::min(asides.size(), i + 3);
  scratch.assign(asides.begin() + static_cast<std::ptrdiff_t>(first),
                 asides.begin() + static_cast<std::ptrdiff_t>(last));
  const double middle = upper_median(scratch);
  const double of_median = 2.5 * scatter / std::sqrt(static_cast<double>(last - first));
  const double before = i > 0 ? std::abs(asides[i - 1]) : 0.0;
  const double after = i + 1 < asides.size() ? std::abs(asides[i + 1]) : 0.0;
  const double pair = std::min(std::abs(asides[i]), std::max(before, after));
  return std::max({0.0, std::abs(middle) - of_median, pair - 4 * scatter});
}

template <class T>
void add_to_line(ImageView<T> image, double sigma, std::span<StripePoint> points, AsymmetryWorkspace& w) {
  const auto wanted = static_cast<std::size_t>(std::clamp(6 * sigma, 12.0, 40.0));
  const std::size_t stretches = std::max<std::size_t>(1, points.size() / wanted);
  const auto begin_of = [&](std::size_t k) { return k * points.size() / stretches; };
  w.asides.clear();
  for (std::size_t k = 0; k < stretches; ++k)
    w.asides.push_back(
        shift_of<T>(image, points.subspan(begin_of(k), begin_of(k + 1) - begin_of(k)), sigma, w));
  const double scatter = scatter_of(w.asides, w.scatter);
  for (std::size_t k = 0; k < stretches; ++k) {
    const double shift = std::min(sigma, kShiftByDisagreement * clear_shift(w.asides, k, scatter, w.scatter));
    if (shift == 0) continue;
    for (StripePoint& p : points.subspan(begin_of(k), begin_of(k + 1) - begin_of(k))) {
      if (shift > p.sigma_px && shift > 0.05) p.flags |= kStripeAsymmetric;
      p.sigma_px = std::hypot(p.sigma_px, shift);
    }
  }
}

}  // namespace

template <class T>
void add_asymmetry(ImageView<T> image, const DerivativeKernels& kernels, LineSet& lines,
                   AsymmetryWorkspace& w) {
  for (const LineRange& r : lines.lines)
    if (r.size() > 0)
      add_to_line(image, kernels.sigma, std::span(lines.points.data() + r.begin, r.size()), w);
}

template void add_asymmetry<std::uint8_t>(ImageView8, const DerivativeKernels&, LineSet&,
                                          AsymmetryWorkspace&);
template void add_asymmetry<std::uint16_t>(ImageView16, const DerivativeKernels&, LineSet&,
                                           AsymmetryWorkspace&);

}  // namespace lightstripe
