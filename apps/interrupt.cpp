// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>

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

void remember(int signal) {
  if (interrupted.exchange(true)) clean_and_end(signal);  // the second one ends the process
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
