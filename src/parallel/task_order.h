// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Makes visible to TSan what oneTBB guarantees and what TSan cannot see, since oneTBB is not built with it:
// tasks begin after their caller's earlier work and end before its later work. Without, TSan takes each
// handover for a race. Only parallel/parallel.h and parallel.cpp use these marks.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

namespace lightstripe {

/// Shared by all loops: an atomic on the stack would be written plainly, by its constructor, before the tasks
/// read it.
inline std::atomic<std::uint64_t> task_marks{0};

/// The caller of a parallel loop, just before it and just after it.
inline void before_tasks() { task_marks.fetch_add(1, std::memory_order_acq_rel); }
inline void after_tasks() { task_marks.load(std::memory_order_acquire); }

/// What the loop calls: `work`, which is made before before_tasks() and lives until after_tasks(). oneTBB
/// copies what it is given from thread to thread; this is all it copies, and scripts/tsan_suppressions.txt
/// leaves out what this file reads of it.
template <class Work>
class Task {
 public:
  explicit Task(const Work& work) : work_(&work) {}

  template <class... Arguments>
  auto operator()(Arguments&&... arguments) const {
    const Marks marks;
    return (*work_)(std::forward<Arguments>(arguments)...);
  }

 private:
  struct Marks {
    Marks() { task_marks.load(std::memory_order_acquire); }
    ~Marks() { task_marks.fetch_add(1, std::memory_order_acq_rel); }
    Marks(const Marks&) = delete;
    Marks& operator=(const Marks&) = delete;
  };

  const Work* work_;
};

}  // namespace lightstripe
