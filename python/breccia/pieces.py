# SPDX-License-Identifier: BSD-3-Clause
"""Frames that several ranks wrote, each its piece: what one file would hold."""
from __future__ import annotations

import xml.etree.ElementTree
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from .errors import Damaged
from .files import read_text

Array = NDArray[Any]


def pieces_of(file: Path) -> list[Path]:
    """Of a .pvtp file the files that it joins. Damaged."""
    try:
        pieces = xml.etree.ElementTree.fromstring(read_text(file)).iter("Piece")
        found = [file.parent / piece.attrib["Source"] for piece in pieces]
    except (xml.etree.ElementTree.ParseError, KeyError):
        raise Damaged(f"{file}: is no whole list of pieces") from None
    if not found:
        raise Damaged(f"{file}: joins no pieces")
    return found


def _as_numpy(array: Any) -> Array:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    return numpy.asarray(vtk_to_numpy(array))


def _of_points(piece: Any, name: str, missing: int) -> Array:
    found = piece.GetPointData().GetArray(name)
    return _as_numpy(found) if found else numpy.full(piece.GetNumberOfPoints(), missing)


def _places(file: Path, pieces: list[Any], linked: bool) -> tuple[list[Array], list[Array], int]:
    """Where each point of each piece stands in the whole, which of them are its own, and how many there are in all.

    linked   points may be copies of those of other pieces, and images of particles; these stand behind all others.
    """
    ids = [_of_points(p, "id", 0) for p in pieces]
    image = [(i < 0) & linked for i in ids]
    own = [(_of_points(p, "vtkGhostType", 0) == 0) & ~i for p, i in zip(pieces, image)]
    place = [numpy.full(len(i), -1) for i in ids]
    count = 0
    for which in (own, image):
        for p, rows in enumerate(which):
            place[p][rows] = numpy.arange(count, count + rows.sum())
            count += int(rows.sum())
    if linked:
        of_id: dict[int, int] = {}
        for i, rows, at in zip(ids, own, place):
            of_id.update(zip(i[rows].tolist(), at[rows].tolist()))
        try:
            for i, at in zip(ids, place):
                at[at < 0] = [of_id[k] for k in i[at < 0].tolist()]
        except KeyError:
            raise Damaged(f"{file}: a bond leads to a particle that is in none of its pieces") from None
    return place, own, count


def _put(file: Path, data: list[Any], rows: list[Any], to: Any) -> None:
    """The rows named of the arrays that the first one has."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    for k in range(data[0].GetNumberOfArrays()):
        first = data[0].GetArray(k)
        parts = [d.GetArray(first.GetName()) for d in data]
        if any(p is None or p.GetNumberOfComponents() != first.GetNumberOfComponents() for p in parts):
            raise Damaged(f"{file}: not all of its pieces have the array `{first.GetName()}`")
        values = numpy.concatenate([_as_numpy(p)[r] for p, r in zip(parts, rows)])
        whole = numpy_to_vtk(values, deep=True, array_type=first.GetDataType())
        whole.SetName(first.GetName())
        whole.CopyComponentNames(first)
        whole.CopyInformation(first.GetInformation())
        to.AddArray(whole)


def joined(file: Path, pieces: list[Any]) -> Any:
    """The vtkPolyData of all, one after the other; `file` is the one that joins them. Damaged."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    linked = bool(pieces[0].GetPointData().HasArray("vtkGhostType"))
    place, own, count = _places(file, pieces, linked)
    positions = numpy.empty((count, 3))
    for at, piece in zip(place, pieces):
        if piece.GetNumberOfPoints():
            positions[at] = _as_numpy(piece.GetPoints().GetData())
    points, result = vtkPoints(), vtkPolyData()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(positions, deep=True))
    result.SetPoints(points)
    for name, size in (("Verts", 1), ("Lines", 2)):
        cells = [getattr(p, "Get" + name)() for p in pieces]
        ends = [at[_as_numpy(c.GetConnectivityArray())] for at, c in zip(place, cells) if c.GetNumberOfCells()]
        if ends:
            flat, all_cells = numpy.concatenate(ends).astype(numpy.int64), vtkCellArray()
            all_cells.SetData(numpy_to_vtkIdTypeArray(numpy.arange(0, len(flat) + 1, size), deep=True),
                              numpy_to_vtkIdTypeArray(flat, deep=True))
            getattr(result, "Set" + name)(all_cells)
    if not linked:
        _put(file, [p.GetPointData() for p in pieces], own, result.GetPointData())
    _put(file, [p.GetCellData() for p in pieces], [slice(None)] * len(pieces), result.GetCellData())
    result.GetFieldData().DeepCopy(pieces[0].GetFieldData())
    return result
