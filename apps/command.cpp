// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <cstdio>
#include <opencv2/core.hpp>

namespace lightstripe {

void add_common_options(CLI::App& app, CommonOptions& options, const std::string& output_help) {
  app.add_option("-o,--output", options.output, output_help)->group("General");
  app.add_option("--threads", options.threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 1024))
      ->group("General");
  app.add_flag("--quiet", options.quiet, "print warnings and errors only")->group("General");
}

int thread_count(const CommonOptions& options) {
  return options.threads > 0 ? options.threads : oneapi::tbb::info::default_concurrency();
}

struct ThreadLimit::Impl {
  explicit Impl(int threads)
      : limit(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)) {}
  oneapi::tbb::global_control limit;
};

// OpenCV is kept to one thread: whatever runs in parallel here runs image by image.
ThreadLimit::ThreadLimit(const CommonOptions& options) : impl_(new Impl(thread_count(options))) {
  cv::setNumThreads(1);
}
ThreadLimit::~ThreadLimit() { delete impl_; }

void say(const CommonOptions& options, const std::string& line) {
  if (!options.quiet) fmt::print("{}\n", line);
}

void warn(const std::string& line) { fmt::print(stderr, "warning: {}\n", line); }

int not_usable(const std::string& reason) {
  fmt::print(stderr, "not usable: {}\n", reason);
  return kExitNotUsable;
}

}  // namespace lightstripe
