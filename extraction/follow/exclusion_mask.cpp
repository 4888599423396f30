// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/exclusion_mask.h"

#include <algorithm>

namespace lightstripe {

void ExclusionMask::reset(int width, int height, int cell_shift) {
  const int size = 1 << cell_shift;
  const int columns = (width + size - 1) / size, rows = (height + size - 1) / size;
  if (columns == columns_ && rows == rows_) {
    for (const Run& run : runs_)
      for (std::uint32_t i = 0; i < run.count; ++i) labels_[run.first + i * run.step] = kFree;
  } else {
    columns_ = columns;
    rows_ = rows;
    labels_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), kFree);
  }
  shift_ = cell_shift;
  runs_.clear();
  last_label_ = kFree;
}

ExclusionMask::CellRange ExclusionMask::cells(double centre, double half, int count) const {
  const double scale = 1.0 / (1 << shift_), middle = 0.5 * ((1 << shift_) - 1);
  // Truncation is floor from 0 on, and what lies before 0 is clamped there anyway.
  const double low = (centre - half - middle) * scale, high = (centre + half - middle) * scale;
  const int first = low > 0 ? std::min(static_cast<int>(low + 1.0), count) : 0;
  const int last = high >= 0 ? std::min(static_cast<int>(high), count - 1) : -1;
  return {first, last};
}

void ExclusionMask::mark(const Run& run, std::uint16_t label) {
  // The steps inside one cell mark the same.
  if (label == last_label_ && !runs_.empty() && runs_.back() == run) return;
  last_label_ = label;
  for (std::uint32_t i = 0; i < run.count; ++i) {
    std::uint16_t& cell = labels_[run.first + i * run.step];
    if (cell == kFree || cell == kDead) cell = label;
  }
  runs_.push_back(run);
}

void ExclusionMask::mark_column(int x, double centre, double half, std::uint16_t label) {
  const auto [first, last] = cells(centre, half, rows_);
  const int column = x >> shift_;
  if (x < 0 || column >= columns_ || last < first) return;
  mark({static_cast<std::uint32_t>(index(column, first)), static_cast<std::uint32_t>(last - first + 1),
        static_cast<std::uint32_t>(columns_)},
       label);
}

void ExclusionMask::mark_row(int y, double centre, double half, std::uint16_t label) {
  const auto [first, last] = cells(centre, half, columns_);
  const int row = y >> shift_;
  if (y < 0 || row >= rows_ || last < first) return;
  mark({static_cast<std::uint32_t>(index(first, row)), static_cast<std::uint32_t>(last - first + 1), 1},
       label);
}

void ExclusionMask::relabel(std::size_t from_checkpoint, std::uint16_t first, std::uint16_t last,
                            std::uint16_t to) {
  last_label_ = kFree;
  for (std::size_t r = from_checkpoint; r < runs_.size(); ++r) {
    const Run& run = runs_[r];
    for (std::uint32_t i = 0; i < run.count; ++i) {
      std::uint16_t& cell = labels_[run.first + i * run.step];
      if (cell >= first && cell <= last) cell = to;
    }
  }
}

void ExclusionMask::lift(std::size_t from_checkpoint, std::uint16_t first, std::uint16_t last,
                         std::vector<Mark>& lifted) {
  last_label_ = kFree;
  lifted.clear();
  for (std::size_t r = from_checkpoint; r < runs_.size(); ++r) {
    const Run& run = runs_[r];
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const std::uint32_t at = run.first + i * run.step;
      if (labels_[at] < first || labels_[at] > last) continue;
      lifted.push_back({at, labels_[at]});
      labels_[at] = kFree;
    }
  }
}

void ExclusionMask::put_back(const std::vector<Mark>& lifted) {
  for (const Mark& mark : lifted) labels_[mark.cell] = mark.label;
}

}  // namespace lightstripe
