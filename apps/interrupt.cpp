// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <ctime>

#include "io/atomic_file.h"

namespace lightstripe {
namespace {

std::atomic<bool> interrupted{false};  // all that a signal handler may touch
static_assert(std::atomic<bool>::is_always_lock_free);

/// Ends the process as the signal would, but leaves no temporary file behind.
void clean_and_end(int signal) {
  delete_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);  // a signal handler may call it
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// The second one ends the process. One that comes at once is the first one again: `timeout` sends its signal
/// to the process and to the group that it is in.
void remember(int signal) {
  constexpr std::int64_t kOnePress = 300'000'000;  // ns
  static std::atomic<std::int64_t> first_ns{0};
  if (!interrupted.exchange(true))
    first_ns = now_ns();
  else if (now_ns() - first_ns > kOnePress)
    clean_and_end(signal);
}

void set_handler(int signal, void (*handler)(int)) {
  struct sigaction action {
  }, before{};
  sigaction(signal, nullptr, &before);
  if (before.sa_handler == SIG_IGN) return;  // nohup, or a shell's job in the background
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  interrupted = false;
  set_handler(SIGINT, remember);
  set_handler(SIGTERM, remember);
  watcher_ = std::jthread([this](const std::stop_token& over) {
    while (!over.stop_requested() && !interrupted) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (interrupted) stop_.request_stop();
  });
}

InterruptWatch::~InterruptWatch() {
  set_handler(SIGINT, clean_and_end);
  set_handler(SIGTERM, clean_and_end);
}

void clean_up_at_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) set_handler(signal, clean_and_end);
}

}  // namespace lightstripe
