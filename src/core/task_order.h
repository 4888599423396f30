// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Makes visible to TSan what oneTBB guarantees and what TSan cannot see, since oneTBB is not built with it:
// tasks begin after their caller's earlier work and end before its later work. Without, TSan takes each
// handover for a race, and looks for it at every access.
#pragma once

#include <atomic>
#include <cstdint>

namespace lightstripe {

/// Shared by all loops: an atomic on the stack would be written plainly, by its constructor, before the tasks
/// read it.
inline std::atomic<std::uint64_t> task_marks{0};

/// The first line of a task; lives until its end.
class TaskScope {
 public:
  TaskScope() { task_marks.load(std::memory_order_acquire); }
  ~TaskScope() { task_marks.fetch_add(1, std::memory_order_acq_rel); }
  TaskScope(const TaskScope&) = delete;
  TaskScope& operator=(const TaskScope&) = delete;
};

/// The caller of a parallel loop, just before it and just after it.
inline void before_tasks() { task_marks.fetch_add(1, std::memory_order_acq_rel); }
inline void after_tasks() { task_marks.load(std::memory_order_acquire); }

}  // namespace lightstripe
