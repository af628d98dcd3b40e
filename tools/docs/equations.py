# SPDX-License-Identifier: BSD-3-Clause
"""Equations of the built pages, rendered once and for all by KaTeX: readers need no script and no network."""
import html
import json
import pathlib
import re
import shutil
import subprocess

MARKED = re.compile(r'<(span|div) class="arithmatex">\s*(\\\(|\\\[)(.*?)(\\\)|\\\])\s*</\1>', re.S)
KATEX = pathlib.Path("/usr/share/javascript/katex")


def render(site):
    """Returns the number of equations; ends the program when one is wrong."""
    pages = {page: page.read_text(encoding="utf-8") for page in sorted(site.rglob("*.html"))}
    found = {(html.unescape(m[3]).strip(), m[2] == r"\["): page for page, text in pages.items() for m in MARKED.finditer(text)}
    script = pathlib.Path(__file__).with_name("equations.js")
    done = subprocess.run(["node", script], input=json.dumps(list(found)), capture_output=True, text=True)
    if done.returncode:
        raise SystemExit("site: equations: " + done.stderr)
    answers = dict(zip(found, json.loads(done.stdout)))
    wrong = [f"site: {found[which].relative_to(site)}: {which[0]}: {answer['wrong']}"
             for which, answer in answers.items() if "wrong" in answer]
    if wrong:
        raise SystemExit("\n".join(wrong))
    for page, text in pages.items():
        def put(match):
            return f'<{match[1]} class="arithmatex">{answers[html.unescape(match[3]).strip(), match[2] == chr(92) + "["]["html"]}</{match[1]}>'
        if (new := MARKED.sub(put, text)) != text:
            page.write_text(new, encoding="utf-8")
    shutil.copytree(KATEX / "fonts", site / "katex/fonts", dirs_exist_ok=True)
    shutil.copy(KATEX / "katex.min.css", site / "katex/katex.min.css")
    return len(found)
