#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
#
# `pip install .` into a virtual environment of its own, with what is already built, then uses the package there.
# usage: pip.sh PYTHON BUILD_FOLDER SOURCE_FOLDER
set -euo pipefail
python=$1 build=$2 source=$3
"$python" -c 'import venv, ensurepip, setuptools, wheel, numpy' 2>/dev/null ||
  { echo "skipped: needs python3-venv python3-setuptools python3-wheel python3-numpy"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# A copy, because setuptools leaves its own folders beside the sources.
mkdir "$work/source"
tar -C "$source" --exclude=./build* --exclude=./.git --exclude=./docs --exclude=./tests --exclude='./demo-output*' -cf - . | tar -C "$work/source" -xf -
"$python" -m venv --system-site-packages "$work/venv"
LIGHTSTRIPE_BUILD=$build "$work/venv/bin/pip" install --quiet --no-build-isolation --no-index --no-deps "$work/source"
cd "$work"
venv/bin/python - <<'PYTHON'
import lightstripe
import numpy

assert "venv" in lightstripe.__file__, lightstripe.__file__
assert lightstripe.extract(numpy.zeros((8, 8), numpy.uint8)).stripes == []
print("pip: ok", lightstripe.__version__)
PYTHON
ls venv/lib/python3*/site-packages/lightstripe/py.typed
