// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Profiles while the camera measures: one line of JSON a frame on stdout.
#include "pipeline/live_profiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/command.h"
#include "apps/interrupt.h"
#include "apps/live_options.h"
#include "apps/options.h"
#include "apps/status_line.h"
#include "core/counted.h"
#include "core/error.h"
#include "io/rig_file.h"

namespace lightstripe {
namespace {

struct LiveArguments {
  LiveJob job;
  bool quiet = false, no_points = false;
  std::string rig, sensor;
  Overrides extraction;
};

int sensor_of(const Rig& rig, const LiveArguments& arguments) {
  std::string names;
  for (std::size_t i = 0; i < rig.sensors.size(); ++i) {
    if (rig.sensors[i].name == arguments.sensor) return static_cast<int>(i);
    names += (i > 0 ? ", " : "") + rig.sensors[i].name;
  }
  if (arguments.sensor.empty() && rig.sensors.size() == 1) return 0;
  throw Error("--sensor",
              arguments.sensor.empty() ? "the rig has several sensors"
                                       : "the rig has no sensor '" + arguments.sensor + "'",
              "name the one that this camera is: " + names);
}

std::string status_of(const LiveSummary& now) {
  return fmt::format("{}, {:.1f}/s, {} lost, {} incomplete, {} late, {}, sigma {:.4f} mm, latency {:.1f} ms",
                     counted(now.frames, "frame"),
                     static_cast<double>(now.frames) / std::max(now.seconds, 1e-3), now.lost, now.incomplete,
                     now.late, counted(now.points, "point"), now.sigma_mm, now.latency.quantile(0.5));
}

int run_live(LiveArguments arguments) {
  LiveJob& job = arguments.job;
  refuse_two_travels(job.travel);
  job.rig = read_rig(arguments.rig);
  job.sensor = sensor_of(job.rig, arguments);
  apply_overrides(job.extraction, arguments.extraction);
  const InterruptWatch interrupt;
  StatusLine line(arguments.quiet);
  const LiveSummary summary =
      live_profiles(job, interrupt.token(), [&](const LiveMeasurement& measured, const LiveSummary& now) {
        const std::string text = json_line(measured, !arguments.no_points) + "\n";
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
          throw Error("stdout", "cannot be written", "see why the program behind the pipe has ended");
        line.show([&] { return status_of(now); });
      });
  line.clear();
  if (!arguments.quiet)
    say_status(fmt::format("{}, 99 % {:.1f} ms", status_of(summary), summary.latency.quantile(0.99)));
  return summary.whole == 0 ? not_usable("no whole frame arrived; the lines on stdout say why") : kExitDone;
}

}  // namespace

void add_live_command(CLI::App& app, Command& run) {
  auto* command =
      app.add_subcommand("live", "a camera's profiles while it measures: one line of JSON a frame on stdout");
  auto arguments = std::make_shared<LiveArguments>();
  LiveJob& job = arguments->job;
  command->add_option("source", job.source, kSourceHelp)->required();
  command->add_option("--rig", arguments->rig, "rig that was calibrated with this camera")->required();
  command->add_option("--sensor", arguments->sensor,
                      "the rig's sensor that this camera is (needed where there are several)");
  command->add_flag("--no-points", arguments->no_points,
                    "leave the columns line, u, v, sigma out of the JSON");
  command
      ->add_option("--max-waiting", job.max_waiting,
                   "frames that may wait; older ones are left out as late, 0 = none is [2]")
      ->check(CLI::Range(0, 1000));
  command->add_flag("--quiet", arguments->quiet, "no line about the state on stderr");
  add_live_options(*command, job.max_frames, job.max_seconds, job.travel);
  add_field_options(*command, "extraction.", arguments->extraction, scan_extraction());
  command->callback([arguments, &run] { run = [arguments] { return run_live(*arguments); }; });
}

}  // namespace lightstripe
