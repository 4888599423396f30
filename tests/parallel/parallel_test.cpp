// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "parallel/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

namespace lightstripe {
namespace {

TEST(ParallelFor, CallsEachIndexOnce) {
  std::vector<int> calls(1000);
  parallel_for(calls.size(), [&](std::size_t i) { ++calls[i]; });
  EXPECT_EQ(calls, std::vector<int>(1000, 1));
  parallel_for(calls.size(), 2, [&](std::size_t i) { ++calls[i]; });
  EXPECT_EQ(calls, std::vector<int>(1000, 2));
  parallel_for(0, [&](std::size_t) { FAIL(); });
}

TEST(ParallelFor, AnExceptionComesOut) {
  const auto work = [](std::size_t i) {
    if (i == 17) throw std::runtime_error("17");
  };
  EXPECT_THROW(parallel_for(100, work), std::runtime_error);
}

TEST(ParallelFor, KeepsToTheLimit) {
  const ThreadLimit limit(1);
  std::mutex mutex;
  std::set<std::thread::id> threads;
  parallel_for(200, [&](std::size_t) {
    const std::scoped_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(threads.size(), 1U);
}

TEST(ParallelPipeline, CollectsInTheOrderOfIssueAndFillsNoSlotThatIsInUse) {
  constexpr int kItems = 500;
  std::vector<int> slots, collected;
  int issued = 0;
  PipelineSteps steps;
  steps.issue = [&](std::size_t slot) {
    if (issued == kItems) return false;
    EXPECT_EQ(slots[slot], -1) << "its last item was not collected";
    slots[slot] = issued++;
    return true;
  };
  steps.process = [&](std::size_t slot) { slots[slot] *= 2; };
  steps.collect = [&](std::size_t slot) {
    collected.push_back(slots[slot]);
    slots[slot] = -1;
  };
  parallel_pipeline(
      2, [&](std::size_t count) { slots.assign(count, -1); }, steps);
  ASSERT_EQ(collected.size(), static_cast<std::size_t>(kItems));
  for (int i = 0; i < kItems; ++i) EXPECT_EQ(collected[static_cast<std::size_t>(i)], 2 * i);
}

TEST(WorkspacePool, NoTwoTasksHaveOneMemory) {
  struct Memory {
    std::atomic<int> users = 0;
  };
  WorkspacePool<Memory> pool;
  std::atomic<int> shared = 0;
  parallel_for(1000, [&](std::size_t) {
    pool.with([&](Memory& memory) {
      if (++memory.users != 1) ++shared;
      --memory.users;
    });
  });
  EXPECT_EQ(shared, 0);
}

}  // namespace
}  // namespace lightstripe
