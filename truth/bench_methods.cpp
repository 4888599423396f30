// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/bench_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>

#include "core/robust.h"
#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "truth/bench_references.h"

namespace lightstripe {
namespace {

/// Something to time, and what is known of its results.
struct Candidate {
  MethodTime timing;
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

MethodTime& add(std::vector<Candidate>& candidates, std::string name, std::function<void()> work) {
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
    MethodTime& timing = add(candidates, std::string(name), work);
    timing.points = points.size();
    timing.found = found;
    timing.besides = besides;
  }
}

void add_references(ImageView8 image, double sigma, double min_strength, Image8& target,
                    std::vector<Candidate>& candidates) {
  const auto kept = std::make_shared<OpenCvSteger>();
  const std::size_t points = steger_by_opencv(image, sigma, min_strength, *kept).size();
  const auto add_steger = [&](std::string_view name, const std::function<void()>& work) {
    add(candidates, std::string(name), work).points = points;
  };
  add_steger(kOpenCvSteger, [=] {
    OpenCvSteger fresh;
    steger_by_opencv(image, sigma, min_strength, fresh);
  });
  add_steger(kOpenCvStegerKept, [=] { steger_by_opencv(image, sigma, min_strength, *kept); });
  add(candidates, "opencv-calchist", [=] { calchist_by_opencv(image); });
  add(candidates, "opencv-gaussianblur", [=, &target] { gaussianblur_by_opencv(image, sigma, target); });
  add(candidates, "memcpy", [=, &target] {
    for (int y = 0; y < image.height; ++y)
      std::memcpy(target.row(y), image.row(y), static_cast<std::size_t>(image.width));
  });
}

double steger_time(const MethodTimes& bench) {
  const auto row = std::find_if(bench.timings.begin(), bench.timings.end(),
                                [](const auto& t) { return t.method == kOpenCvSteger; });
  return row->median_ms;
}

std::string table_row(const MethodTime& t, double steger_ms) {
  std::string row = fmt::format("  {:<20} {:>10.4f} ms {:>8.1f} x opencv-steger's speed", t.method,
                                t.median_ms, steger_ms / t.median_ms);
  if (t.found)
    row += fmt::format(" {:>6} points, {:.1f} % of steger's, {:.1f} % besides", t.points, 100 * *t.found,
                       100 * *t.besides);
  return row;
}

}  // namespace

MethodTimes bench_methods(ImageView8 image, ExtractionOptions options, int repeat) {
  const ExtractionResult found = extract_stripes(image, options);
  const double sigma = found.sigma > 0 ? found.sigma : 2.0;
  // The width is fixed for the timing, as it is in a scan whose rig is known.
  if (!options.sigma && !options.stripe_width) options.sigma = sigma;
  double weakest = 1e9;
  for (const auto& p : all_points(found.stripes)) weakest = std::min(weakest, p.strength);

  MethodTimes bench;
  std::vector<Candidate> candidates;
  Image8 target(image.width, image.height);
  add_methods(image, options, candidates, bench.disagreeing);
  add_references(image, sigma, weakest < 1e9 ? 0.5 * weakest : 1.0, target, candidates);
  time_in_rounds(candidates, repeat);
  for (auto& candidate : candidates) bench.timings.push_back(std::move(candidate.timing));
  return bench;
}

std::vector<std::string> describe_times(const MethodTimes& times) {
  std::vector<std::string> lines;
  for (const MethodTime& time : times.timings) lines.push_back(table_row(time, steger_time(times)));
  return lines;
}

}  // namespace lightstripe
