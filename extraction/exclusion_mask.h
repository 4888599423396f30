// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Which pixels belong to lines already followed (the paper's exclusion, step 4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lightstripe {

/// A label a pixel; clearing costs only what was marked.
class ExclusionMask {
 public:
  static constexpr std::uint16_t kFree = 0;
  static constexpr std::uint16_t kDead =
      0xFFFF;  ///< looked at and found to be no line: no start, but no obstacle

  void reset(int width, int height);

  std::uint16_t operator()(int x, int y) const { return labels_[index(x, y)]; }
  /// Marks free pixels of the column x (or row y), `half` px to both sides of `centre`.
  void mark_column(int x, double centre, double half, std::uint16_t label);
  void mark_row(int y, double centre, double half, std::uint16_t label);
  /// How many runs were marked so far; a later relabel() changes the labels
  /// first..last in those from here on.
  std::size_t checkpoint() const { return runs_.size(); }
  void relabel(std::size_t from_checkpoint, std::uint16_t first, std::uint16_t last, std::uint16_t to);

 private:
  struct Run {
    std::size_t first;
    std::uint32_t count;
    std::uint32_t step;
  };
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void mark(const Run& run, std::uint16_t label);

  int width_ = 0, height_ = 0;
  std::vector<std::uint16_t> labels_;
  std::vector<Run> runs_;
};

}  // namespace lightstripe
