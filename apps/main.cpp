// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <glog/logging.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <opencv2/core/utils/logger.hpp>

#include "apps/command.h"
#include "core/error.h"

namespace {

constexpr const char* kFirstSteps =
    "What to do first:\n"
    "  1. See it work, nothing needed:            lightstripe demo -o demo-output\n"
    "  2. Look at a picture of your laser line:   lightstripe extract frame.png -o stripes.csv "
    "--overlay overlay\n"
    "  3. Copy configs/calibration.yaml, name your board pictures in it, and\n"
    "                                             lightstripe calibrate session.yaml -o rig.yaml\n"
    "  4. Copy configs/scan.yaml, name your scan's pictures in it, and\n"
    "                                             lightstripe reconstruct scan.yaml -o cloud.ply\n"
    "`lightstripe COMMAND --help` tells the options of a command; docs/how-to/ how to take the pictures.";

int run(int argc, char** argv) {
  CLI::App app{"lightstripe: calibrate laser-stripe rigs, reconstruct profiles, write point clouds",
               "lightstripe"};
  app.set_version_flag("--version", LIGHTSTRIPE_VERSION);
  app.require_subcommand(1);
  app.footer(kFirstSteps);
  lightstripe::Command command;
  lightstripe::add_demo_command(app, command);
  lightstripe::add_extract_command(app, command);
  lightstripe::add_calibrate_command(app, command);
  lightstripe::add_verify_command(app, command);
  lightstripe::add_reconstruct_command(app, command);
  lightstripe::add_merge_command(app, command);
  lightstripe::add_record_command(app, command);
  lightstripe::add_live_command(app, command);
  lightstripe::add_simulate_command(app, command);
  lightstripe::add_measure_command(app, command);
  lightstripe::add_conicity_command(app, command);
  lightstripe::add_bench_command(app, command);
  lightstripe::add_view_command(app, command);
  lightstripe::add_design_command(app, command);
  lightstripe::add_generate_command(app, command);
  if (argc < 2) {
    fmt::print(stderr, "{}", app.help());
    return lightstripe::kExitUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? lightstripe::kExitDone : lightstripe::kExitUsage;
  }
  return command();
}

}  // namespace

int main(int argc, char** argv) {
  // OpenCV's own lines on stderr say less than our one error line, and would stand before it.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  std::signal(SIGXFSZ, SIG_IGN);           // a limit on a file's size is an error of writing like a full disk
  FLAGS_minloglevel = google::GLOG_FATAL;  // Ceres tells of steps that it then takes back
  try {
    return run(argc, argv);
  } catch (const lightstripe::Error& error) {
    fmt::print(stderr, "error: {}\n", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: memory: not enough of it; use fewer --threads or smaller images\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: lightstripe: {}; this is a fault of the program, please report it\n",
               error.what());
  }
  return lightstripe::kExitInputWrong;
}
