// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The job of `lightstripe extract`: pictures on disk -> their stripes in one table.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/image.h"
#include "extraction/options.h"
#include "extraction/result.h"
#include "io/images.h"
#include "pipeline/job.h"

namespace lightstripe {

/// One picture, as it was read, and what was found in it.
struct SeenImage {
  const GreyImage& image;
  Channel channel;  ///< that auto chose
  const ExtractionResult& result;
};

struct ExtractJob {
  std::vector<std::string> images;  ///< files
  Channel channel = Channel::kAuto;
  std::string background;  ///< file or pattern of pictures with the laser off; empty: none
  ExtractionOptions extraction;
  std::filesystem::path table = "stripes.csv";
  std::vector<std::filesystem::path> other_outputs;  ///< what else is written: must not be an input either
  int threads = 0;                                   ///< 0 = all cores
  /// Told of each picture (its index in `images`) on the thread that has just looked at it.
  std::function<void(std::size_t index, const SeenImage& seen)> on_image{};
  /// Told of each picture in order, from one thread, when its rows are in the table.
  std::function<void(std::size_t index)> on_row{};
};

struct ExtractResult {
  std::size_t images = 0, lines = 0, points = 0;
  std::vector<std::string> warnings;          ///< of backgrounds that do not quite fit
  Impression impression = Impression::kNone;  ///< of the first picture without a line
  bool usable() const { return points > 0; }
};

/// Reads, extracts and writes; the table appears when all pictures are done. An Error where a picture cannot
/// be read, or a stop was asked for.
ExtractResult extract(const ExtractJob& job, const ProgressCallback& progress = {},
                      const std::stop_token& stop = {});

}  // namespace lightstripe
