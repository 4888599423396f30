// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Extraction in a sequence: an earlier frame tells where to look.
#pragma once

#include <cstdint>

#include "extraction/extract_stripes.h"
#include "extraction/track/track_reference.h"
#include "extraction/workspace.h"

namespace lightstripe {

/// Frames of a sequence that have one reference: frame k is searched by what frame k - k % kTrackedFrames has
/// left, so that the result depends on these two pictures only, and on no thread.
inline constexpr int kTrackedFrames = 32;
constexpr std::int64_t key_frame_of(std::int64_t frame) {
  return frame - ((frame % kTrackedFrames) + kTrackedFrames) % kTrackedFrames;
}

/// As extract_stripes() where lines are looked for near those of `before` only, and near whatever a coarse
/// look over the whole frame sees (every fourth row): what lies in these windows is found as in the full
/// search. True where that was enough. Otherwise the full search was done: a line of `before` was lost, too
/// much of the frame stood out, there is no reference of this size, or the options do not allow windows (a
/// given stripe_width or sigma, with which the full search costs no more; other methods, roi, start,
/// stop_after; pictures so noisy that lines begin in blocks of pixels).
bool track_stripes(ImageView8 image, const ExtractionOptions& options, const TrackReference& before,
                   ExtractionWorkspace& workspace, ExtractionResult& result);
bool track_stripes(ImageView16 image, const ExtractionOptions& options, const TrackReference& before,
                   ExtractionWorkspace& workspace, ExtractionResult& result);

/// What the last extract_stripes() or track_stripes() with this workspace, which gave `result` in `image`,
/// leaves for later frames.
TrackReference reference_of(const ExtractionWorkspace& workspace, const ExtractionResult& result,
                            ImageView8 image);
TrackReference reference_of(const ExtractionWorkspace& workspace, const ExtractionResult& result,
                            ImageView16 image);

}  // namespace lightstripe
