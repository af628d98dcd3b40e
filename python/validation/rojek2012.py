# SPDX-License-Identifier: BSD-3-Clause
"""Rojek et al. (2012): ten workflows, every table and figure, and the experiments that explain the differences."""
from .figures import Drawing
from .report import Report, kept
from .rojek2012_experiments import experiments
from .runs import Case, mean

MODELS = ["1", "2", "3a", "3b", "3c"]
TABLES = {"1": ("4 and 5", "2", "A.1"), "2": ("6 and 7", "3", "A.2")}
TARGETS = {"1": (0.05, 0.08, 0.10), "2": (0.08, 0.08, 0.15)}   # E, Poisson's ratio, strength
SHOWN = ["*_stress_strain.png", "*_global_damage.png"]   # of its pictures, in docs
QUANTITIES = [("particle_radius", "r", "m"), ("pair_arithmetic_mean_radius", "arithmetic mean", "m"),
              ("pair_harmonic_mean_radius", "harmonic mean", "m"), ("pair_minimum_radius", "minimum", "m"),
              ("particle_radius_squared", "r²", "m2"), ("pair_arithmetic_mean_radius_squared", "arithmetic mean²", "m2"),
              ("pair_minimum_radius_squared", "minimum²", "m2")]


def validate(runner, seeds):
    cases = [Case(f"rojek2012/specimen{s}_model{m}", seed, pictures=seed == seeds[0])
             for s in "21" for seed in seeds for m in MODELS]   # the long ones first
    results = runner.run(cases)
    runs = {(s, m): [r for r in results if r.case.workflow == f"rojek2012/specimen{s}_model{m}"] for s in "12" for m in MODELS}
    report = Report()
    report.text("# Rojek et al. (2012): measured beside published",
                f"Made by `tools/validate rojek2012` from the ten workflows in `workflows/rojek2012`, seeds {', '.join(map(str, seeds))}: "
                "mean ± sample standard deviation over the seeds. The workflows hold the paper's inputs. Where the paper is "
                "silent, three settings were chosen with its tables in view, by the arguments at the end: which pairs are "
                "bonded, how alike neighbours of specimen 1 are in size (both from Tables A.1 and A.2), and how much of "
                "the outline the strain counts. Nothing else is fitted. Every seed packs a specimen of its own; the paper had one of each.")
    head = len(report.lines)
    for s in "12":
        results_tables(report, runs, s)
        parameters(report, runs, s)
    for s in "12":
        specimen(report, runs, s)
        statistics(report, runs, s)
    observed(report, runs)
    figures(report, runner, runs)
    experiments(report, runner, seeds[0])
    report.text((runner.root / "python/validation/rojek2012_discussion.md").read_text())
    report.finish(runner, "rojek2012", head, SHOWN)


def values(runs, key):
    return [r.get(key) for r in runs]


def results_tables(report, runs, s):
    report.text(f"## Specimen {s}: elastic constants and strength (Tables {TABLES[s][0]})")
    rows = []
    for m in MODELS:
        for (what, key, unit, digits), target in zip(
                [("Young's modulus [GPa]", "youngs_modulus_Pa", 1e9, 2), ("Poisson's ratio", "poisson_ratio", 1, 4),
                 ("uniaxial compressive strength [MPa]", "peak_stress_Pa", 1e6, 1)], TARGETS[s]):
            these = runs[s, m]
            rows.append([m] + report.compared(what, values(these, key), these[0].reference[key], unit, digits, target))
            if report.missed and report.missed[-1].startswith(what):
                report.missed[-1] = f"specimen {s}, model {m}: " + report.missed[-1]
    e, nu, ucs = TARGETS[s]
    report.table(["model", "", "measured", "paper", "distance", f"within {e:.0%}, {nu:.0%}, {ucs:.0%}"], rows)


def parameters(report, runs, s):
    report.text(f"### Uniform parameters of models 3a-3c, from the measured statistics (Table {TABLES[s][1]})")
    rows = []
    for m in MODELS[2:]:
        these = runs[s, m]
        for what, key, unit in [("normal stiffness [MN/m]", "normal_stiffness_N_m", 1e6),
                                ("bond strength, tension and shear [N]", "bond_tensile_strength_N", 1)]:
            rows.append([m] + report.compared(what, values(these, "elastic_brittle." + key),
                                              these[0].reference["elastic_brittle"][key], unit, 3)[:4])
    report.table(["model", "", "measured", "paper", "distance"], rows)


def specimen(report, runs, s):
    report.text(f"## Specimen {s}: packing (section 5.1.{s})")
    these = runs[s, "1"]
    ref = these[0].reference
    rows = [report.compared("particles", values(these, "particles"), {"1": 10225, "2": 5868}[s], digits=0)[:4]]
    for what, key, digits in [("bonds", "bonds", 0), ("coordination number", "coordination_number", 3),
                              ("porosity, overlaps counted twice", "porosity", 4)]:
        rows.append(report.compared(what, values(these, key), ref[key], digits=digits)[:4])
    for k, axis in enumerate("xyz"):
        rows.append(report.compared(f"fabric tensor, {axis}{axis}", [r.get("fabric_diagonal")[k] for r in these],
                                    ref["fabric_diagonal"][k], digits=5)[:4])
    rows.append(report.compared("largest gap of a bond [mm]", values(these, "bond_gap_m"), float("nan"), 1e-3, 3)[:2] + ["not given", ""])
    report.table(["", "measured", "paper", "distance"], rows)


def statistics(report, runs, s):
    report.text(f"### Statistics of radii and bonded pairs, measured (paper) (Table {TABLES[s][2]}), lengths in mm")
    these = runs[s, "1"]
    rows = []
    for row, key in [("mean", "mean_{}"), ("median", "median_{}"), ("standard deviation", "std_{}"), ("skewness", "skewness"),
                     ("kurtosis", "kurtosis"), ("minimum", "min_{}"), ("maximum", "max_{}")]:
        cells = []
        for name, symbol, unit in QUANTITIES:
            scale = {"m": 1e3, "m2": 1e6}[unit] if "{}" in key else 1
            path = f"statistics.{name}.{key.format(unit)}"
            got = mean(values(these, path)) * scale
            want = these[0].reference["statistics"][name][key.format(unit)] * scale
            cells.append(f"{got:.4f} ({want:.4f})")
            if row in ("mean", "standard deviation") and abs(got / want - 1) > 0.03:
                cells[-1] = f"**{cells[-1]}**"
                report.missed.append(f"specimen {s}, {row} of {symbol}: {got / want - 1:+.1%} (asked: within 3%)")
        rows.append([row] + cells)
    report.table([""] + [symbol for _, symbol, _ in QUANTITIES], rows)
    report.text("Bold: a mean or standard deviation more than 3 % away.")


def observed(report, runs):
    report.text("## What the paper observes", "Means over the seeds; the paper's own values in brackets.")

    def average(s, m, key):
        return mean(values(runs[s, m], key))

    def order(s, models, key, unit, digits):
        wanted = sorted(models, key=lambda m: -runs[s, m][0].reference[key])
        got = [average(s, m, key) for m in wanted]
        text = " > ".join(f"{m}: {g / unit:.{digits}f} ({runs[s, m][0].reference[key] / unit:.{digits}f})" for m, g in zip(wanted, got))
        return text, all(a > b for a, b in zip(got, got[1:]))

    rows = []
    for s in "12":
        for what, key, unit, digits in [("strength [MPa]", "peak_stress_Pa", 1e6, 0), ("Young's modulus [GPa]", "youngs_modulus_Pa", 1e9, 2)]:
            for group in (["1", "2"], ["3a", "3b", "3c"], MODELS):
                text, holds = order(s, group, key, unit, digits)
                rows.append([f"specimen {s}: order of {what}, models {', '.join(group)}", text, kept(holds)])
                if not holds:
                    report.missed.append(f"specimen {s}: order of {what} of models {', '.join(group)}")

    def claim(text, measured, holds):
        rows.append([text, measured, kept(holds)])
        if not holds:
            report.missed.append("observed in the paper: " + text)

    half = {m: average("1", m, "elastic_constants.after_peak.strain_to_half_of_peak") or 0 for m in MODELS}
    peak = {m: average("1", m, "peak_strain") for m in MODELS}
    claim("specimen 1: stress drops at once after the peak in every model",
          "strain from the peak to half of it over the strain at the peak: " + ", ".join(f"{m}: {half[m] / peak[m]:.2f}" for m in MODELS),
          all(half[m] < 0.5 * peak[m] for m in MODELS))
    tension = {(s, m): average(s, m, "bonds_broken_tension") / average(s, m, "bonds_broken_shear") for s in "12" for m in MODELS}
    claim("specimen 1: slightly more bonds break in tension than in shear in every model",
          "tension over shear: " + ", ".join(f"{m}: {tension['1', m]:.2f}" for m in MODELS), all(tension["1", m] > 1 for m in MODELS))
    damage = {(s, m): average(s, m, "global_damage") for s in "12" for m in MODELS}
    for s in "12":
        claim(f"specimen {s}: model 2 has a higher global damage than model 1", f"{damage[s, '2']:.3f} against {damage[s, '1']:.3f}",
              damage[s, "2"] > damage[s, "1"])
    claim("specimen 2: in model 2 more bonds break in shear than in tension", f"tension over shear: {tension['2', '2']:.2f}", tension["2", "2"] < 1)
    claim("specimen 2: in the models 3 tension dominates", "tension over shear: " + ", ".join(f"{m}: {tension['2', m]:.2f}" for m in MODELS[2:]),
          all(tension["2", m] > 1 for m in MODELS[2:]))
    claim("specimen 2: models 3 have a low global damage, below models 1 and 2", ", ".join(f"{m}: {damage['2', m]:.3f}" for m in MODELS),
          max(damage["2", m] for m in MODELS[2:]) < min(damage["2", "1"], damage["2", "2"]))
    for s in "12":
        for a, near in (("1", "3b"), ("2", "3c")):
            def away(m, key):
                return abs(average(s, m, key) / average(s, a, key) - 1)
            claim(f"specimen {s}: model {near} is nearer to model {a} than 3a is (strength, modulus)",
                  f"strength {away(near, 'peak_stress_Pa'):.1%} and {away('3a', 'peak_stress_Pa'):.1%}, "
                  f"modulus {away(near, 'youngs_modulus_Pa'):.1%} and {away('3a', 'youngs_modulus_Pa'):.1%}",
                  away(near, "peak_stress_Pa") < away("3a", "peak_stress_Pa") and away(near, "youngs_modulus_Pa") < away("3a", "youngs_modulus_Pa"))
    report.table(["observation", "measured", ""], rows)


class Figures(Drawing):
    def pictures(self, run, show, prefix, size):
        """A function that takes some of what a run's pictures are, by their names."""
        out = self._render(run, [show], prefix, size)
        return lambda *names: self.taken(out, names, prefix)

    def charts(self, runs, models, prefix):
        """The same of a comparison."""
        out = self._compare([r.folder for r in runs], [f"model {m}" for m in models], prefix, [])
        return lambda *names: self.taken(out, names, prefix)

    def taken(self, out, names, prefix):
        return [self._take(out / f"{name}.png", f"{prefix}_{name}.png") for name in names]


def figures(report, runner, runs):
    report.text("## Figures", "All of the first seed.")
    drawing = Figures(runner, "rojek2012")

    def figure(numbers, caption, files):
        drawing._show(report, numbers, caption, files)

    def of(unit):
        return [f"histogram_{name}" for name, _, its in QUANTITIES if its == unit]

    for s, (linear, rose, squares) in {"1": ("5", "6", "7"), "2": ("8", "10", "9")}.items():
        tables = drawing.pictures(runs[s, "1"][0], {"show": "tables"}, f"specimen{s}", 600)
        figure(f"Figure {linear}", f"Specimen {s}: radii and bonded pairs", tables(*of("m")))
        figure(f"Figure {rose}", f"Specimen {s}: directions of the bonds", tables("rose_xy", "rose_yz", "rose_zx"))
        figure(f"Figure {squares}", f"Specimen {s}: squares", tables(*of("m2")))
    evolution = ["broken_shear", "broken_tension", "global_damage"]
    for s, numbers in {"1": dict(local="12", damage="13", b="15", c="16", uniform="17", failed="11 and 14"),
                       "2": dict(local="19", damage="20", b="22", c="23", uniform="24", failed="18 and 21")}.items():
        def charts(models, name):
            return drawing.charts([runs[s, m][0] for m in models], models, f"specimen{s}_{name}")
        failed = []
        for m in MODELS:
            failed += drawing.pictures(runs[s, m][0], {"show": "specimen", "low": 0, "high": 1}, f"specimen{s}_model{m}", 500)("specimen")
        figure(f"Figures {numbers['failed']}", f"Specimen {s} after failure, damage of the particles; models 1, 2, 3a, 3b, 3c", failed)
        local = charts(["1", "2"], "local")
        figure(f"Figure {numbers['local']}", f"Specimen {s}: models 1 and 2", local("stress_strain"))
        figure(f"Figure {numbers['damage']}", f"Specimen {s}: damage, models 1 and 2", local(*evolution))
        for number, others in (("b", ["1", "3a", "3b"]), ("c", ["2", "3a", "3c"])):
            figure(f"Figure {numbers[number]}", f"Specimen {s}: model {others[0]} and its uniform counterparts", charts(others, f"model{others[0]}_uniform")("stress_strain"))
        figure(f"Figure {numbers['uniform']}", f"Specimen {s}: damage, models 3a, 3b, 3c", charts(["3a", "3b", "3c"], "uniform")(*evolution))
