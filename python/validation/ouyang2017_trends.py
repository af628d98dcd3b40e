# SPDX-License-Identifier: BSD-3-Clause
"""Figures 9 to 13 of Ouyang et al. (2017): every trend that the paper states, each with a number that decides."""
from .report import kept
from .runs import mean

RATIO, BENDING, SHAPE, WIDTH, SHEAR = ("contact_law." + p for p in ("shear_stiffness_ratio", "bending_ratio", "tension_shape", "bond_width", "shear_strain_ratio"))
STUDIES = {  # name: (abscissa, series, cases, figures, charts)
    "study_ks_kn": (RATIO, BENDING, 60, "Fig. 9", ["Ec", "nu_c", "UCS", "TS", "UCS_over_TS", "Ec_over_Et"]),
    "study_b": (SHAPE, RATIO, 48, "Figs 10 and 11", ["UCS", "TS", "UCS_over_TS", "Ec", "Et", "Ec_over_Et", "nu_c", "nu_t", "nu_c_over_nu_t"]),
    "study_w": (WIDTH, RATIO, 30, "Fig. 12", ["Ec", "Ec_over_Et", "nu_c", "nu_c_over_nu_t", "UCS", "UCS_over_TS"]),
    "study_shear_strain": (SHEAR, RATIO, 36, "Fig. 13", ["UCS", "TS", "Ec", "Et", "nu_c", "nu_t"]),
}
# Abscissae without which nothing can be said.
NEEDED = {"study_ks_kn": (0.1, 0.5, 1.0), "study_b": (0.05, 0.7, 1.0), "study_w": (0.4, 0.8), "study_shear_strain": (2.0, 4.5)}
TEXTS = {"study_ks_kn": "ks/kn at three km/(kn R)", "study_b": "b at three ks/kn", "study_w": "w at three ks/kn", "study_shear_strain": "eps_s0/eps_n0 at three ks/kn"}


class Study:
    """values[quantity][series] = [(x, value), ...], of the abscissae where both tests have finished for every series."""

    def __init__(self, name, rows):
        self.name, (self.x, self.series, self.expected, self.figures, self.charts) = name, STUDIES[name]
        points = {}
        for row in rows:
            points.setdefault((row.inputs[self.series], row.inputs[self.x]), {})[row.workflow] = row.values
        points = {key: tests for key, tests in points.items() if len(tests) == 2}
        wanted = {s for s, _ in points}
        self.at_x = sorted(x for x in {x for _, x in points} if len(wanted) == 3 and all((s, x) in points for s in wanted))
        self.complete = 2 * len(points) == self.expected
        self.decides = set(NEEDED[name]) <= set(self.at_x)
        self.values = {}
        for (series, x), tests in sorted(points.items()):
            if x in self.at_x:
                for quantity, value in self._quantities(tests["ucs"], tests["tension"]).items():
                    self.values.setdefault(quantity, {}).setdefault(series, []).append((x, value))

    @staticmethod
    def _quantities(ucs, tension):
        q = {"UCS": ucs["peak_stress_Pa"] / 1e6, "TS": tension["peak_stress_Pa"] / 1e6, "Ec": ucs["youngs_modulus_Pa"] / 1e9,
             "Et": tension["youngs_modulus_Pa"] / 1e9, "nu_c": ucs["poisson_ratio"], "nu_t": tension["poisson_ratio"]}
        return q | {"UCS/TS": q["UCS"] / q["TS"], "Ec/Et": q["Ec"] / q["Et"], "nu_c/nu_t": q["nu_c"] / q["nu_t"]}

    def at(self, quantity, x):
        return {s: dict(line)[x] for s, line in self.values[quantity].items()}

    def lines(self, quantity):
        return {s: [v for _, v in line] for s, line in self.values[quantity].items()}

    def all(self, quantity):
        return [v for line in self.lines(quantity).values() for v in line]


def rises(line, by=0.0, tolerance=0.0):
    """The last exceeds the first by this share, and no step falls by more than the tolerance."""
    return line[-1] > line[0] * (1 + by) and all(b >= a * (1 - tolerance) for a, b in zip(line, line[1:]))


def falls(line, by=0.0, tolerance=0.0):
    return line[-1] < line[0] * (1 - by) and all(b <= a * (1 + tolerance) for a, b in zip(line, line[1:]))


def width(line):
    return max(line) / min(line) - 1


def ends(lines, digits):
    return "; ".join(f"{s:g}: {line[0]:.{digits}f} to {line[-1]:.{digits}f}" for s, line in lines.items())


def widths(lines):
    return "; ".join(f"{s:g}: {width(line):.1%}" for s, line in lines.items())


def spans(lines, digits):
    return "; ".join(f"{s:g}: {max(line) - min(line):.{digits}f}" for s, line in lines.items())


def every(lines, test, *arguments):
    return all(test(line, *arguments) for line in lines.values())


def ks_kn(s):
    ec, nu = s.lines("Ec"), s.lines("nu_c")
    yield "Ec rises with ks/kn", "every step up", ends(ec, 1) + " GPa", every(ec, rises)
    yield "nu_c falls with ks/kn", "every step down", ends(nu, 2), every(nu, lambda line: all(b < a for a, b in zip(line, line[1:])))
    yield "... from 0.45", "at ks/kn = 0.1 within 0.05", ends(nu, 2), every(nu, lambda line: abs(line[0] - 0.45) <= 0.05)
    yield "... to 0", "at ks/kn = 1 within 0.05", ends(nu, 2), every(nu, lambda line: abs(line[-1]) <= 0.05)
    across = list(zip(*ec.values()))
    yield "bending leaves Ec alone", "at every ks/kn at most 5 % between the three", f"at most {max(map(width, across)):.1%}", max(map(width, across)) <= 0.05
    across = [max(v) - min(v) for v in zip(*nu.values())]
    yield "bending leaves nu_c alone", "at every ks/kn at most 0.03 between the three", f"at most {max(across):.3f}", max(across) <= 0.03
    for q in ("UCS", "TS", "UCS/TS"):
        lines, xs = s.lines(q), [x for x, _ in next(iter(s.values[q].values()))]
        low, high = lines[min(lines)], lines[max(lines)]
        gain = [b / a - 1 for x, a, b in zip(xs, low, high) if x > 0.45]
        yield (f"bending raises {q} where ks/kn > 0.4", "km/(kn R) = 0.256 above 0.064 at every ks/kn from 0.5 on",
               f"{min(gain):+.1%} to {max(gain):+.1%}", min(gain) > 0)
    yield "Ec/Et hardly depends on either", "all 30 points within 10 % of each other", f"{width(s.all('Ec/Et')):.1%}", width(s.all("Ec/Et")) <= 0.10


def shape(s):
    ts, ucs, quotient, moduli, ratios = (s.lines(q) for q in ("TS", "UCS", "UCS/TS", "Ec/Et", "nu_c/nu_t"))
    yield "TS rises with b", "by half at least from 0.05 to 1, no step down by more than 3 %", ends(ts, 1) + " MPa", every(ts, rises, 0.5, 0.03)
    yield "UCS almost unchanged", "at most 10 % between all b", widths(ucs), every(ucs, lambda line: width(line) <= 0.10)
    yield "UCS/TS falls with b", "by a third at least, no step up by more than 3 %", ends(quotient, 1), every(quotient, falls, 1 / 3, 0.03)
    top = max(s.all("UCS/TS"))
    yield "UCS/TS up to 45 at b = 0.05", "largest of all within 20 % of 45, at b = 0.05", f"{top:.1f}", abs(top / 45 - 1) <= 0.2 and top in s.at("UCS/TS", 0.05).values()
    yield "Ec/Et falls with b", "every step down", ends(moduli, 2), every(moduli, falls)
    yield "... from 1.6", "at b = 0.05 within 0.15 at every ks/kn", ends(moduli, 2), all(abs(v - 1.6) <= 0.15 for v in s.at("Ec/Et", 0.05).values())
    yield "... to 1.05", "at b = 1 within 0.05 at every ks/kn", ends(moduli, 2), all(abs(v - 1.05) <= 0.05 for v in s.at("Ec/Et", 1.0).values())
    yield "nu_c falls with b", "lower at 1 than at 0.05", ends(s.lines("nu_c"), 3), every(s.lines("nu_c"), lambda line: line[-1] < line[0])
    yield "nu_t rises with b", "higher at 1 than at 0.05", ends(s.lines("nu_t"), 3), every(s.lines("nu_t"), lambda line: line[-1] > line[0])
    yield "nu_c/nu_t falls with b", "lower at 1 than at 0.05", ends(ratios, 2), every(ratios, lambda line: line[-1] < line[0])
    top = max(s.all("nu_c/nu_t"))
    yield "nu_c/nu_t up to 4.5 at b = 0.05", "largest of all within 20 % of 4.5, at b = 0.05", f"{top:.2f}", abs(top / 4.5 - 1) <= 0.2 and top in s.at("nu_c/nu_t", 0.05).values()
    for q in ("TS", "UCS/TS", "Ec/Et"):
        late = {k: s.at(q, 1.0)[k] / s.at(q, 0.7)[k] - 1 for k in s.at(q, 1.0)}
        yield f"{q} flat beyond b = 0.7", "at most 10 % from 0.7 to 1", "; ".join(f"{k:g}: {v:+.1%}" for k, v in late.items()), max(map(abs, late.values())) <= 0.10


def bond_width(s):
    ucs, ts, ec, nu = (s.lines(q) for q in ("UCS", "TS", "Ec", "nu_c"))
    yield "UCS falls with w", "lower at 0.8 than at 0.4, no step up by more than 3 %", ends(ucs, 0) + " MPa", every(ucs, falls, 0, 0.03)
    yield "TS unchanged", "at most 5 % between all w", widths(ts), every(ts, lambda line: width(line) <= 0.05)
    yield "Ec unchanged", "at most 3 %", widths(ec), every(ec, lambda line: width(line) <= 0.03)
    yield "nu_c unchanged", "at most 0.03", spans(nu, 3), every(nu, lambda line: max(line) - min(line) <= 0.03)


def shear_strain(s):
    ucs, ts, et, nu = (s.lines(q) for q in ("UCS", "TS", "Et", "nu_t"))
    yield "UCS rises by more than 50 %", "from 2.0 to 4.5, at every ks/kn", "; ".join(f"{k:g}: {v[-1] / v[0] - 1:+.0%}" for k, v in ucs.items()), every(ucs, rises, 0.5, 0.03)
    yield "TS unchanged", "at most 5 % between all", widths(ts), every(ts, lambda line: width(line) <= 0.05)
    yield "Et unchanged", "at most 3 %", widths(et), every(et, lambda line: width(line) <= 0.03)
    yield "nu_t unchanged", "at most 0.03", spans(nu, 3), every(nu, lambda line: max(line) - min(line) <= 0.03)


CHECKS = {"study_ks_kn": ks_kn, "study_b": shape, "study_w": bond_width, "study_shear_strain": shear_strain}
SPANS = [("UCS/TS", 5, 45, 1), ("Ec/Et", 1.05, 1.6, 2)]
SHORT = {"study_b": ["UCS_over_TS", "Ec_over_Et", "nu_c"], "study_ks_kn": ["nu_c", "UCS_over_TS"]}   # charts of other readings than the first


def studies_of(runner, reading):
    fixed = [tuple(s.split("=", 1)) for s in reading.settings]
    return {name: Study(name, runner.sweep(f"ouyang2017/{name}", STUDIES[name][2], reading.study_label, reading.variant, fixed)) for name in STUDIES}


def checked(studies):
    """[(study, what the paper says, criterion, measured, "kept")] of what can be said."""
    rows = [(name, *line[:3], kept(line[3])) for name, check in CHECKS.items() if studies[name].decides for line in check(studies[name])]
    present = [s for s in studies.values() if s.values]
    for q, low, high, digits in SPANS:
        values = [v for s in present for v in s.all(q)]
        if values:
            holds, whole = min(values) <= 1.1 * low and max(values) >= 0.9 * high, all(s.decides for s in studies.values())
            rows.append(("all", f"{q} spans {low} to {high}", "least and greatest of all points within 10 % of the bounds, or beyond",
                         f"{min(values):.{digits}f} to {max(values):.{digits}f} in {len(values)} points", kept(holds) if holds or whole else "open"))
    return rows


def trends(report, figures, studies):
    """`studies`: {reading: its studies}. What the first reading does not keep is a target missed."""
    readings = list(studies)
    report.text("## Trends (Figs 9 to 13)", "On specimen A, one packing. The paper shows its curves as pictures; checked is what its text says. The criterion is our "
                "reading of the words. In the columns of what was measured the number before the colon is the series: km/(kn R) of Fig. 9, ks/kn of the others.")
    lines, kept_by = {}, {r: [0, 0] for r in readings}
    for k, reading in enumerate(readings):
        for name, text, criterion, measured, verdict in checked(studies[reading]):
            number = STUDIES[name][3] if name in STUDIES else "all"
            lines.setdefault((number, text, criterion), {})[reading] = [measured, verdict]
            kept_by[reading][0] += verdict == "kept"
            kept_by[reading][1] += 1
            if k == 0 and verdict == kept(False):
                report.missed.append(f"{number}, {text} ({criterion}): {measured}")
    report.table(["figure", "the paper", "criterion", *(c for r in readings for c in (r.title, ""))],
                 [[*head, *(c for r in readings for c in of_reading.get(r, ["not measured", ""]))] for head, of_reading in lines.items()])
    report.text("Kept: " + "; ".join(f"{r.title}: {n} of {m}" for r, (n, m) in kept_by.items()) + ".")
    parts = [f"{r.title}: " + "; ".join(some) for r, of_reading in studies.items()
             if (some := [f"{TEXTS[s.name]} at {', '.join(f'{x:g}' for x in s.at_x)}" for s in of_reading.values() if s.values and not s.complete])]
    if parts:
        report.text("**Of a part of the points only**, those without which nothing could be said.", "\n".join(f"- {p}" for p in parts))
    for k, (r, of_reading) in enumerate(studies.items()):
        for name, s in of_reading.items():
            charts = s.charts if k == 0 else SHORT.get(name, []) if k == 1 else []
            figures.study(report, "_".join(filter(None, [name, r.study_label])), s.figures,
                          "specimen A: " + TEXTS[name] + (f", {r.title}" if k else "") + ("" if s.complete else ", of the points that are finished"), charts)


def stated(studies):
    """The numbers that the text gives for Figs 9 to 11: [(figure, quantity, paper, digits, measured or None)]."""
    ks, b = studies["study_ks_kn"], studies["study_b"]

    def of(study, quantity, x, how):
        return how(list(study.at(quantity, x).values())) if study.values and x in study.at_x else None
    return [("Fig. 9", "nu_c at ks/kn = 0.1", 0.45, 2, of(ks, "nu_c", 0.1, mean)), ("Fig. 9", "nu_c at ks/kn = 1", 0.0, 2, of(ks, "nu_c", 1.0, mean)),
            ("Fig. 10", "UCS/TS at b = 0.05, largest", 45, 1, of(b, "UCS/TS", 0.05, max)), ("Fig. 11", "Ec/Et at b = 0.05", 1.6, 2, of(b, "Ec/Et", 0.05, mean)),
            ("Fig. 11", "Ec/Et at b = 1", 1.05, 2, of(b, "Ec/Et", 1.0, mean)), ("Fig. 11", "nu_c/nu_t at b = 0.05, largest", 4.5, 2, of(b, "nu_c/nu_t", 0.05, max))]
