// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/measure.h"

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include <filesystem>
#include <map>

#include "apps/measurement_table.h"
#include "apps/run_record.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/nominal_outlines.h"
#include "io/tables.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

std::string output_of(const MeasureArguments& arguments) {
  return arguments.common.output.empty() ? "measurements.csv" : arguments.common.output;
}

std::string kind_name(ObjectKind kind) { return kind == ObjectKind::kRail ? "rail" : "wheel"; }

ReferenceShape reference_of(const MeasureArguments& arguments) {
  const std::string name = !arguments.nominal.empty()            ? arguments.nominal
                           : arguments.kind == ObjectKind::kRail ? "60E1"
                                                                 : "S1002";
  NominalProfile profile = read_nominal_profile(name);
  if (profile.kind != kind_name(arguments.kind))
    throw Error(name, "is the outline of a " + (profile.kind.empty() ? "thing without kind" : profile.kind),
                "give the outline of a " + kind_name(arguments.kind) + ", or the other --kind");
  return ReferenceShape(profile.name.empty() ? name : profile.name, arguments.kind,
                        std::move(profile.outline));
}

MeasureOptions options_of(const MeasureArguments& arguments) {
  MeasureOptions options;
  apply_overrides(options.rail, arguments.rail);
  apply_overrides(options.wheel, arguments.wheel);
  apply_overrides(options.registration, arguments.registration);
  return options;
}

Limits limits_of(const MeasureArguments& arguments) {
  Limits limits;
  if (!arguments.limits.empty()) read_yaml(arguments.limits, limits);
  apply_overrides(limits, arguments.limit);
  return limits;
}

std::string effective_options(const MeasureArguments& arguments, const MeasureOptions& options,
                              const Limits& limits) {
  std::string text = fmt::format("kind: {}\nregistration:\n{}", kind_name(arguments.kind),
                                 indented(dump_yaml(options.registration)));
  text += arguments.kind == ObjectKind::kRail ? "rail:\n" + indented(dump_yaml(options.rail))
                                              : "wheel:\n" + indented(dump_yaml(options.wheel));
  return text + "limits:\n" + indented(dump_yaml(limits));
}

void summarise(const MeasureArguments& arguments, const MeasureOutcome& outcome) {
  const CommonOptions& common = arguments.common;
  say(common, fmt::format("{:<18} {:>6} {:>10} {:>10} {:>10}", "", "frames", "lowest", "mean", "highest"));
  for (const std::string& name : estimate_names(arguments.kind)) {
    const Spread spread = spread_of(outcome.rows, name);
    if (spread.known == 0) continue;
    say(common, fmt::format("{:<18} {:>6} {:>10.3f} {:>10.3f} {:>10.3f}", name, spread.known, spread.low,
                            spread.mean, spread.high));
  }
  const Spread gap = spread_of(outcome.rows, "overlap_gap");
  if (gap.known > 0)
    say(common, fmt::format("{:<18} {:>6} {:>10.3f} {:>10.3f} {:>10.3f}", "overlap_gap", gap.known, gap.low,
                            gap.mean, gap.high));
  std::map<std::string, int> reasons;
  for (const MeasuredFrame& row : outcome.rows)
    if (row.status != "ok") ++reasons[row.status];
  for (const auto& [reason, count] : reasons)
    warn(fmt::format("{} of {} frames: {}", count, outcome.rows.size(), reason));
  say(common,
      fmt::format("{} of {} frames ok -> {}", outcome.num_ok, outcome.rows.size(), output_of(arguments)));
}

int run_measure(const MeasureArguments& arguments) {
  const MeasureOutcome outcome = measure_profiles(arguments);
  summarise(arguments, outcome);
  if (outcome.num_ok == 0)
    return not_usable(fmt::format("none of {} frames could be measured completely", outcome.rows.size()));
  return kExitDone;
}

}  // namespace

MeasureOutcome measure_profiles(const MeasureArguments& arguments) {
  const ThreadLimit limit(arguments.common);
  const MeasureOptions options = options_of(arguments);
  const Limits limits = limits_of(arguments);
  const std::vector<Profile> profiles = read_profiles(arguments.profiles);
  if (profiles.empty()) throw Error(arguments.profiles, "has no rows", "give the sections of a scan");
  const ReferenceShape reference = reference_of(arguments);
  MeasuredObject object{reference, {}, {}};
  if (arguments.kind == ObjectKind::kWheel) {
    object.wheel.radial = sections_are_radial(profiles);
    object.prior = {true, !object.wheel.radial, object.wheel.radial, std::nullopt};
  }
  MeasureOutcome outcome;
  outcome.rows.resize(profiles.size());
  oneapi::tbb::parallel_for(std::size_t{0}, profiles.size(), [&](std::size_t i) {
    outcome.rows[i] = measure_profile(profiles[i], object, options);
  });
  for (const MeasuredFrame& row : outcome.rows) {
    outcome.verdicts.push_back(verdict_name(judge(row, limits)));
    outcome.num_ok += row.status == "ok" ? 1 : 0;
  }
  write_file(output_of(arguments), measurement_table(outcome.rows, arguments.kind, outcome.verdicts));
  write_run_record(output_of(arguments), "measure", {arguments.profiles},
                   effective_options(arguments, options, limits));
  return outcome;
}

void add_measure_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("measure", "sections to wear and dimensions of rails and wheels");
  auto arguments = std::make_shared<MeasureArguments>();
  command->add_option("profiles", arguments->profiles, "table of sections (profiles.csv)")->required();
  command->add_option("--kind", arguments->kind, "rail or wheel")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, ObjectKind>{{"rail", ObjectKind::kRail}, {"wheel", ObjectKind::kWheel}}))
      ->required();
  command->add_option("--nominal", arguments->nominal,
                      "outline of the new rail or wheel: a name or a file [60E1, S1002]");
  command->add_option("--limits", arguments->limits, "file of limits (YAML)");
  add_common_options(*command, arguments->common, "table of measurements (default: measurements.csv)");
  add_field_options<RailOptions>(*command, "", arguments->rail);
  add_field_options<WheelOptions>(*command, "wheel.", arguments->wheel);
  add_field_options<RegistrationOptions>(*command, "registration.", arguments->registration);
  add_field_options<Limits>(*command, "limit.", arguments->limit);
  command->callback([arguments, &run] { run = [arguments] { return run_measure(*arguments); }; });
}

}  // namespace lightstripe
