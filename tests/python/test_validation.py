# SPDX-License-Identifier: BSD-3-Clause
"""The reports' machinery: what is run again and what is not, numbers beside the text, which pictures the tree has; and
the linear network against a lattice whose modulus is known."""
import json
import math
import pathlib
import re
import shutil
import types

import breccia
import numpy
import pytest
from conftest import BASE, PROGRAM, root

from validation import report as reports
from validation.ouyang2017_network import Network
from validation.runs import Case, Runner

PAPERS = sorted((root / "docs/validation").glob("*.md"))


@pytest.fixture
def tree(tmp_path):
    """A tree with one workflow and one study of it."""
    (tmp_path / "workflows/small").mkdir(parents=True)
    shutil.copy(BASE, tmp_path / "workflows/small/base.yaml")
    for name, velocity in (("quick", "0.2"), ("slow", "0.1")):
        (tmp_path / f"workflows/small/{name}.yaml").write_text(
            f"base: base.yaml\nname: {name}\nprotocol: {{platen_velocity: {velocity} m/s, max_strain: 0.05 %}}\nvariants: {{soft: {{contact_law: {{bond_modulus: 5 GPa}}}}}}\n")
    (tmp_path / "workflows/small/study.yaml").write_text(
        "workflows:\n  - {name: quick, file: quick.yaml}\n  - {name: slow, file: slow.yaml}\nfixed:\n  outputs: []\ngrid:\n  contact_law.friction: [0.1, 0.5]\n")
    (tmp_path / "docs/validation").mkdir(parents=True)
    return tmp_path


def runner(tree, **how):
    return Runner(tree, tree / "results", 2, **({"keep": True, "program": pathlib.Path(PROGRAM)} | how))


def test_folders_of_runs_have_the_names_that_they_had():
    assert Case("ouyang2017/baseline_a_ucs", None, variant="inferred").name == "baseline_a_ucs_inferred"
    assert Case("potyondy2004/ucs_2d", 3, ("a=b",), "beta_0").name == "ucs_2d_beta_0_seed3"


def test_finished_runs_are_kept_and_others_are_missing(tree):
    cases = [Case("small/quick", 1), Case("small/slow", 1, ("contact_law.friction=0.2",), "smooth")]
    first = runner(tree, only="quick")
    found = first.run(cases)
    assert [r.case for r in found] == cases[:1] and first.missing == ["slow_smooth_seed1"] and first.is_part
    assert found[0].get("particles") == 128 and found[0].curve("time_s").size and not found[0].has_frames
    written = (tree / "results/quick_seed1/summary.json").stat().st_mtime_ns
    again = runner(tree)
    assert [r.case for r in again.run(cases)] == cases and not again.missing and not again.is_part
    assert (tree / "results/quick_seed1/summary.json").stat().st_mtime_ns == written
    assert again.results[cases[1]].setting("contact_law.friction") == 0.2
    reader = runner(tree, report=True)
    assert len(reader.run([*cases, Case("small/quick", 2)])) == 2 and reader.missing == ["quick_seed2"]
    assert not (tree / "results/quick_seed2").exists()


def test_a_run_that_did_not_finish_is_not_taken_for_one(tree):
    runner(tree).run([Case("small/quick", 1)])
    shutil.move(tree / "results/quick_seed1", tree / "results/unfinished")
    (tree / "results/quick_seed1").mkdir()
    shutil.move(tree / "results/unfinished", tree / "results/quick_seed1/unfinished")
    (tree / "results/quick_seed1/unfinished/summary.json").unlink()
    assert runner(tree, report=True).run([Case("small/quick", 1)]) == []


def test_a_study_of_a_variant_has_its_values_and_more(tree):
    once = runner(tree)
    cases = once.sweep("small/study", 4, "soft", "soft", [("contact_law.stiffness_ratio", "2")])
    assert not once.missing and (tree / "results/study_soft/results.csv").exists()
    assert sorted((c.workflow, c.inputs["contact_law.friction"]) for c in cases) == [(w, f) for w in ("quick", "slow") for f in (0.1, 0.5)]
    run = breccia.open_study(tree / "results/study_soft").finished[0].run
    assert run.setting("contact_law.bond_modulus") == "5e9 Pa" and run.setting("contact_law.stiffness_ratio") == 2 and run.setting("outputs") == []
    reader = runner(tree, report=True)
    assert len(reader.sweep("small/study", 4, "soft", "soft", [("contact_law.stiffness_ratio", "2")])) == 4
    assert reader.sweep("small/study", 4) == [] and reader.missing == ["study (4 of 4 cases)"]


def test_recorded_cases_of_a_study_are_not_run_again(tree):
    once = runner(tree)
    before = once.sweep("small/study", 4)
    reports.Report().finish(once, "paper", 0, [])
    record = tree / "docs/validation/paper.json"
    read = json.loads(record.read_text())
    assert "earlier sittings" not in (tree / "docs/validation/paper.md").read_text()
    dropped = read["studies"]["study"].pop(1)
    read["studies"]["study"][0]["inputs_sha256"] = "0" * 64    # of other inputs: not this case
    record.write_text(json.dumps(read))
    shutil.rmtree(tree / "results/study")
    again = runner(tree, record=record)
    after = again.sweep("small/study", 4)
    assert [c.inputs_sha256 for c in after] == [c.inputs_sha256 for c in before] and [c.earlier for c in after] == [False, False, True, True]
    assert sorted(f.name for f in (tree / "results/study/cases").iterdir() if not f.name.startswith(".")) == sorted(f"friction=0.1_{w}" for w in ("quick", "slow"))
    assert after[1].values == before[1].values and after[2].values["peak_stress_Pa"] == pytest.approx(before[2].values["peak_stress_Pa"], rel=1e-8)
    assert dropped["program"] == before[1].program and again.missing == []
    reports.Report().finish(again, "paper", 0, [])
    assert f"Of the 4 cases of the studies these are of earlier sittings, known again by the hash of their inputs: 2 by version {dropped['program']}." in (
        tree / "docs/validation/paper.md").read_text()
    base = tree / "workflows/small/base.yaml"
    base.write_text(base.read_text() + "seed: 2\n")
    shutil.rmtree(tree / "results/study")
    assert runner(tree, report=True, record=record).sweep("small/study", 4) == []    # the workflow is another one now
    record.write_text('{"studies": {"study": [{"workflow": "quick"}]}}')
    with pytest.raises(SystemExit, match="is no data of a report"):
        runner(tree, record=record)


def test_numbers_are_written_beside_the_text(tree):
    of = runner(tree)
    results = of.run([Case("small/quick", s) for s in (1, 2)])
    of.missing.append("slow_seed1")
    report = reports.Report()
    report.text("# A paper", "What it is.")
    head = len(report.lines)
    report.text("## Packing")
    lattice = 1 - math.pi / 6
    rows = [report.compared(f"porosity [%], {word}", [r.get("porosity") for r in results], value, 0.01, 2, 0.1) for word, value in (("of the lattice", lattice), ("of another", 0.4))]
    report.table(["", "measured", "paper", "distance", "within"], rows)
    (tree / "results/paper").mkdir()
    report.finish(of, "paper", head, ["*"])
    read = json.loads((tree / "docs/validation/paper.json").read_text())
    assert read["runs"]["quick_seed1"]["values"]["porosity"] == pytest.approx(lattice) and read["runs"]["quick_seed1"]["values"]["particles"] == 128
    assert read["units"]["simulated_time_s"] == "s" and read["not_run"] == ["slow_seed1"]
    first, second = read["comparisons"]
    assert first["mean"] == pytest.approx(100 * lattice) and first["deviation"] == pytest.approx(0, abs=1e-9) and first["met"] is True
    assert second["published"] == 40 and second["met"] is False and second["distance"] == pytest.approx(lattice / 0.4 - 1)
    assert read["tables"] == reports.tables_of((tree / "docs/validation/paper.md").read_text())
    assert read["targets_not_met"] == report.missed and len(report.missed) == 1
    text = (tree / "docs/validation/paper.md").read_text()
    assert text.replace("The same numbers as data: [paper.json](paper.json).\n\n", "") == (tree / "results/paper.md").read_text() and text.index("Targets not met") < text.index("## Packing") and "`slow_seed1`" in text


def test_the_tree_has_the_pictures_that_are_chosen(tree):
    (tree / "results/paper").mkdir(parents=True)
    for name in ("a.png", "b.png", "c.png"):
        (tree / "results/paper" / name).write_bytes(name.encode())
    text = "# P\n\nIntro.\n\n## F\n\n**Fig. 1.** Two.\n\n![t](paper/a.png) ![t](paper/b.png)\n\n**Fig. 2.** One.\n\n![t](paper/c.png)\n\nEnd.\n"
    shown = reports.published(text, "paper", tree / "results", tree / "docs/validation", ["a.*"])
    assert shown == ("# P\n\nIntro.\n\nThe same numbers as data: [paper.json](paper.json); the report that `tools/validate paper` leaves "
                     "beside the results has 2 pictures more.\n\n"
                     "## F\n\n**Fig. 1.** Two.\n\n![t](paper/a.png)\n\nEnd.\n")
    assert [f.name for f in (tree / "docs/validation/paper").iterdir()] == ["a.png"]
    assert reports.published(text, "paper", tree / "results", tree / "docs/validation", ["*"]) == text.replace("## F", "The same numbers as data: [paper.json](paper.json).\n\n## F")


@pytest.mark.parametrize("paper", PAPERS, ids=lambda p: p.stem)
def test_reports_of_the_tree_have_their_numbers_and_their_pictures(paper):
    """After an edit by hand: tools/validate PAPER --report."""
    text = paper.read_text()
    assert json.loads(paper.with_suffix(".json").read_text())["tables"] == reports.tables_of(text)
    there = {f.relative_to(paper.parent).as_posix() for f in (paper.parent / paper.stem).glob("*")}
    assert there == set(re.findall(r"\]\(([^)]+\.png)\)", text))


def lattice(columns, rows, radius, diagonals=False):
    """Equal discs on a square lattice as a run has them in its first frames."""
    at = [(2 * radius * x, 2 * radius * y, 0.0) for y in range(rows) for x in range(columns)]
    ends = [(y * columns + x, (y + 1) * columns + x) for y in range(rows - 1) for x in range(columns)]
    ends += [(y * columns + x, y * columns + x + 1) for y in range(rows) for x in range(columns - 1)]

    class Particles:
        points = numpy.array(at)

        def __getitem__(self, name):
            assert name == "radius"
            return numpy.full(len(at), radius)
    return types.SimpleNamespace(particles=[Particles()], bonds=[types.SimpleNamespace(ends=numpy.array(ends))])


def test_a_square_lattice_is_a_row_of_springs():
    """Rows of n springs k_n/d each between the ends: modulus k_n/d, no lateral strain, whatever the other stiffnesses are;
    half the stiffness with bonds over twice the length."""
    radius, kn = 0.5, 3.0e9
    network = Network(lattice(6, 9, radius))
    modulus, ratio = network.tension(kn, 1.0e9, 0.2e9)
    assert modulus == pytest.approx(kn / (2 * radius), rel=1e-6) and ratio == pytest.approx(0, abs=1e-6)
    assert network.tension(kn, 1.0e9, 0.2e9, reference_length=4 * radius)[0] == pytest.approx(kn / (4 * radius), rel=1e-6)
    assert network.tension(kn, 1.0e9, 0.2e9, harmonic=True)[0] == pytest.approx(modulus, rel=1e-6)
    assert network.tension(kn, 1.0e9, 0.2e9, drop=0.3)[0] < modulus
