// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/saddle_corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace lightstripe {
namespace {

using Eigen::Vector2d;

constexpr double kSmoothingPx = 1.5;
constexpr double kMinStrength = 0.004;  // of the strongest saddles: 6 % of their contrast
constexpr std::size_t kMaxCorners = 3000;
constexpr int kRing = 32;  // samples on the circle around a corner
constexpr double kRingRadiusPx = 5;
constexpr double kMinSymmetry = 0.6;  // correlation of the ring with itself turned by half a turn
constexpr double kMinSector = 20 * std::numbers::pi / 180;

struct Candidate {
  float strength;
  int x, y;
};

/// Local maxima of minus the Hessian's determinant.
std::vector<Candidate> find_candidates(const cv::Mat1f& smooth) {
  cv::Mat1f xx, yy, xy, strength, highest;
  cv::Sobel(smooth, xx, CV_32F, 2, 0);
  cv::Sobel(smooth, yy, CV_32F, 0, 2);
  cv::Sobel(smooth, xy, CV_32F, 1, 1);
  strength = xy.mul(xy) * 4 - xx.mul(yy);  // Sobel's mixed kernel answers half as strongly as the pure ones
  cv::dilate(strength, highest, cv::Mat1b::ones(7, 7));
  std::vector<Candidate> candidates;
  const int border = static_cast<int>(kRingRadiusPx) + 2;
  for (int y = border; y < smooth.rows - border; ++y)
    for (int x = border; x < smooth.cols - border; ++x)
      if (strength(y, x) > 0 && strength(y, x) >= highest(y, x)) candidates.push_back({strength(y, x), x, y});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.strength > b.strength; });
  return candidates;
}

float sample(const cv::Mat1f& image, double x, double y) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float u = static_cast<float>(x - x0), v = static_cast<float>(y - y0);
  return (1 - v) * ((1 - u) * image(y0, x0) + u * image(y0, x0 + 1)) +
         v * ((1 - u) * image(y0 + 1, x0) + u * image(y0 + 1, x0 + 1));
}

/// Grey levels around the point, less their mean; nothing if they are not the same on opposite sides.
std::optional<std::array<float, kRing>> symmetric_ring(const cv::Mat1f& smooth, const Candidate& at) {
  std::array<float, kRing> ring;
  float mean = 0;
  for (int i = 0; i < kRing; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRing;
    ring[static_cast<std::size_t>(i)] =
        sample(smooth, at.x + kRingRadiusPx * std::cos(angle), at.y + kRingRadiusPx * std::sin(angle));
    mean += ring[static_cast<std::size_t>(i)] / kRing;
  }
  for (auto& value : ring) value -= mean;
  float square = 0, product = 0;
  for (std::size_t i = 0; i < kRing; ++i) {
    square += ring[i] * ring[i];
    product += ring[i] * ring[(i + kRing / 2) % kRing];
  }
  return product > kMinSymmetry * square ? std::optional(ring) : std::nullopt;
}

/// Angles where the ring changes sign, with the direction of the change.
struct Crossing {
  double angle;
  bool to_dark;
};

std::vector<Crossing> crossings_of(const std::array<float, kRing>& ring) {
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < kRing; ++i) {
    const float a = ring[i], b = ring[(i + 1) % kRing];
    if ((a < 0) == (b < 0)) continue;
    crossings.push_back({2 * std::numbers::pi * (static_cast<double>(i) + a / (a - b)) / kRing, b < 0});
  }
  return crossings;
}

/// Mean direction of two crossings that lie opposite each other.
Vector2d edge_direction(double angle, double opposite) {
  return (Vector2d(std::cos(angle), std::sin(angle)) - Vector2d(std::cos(opposite), std::sin(opposite)))
      .normalized();
}

std::optional<SaddleCorner> corner_at(const cv::Mat1f& smooth, const Candidate& at) {
  const auto ring = symmetric_ring(smooth, at);
  if (!ring) return std::nullopt;
  const auto crossings = crossings_of(*ring);
  if (crossings.size() != 4) return std::nullopt;
  const std::size_t dark = crossings[0].to_dark ? 0 : 1;
  SaddleCorner corner;
  corner.position = {at.x, at.y};
  corner.edges[0] = edge_direction(crossings[dark].angle, crossings[(dark + 2) % 4].angle);
  corner.edges[1] = edge_direction(crossings[dark + 1].angle, crossings[(dark + 3) % 4].angle);
  const double sine =
      std::abs(corner.edges[0].x() * corner.edges[1].y() - corner.edges[0].y() * corner.edges[1].x());
  return sine > std::sin(kMinSector) ? std::optional(corner) : std::nullopt;
}

}  // namespace

std::vector<SaddleCorner> find_saddle_corners(const cv::Mat& gray) {
  cv::Mat1f smooth;
  gray.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, kSmoothingPx);
  const auto candidates = find_candidates(smooth);
  std::vector<SaddleCorner> corners;
  if (candidates.empty()) return corners;
  // One reflection must not set the scale: the strength of the 20th.
  const float limit = static_cast<float>(kMinStrength) *
                      candidates[std::min<std::size_t>(20, candidates.size() - 1)].strength;
  for (const auto& candidate : candidates) {
    if (candidate.strength < limit || corners.size() == kMaxCorners) break;
    if (const auto corner = corner_at(smooth, candidate)) corners.push_back(*corner);
  }
  return corners;
}

}  // namespace lightstripe
