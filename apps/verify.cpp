// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "apps/calibrate.h"
#include "calib/verify/verify_rig.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/rig_file.h"
#include "pipeline/run_record.h"

namespace lightstripe {
namespace {

struct VerifyArguments {
  CommonOptions common;
  std::string session, rig;
  Overrides extraction, limits;
};

/// Every sensor of the session is in the rig, with pictures of its size and lines of its laser planes.
void check_sensors(const VerifyArguments& arguments, const CalibrationObservations& observations,
                   const Rig& rig) {
  for (const auto& seen : observations.sensors) {
    const auto found = std::find_if(rig.sensors.begin(), rig.sensors.end(),
                                    [&](const auto& s) { return s.name == seen.name; });
    if (found == rig.sensors.end())
      throw Error(arguments.rig, "has no sensor " + seen.name,
                  "give the rig that was calibrated with these sensors");
    if (seen.width > 0 && (seen.width != found->camera.width || seen.height != found->camera.height))
      throw Error(arguments.session,
                  fmt::format("the pictures of {} have {} x {} px, the rig's camera {} x {}", seen.name,
                              seen.width, seen.height, found->camera.width, found->camera.height),
                  "verify with pictures of the calibrated camera and setting");
    if (seen.laser_planes != static_cast<int>(found->laser_planes.size()))
      throw Error(arguments.session,
                  fmt::format("sensor {} says {} laser planes, the rig has {}", seen.name, seen.laser_planes,
                              found->laser_planes.size()),
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

std::string describe(const Verification& verification) {
  std::string text;
  for (const auto& s : by_sensor(verification))
    text += fmt::format(
        "{}: stripe off the board {:.3f} mm, distances along it {:.3f} mm, corners {:.3f} px (rms, {} "
        "views)\n",
        s.name, s.plane_rms_mm, s.length_error_mm, s.corner_rms_px, s.views);
  for (const auto& s : by_seam(verification))
    text += fmt::format("{} to {}: gap {:.3f} mm, board's place {:.3f} mm (rms, {} poses)\n", s.sensor,
                        s.other, s.gap_mm, s.centre_gap_mm, s.poses);
  if (verification.travel_rms_mm)
    text += fmt::format("travel: fixed board within {:.3f} mm rms\n", *verification.travel_rms_mm);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

int verify_session(const VerifyArguments& arguments) {
  const ThreadLimit limit(arguments.common);
  const Session session = read_session(arguments.session);
  const Rig rig = read_rig(arguments.rig);
  ExtractionOptions extraction;
  read_subtree(session.extraction, extraction);
  apply_overrides(extraction, arguments.extraction);
  VerifyLimits limits;
  apply_overrides(limits, arguments.limits);

  const SessionObservations seen = observe_session(session, extraction, arguments.common);
  check_sensors(arguments, seen.observations, rig);
  const Verification verification = verify_rig(seen.observations, rig);
  say(arguments.common, fmt::format("boards: found in {} of {} images", seen.boards_found, seen.images));
  for (const auto& image : seen.rejected)
    warn(fmt::format("{} {}: {}", image.sensor, image.image, image.reason));
  const bool measured = std::any_of(verification.views.begin(), verification.views.end(),
                                    [](const auto& view) { return view.stripe_points > 0; });
  if (!measured)
    return not_usable(
        "no image of the session shows board and stripe; take pictures of the board in the laser");
  say(arguments.common, describe(verification));
  const std::string output = arguments.common.output.empty() ? "verify.csv" : arguments.common.output;
  write_file(output, csv_of(verification));
  write_run_record(output, "verify", {arguments.session, arguments.rig},
                   "limits:\n" + indented(dump_yaml(limits)));
  const auto reasons = exceeded(verification, limits);
  say(arguments.common, (reasons.empty() ? "passed; views -> " : "failed; views -> ") + output);
  std::string all;
  for (const auto& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
  return reasons.empty() ? kExitDone : not_usable(all);
}

}  // namespace

void add_verify_command(CLI::App& app, Command& run) {
  auto* command =
      app.add_subcommand("verify", "accuracy of an existing rig on boards that it was not calibrated with");
  auto arguments = std::make_shared<VerifyArguments>();
  command->add_option("session", arguments->session, "session (YAML) as for calibrate, with new images")
      ->required();
  command->add_option("--rig", arguments->rig, "the rig to verify")->required();
  add_common_options(*command, arguments->common, "table of the views (default: verify.csv)");
  add_field_options<VerifyLimits>(*command, "", arguments->limits);
  add_field_options<ExtractionOptions>(*command, "extraction.", arguments->extraction);
  command->callback([arguments, &run] { run = [arguments] { return verify_session(*arguments); }; });
}

}  // namespace lightstripe
