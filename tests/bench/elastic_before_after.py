#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Elastic constants by two programs, as Markdown: elastic_before_after.py OLD NEW FOLDER [WORD...]

OLD and NEW are `breccia` programs, OLD one that knows no `engine.time_step`. Every workflow of the three papers runs in a small
specimen as far as its elastic constants need: by OLD, by NEW with OLD's step, by NEW with its own. WORDs choose among the workflows.
The differences are relative; of a Brazilian test, which has no elastic constants, those of the load at one displacement.
"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2] / "workflows"
EIGHTH = ["packing.container.diameter=11.5mm", "packing.container.height=23mm"]
SMALL = ["--variant", "small"]


def case(name):
    """What makes a workflow's specimen small and ends its test early: options of the program."""
    paper, test = name.split("/")
    if paper == "rojek2012":
        sets = [*EIGHTH, *(["packing.particles=1278", "protocol.max_strain=0.4%"] if "specimen1" in test else
                           ["packing.particles=734", "protocol.max_strain=0.2%"])]
        return [word for s in sets for word in ("--set", s)]
    if "bts" in test or "brazilian" in test:
        return [*SMALL, "--set", "protocol.max_displacement=0.1%"]
    if test == "concrete_cyclic_40MPa":
        return [*SMALL, "--set", "protocol.stages=[{confining_pressure: 40 MPa}, {axial_strain: 0.2 %}]"]
    brittle = "bonnet" in test or "quartzite" in test
    strain = ("0.05%" if "tension" in test else "0.2%" if "triaxial" in test and "concrete" in test else
              "0.4%" if "cement" in test else "0.1%" if brittle or paper == "onate2015" else "0.3%")
    return [*SMALL, "--set", f"protocol.max_strain={strain}"]


def run(program, name, folder, *sets):
    """The summary of a run, with the load of a Brazilian test where it has come nine tenths of its way."""
    words = [w for s in ("outputs=[]", "renderers=[]", *sets) for w in ("--set", s)]
    done = subprocess.run([program, "run", str(ROOT / f"{name}.yaml"), *case(name), *words, "--threads", "1",
                           "--overwrite", "--output", str(folder)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{name}: {done.stdout}{done.stderr}")
    summary = json.loads((folder / "summary.json").read_text())
    if "brazilian" in summary:
        rows = [(float(r["platen_displacement_m"]), float(r["load_N"])) for r in csv.DictReader((folder / "curves.csv").open())]
        way = 9e-4 * summary["brazilian"]["diameter_m"]
        at = next(k for k, row in enumerate(rows) if row[0] >= way)
        (x, f), (y, g) = rows[at - 1:at + 1]
        summary["load"] = f + (g - f) * (way - x) / (y - x)
    return summary


def apart(old, new):
    """Relative differences of modulus and Poisson's ratio."""
    keys = ("load",) if "load" in old else ("youngs_modulus_Pa", "poisson_ratio")
    return [abs(new[key] / old[key] - 1) for key in keys] + [math.nan] * (2 - len(keys))


def same_step(new, name, folder, old, *sets):
    """A run by the single particles' bound with the step of `old`: its safety factor is found from that of a first run."""
    safety = 0.8
    for _ in range(3):
        made = run(new, name, folder, "engine.time_step=bound", f"engine.time_step_safety={safety!r}", *sets)
        if abs(made["time_step_s"] / old["time_step_s"] - 1) < 1e-12:
            break
        safety *= old["time_step_s"] / made["time_step_s"]
    return made


def percent(x):
    return "" if math.isnan(x) else f"{100 * x:.3f}"


def power(x):
    return "" if math.isnan(x) else "0" if x == 0 else f"{x:.0e}"


def main():
    old_program, new_program, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    names = [f"{paper}/{file.stem}" for paper in ("rojek2012", "onate2015", "ouyang2017")
             for file in sorted((ROOT / paper).glob("*.yaml")) if re.search("^base:", file.read_text(), re.MULTILINE)]
    names = [n for n in names if all(w in n for w in sys.argv[4:])]
    print("| workflow | broken, of bonds | steps | E [GPa] | nu | E, same step | nu | step over old | E, new step [%] | nu [%] |")
    print("|---" * 10 + "|")
    for name in names:
        old = run(old_program, name, folder / "old")
        same = same_step(new_program, name, folder / "same", old)
        new = run(new_program, name, folder / "new")
        for key in ("particles", "bonds", "porosity"):
            if not old[key] == same[key] == new[key]:
                sys.exit(f"{name}: not the same specimen, {key} {old[key]}, {same[key]}, {new[key]}")
        one, other = apart(old, same), apart(old, new)
        modulus, poisson = old.get("youngs_modulus_Pa"), old.get("poisson_ratio")
        broken = old.get("bonds_broken_tension", 0) + old.get("bonds_broken_shear", 0)
        print(f"| `{name}` | {broken} of {old['bonds']} | {old['steps']} | {f'{modulus / 1e9:.3f}' if modulus else ''} | "
              f"{f'{poisson:.4f}' if poisson else ''} | {power(one[0])} | {power(one[1])} | "
              f"{new['time_step_s'] / old['time_step_s']:.2f} | {percent(other[0])} | {percent(other[1])} |", flush=True)


main()
