// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/track/look_through.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "extraction/kernels/kernels_scan.h"

namespace lightstripe {
namespace {

constexpr double kMargin = 8;      // px around the earlier lines; what moved farther appears anew
constexpr double kMostOpen = 0.3;  // of the image: from here on the full search costs no more
constexpr int kClusterShift = 4;   // what appears is one thing where it lies in adjoining cells of 16 x 16 px
/// Every so many rows the coarse look takes one, and compares it with those as far above and below: a stripe
/// of sigma 1.4 px shows at least a third of its height in one of them.
constexpr int kCoarseRows = 4;

/// Pixels of the sparse rows that stand out of the noise and lie in no window.
template <class T>
double look_coarsely(ImageView<T> image, double contrast, TrackWorkspace& w) {
  const ScanRule<T> rule{0, static_cast<T>(std::max(1.0, std::ceil(contrast))), kCoarseRows};
  w.masks.resize(static_cast<std::size_t>((image.width + 63) / 64));
  w.appeared.clear();
  double largest = 0;
  for (int y = kCoarseRows; y + kCoarseRows < image.height; y += kCoarseRows) {
    const T* pixels = image.row(y);
    largest = std::max<double>(largest, largest_pixel(pixels, static_cast<std::size_t>(image.width)));
    const ScanRow<T> row{pixels, image.row(y - kCoarseRows), image.row(y + kCoarseRows)};
    if (!mark_candidates(row, image.width, rule, w.masks.data())) continue;
    for (std::size_t word = 0; word < w.masks.size(); ++word)
      for (std::uint64_t bits = w.masks[word]; bits != 0; bits &= bits - 1) {
        const int x = static_cast<int>(word * 64) + std::countr_zero(bits);
        if (!w.windows.is_open(x, y)) w.appeared.push_back({static_cast<float>(x), static_cast<float>(y)});
      }
  }
  return largest;
}

/// Extent of the things that appeared, by cells: calls use(cells of one thing, as indices into the grid).
template <class Use>
void for_each_cluster(int columns, int rows, TrackWorkspace& w, const Use& use) {
  for (int first = 0; first < columns * rows; ++first) {
    if (w.cells[static_cast<std::size_t>(first)] != 1) continue;
    w.cluster.assign(1, first);
    w.cells[static_cast<std::size_t>(first)] = 2;
    for (std::size_t i = 0; i < w.cluster.size(); ++i) {
      const int column = w.cluster[i] % columns, row = w.cluster[i] / columns;
      for (int y = std::max(0, row - 1); y <= std::min(rows - 1, row + 1); ++y)
        for (int x = std::max(0, column - 1); x <= std::min(columns - 1, column + 1); ++x) {
          std::uint8_t& cell = w.cells[static_cast<std::size_t>(y * columns + x)];
          if (cell != 1) continue;
          cell = 2;
          w.cluster.push_back(y * columns + x);
        }
    }
    use();
  }
}

/// Opens windows on what appeared and is long enough to be a line.
void open_what_appeared(int width, int height, double least_length, double margin, TrackWorkspace& w) {
  if (w.appeared.empty()) return;
  const int columns = (width >> kClusterShift) + 1, rows = (height >> kClusterShift) + 1;
  const auto cell_of = [&](const TrackedPlace& p) {
    return static_cast<std::size_t>((static_cast<int>(p.y) >> kClusterShift) * columns +
                                    (static_cast<int>(p.x) >> kClusterShift));
  };
  w.cells.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  w.extents.assign(w.cells.size(), {});
  for (const TrackedPlace& p : w.appeared) {
    w.cells[cell_of(p)] = 1;
    w.extents[cell_of(p)].add(p);
  }
  constexpr std::uint8_t kLong = 3;
  for_each_cluster(columns, rows, w, [&] {
    PlaceExtent whole;
    for (const int cell : w.cluster) {
      const PlaceExtent& e = w.extents[static_cast<std::size_t>(cell)];
      whole.add({e.left, e.top});
      whole.add({e.right, e.bottom});
    }
    // Both ends lie up to a step of the coarse look farther out.
    if (whole.longer_side() + 2 * kCoarseRows < 0.7 * least_length) return;
    for (const int cell : w.cluster) w.cells[static_cast<std::size_t>(cell)] = kLong;
  });
  for (const TrackedPlace& p : w.appeared)
    if (w.cells[cell_of(p)] == kLong) w.windows.open(double{p.x}, double{p.y}, margin);
}

template <class T>
double brightest_in_windows(ImageView<T> image, const SearchWindows& windows) {
  double largest = 0;
  for (int y = 0; y < image.height; ++y)
    for (const ColumnSpan& span : windows.spans(y))
      largest = std::max<double>(
          largest, largest_pixel(image.row(y) + span.begin, static_cast<std::size_t>(span.end - span.begin)));
  return largest;
}

}  // namespace

int coarsest_level(const TrackReference& reference) {
  // A level's seeds are tried at the rungs from its own finest to four coarser ones.
  return std::clamp(static_cast<int>(1 + std::log2(std::max(reference.sigma, 1.0))), 0, 3);
}

LevelNoise noise_of_levels(const TrackReference& before, double noise) {
  LevelNoise levels{};
  const double change = before.noise[0] > 0 ? noise / before.noise[0] : 0;
  for (std::size_t k = 0; k < levels.size(); ++k)
    levels[k] = std::max(noise / static_cast<double>(1 << k), before.noise[k] * change);
  return levels;
}

template <class T>
std::optional<ImageFacts> look_through(ImageView<T> image, const TrackReference& reference,
                                       double least_length, TrackWorkspace& w) {
  constexpr std::array<int, 4> kSurroundings = {3, 5, 10, 10};  // cells that the kernels of a level read
  const double margin = kMargin + reference.sigma;
  ImageFacts facts;
  facts.noise = noise_of(image);
  w.windows.reset(image.width, image.height);
  for (const TrackedPlace& p : reference.places) w.windows.open(double{p.x}, double{p.y}, margin);
  double largest = look_coarsely(image, seed_contrast(facts.noise, 1), w);
  open_what_appeared(image.width, image.height, least_length, margin, w);
  w.windows.settle();
  if (w.windows.open_share() > kMostOpen) return std::nullopt;
  w.seen.widen(w.windows, kSurroundings.at(static_cast<std::size_t>(coarsest_level(reference))));
  largest = std::max(largest, brightest_in_windows(image, w.windows));
  facts.histogram = compute_histogram(image, facts_thinning(image.width, image.height), largest);
  return facts;
}

bool has_all_lines(const TrackReference& reference, const std::vector<Stripe>& stripes, TrackWorkspace& w) {
  w.found.reset(reference.width, reference.height);
  for (const Stripe& stripe : stripes)
    for (std::size_t i = 0; i < stripe.points.size(); ++i) {
      const StripePoint& p = stripe.points[i];
      if (!w.seen.is_open(p.x, p.y)) return false;
      if (i % 8 == 0) w.found.open(p.x, p.y, 2 * kMargin);
    }
  std::size_t place = 0;
  for (const std::size_t end : reference.line_ends) {
    const std::size_t begin = place;
    std::size_t met = 0;
    for (; place < end; ++place)
      met += w.found.is_open(double{reference.places[place].x}, double{reference.places[place].y}) ? 1U : 0U;
    if (2 * met < end - begin) return false;
  }
  return true;
}

template std::optional<ImageFacts> look_through<std::uint8_t>(ImageView8, const TrackReference&, double,
                                                              TrackWorkspace&);
template std::optional<ImageFacts> look_through<std::uint16_t>(ImageView16, const TrackReference&, double,
                                                               TrackWorkspace&);

}  // namespace lightstripe
