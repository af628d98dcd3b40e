# SPDX-License-Identifier: BSD-3-Clause
"""summary.json: the numbers of a run, each with its unit as data."""
from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .errors import Damaged, NotThere, did_you_mean
from .files import read_object


FORMAT = 1  # of summary.json


@dataclass(frozen=True)
class Quantity:
    """A number with its SI unit; "1" of a pure number. NaN: the run could not measure it."""

    value: float
    unit: str

    def __float__(self) -> float:
        return self.value

    def __str__(self) -> str:
        return f"{self.value:g}" + ("" if self.unit == "1" else f" {self.unit}")


def _written(unit: str) -> str:
    """What a unit adds to the end of a key."""
    return "" if unit == "1" else "_" + "".join(c if c.isascii() and c.isalnum() else "_" for c in unit)


class Summary(Mapping[str, Any]):
    """Results by their paths: `peak_stress_Pa`, `uniaxial_compression.stopped_by`. A quantity is found without
    its unit, too: `peak_stress`."""

    def __init__(self, file: Path, read: dict[str, Any]) -> None:
        units = read.get("units", {})
        if not isinstance(units, dict):
            raise Damaged(f"{file}: its `units` are no mapping")
        self.file = file
        if not isinstance(of := read.get("format", FORMAT), int) or of > FORMAT:
            raise Damaged(f"{file}: is of format {of}; this package reads up to {FORMAT}")
        self._read = {key: value for key, value in read.items() if key not in ("format", "units", "values")}
        self._units: dict[str, str] = {str(key): str(unit) for key, unit in units.items()}
        self._keys: dict[str, str]
        named = read.get("values")  # {name: {value, unit}}; results of earlier versions have the keys' units alone
        if isinstance(named, dict):
            self._keys = {str(name): name + _written(str(it["unit"])) for name, it in named.items()
                          if isinstance(it, dict) and "unit" in it}
        else:
            self._keys = {key[:-len(end)]: key for key, unit in self._units.items()
                          if (end := _written(unit)) and key.endswith(end)}

    @staticmethod
    def load(file: Path) -> Summary:
        """NotThere, Damaged."""
        return Summary(file, read_object(file))

    def _find(self, path: str) -> tuple[bool, Any]:
        at: Any = self._read
        if path in self._read:
            return True, self._read[path]
        for part in path.split("."):
            if not isinstance(at, dict) or part not in at:
                return False, None
            at = at[part]
        return True, at

    def key(self, name: str) -> str:
        """The path in the file of a result that may have been named without its unit. NotThere."""
        if self._find(name)[0]:
            return name
        if name in self._keys and self._find(self._keys[name])[0]:
            return self._keys[name]
        raise NotThere(f"{self.file}: has no `{name}`{did_you_mean(name, [*self.paths(), *self._keys])}")

    def __getitem__(self, name: str) -> Any:
        """What the file says: a number, a text, a list, a mapping; None where it could not be measured. NotThere."""
        return self._find(self.key(name))[1]

    def get(self, name: str, default: Any = None) -> Any:
        """As by brackets, or the default where the file says nothing, or null."""
        try:
            value = self[name]
        except NotThere:
            return default
        return default if value is None else value

    def unit(self, name: str) -> str:
        """SI unit; "1" of a pure number and of what is none. NotThere."""
        key = self.key(name)
        if key in self._units:
            return self._units[key]
        beside = self._find(key.rpartition(".")[0] + ".unit")  # {"unit": "m", "got": 0.001, "asked": 0.001}
        return str(beside[1]) if beside[0] else "1"

    def quantity(self, name: str) -> Quantity:
        """A number with its unit; NaN where null stands. NotThere, also for what is no number."""
        value = self[name]
        if value is None:
            value = math.nan
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise NotThere(f"{self.file}: `{name}` is no number: `{value}`")
        return Quantity(float(value), self.unit(name))

    def paths(self) -> list[str]:
        """Of all values, also those within sections."""
        def below(section: dict[str, Any], prefix: str) -> Iterator[str]:
            for key, value in section.items():
                if isinstance(value, dict):
                    yield from below(value, f"{prefix}{key}.")
                else:
                    yield prefix + key
        return list(below(self._read, ""))

    def quantities(self) -> dict[str, Quantity]:
        """All numbers by their paths; truths are left out."""
        found = {}
        for path in self.paths():
            value = self._find(path)[1]
            if isinstance(value, (int, float)) and not isinstance(value, bool):
                found[path] = Quantity(float(value), self.unit(path))
        return found

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and (self._find(name)[0] or name in self._keys)

    def __iter__(self) -> Iterator[str]:
        return iter(self._read)

    def __len__(self) -> int:
        return len(self._read)

    def __repr__(self) -> str:
        return f"<{self.file}: {len(self.paths())} results>"
