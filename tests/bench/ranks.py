#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Ranks against threads: time of a step and memory of each process.

    tests/bench/ranks.py --particles 100000 --ways 1x1 1x2 2x1      # ranks x threads, in turn, least of three
    tests/bench/ranks.py --particles 100000 --ways 1x1 2x1 --weak   # so many particles for each rank
    tests/bench/ranks.py --particles 10000000 --lattice sc --ways 2x1 --strain 3e-5 --repeats 1
    tests/bench/ranks.py --particles 300000 --ways 2x1 --checkpoints 4  # and with one every four steps

One box of spheres on a lattice is pressed between platens; rows of curves are few, so that bringing the specimen
together does not count. Run it on a machine that does nothing else.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

WORKFLOW = """packing:
  {{type: regular, lattice: {lattice}, container: {{shape: box, size: [{edge} mm, {edge} mm, {height} mm]}}, radius: 1 mm}}
material: {{density: 2650 kg/m3}}
bonding: {{tolerance: 0.01}}
damping: {{translational: 0.3, rotational: 0.3}}
contact_law: {{type: elastic_brittle, bond_modulus: 10 GPa, stiffness_ratio: 3.7, tensile_strength: 40 MPa,
  shear_strength: 40 MPa, friction: 0.5}}
protocol: {{type: uniaxial_compression, platen_velocity: 0.1 m/s, platen_stiffness: 15 MN/m, seating_stress: 0 Pa,
  max_strain: {strain}}}
sampling: {{every_steps: 1000000}}
checkpoints: {{{checkpoints}}}
outputs: []
renderers: []
"""


def one_rank(folder, command):
    """What each rank is started as: it leaves what its process has taken [GiB] in the folder."""
    code = subprocess.run(command).returncode
    taken = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 2**20
    rank = os.environ.get("OMPI_COMM_WORLD_RANK", "0")
    (pathlib.Path(folder) / f"memory_{rank}").write_text(str(taken))
    raise SystemExit(code)


def run(program, workflow, folder, ranks, threads):
    """Milliseconds a step; nanoseconds a bond and step; seconds in all; steps; particles; memory of the first process,
    and of the largest other [GiB]."""
    for old in folder.parent.glob("memory_*"):
        old.unlink()
    command = [sys.executable, __file__, "--one-rank", str(folder.parent), program, "run", str(workflow),
               "--output", str(folder), "--overwrite", "--threads", str(threads)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-n", str(ranks)] + command
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    memory = {path.name: float(path.read_text()) for path in folder.parent.glob("memory_*")}
    summary = json.loads((folder / "summary.json").read_text())
    first = memory.pop("memory_0")
    ns = summary["ns_per_bond_step"]
    return (ns * summary["bonds"] * 1e-6, ns, summary["wall_time_s"], summary["steps"], summary["particles"], first,
            max(memory.values(), default=0))


def main():
    if sys.argv[1:2] == ["--one-rank"]:
        one_rank(sys.argv[2], sys.argv[3:])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/bin/breccia")
    parser.add_argument("--particles", type=float, default=1e5)
    parser.add_argument("--ways", nargs="+", default=["1x1", "1x2", "2x1"], metavar="RANKSxTHREADS")
    parser.add_argument("--lattice", choices=("fcc", "sc"), default="fcc", help="with twelve or six neighbours")
    parser.add_argument("--weak", action="store_true", help="so many particles for each rank, in a longer box")
    parser.add_argument("--strain", default="1e-5")
    parser.add_argument("--checkpoints", type=int, metavar="STEPS", help="one every so many steps; none unless given")
    parser.add_argument("--repeats", type=int, default=3)
    a = parser.parse_args()
    edge = (a.particles * (8 if a.lattice == "sc" else 4 * 2**0.5)) ** (1 / 3)  # of a box with so many spheres of 1 mm
    checkpoints = f"every_steps: {a.checkpoints}, keep: 1" if a.checkpoints else "keep: 0"
    with tempfile.TemporaryDirectory() as name:
        place = pathlib.Path(name)
        best = {}
        for _ in range(a.repeats):
            for way in a.ways:
                ranks, threads = map(int, way.split("x"))
                height = edge * (ranks if a.weak else 1)
                (place / "w.yaml").write_text(WORKFLOW.format(
                    lattice=a.lattice, edge=f"{edge:.3f}", height=f"{height:.3f}", strain=a.strain, checkpoints=checkpoints))
                found = run(a.program, place / "w.yaml", place / "results", ranks, threads)
                best[way] = min(best.get(way, found), found)
        print("ranks x threads | ms a step | ns a bond and step | seconds in all | steps | particles | GiB of the first | "
              "of the largest other")
        for way, (ms, ns, seconds, steps, particles, first, other) in best.items():
            print(f"{way} | {ms:.3f} | {ns:.2f} | {seconds:.2f} | {steps} | {particles} | {first:.2f} | {other:.2f}")


if __name__ == "__main__":
    main()
