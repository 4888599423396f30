#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
"""Checks who includes whom: the table of docs/architecture.md, and heavy libraries at their edge; and that no two headers
define a type of one name: a program that links both would mix them up without a word (one definition rule).

usage: check_layers.py ROOT; prints file:line for every complaint, exit code 1 if there is one.
"""
import pathlib
import re
import sys

# folder -> our own folders that it may include (besides itself)
MAY_INCLUDE = {
    "core": set(),
    "parallel": {"core"},
    "io": {"core"},
    "extraction": {"core"},
    "calib": {"extraction", "parallel", "core"},
    "reconstruct": {"extraction", "parallel", "core"},
    "measure": {"core"},
    "simulate": {"core", "io", "parallel"},
    "pipeline": {"core", "io", "parallel", "extraction", "calib", "reconstruct", "measure"},
    "report": {"core", "io", "parallel", "extraction", "calib", "reconstruct", "measure", "pipeline"},
    "truth": {"core", "io", "measure", "pipeline"},
    "apps": {"core", "io", "parallel", "extraction", "calib", "reconstruct", "measure", "simulate", "pipeline", "report", "truth"},
}
# library's include prefix -> folders where it may appear
LIBRARY_IN = {
    r"ceres/": {"calib"},
    r"pcl/": {"reconstruct"},
    r"yaml-cpp/": {"io"},
    r"opencv2/(imgcodecs|videoio|highgui)": {"io"},
    r"opencv2/calib3d|opencv2/aruco|opencv2/objdetect": {"calib"},
    r"opencv2/": {"io", "calib", "extraction", "simulate", "pipeline", "report", "apps"},
    r"CLI/": {"apps"},
    r"fmt/": {"io", "calib", "reconstruct", "simulate", "measure", "pipeline", "report", "truth", "apps"},
    r"tbb/|oneapi/tbb": {"parallel"},
    r"hwy/": {"extraction"},
    r"nlohmann/": {"report"},
    r"openssl/|xlsxwriter": {"pipeline"},
}
# the direction-guided core needs the standard library and Highway only
NO_OPENCV_FILES = re.compile(r"extraction/(follow|kernels|image|lines)/")
TYPE = re.compile(r"^(?:struct|class|enum class) (\w+)(?: final)?(?:\s*:[^{;]*)?\s*\{", re.MULTILINE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def folder_of(path):
    return path.parts[1] if path.parts[0] == "src" else path.parts[0]


def complaints(root):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.suffix not in {".h", ".cpp"} or len(relative.parts) < 2 or folder_of(relative) not in MAY_INCLUDE:
            continue
        folder = folder_of(relative)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            name = match.group(2)
            target = name.split("/")[0]
            if target in MAY_INCLUDE and target != folder and target not in MAY_INCLUDE[folder]:
                yield f"{relative}:{number}: {folder} may not include {target}"
            for prefix, folders in LIBRARY_IN.items():
                if re.match(prefix, name):
                    if folder not in folders:
                        yield f"{relative}:{number}: {folder} may not use {name}"
                    break
            if name.startswith("opencv2/") and NO_OPENCV_FILES.match(str(relative)):
                yield f"{relative}:{number}: the direction-guided core may not use {name}"


def types_defined_twice(root):
    defined_in = {}
    for path in sorted(root.rglob("*.h")):
        relative = path.relative_to(root)
        if len(relative.parts) < 2 or folder_of(relative) not in MAY_INCLUDE:
            continue
        for match in TYPE.finditer(path.read_text(encoding="utf-8")):
            first = defined_in.setdefault(match.group(1), relative)
            if first != relative:
                yield f"{relative}: {match.group(1)} is defined in {first} too; give one of them another name"


def main():
    root = pathlib.Path(sys.argv[1])
    found = list(complaints(root)) + list(types_defined_twice(root))
    print("\n".join(found) if found else "layers: clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
