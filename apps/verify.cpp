// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/verify_job.h"

#include <fmt/format.h>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/progress.h"

namespace lightstripe {
namespace {

struct VerifyArguments {
  CommonOptions common;
  std::string session, rig;
  Overrides extraction, limits;
};

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

int run_verify(const VerifyArguments& arguments) {
  const CommonOptions& common = arguments.common;
  VerifyJob job = read_verify_job(arguments.session, arguments.rig);
  apply_overrides(job.extraction, arguments.extraction);
  apply_overrides(job.limits, arguments.limits);
  if (!common.output.empty()) job.table = common.output;
  job.threads = common.threads;
  const VerifyResult result = verify(job, progress_line(common.quiet));
  say(common, fmt::format("boards: found in {} of {} images", result.seen.boards_found, result.seen.images));
  for (const auto& image : result.seen.rejected)
    warn(fmt::format("{} {}: {}", image.sensor, image.image, image.reason));
  if (!result.measured) return not_usable(result.not_usable);
  say(common, describe(result.verification));
  say(common, (result.usable() ? "passed; views -> " : "failed; views -> ") + job.table.string());
  return result.usable() ? kExitDone : not_usable(result.not_usable);
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
  command->callback([arguments, &run] { run = [arguments] { return run_verify(*arguments); }; });
}

}  // namespace lightstripe
