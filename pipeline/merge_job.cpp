// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/merge_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/number_text.h"
#include "io/output_guard.h"
#include "io/resumable_file.h"
#include "io/tables.h"
#include "pipeline/rig_of_sections.h"
#include "pipeline/run_record.h"
#include "reconstruct/cloud_header.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

/// What a part adds to the result: its bytes from here on.
struct Part {
  fs::path file;
  std::uint64_t content_at = 0;
  std::int64_t num_points = 0;
  CloudOrigin origin = CloudOrigin::Zero();
  std::optional<std::pair<std::int64_t, std::int64_t>> frames;  ///< first and last; none: no points, or .xyz
};

Part cloud_part(const fs::path& file, CloudFormat format) {
  if (format == CloudFormat::kXyz) return {file, 0, 0, CloudOrigin::Zero(), std::nullopt};
  const CloudPart cloud = inspect_cloud(file);
  Part part{file, cloud.points_at, cloud.num_points, cloud.origin, std::nullopt};
  if (cloud.num_points > 0) part.frames = {cloud.first_frame, cloud.last_frame};
  return part;
}

std::int64_t frame_of_row(const std::string& row, const fs::path& file) {
  const auto frame = parse_integer(std::string_view(row).substr(0, row.find(',')));
  if (!frame)
    throw Error(file.string(), "has a row that begins with no frame", "reconstruct this part again");
  return *frame;
}

/// The text behind the last line break but one; the file has to end with a line break.
std::string last_row(std::ifstream& in, const fs::path& file) {
  constexpr std::uintmax_t kLongestRow = 4096;
  const std::uintmax_t size = fs::file_size(file), length = std::min(kLongestRow, size);
  std::string tail(length, '\0');
  in.clear();
  in.seekg(static_cast<std::streamoff>(size - length));
  in.read(tail.data(), static_cast<std::streamsize>(length));
  if (tail.empty() || tail.back() != '\n')
    throw Error(file.string(), "ends within a row", "reconstruct this part again");
  tail.pop_back();
  return tail.substr(tail.rfind('\n') + 1);
}

Part profiles_part(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file.string(), "cannot be read", "check the path");
  std::string head, row;
  if (!std::getline(in, head) || head + "\n" != kProfilesHeader)
    throw Error(file.string(), "is no profiles.csv of lightstripe", "give the tables of the parts");
  Part part{file, kProfilesHeader.size(), 0, CloudOrigin::Zero(), std::nullopt};
  if (!std::getline(in, row)) return part;
  part.frames = {frame_of_row(row, file), 0};
  part.frames->second = frame_of_row(last_row(in, file), file);
  return part;
}

/// In order of frames; an Error where two parts have frames in common.
void put_in_order(std::vector<Part>& parts) {
  const auto before = [](const Part& a, const Part& b) {
    return a.frames && b.frames && a.frames->first < b.frames->first;
  };
  std::vector<Part> filled;
  for (const Part& part : parts)
    if (part.frames) filled.push_back(part);
  if (filled.empty()) return;  // .xyz files name no frames: the order given
  std::stable_sort(filled.begin(), filled.end(), before);
  for (std::size_t i = 1; i < filled.size(); ++i)
    if (filled[i].frames->first <= filled[i - 1].frames->second)
      throw Error(filled[i].file.string(),
                  fmt::format("has frames {} to {}, and {} has {} to {}", filled[i].frames->first,
                              filled[i].frames->second, filled[i - 1].file.string(),
                              filled[i - 1].frames->first, filled[i - 1].frames->second),
                  "give parts that do not overlap");
  parts = filled;
}

void refuse_other_origins(const std::vector<Part>& parts) {
  for (const Part& part : parts)
    if (part.origin != parts.front().origin)
      throw Error(part.file.string(), "has another origin than " + parts.front().file.string(),
                  "reconstruct the parts from one recording, whose travel table or poses decide it");
}

std::vector<Part> read_parts(const MergeJob& job, bool table, CloudFormat format) {
  std::vector<Part> parts;
  for (const fs::path& file : job.parts) {
    if (file.extension() != job.output.extension())
      throw Error(file.string(), "has another format than " + job.output.string(),
                  "give parts and result the same extension");
    refuse_special_file(file);
    parts.push_back(table ? profiles_part(file) : cloud_part(file, format));
  }
  return parts;
}

/// The one rig of all parts; nothing where they are of several, or the record of one does not say.
RecordedRig rig_of(const std::vector<fs::path>& parts) {
  RecordedRig common = recorded_rig(parts.front());
  bool any = common.rig || !common.why_not.empty();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const RecordedRig one = recorded_rig(parts[i]);
    any = any || one.rig || !one.why_not.empty();
    if (!common.rig) continue;
    if (!one.rig)
      common = {std::nullopt, one.why_not};
    else if (one.rig->sha256 != common.rig->sha256)
      common = {std::nullopt, parts[i].string() + " was made with another rig than " + parts[0].string()};
  }
  if (any && !common.rig && common.why_not.empty()) common.why_not = "not all parts have a record of theirs";
  return common;
}

void write_record(const MergeJob& job, bool table, MergeResult& result) {
  std::error_code error;
  const bool has_place = fs::is_regular_file(job.output, error);  // a pipe has none beside it
  const RecordedRig common = table && has_place ? rig_of(job.parts) : RecordedRig{};
  if (!common.rig && common.why_not.empty()) return write_run_record(job.output, "merge", job.parts, "");
  write_sections_record(job.output, "merge", job.parts, common.rig, common.why_not);
  if (!common.rig)
    result.warnings.push_back(job.output.string() + ".run.yaml names no rig: " + common.why_not +
                              "; `measure` needs it as --rig");
}

}  // namespace

MergeResult merge(const MergeJob& job) {
  const bool table = job.output.extension() == ".csv";
  const CloudFormat format = table ? CloudFormat::kPly : cloud_format(job.output, job.output.string());
  std::vector<Part> parts = read_parts(job, table, format);
  put_in_order(parts);
  refuse_other_origins(parts);
  MergeResult result;
  for (const Part& part : parts) result.num_points += part.num_points;
  if (result.num_points > kMaxCloudPoints)
    throw Error(job.output.string(), fmt::format("the cloud would exceed {} points", kMaxCloudPoints),
                "merge fewer parts");
  guard_outputs(job.parts,
                {job.output, ResumableFile::partial_of(job.output), job.output.string() + ".run.yaml"});
  const TemporaryName half(ResumableFile::partial_of(job.output));  // unlike a scan's, it cannot be resumed
  ResumableFile out(job.output, table ? std::string(kProfilesHeader)
                                      : cloud_header(format, result.num_points, parts.front().origin));
  try {
    for (const Part& part : parts) out.append_file(part.file, part.content_at);
    out.commit();
  } catch (...) {
    out.discard();
    throw;
  }
  write_record(job, table, result);
  return result;
}

}  // namespace lightstripe
