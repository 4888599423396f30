// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"

namespace lightstripe {

void fail_check(const char* condition, const std::string& message, const char* file, int line) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": " + message + " (" + condition +
                         ")");
}

}  // namespace lightstripe
