#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
#
# The reference of all headers and pages is made without a warning.
# usage: reference.sh SOURCE_FOLDER; exit code 77 (skipped) without doxygen
set -euo pipefail
command -v doxygen >/dev/null || { echo "skipped: no doxygen (apt install doxygen)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$1"
(cat docs/Doxyfile && echo "OUTPUT_DIRECTORY = $work") | doxygen -
grep -q 'extract_stripes' "$work/html/extract__stripes_8h.html"
