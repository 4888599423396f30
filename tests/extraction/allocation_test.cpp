// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A sequence runs in the memory of its first frames.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "core/error.h"
#include "extraction/extract_sequence.h"
#include "extraction/extract_stripes.h"
#include "extraction/workspace.h"
#include "stripe_scenes.h"

namespace {

std::atomic<std::size_t> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

// Not inlined: where only one of new and delete is, g++ takes malloc and delete, or new and free, for a
// mismatch.
[[gnu::noinline]] void give_back(void* memory) noexcept { std::free(memory); }

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete[](void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, std::size_t) noexcept { give_back(memory); }
void operator delete[](void* memory, std::size_t) noexcept { give_back(memory); }

namespace lightstripe {
namespace {

/// Three frames with one, two and three lines, the last one cut by a gap.
std::vector<Image8> frames() {
  std::vector<Image8> out;
  for (int k = 1; k <= 3; ++k) {
    scenes::Canvas canvas(400, 300, 5);
    for (int line = 0; line < k; ++line)
      canvas.add(scenes::make_line(-10, 60 + 80 * line, 410, 90 + 70 * line, 150, 2.5));
    out.push_back(canvas.exposed(2, 0.05, static_cast<std::uint64_t>(k)));
    if (k == 3)
      for (int y = 0; y < 300; ++y)
        for (int x = 180; x < 230; ++x) out.back()(x, y) = 5;
  }
  return out;
}

template <class T>
std::size_t allocations_in_steady_state(const std::vector<Image<T>>& images,
                                        const ExtractionOptions& options) {
  ExtractionWorkspace workspace;
  ExtractionResult result;
  std::size_t before = 0;
  for (int round = 0; round < 4; ++round) {
    if (round == 2) before = allocations;
    for (const auto& image : images) extract_stripes(image.view(), options, workspace, result);
  }
  return allocations - before;
}

TEST(Allocation, NoneAfterTheFirstFrames) {
  ExtractionOptions options;
  options.sigma = 2.5;
  EXPECT_EQ(allocations_in_steady_state(frames(), options), 0U);
  options.smoothing = Smoothing::kAlways;
  EXPECT_EQ(allocations_in_steady_state(frames(), options), 0U);
}

TEST(Allocation, NoneWithSixteenBits) {
  std::vector<Image16> wide;
  for (const Image8& image : frames()) {
    wide.emplace_back(image.width, image.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      wide.back().pixels[i] = static_cast<std::uint16_t>(image.pixels[i] * 200);
  }
  ExtractionOptions options;
  options.sigma = 2.5;
  EXPECT_EQ(allocations_in_steady_state(wide, options), 0U);
}

/// The frames `rounds` times over.
std::vector<ImageView8> repeated(const std::vector<Image8>& images, int rounds) {
  std::vector<ImageView8> views;
  for (int round = 0; round < rounds; ++round)
    for (const Image8& image : images) views.push_back(image.view());
  return views;
}

TEST(Allocation, ASequenceNeedsOnlyItsThreads) {
  const auto images = frames();
  const auto sequence = repeated(images, 8);
  ExtractionOptions options;
  options.sigma = 2.5;
  for (const int threads : {1, 3}) {
    SequenceWorkspace workspace;
    std::vector<ExtractionResult> results;
    for (int round = 0; round < 2; ++round) extract_stripes(sequence, options, threads, workspace, results);
    const std::size_t before = allocations;
    extract_stripes(sequence, options, threads, workspace, results);
    // Not one a frame (24): the lists of errors and of threads, and two things that each thread starts with.
    EXPECT_LE(allocations - before, 2U + 2U * static_cast<std::size_t>(threads - 1)) << threads;
  }
}

TEST(Sequence, IsTheSingleFramesResultsForAnyNumberOfThreads) {
  const auto images = frames();
  const auto sequence = repeated(images, 3);
  for (const int threads : {0, 1, 2, 5, 20}) {
    const auto results = extract_stripes(sequence, {}, threads);
    ASSERT_EQ(results.size(), sequence.size());
    for (std::size_t i = 0; i < sequence.size(); ++i) {
      const ExtractionResult alone = extract_stripes(sequence[i]);
      ASSERT_EQ(results[i].stripes.size(), alone.stripes.size()) << threads << " threads, frame " << i;
      for (std::size_t k = 0; k < alone.stripes.size(); ++k) {
        const auto &a = results[i].stripes[k].points, &b = alone.stripes[k].points;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t p = 0; p < a.size(); ++p) {
          EXPECT_EQ(a[p].x, b[p].x);
          EXPECT_EQ(a[p].y, b[p].y);
          EXPECT_EQ(a[p].sigma_px, b[p].sigma_px);
          EXPECT_EQ(a[p].width, b[p].width);
        }
      }
    }
  }
}

TEST(Sequence, OfNoFramesIsEmptyAndBadOptionsAreErrors) {
  EXPECT_TRUE(extract_stripes(std::span<const ImageView8>{}, {}, 4).empty());
  ExtractionOptions options;
  options.sigma = -1.0;
  const auto images = frames();
  EXPECT_THROW(extract_stripes(repeated(images, 2), options, 3), Error);
}

TEST(Allocation, TheCounterCounts) {
  const std::size_t before = allocations;
  std::vector<int> some(100);
  EXPECT_EQ(some.size(), 100U);
  EXPECT_GT(allocations, before);
}

}  // namespace
}  // namespace lightstripe
