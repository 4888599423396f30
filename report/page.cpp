// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/page.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "report/report_texts.h"

namespace lightstripe {
namespace {

void put(std::string& out, std::string_view mark, std::string_view& rest, std::string_view with) {
  const std::size_t at = rest.find(mark);
  LIGHTSTRIPE_CHECK(at != std::string_view::npos, "the template has all marks, in order");
  out.append(rest.substr(0, at)).append(with);
  rest.remove_prefix(at + mark.size());
}

std::string script_data(const nlohmann::json& data) {
  std::string out;
  const std::string text = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  out.reserve(text.size());
  for (const char c : text) c == '<' ? out += "\\u003c" : out += c;  // '<' stands in strings only
  return out;
}

}  // namespace

std::string assemble_page(const Page& page) {
  std::string libraries, out;
  for (const std::string_view library : page.libraries)
    libraries += fmt::format("<script>{}</script>\n", page_text(library));
  if (!page.binary.empty())
    libraries += fmt::format("<script id=\"binary\" type=\"application/octet-stream;base64\">{}</script>\n",
                             page.binary);
  std::string_view rest = page_text("page.html");
  put(out, "<!--TITLE-->", rest, html_escaped(page.title));
  put(out, "/*STYLE*/", rest, page_text("page.css"));
  put(out, "<!--BODY-->", rest, page_text(fmt::format("{}.html", page.name)));
  put(out, "<!--LIBRARIES-->", rest, libraries);
  put(out, "<!--DATA-->", rest, script_data(page.data));
  put(out, "/*COMMON*/", rest, page_text("common.js"));
  put(out, "/*PAGE*/", rest, page_text(fmt::format("{}.js", page.name)));
  return out.append(rest);
}

nlohmann::json rounded(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

std::string html_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) { return i + k < bytes.size() ? unsigned{bytes[i + k]} : 0U; };
    const unsigned group = at(0) << 16 | at(1) << 8 | at(2);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace lightstripe
