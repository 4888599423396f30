#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
#
# Installs the build to a folder of its own, then builds and runs against it what a user would write: tests/consumer, the
# examples, the snippet of docs/how-to/use_as_a_library.md, one part alone by CMake, and one by pkg-config.
# usage: consumer.sh CMAKE BUILD_FOLDER SOURCE_FOLDER COMPILER [COMPILER_LAUNCHER]
set -euo pipefail
cmake=$1 build=$2 source=$3 compiler=$4 launcher=${5:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }

quietly "$cmake" --install "$build" --prefix "$work/installed prefix"
# Moved, because a package must not remember where it was made.
mv "$work/installed prefix" "$work/prefix"
if grep -rlF -e "$source" -e "$build" "$work/prefix/lib" --include='*.cmake' --include='*.pc'; then
  echo "the installed package names the source or build folder"
  exit 1
fi
awk '/^```cpp$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$source/docs/how-to/use_as_a_library.md" >"$work/snippet.cpp"
[ -s "$work/snippet.cpp" ] || { echo "docs/how-to/use_as_a_library.md shows no C++"; exit 1; }

# build_project FOLDER NAME ARGUMENTS: configures and builds it against the installation.
build_project() {
  local from=$1 name=$2
  shift 2
  quietly "$cmake" -G Ninja -S "$from" -B "$work/$name" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$compiler" ${launcher:+-DCMAKE_CXX_COMPILER_LAUNCHER="$launcher"} "$@"
  quietly "$cmake" --build "$work/$name"
}
examples=$(printf '%s;' "$source"/examples/*.cpp)
build_project "$source/tests/consumer" all "-DEXAMPLES=${examples%;}" "-DSNIPPET=$work/snippet.cpp"
hidden=()
for package in Ceres CLI11 TBB yaml-cpp PCL; do hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
build_project "$source/tests/consumer/extraction" part "${hidden[@]}"

cd "$work"
all/consumer
for example in "$source"/examples/*.cpp; do quietly "all/$(basename "$example" .cpp)"; done
part/extraction_only
if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name lightstripe-extraction.pc)")
  # shellcheck disable=SC2046  # flags are words
  "$compiler" "$source/tests/consumer/extraction/main.cpp" -o by_pkg_config $(pkg-config --cflags --libs --static lightstripe-extraction)
  ./by_pkg_config
fi
prefix/bin/lightstripe --version
test -s prefix/share/man/man1/lightstripe.1
test -s prefix/share/bash-completion/completions/lightstripe
