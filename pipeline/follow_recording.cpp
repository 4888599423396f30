// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/follow_recording.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

#include "core/error.h"
#include "pipeline/record_frames.h"

namespace lightstripe {
namespace {

/// The first frame that has to wait: not all sensors or the travel have it yet, or it is the newest, which
/// may still be written.
std::int64_t ready_end(const ScanRun& run, bool newest_too) {
  std::int64_t end = run.end_frame;
  for (int sensor = 0; sensor < static_cast<int>(run.job.rig.sensors.size()); ++sensor) {
    std::int64_t last = run.end_frame - 1;
    while (last >= run.first_frame && run.recording.picture_name(last, sensor).empty()) --last;
    const bool has_pictures = last >= run.first_frame;
    if (has_pictures) end = std::min(end, newest_too ? last + 1 : last);
  }
  while (end > run.first_frame && !run.recording.position(end - 1)) --end;
  return end;
}

/// The recording as it is now; nothing where it cannot be read yet, and why.
std::optional<ScanRun> run_so_far(const ReconstructJob& job, std::string& why_not) {
  try {
    return open_run(job);
  } catch (const Error& error) {
    why_not = error.what();
    return std::nullopt;
  }
}

}  // namespace

ScanRun scan_what_comes(const ReconstructJob& job, const ScanFrames& scan, const std::stop_token& stop,
                        std::optional<ScanOutput>& output) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kPause = std::chrono::milliseconds(100);
  std::int64_t seen_end = 0;
  auto last_news = Clock::now();
  for (std::string why_not;;) {
    const auto begin = Clock::now();
    const bool stopped = stop.stop_requested(),
               recorded = recording_is_over(job.scan);  // before the look: nothing comes after it
    const bool idle = job.idle_s > 0 && begin - last_news > std::chrono::duration<double>(job.idle_s);
    const bool last_look = stopped || recorded || idle;
    auto run = run_so_far(job, why_not);
    if (last_look && !run)
      throw Error(job.scan_file.string(), "nothing that can be used was recorded (" + why_not + ")",
                  "look at the recording");
    const bool news = run && run->end_frame != seen_end;
    if (news) {
      seen_end = run->end_frame;
      last_news = Clock::now();
    }
    if (run) {
      if (!output) output.emplace(output_options(*run));
      if (!last_look) run->end_frame = ready_end(*run, !news);
      if (run->end_frame > output->tally().next_frame || last_look) scan(*run, *output);
      if (last_look) return std::move(*run);
    }
    // Listing a long folder takes its time: most of the machine stays free for the pictures.
    std::this_thread::sleep_for(std::max<Clock::duration>(kPause, 2 * (Clock::now() - begin)));
  }
}

}  // namespace lightstripe
