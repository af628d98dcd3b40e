# SPDX-License-Identifier: BSD-3-Clause
"""Ouyang et al. (2017) once more with bonds as stiff as they are wide, and the two rocks in other packings.

Table 2 gives one k_n for all bonds, and the workflows have it so. The reading tried here: that k_n is of two discs of R_max and
others have k_n r_m/R_max, r_m the smaller radius, as a bond of breadth 2 w r_m (Fig. 3) of one material would."""
from .runs import Case, mean, spread

SEEDS = (2, 3, 4, 5)                   # of the rocks, beside the workflows' 1
SEEDS_UCS = (2, 3)
VARIANT = "by_width"                   # of the workflows
FAST = "protocol.plate_velocity=0.1 m/s"


def by_width(workflow, test):
    return Case(f"ouyang2017/{workflow}_{test}", None, variant=VARIANT)


def pairs_by_width(specimens, rocks):
    """{material: [(compression, tension), ...]}"""
    names = {"baseline": [f"baseline_{s}" for s in specimens]} | {r: [r] for r in rocks}
    return {m: [tuple(by_width(w, t) for t in ("ucs", "tension")) for w in workflows] for m, workflows in names.items()}


def other_packings(rock):
    """{test: cases}; tension ten times as fast as the workflow, which changes it little (see the table of loading rates)."""
    return {"ucs": [Case(f"ouyang2017/{rock}_ucs", s) for s in SEEDS_UCS],
            "tension": [Case(f"ouyang2017/{rock}_tension", s, (FAST,), "rate_0p1") for s in SEEDS]}


def cases(specimens, rocks):
    return [c for pairs in pairs_by_width(specimens, rocks).values() for pair in pairs for c in pair] + [
        c for r in rocks for of_test in other_packings(r).values() for c in of_test]


def table_packings(report, rocks, published, runs, found, names):
    """`published`: as for `table_by_width`."""
    rows = []
    for rock, title in rocks.items():
        others = other_packings(rock)
        for test, quantity, key, unit in [("ucs", "UCS [MPa]", "peak_stress_Pa", 1e6), ("tension", "TS [MPa]", "peak_stress_Pa", 1e6),
                                          ("ucs", "Ec [GPa]", "youngs_modulus_Pa", 1e9), ("tension", "Et [GPa]", "youngs_modulus_Pa", 1e9)]:
            own = runs[f"{rock}_{test}"]
            values = [r.get(key) / unit for r in [own, *(found.get(c) for c in others[test])] if r]
            if len(values) > 1:
                paper = published[rock][0][names.index(quantity)]
                rows.append([title, quantity, len(values), f"{mean(values):.1f} ± {spread(values):.1f}", f"{min(values):.1f} to {max(values):.1f}", f"{paper:g}", f"{mean(values) / paper - 1:+.1%}"])
    if rows:
        report.text("### Other packings of the rocks", "The paper has one specimen of each rock. Here seed 1 and others; in tension the others at 0.1 m/s.")
        report.table(["", "", "packings", "mean", "range", "the paper's model", "distance"], rows)


def table_by_width(report, specimens, rocks, published, runs, found, properties, names, digits):
    """Means of the specimens, and the rocks: constant k_n, in proportion to the width, the paper. `published`: {material: (values,
    what is asked of each)}."""
    rows = []
    for material, pairs in pairs_by_width(specimens, rocks).items():
        scaled = [properties(found[c], found[t]) for c, t in pairs if c in found and t in found]
        plain = [(runs.get(f"{w}_ucs"), runs.get(f"{w}_tension")) for w in ([f"baseline_{s}" for s in specimens] if material == "baseline" else [material])]
        plain = [properties(*p) for p in plain if all(p)]
        if not scaled or not plain:
            continue
        title = rocks.get(material, f"baseline, mean of {len(scaled)}")
        for k, (name, d, paper, asked) in enumerate(zip(names, digits, *published[material])):
            if paper is None:
                continue
            cells = [title, name, f"{paper:.{d}f}", f"{asked:.0%}" if asked else ""]
            for values in (plain, scaled):
                value = mean([v[k] for v in values])
                cells += [f"{value:.{d + 1}f}", f"{value / paper - 1:+.1%}"]
            rows.append(cells)
    if rows:
        report.text("## Another reading: bonds as stiff as they are wide",
                    "The workflows give every bond the k_n of Table 2, as the text has it. If that k_n belonged to two discs of R_max and others had k_n r_m/R_max, r_m the smaller "
                    "radius (and k_m = [k_m/(k_n R)] R_max k_n of the bond), a bond would be of one material whatever its width. The workflows' variant `by_width` has it so. "
                    "Same packings, nothing else changed. Poisson's ratios are asked within 0.03.")
        report.table(["", "", "paper", "asked within", "k_n constant", "distance", "k_n by width", "distance"], rows)
