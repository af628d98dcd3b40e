# SPDX-License-Identifier: BSD-3-Clause
"""Results of Breccia, as a person wants them: numbers with units, curves by name, frames as arrays.

    import breccia

    run = breccia.open_run("results/my")
    print(run.quantity("peak_stress"))                    # 1.23e+08 Pa
    strain, stress = run.curves["axial_strain"], run.curves["axial_stress"]
    damage = run.particles[-1]["damage"]                  # of the last frame

    study = breccia.open_study("results/strength")
    study.column("peak_stress_Pa"), study[0].run.curves

    breccia.find_runs("results").values("youngs_modulus")

All numbers are SI. Nothing is written. What goes wrong is a `ResultsError` whose text says what, where and what to do.
"""
from __future__ import annotations

from pathlib import Path

from .batch import Runs, find_runs
from .columns import Column, Table
from .errors import Damaged, NeedsPackage, NotResults, NotThere, ResultsError
from .frames import Cracks, Frame, Frames
from .run import Run
from .study import Case, Study
from .summary import Quantity, Summary

__all__ = ["Case", "Column", "Cracks", "Damaged", "Frame", "Frames", "NeedsPackage", "NotResults", "NotThere",
           "Quantity", "ResultsError", "Run", "Runs", "Study", "Summary", "Table", "find_runs", "open_run",
           "open_study"]


def open_run(folder: str | Path) -> Run:
    """The results of a run. NotResults if the folder is not one; Damaged if that cannot be told."""
    return Run(folder)


def open_study(folder: str | Path) -> Study:
    """The results of `breccia sweep`. NotResults if the folder is not one of a study; Damaged."""
    return Study(folder)
