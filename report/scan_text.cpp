// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/scan_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/counted.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxShown = 5;

void warn_of_skipped(const ReconstructResult& result, const fs::path& cloud, Messages& out) {
  const ScanSummary& summary = result.summary;
  if (summary.pictures_skipped > 0)
    out.warn(fmt::format("{} of {} {} skipped", summary.pictures_skipped,
                         counted(summary.pictures + summary.pictures_skipped, "picture"),
                         noun_of(summary.pictures_skipped, "is", "are")));
  for (std::size_t i = 0; i < std::min(kMaxShown, result.skipped.size()); ++i)
    out.warn(fmt::format("frame {} skipped: {}", result.skipped[i].frame, result.skipped[i].picture.reason));
  if (result.skipped.size() > kMaxShown)
    out.warn(fmt::format("... and more, all named in {}.run.yaml", cloud.string()));
  if (!result.duplicate_pictures.empty())
    out.warn(fmt::format("{} a number that another one has and {} left out, the first: {}",
                         counted(result.duplicate_pictures.size(), "picture has", "pictures have"),
                         noun_of(result.duplicate_pictures.size(), "is", "are"),
                         result.duplicate_pictures.front()));
}

void warn_of_gaps(const ReconstructResult& result, Messages& out) {
  const ScanSummary& summary = result.summary;
  for (const std::string& warning : result.warnings) out.warn(warning);
  if (!result.without_picture.empty())
    out.warn(
        fmt::format("the table knows {} without a picture, before or behind all pictures: {}; is the "
                    "recording still being written?",
                    counted(result.without_picture.count, "frame"), result.without_picture.text()));
  if (!result.origin.isZero())
    out.warn(
        fmt::format("the cloud's coordinates count from the origin {} {} {} mm, so that 32-bit numbers carry "
                    "them; the file's header and its .run.yaml name it",
                    result.origin.x(), result.origin.y(), result.origin.z()));
  if (!summary.without_position.empty())
    out.warn(fmt::format("{} left out: {}",
                         counted(summary.without_position.count, "frame has no position and is",
                                 "frames have no position and are"),
                         summary.without_position.text()));
  if (!summary.interpolated.empty())
    out.warn(fmt::format(
        "{} neighbours': {}",
        counted(summary.interpolated.count, "frame has no travel of its own, it is interpolated between its",
                "frames have no travel of their own, it is interpolated between their"),
        summary.interpolated.text()));
  if (summary.frames_without_points > 0)
    out.warn(
        fmt::format("{} no stripe", counted(summary.frames_without_points, "frame shows", "frames show")));
  for (const std::string& sentence : result.outside_range) out.warn(sentence);
  if (summary.rays_missed > 0)
    out.warn(fmt::format(
        "{} left out",
        counted(summary.rays_missed, "stripe point has no certain laser plane, or does not meet it, and is",
                "stripe points have no certain laser plane, or do not meet it, and are")));
}

}  // namespace

Messages describe_scan(const ReconstructResult& result, const fs::path& cloud) {
  Messages out;
  warn_of_skipped(result, cloud, out);
  warn_of_gaps(result, out);
  if (!result.usable()) return out;
  out.say(fmt::format("{}, {} in {:.2f} s ({:.1f} frames/s) -> {}", counted(result.summary.frames, "frame"),
                      counted(result.summary.points, "point"), result.seconds,
                      static_cast<double>(result.frames_now) / result.seconds, cloud.string()));
  for (const SensorLines& lines : result.lines)
    if (lines.points > 0) out.say(describe_lines(lines));
  return out;
}

}  // namespace lightstripe
