// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/image/impression.h"

#include <algorithm>
#include <cstdint>

namespace lightstripe {
namespace {

/// Of the pixels: so many clipped ones are no stripe.
constexpr double kMostClipped = 0.2;
/// Of full scale: a picture that nowhere is brighter than this is dark.
constexpr double kDarkest = 0.12;
/// Standard deviations of the noise from the ground to the brightest pixel of a picture in which nothing
/// stands out; a Gaussian reaches 5 in some million pixels.
constexpr double kNothing = 6;
/// Lines that were followed in vain: so many are made by noise or texture.
constexpr std::size_t kCrowd = 20;
/// px: edges shorter than this together are not what the picture shows.
constexpr double kLeastEdges = 50;

double clipped_share(const Histogram& histogram, double full_scale) {
  if (histogram.total == 0 || histogram.largest < full_scale - histogram.bin_width) return 0;
  const auto bin = std::clamp(static_cast<std::size_t>(histogram.largest / histogram.bin_width),
                              std::size_t{0}, histogram.counts.size() - 1);
  return static_cast<double>(histogram.counts.at(bin)) / static_cast<double>(histogram.total);
}

/// The grey level that three quarters of the pixels reach: a line covers less of a picture than its ground.
double ground_level(const Histogram& histogram) {
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    below += histogram.counts.at(bin);
    if (4 * below >= histogram.total) return histogram.bin_width * static_cast<double>(bin);
  }
  return 0;
}

}  // namespace

Impression impression_of(const Histogram& histogram, const ImpressionFacts& facts) {
  if (clipped_share(histogram, facts.full_scale) > kMostClipped) return Impression::kOverexposed;
  if (histogram.largest < kDarkest * facts.full_scale) return Impression::kDark;
  if (histogram.largest - ground_level(histogram) < kNothing * std::max(facts.noise, 1.0))
    return Impression::kEven;
  if (facts.edge_length > kLeastEdges) return Impression::kEdges;
  return facts.tried >= kCrowd ? Impression::kNoise : Impression::kTooFaint;
}

std::string_view what_it_looks_like(Impression impression) {
  switch (impression) {
    case Impression::kNone:
      return "";
    case Impression::kOverexposed:
      return "a large part of the picture is clipped";
    case Impression::kDark:
      return "the picture is dark, nothing in it is bright";
    case Impression::kEven:
      return "it is evenly grey, nothing stands out of its noise (is the laser off?)";
    case Impression::kNoise:
      return "it looks like noise or texture: many short crumbs, none of them a line (is the laser off?)";
    case Impression::kEdges:
      return "it shows edges of lit things, bright on one side only, but no line of light (is the laser "
             "off?)";
    case Impression::kTooFaint:
      return "what stands out in it is too short, too faint or too uneven for a line";
  }
  return "";
}

std::string_view what_to_do_about(Impression impression) {
  switch (impression) {
    case Impression::kOverexposed:
      return "lower the exposure, or choose another --channel";
    case Impression::kDark:
      return "raise the exposure or the laser's power";
    case Impression::kEven:
      return "look at the laser and at --channel";
    case Impression::kNoise:
      return "give --stripe-width, --roi or --background, or look at --channel";
    case Impression::kEdges:
      return "take a picture with the laser off as --background, or look at --channel";
    case Impression::kNone:
    case Impression::kTooFaint:
      return "look at exposure and --channel, or give --stripe-width and --thresholds";
  }
  return "";
}

}  // namespace lightstripe
