// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The accuracy series of Chen, Zhang, Sun 2013, figure 5: one vertical stripe (s = 2.5 px, 512 x 512 px, 8
// bits) in noise of 5 to 40 % of full scale, 100 images a level. Prints a markdown table; with a file name
// also writes a plot (SVG).
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "stripe_scenes.h"

namespace lightstripe {
namespace {

constexpr int kTrials = 100;

struct Level {
  double noise = 0, plain = 0, smooth = 0;  ///< share of full scale; rms, px
  double found = 0;                         ///< share of the rows
  int lines = 0;
};

double squared_errors(const ExtractionResult& result) {
  double sum = 0;
  for (const Stripe& s : result.stripes)
    for (const StripePoint& p : s.points)
      sum += (p.x - scenes::kFigure5Centre) * (p.x - scenes::kFigure5Centre);
  return sum;
}

Level run(double noise, ExtractionWorkspace& workspace) {
  Level level;
  level.noise = noise;
  ExtractionOptions options;
  options.sigma = scenes::kFigure5Sigma;
  double points = 0;
  ExtractionResult result;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Image8 image = scenes::figure5_stripe(
        noise, Random(static_cast<std::uint64_t>(trial), static_cast<std::uint64_t>(1000 * noise)));
    options.smoothing = Smoothing::kNever;
    extract_stripes(image.view(), options, workspace, result);
    level.plain += squared_errors(result);
    level.lines += static_cast<int>(result.stripes.size());
    for (const Stripe& s : result.stripes) points += static_cast<double>(s.points.size());
    options.smoothing = Smoothing::kAlways;
    extract_stripes(image.view(), options, workspace, result);
    level.smooth += squared_errors(result);
  }
  level.plain = std::sqrt(level.plain / points);
  level.smooth = std::sqrt(level.smooth / points);
  level.found = points / (scenes::kFigure5Size * kTrials);
  return level;
}

std::string polyline(const std::vector<Level>& levels, double Level::*value, const char* colour) {
  std::string points;
  for (const Level& l : levels)
    points += std::to_string(60 + 1400 * l.noise) + "," + std::to_string(360 - 1200 * l.*value) + " ";
  return "<polyline fill='none' stroke-width='2' stroke='" + std::string(colour) + "' points='" + points +
         "'/>\n";
}

std::string text(double x, double y, const std::string& what, const char* colour = "#333") {
  return "<text font-family='sans-serif' font-size='13' fill='" + std::string(colour) + "' x='" +
         std::to_string(x) + "' y='" + std::to_string(y) + "'>" + what + "</text>\n";
}

void write_plot(const std::vector<Level>& levels, const char* path) {
  std::ofstream svg(path);
  svg << "<svg xmlns='http://www.w3.org/2000/svg' width='680' height='420'>\n<rect width='680' height='420' "
         "fill='white'/>\n<path d='M60 20V360H660' fill='none' stroke='#333'/>\n";
  for (int k = 1; k <= 8; ++k) svg << text(50 + 70 * k, 378, std::to_string(5 * k) + " %");
  for (int k = 0; k <= 5; ++k) svg << text(22, 364 - 60 * k, "0." + std::to_string(5 * k + 100).substr(1));
  svg << text(200, 402, "noise, share of full scale") << text(66, 32, "rms error of the centre, px");
  svg << polyline(levels, &Level::plain, "#c33") << polyline(levels, &Level::smooth, "#26c");
  svg << text(400, 70, "direction-guided", "#c33") << text(400, 290, "with smoothing along the line", "#26c")
      << "</svg>\n";
}

}  // namespace
}  // namespace lightstripe

int main(int argc, char** argv) {
  using lightstripe::Level;
  lightstripe::ExtractionWorkspace workspace;
  std::vector<Level> levels;
  std::printf("| noise | rms, px | smoothed, px | found | lines an image |\n|---:|---:|---:|---:|---:|\n");
  for (int k = 1; k <= 8; ++k) {
    const Level l = lightstripe::run(0.05 * k, workspace);
    levels.push_back(l);
    std::printf("| %.0f %% | %.4f | %.4f | %.2f %% | %.2f |\n", 100 * l.noise, l.plain, l.smooth,
                100 * l.found, static_cast<double>(l.lines) / lightstripe::kTrials);
  }
  if (argc > 1) lightstripe::write_plot(levels, argv[1]);
}
