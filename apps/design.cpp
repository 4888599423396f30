// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/number_text.h"
#include "report/design_text.h"

namespace lightstripe {
namespace {

struct DesignArguments {
  CommonOptions common;
  SensorDesign design;
  std::string image = "960x700";
};

void parse_image(const std::string& text, SensorDesign& design) {
  const std::size_t x = text.find('x');
  const auto along = parse_integer(text.substr(0, x));
  const auto across = x == std::string::npos ? std::nullopt : parse_integer(text.substr(x + 1));
  if (!along || !across || *along < 1 || *across < 1 || *along > 100000 || *across > 100000)
    throw Error("--image", "'" + text + "' is no size",
                "give pixels along the stripe x pixels across it: 960x700");
  design.along_px = static_cast<int>(*along), design.across_px = static_cast<int>(*across);
}

int run_design(DesignArguments arguments) {
  parse_image(arguments.image, arguments.design);
  const std::string text = describe_design(arguments.design, design_sensor(arguments.design));
  if (arguments.common.output.empty())
    print_result(text);
  else
    write_file(arguments.common.output, text);
  return kExitDone;
}

}  // namespace

void add_design_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("design", "range, resolution and noise of a sensor before it is built");
  auto arguments = std::make_shared<DesignArguments>();
  SensorDesign& design = arguments->design;
  command->add_option("--distance", design.distance_mm,
                      "from the camera to the laser plane along the axis, mm [550]");
  command->add_option("--angle", design.angle_deg,
                      "triangulation angle, between axis and laser plane, degrees [40]");
  command->add_option("--focal", design.focal_px, "focal length, px: mm of the lens over mm a pixel [1640]");
  command->add_option("--image", arguments->image, "pixels along the stripe x pixels across it [960x700]");
  command->add_option("--noise", design.noise_px, "error of the stripe in the image, px, 1 sigma [0.05]");
  add_common_options(*command, arguments->common, "text file (default: standard output)");
  command->callback([arguments, &run] { run = [arguments] { return run_design(*arguments); }; });
}

}  // namespace lightstripe
