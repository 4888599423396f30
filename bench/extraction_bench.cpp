// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Times of the extraction, one thread: the paper's four scenes by every method and by OpenCV's building
// blocks, image sizes, numbers of lines. Every result is checked against the known lines before it is timed.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/core/utility.hpp>
#include <string>

#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "truth/bench_references.h"
#include "whole_scenes.h"

namespace lightstripe {
namespace {

constexpr double kSigma = 3.0;  // px

struct BenchScene {
  Image8 image;
  std::vector<scenes::Curve> truth;
};

BenchScene paper_kind(int kind) {
  const scenes::Scene scene = scenes::paper_scene(kind, kSigma);
  return {scene.canvas.exposed(2, 0.05, 7), scene.truth};
}

/// Slightly wavy lines over the whole width.
BenchScene wavy_lines(int width, int height, int lines) {
  scenes::Canvas canvas(width, height, 5);
  BenchScene scene;
  for (int k = 0; k < lines; ++k) {
    const double y = height * (k + 0.5) / lines;
    scene.truth.push_back(scenes::make_curve(
        [&](double u) {
          return scenes::CurvePoint{5 + (width - 11) * u, y + 0.012 * height * std::sin(5 * u), 160, kSigma};
        },
        6 * width));
    canvas.add(scene.truth.back());
  }
  scene.image = canvas.exposed(2, 0.05, 7);
  return scene;
}

ExtractionOptions options_for(ExtractionMethod method) {
  ExtractionOptions options;
  options.method = method;
  options.sigma = kSigma;
  return options;
}

/// What is wrong with a result; empty if nothing. Methods that see nothing below a threshold lose dark
/// stretches by their idea.
std::string complaint(const BenchScene& scene, const ExtractionResult& result, ExtractionMethod method) {
  const scenes::Score score = scenes::score(scene.truth, result.stripes);
  const bool whole = method == ExtractionMethod::kDirectionGuided;
  if (score.completeness < (whole ? 0.99 : 0.7)) return "incomplete: " + std::to_string(score.completeness);
  if (score.false_points > score.points / 100) return "false points: " + std::to_string(score.false_points);
  return "";
}

void time_extraction(benchmark::State& state, const BenchScene& scene, ExtractionMethod method) {
  const ExtractionOptions options = options_for(method);
  ExtractionWorkspace workspace;
  ExtractionResult result;
  extract_stripes(scene.image.view(), options, workspace, result);
  if (const std::string wrong = complaint(scene, result, method); !wrong.empty()) {
    state.SkipWithError(wrong.c_str());
    return;
  }
  for (auto _ : state) {
    extract_stripes(scene.image.view(), options, workspace, result);
    benchmark::DoNotOptimize(result.stripes.data());
  }
  const double pixels = static_cast<double>(scene.image.pixels.size());
  state.counters["megapixels"] = pixels * 1e-6;
}

/// What OpenCV and memcpy need for the same image: rows to compare with.
using Reference = void (*)(const BenchScene& scene, Image8& target);
struct NamedReference {
  const char* name;
  Reference run;
};

/// Half the matched strength of the scenes' dimmest line: all lines and little else.
void run_opencv_steger(const BenchScene& scene, Image8&) {
  constexpr double kDimmest = 40;  // grey levels
  OpenCvSteger fresh;
  benchmark::DoNotOptimize(
      steger_by_opencv(scene.image.view(), kSigma, 0.5 * kDimmest / (2.83 * kSigma * kSigma), fresh).data());
}
void run_calchist(const BenchScene& scene, Image8&) { calchist_by_opencv(scene.image.view()); }
void run_gaussianblur(const BenchScene& scene, Image8& target) {
  gaussianblur_by_opencv(scene.image.view(), kSigma, target);
}
void run_memcpy(const BenchScene& scene, Image8& target) {
  std::memcpy(target.pixels.data(), scene.image.pixels.data(), scene.image.pixels.size());
  benchmark::ClobberMemory();
}
constexpr std::array<NamedReference, 4> kReferences{{{"opencv-steger", run_opencv_steger},
                                                     {"opencv-calchist", run_calchist},
                                                     {"opencv-gaussianblur", run_gaussianblur},
                                                     {"memcpy", run_memcpy}}};

void time_reference(benchmark::State& state, const BenchScene& scene, Reference run) {
  Image8 target(scene.image.width, scene.image.height);
  for (auto _ : state) run(scene, target);
}

void register_scenes() {
  constexpr std::array<const char*, 4> kNames{"wheel_2", "plate_2_crossed", "pipe_3", "rail_5"};
  for (int kind = 0; kind < 4; ++kind) {
    const auto scene = std::make_shared<BenchScene>(paper_kind(kind));
    const std::string name = std::string("scenes/") + kNames[static_cast<std::size_t>(kind)] + "/";
    for (const auto& [method, method_name] : enum_names(ExtractionMethod{}))
      benchmark::RegisterBenchmark(
          (name + std::string(method_name)).c_str(),
          [scene, m = method](benchmark::State& s) { time_extraction(s, *scene, m); });
    for (const NamedReference& reference : kReferences)
      benchmark::RegisterBenchmark(
          (name + reference.name).c_str(),
          [scene, run = reference.run](benchmark::State& s) { time_reference(s, *scene, run); });
  }
}

void register_sizes_and_lines() {
  const auto guided = [](const std::string& name, int width, int height, int lines) {
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& s) {
      time_extraction(s, wavy_lines(width, height, lines), ExtractionMethod::kDirectionGuided);
    });
  };
  guided("size/0.3_MP", 640, 480, 1);
  guided("size/0.7_MP", 960, 700, 1);
  guided("size/2_MP", 1920, 1080, 1);
  guided("size/12_MP", 4000, 3000, 1);
  for (const int lines : {1, 2, 5, 10, 20}) guided("lines/" + std::to_string(lines), 960, 700, lines);
}

}  // namespace
}  // namespace lightstripe

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  lightstripe::register_scenes();
  lightstripe::register_sizes_and_lines();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::SetDefaultTimeUnit(benchmark::kMillisecond);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
