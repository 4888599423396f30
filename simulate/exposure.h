// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// From light to a picture: reflections on the lens' way, shot noise, read noise, 8 bits.
#pragma once

#include <vector>

#include "core/image.h"
#include "core/random.h"
#include "simulate/scene.h"

namespace lightstripe {

/// A bright ellipse with a soft rim.
struct Blob {
  double x = 0, y = 0;   ///< px, middle
  double radius_px = 0;  ///< larger half axis
  double flatness = 1;   ///< smaller half axis / larger
  double angle = 0;      ///< of the larger axis against x, radians

  /// 1 in the middle, 0.5 on the rim, falling over `edge_px` (logistic).
  double cover(double px, double py, double edge_px) const;
};

/// As many as the plan wants, at places drawn from `random`.
std::vector<Blob> draw_blobs(const Reflections& plan, int width, int height, Random random);

void add_blobs(Image<float>& light, const std::vector<Blob>& blobs, const Reflections& plan);

/// One colour channel's light of a picture: all of the lamp's, the channel's share of the laser's. `channel`:
/// 0 red, 1 green, 2 blue; `total` and `laser` have the same size.
Image<float> channel_light(const Image<float>& total, const Image<float>& laser, const ColourCamera& camera,
                           int channel);

/// Noise of variance read_noise^2 + (level - dark) / electrons_per_level, rounding, clipping to 0 .. 255.
/// Each row draws from its own stream.
Image8 expose(const Image<float>& light, const Imaging& imaging, std::uint64_t seed, std::uint64_t stream);

/// The three channels' exposures, interleaved: rgb, width * height * 3 values.
std::vector<std::uint8_t> expose_rgb(const Image<float>& total, const Image<float>& laser,
                                     const Imaging& imaging, std::uint64_t seed, std::uint64_t stream);

/// One channel a pixel: red and green in even rows, green and blue in odd ones (RGGB).
Image8 expose_bayer(const Image<float>& total, const Image<float>& laser, const Imaging& imaging,
                    std::uint64_t seed, std::uint64_t stream);

}  // namespace lightstripe
