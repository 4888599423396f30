// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "parallel/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include "core/error.h"
#include "parallel/task_order.h"

namespace lightstripe {
namespace tbb = oneapi::tbb;

int thread_count(int threads) { return threads > 0 ? threads : tbb::info::default_concurrency(); }

struct ThreadLimit::Impl {
  explicit Impl(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads) : impl_(std::make_unique<Impl>(thread_count(threads))) {}
ThreadLimit::~ThreadLimit() = default;

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& work) {
  before_tasks();
  tbb::parallel_for(std::size_t{0}, count, Task(work));
  after_tasks();
}

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  const auto run_part = [&](const tbb::blocked_range<std::size_t>& part) {
    for (std::size_t i = part.begin(); i < part.end(); ++i) work(i);
  };
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  before_tasks();
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1), Task(run_part),
                      tbb::simple_partitioner());
  });
  after_tasks();
}

void parallel_pipeline(int threads, const std::function<void(std::size_t slots)>& prepare,
                       const PipelineSteps& steps) {
  LIGHTSTRIPE_CHECK(threads >= 0, "the number of threads must not be negative");
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : threads);
  const std::size_t slots = 2 * static_cast<std::size_t>(arena.max_concurrency());
  prepare(slots);
  std::size_t issued = 0;
  const auto issue = [&](tbb::flow_control& flow) -> std::size_t {
    const std::size_t slot = issued % slots;  // its last item was handed on: items end in order
    if (steps.issue(slot))
      ++issued;
    else
      flow.stop();
    return slot;
  };
  const auto process = [&](std::size_t slot) {
    steps.process(slot);
    return slot;
  };
  const auto collect = [&](std::size_t slot) { steps.collect(slot); };
  arena.execute([&] {
    before_tasks();
    tbb::parallel_pipeline(
        slots, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, Task(issue)) &
                   tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, Task(process)) &
                   tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, Task(collect)));
    after_tasks();
  });
}

}  // namespace lightstripe
