// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/extract_stripes.h"

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "apps/command.h"
#include "apps/explain.h"
#include "apps/progress.h"
#include "core/error.h"
#include "core/task_order.h"
#include "extraction/draw/histogram_plot.h"
#include "extraction/draw/overlay.h"
#include "extraction/workspace.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/tables.h"

namespace lightstripe {
namespace {

namespace fs = std::filesystem;

struct ExtractArguments {
  CommonOptions common;
  std::vector<std::string> images;
  std::string channel = "auto";
  std::string overlay_folder;
  bool explain = false;
  Overrides overrides;
};

/// One picture a name; pictures of the same name from several folders keep apart by the folder's name in
/// front.
std::vector<fs::path> overlay_names(const std::vector<std::string>& images, const fs::path& folder) {
  std::vector<fs::path> names;
  std::set<std::string> taken;
  for (const auto& image : images) {
    const fs::path path(image);
    std::string name = path.stem().string();
    if (taken.contains(name)) name = path.parent_path().filename().string() + "_" + name;
    for (int copy = 2; taken.contains(name); ++copy) name = fmt::format("{}_{}", path.stem().string(), copy);
    taken.insert(name);
    names.push_back(folder / (name + ".png"));
  }
  return names;
}

Channel parse_channel(const std::string& text) {
  for (const auto& [value, name] : enum_names(Channel{}))
    if (name == text) return value;
  throw Error("--channel", "'" + text + "' is no channel",
              "use auto, gray, or red, green or blue, alone or with -excess, -laser or -clipped");
}

struct Extracted {
  std::string rows;
  std::string explanation;
  std::size_t lines = 0, points = 0;
};

/// What one thread keeps from image to image.
struct ExtractMemory {
  ExtractionWorkspace workspace;
  ExtractionResult result;
};

Extracted extract_one(const std::string& file, Channel channel, const ExtractionOptions& options,
                      const std::optional<fs::path>& overlay, bool explain, ExtractMemory& memory) {
  Channel chosen = channel;
  const GreyImage image = read_grey_image(file, channel, &chosen);
  std::visit(
      [&](const auto& pixels) { extract_stripes(pixels.view(), options, memory.workspace, memory.result); },
      image);
  const ExtractionResult& result = memory.result;
  Extracted out;
  append_stripes(out.rows, file, result.stripes);
  out.lines = result.stripes.size();
  for (const auto& stripe : result.stripes) out.points += stripe.points.size();
  if (overlay) {
    RgbImage picture = read_rgb_image(file);
    draw_stripes(picture.pixels, picture.width, picture.height, result.stripes);
    write_rgb_image(*overlay, picture.pixels, picture.width, picture.height);
  }
  if (!explain) return out;
  out.explanation = explain_extraction(file, chosen, options, result);
  if (overlay) {
    fs::path picture = *overlay;
    picture.replace_filename(overlay->stem().string() + "_histogram.png");
    const Histogram histogram =
        std::visit([](const auto& pixels) { return compute_histogram(pixels.view()); }, image);
    write_rgb_image(picture, draw_histogram(histogram, result), kHistogramPlotWidth, kHistogramPlotHeight);
  }
  return out;
}

int run_extract(const ExtractArguments& arguments) {
  const ThreadLimit limit(arguments.common);
  ExtractionOptions options;
  apply_overrides(options, arguments.overrides);
  const Channel channel = parse_channel(arguments.channel);
  std::vector<fs::path> overlays;
  if (!arguments.overlay_folder.empty()) overlays = overlay_names(arguments.images, arguments.overlay_folder);
  const std::size_t total = arguments.images.size();
  const std::size_t batch =
      2 * static_cast<std::size_t>(thread_count(arguments.common));  // bounds the memory

  AtomicFile file(arguments.common.output.empty() ? "stripes.csv" : arguments.common.output);
  std::ofstream table(file.temporary(), std::ios::binary);
  table << kStripesHeader;
  Progress progress("extracting", "images", static_cast<std::int64_t>(total), arguments.common.quiet);
  oneapi::tbb::enumerable_thread_specific<ExtractMemory> memories;
  std::size_t lines = 0, points = 0;
  for (std::size_t begin = 0; begin < total; begin += batch) {
    std::vector<Extracted> results(std::min(batch, total - begin));
    const auto extract_image = [&](std::size_t i) {
      const std::size_t index = begin + i;
      results[i] = extract_one(arguments.images[index], channel, options,
                               overlays.empty() ? std::nullopt : std::optional(overlays[index]),
                               arguments.explain, memories.local());
      progress.step();
    };
    before_tasks();
    oneapi::tbb::parallel_for(std::size_t{0}, results.size(), Task(extract_image));
    after_tasks();
    for (const auto& result : results) {
      table << result.rows;
      if (!result.explanation.empty()) say(arguments.common, result.explanation);
      lines += result.lines;
      points += result.points;
    }
  }
  table.close();
  if (!table) throw Error(file.path().string(), "writing failed", "check the disk's free space");
  file.commit();
  say(arguments.common,
      fmt::format("{} images, {} lines, {} points -> {}", total, lines, points, file.path().string()));
  if (points == 0)
    return not_usable(
        "no stripe was found in any image; look at exposure and --channel, or give --stripe-width and "
        "--thresholds");
  return kExitDone;
}

}  // namespace

void add_extract_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("extract", "centre lines of the light stripes in single images");
  auto arguments = std::make_shared<ExtractArguments>();
  command->add_option("images", arguments->images, "image files")->required();
  add_common_options(*command, arguments->common, "table of points (default: stripes.csv)");
  command->add_option(
      "--channel", arguments->channel,
      "of colour images: auto, gray, or red, green, blue, alone or with -excess, -laser, -clipped");
  command->add_option("--overlay", arguments->overlay_folder, "folder for pictures with the lines drawn in");
  command->add_flag("--explain", arguments->explain,
                    "print how the thresholds came about; with --overlay also draw the histogram");
  add_field_options<ExtractionOptions>(*command, "", arguments->overrides);
  command->callback([arguments, &run] { run = [arguments] { return run_extract(*arguments); }; });
}

}  // namespace lightstripe
