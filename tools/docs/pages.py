# SPDX-License-Identifier: BSD-3-Clause
"""Which sources are pages of the site, and how links between sources become links between pages.

Pages stand where they are written (README.md, docs/, the plugins' folders) and are read by people there, too, so links in
them are those between files of the tree. Here such a link becomes one to the page, or to a copy of the file.
"""
import html
import os
import pathlib
import posixpath
import re

root = pathlib.Path(__file__).resolve().parent.parent.parent

# Title in the menu, file of the tree (its place in the site follows from `place`), or what is generated.
MENU = [
    ("Home", "README.md"),
    ("Tutorials", [
        ("First workflow", "docs/tutorials/first_workflow.md"),
        ("First law", "docs/tutorials/first_law.md"),
        ("Reading results", "docs/tutorials/reading_results.md"),
    ]),
    ("Guides", [
        ("Choosing a contact law", "docs/laws.md"),
        ("Materials and scatter", "docs/materials.md"),
        ("Parameter studies", "docs/sweeps.md"),
        ("Calibration", "docs/calibration.md"),
        ("Several ranks, clusters", "docs/clusters.md"),
        ("Results in Python", "docs/python.md"),
        ("What is measured", "docs/measurements.md"),
        ("Reports", "docs/reports.md"),
        ("Writing a contact law", "docs/writing_a_law.md"),
        ("Writing a plugin", "docs/writing_a_plugin.md"),
        ("The package", "docs/package.md"),
    ]),
    ("Reference", [
        ("Workflow", "generated/reference/workflow.md"),
        ("Study", "generated/reference/sweep.md"),
        ("Calibration keys", "generated/reference/calibration.md"),
        ("Plugins", "plugins"),
    ]),
    ("Methods", [
        ("Time step, energy, determinism", "docs/methods.md"),
        ("How we test", "docs/testing.md"),
        ("What a run survives", "docs/reliability.md"),
        ("Performance", "docs/performance.md"),
        ("Validation", "docs/validation"),
    ]),
    ("Development", [
        ("Contributing", "CONTRIBUTING.md"),
        ("Architecture", "ARCHITECTURE.md"),
        ("Changelog", "CHANGELOG.md"),
    ]),
]


def sources():
    """All Markdown files that are written by hand and are pages, relative to the tree."""
    top = [root / name for name in ("README.md", "CONTRIBUTING.md", "ARCHITECTURE.md", "CHANGELOG.md")]
    found = top + sorted((root / "docs").rglob("*.md")) + sorted((root / "plugins").glob("*/*/README.md"))
    return [f.relative_to(root).as_posix() for f in found]


def is_listed(source, entries=MENU):
    """Whether the menu has a source: by itself or with its folder."""
    return any(is_listed(source, what) if isinstance(what, list) else source == what or source.startswith(what + "/")
               for _, what in entries)


def place(source):
    """Where a source stands in the site."""
    if source == "README.md":
        return "index.md"
    if source.startswith("docs/"):
        return source[len("docs/"):]
    if source.startswith("generated/"):
        return source[len("generated/"):]
    if plugin := re.fullmatch(r"plugins/(\w+)/(\w+)/README\.md", source):
        return f"plugins/{plugin[1]}/{plugin[2]}.md"
    return source.lower()


def outside_fences(text, change):
    """The text with `change` applied to all that is in no fence."""
    parts = re.split(r"(^[ ]*```.*?^[ ]*```[ ]*$)", text, flags=re.M | re.S)
    return "".join(part if k % 2 else change(part) for k, part in enumerate(parts))


LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\]|`[^`]*`)*\]\()([^)\s]+)(\))")
RAW = re.compile(r"(<(?:img|a)\b[^>]*?\b(?:src|href)=\")([^\"]+)(\")")


def is_foreign(target):
    return bool(re.match(r"[a-z][a-z0-9+.-]*:|//", target))


class Stage:
    """The folder of pages that the generator turns into the site."""

    def __init__(self, folder):
        self.folder = folder
        self.placed = {source: place(source) for source in sources()} | {"docs/validation": "validation/index.md"}
        self.copied = set()

    def link(self, source, page, target):
        """What a link of a source is called in its page; files that are no pages are copied beside the pages."""
        if is_foreign(target) or target.startswith("#"):
            return target
        path, _, anchor = target.partition("#")
        aim = posixpath.normpath(posixpath.join(posixpath.dirname(source), html.unescape(path)))
        there = self.placed.get(aim)
        if not there:
            there = aim[len("docs/"):] if aim.startswith("docs/") else "source/" + aim
            self.copy(aim, there)
        return os.path.relpath(there, posixpath.dirname(page) or ".") + ("#" + anchor if anchor else "")

    def copy(self, aim, there):
        if there in self.copied:
            return
        if not (root / aim).is_file():
            raise SystemExit(f"site: a link leads to {aim}, which is not there")
        (self.folder / there).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / there).write_bytes((root / aim).read_bytes())
        self.copied.add(there)

    def linked(self, source, page, text):
        """A source's text with its links as they are in the page."""
        def links(part):
            for pattern in (LINK, RAW):
                part = pattern.sub(lambda m: m[1] + self.link(source, page, m[2]) + m[3], part)
            return part
        return outside_fences(text, links)

    def write(self, page, text):
        file = self.folder / page
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def title(text):
    """The first heading, without marks."""
    found = re.search(r"^# (.+)$", text, flags=re.M)
    return re.sub(r"`", "", found[1]).strip() if found else ""
