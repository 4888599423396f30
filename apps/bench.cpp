// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/output_guard.h"
#include "io/tables.h"
#include "pipeline/job.h"
#include "truth/bench_methods.h"
#include "truth/bench_real.h"

namespace lightstripe {
namespace {

struct BenchArguments {
  CommonOptions common;
  std::vector<std::string> images;
  std::string labels;  ///< folder of labelled pictures; else `images`
  int repeat = 100;
  Overrides overrides;
};

int run_bench_labelled(const BenchArguments& arguments, const ExtractionOptions& options) {
  constexpr int kMostRepeats = 7, kSpecklePictures = 12;
  const auto scores = bench_labelled(arguments.labels, options, std::min(arguments.repeat, kMostRepeats));
  const std::string output = arguments.common.output.empty() ? "real_pictures.md" : arguments.common.output;
  const auto cameras = bench_other_cameras(arguments.labels, options);
  write_file(output, real_pictures_page(scores, cameras, bench_speckle(options, kSpecklePictures)));
  say(arguments.common, "-> " + output);
  return kExitDone;
}

int run_bench(const BenchArguments& arguments) {
  const JobThreads one_thread(1);
  const std::string output = arguments.common.output.empty() ? "bench.csv" : arguments.common.output;
  guard_outputs({arguments.images.begin(), arguments.images.end()}, {output});
  ExtractionOptions options;
  apply_overrides(options, arguments.overrides);
  if (!arguments.labels.empty()) return run_bench_labelled(arguments, options);
  std::string csv = "image,method,median_ms,points\n";
  std::string disagreements;
  for (const auto& file : arguments.images) {
    const Image8 image = read_image(file);
    const MethodTimes bench = bench_methods(image, options, arguments.repeat);
    say(arguments.common, fmt::format("{} ({} x {}, one thread, median of {})", file, image.width,
                                      image.height, arguments.repeat));
    for (const auto& timing : bench.timings)
      csv += fmt::format("{},{},{:.6f},{}\n", csv_cell(file), timing.method, timing.median_ms, timing.points);
    for (const std::string& line : describe_times(bench)) say(arguments.common, line);
    for (const auto& method : bench.disagreeing) disagreements += fmt::format(" {} in {};", method, file);
  }
  write_file(output, csv);
  say(arguments.common, "-> " + output);
  if (!disagreements.empty())
    return not_usable("these methods find other lines than steger, so their times mean little:" +
                      disagreements);
  return kExitDone;
}

}  // namespace

void add_bench_command(CLI::App& app, Command& run) {
  auto* command = app.add_subcommand("bench", "every extraction method on these images, timed on one thread");
  auto arguments = std::make_shared<BenchArguments>();
  auto* images = command->add_option("images", arguments->images, "image files");
  auto* labels =
      command->add_option("--labels", arguments->labels,
                          "folder of labelled pictures (<set>/<picture>.json): writes a page of how the "
                          "methods do on them, as other cameras would have taken them too, and on speckle");
  labels->excludes(images);
  add_common_options(*command, arguments->common,
                     "table of times (default: bench.csv; page: real_pictures.md)");
  command->add_option("--repeat", arguments->repeat, "runs of which the median is taken [100]")
      ->check(CLI::Range(1, 1000000));
  add_field_options<ExtractionOptions>(*command, "", arguments->overrides);
  command->callback([arguments, &run] {
    if (arguments->images.empty() && arguments->labels.empty()) throw CLI::RequiredError("images");
    run = [arguments] { return run_bench(*arguments); };
  });
}

}  // namespace lightstripe
