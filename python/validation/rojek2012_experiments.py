# SPDX-License-Identifier: BSD-3-Clause
"""One thing changed at a time: what the results of Rojek et al. (2012) depend on."""
import numpy

from .runs import Case

SPECIMEN1, SPECIMEN2 = "rojek2012/specimen1_model1", "rojek2012/specimen2_model1"
ELASTIC = "protocol.max_strain=0.6%"   # for what only the elastic constants can tell
STRAIN = "postprocessors[1].hull_gap="

EXPERIMENTS = [
    # heading, [(text, workflow, label, settings)]
    ("Loading rate: is the response quasi-static?", [
        ("platens at 0.05 m/s", SPECIMEN1, "velocity_0p05", ["protocol.platen_velocity=0.05 m/s"]),
        ("0.1 m/s", SPECIMEN1, "velocity_0p1", ["protocol.platen_velocity=0.1 m/s"]),
        ("0.2 m/s, as in the paper", SPECIMEN1, "", []),
        ("0.4 m/s", SPECIMEN1, "velocity_0p4", ["protocol.platen_velocity=0.4 m/s"]),
        ("0.2 m/s with damping 0.3 instead of 0.7", SPECIMEN1, "damping_0p3", ["damping.translational=0.3", "damping.rotational=0.3"]),
    ]),
    ("Platens and seating", [
        ("15 MN/m, frictionless, as in the paper", SPECIMEN1, "", []),
        ("150 MN/m", SPECIMEN1, "platen_150", ["protocol.platen_stiffness=150 MN/m"]),
        ("strain counted from the first step", SPECIMEN1, "no_seating", ["protocol.seating_stress=0 Pa"]),
        ("strain counted from 5 MPa", SPECIMEN1, "seating_5MPa", ["protocol.seating_stress=5 MPa"]),
    ]),
    ("Specimen 1: which pairs are bonded, how it is packed, the free length of broken bonds", [
        ("as in the workflow", SPECIMEN1, "", []),
        ("nearest by the relative gap", SPECIMEN1, "relative", ["bonding.nearest_by=relative_gap"]),
        ("neighbours uncorrelated in size", SPECIMEN1, "uncorrelated", ["packing.neighbour_size_correlation=0"]),
        ("free length of broken bonds: touching", SPECIMEN1, "touching", ["contact_law.broken_rest_length=touching"]),
    ]),
    ("Specimen 2: which pairs are bonded, how it is packed (loaded to 0.6 % only)", [
        ("as in the workflow", SPECIMEN2, "hull_3", [ELASTIC, STRAIN + "3"]),
        ("nearest by the relative gap", SPECIMEN2, "relative", [ELASTIC, "bonding.nearest_by=relative_gap"]),
        ("packed 3 mm wider and cut", SPECIMEN2, "cut", [ELASTIC, "packing.margin=3 mm"]),
        ("nearest pairs drawn together", SPECIMEN2, "drawn",
         [ELASTIC, "packing.neighbours_per_particle=10.7127", "packing.overlap_tolerance=45 %"]),
    ]),
    ("Strain measure: how much of the triangulation's outline counts (loaded to 0.6 % only)", [
        (f"specimen {s}, `hull_gap` {gap}", w, f"hull_{gap}", [ELASTIC, STRAIN + gap])
        for s, w in (("1", SPECIMEN1), ("2", SPECIMEN2)) for gap in ("1", "3", "100")
    ]),
]


def slope_over_platens(run):
    """Of the stress over the approach of the platens, between 10 and 40 % of the peak [GPa]."""
    stress, strain = run.curve("axial_stress_Pa"), run.curve("platen_strain")
    stress, strain = stress[:stress.argmax() + 1], strain[:stress.argmax() + 1]
    part = (0.1 * stress[-1] <= stress) & (stress <= 0.4 * stress[-1])
    return numpy.polynomial.Polynomial.fit(strain[part], stress[part], 1).convert().coef[1] * 1e-9


def experiments(report, runner, seed):
    report.text("## Experiments", "One thing changed at a time, model 1, one seed. The unbalanced force ratio is the mean "
                "resultant on a particle over the mean contact force, the largest value between 10 and 90 % of the peak.")
    cases = {(text, w, label): Case(w, seed, tuple(settings), label, pictures=not label) for _, group in EXPERIMENTS for text, w, label, settings in group}
    # The unchanged runs are there already.
    keep, runner.keep = runner.keep, True
    unchanged = runner.run([c for c in dict.fromkeys(cases.values()) if not c.label])
    runner.keep = keep
    changed = runner.run([c for c in dict.fromkeys(cases.values()) if c.label])
    found = {r.case: r for r in unchanged + changed}
    for heading, group in EXPERIMENTS:
        report.text(f"### {heading}")
        rows = []
        elastic = ELASTIC in group[-1][3]
        for text, w, label, _ in group:
            r = found[cases[text, w, label]]
            row = [text, f"{r.get('youngs_modulus_Pa') * 1e-9:.2f}", f"{slope_over_platens(r):.2f}", f"{r.get('poisson_ratio'):.4f}"]
            if elastic:
                row += [f"{r.get('bagi_strain.boundary_particles')}", f"{r.get('bagi_strain.outline_volume_share_left_out'):.1%}"]
            else:
                row += [f"{r.get('peak_stress_Pa') * 1e-6:.1f}", f"{r.get('bonds_broken_tension')}", f"{r.get('bonds_broken_shear')}",
                        f"{r.get('uniaxial_compression.unbalanced_force_ratio_max_before_peak'):.3f}"]
            rows.append(row)
        tail = ["boundary particles", "volume left out"] if elastic else ["strength [MPa]", "broken in tension", "in shear", "unbalanced force ratio"]
        report.table(["", "E [GPa]", "E by the platens' approach [GPa]", "Poisson's ratio", *tail], rows)
