#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs programs in turn, a short batch of steps each, so that other work on the machine is in the way of each alike.

    in_turn.py BATCHES LABEL=COMMAND LABEL=COMMAND...

A command says `READY` and what it has as JSON (`bonds`, `steps`), then answers every line with `SECONDS` of a batch (of the
processor, so that other work on the machine does not count, but for what it does to the caches). Printed
are the least and the median time per bond and step, and those over the first command's.
"""
import json
import shlex
import statistics
import subprocess
import sys


class Program:
    """One of them, started and ready."""

    def __init__(self, text):
        self.label, _, command = text.partition("=")
        self.process = subprocess.Popen(shlex.split(command), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.has = json.loads(self.answer("READY"))
        self.times = []

    def answer(self, word):
        for line in self.process.stdout:
            if line.startswith(word + " "):
                return line[len(word) + 1:]
        sys.exit(f"{self.label}: ended before it said {word}")

    def batch(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        self.times.append(float(self.answer("SECONDS")))


def run(programs, batches):
    """Batches of all of them in turn; then they end."""
    for _ in range(batches):
        for program in programs:
            program.batch()
    for program in programs:
        program.process.stdin.close()
        program.process.wait()


def main():
    programs = [Program(text) for text in sys.argv[2:]]
    run(programs, int(sys.argv[1]))
    print(f"{'':>20}  {'particles':>9} {'bonds':>8}  {'least':>8} {'median':>8}  ns per bond and step; over the first")
    first = None
    for program in programs:
        each = 1e9 / program.has.get("steps", programs[0].has["steps"]) / program.has["bonds"]
        least, median = each * min(program.times), each * statistics.median(program.times)
        first = first or (least, median)
        print(f"{program.label:>20}  {program.has['particles']:>9} {program.has['bonds']:>8}  {least:>8.2f} {median:>8.2f}  "
              f"{least / first[0]:.3f} {median / first[1]:.3f}")


if __name__ == "__main__":
    main()
