// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/report_texts.h"

// The assembler takes the files in as they stand: a megabyte of JavaScript is too long for a string literal.
#define LIGHTSTRIPE_EMBED(name, path)                                    \
  asm(".section .rodata\n.global " #name "\n" #name ":\n.incbin \"" path \
      "\"\n"                                                             \
      ".global " #name "_end\n" #name "_end:\n.byte 0\n.previous\n");    \
  extern "C" const char name[];                                          \
  extern "C" const char name##_end[]

LIGHTSTRIPE_EMBED(lightstripe_report_page, LIGHTSTRIPE_REPORT_PAGE);
LIGHTSTRIPE_EMBED(lightstripe_report_script, LIGHTSTRIPE_REPORT_SCRIPT);
LIGHTSTRIPE_EMBED(lightstripe_chart_library, LIGHTSTRIPE_CHART_JS);
LIGHTSTRIPE_EMBED(lightstripe_three_library, LIGHTSTRIPE_THREE_JS);
LIGHTSTRIPE_EMBED(lightstripe_orbit_controls, LIGHTSTRIPE_ORBIT_CONTROLS_JS);

namespace lightstripe {
namespace {

std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view report_page() { return between(lightstripe_report_page, lightstripe_report_page_end); }
std::string_view report_script() { return between(lightstripe_report_script, lightstripe_report_script_end); }
std::string_view chart_library() { return between(lightstripe_chart_library, lightstripe_chart_library_end); }
std::string_view three_library() { return between(lightstripe_three_library, lightstripe_three_library_end); }
std::string_view orbit_controls() {
  return between(lightstripe_orbit_controls, lightstripe_orbit_controls_end);
}

}  // namespace lightstripe
