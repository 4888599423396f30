// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What a person is told at the end of a job.
#pragma once

#include <string>
#include <vector>

namespace lightstripe {

struct Message {
  std::string text;
  bool warning = false;  ///< told even to those who asked for silence
};

/// In the order in which they are told.
struct Messages {
  std::vector<Message> list;

  void say(std::string text) { list.push_back({std::move(text), false}); }
  void warn(std::string text) { list.push_back({std::move(text), true}); }
  void append(const Messages& more) { list.insert(list.end(), more.list.begin(), more.list.end()); }
};

}  // namespace lightstripe
