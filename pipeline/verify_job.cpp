// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/verify_job.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/counted.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/output_guard.h"
#include "io/rig_file.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

/// Every sensor of the session is in the rig, with pictures of its size and lines of its laser planes.
void check_sensors(const VerifyJob& job, const CalibrationObservations& observations) {
  for (const auto& seen : observations.sensors) {
    const auto found = std::find_if(job.rig.sensors.begin(), job.rig.sensors.end(),
                                    [&](const auto& s) { return s.name == seen.name; });
    if (found == job.rig.sensors.end())
      throw Error(job.rig_file.string(), "has no sensor " + seen.name,
                  "give the rig that was calibrated with these sensors");
    if (seen.width > 0 && (seen.width != found->camera.width || seen.height != found->camera.height))
      throw Error(job.session_file.string(),
                  fmt::format("the pictures of {} have {} x {} px, the rig's camera {} x {}", seen.name,
                              seen.width, seen.height, found->camera.width, found->camera.height),
                  "verify with pictures of the calibrated camera and setting");
    if (seen.laser_planes != static_cast<int>(found->laser_planes.size()))
      throw Error(job.session_file.string(),
                  fmt::format("sensor {} says {}, the rig has {}", seen.name,
                              counted(seen.laser_planes, "laser plane"), found->laser_planes.size()),
                  "give laser_planes as in the calibration session");
  }
}

std::string csv_of(const Verification& verification) {
  std::string text =
      "pose,sensor,other,laser_plane,corners,corner_rms_px,stripe_points,plane_mean_mm,plane_rms_mm,plane_"
      "max_mm,"
      "length_mm,length_error_mm,gap_mm,centre_gap_mm\n";
  for (const auto& v : verification.views) {
    text += fmt::format("{},{},,{},{},{:.4f},{},", v.pose, v.sensor, v.laser_plane, v.corners,
                        v.corner_rms_px, v.stripe_points);
    text += v.stripe_points > 0
                ? fmt::format("{:.5f},{:.5f},{:.5f},", v.plane_mean_mm, v.plane_rms_mm, v.plane_max_mm)
                : ",,,";
    text += v.length_mm > 0 ? fmt::format("{:.4f},{:.5f},,\n", v.length_mm, v.length_error_mm) : ",,,\n";
  }
  for (const auto& p : verification.pairs)
    text += fmt::format("{},{},{},,,,,,,,,,{},{:.5f}\n", p.pose, p.sensor, p.other,
                        p.gap_mm ? fmt::format("{:.5f}", *p.gap_mm) : "", p.centre_gap_mm);
  return text;
}

std::string joined(const std::vector<std::string>& reasons) {
  std::string all;
  for (const auto& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
  return all;
}

}  // namespace

VerifyJob read_verify_job(const std::filesystem::path& session_file, const std::filesystem::path& rig_file) {
  VerifyJob job;
  job.session_file = session_file;
  job.rig_file = rig_file;
  job.session = read_session(session_file);
  job.rig = read_rig(rig_file);
  read_subtree(job.session.extraction, job.extraction);
  return job;
}

VerifyResult verify(const VerifyJob& job, const ProgressCallback& progress, const std::stop_token& stop) {
  std::vector<std::filesystem::path> inputs = files_of(job.session);
  inputs.insert(inputs.end(), {job.session_file, job.rig_file});
  if (!job.table.empty()) guard_outputs(inputs, {job.table, job.table.string() + ".run.yaml"});
  const JobThreads threads(job.threads);
  VerifyResult result;
  result.seen = observe_session(job.session, job.extraction, progress, stop);
  check_sensors(job, result.seen.observations);
  result.verification = verify_rig(result.seen.observations, job.rig);
  const auto& views = result.verification.views;
  result.measured =
      std::any_of(views.begin(), views.end(), [](const auto& v) { return v.stripe_points > 0; });
  if (!result.measured) {
    result.not_usable =
        "no image of the session shows board and stripe; take pictures of the board in the laser";
    return result;
  }
  if (!job.table.empty()) {
    write_file(job.table, csv_of(result.verification));
    write_run_record(job.table, "verify", {job.session_file, job.rig_file},
                     "limits:\n" + indented(dump_yaml(job.limits)));
  }
  result.exceeded = exceeded(result.verification, job.limits);
  result.not_usable = joined(result.exceeded);
  return result;
}

}  // namespace lightstripe
