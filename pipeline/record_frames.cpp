// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/record_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/number_text.h"
#include "io/raw_frames.h"
#include "io/tables.h"
#include "io/yaml_binding.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;
constexpr int kMaxNamed = 8;

std::int64_t nanoseconds_of(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

/// A table that grows line by line, and is whole up to its last line whenever the program ends.
class GrowingTable {
 public:
  GrowingTable(fs::path path, std::string_view header)
      : path_(std::move(path)), out_(path_, std::ios::binary) {
    add(std::string(header));
  }
  void add(const std::string& line) {
    errno = 0;
    out_ << line << std::flush;
    if (!out_) cannot_write(path_, errno != 0 ? errno : EIO);
  }

 private:
  fs::path path_;
  std::ofstream out_;
};

/// Takes a folder away again that nothing was recorded into.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& place)
      : place_(place), was_there_(fs::exists(fs::symlink_status(place))) {}
  ~NewFolder() {
    std::error_code ignored;
    if (!was_there_ && fs::is_directory(place_, ignored)) fs::remove(place_, ignored);  // an empty one only
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

 private:
  fs::path place_;
  bool was_there_;
};

std::string row_of(const LiveFrame& frame, const std::string& file) {
  std::string row =
      fmt::format("{},{},{},{},{},", frame.frame, frame.status == FrameStatus::kWhole ? file : "",
                  name_of(frame.status), frame.camera_ns, nanoseconds_of(frame.arrived));
  if (frame.encoder) append_shortest(row, *frame.encoder);
  return row + "," + (frame.reason.empty() ? "" : csv_cell(frame.reason)) + "\n";
}

void count(const LiveFrame& frame, RecordSummary& summary) {
  ++summary.frames;
  if (frame.status == FrameStatus::kWhole) {
    ++summary.whole;
    return;
  }
  ++(frame.status == FrameStatus::kLost ? summary.lost : summary.incomplete);
  const std::int64_t missing = summary.lost + summary.incomplete;
  if (missing <= kMaxNamed)
    summary.first_missing += fmt::format("{}{} ({}: {})", missing > 1 ? ", " : "", frame.frame,
                                         name_of(frame.status), frame.reason);
  if (missing == kMaxNamed + 1) summary.first_missing += " ...";
}

std::string value_text(const std::optional<double>& value) { return value ? shortest_text(*value) : "null"; }

void write_settings(const RecordJob& job, const RecordSummary& summary, bool over) {
  const CameraSettings& settings = summary.settings;
  std::string text =
      fmt::format("source: {}\ncamera: {}\nexposure_us: {}\ngain: {}\nframes_per_second: {}\n",
                  yaml_text(job.source), yaml_text(settings.camera), value_text(settings.exposure_us),
                  value_text(settings.gain), value_text(settings.frames_per_second));
  if (over)
    text += fmt::format("frames: {}\nwhole: {}\nincomplete: {}\nlost: {}\nseconds: {:.3f}\n", summary.frames,
                        summary.whole, summary.incomplete, summary.lost, summary.seconds);
  write_file(PictureRecorder::beside(job.folder, "record.yaml"), text);
}

}  // namespace

std::optional<double> TravelOfFrames::at(const LiveFrame& frame) {
  if (travel_.step_mm) return static_cast<double>(frame.frame) * *travel_.step_mm;
  if (frame.status == FrameStatus::kLost) return std::nullopt;
  if (travel_.mm_per_count) {
    if (!frame.encoder) return std::nullopt;
    if (!first_count_) first_count_ = frame.encoder;
    return (*frame.encoder - *first_count_) * *travel_.mm_per_count;
  }
  if (!travel_.mm_per_s) return std::nullopt;
  const double ns =
      static_cast<double>(frame.camera_ns != 0 ? frame.camera_ns : nanoseconds_of(frame.arrived));
  if (!first_ns_) first_ns_ = ns;
  return (ns - *first_ns_) * 1e-9 * *travel_.mm_per_s;
}

RecordSummary record_frames(const RecordJob& job, const std::stop_token& stop,
                            const std::function<void(const RecordSummary&)>& progress) {
  const NewFolder folder(job.folder);
  PictureRecorder pictures(job.folder, job.format);
  const auto source = open_live(job.source, {job.channel, 0});
  RecordSummary summary;
  summary.settings = source->settings();
  write_settings(job, summary, false);
  GrowingTable frames(PictureRecorder::beside(job.folder, "frames.csv"),
                      "frame,file,status,camera_ns,arrived_ns,encoder,reason\n");
  std::optional<GrowingTable> travel;
  if (job.travel.any())
    travel.emplace(PictureRecorder::beside(job.folder, "travel.csv"), "frame,travel_mm\n");
  TravelOfFrames travel_of(job.travel);
  const auto start = std::chrono::steady_clock::now();
  while (job.max_frames == 0 || summary.frames < job.max_frames) {
    summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (job.max_seconds > 0 && summary.seconds >= job.max_seconds) break;
    const auto frame = source->next(stop);
    if (!frame) break;
    const std::string file = pictures.name(frame->frame);
    const std::int64_t number = pictures.scan_number(frame->frame);
    const bool whole = frame->status == FrameStatus::kWhole;
    if (whole) pictures.write(frame->frame, frame->image);
    frames.add(row_of(*frame, file));
    const auto at = travel ? travel_of.at(*frame) : std::nullopt;
    // Pages of one file are counted without the frames that are lost.
    if (at && (whole || number == frame->frame)) {
      std::string row = fmt::format("{},", number);
      append_decimals(row, *at, 6);
      travel->add(row + "\n");
    }
    count(*frame, summary);
    progress(summary);
  }
  write_settings(job, summary, true);
  return summary;
}

namespace {

/// What a recording leaves at its end, where it wrote these frames.
fs::path note_of(const fs::path& frames) {
  const bool pattern = frames.filename().string().find_first_of("*?") != std::string::npos;
  std::error_code error;
  if (!pattern && (PictureRecorder::is_one_file(frames) || fs::is_directory(frames, error)))
    return PictureRecorder::beside(frames, "record.yaml");
  return frames.parent_path() / "record.yaml";
}

}  // namespace

bool recording_is_over(const Scan& scan) {
  return std::all_of(scan.frames.begin(), scan.frames.end(), [&](const auto& sensor) {
    const fs::path note = note_of(scan.folder / files_of_frames(sensor.second));
    return fs::exists(note) && read_file(note).find("\nframes: ") != std::string::npos;
  });
}

}  // namespace lightstripe
