# SPDX-License-Identifier: BSD-3-Clause
"""Studies: cases, inputs in SI, values, runs; also of one that gathered nothing."""
import math
import shutil

import numpy
import pytest

import breccia

MODULUS, LIMIT = "contact_law.bond_modulus_Pa", "engine.energy_error_limit"


def test_cases_inputs_and_values(study):
    read = breccia.open_study(study)
    assert len(read) == 4 and read.inputs == [LIMIT, MODULUS]
    assert read.column(MODULUS).tolist() == [10e9, 20e9, 10e9, 20e9] and read.column(LIMIT).tolist() == [1, 1, 1e-15, 1e-15]
    assert [c.status for c in read] == ["finished", "finished", "failed", "failed"] and [c.number for c in read] == [1, 2, 3, 4]
    assert [c.number for c in read.finished] == [1, 2] and [c.number for c in read.failed] == [3, 4]
    assert "energy" in read.failed[0].error


def test_values_are_those_of_the_runs(study):
    read = breccia.open_study(study)
    moduli = read.column("youngs_modulus_Pa")
    assert [c.run.quantity("youngs_modulus").value for c in read.finished] == moduli[:2].tolist() and numpy.isnan(moduli[2:]).all()
    assert [read.unit(n) for n in ("youngs_modulus_Pa", "particles", MODULUS, LIMIT, "stiffening")] == ["Pa", "1", "Pa", "1", "1"]
    assert read.column("stiffening")[:2] == pytest.approx(moduli[:2] / read.column(MODULUS)[:2])
    assert moduli[1] / moduli[0] == pytest.approx(2, rel=0.02)  # bonds alone are elastic here; platens are stiffer still


def test_cases_that_failed_can_be_opened(study):
    assert breccia.open_study(study).failed[0].run.state != "finished"


def test_a_study_that_has_gathered_nothing(study, tmp_path):
    copy = shutil.copytree(study, tmp_path / "copy")
    (copy / "results.csv").unlink()
    read = breccia.open_study(copy)
    assert [c.status for c in read] == ["finished", "finished", "failed", "failed"] and read.column(MODULUS).tolist() == [10e9, 20e9, 10e9, 20e9]
    assert read[0].run.quantity("particles").value == 128 and read.keys == []


def test_its_runs_are_found(study):
    runs = breccia.find_runs(study)
    assert len(runs) == 4 and len(runs.finished) == 2


def test_names_that_are_not_there(study):
    read = breccia.open_study(study)
    with pytest.raises(breccia.NotThere, match="did you mean `youngs_modulus_Pa`"):
        read.column("youngs_modulus_P")
    with pytest.raises(breccia.NotThere, match="has no unit of `nothing`"):
        read.unit("nothing")


def test_units_of_a_study_by_an_earlier_version(study, tmp_path):
    copy = shutil.copytree(study, tmp_path / "copy")
    (copy / "results.json").write_text('[{"unit": "Pa"}]')
    with pytest.raises(breccia.Damaged, match="results.json: is no list of columns"):
        breccia.open_study(copy).unit("youngs_modulus_Pa")
    (copy / "results.json").unlink()
    assert breccia.open_study(copy).unit("youngs_modulus_Pa") == "Pa"
    with pytest.raises(breccia.NotThere, match="has no unit of"):
        breccia.open_study(copy).unit(MODULUS)


def test_a_damaged_table(study, tmp_path):
    copy = shutil.copytree(study, tmp_path / "copy")
    for text, words in (("a,b\n1,2\n", "no table of a study"), ("case,folder,status,x,error\n1,a,finished,many,\n", "results.csv:2: has a text"),
                        ("case,folder,status,error\n1,a\n", "has 2 cells"), ("", "is empty")):
        (copy / "results.csv").write_text(text)
        with pytest.raises(breccia.Damaged, match=words):
            breccia.open_study(copy)


def test_a_data_frame_has_a_row_for_each_case(study):
    pytest.importorskip("pandas")
    frame = breccia.open_study(study).frame()
    assert list(frame["status"]) == ["finished", "finished", "failed", "failed"] and math.isnan(frame["youngs_modulus_Pa"][3])
