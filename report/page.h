// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Every page is made of one template: style, body, libraries, data as JSON, script; one file, no network.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lightstripe {

struct Page {
  std::string title;
  std::string_view name;                    ///< report/pages/NAME.html and NAME.js
  std::vector<std::string_view> libraries;  ///< as page_text() names them
  nlohmann::json data;                      ///< what the script finds as `data`
  std::string_view binary = {};             ///< base64 text for the element #binary; empty: none
};

/// The page's text. Characters that could end the script element are escaped, invalid UTF-8 is replaced.
std::string assemble_page(const Page& page);

/// For small files: the value to so many digits behind the point, null where it is not finite.
nlohmann::json rounded(double value, int decimals);

/// As the template's attributes and texts need it: & < > " escaped.
std::string html_escaped(std::string_view text);

std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace lightstripe
