// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "argument_words.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace lightstripe::python {
namespace {

/// Options that are no argument of the same name, or that come with their value.
struct OwnWords {
  std::string_view option, words;
};
constexpr std::array<OwnWords, 5> kOwnWords{
    {{"--frames", "`first_frame` and `end_frame`"},
     {"--follow", "`lightstripe reconstruct --follow`"},  // there is no such argument
     {"--nominal auto", "`nominal=\"auto\"`"},
     {"--kind rail", "`kind=\"rail\"`"},
     {"--kind wheel", "`kind=\"wheel\"`"}}};

/// The option at the beginning of `rest`, in Python's words; its length in `length`.
std::string argument_at(std::string_view rest, std::size_t& length) {
  for (const OwnWords& own : kOwnWords) {
    length = own.option.size();
    if (rest.starts_with(own.option)) return std::string(own.words);
  }
  length = std::min(rest.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), rest.size());
  std::string name(rest.substr(2, length - 2));
  std::replace(name.begin(), name.end(), '-', '_');
  return "`" + name + "`";
}

}  // namespace

std::string in_arguments(const std::string& message) {
  std::string out;
  bool command = false;
  for (std::size_t i = 0; i < message.size(); ++i) {
    if (message[i] == '`') command = !command;
    const bool begins = i == 0 || message[i - 1] == ' ' || message[i - 1] == '(';
    if (command || !begins || message.compare(i, 2, "--") != 0) {
      out += message[i];
      continue;
    }
    std::size_t length = 0;
    out += argument_at(std::string_view(message).substr(i), length);
    i += length - 1;
  }
  return out;
}

std::vector<std::string> in_arguments(std::vector<std::string> messages) {
  for (std::string& message : messages) message = in_arguments(message);
  return messages;
}

}  // namespace lightstripe::python
