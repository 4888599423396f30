// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// A sequence runs in the memory of its first frames.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

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

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

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
  options.smoothing = true;
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

TEST(Allocation, TheCounterCounts) {
  const std::size_t before = allocations;
  std::vector<int> some(100);
  EXPECT_EQ(some.size(), 100U);
  EXPECT_GT(allocations, before);
}

}  // namespace
}  // namespace lightstripe
