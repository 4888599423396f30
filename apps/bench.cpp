// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

#include "apps/bench_real.h"
#include "apps/bench_references.h"
#include "apps/command.h"
#include "apps/options.h"
#include "core/error.h"
#include "core/robust.h"
#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "io/atomic_file.h"
#include "io/images.h"
#include "io/output_guard.h"
#include "io/tables.h"
#include "pipeline/job.h"

namespace lightstripe {
namespace {

struct BenchArguments {
  CommonOptions common;
  std::vector<std::string> images;
  std::string labels;  ///< folder of labelled pictures; else `images`
  int repeat = 100;
  Overrides overrides;
};

struct Timing {
  std::string method;
  double median_ms = 0;
  std::size_t points = 0;
  // Of extraction methods only:
  std::optional<double> found;    ///< part of the reference's points that this method finds
  std::optional<double> besides;  ///< part of its own points that the reference does not have
};

/// Something to time, and what is known of its results.
struct Candidate {
  Timing timing;
  std::function<void()> work;
  std::vector<double> times_ms;
};

constexpr int kRounds = 10;

/// Medians of the repeats. They are taken in rounds over all candidates, so that a slow phase of the machine
/// hits all alike; each begins its turn with a run that warms its caches and buffers.
void time_in_rounds(std::vector<Candidate>& candidates, int repeat) {
  const int rounds = std::min(kRounds, repeat);
  for (int round = 0; round < rounds; ++round)
    for (auto& candidate : candidates) {
      candidate.work();
      for (int i = round * repeat / rounds; i < (round + 1) * repeat / rounds; ++i) {
        const auto start = std::chrono::steady_clock::now();
        candidate.work();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        candidate.times_ms.push_back(taken.count());
      }
    }
  for (auto& [timing, work, times] : candidates) {
    timing.median_ms = upper_median(times);
  }
}

std::vector<StripePoint> all_points(const std::vector<Stripe>& stripes) {
  std::vector<StripePoint> points;
  for (const auto& stripe : stripes) points.insert(points.end(), stripe.points.begin(), stripe.points.end());
  return points;
}

/// The part of `points` that has a point of `others` within a pixel and a half.
double agreement(const std::vector<StripePoint>& points, const std::vector<StripePoint>& others,
                 ImageView8 image) {
  constexpr int kReach = 1;
  Image8 marked(image.width, image.height);
  for (const auto& p : others) {
    const int x = static_cast<int>(std::lround(p.x)), y = static_cast<int>(std::lround(p.y));
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx)
        if (marked.view().contains(x + dx, y + dy)) marked(x + dx, y + dy) = 1;
  }
  std::size_t found = 0;
  for (const auto& p : points) {
    const int x = static_cast<int>(std::lround(p.x)), y = static_cast<int>(std::lround(p.y));
    if (marked.view().contains(x, y) && marked(x, y) != 0) ++found;
  }
  return points.empty() ? 1.0 : static_cast<double>(found) / static_cast<double>(points.size());
}

struct ImageBench {
  std::vector<Timing> timings;
  std::vector<std::string> disagreements;
};

/// What a method has to share with the reference before its time means something.
struct RequiredAgreement {
  double found = 0.9;    ///< part of the reference's points that the method finds
  double besides = 0.1;  ///< part of its own points that the reference does not have
};

/// The grey-value methods take one point a row or column, Zhou's sees nothing below Otsu's threshold: what
/// they lose by their idea is shown, not refused.
RequiredAgreement required_agreement(ExtractionMethod method) {
  switch (method) {
    case ExtractionMethod::kCentroid:
    case ExtractionMethod::kExtremum:
      return {0.0, 1.0};
    case ExtractionMethod::kZhouRoi:
      return {0.0, 0.1};
    default:
      return {};
  }
}

Timing& add(std::vector<Candidate>& candidates, std::string name, std::function<void()> work) {
  Candidate& candidate = candidates.emplace_back();
  candidate.timing.method = std::move(name);
  candidate.work = std::move(work);
  return candidate.timing;
}

/// What one method of ours keeps from frame to frame.
struct MethodRun {
  ExtractionOptions options;
  ExtractionWorkspace workspace;
  ExtractionResult result;
};

void add_methods(ImageView8 image, ExtractionOptions options, std::vector<Candidate>& candidates,
                 std::vector<std::string>& disagreements) {
  options.method = ExtractionMethod::kSteger;
  const auto reference = all_points(extract_stripes(image, options).stripes);
  for (const auto& [method, name] : enum_names(ExtractionMethod{})) {
    const auto run = std::make_shared<MethodRun>();
    run->options = options;
    run->options.method = method;
    const auto work = [image, run] { extract_stripes(image, run->options, run->workspace, run->result); };
    work();
    const auto points = all_points(run->result.stripes);
    const double found = agreement(reference, points, image);
    const double besides = 1 - agreement(points, reference, image);
    const RequiredAgreement required = required_agreement(method);
    if (found < required.found || besides > required.besides) disagreements.emplace_back(name);
    Timing& timing = add(candidates, std::string(name), work);
    timing.points = points.size();
    timing.found = found;
    timing.besides = besides;
  }
}

void add_references(ImageView8 image, double sigma, double min_strength, Image8& target,
                    std::vector<Candidate>& candidates) {
  const std::size_t points = steger_by_opencv(image, sigma, min_strength).size();
  add(candidates, "opencv-steger", [=] { steger_by_opencv(image, sigma, min_strength); }).points = points;
  add(candidates, "opencv-calchist", [=] { calchist_by_opencv(image); });
  add(candidates, "opencv-gaussianblur", [=, &target] { gaussianblur_by_opencv(image, sigma, target); });
  add(candidates, "memcpy", [=, &target] {
    for (int y = 0; y < image.height; ++y)
      std::memcpy(target.row(y), image.row(y), static_cast<std::size_t>(image.width));
  });
}

ImageBench bench_image(ImageView8 image, ExtractionOptions options, int repeat) {
  const ExtractionResult found = extract_stripes(image, options);
  const double sigma = found.sigma > 0 ? found.sigma : 2.0;
  // The width is fixed for the timing, as it is in a scan whose rig is known.
  if (!options.sigma && !options.stripe_width) options.sigma = sigma;
  double weakest = 1e9;
  for (const auto& p : all_points(found.stripes)) weakest = std::min(weakest, p.strength);

  ImageBench bench;
  std::vector<Candidate> candidates;
  Image8 target(image.width, image.height);
  add_methods(image, options, candidates, bench.disagreements);
  add_references(image, sigma, weakest < 1e9 ? 0.5 * weakest : 1.0, target, candidates);
  time_in_rounds(candidates, repeat);
  for (auto& candidate : candidates) bench.timings.push_back(std::move(candidate.timing));
  return bench;
}

double steger_time(const ImageBench& bench) {
  const auto row = std::find_if(bench.timings.begin(), bench.timings.end(),
                                [](const auto& t) { return t.method == "opencv-steger"; });
  return row->median_ms;
}

std::string table_row(const Timing& t, double steger_ms) {
  std::string row = fmt::format("  {:<20} {:>10.4f} ms {:>8.1f} x opencv-steger's speed", t.method,
                                t.median_ms, steger_ms / t.median_ms);
  if (t.found)
    row += fmt::format(" {:>6} points, {:.1f} % of steger's, {:.1f} % besides", t.points, 100 * *t.found,
                       100 * *t.besides);
  return row;
}

int run_bench_labelled(const BenchArguments& arguments, const ExtractionOptions& options) {
  constexpr int kMostRepeats = 7, kSpecklePictures = 12;
  const auto scores = bench_labelled(arguments.labels, options, std::min(arguments.repeat, kMostRepeats));
  const std::string output = arguments.common.output.empty() ? "real_pictures.md" : arguments.common.output;
  write_file(output, real_pictures_page(scores, bench_speckle(options, kSpecklePictures)));
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
    const ImageBench bench = bench_image(image, options, arguments.repeat);
    say(arguments.common, fmt::format("{} ({} x {}, one thread, median of {})", file, image.width,
                                      image.height, arguments.repeat));
    for (const auto& timing : bench.timings) {
      csv += fmt::format("{},{},{:.6f},{}\n", csv_cell(file), timing.method, timing.median_ms, timing.points);
      say(arguments.common, table_row(timing, steger_time(bench)));
    }
    for (const auto& method : bench.disagreements) disagreements += fmt::format(" {} in {};", method, file);
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
                          "methods do on them and on speckle");
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
