// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <glog/logging.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <opencv2/core/utils/logger.hpp>

#include "apps/command.h"
#include "apps/interrupt.h"
#include "apps/self_description.h"
#include "core/error.h"
#include "io/edit_distance.h"

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

std::string command_line_help(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  return "`lightstripe " + (parsed.empty() ? std::string() : parsed.front()->get_name() + " ") + "--help`";
}

/// ", did you mean ...?" where a name is near.
std::string suggestion(const std::string& given, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 64;
  if (given.size() > kLongest) return "";
  std::string nearest;
  std::size_t least = given.size() / 3 + 2;
  for (const std::string& name : names)
    if (const std::size_t distance = lightstripe::edit_distance(given, name); distance < least) {
      least = distance;
      nearest = name;
    }
  return nearest.empty() ? "" : ", did you mean " + nearest + "?";
}

/// "Could not convert: --threads = abc" -> "--threads: 'abc' is no number".
std::string in_our_words(const CLI::ParseError& error) {
  std::string text = error.what();
  const std::string head = "Could not convert: ";
  const std::size_t equals = text.find(" = ");
  if (!text.starts_with(head) || equals == std::string::npos) return text;
  const std::string value = text.substr(equals + 3);
  return text.substr(head.size(), equals - head.size()) + ": '" + value + "' is no number";
}

int unknown_arguments(const CLI::App& app) {
  const auto parsed = app.get_subcommands();
  const auto extras = app.remaining(true);
  const std::string first = extras.empty() ? "" : extras.front();
  std::vector<std::string> names;
  if (!parsed.empty())
    for (const CLI::Option* option : parsed.front()->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string name = first.substr(0, first.find('='));
  lightstripe::say_error(
      first + (first.starts_with("-") ? ": is no option here" : ": is one argument too many") +
      (first.starts_with("-") ? suggestion(name, names) : "") + "; see " + command_line_help(app));
  return lightstripe::kExitUsage;
}

/// The first option or argument with an empty value, as a shell variable that is not set gives one: taken for
/// "not given", it would write a default output where another was meant.
std::string empty_argument(const CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands())
    for (const CLI::Option* option : command->get_options())
      for (const std::string& value : option->results())
        if (value.empty()) return option->get_name();
  return "";
}

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
  lightstripe::name_types(app);
  if (argc < 2) {
    std::fputs(app.help().c_str(), stderr);
    return lightstripe::kExitUsage;
  }
  std::vector<std::string> names;
  bool known = false;
  for (const CLI::App* subcommand : app.get_subcommands({})) {
    known = known || subcommand->check_name(argv[1]);
    if (!subcommand->get_group().empty()) names.push_back(subcommand->get_name());
  }
  if (argv[1][0] != '-' && !known) {
    lightstripe::say_error(std::string(argv[1]) + ": is no command" + suggestion(argv[1], names) +
                           "; lightstripe --help lists them");
    return lightstripe::kExitUsage;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    return unknown_arguments(app);
  } catch (const CLI::RequiredError& error) {
    // A mistyped option is told before what it seems to leave out.
    const auto extras = app.remaining(true);
    if (!extras.empty() && extras.front().starts_with("-")) return unknown_arguments(app);
    lightstripe::say_error(in_our_words(error) + "; see " + command_line_help(app));
    return lightstripe::kExitUsage;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    lightstripe::say_error(in_our_words(error) + "; see " + command_line_help(app));
    return lightstripe::kExitUsage;
  }
  if (const std::string name = empty_argument(app); !name.empty()) {
    lightstripe::say_error(name + ": is empty; give it a value, or leave it out");
    return lightstripe::kExitUsage;
  }
  return command();
}

/// A process that was started with closed standard streams would open its results in their place, and write
/// its messages into them.
void open_standard_streams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (::fcntl(descriptor, F_GETFD) == -1) {
      const int opened = ::open("/dev/null", descriptor == 0 ? O_RDONLY : O_WRONLY);
      if (opened >= 0 && opened != descriptor) {
        ::dup2(opened, descriptor);
        ::close(opened);
      }
    }
}

}  // namespace

int main(int argc, char** argv) {
  // OpenCV's own lines on stderr say less than our one error line, and would stand before it.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // likewise those of its video reader
  open_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);  // messages that nobody reads never cost a result
  lightstripe::clean_up_at_signals();
  std::signal(SIGXFSZ, SIG_IGN);           // a limit on a file's size is an error of writing like a full disk
  FLAGS_minloglevel = google::GLOG_FATAL;  // Ceres tells of steps that it then takes back
  try {
    return run(argc, argv);
  } catch (const lightstripe::Error& error) {
    lightstripe::say_error(error.what());
  } catch (const std::bad_alloc&) {
    lightstripe::say_error("memory: not enough of it; use fewer --threads or smaller images");
  } catch (const std::exception& error) {
    lightstripe::say_error(std::string("lightstripe: ") + error.what() +
                           "; this is a fault of the program, please report it");
  }
  return lightstripe::kExitInputWrong;
}
