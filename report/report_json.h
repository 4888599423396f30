// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Values as JSON text inside an HTML page.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightstripe {

/// A quoted text; '<' is escaped, so that it cannot end the script element it stands in.
std::string json(std::string_view text);
/// A number to nine digits; 0 for what is not finite.
std::string json(double value);

class JsonList {
 public:
  void add(const std::string& item) { items_ += (items_.empty() ? "" : ",\n") + item; }
  std::string text() const { return "[" + items_ + "]"; }

 private:
  std::string items_;
};

std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace lightstripe
