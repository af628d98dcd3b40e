# SPDX-License-Identifier: BSD-3-Clause
"""The results of `breccia sweep`: cases, their inputs and values, their runs."""
from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, overload

import numpy

from .columns import Floats, data_frame
from .errors import Damaged, NotResults, NotThere, did_you_mean
from .files import UNFINISHED, manifests, read_json, read_object, read_rows
from .run import Run

Cell = float | str


def _cell(text: str) -> Cell:
    try:
        return float(text)
    except ValueError:
        return text


@dataclass(frozen=True)
class Case:
    """One case of a study.

    number    from 1
    name      of its folder below `cases/`
    workflow  its name, of a study of several; else empty
    inputs    {header: value}, numbers in SI as the header says: `contact_law.tensile_strength_Pa`
    status    "finished", "failed", "unfinished", "not run", "other inputs"
    values    {key: number}; NaN where the case has none
    error     the first line of what went wrong
    """

    study: Path
    number: int
    name: str
    workflow: str
    inputs: Mapping[str, Cell]
    status: str
    values: Mapping[str, float]
    error: str

    @property
    def finished(self) -> bool:
        return self.status == "finished"

    @cached_property
    def run(self) -> Run:
        """What the case left. NotResults if it left nothing, Damaged."""
        return Run(self.study / "cases" / self.name)


class Study(Sequence[Case]):
    """The cases in their order, as the study last gathered them (results.csv). Of a study that was stopped before it
    gathered anything: those that have begun, by their own records.

    folder   as it was given
    inputs   headers of what varies
    keys     of the values: results of the runs, and what the study derives of them
    """

    def __init__(self, folder: str | Path) -> None:
        """NotResults if the folder is not one of a study; Damaged."""
        self.folder = Path(folder)
        whole, growing = manifests(self.folder)
        manifest = whole or growing
        assert manifest is not None  # one of the two is there
        kind = manifest.kind
        if kind != "study":
            raise NotResults(f"{self.folder}: holds a {kind}, not a study"
                             + ("; read it by `open_run`" if kind == "run" else ""))
        gathered = next((f for f in (self.folder / "results.csv", self.folder / UNFINISHED / "results.csv")
                         if f.is_file()), None)
        self.inputs: list[str] = []
        self.keys: list[str] = []
        self._cases = list(self._of_table(gathered) if gathered else self._of_records())

    def _of_table(self, file: Path) -> Iterator[Case]:
        head, rows = read_rows(file)
        if head[:2] != ["case", "folder"] or "status" not in head or head[-1] != "error":
            raise Damaged(f"{file}: is no table of a study's results")
        status = head.index("status")
        named = len(head) > 2 and head[2] == "workflow"
        first = 3 if named else 2
        self.inputs, self.keys = head[first:status], head[status + 1:-1]
        for number, row in enumerate(rows, 2):
            try:
                values = {k: float(v) if v else numpy.nan for k, v in zip(self.keys, row[status + 1:-1])}
                yield Case(self.folder, int(row[0]), row[1], row[2] if named else "",
                           {k: _cell(v) for k, v in zip(self.inputs, row[first:status])}, row[status], values, row[-1])
            except ValueError:
                raise Damaged(f"{file}:{number}: has a text where a number stands in other rows") from None

    def _of_records(self) -> Iterator[Case]:
        found = []
        for folder in sorted((self.folder / "cases").glob("*")):
            record = next((f for f in (folder / "case.json", folder / UNFINISHED / "case.json") if f.is_file()), None)
            if record is None:
                continue
            about = read_object(record)
            inputs = about.get("inputs", {})
            if not isinstance(inputs, dict) or not isinstance(about.get("case"), int):
                raise Damaged(f"{record}: is no record of a case")
            found.append(Case(self.folder, about["case"], folder.name, str(about.get("workflow", "")),
                              {k: float(v) if isinstance(v, (int, float)) else str(v) for k, v in inputs.items()},
                              str(about.get("status", "unfinished")), {}, str(about.get("error", "")).split("\n")[0]))
            self.inputs += [k for k in inputs if k not in self.inputs]
        yield from sorted(found, key=lambda c: c.number)

    @property
    def finished(self) -> list[Case]:
        """Cases that came to their end."""
        return [c for c in self if c.finished]

    @property
    def failed(self) -> list[Case]:
        """Cases that went wrong; each says why in `error`."""
        return [c for c in self if c.status == "failed"]

    def column(self, name: str) -> Floats:
        """An input or a value over all cases, NaN where a case has none; shape (cases,). NotThere, also for an input
        that is no number."""
        if name not in (*self.inputs, *self.keys):
            raise NotThere(f"{self.folder}: has no `{name}`{did_you_mean(name, (*self.inputs, *self.keys))}")
        cells = [c.inputs[name] if name in c.inputs else c.values.get(name, numpy.nan) for c in self]
        text = next((c for c in cells if isinstance(c, str) and c), None)
        if text is not None:
            raise NotThere(f"{self.folder}: `{name}` is no number in all cases: `{text}`")
        return numpy.array([numpy.nan if isinstance(c, str) else c for c in cells], dtype=numpy.float64)

    @cached_property
    def _units(self) -> dict[str, str]:
        """results.json, which earlier versions did not write."""
        file = next((f for f in (self.folder / "results.json", self.folder / UNFINISHED / "results.json")
                     if f.is_file()), None)
        if file is None:
            return {}
        try:
            return {str(column["header"]): str(column["unit"]) for column in read_json(file)}
        except (KeyError, TypeError):
            raise Damaged(f"{file}: is no list of columns") from None

    def unit(self, key: str) -> str:
        """SI unit of an input or a value, "1" of a pure number; of a study by an earlier version only those that the
        summary of a case has. NotThere, Damaged."""
        if key in self._units:
            return self._units[key]
        for case in self.finished:
            if key in case.run.summary:
                return case.run.summary.unit(key)
        raise NotThere(f"{self.folder}: has no unit of `{key}`{did_you_mean(key, (*self.inputs, *self.keys))}")

    def frame(self) -> Any:
        """A pandas.DataFrame with a row for each case. NeedsPackage without pandas."""
        several = {"workflow": [c.workflow for c in self]} if any(c.workflow for c in self) else {}
        return data_frame({"case": [c.number for c in self], "folder": [c.name for c in self], **several,
                           **{k: [c.inputs.get(k) for c in self] for k in self.inputs},
                           "status": [c.status for c in self],
                           **{k: [c.values.get(k, numpy.nan) for c in self] for k in self.keys},
                           "error": [c.error for c in self]})

    @overload
    def __getitem__(self, k: int) -> Case: ...
    @overload
    def __getitem__(self, k: slice) -> list[Case]: ...

    def __getitem__(self, k: int | slice) -> Case | list[Case]:
        return self._cases[k]

    def __len__(self) -> int:
        return len(self._cases)

    def __repr__(self) -> str:
        return f"<study {self.folder}: {len(self.finished)} of {len(self)} cases finished>"
