// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/reconstruct_refusals.h"

#include <fmt/format.h>

#include "core/counted.h"
#include "core/error.h"
#include "pipeline/outside_range.h"

namespace lightstripe {
namespace {

/// Why there is nothing, and what helps.
std::string why_empty(const ReconstructResult& result) {
  const ScanSummary& summary = result.summary;
  if (summary.frames == 0)
    return "none of the frames has a position (nothing is written); number the travel table's frames as the "
           "pictures, or from 0 in their order";
  if (summary.rays_missed > 0) return why_all_missed(summary, result.outside_range);
  std::string text = summary.frames == 1
                         ? "no stripe was found in the only frame"
                         : fmt::format("no stripe was found in any of the {} frames", summary.frames);
  text += " (nothing is written); ";
  constexpr int kDark = 60;
  if (result.brightest < kDark)
    text +=
        fmt::format("the pictures are dark, grey level {} at most: expose longer, or switch the laser on; ",
                    result.brightest);
  return text + "look at a frame with `lightstripe extract --overlay`";
}

}  // namespace

void refuse_unusable_pictures(const ReconstructJob& job, const ReconstructResult& result) {
  if (result.summary.pictures == 0 && !result.summary.stopped && !result.skipped.empty())
    throw Error(job.scan_file.string(),
                fmt::format("none of its pictures can be used, the first because: {}",
                            result.skipped.front().picture.reason),
                "look at the pictures");
  if (job.strict && !result.duplicate_pictures.empty())
    throw Error(result.duplicate_pictures.front(), "another picture has the same number", "keep one of them");
}

std::string why_not_usable(const ReconstructResult& result) {
  if (result.summary.stopped)
    return fmt::format("interrupted before frame {}; what is done is kept in {}; --resume goes on from there",
                       result.end_frame, result.partial_cloud.string());
  return result.summary.points == 0 ? why_empty(result) : "";
}

}  // namespace lightstripe
