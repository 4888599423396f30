// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// How lightstripe reports trouble. The world is wrong (a file, a key, an image): throw Error, caught once in
// main. The caller is wrong (a precondition): LIGHTSTRIPE_CHECK, a std::logic_error with file:line.
// Data that say no (no stripe in a frame, a parallel ray) are counted or optional, never thrown.
#pragma once

#include <stdexcept>
#include <string>

namespace lightstripe {

/// The message of an Error reads "<subject>: <what is wrong>; <what to do>".
class Error : public std::runtime_error {
 public:
  /// `subject`: the file or the key; `what_is_wrong` and `what_to_do` are half sentences without full stop.
  Error(const std::string& subject, const std::string& what_is_wrong, const std::string& what_to_do)
      : std::runtime_error(subject + ": " + what_is_wrong + "; " + what_to_do) {}
};

[[noreturn]] void fail_check(const char* condition, const std::string& message, const char* file, int line);

}  // namespace lightstripe

#define LIGHTSTRIPE_CHECK(condition, message) \
  ((condition) ? static_cast<void>(0) : ::lightstripe::fail_check(#condition, (message), __FILE__, __LINE__))
