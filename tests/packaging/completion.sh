#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
#
# What <Tab> gives in bash, and that the man page names every command of --help.
# usage: completion.sh BINARY
set -euo pipefail
binary=$(realpath "$1")
source <("$binary" generate bash-completion)
complete_words() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _lightstripe
  echo "${COMPREPLY[*]}"
}
expect() {
  local wanted=$1 got
  shift
  got=$(complete_words "$@")
  [ "$got" = "$wanted" ] || { echo "after '$*': '$got' instead of '$wanted'"; exit 1; }
}
expect "extract" lightstripe ext
expect "reconstruct" lightstripe recon
expect "--stripe-width" lightstripe extract a.png --str
expect "--extraction.stripe-width" lightstripe reconstruct --extraction.str
cd "$(mktemp -d)"
trap 'rm -r "$PWD"' EXIT
touch "two words.yaml"
expect "two words.yaml" lightstripe calibrate two

manual=$("$binary" generate man-page)
for command in $("$binary" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  [[ $manual == *".SS $command"* ]] || { echo "the man page lacks $command"; exit 1; }
  checked=1
done
[ -n "${checked:-}" ]
[[ $manual == *'\-\-threads VALUE'* && $manual == *'\fB\-\-quiet\fR'* ]] || { echo "options are described wrongly"; exit 1; }
if command -v groff >/dev/null; then
  [ -z "$(groff -man -ww -z <<<"$manual" 2>&1)" ]
fi
