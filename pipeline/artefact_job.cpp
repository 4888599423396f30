// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/artefact_job.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/error.h"
#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "io/atomic_file.h"
#include "io/csv_reader.h"
#include "io/images.h"
#include "io/output_guard.h"
#include "io/session_file.h"
#include "io/tables.h"
#include "measure/sheet_thickness.h"
#include "pipeline/recording.h"
#include "pipeline/run_record.h"
#include "reconstruct/scanner.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHead =
    "time,rig,input,artefact,size_mm,measured_mm,error_mm,sigma_mm,scatter_mm,points,limit_mm,drift_mm,"
    "drift_sigma_mm,verdict\n";

struct SeenPoints {
  std::vector<Eigen::Vector3d> points;
  std::vector<int> groups;
  double sigma_sum = 0;                        ///< of the points' predicted sigmas
  double sheet_squares = 0, sheet_points = 0;  ///< of the sheet's thickness, mm^2

  /// A line's thickness counts with its points. `seen`: one of them, camera frame.
  void add_line(const Sensor& sensor, const Eigen::Vector3d& seen, const LineWidth& line) {
    if (sensor.laser_planes.empty()) return;
    const auto sigma = sheet_sigma_mm(sensor.camera, sensor.laser_planes.front(), seen, line.width_px);
    if (!sigma) return;
    sheet_squares += line.points * *sigma * *sigma, sheet_points += line.points;
  }
  double sheet_sigma() const { return sheet_points > 0 ? std::sqrt(sheet_squares / sheet_points) : 0; }
  double mean_sigma() const { return points.empty() ? 0 : sigma_sum / static_cast<double>(points.size()); }
};

void add_lines(const Rig& rig, const Rigid3& result_from_rig, const ScannedFrame& frame, SeenPoints& seen) {
  for (const LineWidth& line : frame.lines) {
    const Sensor& sensor = rig.sensors[static_cast<std::size_t>(line.sensor)];
    for (const ProfilePoint& p : frame.profile.points)
      if (p.sensor == line.sensor) {
        seen.add_line(sensor, (result_from_rig * sensor.rig_from_camera).inverse() * p.position, line);
        break;
      }
  }
}

/// Every frame is a group.
SeenPoints points_of_scan(const ArtefactJob& job, const ProgressCallback& progress,
                          const std::stop_token& stop) {
  const Scan scan = read_scan(job.input);
  ExtractionOptions extraction = job.extraction;
  const Recording recording(scan, job.input.string(), job.rig);
  ScanInput input;
  input.first_frame = recording.first_frame(), input.end_frame = recording.end_frame();
  input.read = [&](std::int64_t frame, int sensor) { return recording.read(frame, sensor); };
  input.position = [&](std::int64_t frame) { return recording.position(frame); };
  input.recorded = [&](std::int64_t frame) { return recording.recorded(frame); };
  input.stop = stop;
  StepCounter steps("measuring", "frames", input.end_frame - input.first_frame, progress);
  SeenPoints seen;
  int group = 0;
  const auto summary =
      scan_profiles(input, job.rig, extraction, thread_count(job.threads), [&](const ScannedFrame& frame) {
        for (const ProfilePoint& p : frame.profile.points)
          seen.points.push_back(p.position), seen.groups.push_back(group), seen.sigma_sum += p.sigma_mm;
        if (const auto position = recording.position(frame.profile.frame); position)
          add_lines(job.rig, result_from_rig(job.rig.motion, *position), frame, seen);
        ++group;
        steps.step();
      });
  if (summary.stopped) throw Error(job.input.string(), "the check was interrupted", "run it again");
  return seen;
}

int sensor_index(const ArtefactJob& job) {
  if (job.sensor.empty()) return 0;
  for (std::size_t s = 0; s < job.rig.sensors.size(); ++s)
    if (job.rig.sensors[s].name == job.sensor) return static_cast<int>(s);
  throw Error(job.rig_file.string(), "has no sensor " + job.sensor, "give --sensor one of its names");
}

void check_picture(const ArtefactJob& job, const Image8& image, const Sensor& sensor) {
  if (image.width != sensor.camera.width || image.height != sensor.camera.height)
    throw Error(job.input.string(),
                fmt::format("the picture has {} x {} px, the rig's camera {} x {}", image.width, image.height,
                            sensor.camera.width, sensor.camera.height),
                "verify with a picture of the calibrated camera and setting");
  if (job.spec.kind == Artefact::kSphere)
    throw Error(job.input.string(), "one picture shows a circle of the ball, not the ball",
                "give a scan of it, or take --artefact cylinder or step");
}

/// Pieces of the line are the groups, long enough that their errors have little in common.
SeenPoints points_of_picture(const ArtefactJob& job) {
  constexpr std::size_t kPiece = 20;
  const int index = sensor_index(job);
  const Image8 image = read_image(job.input);
  check_picture(job, image, job.rig.sensors[static_cast<std::size_t>(index)]);
  ExtractionWorkspace workspace;
  ExtractionResult found;
  extract_stripes(image.view(), job.extraction, workspace, found);
  Profile profile;
  triangulate_stripes(found.stripes, job.rig, index, {}, profile);
  SeenPoints seen;
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const ProfilePoint& p = profile.points[i];
    seen.points.emplace_back(0, p.u, p.v);
    seen.groups.push_back(static_cast<int>(i / kPiece));
    seen.sigma_sum += p.sigma_mm;
  }
  return seen;
}

std::string now_utc() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

/// Of the first sensor's laser, rig frame.
Eigen::Vector3d sheet_normal(const Rig& rig) {
  const Sensor& first = rig.sensors.front();
  return first.rig_from_camera.rotation * first.laser_planes.front().normal;
}

/// The rows of the same body.
std::vector<ArtefactCheck> same_body(std::vector<ArtefactCheck> checks, const ArtefactCheck& as) {
  std::erase_if(checks, [&](const ArtefactCheck& c) {
    return c.artefact != as.artefact || std::abs(c.size_mm - as.size_mm) > 1e-6;
  });
  return checks;
}

/// Points may err alike (the rig, light on a bright edge): their own sigma does not average out.
ArtefactCheck check_of(const ArtefactJob& job, const ArtefactMeasurement& m, double shared_mm) {
  ArtefactCheck check;
  check.time = now_utc();
  check.rig = job.rig_file.string(), check.input = job.input.string();
  check.artefact = std::string(enum_name(job.spec.kind));
  check.size_mm = job.spec.size_mm, check.measured_mm = m.size_mm;
  check.error_mm = m.size_mm - job.spec.size_mm;
  check.sigma_mm = std::hypot(m.sigma_mm, shared_mm);
  check.scatter_mm = m.scatter_mm, check.points = m.points;
  check.limit_mm = job.max_error_mm > 0 ? job.max_error_mm : 3 * check.sigma_mm;
  return check;
}

/// Two checks of one body by one rig share the body's and the rig's own error: what is left is the
/// measurement's.
void compare_with_last(const ArtefactCheck& last, double shared_mm, ArtefactCheck& check) {
  const auto own = [&](const ArtefactCheck& c) {
    return std::sqrt(std::max(0.0, c.sigma_mm * c.sigma_mm - shared_mm * shared_mm));
  };
  check.drift_mm = check.measured_mm - last.measured_mm;
  check.drift_sigma_mm = std::hypot(own(check), own(last));
}

std::string why_failed(const ArtefactJob& job, const ArtefactCheck& check) {
  std::string why;
  if (!(std::abs(check.error_mm) <= check.limit_mm))
    why = fmt::format("the {} of {:g} mm measures {:.4f} mm, {:+.4f} mm off, more than the {} {:.4f} mm",
                      check.artefact, check.size_mm, check.measured_mm, check.error_mm,
                      job.max_error_mm > 0 ? "allowed" : "three sigma of", check.limit_mm);
  if (job.max_drift_mm > 0 && check.drift_mm && !(std::abs(*check.drift_mm) <= job.max_drift_mm))
    why += fmt::format("{}it has moved by {:+.4f} mm since the last check, more than the allowed {:.4f} mm",
                       why.empty() ? "" : "; ", *check.drift_mm, job.max_drift_mm);
  return why.empty() ? why : why + "; clean lens and body and repeat, then calibrate anew";
}

std::string row_of(const ArtefactCheck& c) {
  const auto cell = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.5f}", *value) : "";
  };
  return fmt::format("{},{},{},{},{:g},{:.5f},{:.5f},{:.5f},{:.5f},{},{:.5f},{},{},{}\n", c.time,
                     csv_cell(c.rig), csv_cell(c.input), c.artefact, c.size_mm, c.measured_mm, c.error_mm,
                     c.sigma_mm, c.scatter_mm, c.points, c.limit_mm, cell(c.drift_mm), cell(c.drift_sigma_mm),
                     c.verdict);
}

void guard(const ArtefactJob& job) {
  std::vector<fs::path> inputs{job.input, job.rig_file}, outputs = job.other_outputs;
  if (shows_scan(job.input)) {
    const std::vector<fs::path> files = files_of(read_scan(job.input));
    inputs.insert(inputs.end(), files.begin(), files.end());
  }
  if (!job.table.empty()) outputs.insert(outputs.end(), {job.table, job.table.string() + ".run.yaml"});
  guard_outputs(inputs, outputs);
}

/// Earlier rows stay as they are, byte by byte.
void append_row(const ArtefactJob& job, const ArtefactCheck& check) {
  if (job.table.empty()) return;
  std::string text = fs::exists(job.table) ? read_file(job.table) : std::string(kHead);
  if (!text.empty() && text.back() != '\n') text += '\n';
  write_file(job.table, text + row_of(check));
  write_run_record(job.table, "verify", {job.input, job.rig_file},
                   "extraction:\n" + indented(dump_yaml(job.extraction)));
}

}  // namespace

bool shows_scan(const fs::path& input) { return input.extension() == ".yaml" || input.extension() == ".yml"; }

std::vector<ArtefactCheck> read_artefact_checks(const fs::path& table) {
  std::vector<ArtefactCheck> checks;
  CsvReader rows(table, {"time", "rig", "input", "artefact", "size_mm", "measured_mm", "error_mm", "sigma_mm",
                         "scatter_mm", "points", "limit_mm", "drift_mm", "drift_sigma_mm", "verdict"});
  while (rows.next()) {
    ArtefactCheck c{rows.text(0),
                    rows.text(1),
                    rows.text(2),
                    rows.text(3),
                    rows.number(4),
                    rows.number(5),
                    rows.number(6),
                    rows.number(7),
                    rows.number(8),
                    rows.integer(9),
                    rows.number(10),
                    {},
                    {},
                    rows.text(13)};
    if (!rows.text(11).empty()) c.drift_mm = rows.number(11);
    if (!rows.text(12).empty()) c.drift_sigma_mm = rows.number(12);
    checks.push_back(std::move(c));
  }
  return checks;
}

ArtefactResult verify_artefact(const ArtefactJob& job, const ProgressCallback& progress,
                               const std::stop_token& stop) {
  guard(job);
  const JobThreads threads(job.threads);
  const bool known_before = !job.table.empty() && fs::exists(job.table);
  const auto before = known_before ? read_artefact_checks(job.table) : std::vector<ArtefactCheck>{};
  ArtefactSpec spec = job.spec;
  spec.section = !shows_scan(job.input);
  const SeenPoints seen = spec.section ? points_of_picture(job) : points_of_scan(job, progress, stop);
  ArtefactResult result;
  std::string why_not;
  const auto measurement = measure_artefact(seen.points, seen.groups, spec, why_not);
  if (!measurement) {
    result.not_usable = why_not + "; show the whole body in the laser, and check --size";
    return result;
  }
  if (spec.kind != Artefact::kStep)
    result.sheet_error_mm =
        kLeftInTheMiddle * sheet_error_mm(seen.sheet_sigma(), job.spec.size_mm,
                                          spec.section ? Eigen::Vector3d::UnitX() : measurement->axis,
                                          sheet_normal(job.rig));
  const double shared_mm = std::hypot(seen.mean_sigma(), job.size_sigma_mm, result.sheet_error_mm);
  ArtefactCheck check = check_of(job, *measurement, shared_mm);
  result.history = same_body(before, check);
  if (!result.history.empty()) compare_with_last(result.history.back(), shared_mm, check);
  result.not_usable = why_failed(job, check);
  check.verdict = result.usable() ? "pass" : "fail";
  append_row(job, check);
  result.history.push_back(check);
  result.check = check;
  return result;
}

}  // namespace lightstripe
