#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0
"""Checks who includes whom against cmake/layers.txt: our own rooms, heavy libraries at their edge, headers that are there; that no
two headers define a type of one name (a program that links both would mix them up without a word: one definition rule); that
docs/architecture.md shows the table as it is; and that each file which may hold an algorithm has a test beside it, or a line in
tests/beside.txt that says why not.

usage: check_layers.py ROOT [--write]; prints file:line for every complaint, exit code 1 if there is one. --write: brings the table
in docs/architecture.md up to date.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
TYPE = re.compile(r"^(?:struct|class|enum class) (\w+)(?: final)?(?:\s*:[^{;]*)?\s*\{", re.MULTILINE)
# The direction-guided core needs the standard library and Highway only.
NO_OPENCV_FILES = re.compile(r"extraction/(follow|kernels|image|lines)/")
TESTS_OF_EVERYTHING = {"apps", "fuzz", "consumer"}
GENERATED = {"io/embedded_profiles.h", "report/embedded_pages.h", "tests/test_paths.h"}  # by CMake
ROOMS_OF_ALGORITHMS = ("calib", "extraction", "measure")
BEGIN, END = "<!-- layers: begin -->\n", "<!-- layers: end -->\n"


class Table:
    def __init__(self, path):
        self.rooms = []  # (kind, name, names of the rooms that it may include, what it holds)
        self.external = []  # (pattern, rooms)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if not line.strip() or line.startswith("#"):
                continue
            cells = [cell.strip() for cell in re.split(r" \| ?", line)]
            if cells[0] == "external" and len(cells) == 3:
                self.external.append((re.compile(cells[1]), set(cells[2].split())))
            elif cells[0] in {"library", "program", "tests"} and len(cells) == 4:
                self.rooms.append((cells[0], cells[1], cells[2].split(), cells[3]))
            else:
                sys.exit(f"{path}:{number}: is no row of the table")
        self.allowed = {name: set(may) for _, name, may, _ in self.rooms}

    def may_include(self, room, path):
        """What a file of this room may include, itself among it."""
        if room != "tests":
            return self.allowed[room] | {room}
        tested = path.parts[1] if len(path.parts) > 2 else ""
        if tested in TESTS_OF_EVERYTHING or tested not in self.allowed:
            return set(self.allowed)
        return self.allowed[tested] | {tested, "tests"} | self.allowed["tests"]

    def page(self, root):
        rows = ["| folder | holds | may include |\n|---|---|---|\n"]
        for _, name, may, holds in self.rooms:
            folder = f"src/{name}" if (root / "src" / name).is_dir() else name
            rows.append(f"| `{folder}` | {holds} | {', '.join(may) or 'Eigen, the standard library'} |\n")
        return "".join(rows)


def room_of(path):
    return path.parts[1] if path.parts[0] == "src" else path.parts[0]


def sources(root, table):
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root)
        if path.suffix in {".h", ".cpp"} and len(relative.parts) > 1 and room_of(relative) in table.allowed:
            yield path, relative


def is_there(root, path, name):
    roots = [path.parent, root, root / "src", root / "tests", root / "tests" / "extraction"]
    return any((base / name).exists() for base in roots)


def complaints_of_line(root, table, path, relative, match):
    room, name = room_of(relative), match.group(2)
    target = name.split("/")[0]
    if target in table.allowed and match.group(1) == '"':
        if target not in table.may_include(room, relative):
            yield f"{room} may not include {target}"
        if name not in GENERATED and not is_there(root, path, name):
            yield f"{name} does not exist"
    for pattern, rooms in table.external:
        if pattern.match(name):
            if room not in rooms:
                yield f"{room} may not use {name}"
            break
    if name.startswith("opencv2/") and NO_OPENCV_FILES.match(str(relative)):
        yield f"the direction-guided core may not use {name}"


def complaints(root, table):
    for path, relative in sources(root, table):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if match := INCLUDE.match(line):
                for text in complaints_of_line(root, table, path, relative, match):
                    yield f"{relative}:{number}: {text}"


def types_defined_twice(root, table):
    defined_in = {}
    for path, relative in sources(root, table):
        if path.suffix != ".h" or room_of(relative) == "tests":
            continue
        for match in TYPE.finditer(path.read_text(encoding="utf-8")):
            first = defined_in.setdefault(match.group(1), relative)
            if first != relative:
                yield f"{relative}: {match.group(1)} is defined in {first} too; give one of them another name"


def page_is_old(root, table, write):
    page = root / "docs" / "architecture.md"
    text = page.read_text(encoding="utf-8")
    if BEGIN not in text or END not in text:
        return [f"{page.relative_to(root)}: lacks the marks {BEGIN.strip()} and {END.strip()}"]
    before, rest = text.split(BEGIN, 1)
    old, after = rest.split(END, 1)
    if old == table.page(root):
        return []
    if write:
        page.write_text(before + BEGIN + table.page(root) + END + after, encoding="utf-8")
        return []
    return [f"{page.relative_to(root)}: shows another table than cmake/layers.txt; run scripts/check_layers.py . --write"]


def excused_files(root):
    """File -> where it is tested instead ("-": it holds no algorithm), and what is wrong with the table."""
    table, excused, wrong = root / "tests" / "beside.txt", {}, []
    for number, line in enumerate(table.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) != 3 or not all(cells):
            wrong.append(f"tests/beside.txt:{number}: is no row of the table")
            continue
        name, tested_in, _ = cells
        wrong += [f"tests/beside.txt:{number}: {path} does not exist" for path in (name, tested_in)
                  if path != "-" and not (root / path).is_file()]
        excused[name] = tested_in
    return excused, wrong


def files_without_test(root):
    excused, found = excused_files(root)
    for room in ROOMS_OF_ALGORITHMS:
        for path in sorted((root / room).rglob("*.cpp")):
            name = str(path.relative_to(root))
            tests = [root / "tests" / room / f"{path.stem}{kind}_test.cpp" for kind in ("", ".scene", ".data")]
            has_test = any(test.is_file() for test in tests)
            if has_test and name in excused:
                found.append(f"{name}: has a test beside it; take it out of tests/beside.txt")
            if not has_test and name not in excused:
                found.append(f"{name}: lacks {tests[0].relative_to(root)} (or a line in tests/beside.txt that says why)")
    return found


def main():
    root = pathlib.Path(sys.argv[1])
    table = Table(root / "cmake" / "layers.txt")
    found = list(complaints(root, table)) + list(types_defined_twice(root, table))
    found += files_without_test(root)
    found += page_is_old(root, table, "--write" in sys.argv[2:])
    print("\n".join(found) if found else "layers: clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
