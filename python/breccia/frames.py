# SPDX-License-Identifier: BSD-3-Clause
"""Frames of particles, bonds and walls, read by VTK when they are first looked at; cracks."""
from __future__ import annotations

import xml.etree.ElementTree
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, overload

import numpy
from numpy.typing import NDArray

from .columns import Floats
from .errors import Damaged, NeedsPackage, NotThere, did_you_mean
from .files import read_text
from .pieces import joined, pieces_of

Ints = NDArray[numpy.int64]
MODES = {2: "tension", 3: "shear", 4: "mixed"}  # of the array `state`; 1 is intact


def _read(file: Path) -> Any:
    """The vtkPolyData of a file, or of the pieces that a .pvtp file joins. NotThere, Damaged, NeedsPackage."""
    try:
        from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    except ImportError:
        raise NeedsPackage("frames need VTK's Python module (Debian: python3-vtk9)") from None
    if not file.is_file():
        raise NotThere(f"{file}: is not there; was it removed after the run?")
    if file.suffix == ".pvtp":
        return joined(file, [_read(piece) for piece in pieces_of(file)])
    # VTK says what is wrong on the terminal and returns an empty or a wrong frame: its words are caught here.
    words, window = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(file))
    loud = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    vtkOutputWindow.SetInstance(words)
    try:
        whole = reader.CanReadFile(str(file))
        if whole:
            reader.Update()
    finally:
        vtkOutputWindow.SetInstance(window)
        vtkLogger.SetStderrVerbosity(loud)
    if not whole or words.GetOutput() or reader.GetErrorCode():
        raise Damaged(f"{file}: is no whole file of VTK's poly data")
    return reader.GetOutput()


def _as_numpy(array: Any) -> NDArray[Any]:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    if array.IsNumeric():
        return numpy.array(vtk_to_numpy(array))  # a copy: the array's own memory goes with the frame
    return numpy.array([array.GetValue(k) for k in range(array.GetNumberOfTuples())])


class Frame:
    """One instant of the particles, bonds or walls. The file is read when something of it is asked for, and the
    frame keeps it; `frames[k]` makes a new frame.

    file   of VTK's poly data
    time   [s]
    """

    def __init__(self, file: Path, time: float) -> None:
        self.file, self.time = file, time

    @cached_property
    def polydata(self) -> Any:
        """VTK's own object. NotThere, Damaged, NeedsPackage."""
        return _read(self.file)

    def _data(self) -> Iterator[Any]:
        yield from (self.polydata.GetPointData(), self.polydata.GetCellData())

    @property
    def names(self) -> list[str]:
        """Of the arrays, of points (particles) or cells (bonds, walls)."""
        return [d.GetArrayName(k) for d in self._data() for k in range(d.GetNumberOfArrays())]

    def _array(self, name: str) -> Any:
        for data in self._data():
            found = data.GetAbstractArray(name)
            if found is not None:
                return found
        raise NotThere(f"{self.file}: has no array `{name}`{did_you_mean(name, self.names)}")

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Shape (n,), (n, 3) of vectors or (n, 6) of symmetric tensors; n particles, bonds or walls. NotThere."""
        return _as_numpy(self._array(name))

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def unit(self, name: str) -> str:
        """SI unit of an array; "1" of what has none. NotThere."""
        from vtkmodules.vtkCommonCore import vtkDataArray
        about, key = self._array(name).GetInformation(), vtkDataArray.UNITS_LABEL()
        return str(about.Get(key)) if about.Has(key) else "1"

    def field(self, name: str) -> NDArray[Any]:
        """What belongs to the whole frame: `dimension`, `specimen_height`, ... Shape (n,) or (n, k). NotThere."""
        data = self.polydata.GetFieldData()
        found = data.GetAbstractArray(name)
        if found is None:
            names = [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())]
            raise NotThere(f"{self.file}: has no field `{name}`{did_you_mean(name, names)}")
        return _as_numpy(found)

    @property
    def points(self) -> Floats:
        """Centres of the particles, or where bonds and walls have their ends; shape (n, 3), m."""
        points = self.polydata.GetPoints()
        return _as_numpy(points.GetData()).astype(numpy.float64) if points else numpy.empty((0, 3))

    @property
    def ends(self) -> Ints:
        """The two points of each line (of bonds: the two particles, as in the frame of the particles); shape (n, 2)."""
        lines = self.polydata.GetLines()
        pairs = _as_numpy(lines.GetConnectivityArray()) if lines.GetNumberOfCells() else numpy.empty(0)
        if pairs.size != 2 * lines.GetNumberOfCells():
            raise Damaged(f"{self.file}: its lines do not have two ends each")
        return pairs.astype(numpy.int64).reshape(-1, 2)

    def __repr__(self) -> str:
        return f"<{self.file.name} at {self.time:g} s>"


class Frames(Sequence[Frame]):
    """The frames of one series (`particles.pvd`) in order of time; none is read before it is looked at."""

    def __init__(self, file: Path, files: list[Path], times: list[float]) -> None:
        self.file, self._files = file, files
        self.times: Floats = numpy.array(times, dtype=numpy.float64)

    @staticmethod
    def load(file: Path) -> Frames:
        """NotThere, Damaged."""
        try:
            sets = list(xml.etree.ElementTree.fromstring(read_text(file)).iter("DataSet"))
            named = [(float(s.attrib["timestep"]), file.parent / s.attrib["file"]) for s in sets]
        except (xml.etree.ElementTree.ParseError, KeyError, ValueError):
            raise Damaged(f"{file}: is no whole series of frames") from None
        return Frames(file, [f for _, f in named], [t for t, _ in named])

    def at(self, time: float) -> Frame:
        """The frame nearest to a time [s]. NotThere if there is none at all."""
        if not self._files:
            raise NotThere(f"{self.file}: has no frames")
        return self[int(numpy.abs(self.times - time).argmin())]

    @overload
    def __getitem__(self, k: int) -> Frame: ...
    @overload
    def __getitem__(self, k: slice) -> list[Frame]: ...

    def __getitem__(self, k: int | slice) -> Frame | list[Frame]:
        if isinstance(k, slice):
            return [self[n] for n in range(len(self))[k]]
        try:
            return Frame(self._files[k], float(self.times[k]))
        except IndexError:
            raise IndexError(f"{self.file}: has {len(self)} frames, no number {k}") from None

    def __len__(self) -> int:
        return len(self._files)

    def __repr__(self) -> str:
        return f"<{self.file.name}: {len(self)} frames>"


@dataclass(frozen=True)
class Cracks:
    """Bonds that broke, in the order of their times; n of them.

    bond      number of the bond in the frames, shape (n,)
    time      [s], shape (n,)
    mode      "tension", "shear" or "mixed", shape (n,)
    position  where it broke [m], shape (n, 3)
    normal    of the crack, shape (n, 3), unit vectors
    radius    of the disc that stands for it [m], shape (n,)
    """

    bond: Ints
    time: Floats
    mode: NDArray[numpy.str_]
    position: Floats
    normal: Floats
    radius: Floats

    def __len__(self) -> int:
        return len(self.bond)

    @staticmethod
    def of(bonds: Frame) -> Cracks:
        """Those of a frame of the bonds. NotThere, Damaged."""
        state = bonds["state"].astype(int)
        broken = numpy.flatnonzero(state >= 2)
        unknown = set(state[broken].tolist()) - set(MODES)
        if unknown:
            raise Damaged(f"{bonds.file}: `state` {min(unknown)} is not known to this package")
        order = broken[numpy.argsort(bonds["break_time"][broken], kind="stable")]

        def taken(name: str) -> Floats:
            return numpy.asarray(bonds[name][order], dtype=numpy.float64)
        return Cracks(order.astype(numpy.int64), taken("break_time"),
                      numpy.array([MODES[s] for s in state[order].tolist()], dtype=numpy.str_),
                      taken("break_position"), taken("break_normal"), taken("crack_radius"))
