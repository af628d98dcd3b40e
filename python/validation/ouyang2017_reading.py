# SPDX-License-Identifier: BSD-3-Clause
"""Ouyang et al. (2017) as its equations are printed, and as its tables seem to have been made: one table of all published values, and
the two rocks in other packings.

Printed: one k_n for all bonds, secants at half the peak stress. Inferred (the workflows' variant): k_n x/R_max of a bond, x the
harmonic mean of its radii, secants at half the strain of the peak; its k_m goes with the bond's k_n, or with that of the table."""
import re
from dataclasses import dataclass

from .runs import Case, mean, spread

SEEDS = (2, 3, 4, 5)                   # of the rocks, beside the workflows' 1
TESTS = ("ucs", "tension")
WITHIN = 0.10                          # of a published value


@dataclass(frozen=True)
class Reading:
    title: str
    variant: str = ""                  # of the workflows
    settings: tuple = ()
    label: str = ""                    # of runs and studies, after the variant's name

    def case(self, name, plain, seed=None):
        """`plain`: {name: case} of the printed reading, which has the pictures."""
        if not self.variant and seed is None:
            return plain[name]
        return Case("ouyang2017/" + name, seed, self.settings, self.label, variant=self.variant)

    @property
    def study_label(self):
        return "_".join(filter(None, [self.variant, self.label]))


PRINTED = Reading("as printed")
INFERRED = Reading("inferred", "inferred")
OF_TABLE = Reading("inferred, k_m of the table", "inferred", ("contact_law.bending_of=table",), "bending_of_table")
READINGS = (PRINTED, INFERRED, OF_TABLE)


def specimens_of(material, specimens):
    return [f"baseline_{s}" for s in specimens] if material == "baseline" else [material]


def cases(specimens, rocks, plain):
    """Those of the other readings."""
    names = [f"{w}_{t}" for m in ["baseline", *rocks] for w in specimens_of(m, specimens) for t in TESTS]
    return [r.case(n, plain) for r in READINGS[1:] for n in names]


def other_packings(rocks, plain):
    """(reading, name of the workflow, case); at the paper's velocities."""
    return [(r, f"{rock}_{t}", r.case(f"{rock}_{t}", plain, s)) for r in (PRINTED, INFERRED) for rock in rocks for t in TESTS for s in SEEDS]


def table_packings(report, rocks, published, plain, found, names):
    """`published`: {rock: a row of Table 3}."""
    quantities = [("ucs", "UCS [MPa]", "peak_stress_Pa", 1e6), ("tension", "TS [MPa]", "peak_stress_Pa", 1e6),
                  ("ucs", "Ec [GPa]", "youngs_modulus_Pa", 1e9), ("tension", "Et [GPa]", "youngs_modulus_Pa", 1e9)]
    others, rows = other_packings(rocks, plain), []
    for rock, title in rocks.items():
        for test, quantity, key, unit in quantities:
            paper, cells = published[rock][names.index(quantity)], []
            for reading in (PRINTED, INFERRED):
                all_seeds = [reading.case(f"{rock}_{test}", plain), *(c for r, n, c in others if r == reading and n == f"{rock}_{test}")]
                values = [found[c].get(key) / unit for c in all_seeds if c in found]
                cells += [len(values), f"{mean(values):.1f} ± {spread(values):.1f}", f"{min(values):.1f} to {max(values):.1f}",
                          f"{mean(values) / paper - 1:+.1%}"] if values else ["", "not measured", "", ""]
            rows.append([title, quantity, f"{paper:g}", *cells])
    report.text("### Other packings of the rocks", "The paper has one specimen of each rock. Here five, seeds 1 to 5, at the paper's velocities; first as printed, then the inferred reading.")
    report.table(["", "", "the paper's model", "packings", "as printed", "range", "distance", "packings", "inferred", "range", "distance"], rows)


class Tally:
    """Every published value beside the three readings, and how many of them each comes within a tenth of."""

    def __init__(self):
        self.rows, self.near, self.measured, self.off = [], [0, 0, 0], [0, 0, 0], []
        self.values = {}               # of "source: quantity": paper, digits, one of each reading

    def add(self, source, quantity, paper, digits, values):
        """`values`: one of each reading, None where it is not measured."""
        cells, told, off = [], [], False
        self.values[f"{source}: {quantity}"] = paper, digits, values
        for k, value in enumerate(values):
            if value is None or value != value:
                cells += ["not measured", ""]
                continue
            # Of a zero, what the trends ask: within 0.05.
            near = abs(value / paper - 1) <= WITHIN if paper else abs(value) <= 0.05
            self.measured[k] += 1
            self.near[k] += near
            distance = f"{value / paper - 1:+.1%}" if paper else f"{value:+.3f}"
            cells += [f"{value:.{digits}f}", distance if near else f"**{distance}**"]
            off |= k > 0 and not near
            told.append(f"{READINGS[k].title} {value:.{digits}f} ({distance})")
        if off:
            self.off.append(f"{source}, {quantity}, paper {paper:.{digits}f}: " + "; ".join(told))
        self.rows.append([source, quantity, f"{paper:.{digits}f}", *cells])

    def write(self, report):
        report.text("## The printed equations and what the paper seems to have done",
                    "The workflows give every bond the k_n of Table 2 (6 for the rocks) and read secants at half the peak *stress*, as the text has it. Their variant `inferred` reads the tables "
                    "otherwise, in two points: k_n is that of two discs of R_max and other bonds have k_n x/R_max, x the harmonic mean of the pair's radii (`stiffness_radius: harmonic`); secants are "
                    "read at half the *strain* of the peak (`secant_of: strain`). Whether k_m = [k_m/(k_n R)] R_max k_n takes the bond's k_n (`bending_of: bond`) or the table's (`table`) is open: "
                    "both are shown. Same packings, same velocities. The values are the means of Table 3, the model of Table 5, the numbers of broken bonds, and the six numbers that the text gives for Figs "
                    "9 to 11: Ec/Et as the mean of the three series, nu_c likewise; UCS/TS and nu_c/nu_t at b = 0.05 as the largest of the three. **Bold**: farther than a tenth (of 0: than 0.05).")
        report.table(["", "", "paper", *(c for r in READINGS for c in (r.title, "distance"))], self.rows)
        report.table(["", *(r.title for r in READINGS)],
                     [[f"within {WITHIN:.0%}, of the measured"] + [f"{n} of {m}" for n, m in zip(self.near, self.measured)]])
        if self.off:
            report.text("What stays off by more than a tenth in the inferred reading, one way or the other:", "\n".join(f"- {line}" for line in self.off))

    def fill(self, text):
        """Puts measured numbers into a text: `{{inferred | Table 3, means: Ec [GPa] | x}}` is over the paper's, with `%` the distance from
        it, with `=` the number itself; the readings are printed, inferred, table."""
        def number(match):
            reading, of, form = (part.strip() for part in match[1].split("|"))
            paper, digits, values = self.values[of]
            value = values[("printed", "inferred", "table").index(reading)]
            if value is None or value != value:
                return "(not measured)"
            return {"x": lambda: f"{value / paper:.2f}", "%": lambda: f"{100 * (value / paper - 1):+.0f} %", "=": lambda: f"{value:.{digits}f}"}[form]()
        return re.sub(r"\{\{(.+?)\}\}", number, text, flags=re.DOTALL)
