#!/usr/bin/python3
"""Checks the rules of the house that a compiler does not: who may include whom, and words that must not appear.

Usage: check_layering.py SOURCE_ROOT. The order of the rooms is the order of add_subdirectory in src/CMakeLists.txt.
"""
import re
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
ROOM_LINE = re.compile(r"^\s*add_subdirectory\(\s*(\w+)\s*\)", re.MULTILINE)
SOURCES = {".h", ".cpp"}

FORBIDDEN = [
    (re.compile(r"\bu?sleep\s*\("), "sleeps: wait on a condition variable"),
    (re.compile(r"\bsleep_(for|until)\b"), "sleeps: wait on a condition variable"),
    (re.compile(r"(?<![\w.>])exit\s*\("), "ends the process: throw"),
    (re.compile(r"\bdetach\s*\("), "detaches a thread: join it"),
]

# Only the viewer draws: everything else has to build, link and run where there is no OpenGL.
GRAPHICS = re.compile(r"(GL|GLFW|epoxy|backends)/.*|imgui.*")

# What the public headers may include beside cpslam/* and the standard library.
PUBLIC_OUTSIDE = re.compile(r"opencv2/core(\.hpp|/.*)")
STANDARD_HEADER = re.compile(r"[a-z_0-9]+")


def without_comments(text):
    """The code with comments and string literals blanked, line by line as it was."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in SOURCES)


def check_rooms(root):
    order = ROOM_LINE.findall((root / "src" / "CMakeLists.txt").read_text())
    if not order:
        yield "src/CMakeLists.txt: names no room"
    for path in sources(root / "src"):
        room = path.relative_to(root / "src").parts[0]
        name = path.relative_to(root)
        if room not in order:
            yield f"{name}: the room '{room}' is not in src/CMakeLists.txt"
            continue
        for number, quote, included in includes(path):
            target = included.split("/")[0]
            if target in order and "/" in included:
                if quote == "<":
                    yield f"{name}:{number}: include {included} with quotes: it is ours"
                if order.index(target) > order.index(room):
                    yield f"{name}:{number}: room '{room}' may not include '{included}': '{target}' stands above it"
            elif quote == '"' and "/" not in included:
                yield f"{name}:{number}: write '{included}' with its room: room/file.h"


def check_graphics(root):
    for folder in ("src", "include", "Examples"):
        for path in sources(root / folder):
            name = path.relative_to(root)
            if name.parts[:2] == ("src", "viewer"):
                continue
            for number, _, included in includes(path):
                if GRAPHICS.fullmatch(included):
                    yield f"{name}:{number}: only the room 'viewer' may include '{included}'"


def check_public_headers(root):
    for path in sources(root / "include"):
        for number, _, included in includes(path):
            if included.startswith("cpslam/") or PUBLIC_OUTSIDE.fullmatch(included):
                continue
            if not STANDARD_HEADER.fullmatch(included):
                yield f"{path.relative_to(root)}:{number}: a public header may not include '{included}'"


def check_words(root):
    for folder in ("src", "include", "Examples"):
        for path in sources(root / folder):
            for number, line in enumerate(without_comments(path.read_text()).splitlines(), start=1):
                for pattern, reason in FORBIDDEN:
                    if pattern.search(line):
                        yield f"{path.relative_to(root)}:{number}: '{line.strip()}' {reason}"
    build_files = [root / "CMakeLists.txt", root / "CMakePresets.json"]
    for folder in ("cmake", "src", "Examples", "Thirdparty"):
        build_files += sorted(p for p in (root / folder).rglob("*") if p.name == "CMakeLists.txt" or p.suffix == ".cmake")
    for path in build_files:
        if path.exists() and re.search(r"-m(arch|tune)=native", path.read_text()):
            yield f"{path.relative_to(root)}: builds for the machine at hand only (march=native)"


def check(root):
    return [*check_rooms(root), *check_graphics(root), *check_public_headers(root), *check_words(root)]


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    problems = check(Path(sys.argv[1]))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
