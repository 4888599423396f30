#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs the build to a folder of its own, then builds and runs tests/consumer against it.
# usage: consumer.sh CMAKE BUILD_FOLDER SOURCE_FOLDER COMPILER [COMPILER_LAUNCHER]
set -euo pipefail
cmake=$1 build=$2 source=$3 compiler=$4 launcher=${5:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$cmake" --install "$build" --prefix "$work/installed prefix" >"$work/log" || { cat "$work/log"; exit 1; }
# Moved, because a package must not remember where it was made.
mv "$work/installed prefix" "$work/prefix"
"$cmake" -G Ninja -S "$source/tests/consumer" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_COMPILER="$compiler" ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher"} >"$work/log" ||
  { cat "$work/log"; exit 1; }
"$cmake" --build "$work/build"
if grep -rlF -e "$source" -e "$build" "$work/prefix/lib" --include='*.cmake'; then
  echo "the installed CMake package names the source or build folder"
  exit 1
fi
cd "$work"
build/consumer
build/extraction_only
prefix/bin/lightstripe --version
test -s prefix/share/man/man1/lightstripe.1
test -s prefix/share/bash-completion/completions/lightstripe
