# SPDX-License-Identifier: BSD-3-Clause
"""Several runs side by side."""
from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, overload

import numpy

from .columns import Floats, data_frame
from .errors import NotResults, ResultsError
from .files import MANIFEST, UNFINISHED
from .run import Run


class Runs(Sequence[Run]):
    """Runs in the order of their folders' names.

    skipped  {folder: why it could not be opened}, of damaged ones
    """

    def __init__(self, runs: Iterable[Run], skipped: dict[Path, str] | None = None) -> None:
        self._runs = list(runs)
        self.skipped = dict(skipped or {})

    @property
    def finished(self) -> Runs:
        """Those that came to their own end."""
        return Runs((r for r in self if r.finished), self.skipped)

    def values(self, name: str) -> Floats:
        """A number of the summaries, shape (runs,); NaN where a run has no such number, or no summary."""
        def of(run: Run) -> float:
            try:
                return run.quantity(name).value
            except ResultsError:
                return float("nan")
        return numpy.array([of(r) for r in self], dtype=numpy.float64)

    def frame(self, names: Sequence[str]) -> Any:
        """A pandas.DataFrame: a row for each run, its folder, state and these numbers. NeedsPackage without pandas."""
        return data_frame({"folder": [str(r.folder) for r in self], "state": [r.state for r in self],
                           **{n: self.values(n) for n in names}})

    @overload
    def __getitem__(self, k: int) -> Run: ...
    @overload
    def __getitem__(self, k: slice) -> Runs: ...

    def __getitem__(self, k: int | slice) -> Run | Runs:
        return Runs(self._runs[k], self.skipped) if isinstance(k, slice) else self._runs[k]

    def __len__(self) -> int:
        return len(self._runs)

    def __repr__(self) -> str:
        return f"<{len(self)} runs, {len(self.finished)} finished>"


def find_runs(folder: str | Path) -> Runs:
    """All runs in a folder and below it, at any depth; of studies, those of their cases. NotResults if there is no
    such folder. Folders of other things are passed over, damaged ones are listed in `skipped`."""
    top = Path(folder)
    if not top.is_dir():
        raise NotResults(f"{top}: there is no such folder")
    found: list[Run] = []
    skipped: dict[Path, str] = {}
    for here, below, files in os.walk(top):
        below.sort()
        place = Path(here)
        growing = UNFINISHED in below and (place / UNFINISHED / MANIFEST).is_file()
        if growing:
            below.remove(UNFINISHED)  # belongs to this folder
        if MANIFEST not in files and not growing:
            continue
        try:
            found.append(Run(place))
        except NotResults:
            continue  # a study or a comparison
        except ResultsError as error:
            skipped[place] = str(error)
    return Runs(found, skipped)
