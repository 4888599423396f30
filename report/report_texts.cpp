// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
#include "report/report_texts.h"

#include "core/error.h"

// NOLINTBEGIN(bugprone-macro-parentheses): `name` is the variable's.
// The assembler takes the files in as they stand: a megabyte of JavaScript is too long for a string literal.
#define LIGHTSTRIPE_EMBED(name, path)                                    \
  asm(".section .rodata\n.global " #name "\n" #name ":\n.incbin \"" path \
      "\"\n"                                                             \
      ".global " #name "_end\n" #name "_end:\n.byte 0\n.previous\n");    \
  extern "C" const char name[];                                          \
  extern "C" const char name##_end[]
// NOLINTEND(bugprone-macro-parentheses)

// Made by report/CMakeLists.txt: one LIGHTSTRIPE_EMBED a file, and the table LIGHTSTRIPE_EMBEDDED of them.
#include "report/embedded_pages.h"

namespace lightstripe {

std::string_view page_text(std::string_view name) {
  struct Text {
    std::string_view name;
    const char *begin, *end;
  };
  static const Text kTexts[] = {LIGHTSTRIPE_EMBEDDED};
  for (const Text& text : kTexts)
    if (text.name == name) return {text.begin, static_cast<std::size_t>(text.end - text.begin)};
  LIGHTSTRIPE_CHECK(false, "a part of a page that is built in");
  return {};
}

}  // namespace lightstripe
