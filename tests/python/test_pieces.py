# SPDX-License-Identifier: BSD-3-Clause
"""Frames that several ranks wrote: what one file would hold. Pieces made by hand: particles 0 to 3 in a row, bonds
between neighbours, the last one across a face to an image."""
import numpy
import pytest

import breccia
from breccia.frames import Frame

vtk = pytest.importorskip("vtkmodules.vtkCommonCore")


def write(file, points, lines, **arrays):
    """Arrays of points; `of_bonds` of the lines."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
    data, places, cells = vtkPolyData(), vtk.vtkPoints(), vtkCellArray()
    places.SetDataTypeToDouble()
    places.SetData(numpy_to_vtk(numpy.array([[x, 0.0, 0.0] for x in points]), deep=True))
    data.SetPoints(places)
    size = 2 if lines else 1
    flat = numpy.array(lines if lines else [[k] for k in range(len(points))], dtype=numpy.int64).ravel()
    cells.SetData(numpy_to_vtkIdTypeArray(numpy.arange(0, len(flat) + 1, size), deep=True),
                  numpy_to_vtkIdTypeArray(flat, deep=True))
    (data.SetLines if lines else data.SetVerts)(cells)
    for name, values in arrays.items():
        array = numpy_to_vtk(numpy.array(values), deep=True)
        array.SetName(name)
        array.GetInformation().Set(vtk.vtkDataArray.UNITS_LABEL(), "m")
        (data.GetCellData() if name == "of_bonds" else data.GetPointData()).AddArray(array)
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(data)
    writer.Write()


def join(file, *pieces):
    text = "".join(f'<Piece Source="{p}"/>' for p in pieces)
    file.write_text(f'<VTKFile type="PPolyData"><PPolyData>{text}</PPolyData></VTKFile>')
    return Frame(file, 0.0)


def ghosts(*flags):
    return numpy.array(flags, dtype=numpy.uint8)


@pytest.fixture
def bonds(tmp_path):
    ints = numpy.int32
    write(tmp_path / "bonds_0.vtp", [0.0, 1.0, 2.0, -1.0], [[0, 1], [0, 3], [1, 2]], id=numpy.array([10, 11, 12, -1], ints),
          vtkGhostType=ghosts(0, 0, 1, 0), of_bonds=[0.5, 0.6, 0.7])
    write(tmp_path / "bonds_1.vtp", [1.0, 2.0, 3.0], [[1, 2]], id=numpy.array([11, 12, 13], ints), vtkGhostType=ghosts(1, 0, 0),
          of_bonds=[0.8])
    return tmp_path


def test_particles_stand_one_behind_the_other(tmp_path):
    write(tmp_path / "p_0.vtp", [0.0, 1.0], [], radius=[1.0, 2.0])
    write(tmp_path / "p_1.vtp", [2.0, 3.0, 4.0], [], radius=[3.0, 4.0, 5.0])
    frame = join(tmp_path / "p.pvtp", "p_0.vtp", "p_1.vtp")
    assert frame["radius"].tolist() == [1, 2, 3, 4, 5]
    assert frame.points[:, 0].tolist() == [0, 1, 2, 3, 4]
    assert frame.unit("radius") == "m"


def test_bonds_lead_to_the_particles_of_other_pieces(bonds):
    frame = join(bonds / "b.pvtp", "bonds_0.vtp", "bonds_1.vtp")
    assert frame.points[:, 0].tolist() == [0, 1, 2, 3, -1]
    assert frame.ends.tolist() == [[0, 1], [0, 4], [1, 2], [2, 3]]
    assert frame["of_bonds"].tolist() == [0.5, 0.6, 0.7, 0.8]
    assert frame.names == ["of_bonds"]


def test_what_does_not_fit_is_refused(bonds):
    with pytest.raises(breccia.Damaged, match="in none of its pieces"):
        join(bonds / "b.pvtp", "bonds_0.vtp").ends
    with pytest.raises(breccia.NotThere, match="bonds_2.vtp"):
        join(bonds / "b.pvtp", "bonds_0.vtp", "bonds_2.vtp").ends
    with pytest.raises(breccia.Damaged, match="joins no pieces"):
        join(bonds / "b.pvtp").ends
