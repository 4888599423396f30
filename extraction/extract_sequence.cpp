// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "extraction/extract_sequence.h"

#include <algorithm>
#include <exception>
#include <thread>

namespace lightstripe {
namespace {

std::size_t worker_count(int threads, std::size_t frames) {
  const std::size_t wanted =
      threads > 0 ? static_cast<std::size_t>(threads) : std::max(1U, std::thread::hardware_concurrency());
  return std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(frames, 1));
}

template <class T>
void extract(std::span<const ImageView<T>> frames, const ExtractionOptions& options, int threads,
             SequenceWorkspace& workspace, std::vector<ExtractionResult>& results) {
  const std::size_t count = worker_count(threads, frames.size());
  if (workspace.workers.size() < count) workspace.workers.resize(count);
  results.resize(frames.size());
  std::vector<std::exception_ptr> errors(count);
  // Frames are dealt out in turn: each worker meets the same ones in every run, so that its memory settles.
  const auto work = [&](std::size_t worker) {
    try {
      for (std::size_t i = worker; i < frames.size(); i += count)
        extract_stripes(frames[i], options, workspace.workers[worker], results[i]);
    } catch (...) {
      errors[worker] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    helpers.reserve(count - 1);
    for (std::size_t worker = 1; worker < count; ++worker) helpers.emplace_back(work, worker);
    work(0);
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

template <class T>
std::vector<ExtractionResult> extract(std::span<const ImageView<T>> frames, const ExtractionOptions& options,
                                      int threads) {
  SequenceWorkspace workspace;
  std::vector<ExtractionResult> results;
  extract(frames, options, threads, workspace, results);
  return results;
}

}  // namespace

void extract_stripes(std::span<const ImageView8> frames, const ExtractionOptions& options, int threads,
                     SequenceWorkspace& workspace, std::vector<ExtractionResult>& results) {
  extract(frames, options, threads, workspace, results);
}

void extract_stripes(std::span<const ImageView16> frames, const ExtractionOptions& options, int threads,
                     SequenceWorkspace& workspace, std::vector<ExtractionResult>& results) {
  extract(frames, options, threads, workspace, results);
}

std::vector<ExtractionResult> extract_stripes(std::span<const ImageView8> frames,
                                              const ExtractionOptions& options, int threads) {
  return extract(frames, options, threads);
}

std::vector<ExtractionResult> extract_stripes(std::span<const ImageView16> frames,
                                              const ExtractionOptions& options, int threads) {
  return extract(frames, options, threads);
}

}  // namespace lightstripe
