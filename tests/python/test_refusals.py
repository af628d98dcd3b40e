# SPDX-License-Identifier: BSD-3-Clause
"""What is no results of Breccia's, or not whole any more: one line that names the file, never another exception."""
import json
import shutil
import sys

import pytest

import breccia


@pytest.fixture
def copy(whole, tmp_path):
    return shutil.copytree(whole, tmp_path / "copy")


def refused(kind, words, do):
    with pytest.raises(kind) as caught:
        do()
    said = str(caught.value)
    assert isinstance(caught.value, breccia.ResultsError) and "\n" not in said
    for word in [words] if isinstance(words, str) else words:
        assert word in said, said


def test_folders_that_are_not_breccias(tmp_path):
    refused(breccia.NotResults, ["nowhere", "no such folder"], lambda: breccia.open_run(tmp_path / "nowhere"))
    refused(breccia.NotResults, "has no `breccia.json`", lambda: breccia.open_run(tmp_path))
    (tmp_path / "file").write_text("")
    refused(breccia.NotResults, "is a file", lambda: breccia.open_run(tmp_path / "file"))
    (tmp_path / "summary.json").write_text("{}")
    refused(breccia.NotResults, "version 0.1", lambda: breccia.open_run(tmp_path))
    refused(breccia.NotResults, "no such folder", lambda: breccia.find_runs(tmp_path / "nowhere"))


def test_folders_of_another_kind(whole, study):
    refused(breccia.NotResults, ["holds a study", "open_study"], lambda: breccia.open_run(study))
    refused(breccia.NotResults, ["holds a run", "open_run"], lambda: breccia.open_study(whole))


@pytest.mark.parametrize("text, words", [
    ("{", "breccia.json:1:2: is no JSON"), ("[]", "is no JSON object"), ('{"format": "breccia results 9"}', "`breccia results 9`; this package reads"),
    ("\x00\xff", "is no JSON")])
def test_a_manifest_that_is_not_understood(copy, text, words):
    (copy / "breccia.json").write_text(text)
    refused(breccia.Damaged, words, lambda: breccia.open_run(copy))


def test_a_damaged_summary(copy):
    whole = (copy / "summary.json").read_text()
    (copy / "summary.json").write_text(whole[:300])
    refused(breccia.Damaged, "summary.json:", lambda: breccia.open_run(copy))
    (copy / "summary.json").write_bytes(b"\xff\xfe{")
    refused(breccia.Damaged, "is not a text in UTF-8", lambda: breccia.open_run(copy))
    (copy / "summary.json").write_text(json.dumps({"format": 2}))
    refused(breccia.Damaged, "is of format 2; this package reads up to 1", lambda: breccia.open_run(copy))
    (copy / "summary.json").write_text(json.dumps({"units": 3}))
    refused(breccia.Damaged, "its `units`", lambda: breccia.open_run(copy))
    (copy / "summary.json").unlink()
    refused(breccia.Damaged, "was removed", lambda: breccia.open_run(copy))


def test_damaged_curves(copy):
    whole = (copy / "curves.csv").read_text()
    (copy / "curves.csv").write_text(whole[:-20])
    refused(breccia.Damaged, ["curves.csv:", "cells where the head has"], lambda: breccia.open_run(copy).curves)
    (copy / "curves.csv").write_text(whole.replace(whole.split("\n")[1].split(",")[1], "1.0e", 1))
    refused(breccia.Damaged, "no number: '1.0e'", lambda: breccia.open_run(copy).curves)
    (copy / "curves.csv").write_text("")
    refused(breccia.Damaged, "is empty", lambda: breccia.open_run(copy).curves)
    (copy / "curves.csv").unlink()
    refused(breccia.NotThere, "has no curves", lambda: breccia.open_run(copy).curves)


def test_damaged_units_of_curves(copy):
    (copy / "curves.json").write_text('{"time": "s"}')
    refused(breccia.Damaged, "curves.json: is no list of columns", lambda: breccia.open_run(copy).curves)


def test_a_row_in_the_middle_of_being_written_is_left_out(killed, tmp_path):
    copy = shutil.copytree(killed, tmp_path / "copy", symlinks=True)
    before = breccia.open_run(killed).curves.rows
    with open(copy / "unfinished/curves.csv.partial", "a") as file:
        file.write("1.0,2.")
    assert breccia.open_run(copy).curves.rows == before


@pytest.mark.parametrize("left", [0, 10, 400, 0.5, -12])
def test_frames_that_were_cut_off(copy, left, capfd):
    file = copy / "particles_000000.vtp"
    whole = file.read_bytes()
    file.write_bytes(whole[:int(left * len(whole)) if isinstance(left, float) else left])
    refused(breccia.Damaged, "particles_000000.vtp: is no whole file", lambda: breccia.open_run(copy).particles[0]["radius"])
    assert capfd.readouterr() == ("", "")  # VTK's own words are not for the reader


def test_damaged_series(copy):
    (copy / "particles.pvd").write_text("<VTKFile><Collection>")
    refused(breccia.Damaged, "is no whole series", lambda: breccia.open_run(copy).particles)
    (copy / "bonds.pvd").write_text('<VTKFile><Collection><DataSet timestep="soon" file="a.vtp"/></Collection></VTKFile>')
    refused(breccia.Damaged, "is no whole series", lambda: breccia.open_run(copy).bonds)
    (copy / "walls.pvd").write_text("<VTKFile/>")
    assert len(breccia.open_run(copy).walls) == 0
    refused(breccia.NotThere, "has no frames", lambda: breccia.open_run(copy).walls.at(0))


def test_a_damaged_workflow(copy):
    (copy / "resolved.yaml").write_text("a: [1, 2")
    refused(breccia.Damaged, "is no YAML", lambda: breccia.open_run(copy).workflow)
    (copy / "resolved.yaml").write_text("only text")
    refused(breccia.Damaged, "is no workflow", lambda: breccia.open_run(copy).workflow)
    (copy / "resolved.yaml").unlink()
    refused(breccia.NotThere, "is not there", lambda: breccia.open_run(copy).workflow)


def test_names_that_are_not_there(whole):
    run = breccia.open_run(whole)
    refused(breccia.NotThere, ["summary.json", "did you mean `peak_stress`"], lambda: run.quantity("peak_stres"))
    refused(breccia.NotThere, "is no number", lambda: run.quantity("workflow"))
    refused(breccia.NotThere, "did you mean `axial_stress`", lambda: run.curves["axial_stres"])
    refused(breccia.NotThere, "did you mean `radius`", lambda: run.particles[0]["radus"])
    refused(breccia.NotThere, "has no field", lambda: run.particles[0].field("height"))
    refused(breccia.NotThere, "`contact_law` has no `frction`; did you mean `friction`", lambda: run.setting("contact_law.frction"))
    refused(breccia.NotThere, "there are", lambda: run.frames("particles", "coarse"))
    assert run.curves.get("nothing") is None and dict(run.curves).keys() >= {"time", "axial_stress"}
    with pytest.raises(IndexError, match="frames, no number 99"):
        run.particles[99]


def test_a_run_without_frames(study):
    refused(breccia.NotThere, "the run wrote no output `vtk`", lambda: breccia.open_study(study)[0].run.cracks)


@pytest.mark.parametrize("module, do", [
    ("pandas", lambda run: run.curves.frame()), ("yaml", lambda run: run.workflow), ("vtkmodules.vtkIOXML", lambda run: run.particles[0].points)])
def test_packages_that_are_not_installed(whole, monkeypatch, module, do):
    monkeypatch.setitem(sys.modules, module, None)
    refused(breccia.NeedsPackage, "Debian: python3-", lambda: do(breccia.open_run(whole)))
