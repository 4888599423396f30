// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/page_text.h"

#include "report/page.h"

namespace lightstripe {
namespace {

constexpr const char* kStyle =
    "body{font:14px/1.45 sans-serif;max-width:1280px;margin:24px auto;padding:0 16px;color:#222}"
    "table{border-collapse:collapse;margin:8px 0}td,th{padding:3px 7px;white-space:nowrap;border-bottom:1px "
    "solid "
    "#ddd;text-align:right}"
    "td:first-child,th:first-child{text-align:left}.fail{color:#c8401f;font-weight:bold}.strip{display:flex;"
    "flex-wrap:wrap;gap:12px}"
    "figure{margin:0;border:1px solid #ddd;padding:6px}figcaption{font-size:12px}svg text{font:11px "
    "sans-serif}";

}  // namespace

std::string page_style() { return kStyle; }

std::string page(const std::string& title, const std::string& body) {
  return "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + html_escaped(title) +
         "</title><style>" + kStyle + "</style></head><body>" + body + "</body></html>\n";
}

}  // namespace lightstripe
