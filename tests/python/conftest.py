# SPDX-License-Identifier: BSD-3-Clause
"""Results to read: those of small runs by the built program. tests/docs/files/base.yaml: 4 x 4 x 8 spheres of 1 mm on a
cubic lattice, bonded to their neighbours, between platens."""
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "python"))
PROGRAM = os.environ.get("BRECCIA_PROGRAM", str(root / "build/bin/breccia"))
BASE = root / "tests/docs/files/base.yaml"
WHOLE = ["outputs=[{type: vtk, interval: 0.02 ms}, {type: vtk, name: fine, interval: 0.01 ms}]", "protocol.max_strain=1 %",
         "postprocessors=[{type: stress}, {type: bagi_strain}, {type: elastic_constants}, {type: damage}, {type: statistics}]"]


def breccia_says(*arguments):
    """Runs the program; its words if it fails."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def run_base(folder, *settings):
    breccia_says("run", BASE, "--output", folder, "--threads", "1", *[x for s in settings for x in ("--set", s)])


@pytest.fixture(scope="session")
def whole(tmp_path_factory):
    """The folder of a finished run; not to be changed."""
    folder = tmp_path_factory.mktemp("results") / "whole"
    run_base(folder, *WHOLE)
    return folder


@pytest.fixture(scope="session")
def torn(tmp_path_factory):
    """The folder of a run in tension until it is torn."""
    folder = tmp_path_factory.mktemp("results") / "torn"
    run_base(folder, "outputs=[{type: vtk, interval: 0.1 ms}]", "protocol={type: direct_tension, plate_velocity: 0.5 m/s, max_strain: 1 %}",
             "contact_law.tensile_strength=5 MPa", "postprocessors=[{type: stress}, {type: damage}]")
    return folder


def stopped(folder, how):
    """A long run that ended by a signal when it had written some rows."""
    running = subprocess.Popen([PROGRAM, "run", str(BASE), "--output", str(folder), "--threads", "1", "--set", "protocol.platen_velocity=0.0002 m/s",
                                "--set", "outputs=[{type: vtk, interval: 0.1 ms}]"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    end = time.monotonic() + 30
    growing = folder / "unfinished/curves.csv.partial"
    while time.monotonic() < end and not (growing.exists() and growing.read_bytes().count(b"\n") > 3):
        time.sleep(0.02)
    running.send_signal(how)
    running.wait(30)
    return folder


@pytest.fixture(scope="session")
def interrupted(tmp_path_factory):
    return stopped(tmp_path_factory.mktemp("results") / "interrupted", signal.SIGINT)


@pytest.fixture(scope="session")
def killed(tmp_path_factory):
    return stopped(tmp_path_factory.mktemp("results") / "killed", signal.SIGKILL)


@pytest.fixture(scope="session")
def study(tmp_path_factory):
    """The folder of a study of four cases, the last two of which fail: no run closes its energy balance to 1e-15."""
    place = tmp_path_factory.mktemp("study")
    (place / "four.yaml").write_text(f"""
workflow: {BASE}
fixed: {{outputs: [], protocol.max_strain: 0.3 %}}
grid:
  engine.energy_error_limit: [1, 1e-15]
  contact_law.bond_modulus: [10 GPa, 20 GPa]
derived: [{{name: stiffening, numerator: youngs_modulus_Pa, denominator: contact_law.bond_modulus}}]
""")
    done = subprocess.run([PROGRAM, "sweep", place / "four.yaml", "--output", place / "four", "--jobs", "2"], capture_output=True, text=True)
    assert done.returncode == 1, done.stdout + done.stderr  # some have not finished
    return place / "four"
