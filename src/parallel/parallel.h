// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Parallel loops and pipelines: the only room that knows oneTBB, and that makes its handovers visible to
// TSan.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace lightstripe {

/// The number of threads to use: `threads`, or all cores that this process may use where it is 0.
int thread_count(int threads);

/// Limits all parallel loops of the process to `threads` (0 = all cores) for as long as it lives. Of several
/// limits the lowest counts.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Calls work(0) ... work(count - 1), in any order and on several threads. An exception of `work` ends the
/// loop and comes out here.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work);

/// The same on `threads` threads (0 = all cores), and never more than one index at a time in a task: for work
/// that takes long.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

/// The three steps of a pipeline over numbered slots.
struct PipelineSteps {
  /// Fills the slot with the next item, in order, from one thread at a time; false: there is none left.
  std::function<bool(std::size_t slot)> issue;
  std::function<void(std::size_t slot)> process;  ///< in any order, on several threads
  std::function<void(std::size_t slot)> collect;  ///< in the order of issue, from one thread at a time
};

/// Runs items through the steps on `threads` threads (0 = all cores). At most as many items are under way as
/// there are slots; `prepare` is told that number once before the first item.
void parallel_pipeline(int threads, const std::function<void(std::size_t slots)>& prepare,
                       const PipelineSteps& steps);

/// Work memory that is handed from task to task: as many as tasks run at one time, made when first needed.
template <class T>
class WorkspacePool {
 public:
  /// Calls use(memory) with a memory that no other task has meanwhile.
  template <class Use>
  auto with(const Use& use) {
    Lease lease(*this);
    return use(*lease.memory);
  }

 private:
  struct Lease {
    explicit Lease(WorkspacePool& from) : pool(from), memory(from.take()) {}
    ~Lease() { pool.give_back(std::move(memory)); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    WorkspacePool& pool;
    std::unique_ptr<T> memory;
  };

  std::unique_ptr<T> take() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) return std::make_unique<T>();
    std::unique_ptr<T> memory = std::move(free_.back());
    free_.pop_back();
    return memory;
  }
  void give_back(std::unique_ptr<T> memory) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(memory));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace lightstripe
