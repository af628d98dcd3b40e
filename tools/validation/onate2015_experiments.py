# SPDX-License-Identifier: BSD-3-Clause
"""Oñate et al. (2015): mesh-size study, which the paper leaves as future work, and one thing changed at a time."""
import re

from .runs import Case, mean, spread

UCS, TRIAXIAL, ROUND = "onate2015/concrete_ucs", "onate2015/concrete_triaxial_9MPa", "onate2015/cement_triaxial_4000psi"
SIZES = {"": [70000, 30000, 13000, 8000, 4000], "small": [3000, 1500, 800]}
EXPERIMENT_SIZE = {"": 4000, "small": 1000}
MESH_SEEDS = 3            # of the smaller specimens, for the scatter
SPREADS = [0.10, 0.20, 0.30, 0.40, 0.45]
E_0 = 28e9


class Concrete:
    """Number, mean and standard deviation of the radii as in the workflow's base, scaled to another number of spheres."""

    def __init__(self, root):
        text = (root / "workflows/onate2015/base/concrete.yaml").read_text()
        self.particles = int(re.search(r"particles: (\d+)", text)[1])
        radius = re.search(r"radius: \{.*mean: ([\d.]+) mm, standard_deviation: ([\d.]+) mm", text)
        self.mean, self.deviation = float(radius[1]), float(radius[2])
        self.velocity = float(re.search(r"platen_velocity: ([\d.]+) m/s", (root / f"workflows/{UCS}.yaml").read_text())[1])

    def packing(self, particles, share=None):
        """Settings; `share`: standard deviation over mean. The volume of the spheres is that of a lognormal distribution: it
        stays the same when the spread changes."""
        here = self.deviation / self.mean
        share = share or here
        # <r^3> = mean^3 (1 + share^2)^3
        radius = self.mean * (self.particles / particles) ** (1 / 3) * (1 + here ** 2) / (1 + share ** 2)
        return (f"packing.particles={particles}", f"packing.radius.mean={radius:.5g} mm",
                f"packing.radius.standard_deviation={share * radius:.5g} mm")


def groups(runner, seed):
    """[(heading, [(text, case)])]."""
    concrete, size = Concrete(runner.root), EXPERIMENT_SIZE.get(runner.variant, 1000)
    plain, v = concrete.packing(size), concrete.velocity

    def ucs(label, *settings, packing=plain, s=seed):
        return Case(UCS, s, (*packing, *settings), label, variant=runner.variant)

    base = ucs("base")
    mesh = []
    for n in SIZES.get(runner.variant, SIZES["small"]):
        seeds = [seed] if n > 13000 else range(seed, seed + MESH_SEEDS)
        for k in seeds:   # the workflow's own runs serve as well
            mesh.append((n, Case(UCS, k, pictures=k == seed) if n == concrete.particles else ucs(f"mesh_{n}", packing=concrete.packing(n), s=k)))
    return {
        "mesh": mesh,
        "Loading rate": [(f"platens at {f * v:g} m/s" + (", as in the workflow" if f == 1 else ""),
                          base if f == 1 else ucs(f"rate_{f}", f"protocol.platen_velocity={f * v:g} m/s")) for f in (0.5, 1, 2)],
        "Damping in the contact": [(f"xi = {x}" + (", as in the paper" if x == 0.9 else ""),
                                    base if x == 0.9 else ucs(f"xi_{x}", f"contact_law.contact_damping={x}")) for x in (0.9, 0.3, 0)],
        "Spread of the radii (standard deviation over mean)": [
            (f"{s:.2f}", ucs(f"spread_{s}", packing=concrete.packing(size, s))) for s in SPREADS],
        "pressure": [(area, Case(TRIAXIAL, seed, (*plain, f"protocol.pressure_area={area}"), f"area_{area}", variant=runner.variant))
                     for area in ("voronoi", "disc")],
    }


def cases(runner, seed):
    return list(dict.fromkeys(c for group in groups(runner, seed).values() for _, c in group))


def cells(run):
    """Modulus over E_0, bonds per particle, alpha by Eq. 22, strength, strain at the peak, broken bonds, unbalanced force."""
    def number(key, unit, digits):
        value = run.get(key)
        return "" if value is None else f"{value / unit:.{digits}f}"
    bonds, porosity = run.get("coordination_number"), run.get("porosity")
    strain = run.get("peak_strain")
    return [number("youngs_modulus_Pa", E_0, 3), number("coordination_number", 1, 2), f"{40 * porosity / bonds:.3f}",
            number("peak_stress_Pa", 1e6, 2), f"{strain:.3%}" if strain else "", f"{run.get('bonds_broken_tension')}",
            f"{run.get('bonds_broken_shear')}", number("uniaxial_compression.unbalanced_force_ratio_max_before_peak", 1, 3)]


HEAD = ["E/E_0", "N_c", "40 P/N_c", "strength [MPa]", "strain at the peak", "broken in tension", "in shear", "unbalanced force ratio"]


def tables(report, runner, found, seed, figures):
    everything = groups(runner, seed)
    mesh_study(report, everything.pop("mesh"), found, figures)
    pressure = everything.pop("pressure")
    size = EXPERIMENT_SIZE.get(runner.variant, 1000)
    report.text("## Experiments", f"One thing changed at a time: uniaxial compression of concrete, {size} spheres, one seed. 40 P/N_c is the "
                "`area_factor` that the law takes when none is given (Eq. 22), with the porosity and bonds of the specimen; all runs have 1. "
                "The unbalanced force ratio is the mean resultant on a particle over the mean contact force, the largest value between "
                "10 and 90 % of the peak.")
    for heading, group in everything.items():
        rows = [[text, *cells(found[c])] for text, c in group if c in found]
        if rows:
            report.text(f"### {heading}")
            report.table(["", *HEAD], rows)
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
        rows.append([n, len(these), both("youngs_modulus_Pa", E_0, 3), both("poisson_ratio", 1, 3), both("peak_stress_Pa", 1e6, 2),
                     both("peak_strain", 1e-2, 3), both("elastic_constants.after_peak.last_stress_over_peak", 1, 2), both("time_step_s", 1e-9, 1)])
    report.table(["spheres", "seeds", "E/E_0", "Poisson's ratio", "strength [MPa]", "strain at the peak [%]", "last stress over peak", "time step [ns]"], rows)
    figures.stress_strain(report, "Mesh size", "concrete: uniaxial compression with different numbers of spheres", [r[0] for _, r in sorted(runs.items())], "mesh_size",
                          [f"{n} spheres" for n in sorted(runs)])
