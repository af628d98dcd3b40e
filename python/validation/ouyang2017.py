# SPDX-License-Identifier: BSD-3-Clause
"""Ouyang et al. (2017): Tables 1 and 3 to 5, Figures 7 to 17, and the tests that the paper leaves as future work."""
import math

from . import ouyang2017_experiments as study
from . import ouyang2017_reading as reading
from .ouyang2017_figures import Figures, broken_at, peak
from .ouyang2017_trends import stated, studies_of, trends
from .report import Report
from .runs import Case, mean, spread

SPECIMENS = "abcde"
TABLE_1 = {  # mean radius [mm], particles, bonds, porosity [%]
    "a": (0.544, 2031, 5100, 13.77), "b": (0.559, 2006, 5031, 13.76), "c": (0.557, 2023, 5089, 13.65), "d": (0.560, 1996, 5004, 13.72), "e": (0.564, 1960, 4912, 14.02)}
TABLE_3 = {  # Ec, Et [GPa], nu_c, nu_t, UCS, TS [MPa], UCS/TS, Ec/Et, nu_c/nu_t
    "a": (16.9, 14.4, 0.19, 0.11, 185.0, 11.4, 16.2, 1.17, 1.69), "b": (16.9, 15.4, 0.19, 0.14, 195.2, 9.5, 20.5, 1.10, 1.29),
    "c": (17.4, 13.8, 0.20, 0.13, 206.4, 13.0, 15.9, 1.26, 1.58), "d": (15.0, 12.5, 0.19, 0.11, 164.1, 11.3, 14.5, 1.20, 1.64),
    "e": (16.7, 13.0, 0.21, 0.13, 194.9, 14.6, 13.4, 1.29, 1.69)}
MEANS = (16.6, 13.8, 0.19, 0.12, 189.1, 12.0, 16.1, 1.20, 1.58)
DEVIATIONS = (0.81, 1.02, 0.01, 0.01, 14.24, 1.71, 2.43, 0.07, 0.15)
NAMES = ("Ec [GPa]", "Et [GPa]", "nu_c", "nu_t", "UCS [MPa]", "TS [MPa]", "UCS/TS", "Ec/Et", "nu_c/nu_t")
DIGITS = (1, 1, 2, 2, 1, 1, 1, 2, 2)
SHARES = (0.07, 0.07, None, None, 0.10, 0.12, None, None, None)   # targets on the means; Poisson's ratios within RATIO
RATIO, ROCK = 0.03, 0.10
ROCKS = {"lac_du_bonnet": "Lac du Bonnet granite", "quartzite": "quartzite"}
TABLE_4 = {"lac_du_bonnet": (0.562, 7892, 20071, 13.48), "quartzite": (0.373, 4365, 11021, 13.67)}
TABLE_5 = {  # UCS, TS, UCS/TS, Ec, Et, Ec/Et, nu_c: experiment, NET-BPM
    "lac_du_bonnet": ((200.0, 9.3, 21.5, 68.1, 47.5, 1.43, 0.35), (201.4, 9.3, 21.7, 68.0, 46.8, 1.45, 0.36)),
    "quartzite": ((264.0, 14.9, 17.8, 75.3, 66.6, 1.13, 0.20), (265.8, 14.8, 18.0, 75.7, 62.0, 1.22, 0.20))}
ORDER_5 = (4, 5, 6, 0, 1, 7, 2)         # of Table 5 in that of Table 3
BROKEN = {"baseline_a_ucs": ("compression", 10000, (420, 931)), "baseline_a_tension": ("tension", 4000, (7, 88))}   # steps after the peak, of 10 ns
NEW = ("baseline_3d_ucs", "baseline_3d_tension", "baseline_biaxial", "baseline_brazilian")
INTERVALS = {  # of the frames
    "baseline_a_ucs": "50 us", "baseline_a_tension": "10 us", "lac_du_bonnet_ucs": "50 us", "lac_du_bonnet_tension": "40 us", "quartzite_ucs": "50 us",
    "quartzite_tension": "20 us", "baseline_brazilian": "50 us", "baseline_biaxial": "100 us", "baseline_3d_ucs": "200 us", "baseline_3d_tension": "50 us"}


# Of its pictures, in docs: curves, and of each study what the text speaks of.
SHOWN = ["load_*.png", "*_compression.png", "*_tension.png", "biaxial.png", "brazilian.png", "envelope.png", "size_effect_*.png", "study_ks_kn_nu_c.png", "study_ks_kn_UCS_over_TS.png",
         "study_b_UCS_over_TS.png", "study_b_Ec_over_Et.png", "study_b_inferred_UCS_over_TS.png", "study_b_inferred_Ec_over_Et.png", "study_w_UCS.png", "study_shear_strain_UCS.png"]


def workflow(name, variant=""):
    frames = INTERVALS.get(name)
    settings = () if variant or not frames else ("renderers=[]", f"outputs[0].interval={frames}")
    return Case("ouyang2017/" + name, None, settings, pictures=bool(frames), variant=variant)


def validate(runner, seeds):
    """The seeds are those of the workflows: specimens A to E."""
    small = runner.variant
    names = [f"baseline_{s}_{t}" for s in SPECIMENS for t in ("tension", "ucs")] + [f"{r}_{t}" for r in ROCKS for t in ("tension", "ucs")] + list(NEW)
    cases = {n: workflow(n, small) for n in names}
    plain = {study.UCS: cases["baseline_a_ucs"], study.TENSION: cases["baseline_a_tension"]}
    # What the paper has numbers for comes first: it all takes hours.
    results = runner.run([c for n, c in cases.items() if n not in NEW] + ([] if small else reading.cases(SPECIMENS, ROCKS, cases)))
    studies = {} if small else {r: studies_of(runner, r) for r in reading.READINGS}
    results += runner.run([cases[n] for n in NEW] + ([] if small else [c for *_, c in reading.other_packings(ROCKS, cases)] + study.cases(plain)))
    found = {r.case: r for r in results}
    runs = {n: found.get(c) for n, c in cases.items()}
    report, figures = Report(), Figures(runner, "ouyang2017")
    report.text("# Ouyang et al. (2017): measured beside published",
                f"Made by `tools/validate ouyang2017` from the workflows in `workflows/ouyang2017`{f', variant `{small}`' if small else ''}, which hold the paper's inputs. "
                "Specimens A to E are five packings (seeds 1 to 5) by a method of our own, not the paper's five: their means and deviations can be compared, not one with one.")
    head = len(report.lines)
    specimens(report, "Specimens (Table 1)", {s: runs[f"baseline_{s}_ucs"] for s in SPECIMENS}, TABLE_1)
    table3(report, runs)
    counts(report, runs)
    specimens(report, "Rock specimens (Table 4)", {r: runs[r + "_ucs"] for r in ROCKS}, TABLE_4, ROCKS)
    table5(report, runs)
    made(report, runs)
    report.text("## Curves and cracks")
    figures.load_displacement(report, runs["baseline_a_ucs"], runs["baseline_a_tension"])
    for number, name, title in [("Fig. 8", "baseline_a", "specimen A"), ("Fig. 15", "lac_du_bonnet", ROCKS["lac_du_bonnet"]), ("Fig. 17", "quartzite", ROCKS["quartzite"])]:
        size = 360 if number == "Fig. 8" else 430
        if number != "Fig. 8":
            figures.rock(report, {"Fig. 15": "Fig. 14", "Fig. 17": "Fig. 16"}[number], name, title, runs[name + "_ucs"], runs[name + "_tension"])
        figures.cracks(report, number, f"{title} in compression", runs[name + "_ucs"], name + "_ucs", (1e-4,) if name == "baseline_a" else (1e-4, 2e-4), size)
        figures.cracks(report, number, f"{title} in tension", runs[name + "_tension"], name + "_tension", (4e-5,), size)
    if not small:
        trends(report, figures, studies)
        tally = all_published(report, cases, found, studies)
    new_results(report, figures, runner, runs, found)
    if not small:
        study.tables(report, found, plain)
        reading.table_packings(report, ROCKS, {r: in_order_of_table_3(t[1]) for r, t in TABLE_5.items()}, cases, found, NAMES)
        materials = {"specimen A": "baseline_a_tension"} | {title: f"{r}_tension" for r, title in ROCKS.items()}
        study.network(report, {m: runs[n] for m, n in materials.items()}, {m: found.get(reading.INFERRED.case(n, cases)) for m, n in materials.items()})
        report.text(tally.fill((runner.root / "python/validation/ouyang2017_discussion.md").read_text()))
    report.finish(runner, "ouyang2017", head, SHOWN)


def specimens(report, heading, runs, published, names=None):
    present = {k: r for k, r in runs.items() if r}
    report.text(f"## {heading}", "Measured, and the paper's in brackets." if present else "Not measured.")
    rows, columns = [], []
    for key, run in present.items():
        values = [run.get("packing.radius_mean.got") * 1e3, run.get("particles"), run.get("bonds"), run.get("porosity") * 100]
        columns.append(values)
        cells = [f"{v:.{d}f} ({p:.{d}f})" for v, p, d in zip(values, published[key], (3, 0, 0, 2))]
        overlap = run.get("packing.max_overlap.got")
        rows.append([names[key] if names else key.upper(), *cells, f"{2 * values[2] / values[1]:.3f} ({2 * published[key][2] / published[key][1]:.3f})", f"{overlap:.0e}"])
    if not names and len(present) > 1:
        papers = list(zip(*published.values()))
        cells = [f"{mean(v):.{d}f} ± {spread(v):.{d}f} ({mean(p):.{d}f} ± {spread(p):.{d}f})" for v, p, d in zip(zip(*columns), papers, (3, 0, 0, 2))]
        per = [[2 * v[2] / v[1] for v in t] for t in (columns, published.values())]
        rows.append(["mean", *cells, f"{mean(per[0]):.3f} ({mean(per[1]):.3f})", ""])
    if rows:
        report.table(["", "mean radius [mm]", "particles", "bonds", "porosity [%]", "bonds per particle", "largest overlap ratio"], rows)


def properties(compression, tension):
    """A row of Table 3."""
    def value(run, key, unit):
        number = run.get(key)
        return float("nan") if number is None else number / unit
    ec, et, nuc, nut, ucs, ts = (value(r, k, u) for k, u in (("youngs_modulus_Pa", 1e9), ("poisson_ratio", 1), ("peak_stress_Pa", 1e6)) for r in (compression, tension))
    return (ec, et, nuc, nut, ucs, ts, ucs / ts, ec / et, nuc / nut)


def in_order_of_table_3(row):
    """A row of Table 5; None where it has no number."""
    values = [None] * len(NAMES)
    for k, v in zip(ORDER_5, row):
        values[k] = v
    return values


def table3(report, runs):
    pairs = {s: (runs[f"baseline_{s}_ucs"], runs[f"baseline_{s}_tension"]) for s in SPECIMENS}
    rows = {s: properties(*p) for s, p in pairs.items() if all(p)}
    report.text("## Baseline (Table 3)", "Measured, and the paper's in brackets." if rows else "Not measured.")
    if not rows:
        return
    report.table(["", *NAMES], [[s.upper(), *(f"{v:.{d}f} ({p:.{d}f})" for v, p, d in zip(r, TABLE_3[s], DIGITS))] for s, r in rows.items()])
    lines = []
    for k, (name, published, deviation, share) in enumerate(zip(NAMES, MEANS, DEVIATIONS, SHARES)):
        values, d = [r[k] for r in rows.values()], DIGITS[k]
        away, ratio = mean(values) / published - 1, name in ("nu_c", "nu_t")
        off = abs(mean(values) - published)
        allowed = f"{RATIO}" if ratio else f"{share:.0%}" if share else ""
        met = off <= RATIO if ratio else abs(away) <= share if share else None
        distance = f"{mean(values) - published:+.3f}" if ratio else f"{away:+.1%}"
        lines.append([name, f"{mean(values):.{d + 1}f} ± {spread(values):.{d + 1}f}", f"{published:.{d}f} ± {deviation}", distance, allowed, {True: "yes", False: "**no**", None: ""}[met]])
        if met is False:
            report.missed.append(f"baseline, {name}: {mean(values):.{d}f}, paper {published:.{d}f}, {distance} (asked: within {allowed})")
    report.table([f"mean of {len(rows)}", "measured", "paper", "distance", "asked within", ""], lines)
    scatter = max(spread([r[k] for r in rows.values()]) / mean([r[k] for r in rows.values()]) for k in range(9))
    report.text(f"The largest deviation over a mean is {scatter:.2f}; the paper's is 0.15.")


def broken(run, steps):
    """At the peak, and so many of the paper's steps of 10 ns later."""
    at = run.curve("time_s")[peak(run)]
    return broken_at(run, at), broken_at(run, at + steps * 1e-8)


def counts(report, runs):
    report.text("## Broken bonds of specimen A", "Steps after the peak are the paper's, of 10 ns: 0.1 ms and 40 us.")
    rows = []
    for name, (text, steps, published) in BROKEN.items():
        run = runs[name]
        if run:
            after = run.curve("time_s")[-1] - run.curve("time_s")[peak(run)]
            tension, shear = (int(run.get(f"bonds_broken_{m}") or 0) for m in ("tension", "shear"))
            at_peak, later = broken(run, steps)
            rows.append([text, at_peak, published[0], f"{later}" + (f" (run ends {1e3 * after:.3f} ms after the peak)" if after < steps * 1e-8 else ""), published[1],
                         f"{tension / max(1, tension + shear):.0%}"])
    report.table(["", "at the peak", "paper", "after 10000 steps (tension: 4000)", "paper", "share broken in tension, end of the run"], rows)


def table5(report, runs):
    report.text("## Rocks (Table 5)")
    rows = []
    for rock, title in ROCKS.items():
        pair = runs[rock + "_ucs"], runs[rock + "_tension"]
        if not all(pair):
            rows.append([title, "not measured"] + [""] * 5)
            continue
        measured = properties(*pair)
        for k, experiment, model in zip(ORDER_5, *TABLE_5[rock]):
            away = measured[k] / model - 1
            rows.append([title, NAMES[k], f"{measured[k]:.{DIGITS[k] + 1}f}", f"{model:.{DIGITS[k]}f}", f"{experiment:.{DIGITS[k]}f}", f"{away:+.1%}", "yes" if abs(away) <= ROCK else "**no**"])
            if abs(away) > ROCK:
                report.missed.append(f"{title}, {NAMES[k]}: {measured[k]:.{DIGITS[k]}f}, paper's model {model:.{DIGITS[k]}f}, {away:+.1%} (asked: within {ROCK:.0%})")
    report.table(["", "", "measured", "paper's model", "experiment", "distance from the model", f"within {ROCK:.0%}"], rows)


def all_published(report, cases, found, studies):
    """Each value that the paper gives beside all readings; returns them."""
    def of(r, name):
        return found.get(r.case(name, cases))
    tally, readings = reading.Tally(), reading.READINGS

    def row(r, workflows):
        pairs = [(of(r, w + "_ucs"), of(r, w + "_tension")) for w in workflows]
        return [mean(v) for v in zip(*(properties(*p) for p in pairs))] if all(map(all, pairs)) else [None] * len(NAMES)
    tables = {"baseline": ("Table 3, means", MEANS)} | {r: (f"Table 5, {title}", in_order_of_table_3(TABLE_5[r][1])) for r, title in ROCKS.items()}
    for material, (source, published) in tables.items():
        measured = [row(r, reading.specimens_of(material, SPECIMENS)) for r in readings]
        for k, paper in enumerate(published):
            if paper is not None:
                tally.add(source, NAMES[k], paper, DIGITS[k], [m[k] for m in measured])
    for name, (text, steps, published) in BROKEN.items():
        measured = [broken(of(r, name), steps) if of(r, name) else (None, None) for r in readings]
        for k, when in enumerate(("at the peak", f"{steps} steps later")):
            tally.add("Broken bonds", f"{text}, {when}", published[k], 0, [m[k] for m in measured])
    for lines in zip(*(stated(studies[r]) for r in readings)):
        tally.add(*lines[0][:4], [line[4] for line in lines])
    tally.write(report)
    return tally


def made(report, runs):
    report.text("## The runs", "One thread each. Asked of a two-dimensional case: at most 60 s on two cores. Wall times are of a machine that was shared with other work, "
                "and with frames written where there are pictures. The error of the energy balance is a share of the work done.")
    rows = []
    for name, run in runs.items():
        if run:
            seconds = run.get("wall_time_s")
            error = run.get("energy_error")
            rows.append([f"`{name}`", run.get("particles"), run.get("bonds"), run.get("steps"), f"{run.get('time_step_s') * 1e9:.1f}", f"{seconds:.0f}",
                         f"{run.get('ns_per_bond_step'):.0f}", "" if error is None else f"{error:.0e}"])
    report.table(["", "particles", "bonds", "steps", "time step [ns]", "wall time [s]", "ns per bond and step", "energy error"], rows)


def new_results(report, figures, runner, runs, found):
    report.text("## New: spheres, confinement, the Brazilian test, size", "The paper names these as work to come: there are no numbers to compare with. What was found is said in the discussion.")
    report.text("### Spheres")
    pair = runs["baseline_3d_ucs"], runs["baseline_3d_tension"]
    if all(pair):
        cells = [f"{v:.{d}f}" for v, d in zip(properties(*pair), DIGITS)]
        report.table(["", "particles", "bonds per particle", *NAMES], [["spheres", pair[0].get("particles"), f"{pair[0].get('coordination_number'):.2f}", *cells]])
        figures.cracks(report, "Spheres", "compression", pair[0], "baseline_3d_ucs", ())
        figures.cracks(report, "Spheres", "tension", pair[1], "baseline_3d_tension", (4e-5,))
    else:
        report.text("Not measured.")
    report.text("### Biaxial compression of specimen A")
    confined = study.confinement(report, found, runs["baseline_a_ucs"], runs["baseline_biaxial"])
    if confined:
        labels = [f"{p} MPa" for p, _ in confined]
        figures.curves(report, "Biaxial", "axial stress against axial strain at four confining pressures", [r for _, r in confined], labels, "biaxial", "platen_strain", "platen_stress")
        figures.envelope(report, [runs["baseline_a_tension"], runs["baseline_brazilian"], *(r for _, r in confined)], ["direct tension", "Brazilian", *labels])
        figures.cracks(report, "Biaxial", "specimen A at 20 MPa of confinement", runs["baseline_biaxial"], "baseline_biaxial", (1e-4,))
    else:
        report.text("Not measured.")
    report.text("### Brazilian test")
    run = runs["baseline_brazilian"]
    if run:
        strength = run.get("brazilian_tensile_strength_Pa")
        direct = [r.get("peak_stress_Pa") for r in (runs[f"baseline_{s}_tension"] for s in SPECIMENS) if r]
        report.text(f"Disc of 50 mm, {run.get('particles')} particles: splitting strength " + (f"{strength / 1e6:.1f} MPa" if strength else "not reached")
                    + (f"; direct tension of the squares {mean(direct) / 1e6:.1f} ± {spread(direct) / 1e6:.1f} MPa." if direct else "."))
        figures.curves(report, "Brazilian test", "tensile stress 2P/(pi D t) against the approach of the platens over the diameter", [run], ["disc of 50 mm"], "brazilian", "diametral_strain", "tensile_stress")
        figures.cracks(report, "Brazilian test", "disc of 50 mm", run, "baseline_brazilian", (1e-4,))
    else:
        report.text("Not measured.")
    report.text("### Size of the particles")
    size_effect(report, figures, [] if runner.variant else runner.sweep("ouyang2017/size_effect", 18))


def size_effect(report, figures, rows):
    groups = {}
    for row in rows:
        groups.setdefault(row.inputs["packing.radius_max_m"], {}).setdefault(row.workflow, []).append(row.values)
    lines = []
    for radius, tests in sorted(groups.items()):
        cells = [f"{radius * 1e3:g}", len(tests.get("ucs", []))]
        for test, key, unit, digits in [("ucs", "particles", 1, 0), ("ucs", "youngs_modulus_Pa", 1e9, 2), ("ucs", "poisson_ratio", 1, 3), ("ucs", "peak_stress_Pa", 1e6, 0),
                                        ("tension", "youngs_modulus_Pa", 1e9, 2), ("tension", "peak_stress_Pa", 1e6, 2)]:
            values = [r[key] / unit for r in tests.get(test, []) if not math.isnan(r[key])]
            cells.append(f"{mean(values):.{digits}f} ± {spread(values):.{digits}f}" if values else "")
        lines.append(cells)
    if not lines:
        report.text("Not measured.")
        return
    report.table(["R_max [mm]", "packings", "particles", "Ec [GPa]", "nu_c", "UCS [MPa]", "Et [GPa]", "TS [MPa]"], lines)
    figures.study(report, "size_effect", "Size effect", "specimens of 50 mm, three packings each", ["UCS", "TS", "UCS_over_TS", "Ec"])
