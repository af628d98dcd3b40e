# SPDX-License-Identifier: BSD-3-Clause
"""The code blocks of Markdown texts, with what a comment before them says of how they are tried.

    <!-- block: WORDS -->     before the fence; WORDS, several divided by `; `, are
    run                       (sh) the whole block is run, in the page's folder, after the blocks before it
    file NAME                 written to NAME in the page's folder, for blocks that follow
    after COMMAND             runs COMMAND in the page's folder first
    same as PATH              must be the whole text of that file of the tree
    over PATH                 (yaml) a part of a workflow that is laid over this workflow instead of tests/docs/files/base.yaml
    not run: REASON           listed with its reason
"""
import dataclasses
import re

FENCE = re.compile(r"^( *)(```+)\s*(\S*)\s*$")
MARKER = re.compile(r"^\s*<!-- block: (.+?) -->\s*$")


@dataclasses.dataclass
class Block:
    page: str
    line: int  # of the fence
    language: str
    marker: str
    text: str

    @property
    def where(self):
        return f"{self.page}:{self.line}"


def unfenced(lines, fenced):
    """Lines at which a block begins that only its indentation makes code; under items of a list that is text."""
    in_list, blank, found = False, True, []
    for number, line in enumerate(lines, 1):
        if number in fenced:
            in_list, blank = False, True
        elif not line.strip():
            blank = True
        else:
            if re.match(r"\s{0,3}([-*+]|\d+\.)\s", line):
                in_list = True
            elif blank and line.startswith("    ") and not in_list:
                if not found or any(l.strip() and not l.startswith("    ") for l in lines[found[-1]:number - 1]):
                    found.append(number)
            elif blank and not line.startswith(" "):
                in_list = False
            blank = False
    return found


def collect(page, text):
    """Blocks of a page in their order, and what is wrong with their form."""
    lines = text.splitlines()
    blocks, wrong, fenced, k = [], [], set(), 0
    while k < len(lines):
        opening = FENCE.match(lines[k])
        if not opening:
            k += 1
            continue
        indent, fence, language = opening.groups()
        end = next((n for n in range(k + 1, len(lines)) if lines[n].strip() == fence), None)
        if end is None:
            wrong.append(f"{page}:{k + 1}: this block does not end")
            break
        before = next((lines[n] for n in range(k - 1, -1, -1) if lines[n].strip()), "")
        marker = MARKER.match(before)
        body = "".join(line.removeprefix(indent) + "\n" for line in lines[k + 1:end])
        blocks.append(Block(page, k + 1, language, marker[1] if marker else "", body))
        fenced.update(range(k + 1, end + 2))
        k = end + 1
    wrong += [f"{page}:{n}: code by indentation alone: write a fence and its language" for n in unfenced(lines, fenced)]
    return blocks, wrong
