// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/verify_job.h"

#include <fmt/format.h>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/progress.h"
#include "apps/table_style.h"
#include "core/counted.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/rig_file.h"
#include "io/session_file.h"
#include "pipeline/artefact_job.h"
#include "report/artefact_report.h"
#include "report/verify_text.h"

namespace lightstripe {
namespace {

struct ArtefactArguments {
  std::string kind, sensor, report;
  double size_mm = 0, size_sigma_mm = 0, max_error_mm = 0, max_drift_mm = 0;
};

struct VerifyArguments {
  CommonOptions common;
  std::string session, rig;
  Overrides extraction, limits;
  ArtefactArguments artefact;
  TableStyle style = TableStyle::kPlain;
};

ArtefactJob artefact_job_of(const VerifyArguments& arguments) {
  const ArtefactArguments& given = arguments.artefact;
  if (!(given.size_mm > 0))
    throw Error("--size", "the body's size is not given",
                "give its height (step) or diameter (cylinder, sphere) in mm");
  ArtefactJob job;
  job.input = arguments.session, job.rig_file = arguments.rig;
  job.rig = read_rig(arguments.rig);
  for (const auto& entry : enum_names(Artefact{}))
    if (given.kind == entry.name) job.spec.kind = entry.value;
  job.spec.size_mm = given.size_mm, job.size_sigma_mm = given.size_sigma_mm;
  job.max_error_mm = given.max_error_mm, job.max_drift_mm = given.max_drift_mm;
  job.sensor = given.sensor;
  if (shows_scan(job.input)) read_subtree(read_scan(job.input).extraction, job.extraction);
  apply_overrides(job.extraction, arguments.extraction);
  if (!arguments.common.output.empty()) job.table = arguments.common.output;
  if (!given.report.empty()) job.other_outputs = {given.report};
  job.threads = arguments.common.threads;
  return job;
}

int run_artefact(const VerifyArguments& arguments) {
  const CommonOptions& common = arguments.common;
  if (arguments.style == TableStyle::kExcel)
    throw Error("--csv-style", "is not for a table that grows, which the next check reads again",
                "leave it out; the page of --report shows all checks");
  const ArtefactJob job = artefact_job_of(arguments);
  const ArtefactResult result = verify_artefact(job, progress_line(common.quiet));
  if (!result.check) return not_usable(result.not_usable);
  say(common, describe_check(*result.check));
  if (result.sheet_error_mm > 0)
    say(common,
        fmt::format("a laser sheet as thick as this one makes the body smaller by about {:.3f} mm, which "
                    "counts in the sigma",
                    result.sheet_error_mm));
  if (!arguments.artefact.report.empty())
    write_file(arguments.artefact.report, artefact_report_html(result.history));
  say(common, fmt::format("{}; check {} -> {}", result.usable() ? "passed" : "failed", result.history.size(),
                          job.table.string()));
  return result.usable() ? kExitDone : not_usable(result.not_usable);
}

int run_verify(const VerifyArguments& arguments) {
  if (!arguments.artefact.kind.empty()) return run_artefact(arguments);
  const CommonOptions& common = arguments.common;
  VerifyJob job = read_verify_job(arguments.session, arguments.rig);
  apply_overrides(job.extraction, arguments.extraction);
  apply_overrides(job.limits, arguments.limits);
  if (!common.output.empty()) job.table = common.output;
  job.threads = common.threads;
  const VerifyResult result = verify(job, progress_line(common.quiet));
  say(common, fmt::format("boards: found in {} of {}", result.seen.boards_found,
                          counted(result.seen.images, "image")));
  for (const auto& image : result.seen.rejected)
    warn(fmt::format("{} {}: {}", image.sensor, image.image, image.reason));
  if (!result.measured) return not_usable(result.not_usable);
  apply_table_style(job.table, arguments.style);
  say(common, describe_verification(result.verification));
  say(common, (result.usable() ? "passed; views -> " : "failed; views -> ") + job.table.string());
  return result.usable() ? kExitDone : not_usable(result.not_usable);
}

void add_artefact_options(CLI::App& command, ArtefactArguments& artefact) {
  const char* group = "A body of known size instead of boards";
  auto* kind = one_of(command.add_option("--artefact", artefact.kind,
                                         "step, cylinder or sphere; SESSION is a scan or a picture"),
                      {"step", "cylinder", "sphere"})
                   ->group(group);
  const auto add_mm = [&](const char* name, double& value, const char* what) {
    command.add_option(name, value, what)->check(CLI::NonNegativeNumber)->needs(kind)->group(group);
  };
  add_mm("--size", artefact.size_mm, "its height (step) or diameter, mm");
  add_mm("--size-sigma-mm", artefact.size_sigma_mm, "how well that is known, 1 sigma [0]");
  add_mm("--max-error-mm", artefact.max_error_mm, "limit of the error [3 sigma]");
  add_mm("--max-drift-mm", artefact.max_drift_mm, "limit of the change since the last check [none]");
  command.add_option("--sensor", artefact.sensor, "that took the picture [the rig's first]")
      ->needs(kind)
      ->group(group);
  command.add_option("--report", artefact.report, "page with all checks of this body (HTML)")
      ->needs(kind)
      ->group(group);
}

}  // namespace

void add_verify_command(CLI::App& app, Command& run) {
  auto* command =
      app.add_subcommand("verify", "accuracy of an existing rig on boards that it was not calibrated with");
  auto arguments = std::make_shared<VerifyArguments>();
  command->add_option("session", arguments->session, "session (YAML) as for calibrate, with new images")
      ->required();
  command->add_option("--rig", arguments->rig, "the rig to verify")->required();
  add_common_options(
      *command, arguments->common,
      "table of the views (default: verify.csv; with --artefact artefact_checks.csv, which grows)");
  add_table_style_option(*command, arguments->style);
  add_field_options<VerifyLimits>(*command, "", arguments->limits);
  add_artefact_options(*command, arguments->artefact);
  add_field_options<ExtractionOptions>(*command, "extraction.", arguments->extraction);
  command->callback([arguments, &run] { run = [arguments] { return run_verify(*arguments); }; });
}

}  // namespace lightstripe
