// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/table_style.h"
#include "io/atomic_file.h"
#include "pipeline/conicity_job.h"
#include "report/conicity_report.h"
#include "report/conicity_text.h"

namespace lightstripe {
namespace {

struct ConicityArguments {
  CommonOptions common;
  ConicityJob job;
  Overrides options;
  TableStyle style = TableStyle::kPlain;
};

int run(ConicityArguments arguments) {
  arguments.job.output = arguments.common.output.empty() ? "conicity.csv" : arguments.common.output;
  apply_overrides(arguments.job.options, arguments.options);
  const Conicity conicity = run_conicity(arguments.job);
  if (!conicity.usable()) return not_usable(conicity.reason);
  apply_table_style(arguments.job.output, arguments.style);
  if (!arguments.job.contacts.empty()) apply_table_style(arguments.job.contacts, arguments.style);
  if (!arguments.job.report.empty())
    write_file(arguments.job.report, conicity_report_html(arguments.job, conicity));
  tell(arguments.common, describe_conicity(conicity, arguments.job.output));
  return kExitDone;
}

}  // namespace

void add_conicity_command(CLI::App& app, Command& run_command) {
  auto* command =
      app.add_subcommand("conicity", "equivalent conicity and contact points of a wheelset on a track");
  auto arguments = std::make_shared<ConicityArguments>();
  ConicityJob& job = arguments->job;
  const std::string kinds =
      "a built-in outline, an outline file, .ban .whl .mpt .prr .prw, or csv (y_mm,z_mm)";
  command->add_option("--wheel", job.wheel, "the wheels: " + kinds)->required();
  command->add_option("--wheel-right", job.wheel_right, "the right wheel, if it is another");
  command->add_option("--rail", job.rail, "the rails: " + kinds)->required();
  command->add_option("--rail-right", job.rail_right, "the right rail, if it is another");
  command
      ->add_option(
          "--inclination", job.inclination,
          "outlines of rails lean inwards by 1:this, 0: not; measured rails are taken as they lie [40]")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--gauge-point-mm", job.gauge_point_mm, "depth of the gauge point below the top [14]")
      ->check(CLI::PositiveNumber);
  command->add_option("--wheel-sigma", job.wheel_sigma_mm,
                      "1-sigma error of a measured wheel's point, mm [from its scatter]");
  command->add_option("--rail-sigma", job.rail_sigma_mm,
                      "1-sigma error of a measured rail's point, mm [from its scatter]");
  command->add_option("--correlation", job.correlation_mm,
                      "length along a measured profile over which points share their error, mm [0]");
  command->add_option("--contacts", job.contacts, "table of the contact points over the shift (csv)");
  add_table_style_option(*command, arguments->style);
  command->add_option("--report", job.report, "report to look at (HTML)");
  add_common_options(*command, arguments->common, "table of tan gamma_e (default: conicity.csv)");
  add_field_options<ConicityOptions>(*command, "", arguments->options);
  command->callback([arguments, &run_command] { run_command = [arguments] { return run(*arguments); }; });
}

}  // namespace lightstripe
