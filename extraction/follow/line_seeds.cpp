// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/follow/line_seeds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "extraction/kernels/kernels_scan.h"

namespace lightstripe {
namespace {

/// Rows that are searched: a line of w >= 7 px is met by each fourth, one of sigma 1 px still stands out half
/// a pixel beside its centre; thinner ones need each row.
int row_step(double sigma) { return sigma < 1 ? 1 : std::clamp(static_cast<int>(sigma), 2, 4); }

/// The columns taken in a row, every so many from the offset on: as sparse as the rows, and staggered, so
/// that lines along the columns are met.
struct ColumnPattern {
  int step, offset;  ///< step: a power of two, so that remainders need no division
  std::uint64_t bits() const {
    const std::uint64_t first = step == 1 ? ~0ULL : step == 2 ? 0x5555555555555555ULL : 0x0101010101010101ULL;
    return first << offset;
  }
  int first_from(int x) const { return x + ((offset - x) & (step - 1)); }
  /// The same pattern counted from `x` on.
  ColumnPattern from(int x) const { return {step, (offset - x) & (step - 1)}; }
};

ColumnPattern column_pattern(int rows, int row_number) {
  const int step = rows == 1 ? 1 : rows == 2 ? 2 : 8;
  return {step, row_number & (step - 1)};
}

template <class T>
T to_pixel(double level) {
  return static_cast<T>(std::clamp(std::ceil(level), 0.0, double{std::numeric_limits<T>::max()}));
}

template <class T>
std::vector<T>& zeros_of(SeedWorkspace& w) {
  if constexpr (sizeof(T) == 1)
    return w.zeros8;
  else
    return w.zeros16;
}

template <class T>
std::vector<T>& contrasts_of(SeedWorkspace& w) {
  if constexpr (sizeof(T) == 1)
    return w.contrasts8;
  else
    return w.contrasts16;
}

/// The row of `where` that tells of a row of the searched image.
const std::uint8_t* where_of_row(const SeedRule& rule, int y) {
  if (rule.where == nullptr) return nullptr;
  return rule.where + ((y << rule.binned) + ((1 << rule.binned) >> 1)) * rule.where_stride;
}

/// Whether any of `count` bytes is not 0.
bool any_set(const std::uint8_t* bytes, int count) {
  static_assert(LaserPlace::kNone == 0 && LaserPlace::kFaint == 1);
  constexpr int kChunk = 64;  // of known length: the compiler makes vectors of it
  std::uint64_t all = 0;
  int i = 0;
  for (; i + kChunk <= count; i += kChunk) {
    std::array<std::uint64_t, kChunk / 8> words{};
    std::memcpy(words.data(), bytes + i, kChunk);
    for (const std::uint64_t word : words) all |= word;
  }
  for (; i + 8 <= count; i += 8) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes + i, 8);
    all |= eight;
  }
  for (; i < count; ++i) all |= bytes[i];
  return all != 0;
}

/// The parts of a row that hold the laser's colour: most of a picture does not.
void find_coloured(const std::uint8_t* where, int width, int block, std::vector<ColumnSpan>& spans) {
  spans.clear();
  for (int x = 0; x < width; x += block) {
    const int end = std::min(width, x + block);
    if (!any_set(where + x, end - x)) continue;
    if (!spans.empty() && spans.back().end == x)
      spans.back().end = end;
    else
      spans.push_back({x, end});
  }
}

/// The columns of one row that are looked at, in the pixels of the windows and of `where`.
std::span<const ColumnSpan> spans_of_row(const SeedRule& rule, int y, int width, SeedWorkspace& w) {
  constexpr int kBlock = 64;  // searched pixels: as many as one word of the masks is for
  if (rule.windows != nullptr) return rule.windows->spans(y << rule.binned);
  if (rule.where != nullptr)
    find_coloured(where_of_row(rule, y), width, kBlock << rule.binned, w.coloured);
  else
    w.coloured.assign(1, {0, width});
  return w.coloured;
}

/// A part [begin, end) of a row with what the vectors need on both sides of it.
ColumnSpan with_surroundings(const ColumnSpan& span, int reach, int width) {
  constexpr int kVector = 64;  // shorter rows would go pixel by pixel
  const int begin = std::max(0, span.begin - reach);
  return {begin, std::min(width, std::max(span.end + reach, begin + kVector + 2 * reach))};
}

/// The candidates of one span of a row, in reading order: add(column, contrast).
template <class T, class Add>
void candidates_of_span(const ScanRow<T>& row, int width, const ScanRule<T>& scan, const ColumnSpan& span,
                        const ColumnPattern& pattern, SeedWorkspace& w, const Add& add) {
  const T least = std::max(scan.level, scan.contrast);
  const auto add_at_border = [&](int x) {
    // Nothing stands out by more than it has.
    if (row.centre[x] < least) return;
    const T contrast = candidate_contrast(row, x, width, scan.reach);
    if (contrast >= scan.contrast) add(x, contrast);
  };
  const int left = std::min(std::min(scan.reach, width), span.end),
            right = std::max(std::max(width - scan.reach, std::min(scan.reach, width)), span.begin);
  for (int x = pattern.first_from(span.begin); x < left; x += pattern.step) add_at_border(x);
  const ColumnSpan seen = with_surroundings(span, scan.reach, width);
  const ScanRow<T> part{row.centre + seen.begin, row.above + seen.begin, row.below + seen.begin};
  const int length = seen.end - seen.begin;
  // The pattern counts from the row's begin, the masks from the part's.
  const ColumnPattern shifted = pattern.from(seen.begin);
  T* contrasts = contrasts_of<T>(w).data();
  if (mark_candidates(part, length, scan, w.candidate_masks.data(), contrasts))
    for (int word = 0; word < (length + 63) / 64; ++word)
      for (std::uint64_t bits = w.candidate_masks[static_cast<std::size_t>(word)] & shifted.bits(); bits != 0;
           bits &= bits - 1) {
        const int at = word * 64 + std::countr_zero(bits), x = seen.begin + at;
        if (x >= span.begin && x < span.end) add(x, contrasts[at]);
      }
  for (int x = pattern.first_from(right); x < span.end; x += pattern.step) add_at_border(x);
}

/// The strongest seeds of cells, the first of equals. Their rank is their contrast at first.
class SeedCells {
 public:
  SeedCells(int shift, int width, SeedWorkspace& w) : shift_(shift), w_(w) {
    w.in_cell.assign(static_cast<std::size_t>((width >> shift) + 1), 0);
  }
  void begin_row(int y) {
    if (y >> shift_ == row_) return;
    row_ = y >> shift_;
    // Most rows hold nothing that would have to be cleared.
    if (is_used_) std::fill(w_.in_cell.begin(), w_.in_cell.end(), 0U);
    is_used_ = false;
  }
  void add(const LineSeed& seed) {
    if (shift_ == 0) return w_.found.push_back(seed);  // no pixel is met twice
    is_used_ = true;
    std::uint32_t& place = w_.in_cell[static_cast<std::size_t>(seed.x >> shift_)];
    if (place == 0) {
      w_.found.push_back(seed);
      place = static_cast<std::uint32_t>(w_.found.size());
    } else if (w_.found[place - 1].rank < seed.rank) {
      w_.found[place - 1] = seed;
    }
  }

 private:
  int shift_, row_ = 0;
  bool is_used_ = false;  ///< some cell of the row holds a seed
  SeedWorkspace& w_;
};

/// From contrasts to 0..255 of the brightest pixel.
void rank_by_brightest(double brightest, std::vector<LineSeed>& seeds) {
  // Without a division a seed.
  const auto scale = static_cast<std::uint64_t>(255.0 * 65536 / std::max(brightest, 1.0));
  for (LineSeed& seed : seeds)
    seed.rank =
        std::min(static_cast<std::int32_t>((static_cast<std::uint64_t>(seed.rank) * scale) >> 16), 255);
}

/// A counting sort, which keeps the order of equals.
void sort_by_rank(SeedWorkspace& w) {
  constexpr std::int32_t kRanks = 512;
  const auto place = [](const LineSeed& s) {
    return static_cast<std::size_t>(kRanks - 1 - ((s.foreground ? 256 : 0) + s.rank));
  };
  std::array<std::size_t, kRanks + 1> first{};
  for (const LineSeed& s : w.found) ++first[place(s) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  w.sorted.resize(w.found.size());
  for (const LineSeed& s : w.found) w.sorted[first[place(s)]++] = s;
}

}  // namespace

template <class T>
void collect_seeds(ImageView<T> image, const SeedRule& rule, SeedWorkspace& w) {
  const ScanRule<T> scan{
      to_pixel<T>(std::min(rule.level, rule.brightest)), std::max(T{1}, to_pixel<T>(rule.contrast)),
      rule.reach > 0 ? rule.reach : std::max(2, static_cast<int>(std::lround(3.2 * rule.sigma)))};
  const T foreground = to_pixel<T>(rule.foreground);
  std::vector<T>& zeros = zeros_of<T>(w);
  zeros.assign(static_cast<std::size_t>(image.width), T{});
  contrasts_of<T>(w).resize(static_cast<std::size_t>(image.width));
  w.candidate_masks.resize(static_cast<std::size_t>((image.width + 63) / 64));
  w.found.clear();
  const int step = rule.step > 0 ? rule.step : row_step(rule.sigma);
  const int shift = rule.binned, half = (1 << shift) >> 1;
  SeedCells cells(rule.cell_shift, image.width, w);
  for (int y = step / 2, number = 0; y < image.height; y += step, ++number) {
    const ScanRow<T> row{image.row(y), y >= scan.reach ? image.row(y - scan.reach) : zeros.data(),
                         y + scan.reach < image.height ? image.row(y + scan.reach) : zeros.data()};
    const std::uint8_t* where = where_of_row(rule, y);
    cells.begin_row(y);
    const auto add = [&](int x, T contrast) {
      if (where == nullptr || where[(x << shift) + half] >= LaserPlace::kFaint)
        cells.add({x, y, contrast, row.centre[x] >= foreground});
    };
    for (const ColumnSpan& span : spans_of_row(rule, y, image.width << shift, w)) {
      const ColumnSpan here{span.begin >> shift, std::min(span.end >> shift, image.width)};
      candidates_of_span(row, image.width, scan, here, column_pattern(step, number), w, add);
    }
  }
  rank_by_brightest(rule.brightest, w.found);
}

template <class T>
void find_seeds(ImageView<T> image, const SeedRule& rule, SeedWorkspace& workspace) {
  collect_seeds(image, rule, workspace);
  sort_by_rank(workspace);
}

template void collect_seeds<std::uint8_t>(ImageView8, const SeedRule&, SeedWorkspace&);
template void collect_seeds<std::uint16_t>(ImageView16, const SeedRule&, SeedWorkspace&);
template void find_seeds<std::uint8_t>(ImageView8, const SeedRule&, SeedWorkspace&);
template void find_seeds<std::uint16_t>(ImageView16, const SeedRule&, SeedWorkspace&);

}  // namespace lightstripe
