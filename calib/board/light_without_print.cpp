// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/light_without_print.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/random.h"
#include "core/robust.h"
#include "extraction/image/background.h"

namespace lightstripe {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;

constexpr double kMinSquarePx = 6;
constexpr float kOutside = std::numeric_limits<float>::quiet_NaN();

/// Where each pixel lies on the board, in squares from the first corner; NaN beside the board and its rim.
struct PixelPlaces {
  int width = 0, height = 0;
  std::vector<Vector2f> places;

  const Vector2f& operator()(int x, int y) const {
    return places[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  bool is_on_board(int x, int y) const { return !std::isnan((*this)(x, y).x()); }
  /// How fast either coordinate changes (squares / px).
  Vector2f slopes(int x, int y) const {
    const auto step = [&](int dx, int dy) -> Vector2f {
      const bool forward = x + dx < width && y + dy < height && is_on_board(x + dx, y + dy);
      if (forward) return (*this)(x + dx, y + dy) - (*this)(x, y);
      const bool back = x >= dx && y >= dy && is_on_board(x - dx, y - dy);
      return back ? Vector2f((*this)(x, y) - (*this)(x - dx, y - dy)) : Vector2f::Zero();
    };
    const Vector2f along_x = step(1, 0), along_y = step(0, 1);
    return {std::hypot(along_x.x(), along_y.x()), std::hypot(along_x.y(), along_y.y())};
  }
};

/// The squares, and one ring of the rim around them.
struct SquareGrid {
  int columns, rows;           ///< of squares with the ring
  Vector2d low, high;          ///< limits of pattern and rim, squares
  std::vector<double> levels;  ///< median grey level; NaN where it is not known
  /// Column of a place's x, row of its y.
  static int cell(double place) { return static_cast<int>(std::floor(place)) + 2; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(std::clamp(row, 0, rows - 1)) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(std::clamp(column, 0, columns - 1));
  }
};

SquareGrid grid_of(const Target& target) {
  const Vector2d pitch(target.pitch_x, target.pitch_y);
  // A wider rim than one square is left out: far from the corners the map no longer holds.
  const Vector2d rim = (target.rim() / pitch.array()).min(1.0).matrix();
  return {target.columns + 3,
          target.rows + 3,
          Vector2d(-1, -1) - rim,
          Vector2d(target.columns, target.rows) + rim,
          {}};
}

PixelPlaces places_of(ImageView8 image, const BoardMap& map, const Target& target, const SquareGrid& grid) {
  constexpr double kSlack = 0.5;  // squares; what a lens may add to the homography
  PixelPlaces result{image.width, image.height, {}};
  result.places.assign(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
                       Vector2f::Constant(kOutside));
  const Vector2d pitch(target.pitch_x, target.pitch_y);
  const auto within = [&](const Vector2d& p, double slack) {
    return ((p - grid.low).array() > -slack).all() && ((grid.high - p).array() > -slack).all();
  };
  const double side = (map.board_from_pixel * map.centre.homogeneous()).z();
  std::size_t i = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x, ++i) {
      // The polynomial of the map holds near the corners only: the homography says whether that is here.
      const Eigen::Vector3d plain = map.board_from_pixel * Eigen::Vector3d(x, y, 1);
      if (!(plain.z() * side > 0)) continue;
      if (!within(plain.hnormalized().cwiseQuotient(pitch), kSlack)) continue;
      const Vector2d place = map({1.0 * x, 1.0 * y}).cwiseQuotient(pitch);
      if (within(place, 0)) result.places[i] = place.cast<float>();
    }
  }
  return result;
}

void measure_levels(ImageView8 image, const PixelPlaces& places, SquareGrid& grid) {
  constexpr float kClear = 0.12F;  // squares; from an edge
  constexpr std::size_t kMinPixels = 8;
  std::vector<std::vector<std::uint8_t>> pixels(grid.index(grid.columns, grid.rows) + 1);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!places.is_on_board(x, y)) continue;
      const Vector2f& p = places(x, y);
      const Vector2f in_square = p - p.array().floor().matrix();
      if (in_square.minCoeff() < kClear || in_square.maxCoeff() > 1 - kClear) continue;
      pixels[grid.index(SquareGrid::cell(p.x()), SquareGrid::cell(p.y()))].push_back(image(x, y));
    }
  }
  grid.levels.clear();
  for (auto& square : pixels)
    grid.levels.push_back(square.size() < kMinPixels ? std::numeric_limits<double>::quiet_NaN()
                                                     : upper_median(square));
}

/// Share of the square beyond the edge, where the place lies `distance` sigmas of the blur beyond it.
double share_beyond(double distance) {
  constexpr double kAllOrNothing = 4;
  if (std::abs(distance) > kAllOrNothing) return distance > 0 ? 1 : 0;
  return 0.5 * std::erfc(-distance / std::sqrt(2.0));
}

/// Grey level of the print under a blur (Gaussian, sigma in px); NaN where a square's level is not known.
double predicted_level(const PixelPlaces& places, const SquareGrid& grid, int x, int y, double blur_px) {
  const Vector2f& p = places(x, y);
  const Vector2f slopes = places.slopes(x, y);
  const auto beyond = [&](float place, float slope) {
    return share_beyond((place - std::round(place)) / std::max(1e-6, slope * blur_px));
  };
  const double u = beyond(p.x(), slopes.x()), v = beyond(p.y(), slopes.y());
  const int column = SquareGrid::cell(std::round(p.x())), row = SquareGrid::cell(std::round(p.y()));
  double sum = 0;
  const auto add = [&](int c, int r, double weight) {
    if (weight > 0) sum += weight * grid.levels[grid.index(c, r)];
  };
  add(column - 1, row - 1, (1 - u) * (1 - v));
  add(column, row - 1, u * (1 - v));
  add(column - 1, row, (1 - u) * v);
  add(column, row, u * v);
  return sum;
}

/// The blur that leaves the least beside the edges; absolute values, so that the stripe does not decide.
double fit_blur(ImageView8 image, const PixelPlaces& places, const SquareGrid& grid) {
  constexpr double kLeastPx = 0.4, kLargestPx = 4, kFactor = 1.2, kNearPx = 5;
  constexpr int kStride = 3;
  double best = kLeastPx, least = std::numeric_limits<double>::infinity();
  for (double blur = kLeastPx; blur < kLargestPx; blur *= kFactor) {
    double sum = 0;
    for (int y = 0; y < image.height; y += kStride) {
      for (int x = 0; x < image.width; x += kStride) {
        if (!places.is_on_board(x, y)) continue;
        const Vector2f& p = places(x, y);
        const Vector2f to_edge = (p - p.array().round().matrix()).cwiseAbs();
        if ((to_edge.array() > kNearPx * places.slopes(x, y).array()).all()) continue;
        const double rest = std::abs(image(x, y) - predicted_level(places, grid, x, y, blur));
        if (rest >= 0) sum += rest;
      }
    }
    if (sum < least) {
      least = sum;
      best = blur;
    }
  }
  return best;
}

/// What the prediction leaves; NaN beside the board.
std::vector<float> rest_of(ImageView8 image, const PixelPlaces& places, const SquareGrid& grid) {
  const double blur_px = fit_blur(image, places, grid);
  std::vector<float> rest;
  rest.reserve(places.places.size());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      rest.push_back(places.is_on_board(x, y)
                         ? static_cast<float>(image(x, y) - predicted_level(places, grid, x, y, blur_px))
                         : kOutside);
  return rest;
}

std::vector<float> noise_like(const std::vector<float>& rest) {
  std::vector<float> sizes;
  for (const float r : rest)
    if (!std::isnan(r)) sizes.push_back(std::abs(r));
  std::vector<float> noise(4096, 0.0F);
  if (sizes.empty()) return noise;
  const double sigma = kMadToSigma * upper_median(sizes);
  Random random(noise.size());
  for (float& value : noise) value = static_cast<float>(sigma * random.gaussian());
  return noise;
}

double square_px(const BoardMap& map, const Target& target) {
  const double mm_per_px = std::sqrt(std::abs(map.derivative(map.centre).determinant()));
  return std::min(target.pitch_x, target.pitch_y) / mm_per_px;
}

}  // namespace

std::optional<Image8> light_without_print(ImageView8 image, const BoardMap& map, const Target& target) {
  if (target.type != TargetType::kCheckerboard || square_px(map, target) < kMinSquarePx) return std::nullopt;
  SquareGrid grid = grid_of(target);
  const PixelPlaces places = places_of(image, map, target, grid);
  measure_levels(image, places, grid);
  const std::vector<float> rest = rest_of(image, places, grid), noise = noise_like(rest);
  Image8 light(image.width, image.height);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const float value = std::isnan(rest[i]) ? noise[scatter_bits(i) % noise.size()] : rest[i];
    light.pixels[i] = static_cast<std::uint8_t>(std::clamp(kDarkLevel + value, 0.0F, 255.0F) + 0.5F);
  }
  return light;
}

}  // namespace lightstripe
