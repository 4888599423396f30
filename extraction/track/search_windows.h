// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// The parts of an image in which lines are looked for: square cells, open or closed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lightstripe {

/// Columns [begin, end), px.
struct ColumnSpan {
  int begin = 0, end = 0;
};

class SearchWindows {
 public:
  static constexpr int kCellShift = 3;  ///< cells of 8 x 8 px: whole pixels in four levels of a pyramid

  /// All closed.
  void reset(int width, int height);
  /// Opens every cell within `margin` px of (x, y).
  void open(double x, double y, double margin);
  /// The cells of `other`, which is settled, and those within `cells` cells of them; settled.
  void widen(const SearchWindows& other, int cells);
  /// To be called after the last open(): makes the spans.
  void settle();

  /// Open columns of the row `y`, px; none outside the image.
  std::span<const ColumnSpan> spans(int y) const;
  bool is_open(double x, double y) const;
  double open_share() const;

 private:
  std::uint8_t& cell(int column, int row) {
    return cells_[static_cast<std::size_t>(row * columns_ + column)];
  }

  int width_ = 0, columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> cells_;
  std::vector<ColumnSpan> spans_;
  std::vector<std::size_t> first_span_;  ///< of each row of cells, and the end
  std::size_t open_cells_ = 0;
};

}  // namespace lightstripe
