// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "truth/bench_real.h"

#include <algorithm>
#include <chrono>
#include <functional>

#include "core/robust.h"
#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "io/images.h"
#include "simulate/real_stripe.h"
#include "truth/bench_references.h"
#include "truth/other_cameras.h"

namespace lightstripe {
namespace {

double median_ms(int repeat, const std::function<void()>& work) {
  std::vector<double> times;
  for (int i = 0; i < repeat; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return upper_median(times);
}

SpeckleScore speckle_score(const RealStripe& truth, ExtractionOptions options, int pictures) {
  RealScore plain, smooth;
  for (int k = 1; k <= pictures; ++k) {
    const Image8 image = picture_of(truth, static_cast<std::uint64_t>(k));
    options.smoothing = Smoothing::kNever;
    add_to(plain, truth, extract_stripes(image.view(), options).stripes);
    options.smoothing = Smoothing::kAlways;
    add_to(smooth, truth, extract_stripes(image.view(), options).stripes);
  }
  return {truth.speckle.contrast,
          truth.speckle.grain_px,
          truth.sigma,
          plain.completeness(),
          static_cast<std::int64_t>(plain.false_points),
          plain.rms(),
          smooth.rms(),
          plain.variance_ratio(),
          smooth.variance_ratio()};
}

}  // namespace

std::vector<MethodScore> bench_labelled(const std::filesystem::path& folder, const ExtractionOptions& options,
                                        int repeat) {
  const auto pictures = read_labelled_pictures(folder);
  constexpr auto kMethods = enum_names(ExtractionMethod{});
  std::vector<std::vector<MethodScore>> by_method(kMethods.size());
  ExtractionWorkspace workspace;
  OpenCvSteger kept;
  ExtractionResult result;
  for (const LabelledPicture& picture : pictures) {
    const Image8 image = read_image(picture.file);
    double steger_ms = 0;
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
      ExtractionOptions of_method = options;
      of_method.method = kMethods.at(m).value;
      extract_stripes(image.view(), of_method, workspace, result);
      MethodScore score{std::string(kMethods.at(m).name), picture.set, picture.file.filename().string(),
                        score_lines(picture.lines, result.stripes)};
      if (m == 0) {
        explain_score(picture.lines, result.stripes, image.view(), result.noise, score.score);
        const double sigma = result.sigma > 0 ? std::min(result.sigma, 4.0) : 2.0;
        steger_ms = median_ms(repeat, [&] { steger_by_opencv(image.view(), sigma, 1.0, kept); });
      }
      score.median_ms =
          median_ms(repeat, [&] { extract_stripes(image.view(), of_method, workspace, result); });
      score.steger_ms = steger_ms;
      by_method[m].push_back(std::move(score));
    }
  }
  std::vector<MethodScore> all;
  for (auto& scores : by_method) std::move(scores.begin(), scores.end(), std::back_inserter(all));
  return all;
}

std::vector<MethodScore> bench_other_cameras(const std::filesystem::path& folder,
                                             const ExtractionOptions& options) {
  std::vector<MethodScore> scores;
  for (const LabelledPicture& picture : read_labelled_pictures(folder)) {
    const RgbImage pixels = read_rgb_image(picture.file);
    for (const OtherCamera& camera : other_cameras()) {
      const auto found = extract_stripes(imitated(camera, pixels).view(), options);
      scores.push_back({std::string(camera.name), picture.set, picture.file.filename().string(),
                        score_lines(picture.lines, found.stripes)});
    }
  }
  return scores;
}

std::vector<SpeckleScore> bench_speckle(const ExtractionOptions& options, int pictures) {
  std::vector<SpeckleScore> scores;
  for (const double contrast : {0.15, 0.3, 0.5})
    for (const double grain : {0.8, 1.6})
      for (const double sigma : {2.0, 4.0}) {
        RealStripe truth;
        truth.speckle = {contrast, grain};
        truth.sigma = sigma;
        scores.push_back(speckle_score(truth, options, pictures));
      }
  return scores;
}

}  // namespace lightstripe
