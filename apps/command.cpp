// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/command.h"

#include <cerrno>
#include <cstdio>

#include "io/atomic_file.h"

namespace lightstripe {

namespace {

/// Best effort: a message that nobody reads any more (a closed pipe, a full disk) never costs a result. Each
/// line is flushed, so that a log shows it at once.
void put_line(std::FILE* stream, const std::string& line) {
  const std::string text = line + '\n';
  if (std::fwrite(text.data(), 1, text.size(), stream) != text.size() || std::fflush(stream) != 0)
    std::clearerr(stream);
}

}  // namespace

void say(const CommonOptions& options, const std::string& line) {
  if (!options.quiet) put_line(stdout, line);
}

void warn(const std::string& line) { put_line(stderr, "warning: " + line); }

void tell(const CommonOptions& options, const Messages& messages) {
  for (const Message& message : messages.list)
    if (message.warning)
      warn(message.text);
    else
      say(options, message.text);
}

void say_error(const std::string& line) { put_line(stderr, "error: " + line); }

void say_status(const std::string& line) { put_line(stderr, line); }

int not_usable(const std::string& reason) {
  put_line(stderr, "not usable: " + reason);
  return kExitNotUsable;
}

void print_result(const std::string& text) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  const int reason = errno;
  std::clearerr(stdout);
  if (reason != EPIPE) cannot_write("standard output", reason);  // a reader that has seen enough is no error
}

}  // namespace lightstripe
