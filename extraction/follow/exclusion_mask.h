// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which pixels belong to lines already followed (the paper's exclusion, step 4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lightstripe {

/// A label a square cell of pixels; clearing costs only what was marked.
class ExclusionMask {
 public:
  static constexpr std::uint16_t kFree = 0;
  static constexpr std::uint16_t kDead =
      0xFFFF;  ///< looked at and found to be no line: no start, but no obstacle

  /// No new line begins with a label from here on: fewer are left than one long line may need.
  static constexpr std::uint16_t kLastLabel = 60000;

  /// All free; cells of 2^cell_shift x 2^cell_shift pixels.
  void reset(int width, int height, int cell_shift);

  std::uint16_t operator()(int x, int y) const { return labels_[index(x >> shift_, y >> shift_)]; }
  /// Marks free cells of the column x (or row y) whose centres lie within `half` px of `centre`.
  void mark_column(int x, double centre, double half, std::uint16_t label);
  void mark_row(int y, double centre, double half, std::uint16_t label);
  /// How many runs were marked so far; a later relabel() changes the labels
  /// first..last in those from here on.
  std::size_t checkpoint() const { return runs_.size(); }
  void relabel(std::size_t from_checkpoint, std::uint16_t first, std::uint16_t last, std::uint16_t to);

  /// A cell and what was written there.
  struct Mark {
    std::uint32_t cell = 0;
    std::uint16_t label = kFree;
  };
  /// As relabel() to kFree, and tells what was there, so that put_back() can undo it.
  void lift(std::size_t from_checkpoint, std::uint16_t first, std::uint16_t last, std::vector<Mark>& lifted);
  /// What other lines marked since then has to be free again.
  void put_back(const std::vector<Mark>& lifted);

 private:
  struct Run {
    std::uint32_t first, count, step;
    bool operator==(const Run&) const = default;
  };
  struct CellRange {
    int first, last;
  };
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  CellRange cells(double centre, double half, int count) const;
  void mark(const Run& run, std::uint16_t label);

  int shift_ = 0;
  std::uint16_t last_label_ = kFree;  ///< of the last run, unless it was changed since
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint16_t> labels_;
  std::vector<Run> runs_;
};

}  // namespace lightstripe
