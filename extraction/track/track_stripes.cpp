// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/track/track_stripes.h"

#include <algorithm>

namespace lightstripe {
namespace {

constexpr std::size_t kSpacing = 8;  // points of a line from one place to the next

double largest_sigma(const ExtractionWorkspace& workspace) {
  double sigma = 0;
  for (std::size_t g = 0; g < workspace.groups.count; ++g) {
    const ScaleGroup& group = workspace.groups.all[g];
    if (!group.lines.lines.empty()) sigma = std::max(sigma, group.kernels->sigma);
  }
  return sigma;
}

TrackReference make_reference(const ExtractionWorkspace& workspace, const ExtractionResult& result, int width,
                              int height, const LevelNoise& noise) {
  TrackReference reference{width, height, {}, {}, noise, largest_sigma(workspace)};
  for (const Stripe& stripe : result.stripes) {
    const std::size_t count = stripe.points.size();
    for (std::size_t i = 0; i < count; i = i + 1 < count ? std::min(i + kSpacing, count - 1) : count)
      reference.places.push_back(
          {static_cast<float>(stripe.points[i].x), static_cast<float>(stripe.points[i].y)});
    reference.line_ends.push_back(reference.places.size());
  }
  return reference;
}

}  // namespace

TrackReference reference_of(const ExtractionWorkspace& workspace, const ExtractionResult& result,
                            ImageView8 image) {
  return make_reference(workspace, result, image.width, image.height, workspace.own_scale8.pyramid.noise);
}

TrackReference reference_of(const ExtractionWorkspace& workspace, const ExtractionResult& result,
                            ImageView16 image) {
  return make_reference(workspace, result, image.width, image.height, workspace.own_scale16.pyramid.noise);
}

}  // namespace lightstripe
