// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What the image as a whole says, before any line is looked for.
#pragma once

#include "core/image.h"
#include "extraction/follow/ridge_limits.h"
#include "extraction/image/noise.h"
#include "extraction/image/thresholds.h"
#include "extraction/kernels/kernels.h"
#include "extraction/options.h"
#include "extraction/parsed_options.h"
#include "extraction/result.h"

namespace lightstripe {

struct ImageFacts {
  Histogram histogram;
  NoiseEstimate noise;
};

/// Statistics of some 10 000 pixels, whatever the image's size; the brightest pixel is looked for in all.
template <class T>
ImageFacts look_at(ImageView<T> image);

/// How thin the statistics of an image of this size are.
int facts_thinning(int width, int height);
/// The noise as look_at() measures it.
template <class T>
NoiseEstimate noise_of(ImageView<T> image);

/// Sets threshold_low/high by the chosen rule and records the intermediate levels.
void choose_levels(const ImageFacts& facts, const ExtractionOptions& options, const ParsedOptions& parsed,
                   ExtractionResult& result);

/// Less than this over the surroundings is noise, in means of block x block pixels; grey levels.
double seed_contrast(const NoiseEstimate& noise, int block);
/// Size of the blocks in which first points are looked for: 1 unless single pixels are too noisy, px.
int seed_block(const ImageFacts& facts);

/// What a ridge must have in this image; the levels are those of `result`.
RidgeLimits ridge_limits(const DerivativeKernels& kernels, const ImageFacts& facts,
                         const ParsedOptions& parsed, const ExtractionResult& result);

}  // namespace lightstripe
