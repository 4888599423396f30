// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>

namespace lightstripe {
namespace {

std::atomic<bool> interrupted{false};  // all that a signal handler may touch
static_assert(std::atomic<bool>::is_always_lock_free);

void remember(int) { interrupted = true; }

void set_handler(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  if (handler != SIG_DFL)
    action.sa_flags |= static_cast<int>(SA_RESETHAND);  // the second one ends the process
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  interrupted = false;
  set_handler(remember);
  watcher_ = std::jthread([this](const std::stop_token& over) {
    while (!over.stop_requested() && !interrupted) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (interrupted) stop_.request_stop();
  });
}

InterruptWatch::~InterruptWatch() { set_handler(SIG_DFL); }

}  // namespace lightstripe
