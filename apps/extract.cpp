// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/extract_job.h"

#include <fmt/format.h>

#include <mutex>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/progress.h"
#include "apps/table_style.h"
#include "core/counted.h"
#include "core/error.h"
#include "pipeline/overlay_files.h"
#include "report/explain_extraction.h"
#include "report/extraction_pictures.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct ExtractArguments {
  CommonOptions common;
  std::vector<std::string> images;
  std::string channel = "auto";
  std::string overlay_folder, background;
  bool explain = false;
  TableStyle style = TableStyle::kPlain;
  Overrides overrides;
};

Channel parse_channel(const std::string& text) {
  for (const auto& [value, name] : enum_names(Channel{}))
    if (name == text) return value;
  throw Error("--channel", "'" + text + "' is no channel",
              "use auto, gray, or red, green or blue, alone or with -excess, -laser, -clipped or -textured");
}

int run_extract(const ExtractArguments& arguments) {
  ExtractJob job;
  apply_overrides(job.extraction, arguments.overrides);
  job.images = arguments.images;
  job.channel = parse_channel(arguments.channel);
  job.background = arguments.background;
  job.threads = arguments.common.threads;
  if (!arguments.common.output.empty()) job.table = arguments.common.output;
  std::vector<fs::path> overlays;
  if (!arguments.overlay_folder.empty()) overlays = overlay_files(arguments.images, arguments.overlay_folder);
  job.other_outputs = overlays;
  if (arguments.explain)
    for (const fs::path& overlay : overlays) job.other_outputs.push_back(histogram_file(overlay));
  std::string lost_overlay;  // a picture that cannot be drawn does not cost the table
  std::mutex mutex;
  std::vector<std::string> explanations(arguments.explain ? job.images.size() : 0);
  job.on_image = [&](std::size_t i, const SeenImage& seen) {
    if (arguments.explain)
      explanations[i] = explain_extraction(job.images[i], seen.channel, job.extraction, seen.result);
    if (overlays.empty()) return;
    try {
      write_overlay(overlays[i], job.images[i], seen.result);
      if (arguments.explain) write_histogram(overlays[i], seen.image, seen.result);
    } catch (const Error& error) {
      const std::scoped_lock lock(mutex);
      if (lost_overlay.empty()) lost_overlay = error.what();
    }
  };
  if (arguments.explain) job.on_row = [&](std::size_t i) { say(arguments.common, explanations[i]); };
  const ExtractResult result = extract(job, progress_line(arguments.common.quiet));
  apply_table_style(job.table, arguments.style);
  for (const std::string& warning : result.warnings) warn(warning);
  say(arguments.common,
      fmt::format("{}, {}, {} -> {}", counted(result.images, "image"), counted(result.lines, "line"),
                  counted(result.points, "point"), job.table.string()));
  if (!lost_overlay.empty()) {
    say_error(lost_overlay);  // the table is written
    return kExitInputWrong;
  }
  if (!result.usable())
    return not_usable(fmt::format("no stripe was found in any image: {}; {}",
                                  what_it_looks_like(result.impression),
                                  what_to_do_about(result.impression)));
  return kExitDone;
}

}  // namespace

void add_extract_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("extract", "centre lines of the light stripes in single images");
  auto arguments = std::make_shared<ExtractArguments>();
  command->add_option("images", arguments->images, "image files")->required();
  add_common_options(*command, arguments->common, "table of points (default: stripes.csv)");
  add_table_style_option(*command, arguments->style);
  command->add_option("--channel", arguments->channel,
                      "of colour images: auto, gray, or red, green, blue, alone or with -excess, -laser, "
                      "-clipped, -textured");
  command->add_option(
      "--background", arguments->background,
      "picture with the laser off, or a pattern ('off/*.png') of one each with the same number");
  command->add_option("--overlay", arguments->overlay_folder, "folder for pictures with the lines drawn in");
  command->add_flag("--explain", arguments->explain,
                    "print how the thresholds came about; with --overlay also draw the histogram");
  add_field_options<ExtractionOptions>(*command, "", arguments->overrides);
  command->callback([arguments, &run] { run = [arguments] { return run_extract(*arguments); }; });
}

}  // namespace lightstripe
