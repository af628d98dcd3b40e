#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tries every code block of the site's sources: workflows are validated, commands run or read, programs compiled.

    tests/docs/try_blocks.py [--program build/bin/breccia] [PAGE ...]

Without PAGE all sources. With --expect-wrong each of a page's blocks must be found to be wrong, and something in the form
of the page, too: the test of the test.
"""
import argparse
import pathlib
import sys
import tempfile
import time

sys.dont_write_bytecode = True
root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tools"))
from docs import pages  # noqa: E402

import blocks  # noqa: E402
import trials  # noqa: E402

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("pages", nargs="*", metavar="PAGE", help="relative to the tree")
parser.add_argument("--program", type=pathlib.Path, default=root / "build/bin/breccia")
parser.add_argument("--expect-wrong", action="store_true")
parser.add_argument("--times", action="store_true", help="what each block took")
arguments = parser.parse_args()
program = arguments.program.resolve()

wrong, skipped, count, missed, form = [], [], 0, [], []
with tempfile.TemporaryDirectory(prefix="breccia_docs_") as scratch:
    tried = trials.Trials(program, program.parent.parent, pathlib.Path(scratch))
    for page in arguments.pages or pages.sources():
        found, badly_formed = blocks.collect(page, (root / page).read_text(encoding="utf-8"))
        form += badly_formed
        for block in found:
            count += 1
            begin = time.monotonic()
            try:
                if problem := tried.trial(block):
                    wrong.append(f"{block.where}: {problem}")
                else:
                    missed.append(block.where)
            except trials.Skip as reason:
                skipped.append(f"{block.where}: {reason}")
            if arguments.times:
                print(f"{time.monotonic() - begin:6.1f} s {block.where}")

if arguments.expect_wrong:
    print("\n".join(wrong + form))
    if missed or skipped:
        sys.exit("found to be in order: " + ", ".join(missed + skipped))
    sys.exit(0 if wrong and form else "nothing was found to be wrong")
print(f"{count} blocks: " + ", ".join(f"{n} {what}" for what, n in sorted(tried.counts.items())))
print(f"{len(skipped)} not run" + "".join("\n  " + line for line in skipped))
if wrong or form:
    sys.exit("\n".join(wrong + form))
