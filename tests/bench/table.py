#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints what `tools/bench --table` measured as Markdown: table.py BRECCIA FOLDER SIZE..."""
import json
import os
import pathlib
import subprocess
import sys
import time

program, folder, sizes = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
print("| law | particles | bonds | ns per bond and step, 1 thread | its processor | 2 threads | steps/s, 1 thread | speed-up | bytes per particle | "
      "at the peak | bonding [s] | prepare [s] | rebuild [s] |")
print("|---" * 13 + "|")
for law in ("elastic_brittle", "elasto_damage_plastic", "nonlinear_tension"):
    for size in sizes:
        one, two = json.loads((folder / f"table_{law}_{size}.json").read_text())
        n = one["particles"]
        print(f"| `{law}` | {n} | {one['bonds']} | {one['ns_per_bond_step']:.1f} | "
              f"{one['processor_ns_per_bond_step']:.1f} | {two['ns_per_bond_step']:.1f} | "
              f"{1000 / one['seconds_per_1000_steps']:.0f} | "
              f"{one['seconds_per_1000_steps'] / two['seconds_per_1000_steps']:.2f} | {one['bytes'] / n:.0f} | "
              f"{one['peak_bytes'] / n:.0f} | {one['bonding_seconds']:.2f} | {one['prepare_seconds']:.2f} | "
              f"{one['rebuild_seconds']:.3f} |")


def least_time(command, times):
    """Wall time of a command, the least of several [s]."""
    least = float("inf")
    for _ in range(times):
        start = time.perf_counter()
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        least = min(least, time.perf_counter() - start)
    return least


print(f"\nLoad when this was printed: {os.getloadavg()[0]:.1f}. Start-up, least of 20: `breccia --version` "
      f"{1e3 * least_time([program, '--version'], 20):.0f} ms, `breccia list` {1e3 * least_time([program, 'list'], 20):.0f} ms.")
