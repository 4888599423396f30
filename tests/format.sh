#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
#
# Every C++ file of the tree reads as .clang-format says.
# usage: format.sh SOURCE_FOLDER; exit code 77 (skipped) without clang-format 14, whose ways differ from other versions'
set -euo pipefail
wanted=14
tool=$(command -v "clang-format-$wanted" || command -v clang-format || true)
[[ -n $tool && $("$tool" --version) == *"version $wanted."* ]] || {
  echo "skipped: no clang-format $wanted (apt install clang-format-$wanted)"
  exit 77
}
cd "$1"
find apps bench calib examples extraction measure python reconstruct simulate src tests \( -name '*.cpp' -o -name '*.h' \) -print0 |
  sort -z | xargs -0 "$tool" --dry-run -Werror
