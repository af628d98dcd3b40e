#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Holds the sources to the arrows that ARCHITECTURE.md draws.

The block that begins with `# arrows:` has one line per room of core/: its name, the rooms that it may use, `:` and what
it is for. Refused, with file and line: an include that no arrow allows; in a plugin, whatever is neither the SDK nor
its own folder nor plugins/shared; a CMake target that links a room without an arrow. Refused, too: arrows that nothing
uses, since the drawing tells what is, and one to a room that does not stand above: so no way leads back.
"""
import argparse
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
LINKED = re.compile(r"\b(?:breccia_([a-z]+)|Breccia::(sdk))\b")


class Tree:
    """A tree of sources and what is wrong with it."""

    def __init__(self, root):
        self.root = root
        self.wrong = []
        self.rooms = {d.name for d in (root / "core").iterdir() if d.is_dir()}
        self.arrows = self.drawn()
        self.used = set()

    def say(self, file, line, text):
        self.wrong.append(f"{file.relative_to(self.root)}:{line}: {text}")

    def drawn(self):
        """Room to the rooms that it may use, from the drawing."""
        page = self.root / "ARCHITECTURE.md"
        lines = page.read_text(encoding="utf-8").splitlines()
        begins = [k for k, line in enumerate(lines) if line.strip() == "# arrows: room -> rooms that it may use : what it is for"]
        if len(begins) != 1:
            sys.exit("ARCHITECTURE.md: there must be one block of arrows, it is what the sources are held to")
        arrows = {}
        self.place = {}
        for k in range(begins[0] + 1, len(lines)):
            if lines[k].startswith("```"):
                break
            match = re.fullmatch(r"([a-z]+) *->([a-z ]*):.*", lines[k])
            if not match:
                if lines[k].strip() and not lines[k].startswith(" "):  # what goes on is indented
                    self.say(page, k + 1, "not `room -> rooms : what it is for`")
                continue
            room, uses = match[1], match[2].split()
            if room in arrows:
                self.say(page, k + 1, f"{room} stands there twice")
            arrows[room] = set(uses)
            self.place[room] = k + 1
            for other in uses:  # a line may name only rooms that stand above it: no way leads back
                if other not in arrows or other == room:
                    self.say(page, k + 1, f"{room} -> {other}: {other} does not stand above it")
        for room in sorted(self.rooms - arrows.keys()):
            self.say(page, begins[0] + 1, f"core/{room} is not in the drawing")
        for room in sorted(arrows.keys() - self.rooms):
            self.say(page, self.place[room], f"there is no core/{room}")
        return arrows

    def sources(self, folder):
        return sorted(f for f in (self.root / folder).rglob("*") if f.suffix in (".hpp", ".cpp", ".h", ".in"))

    def includes(self, file):
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            if match := INCLUDE.match(line):
                yield number, match[1] == '"', match[2]

    def room_of(self, file, name):
        """Of an included name: a room of the core, or none."""
        first = name.split("/")[0]
        if first == "breccia":
            return "sdk"
        if (file.parent / name).is_file():
            inner = (file.parent / name).resolve().relative_to(self.root)
            return inner.parts[1] if inner.parts[0] == "core" else None
        return first if first in self.rooms and "/" in name else None

    def check_core(self):
        for file in self.sources("core"):
            room = file.relative_to(self.root).parts[1]
            for line, _, name in self.includes(file):
                other = self.room_of(file, name)
                if other is None or other == room:
                    continue
                self.used.add((room, other))
                if other not in self.arrows.get(room, ()):
                    self.say(file, line, f"core/{room} may not include {name}: ARCHITECTURE.md draws no arrow {room} -> {other}")

    def check_plugins(self):
        shared = self.root / "plugins/shared"
        for file in self.sources("plugins"):
            own = self.root.joinpath(*file.relative_to(self.root).parts[:3])
            for line, quoted, name in self.includes(file):
                if name.startswith("breccia/"):
                    continue
                at = (file.parent / name).resolve()
                inside = quoted and at.is_file() and (at.is_relative_to(own) or at.is_relative_to(shared))
                if inside or not (quoted or self.room_of(file, name)):
                    continue
                self.say(file, line, f"a plugin includes the SDK, its own folder and plugins/shared, not {name}")

    def check_targets(self):
        for file in sorted((self.root / "core").glob("*/CMakeLists.txt")):
            room = file.parent.name
            for line, text in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
                if "target_link_libraries" not in text:
                    continue
                for match in LINKED.finditer(text):
                    other = match[1] or match[2]
                    if other in self.rooms and other != room and other not in self.arrows.get(room, ()):
                        self.say(file, line, f"core/{room} may not link {match[0]}: ARCHITECTURE.md draws no arrow to it")

    def check_drawing(self):
        for room, uses in self.arrows.items():
            for other in sorted(uses & self.rooms):
                if (room, other) not in self.used:
                    self.say(self.root / "ARCHITECTURE.md", self.place.get(room, 1),
                             f"nothing in core/{room} includes a header of core/{other}: the arrow is not needed")

    def check(self):
        self.check_core()
        self.check_plugins()
        self.check_targets()
        self.check_drawing()
        return self.wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("root", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).parents[2])
    wrong = Tree(parser.parse_args().root.resolve()).check()
    print("\n".join(wrong) if wrong else "the includes are those that ARCHITECTURE.md draws")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
