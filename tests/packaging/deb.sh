#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
#
# Makes the .deb packages and looks into them: version, dependencies found from the binary, a binary that runs unpacked.
# usage: deb.sh CPACK BUILD_FOLDER VERSION; exit code 77 (skipped) without the tools that make packages
set -euo pipefail
cpack=$1 build=$2 version=$3
for tool in dpkg-shlibdeps dpkg-deb file; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool (apt install dpkg-dev file)"; exit 77; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$cpack" --config "$build/CPackConfig.cmake" -B "$work" -D CPACK_COMPONENTS_ALL=program >"$work/log" || { cat "$work/log"; exit 1; }
deb=$(echo "$work"/lightstripe_*.deb)
field() { dpkg-deb --field "$deb" "$1"; }
[ "$(field Version)" = "$version" ] || { echo "Version is $(field Version), not $version"; exit 1; }
for package in libc6 libopencv-core libyaml-cpp libopencv-imgcodecs libtbb; do
  [[ $(field Depends) == *"$package"* ]] || { echo "Depends lacks $package: $(field Depends)"; exit 1; }
done
[[ $(field Depends) != *-dev* ]] || { echo "a program must not depend on headers: $(field Depends)"; exit 1; }
dpkg-deb --extract "$deb" "$work/root"
[ "$("$work/root/usr/bin/lightstripe" --version)" = "$version" ]
! readelf -d "$work/root/usr/bin/lightstripe" | grep -E 'RPATH|RUNPATH'
test -s "$work/root/usr/share/man/man1/lightstripe.1"
test -s "$work/root/usr/share/lightstripe/configs/scan.yaml"
