// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "calib/board/laser_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/error.h"

namespace lightstripe {
namespace {

constexpr int kLevels = 256;
constexpr int kClipped = 250;             // board pixels from here on say nothing about the light
constexpr std::uint32_t kMinPixels = 50;  // of a grey level, for its median to count

struct LevelMedian {
  double board, laser, weight;
};

std::vector<LevelMedian> level_medians(ImageView8 laser, ImageView8 board) {
  std::vector<std::uint32_t> joint(static_cast<std::size_t>(kLevels) * kLevels);
  for (int y = 0; y < board.height; ++y)
    for (int x = 0; x < board.width; ++x)
      ++joint[static_cast<std::size_t>(board(x, y)) * kLevels + laser(x, y)];
  std::vector<LevelMedian> medians;
  for (int level = 0; level < kClipped; ++level) {
    const std::uint32_t* row = joint.data() + static_cast<std::ptrdiff_t>(level) * kLevels;
    std::uint32_t total = 0;
    for (int i = 0; i < kLevels; ++i) total += row[i];
    if (total < kMinPixels) continue;
    int median = 0;
    for (std::uint32_t below = row[0]; 2 * below < total;) below += row[++median];
    medians.push_back(
        {static_cast<double>(level), static_cast<double>(median), std::sqrt(static_cast<double>(total))});
  }
  return medians;
}

/// Weighted least squares; gain 1 where the levels do not spread enough to tell.
AmbientChange fit_line(const std::vector<LevelMedian>& medians) {
  constexpr double kMinSpread = 5;  // grey levels
  double w = 0, mean_board = 0, mean_laser = 0;
  for (const auto& m : medians) {
    w += m.weight;
    mean_board += m.weight * m.board;
    mean_laser += m.weight * m.laser;
  }
  if (!(w > 0)) return {};
  mean_board /= w;
  mean_laser /= w;
  double variance = 0, covariance = 0;
  for (const auto& m : medians) {
    variance += m.weight * (m.board - mean_board) * (m.board - mean_board) / w;
    covariance += m.weight * (m.board - mean_board) * (m.laser - mean_laser) / w;
  }
  const double gain = variance > kMinSpread * kMinSpread ? std::max(0.0, covariance / variance) : 1.0;
  return {gain, mean_laser - gain * mean_board};
}

}  // namespace

AmbientChange fit_ambient_change(ImageView8 laser, ImageView8 board) {
  LIGHTSTRIPE_CHECK(laser.width == board.width && laser.height == board.height, "a pair has one size");
  auto medians = level_medians(laser, board);
  AmbientChange change = fit_line(medians);
  // A level that lies mostly under the stripe or a reflection does not follow the others: once more without
  // such.
  constexpr double kOutlier = 15;  // grey levels
  std::erase_if(medians, [&](const auto& m) {
    return std::abs(m.laser - change.gain * m.board - change.offset) > kOutlier;
  });
  if (medians.size() >= 2) change = fit_line(medians);
  return change;
}

Image8 laser_light(ImageView8 laser, ImageView8 board) {
  const AmbientChange change = fit_ambient_change(laser, board);
  std::array<int, kLevels> ambient{};
  for (int level = 0; level < kLevels; ++level)
    ambient[static_cast<std::size_t>(level)] =
        static_cast<int>(std::lround(change.gain * level + change.offset));
  Image8 light(laser.width, laser.height);
  for (int y = 0; y < laser.height; ++y)
    for (int x = 0; x < laser.width; ++x)
      light(x, y) =
          static_cast<std::uint8_t>(std::clamp(laser(x, y) - ambient[board(x, y)] + kDarkLevel, 0, 255));
  return light;
}

}  // namespace lightstripe
