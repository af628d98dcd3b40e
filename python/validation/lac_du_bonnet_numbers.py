# SPDX-License-Identifier: BSD-3-Clause
"""Numbers in the text of the granite's discussion, from the runs: [[strength of ucs_2d]], [[E of ucs_2d_bar over ucs_2d]]."""
import re

from .runs import mean, spread

QUANTITIES = {"E": ("youngs_modulus_Pa", 1e-9, 1), "nu": ("particles_poisson_ratio", 1, 3), "strength": ("peak_stress_Pa", 1e-6, 1),
              "grains": ("brazilian.platen_particles_at_peak", 1, 0)}


def filled(text, results):
    """Mean ± deviation over the seeds of the runs of that name, or the ratio of two means over the seeds that both have."""
    by_name = {}
    for r in results:
        by_name.setdefault(r.case.name.rsplit("_seed", 1)[0], {})[r.case.seed] = r

    def values(what, name):
        key, unit, _ = QUANTITIES[what]
        if what == "strength" and name.startswith("brazilian"):
            key = "brazilian.peak_tensile_stress_Pa"
        return {s: abs(r.get(key)) * unit for s, r in by_name.get(name, {}).items() if r.get(key) is not None}

    def number(match):
        what, name, over = match.groups()
        found = values(what, name)
        if over:
            others = values(what, over)
            both = found.keys() & others.keys()
            return f"{mean([found[s] for s in both]) / mean([others[s] for s in both]):.2f}" if both else "(not run)"
        if not found:
            return "(not run)"
        digits = QUANTITIES[what][2]
        return f"{mean(list(found.values())):.{digits}f}" + (f" ± {spread(list(found.values())):.{digits}f}" if len(found) > 1 else "")

    return re.sub(r"\[\[(\w+) of (\w+)(?: over (\w+))?\]\]", number, text)
