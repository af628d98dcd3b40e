# SPDX-License-Identifier: BSD-3-Clause
"""Oñate et al. (2015): every published number, the figures, the mesh-size study and the experiments."""
import json

from . import onate2015_experiments as study
from .onate2015_figures import Figures, confined
from .onate2015_law import law
from .report import Report, kept
from .runs import Case, mean

CEMENT = {"cement_ucs": 70, "cement_triaxial_500psi": 500, "cement_triaxial_1000psi": 1000, "cement_triaxial_2000psi": 2000,
          "cement_triaxial_4000psi": 4000}                                      # confining pressure [psi]
CONCRETE = {"concrete_ucs": 0, "concrete_triaxial_4.5MPa": 4.5, "concrete_triaxial_9MPa": 9, "concrete_triaxial_60MPa": 60}   # [MPa]
CYCLIC = "concrete_cyclic_40MPa"
# The long ones first.
MAIN = ["cement_triaxial_4000psi", "cement_triaxial_2000psi", "cement_triaxial_1000psi", "cement_triaxial_500psi", "cement_ucs",
        "concrete_triaxial_60MPa", "shale_ucs", "cement_usc", "concrete_triaxial_9MPa", "concrete_triaxial_4.5MPa", "concrete_ucs",
        "shale_bts", "concrete_bts", CYCLIC, "cement_bts"]
E_0 = {"cement": 3.80e9, "concrete": 28e9, "shale": 30e9}                       # Tables 2, 5, 6
SPHERES = {"cement_usc": 16000, "cement_bts": 16000, "cement": 42000, "concrete_bts": 27000, CYCLIC: 4000, "concrete": 13000, "shale_bts": 27000, "shale": 37000}
MODULUS, MODEL, LABORATORY = 0.07, 0.10, 0.15   # targets: of E_0; of the paper's own result; of an experiment where only that is given
LIMIT = {"cement_ucs": 8.5e6, "cement_triaxial_500psi": 9.5e6, "cement_triaxial_1000psi": 10e6, "cement_triaxial_2000psi": 13e6, "cement_triaxial_4000psi": 21e6,
         "concrete": 20e6, "shale": 20e6}    # LCS1: a contact yields from here on
TENSILE = "brazilian_tensile_strength_Pa"
# Of its pictures, in docs: the charts.
SHOWN = ["cement.png", "cement_usc.png", "cement_envelope.png", "concrete.png", "concrete_cyclic.png", "concrete_envelope.png", "shale.png", "brazilian.png", "law_*.png", "contact_stress_*.png", "mesh_size.png"]
NUMBERS = [  # workflow, what, key, published, unit, target
    ("cement_ucs", "cement, compressive strength in the jacket, experiment [MPa]", "peak_stress_Pa", 17.0e6, 1e6, LABORATORY),
    ("cement_bts", "cement, Brazilian strength, paper's model [MPa]", TENSILE, 3.0e6, 1e6, MODEL),
    ("cement_bts", "cement, Brazilian strength, experiment [MPa]", TENSILE, 2.9e6, 1e6, None),
    ("cement_usc", "cement, uniaxial strain: differential stress at the end of the linear part (slope down to 80 %), experiment, about [MPa]",
     "limit", 10e6, 1e6, LABORATORY),
    ("cement_usc", "the same where the slope is down to half [MPa]", "half", 10e6, 1e6, None),
    ("concrete_ucs", "concrete, compressive strength, experiment, 32.8 to 38 [MPa]", "peak_stress_Pa", 37e6, 1e6, LABORATORY),
    ("concrete_bts", "concrete, Brazilian strength, experiment [MPa]", TENSILE, 3.0e6, 1e6, LABORATORY),
    ("shale_ucs", "shale, compressive strength, paper's model [MPa]", "peak_stress_Pa", 48e6, 1e6, MODEL),
    ("shale_ucs", "shale, compressive strength, experiment [MPa]", "peak_stress_Pa", 50e6, 1e6, None),
    ("shale_bts", "shale, Brazilian strength, paper's model [MPa]", TENSILE, 5.4e6, 1e6, MODEL),
    ("shale_bts", "shale, tensile strength, experiment [MPa]", TENSILE, 5.0e6, 1e6, None),
]


def validate(runner, seeds):
    small = runner.variant
    cases = {(w, s): Case(f"onate2015/{w}", s, pictures=s == seeds[0], variant=small) for s in seeds for w in MAIN}
    first = [c for (_, s), c in cases.items() if s == seeds[0]]
    experiments = study.cases(runner, seeds[0])
    found = {r.case: r for r in runner.run(first + experiments + [c for c in cases.values() if c not in first])}
    runs = {w: [found[cases[w, s]] for s in seeds if cases[w, s] in found] for w in MAIN}
    report, figures = Report(), Figures(runner, "onate2015")
    report.text("# Oñate et al. (2015): measured beside published",
                f"Made by `tools/validate onate2015` from the workflows in `workflows/onate2015`{f', variant `{small}`' if small else ''}; seeds "
                f"{', '.join(map(str, seeds))}: mean ± sample standard deviation. Every seed packs a specimen of its own. The paper gives "
                "the numbers of spheres, and neither their sizes nor the porosity; what was chosen is at the end.")
    head = len(report.lines)
    numbers(report, runs)
    made(report, runs)
    series(report, runs, CEMENT, "cement", "psi", 6894.757)
    series(report, runs, CONCRETE, "concrete", "MPa", 1e6)
    curves(report, figures, runs)
    figures.envelope(report, "cement", [r for w in [*CEMENT, "cement_bts"] for r in runs[w][:1]])
    figures.envelope(report, "concrete", [r for w in [*CONCRETE, "concrete_bts"] for r in runs[w][:1]])
    cycles(report, figures, runs[CYCLIC])
    law(report, runner, figures.folder)
    figures.contacts(report, [r for w in CEMENT for r in runs[w][:1]])
    figures.failed(report, runs)
    study.tables(report, runner, found, seeds[0], figures)
    scaling(report, runner)
    report.text((runner.root / "python/validation/onate2015_discussion.md").read_text())
    report.finish(runner, "onate2015", head, SHOWN)


def numbers_of(runs, key):
    share = {"limit": 0.8, "half": 0.5}.get(key)
    values = [limit_stress(r, share) if share else r.get(key) for r in runs]
    return [v for v in values if v is not None]


def numbers(report, runs):
    report.text("## Published numbers")
    rows = []
    for workflow, what, key, published, unit, target in NUMBERS:
        values = numbers_of(runs[workflow], key)
        rows.append(report.compared(what, values, published, unit, 2, target) if values else [what, "not measured", f"{published / unit:.2f}", "", ""])
    for workflow in [*CEMENT, *CONCRETE, CYCLIC, "shale_ucs"]:
        values = numbers_of(runs[workflow], "youngs_modulus_Pa")
        if values:
            limit = next(v for name, v in LIMIT.items() if workflow.startswith(name))
            pressure = runs[workflow][0].get("triaxial_compression.confining_pressure_asked_Pa") or 0
            yields = pressure > limit
            rows.append(report.compared(f"{workflow}, Young's modulus against E_0 [GPa]" + (" (pressure above LCS1)" if yields else ""), values,
                                        E_0[workflow.split("_")[0]], 1e9, 2, None if yields else MODULUS))
    for workflow in ["cement_ucs", "concrete_ucs", "shale_ucs"]:
        values = numbers_of(runs[workflow], "poisson_ratio")
        if values:
            rows.append(report.compared(f"{workflow}, Poisson's ratio against the input", values, 0.2, 1, 3))
    report.table(["", "measured", "published", "distance", f"within {MODULUS:.0%} (modulus), {MODEL:.0%} (model), {LABORATORY:.0%} (experiment)"], rows)
    report.text("Where the confining pressure lies above the first limit of the contacts (LCS1) they yield while it is applied, and the specimen "
                "is no longer elastic when axial loading begins: the law does not imply E_0 there, and no target is set. See the experiment below.")


def made(report, runs):
    report.text("## The runs", "Of the first seed. The error of the energy balance is a share of the work done.")
    rows = []
    for workflow in MAIN[::-1]:
        for run in runs[workflow][:1]:
            paper = next(n for name, n in SPHERES.items() if workflow.startswith(name))
            rows.append([f"`{workflow}`", run.get("particles"), paper, run.get("bonds"), f"{run.get('porosity'):.3f}", f"{run.get('coordination_number'):.2f}",
                         run.get("steps"), f"{run.get('time_step_s') * 1e9:.1f}", f"{run.get('wall_time_s') / 60:.1f}", f"{run.get('energy_error'):.0e}",
                         len(runs[workflow])])
    report.table(["", "spheres", "paper's", "bonds", "porosity", "N_c", "steps", "time step [ns]", "wall time [min]", "energy error", "seeds"], rows)


def limit_stress(run, share):
    """Of uniaxial strain: the differential stress where the slope over 0.02 % of strain first falls to this share of the slope at the start [Pa]."""
    strain, stress = run.curve("platen_strain"), run.curve("deviatoric_platen_stress_Pa")
    start = next((k for k, e in enumerate(strain) if e >= 2e-4), None)
    if start is None or strain[start] <= strain[0]:
        return None
    at_first = (stress[start] - stress[0]) / (strain[start] - strain[0])
    low = 0
    for k, e in enumerate(strain):
        while strain[low] < e - 2e-4:
            low += 1
        if e > 4e-4 and low < k and (stress[k] - stress[low]) / (e - strain[low]) < share * at_first:
            return stress[low]
    return None


def series(report, runs, group, material, unit, pascal):
    present = {w: p for w, p in group.items() if runs[w]}
    if not present:
        return
    report.text(f"## {material.capitalize()}: strength and ductility against confinement",
                "Differential stress (axial less confining) of the platens. Residual: at the end of the run, over the peak.")
    rows, axial, peaks, residuals = [], [], [], []
    for w, pressure in present.items():
        points = [confined(r) for r in runs[w]]
        peak = [max(s for _, s, _ in p) for p in points]
        last = [p[-1][1] / m for p, m in zip(points, peak)]
        at = [max(p, key=lambda q: q[1])[0] for p in points]
        peaks.append(mean(peak))
        axial.append(mean(peak) + pressure * pascal)
        residuals.append(mean(last))
        rows.append([f"{pressure} {unit}", f"{mean(peak) * 1e-6:.1f}", f"{axial[-1] * 1e-6:.1f}", f"{mean(at):.2%}",
                     f"{mean(last):.2f}", f"{mean([p[-1][0] for p in points]):.2%}"])
    report.table(["confining pressure", "peak, differential [MPa]", "axial [MPa]", "strain at the peak", "residual", "run to"], rows)
    for text, values in [("strength (axial stress) rises with the confinement", axial), ("differential strength rises with the confinement", peaks),
                         ("from brittle to ductile: the residual rises with the confinement", residuals)]:
        holds = all(a < b or (values is residuals and b > 0.98) for a, b in zip(values, values[1:]))
        report.text(f"{text[0].upper() + text[1:]}: {kept(holds)}.")
        if not holds:
            report.missed.append(f"{material}: {text}")


def curves(report, figures, runs):
    report.text("## Stress-strain curves", "Of the first seed. Strain is the approach of the platens over the height, from the end of the confining stage on.")
    for name, number, group in [("cement", "Figs 15 and 16", CEMENT), ("concrete", "Figs 22 and 23", CONCRETE), ("shale", "Fig. 26", ["shale_ucs"])]:
        figures.stress_strain(report, number, f"{name}: differential stress at all confinements", [r for w in group for r in runs[w][:1]], name)
    figures.compaction(report, runs["cement_usc"][:1])
    figures.brazilian(report, [r for w in ["cement_bts", "concrete_bts", "shale_bts"] for r in runs[w][:1]])


def slope(points, low=None, high=None):
    """Least squares of stress over strain between two stresses; if absent over the middle half of all [Pa]."""
    if low is None:
        bottom, top = min(s for _, s, _ in points), max(s for _, s, _ in points)
        low, high = bottom + 0.25 * (top - bottom), top - 0.25 * (top - bottom)
    inside = [(e, s) for e, s, _ in points if low <= s <= high]
    if len(inside) < 3:
        return None
    me, ms = mean([e for e, _ in inside]), mean([s for _, s in inside])
    across = sum((e - me) ** 2 for e, _ in inside)
    return sum((e - me) * (s - ms) for e, s in inside) / across if across else None


def cycles(report, figures, runs):
    if not runs:
        return
    report.text("## Cycles of unloading and reloading, concrete at 40 MPa (Fig. 25)",
                "Slopes of the differential stress over the strain between the platens, by least squares over the middle half of each "
                "stage (when reloading: of the way back to the stress where unloading began), against the modulus at the start of "
                "loading, measured in the same way between 5 and 25 % of the highest stress.")
    points = confined(runs[0])
    peak = max(s for _, s, _ in points)
    stages = sorted({k for _, _, k in points})
    first = slope([p for p in points if p[2] == stages[0]], 0.05 * peak, 0.25 * peak)
    rows, before = [], None
    for k in stages:
        part = [p for p in points if p[2] == k]
        falls = part[-1][1] < part[0][1]
        if before is not None:
            part = part if falls else [p for p in part if p[1] <= before]
            value = slope(part) if len(part) > 2 else None
            if value and first:
                rows.append([int(k), "unloading" if falls else "reloading", f"{part[0][0]:.2%}", f"{value * 1e-9:.2f}", f"{value / first:.2f}"])
        if not falls:
            before = [p for p in points if p[2] == k][-1][1]
    report.text(f"Initial modulus {first * 1e-9:.2f} GPa; E_0 is 28 GPa." if first else "The start of loading has too few samples.")
    report.table(["stage", "", "from strain", "slope [GPa]", "over the initial modulus"], rows)
    figures.stress_strain(report, "Fig. 25", "concrete at 40 MPa, unloaded and reloaded", runs[:1], "concrete_cyclic")


def scaling(report, runner):
    """results/bench/onate2015_scaling.json: [{"threads": 1, "seconds_per_1000_steps": 123.4}, ...]."""
    report.text("## Scaling: 70000 spheres, 1000 steps (Table 1)")
    file = runner.root / "results/bench/onate2015_scaling.json"
    published = dict(zip([1, 2, 4, 8, 12, 16], zip([699.25, 434.03, 255.35, 151.23, 111.05, 88.04], [699.25, 372.29, 243.92, 111.01, 71.09, 56.35])))
    own = {e["threads"]: e["seconds_per_1000_steps"] for e in json.loads(file.read_text())} if file.exists() else {}
    rows = [[n, f"{own[n]:.2f}" if n in own else "", *(f"{v:.2f}" for v in published.get(n, ()))] for n in sorted({*own, *published})]
    report.text("Wall seconds. Published: Intel Xeon E5-2670." + ("" if own else " Not measured here: `tools/bench` does it."))
    report.table(["threads", "here", "paper, OpenMP", "paper, MPI"], rows)
