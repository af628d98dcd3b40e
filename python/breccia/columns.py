# SPDX-License-Identifier: BSD-3-Clause
"""Tables of numbers whose columns have names, units and a meaning: curves.csv, and those in tables/."""
from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from .errors import Damaged, NeedsPackage, NotThere, did_you_mean
from .files import read_json, read_rows

Floats = NDArray[numpy.float64]


@dataclass(frozen=True)
class Column:
    """One column of a table.

    name     without the unit: `axial_stress`
    header   as in the file: `axial_stress_Pa`
    unit     SI; "1" of a pure number; "" if the files do not say
    doc      what it is
    role     what it is for those who look for a kind of curve; the name, unless the file says otherwise
    values   shape (rows,); NaN where nothing was measured
    """

    name: str
    header: str
    unit: str
    doc: str
    role: str
    values: Floats


class Table(Mapping[str, Floats]):
    """Columns by name or by header; both give an array of shape (rows,), in SI units.

    >>> run.curves["axial_stress"].max(), run.curves.unit("axial_stress")
    """

    def __init__(self, file: Path, columns: list[Column]) -> None:
        self.file = file
        self.columns = columns
        self._by_name = {c.header: c for c in columns} | {c.name: c for c in columns}

    @property
    def rows(self) -> int:
        """How many samples there are."""
        return len(self.columns[0].values) if self.columns else 0

    def column(self, name: str) -> Column:
        """Values with unit and meaning. NotThere."""
        found = self._by_name.get(name)
        if found is None:
            raise NotThere(f"{self.file}: has no column `{name}`{did_you_mean(name, self)}")
        return found

    def unit(self, name: str) -> str:
        """SI unit of a column, "1" of a pure number. NotThere."""
        return self.column(name).unit

    def with_role(self, role: str) -> list[Column]:
        """All columns of a role, in their order; none if there are none."""
        return [c for c in self.columns if c.role == role]

    def frame(self) -> Any:
        """A pandas.DataFrame whose columns are the headers. NeedsPackage without pandas."""
        return data_frame({c.header: c.values for c in self.columns})

    def __getitem__(self, name: str) -> Floats:
        return self.column(name).values

    def __contains__(self, name: object) -> bool:
        return name in self._by_name

    def __iter__(self) -> Iterator[str]:
        return (c.name for c in self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        return f"<{self.file.name}: {self.rows} rows of {', '.join(self)}>"


def data_frame(columns: Mapping[str, Any]) -> Any:
    """A pandas.DataFrame. NeedsPackage without pandas."""
    try:
        import pandas
    except ImportError:
        raise NeedsPackage("a data frame needs pandas (Debian: python3-pandas)") from None
    return pandas.DataFrame(dict(columns))


def read_table(file: Path, said: Path, growing: bool = False) -> Table:
    """A CSV file and the JSON file that says what its columns are. NotThere, Damaged."""
    head, rows = read_rows(file, growing)
    about: dict[str, dict[str, Any]] = {}
    if said.is_file():
        entries = read_json(said)
        if not isinstance(entries, list) or not all(isinstance(e, dict) and "header" in e for e in entries):
            raise Damaged(f"{said}: is no list of columns")
        about = {str(e["header"]): e for e in entries}
    try:
        cells = [[float(c) if c else numpy.nan for c in row] for row in rows]
    except ValueError as error:
        raise Damaged(f"{file}: {str(error).replace('could not convert string to float:', 'no number:')}") from None
    values = numpy.array(cells, dtype=numpy.float64).reshape(len(rows), len(head))
    columns = []
    for k, header in enumerate(head):
        entry = about.get(header, {})
        name = str(entry.get("name", header))
        columns.append(Column(name, header, str(entry.get("unit", "")), str(entry.get("doc", "")),
                              str(entry.get("role", name)), numpy.ascontiguousarray(values[:, k])))
    return Table(file, columns)
