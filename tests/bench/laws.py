#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the costs of contact laws side by side as Markdown: laws.py BRECCIA BENCH FOLDER [NAME...]; all of them without names.

Each law has the parameters of its declaration: defaults, else examples, of those that exclude each other the first. Its loop alone is
timed by `breccia check`, the whole step on the specimen of `tools/bench` (10 000 particles), where all laws take batches in turn.
"""
import json
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
from in_turn import Program, run  # noqa: E402

BATCHES = 60


def output(*command):
    return subprocess.run(command, capture_output=True, text=True).stdout


def section(program, name):
    """The law with the parameters of its declaration, as YAML reads it."""
    declared = json.loads(output(program, "describe", f"contact_law/{name}", "--format", "json"))
    first = {group[0] for group in declared.get("exactly_one_of", [])}
    chosen = [p for p in declared["parameters"] if p["name"] in first or p.get("required") and "default" not in p]
    return f"{{type: {name}" + "".join(f", {p['name']}: {p['example']}" for p in chosen) + "}"


def loop(program, name):
    """ns a pair of the law's loop alone, and whether it is vectorised."""
    told = output(program, "check", f"contact_law/{name}")
    time = re.search(r"speed: ([\d.]+) ns a pair", told)
    return time and time[1], "the loop is vectorised" in told


program, bench, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
names = sys.argv[4:] or sorted(set(re.findall(r"contact_law/(\w+)", output(program, "list"))))
names.sort(key=lambda n: n != "elastic_brittle")  # the first is what the others are held against
folder.mkdir(parents=True, exist_ok=True)
specimen = (pathlib.Path(__file__).parent / "specimen.yaml").resolve()
programs = []
for name in names:
    file = folder / f"{name}.yaml"
    file.write_text(f"base: {specimen}\nname: bench_{name}\ncontact_law: {section(program, name)}\n")
    programs.append(Program(f"{name}={bench} --serve {file} 1"))
run(programs, BATCHES)

print("| law | loop alone, ns a pair | vectorised | whole step, ns a pair | over the first | bytes a pair, of the whole simulation |")
print("|---" * 6 + "|")
first = None
for p in programs:
    least = 1e9 * min(p.times) / p.has["steps"] / p.has["pairs"]
    first = first or least
    time, vectorised = loop(program, p.label)
    print(f"| `{p.label}` | {time or 'not told'} | {'yes' if vectorised else 'no'} | {least:.1f} | {least / first:.2f} | {p.has['bytes'] / p.has['pairs']:.0f} |")
