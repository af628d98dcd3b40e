# SPDX-License-Identifier: BSD-3-Clause
"""What the package reads of runs, against what is known of them: their geometry, their input, and other files of theirs."""
import csv
import json
import math
import shutil

import numpy
import pytest

import breccia


def test_a_finished_run_says_so(whole):
    run = breccia.open_run(whole)
    assert run.state == "finished" and run.finished and not run.newer_unfinished
    assert run.name == "whole" and run.place == whole


def test_numbers_have_units_as_data(whole):
    run = breccia.open_run(whole)
    assert run.summary["particles"] == 128
    assert run.quantity("peak_stress").unit == "Pa" and run.quantity("peak_stress_Pa") == run.quantity("peak_stress")
    assert run.quantity("particles").unit == "1"
    assert run.summary.unit("packing.porosity.got") == "1"
    assert run.quantity("uniaxial_compression.cross_section_area").unit == "m2"
    written = json.loads((whole / "summary.json").read_text())
    found = run.summary.quantities()
    assert set(written["units"]) & set(found) and all(found[key].unit == written["units"][key] for key in set(written["units"]) & set(found))
    assert str(breccia.Quantity(2e6, "Pa")) == "2e+06 Pa" and str(breccia.Quantity(0.5, "1")) == "0.5"


def test_numbers_are_those_that_the_file_has_by_name(whole):
    values = json.loads((whole / "summary.json").read_text())["values"]
    summary = breccia.open_run(whole).summary
    for name, it in values.items():
        if isinstance(it["value"], (int, float)):
            assert summary.quantity(name) == breccia.Quantity(it["value"], it["unit"])
    assert "values" not in summary and "format" not in summary and len(values) > 20


def test_names_without_units_in_summaries_of_earlier_versions(tmp_path):
    summary = breccia.Summary(tmp_path, {"peak_stress_Pa": 2e6, "units": {"peak_stress_Pa": "Pa"}})
    assert summary.quantity("peak_stress") == breccia.Quantity(2e6, "Pa")


def test_a_unit_may_stand_beside_a_number(tmp_path):
    summary = breccia.Summary(tmp_path, {"packing": {"radius_max": {"unit": "m", "got": 0.9e-3, "asked": 1e-3}}})
    assert summary.quantity("packing.radius_max.asked") == breccia.Quantity(1e-3, "m")


def test_what_was_not_measured_is_not_a_number(whole, tmp_path):
    copy = shutil.copytree(whole, tmp_path / "copy")
    changed = json.loads((copy / "summary.json").read_text()) | {"poisson_ratio": None}
    (copy / "summary.json").write_text(json.dumps(changed))
    run = breccia.open_run(copy)
    assert math.isnan(run.quantity("poisson_ratio").value)
    assert run.summary["poisson_ratio"] is None and run.summary.get("poisson_ratio", 7) == 7 and run.summary.get("nothing") is None


def test_curves_have_names_headers_and_units(whole):
    curves = breccia.open_run(whole).curves
    with open(whole / "curves.csv") as file:
        rows = list(csv.reader(file))
    assert curves.rows == len(rows) - 1 and [c.header for c in curves.columns] == rows[0]
    k = rows[0].index("axial_stress_Pa")
    assert curves["axial_stress"].shape == (curves.rows,)
    assert [f"{v}" for v in curves["axial_stress"]] == [f"{float(r[k])}" for r in rows[1:]]
    assert curves.unit("axial_stress") == "Pa" and curves.unit("axial_strain") == "1" and curves.column("axial_stress").doc
    assert "axial_stress" in curves and "axial_stress_Pa" in curves and "other" not in curves
    assert (numpy.diff(curves["time"]) > 0).all()
    assert [c.name for c in curves.with_role("axial_stress")] == ["axial_stress"] and curves.with_role("nothing") == []


def test_the_largest_stress_is_the_peak(whole):
    run = breccia.open_run(whole)
    assert run.curves["axial_stress"].max() == pytest.approx(run.quantity("peak_stress").value, rel=1e-6)


def test_tables_of_postprocessors(whole):
    tables = breccia.open_run(whole).tables
    assert set(tables) == {f.stem for f in (whole / "tables").glob("*.csv")} and tables
    assert all(t.rows and all(c.unit for c in t.columns) for t in tables.values())


def test_frames_are_those_of_the_lattice(whole):
    run = breccia.open_run(whole)
    first = run.particles[0]
    assert len(run.particles) == len(run.bonds) == len(run.walls) == len(list(whole.glob("particles_*.vtp")))
    assert first.points.shape == (128, 3) and first["radius"].shape == (128,) and first["velocity"].shape == (128, 3)
    spacing = numpy.unique(numpy.round(first.points[:, 2] * 1e3, 3))
    assert len(spacing) == 8 and numpy.allclose(numpy.diff(spacing), 2, atol=0.01)
    assert first["mass"] == pytest.approx(numpy.full(128, 2650 * 4 / 3 * math.pi * 1e-9), rel=1e-6)
    assert (first.unit("radius"), first.unit("mass"), first.unit("velocity"), first.unit("id")) == ("m", "kg", "m/s", "1")
    assert first.field("dimension").tolist() == [3] and "radius" in first and "state" not in first
    assert first.time == run.particles.times[0] and (numpy.diff(run.particles.times) > 0).all()
    assert list(run.walls[0]["name"]) == ["lower_platen", "upper_platen"]


def test_bonds_join_neighbours(whole):
    run = breccia.open_run(whole)
    ends, points = run.bonds[0].ends, run.particles[0].points
    assert len(ends) == 2 * 3 * 4 * 8 + 4 * 4 * 7 == run.summary["bonds"]
    assert numpy.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1) == pytest.approx(numpy.full(len(ends), 2e-3), rel=0.01)


def test_cracks_are_the_broken_bonds(torn):
    run = breccia.open_run(torn)
    cracks = run.cracks
    assert len(cracks) == run.summary["damage.bonds_broken"] >= 16  # a layer at least
    assert list(cracks.mode).count("tension") == run.summary["bonds_broken_tension"]
    assert list(cracks.mode).count("shear") == run.summary["bonds_broken_shear"]
    assert (numpy.diff(cracks.time) >= 0).all() and 0 < cracks.time[-1] <= run.curves["time"][-1] * (1 + 1e-6)
    assert numpy.linalg.norm(cracks.normal, axis=1) == pytest.approx(numpy.ones(len(cracks)), abs=1e-5)
    assert cracks.position.shape == (len(cracks), 3) and cracks.radius == pytest.approx(numpy.full(len(cracks), 1e-3), rel=1e-6)
    along = abs(cracks.normal[:, 2]) > 0.9
    assert along.sum() >= 16 and set(cracks.bond) <= set(range(304))


def test_frames_are_found_by_time_and_by_output(whole):
    run = breccia.open_run(whole)
    times = run.particles.times
    assert run.particles.at(times[2] + 0.1 * (times[3] - times[2])).time == times[2]
    assert [f.time for f in run.particles[1:3]] == list(times[1:3]) and run.particles[-1].time == times[-1]
    for name in ("fine", "fine_vtk"):
        assert len(run.frames("bonds", name)) > len(run.bonds)


def test_a_frame_is_read_only_when_it_is_looked_at(whole, tmp_path):
    copy = shutil.copytree(whole, tmp_path / "copy")
    (copy / "particles_000001.vtp").unlink()
    frames = breccia.open_run(copy).particles
    assert frames[0]["radius"].size and frames[1].time > 0
    with pytest.raises(breccia.NotThere, match="particles_000001.vtp: is not there"):
        frames[1]["radius"]


def test_the_resolved_workflow(whole):
    run = breccia.open_run(whole)
    assert run.workflow["name"] == "base"
    assert run.setting("contact_law.friction") == 0.5 and run.setting("protocol.platen_velocity") == "0.2 m/s"
    assert run.setting("outputs[1].name") == run.setting("outputs.1.name") == "fine"


def test_an_interrupted_run_has_all_but_its_end(interrupted):
    run = breccia.open_run(interrupted)
    assert run.state == "interrupted" and not run.finished
    assert run.summary["interrupted"] is True and run.curves.rows > 2 and run.particles[-1]["radius"].shape == (128,)


def test_a_killed_run_has_what_it_had_written(killed):
    run = breccia.open_run(killed)
    assert run.state == "unfinished" and run.place == killed / "unfinished"
    assert run.curves.rows > 2 and run.curves.unit("time") == "s" and run.setting("contact_law.friction") == 0.5
    assert run.particles[0]["radius"].shape == (128,)
    with pytest.raises(breccia.NotThere, match="has not come to its end"):
        run.summary


def test_earlier_results_stay_when_a_later_run_was_killed(whole, killed, tmp_path):
    copy = shutil.copytree(whole, tmp_path / "copy")
    shutil.copytree(killed / "unfinished", copy / "unfinished")
    run = breccia.open_run(copy)
    assert run.finished and run.newer_unfinished and run.summary["particles"] == 128


def test_a_batch_of_runs(whole, interrupted, killed, tmp_path):
    for name, folder in (("a/whole", whole), ("b/interrupted", interrupted), ("c/killed", killed)):
        shutil.copytree(folder, tmp_path / name)
    damaged = shutil.copytree(whole, tmp_path / "d")
    (damaged / "summary.json").write_text("{")
    (tmp_path / "notes").mkdir()
    runs = breccia.find_runs(tmp_path)
    assert [r.name for r in runs] == ["whole", "interrupted", "killed"] and [r.name for r in runs.finished] == ["whole"]
    assert runs.values("particles")[:2].tolist() == [128, 128] and math.isnan(runs.values("particles")[2])
    assert list(runs.skipped) == [damaged] and "summary.json" in runs.skipped[damaged]
    assert len(runs[:2]) == 2 and runs[2].state == "unfinished"


def test_data_frames(whole):
    pandas = pytest.importorskip("pandas")
    run = breccia.open_run(whole)
    frame = run.curves.frame()
    assert isinstance(frame, pandas.DataFrame) and list(frame) == [c.header for c in run.curves.columns]
    assert list(breccia.find_runs(whole).frame(["particles"])["particles"]) == [128]


def test_a_contact_along_a_path_is_read_as_a_run(tmp_path):
    from conftest import BASE, breccia_says
    (tmp_path / "path.csv").write_text("normal_m\n-1e-6\n0\n")
    breccia_says("drive", BASE, "--path", tmp_path / "path.csv", "-o", tmp_path / "driven", "--radius", "1 mm")
    curves = breccia.open_run(tmp_path / "driven").curves
    assert curves.rows > 2 and curves.unit("normal_force") == "N"
