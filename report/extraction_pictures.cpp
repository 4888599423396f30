// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/extraction_pictures.h"

#include <string>
#include <variant>

#include "extraction/draw/histogram_plot.h"
#include "extraction/draw/overlay.h"
#include "io/images.h"

namespace lightstripe {

namespace fs = std::filesystem;

void write_overlay(const fs::path& file, const fs::path& image, const ExtractionResult& result) {
  RgbImage picture = read_rgb_image(image);
  draw_stripes(picture.pixels, picture.width, picture.height, result.stripes);
  write_rgb_image(file, picture.pixels, picture.width, picture.height);
}

fs::path histogram_file(const fs::path& overlay) {
  fs::path picture = overlay;
  return picture.replace_filename(overlay.stem().string() + "_histogram.png");
}

void write_histogram(const fs::path& overlay, const GreyImage& image, const ExtractionResult& result) {
  const Histogram histogram =
      std::visit([](const auto& pixels) { return compute_histogram(pixels.view()); }, image);
  write_rgb_image(histogram_file(overlay), draw_histogram(histogram, result), kHistogramPlotWidth,
                  kHistogramPlotHeight);
}

}  // namespace lightstripe
