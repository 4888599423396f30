// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A scan whose pictures are numbers, for the tests of the scanner: what comes out tells what went in.
#pragma once

#include <chrono>
#include <thread>
#include <vector>

#include "core/random.h"
#include "reconstruct/scanner.h"

namespace lightstripe::testing {

inline constexpr int kFrames = 120;

inline Rig two_sensor_rig() {
  Rig rig;
  const Camera camera{32, 24, 1000, 1000, 16, 12, {-0.1}};
  rig.sensors.push_back({"gauge", camera, {canonical({{0.8, 0.1, 0.6}, 300})}, {}});
  rig.sensors.push_back(
      {"field", camera, {canonical({{0.7, -0.2, 0.6}, 310})}, {Eigen::Quaterniond(0, 0, 1, 0), {0, 90, 0}}});
  rig.motion.type = MotionType::kLinear;
  return rig;
}

/// A picture that names its frame and sensor.
inline Image8 numbered_image(std::int64_t frame, int sensor) {
  Image8 image(32, 24, 0);
  image(0, 0) = static_cast<std::uint8_t>(frame);
  image(1, 0) = static_cast<std::uint8_t>(sensor);
  return image;
}

/// In place of the extraction: points that depend on the picture only, after a time that depends on it too,
/// so that frames overtake each other.
inline std::vector<Stripe> stripes_of_numbered_image(const GreyImage& picture) {
  const auto& image = std::get<Image8>(picture);
  Random random(image(0, 0), image(1, 0));
  std::this_thread::sleep_for(std::chrono::microseconds(random.bits() % 300));
  Stripe stripe;
  for (int i = 0; i < 5; ++i)
    stripe.points.push_back({.x = random.uniform(0, 32),
                             .y = random.uniform(0, 24),
                             .normal_x = 1,
                             .sigma_px = 0.1,
                             .intensity = static_cast<float>(image(0, 0))});
  return {stripe};
}

inline ScanInput numbered_input() {
  ScanInput input;
  input.end_frame = kFrames;
  input.read = [](std::int64_t frame, int sensor) { return numbered_image(frame, sensor); };
  input.position = [](std::int64_t frame) { return FramePosition{2.0 * static_cast<double>(frame), {}}; };
  return input;
}

inline std::vector<Profile> scan(const ScanInput& input, int threads, ScanSummary* summary = nullptr) {
  std::vector<Profile> profiles;
  const auto result =
      scan_profiles(input, two_sensor_rig(), StripeExtractor(stripes_of_numbered_image), threads,
                    [&](const ScannedFrame& frame) { profiles.push_back(frame.profile); });
  if (summary) *summary = result;
  return profiles;
}

}  // namespace lightstripe::testing
