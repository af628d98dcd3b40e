# SPDX-License-Identifier: BSD-3-Clause
"""Oñate et al. (2015): mesh-size study, which the paper leaves as future work, and one thing changed at a time."""
import re

from .runs import Case, mean, spread

SIZES = {"": [70000, 30000, 13000, 8000, 4000], "small": [3000, 1500, 800]}
EXPERIMENT_SIZE = {"": 4000, "small": 1000}
MESH_SEEDS = 3            # of the smaller specimens, for the scatter
SPREADS = [0.10, 0.20, 0.30, 0.50]
E_0 = {"cement": 3.8e9, "concrete": 28e9, "shale": 30e9}


class Specimen:
    """Number, mean and standard deviation of the radii of a workflow (or of the base it names), scaled to another number of spheres."""

    def __init__(self, root, workflow):
        own = (root / f"workflows/{workflow}.yaml").read_text()
        base = (root / "workflows/onate2015" / re.search(r"^base: (\S+)", own, re.M)[1]).read_text()

        def first(pattern):
            return next(m for m in (re.search(pattern, text.split("\nvariants:")[0]) for text in (own, base)) if m)
        self.workflow, self.particles = workflow, int(first(r"particles: (\d+)")[1])
        self.mean, self.deviation = map(float, first(r"mean: ([\d.]+) mm, standard_deviation: ([\d.]+) mm").groups())
        self.velocity = float(first(r"platen_velocity: ([\d.]+) m/s")[1])

    def packing(self, particles, share=None):
        """Settings; `share`: standard deviation over mean. The volume of the spheres is that of a lognormal distribution: it
        stays the same when the spread changes."""
        here = self.deviation / self.mean
        share = share or here
        # <r^3> = mean^3 (1 + share^2)^3
        radius = self.mean * (self.particles / particles) ** (1 / 3) * (1 + here ** 2) / (1 + share ** 2)
        return (f"packing.particles={particles}", f"packing.radius.mean={radius:.5g} mm",
                f"packing.radius.standard_deviation={share * radius:.5g} mm")


class Study:
    """One workflow at the size of the experiments; each case changes one thing."""

    def __init__(self, runner, workflow, seed):
        self.specimen, self.seed, self.variant = Specimen(runner.root, "onate2015/" + workflow), seed, runner.variant
        self.size = EXPERIMENT_SIZE.get(runner.variant, 1000)
        self.plain = self.specimen.packing(self.size)
        self.base = self.case("base")

    def case(self, label, *settings, packing=None, seed=None):
        return Case(self.specimen.workflow, seed or self.seed, (*(packing or self.plain), *settings), label, variant=self.variant)

    def rates(self, factors):
        v = self.specimen.velocity
        return [(f"platens at {f * v:g} m/s" + (", as in the workflow" if f == 1 else ""),
                 self.base if f == 1 else self.case(f"rate_{f}", f"protocol.platen_velocity={f * v:g} m/s")) for f in factors]

    def contact_damping(self, values):
        return [(f"xi = {x}" + (", as in the paper" if x == 0.9 else ""),
                 self.base if x == 0.9 else self.case(f"xi_{x}", f"contact_law.contact_damping={x}")) for x in values]

    def spreads(self, values):
        return [(f"spread {s:.2f}", self.case(f"spread_{s}", packing=self.specimen.packing(self.size, s))) for s in values]

    def seeds(self, values):
        return [(f"seed {k}", self.case("base", seed=k)) for k in values]


def groups(runner, seed):
    """{heading: [(text, case)]}: "mesh", "pressure", "compression" and "tension" are groups or groups of groups."""
    concrete, shale = Study(runner, "concrete_ucs", seed), Study(runner, "shale_ucs", seed)
    disc, shale_disc, triaxial = (Study(runner, w, seed) for w in ("concrete_bts", "shale_bts", "concrete_triaxial_9MPa"))
    mesh = []
    for n in SIZES.get(runner.variant, SIZES["small"]):
        for k in [seed] if n > 13000 else range(seed, seed + MESH_SEEDS):   # the workflow's own runs serve as well
            mesh.append((n, Case(concrete.specimen.workflow, k, pictures=k == seed, variant=runner.variant) if n == concrete.specimen.particles
                         else concrete.case(f"mesh_{n}", packing=concrete.specimen.packing(n), seed=k)))
    law = [("failure: coupled", concrete.case("coupled", "contact_law.failure=coupled")),
           ("softening 0.02 instead of 0.20", concrete.case("softening", "contact_law.softening_tension=0.02", "contact_law.softening_shear=0.02"))]
    elastic = "contact_law.compressive_limits=[1 GPa, 2 GPa, 3 GPa]"
    confined = []
    for w in ("cement_triaxial_4000psi", "concrete_triaxial_60MPa"):
        test, short = Study(runner, w, seed), "protocol.max_strain=0.3 %"
        confined += [(f"{w}", test.case("short", short)), (f"{w}, limits out of reach", test.case("elastic", short, elastic))]
    cement_limits = "contact_law.compressive_limits=[8.5 MPa, 9 MPa, 11 MPa]"
    return {
        "mesh": mesh,
        "pressure": [(a, triaxial.case(f"area_{a}", f"protocol.pressure_area={a}")) for a in ("voronoi", "disc")],
        "compression": {
            "Concrete: loading rate": concrete.rates((0.5, 1, 4)),
            "Concrete: damping in the contact": concrete.contact_damping((0.9, 0.3, 0)),
            "Concrete: spread of the radii (standard deviation over mean)": concrete.spreads(SPREADS),
            "Concrete: the law": law,
            "Shale: loading rate and spread of the radii": shale.rates((1, 4)) + shale.spreads((0.10,)),
            "Modulus under pressure, to 0.3 % of strain": confined,
        },
        "tension": {
            "Concrete: packings": disc.seeds(range(seed, seed + 3)) + disc.spreads((0.10,)),
            "Concrete: loading rate": disc.rates((1, 4)),
            "Concrete: damping in the contact": disc.contact_damping((0.9, 0)),
            "Concrete: crushing below the platens": [("limits of cement, 8.5 to 11 MPa", disc.case("soft", cement_limits))],
            "Shale: loading rate and spread of the radii": shale_disc.rates((1, 4)) + shale_disc.spreads((0.10,)),
        },
    }


def cases(runner, seed):
    every = groups(runner, seed)
    flat = [every["mesh"], every["pressure"], *every["compression"].values(), *every["tension"].values()]
    return list(dict.fromkeys(c for group in flat for _, c in group))


def written(run, key, unit, digits):
    value = run.get(key)
    return "" if value is None else f"{value / unit:.{digits}f}"


def in_compression(run):
    bonds, strain = run.get("coordination_number"), run.get("peak_strain")
    modulus = E_0[run.case.workflow.split("/")[1].split("_")[0]]
    return [written(run, "youngs_modulus_Pa", modulus, 3), f"{bonds:.2f}", f"{40 * run.get('porosity') / bonds:.3f}", written(run, "peak_stress_Pa", 1e6, 2),
            f"{strain:.3%}" if strain else "", *broken(run),
            written(run, "uniaxial_compression.unbalanced_force_ratio_max_before_peak", 1, 3)]


def broken(run):
    """All, in tension, in shear; the others in both at once."""
    return [written(run, "damage.bonds_broken", 1, 0), written(run, "bonds_broken_tension", 1, 0), written(run, "bonds_broken_shear", 1, 0)]


def in_tension(run):
    return [f"{run.get('coordination_number'):.2f}", written(run, "brazilian_tensile_strength_Pa", 1e6, 2), *broken(run)]


KINDS = {
    "compression": ("uniaxial compression", in_compression,
                    ["E/E_0", "N_c", "40 P/N_c", "strength [MPa]", "strain at the peak", "broken bonds", "in tension", "in shear", "unbalanced force ratio"]),
    "tension": ("the Brazilian test", in_tension, ["N_c", "strength [MPa]", "broken bonds", "in tension", "in shear"]),
}


def tables(report, runner, found, seed, figures):
    everything = groups(runner, seed)
    mesh_study(report, everything["mesh"], found, figures)
    size = EXPERIMENT_SIZE.get(runner.variant, 1000)
    report.text("## Experiments", f"One thing changed at a time, {size} spheres, one seed unless said. 40 P/N_c is the `area_factor` that the law takes when "
                "none is given (Eq. 22), with the porosity and bonds of the specimen; all runs have 1. The unbalanced force ratio is the mean "
                "resultant on a particle over the mean contact force, the largest value between 10 and 90 % of the peak.")
    for kind, (name, cells, head) in KINDS.items():
        rows = []
        for heading, group in everything[kind].items():
            rows += [[f"{heading}: {text}" if k == 0 else f"... {text}", *cells(found[c])] for k, (text, c) in enumerate((t, c) for t, c in group if c in found)]
        if rows:
            report.text(f"### In {name}")
            report.table(["", *head], rows)
    pressure = everything["pressure"]
    present = [(text, found[c]) for text, c in pressure if c in found]
    if not present:
        return
    report.text("### Area on which the confining pressure acts (concrete at 9 MPa)",
                "The paper's force `pi r^2 p_c` on each surface sphere (`disc`), and the sphere's share of the surface (`voronoi`, the default).")
    rows = []
    for text, run in present:
        asked, got = (run.get(f"triaxial_compression.confining_pressure_{w}_Pa") for w in ("asked", "applied"))
        ratio = run.get("triaxial_compression.disc_area_over_lateral_surface")
        peak = run.get("triaxial_compression.peak_deviatoric_platen_stress_Pa")
        rows.append([text, f"{asked * 1e-6:.2f}", f"{got * 1e-6:.2f}", f"{got / asked:.2f}" if asked else "", f"{ratio:.2f}" if ratio else "", f"{peak * 1e-6:.1f}"])
    report.table(["", "asked [MPa]", "applied [MPa]", "ratio", "sum of pi r^2 over the surface", "differential strength [MPa]"], rows)


def mesh_study(report, group, found, figures):
    runs = {}
    for n, case in group:
        if case in found:
            runs.setdefault(n, []).append(found[case])
    if not runs:
        return
    report.text("## Mesh size: concrete in uniaxial compression", "The paper leaves it as future work. The radii shrink with the cube root of the "
                f"number; all else is the same. Mean ± standard deviation over the seeds, if more than one ({MESH_SEEDS} up to 13000 spheres).")
    rows = []
    for n, these in sorted(runs.items()):
        def both(key, unit, digits):
            values = [r.get(key) / unit for r in these if r.get(key) is not None]
            if not values:
                return ""
            return f"{mean(values):.{digits}f}" + (f" ± {spread(values):.{digits}f}" if len(values) > 1 else "")
        rows.append([n, len(these), both("youngs_modulus_Pa", E_0["concrete"], 3), both("poisson_ratio", 1, 3), both("peak_stress_Pa", 1e6, 2),
                     both("peak_strain", 1e-2, 3), both("elastic_constants.after_peak.last_stress_over_peak", 1, 2), both("time_step_s", 1e-9, 1)])
    report.table(["spheres", "seeds", "E/E_0", "Poisson's ratio", "strength [MPa]", "strain at the peak [%]", "last stress over peak", "time step [ns]"], rows)
    figures.stress_strain(report, "Mesh size", "concrete: uniaxial compression with different numbers of spheres", [r[0] for _, r in sorted(runs.items())], "mesh_size",
                          [f"{n} spheres" for n in sorted(runs)])
