// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/exclusion_mask.h"

#include <algorithm>
#include <cmath>

namespace lightstripe {

void ExclusionMask::reset(int width, int height) {
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (width == width_ && height == height_) {
    for (const Run& run : runs_)
      for (std::uint32_t i = 0; i < run.count; ++i) labels_[run.first + i * run.step] = kFree;
  } else {
    labels_.assign(size, kFree);
    width_ = width;
    height_ = height;
  }
  runs_.clear();
}

void ExclusionMask::mark(const Run& run, std::uint16_t label) {
  for (std::uint32_t i = 0; i < run.count; ++i) {
    std::uint16_t& pixel = labels_[run.first + i * run.step];
    if (pixel == kFree || pixel == kDead) pixel = label;
  }
  runs_.push_back(run);
}

void ExclusionMask::mark_column(int x, double centre, double half, std::uint16_t label) {
  const int first = std::max(0, static_cast<int>(std::ceil(centre - half)));
  const int last = std::min(height_ - 1, static_cast<int>(std::floor(centre + half)));
  if (x < 0 || x >= width_ || last < first) return;
  mark({index(x, first), static_cast<std::uint32_t>(last - first + 1), static_cast<std::uint32_t>(width_)},
       label);
}

void ExclusionMask::mark_row(int y, double centre, double half, std::uint16_t label) {
  const int first = std::max(0, static_cast<int>(std::ceil(centre - half)));
  const int last = std::min(width_ - 1, static_cast<int>(std::floor(centre + half)));
  if (y < 0 || y >= height_ || last < first) return;
  mark({index(first, y), static_cast<std::uint32_t>(last - first + 1), 1}, label);
}

void ExclusionMask::relabel(std::size_t from_checkpoint, std::uint16_t first, std::uint16_t last,
                            std::uint16_t to) {
  for (std::size_t r = from_checkpoint; r < runs_.size(); ++r) {
    const Run& run = runs_[r];
    for (std::uint32_t i = 0; i < run.count; ++i) {
      std::uint16_t& pixel = labels_[run.first + i * run.step];
      if (pixel >= first && pixel <= last) pixel = to;
    }
  }
}

}  // namespace lightstripe
