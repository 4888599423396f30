// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/scan_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxShown = 5;

void warn_of_skipped(const ReconstructResult& result, const fs::path& cloud, Messages& out) {
  const ScanSummary& summary = result.summary;
  if (summary.pictures_skipped > 0)
    out.warn(fmt::format("{} of {} pictures are skipped", summary.pictures_skipped,
                         summary.pictures + summary.pictures_skipped));
  for (std::size_t i = 0; i < std::min(kMaxShown, result.skipped.size()); ++i)
    out.warn(fmt::format("frame {} skipped: {}", result.skipped[i].frame, result.skipped[i].picture.reason));
  if (result.skipped.size() > kMaxShown)
    out.warn(fmt::format("... and more, all named in {}.run.yaml", cloud.string()));
  if (!result.duplicate_pictures.empty())
    out.warn(fmt::format("{} pictures have a number that another one has and are left out, the first: {}",
                         result.duplicate_pictures.size(), result.duplicate_pictures.front()));
}

void warn_of_gaps(const ReconstructResult& result, Messages& out) {
  const ScanSummary& summary = result.summary;
  for (const std::string& warning : result.warnings) out.warn(warning);
  if (!result.without_picture.empty())
    out.warn(
        fmt::format("the table knows {} frames without a picture, before or behind all pictures: {}; is the "
                    "recording still being written?",
                    result.without_picture.count, result.without_picture.text()));
  if (!result.origin.isZero())
    out.warn(
        fmt::format("the cloud's coordinates count from the origin {} {} {} mm, so that 32-bit numbers carry "
                    "them; the file's header and its .run.yaml name it",
                    result.origin.x(), result.origin.y(), result.origin.z()));
  if (!summary.without_position.empty())
    out.warn(fmt::format("{} frames have no position and are left out: {}", summary.without_position.count,
                         summary.without_position.text()));
  if (!summary.interpolated.empty())
    out.warn(
        fmt::format("{} frames have no travel of their own, it is interpolated between their neighbours': {}",
                    summary.interpolated.count, summary.interpolated.text()));
  if (summary.frames_without_points > 0)
    out.warn(fmt::format("{} frames show no stripe", summary.frames_without_points));
  for (const std::string& sentence : result.outside_range) out.warn(sentence);
  if (summary.rays_missed > 0)
    out.warn(fmt::format("{} stripe points have no certain laser plane, or do not meet it, and are left out",
                         summary.rays_missed));
}

}  // namespace

Messages describe_scan(const ReconstructResult& result, const fs::path& cloud) {
  Messages out;
  warn_of_skipped(result, cloud, out);
  warn_of_gaps(result, out);
  if (!result.usable()) return out;
  out.say(fmt::format("{} frames, {} points in {:.2f} s ({:.1f} frames/s) -> {}", result.summary.frames,
                      result.summary.points, result.seconds,
                      static_cast<double>(result.frames_now) / result.seconds, cloud.string()));
  for (const SensorLines& lines : result.lines)
    if (lines.points > 0) out.say(describe_lines(lines));
  return out;
}

}  // namespace lightstripe
