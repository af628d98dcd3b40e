#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether links lead somewhere: of the sources within the tree, of the built site within itself, without a network.

    tools/docs/links.py                 the sources
    tools/docs/links.py build/site/html the site, too

Pages of other sites are not asked for; scripts, styles, fonts and pictures from elsewhere are refused.
"""
import html.parser
import os
import pathlib
import re
import sys
import urllib.parse

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from docs import pages  # noqa: E402


def anchors_of(text):
    """Of the headings, as GitHub and the generator make them."""
    anchors = set()
    for heading in re.findall(r"^#{1,6} (.+?)\s*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), flags=re.M):
        words = re.sub(r"[^\w\s-]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)).strip().lower()
        base, number = re.sub(r"\s+", "-", words), 0
        while (anchor := base + (f"-{number}" if number else "")) in anchors:
            number += 1
        anchors.add(anchor)
    return anchors


def check_source(source):
    """What is wrong with a source's links."""
    file, wrong = pages.root / source, []
    links = []
    pages.outside_fences(file.read_text(encoding="utf-8"), lambda part: links.extend(
        m[2] for pattern in (pages.LINK, pages.RAW) for m in pattern.finditer(part)) or part)
    for link in links:
        if pages.is_foreign(link):
            continue
        path, _, anchor = urllib.parse.unquote(link).partition("#")
        aim = (file.parent / path).resolve() if path else file
        if not aim.exists():
            wrong.append(f"{source}: {link}: there is no such file")
        elif anchor and aim.suffix == ".md" and anchor not in anchors_of(aim.read_text(encoding="utf-8")):
            wrong.append(f"{source}: {link}: no heading there makes this anchor")
    return wrong


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.needed = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.ids.update(given[key] for key in ("id", "name") if given.get(key))
        if given.get("href"):
            follows = tag == "a" or given.get("rel") in ("canonical", "next", "prev")
            (self.links if follows else self.needed).append(given["href"])
        if given.get("src"):
            self.needed.append(given["src"])


def check_site(site):
    """What is wrong within a built site, and the number of links that were followed."""
    read, wrong, followed = {}, [], 0
    for file in sorted(site.rglob("*.html")):
        read[file] = Page(file.read_text(encoding="utf-8"))
    for file, page in read.items():
        where = file.relative_to(site)
        for link in page.needed:
            if re.match(r"https?:|//", link):
                wrong.append(f"{where}: {link}: is fetched from elsewhere")
        for link in page.links + page.needed:
            if pages.is_foreign(link) or where.name == "404.html":
                continue
            path, _, anchor = urllib.parse.unquote(link.split("?")[0]).partition("#")
            aim = pathlib.Path(os.path.normpath(file.parent / path)) if path else file
            if aim.is_dir():
                aim = aim / "index.html"
            followed += 1
            if not aim.is_file():
                wrong.append(f"{where}: {link}: there is no such file")
            elif anchor and aim in read and anchor not in read[aim].ids and where.parts[0] != "sdk":  # Doxygen's own affair
                wrong.append(f"{where}: {link}: no such place in that page")
    for style in sorted(site.rglob("*.css")):
        for link in re.findall(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)", style.read_text(encoding="utf-8")):
            if re.match(r"https?:|//", link := "".join(link)):
                wrong.append(f"{style.relative_to(site)}: {link}: is fetched from elsewhere")
    return wrong, followed


if __name__ == "__main__":
    wrong = [line for source in pages.sources() for line in check_source(source)]
    followed = 0
    for folder in sys.argv[1:]:
        more, followed = check_site(pathlib.Path(folder).resolve())
        wrong += more
    print("\n".join(wrong), file=sys.stderr) if wrong else print(f"links: {len(pages.sources())} sources"
                                                                 + (f", {followed} links of the site" if followed else "") + " in order")
    sys.exit(1 if wrong else 0)
