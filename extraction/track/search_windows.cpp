// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/track/search_windows.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lightstripe {
namespace {

constexpr int kCell = 1 << SearchWindows::kCellShift;

}  // namespace

void SearchWindows::reset(int width, int height) {
  width_ = width;
  columns_ = (width + kCell - 1) / kCell;
  rows_ = (height + kCell - 1) / kCell;
  cells_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  spans_.clear();
  first_span_.assign(static_cast<std::size_t>(rows_) + 1, 0);
  open_cells_ = 0;
}

void SearchWindows::open(double x, double y, double margin) {
  const auto cell_of = [](double place, int count) {
    return std::clamp(static_cast<int>(std::floor(place)) >> kCellShift, 0, count - 1);
  };
  if (columns_ == 0 || rows_ == 0) return;
  const int left = cell_of(x - margin, columns_), right = cell_of(x + margin, columns_),
            last = cell_of(y + margin, rows_);
  for (int row = cell_of(y - margin, rows_); row <= last; ++row)
    std::fill(&cell(left, row), &cell(right, row) + 1, std::uint8_t{1});
}

void SearchWindows::widen(const SearchWindows& other, int cells) {
  width_ = other.width_;
  columns_ = other.columns_;
  rows_ = other.rows_;
  cells_.assign(other.cells_.size(), 0);
  first_span_.assign(static_cast<std::size_t>(rows_) + 1, 0);
  for (int row = 0; row < rows_; ++row)
    for (const ColumnSpan& span : other.spans(row * kCell)) {
      const int left = std::max(0, span.begin / kCell - cells),
                right = std::min(columns_, (span.end + kCell - 1) / kCell + cells);
      const int last = std::min(rows_ - 1, row + cells);
      for (int r = std::max(0, row - cells); r <= last; ++r)
        std::fill_n(&cell(left, r), right - left, std::uint8_t{1});
    }
  settle();
}

void SearchWindows::settle() {
  spans_.clear();
  open_cells_ = 0;
  for (int row = 0; row < rows_; ++row) {
    first_span_[static_cast<std::size_t>(row)] = spans_.size();
    const std::uint8_t* cells = &cell(0, row);
    // From the next open cell to the next closed one: memchr skips at memory speed.
    for (int column = 0; column < columns_;) {
      const auto* open = static_cast<const std::uint8_t*>(
          std::memchr(cells + column, 1, static_cast<std::size_t>(columns_ - column)));
      if (open == nullptr) break;
      const int begin = static_cast<int>(open - cells);
      const auto* closed =
          static_cast<const std::uint8_t*>(std::memchr(open, 0, static_cast<std::size_t>(columns_ - begin)));
      column = closed == nullptr ? columns_ : static_cast<int>(closed - cells);
      spans_.push_back({begin * kCell, std::min(column * kCell, width_)});
      open_cells_ += static_cast<std::size_t>(column - begin);
    }
  }
  first_span_[static_cast<std::size_t>(rows_)] = spans_.size();
}

std::span<const ColumnSpan> SearchWindows::spans(int y) const {
  const int row = y >> kCellShift;
  if (row < 0 || row >= rows_) return {};
  const std::size_t first = first_span_[static_cast<std::size_t>(row)],
                    end = first_span_[static_cast<std::size_t>(row) + 1];
  return std::span(spans_).subspan(first, end - first);
}

bool SearchWindows::is_open(double x, double y) const {
  const int column = static_cast<int>(std::floor(x + 0.5)) >> kCellShift,
            row = static_cast<int>(std::floor(y + 0.5)) >> kCellShift;
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return false;
  return cells_[static_cast<std::size_t>(row * columns_ + column)] != 0;
}

double SearchWindows::open_share() const {
  return cells_.empty() ? 0 : static_cast<double>(open_cells_) / static_cast<double>(cells_.size());
}

}  // namespace lightstripe
