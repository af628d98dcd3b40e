# SPDX-License-Identifier: BSD-3-Clause
"""One thing changed at a time: what the results for Potyondy and Cundall's granite depend on."""
from .runs import Case

UCS, BRAZILIAN, TENSION, UCS_3D, BRAZILIAN_3D, TENSION_3D = (f"potyondy2004/{w}" for w in ("ucs_2d", "brazilian_2d", "tension_2d", "ucs_3d", "brazilian_3d", "tension_3d"))
PURE_TENSION = ["contact_law[1].moment_contribution=0"]
EVEN = ["contact_law[1].tensile_strength=157 MPa", "contact_law[1].cohesion=157 MPa"]


def discs_of(factor):
    """Radii of the discs times a factor."""
    return [f"packing.radius.min={0.270677 * factor:g} mm", f"packing.radius.max={0.449323 * factor:g} mm", "packing.overlap_tolerance=8 %"]


COMPRESSION = [
    # heading, [(text, label, settings)], of discs in unconfined compression
    ("Loading", [
        ("as in the workflow: platens at 0.1 m/s, frictionless", "", []),
        ("platens at 0.05 m/s", "velocity_0p05", ["protocol.platen_velocity=0.05 m/s"]),
        ("platens at 0.2 m/s", "velocity_0p2", ["protocol.platen_velocity=0.2 m/s"]),
        ("platens with friction 0.5", "platen_friction", ["protocol.platen_friction=0.5"]),
        ("platens a tenth as stiff", "soft_platens", ["protocol.platen_stiffness=24 GN/m"]),
    ]),
    ("Packing", [
        ("as in the workflow: porosity 16 %, 4 bonds a disc", "", []),
        ("3.8 bonds a disc", "z3p8", ["bonding.coordination_number=3.8"]),
        ("4.4 bonds a disc", "z4p4", ["bonding.coordination_number=4.4"]),
        ("porosity 16.5 %: the workflow's first form, some gaps", "jammed", ["packing.porosity=16.5 %"]),
        ("porosity 15 %: overlaps", "dense", ["packing.porosity=15 %", "packing.overlap_tolerance=8 %"]),
        ("porosity 18 %: gaps", "loose", ["packing.porosity=18 %"]),
        ("discs twice as large", "coarse", discs_of(2)),
        ("discs half as large", "fine", discs_of(0.5)),
    ]),
    ("Law", [
        ("as in the workflow", "", []),
        ("grains' modulus that of one bar between the centres (`modulus_of: contact`)", "bar", ["contact_law[0].modulus_of=contact"]),
        ("a grain's k_n read as that of the contact: twice as stiff", "twice", ["contact_law[0].contact_modulus=124 GPa"]),
        ("bending left out of the stresses that break (`moment_contribution: 0`)", "beta_0", PURE_TENSION),
        ("strengths of all bonds alike, 157 MPa", "even", EVEN),
        ("grains without friction", "mu_0", ["contact_law[0].friction=0"]),
        ("shear strength with a friction angle of 30 degrees", "phi_30", ["contact_law[1].internal_friction_angle=30 deg"]),
    ]),
]
CUT_FREE = "cut_free"   # variant of the Brazilian test: cut free all round, so that single grains carry
SPLITTING = [  # text, workflow, variant, label, settings: discs
    ("Brazilian, as in the workflow: as wide as its vessel", BRAZILIAN, "", "", []),
    ("platens at 0.1 m/s instead of 0.05", BRAZILIAN, "", "velocity_0p1", ["protocol.platen_velocity=0.1 m/s"]),
    ("platens at 0.025 m/s", BRAZILIAN, "", "velocity_0p025", ["protocol.platen_velocity=0.025 m/s"]),
    ("platens of 20 GN/m, a twelfth of the default", BRAZILIAN, "", "platen_20", ["protocol.platen_stiffness=20 GN/m", "protocol.max_displacement=1.2 %"]),
    ("platens with friction 0.5", BRAZILIAN, "", "platen_friction", ["protocol.platen_friction=0.5"]),
    ("porosity 16.5 %", BRAZILIAN, "", "jammed", ["packing.porosity=16.5 %"]),
    ("discs twice as large", BRAZILIAN, "", "coarse", discs_of(2)),
    ("bending left out of the stresses that break", BRAZILIAN, "", "beta_0", PURE_TENSION),
    ("strengths of all bonds alike", BRAZILIAN, "", "even", EVEN),
    ("cut free all round: one grain under a platen (`cut_free`)", BRAZILIAN, CUT_FREE, "", []),
    ("... with platens of 20 GN/m", BRAZILIAN, CUT_FREE, "platen_20", ["protocol.platen_stiffness=20 GN/m", "protocol.max_displacement=1.2 %"]),
    ("... with platens of 5 GN/m, at 0.1 m/s", BRAZILIAN, CUT_FREE, "platen_5",
     ["protocol.platen_stiffness=5 GN/m", "protocol.max_displacement=2.5 %", "protocol.platen_velocity=0.1 m/s"]),
    ("... bending left out of the stresses that break", BRAZILIAN, CUT_FREE, "beta_0", PURE_TENSION),
    ("... packed into a round wall instead of cut out", BRAZILIAN, CUT_FREE, "round_wall", ["packing.margin=0 mm", "packing.overlap_tolerance=5 %"]),
    ("direct tension, as in the workflow", TENSION, "", "", []),
    ("direct tension, bending left out of the stresses that break", TENSION, "", "beta_0", PURE_TENSION),
]
SPLITTING_3D = [
    ("Brazilian, as in the workflow: as wide as its vessel", BRAZILIAN_3D, "", "", []),
    ("platens at 0.2 m/s", BRAZILIAN_3D, "", "velocity_0p2", ["protocol.platen_velocity=0.2 m/s"]),
    ("5.4 bonds a sphere", BRAZILIAN_3D, "", "z5p4", ["bonding.coordination_number=5.4"]),
    ("cut free all round (`cut_free`)", BRAZILIAN_3D, CUT_FREE, "", []),
    ("... with platens of 31 MN/m, a twelfth of the default, at 0.2 m/s", BRAZILIAN_3D, CUT_FREE, "platen_31",
     ["protocol.platen_stiffness=31 MN/m", "protocol.max_displacement=4 %", "protocol.platen_velocity=0.2 m/s"]),
    ("... with platens of 8 MN/m, at 0.4 m/s", BRAZILIAN_3D, CUT_FREE, "platen_8",
     ["protocol.platen_stiffness=8 MN/m", "protocol.max_displacement=6 %", "protocol.platen_velocity=0.4 m/s"]),
    ("direct tension, as in the workflow", TENSION_3D, "", "", []),
]
SPHERES = [
    ("as in the workflow: platens at 0.1 m/s, 6 bonds a sphere", UCS_3D, "", []),
    ("platens at 0.2 m/s", UCS_3D, "velocity_0p2", ["protocol.platen_velocity=0.2 m/s"]),
    ("grains' modulus that of one bar between the centres, at 0.2 m/s as all below", UCS_3D, "bar", ["contact_law[0].modulus_of=contact", "protocol.platen_velocity=0.2 m/s"]),
    ("5.4 bonds a sphere", UCS_3D, "z5p4", ["bonding.coordination_number=5.4", "protocol.platen_velocity=0.2 m/s"]),
    ("bending left out of the stresses that break", UCS_3D, "beta_0", [*PURE_TENSION, "protocol.platen_velocity=0.2 m/s"]),
]


def cases(seed, pictures):
    """{(workflow, variant, label): case}; the unchanged ones are those of the report."""
    rows = [(UCS, "", label, settings) for _, group in COMPRESSION for _, label, settings in group] + [r[1:] for r in SPLITTING + SPLITTING_3D]
    rows += [(w, "", label, settings) for _, w, label, settings in SPHERES]
    return {(w, v, label): Case(w, seed, tuple(settings), label, pictures=pictures and not label, variant=v) for w, v, label, settings in rows}


def megapascal(run, key="peak_stress_Pa"):
    return f"{abs(run.get(key)) * 1e-6:.1f}"


def compression_row(text, run):
    return [text, run.get("particles"), f"{run.get('coordination_number'):.2f}", f"{run.get('youngs_modulus_Pa') * 1e-9:.1f}", f"{run.get('particles_poisson_ratio'):.3f}",
            megapascal(run), run.get("bonds_broken_tension"), run.get("bonds_broken_shear")]


def first_drop(run, share=0.05):
    """The first local peak of the load that it then falls from by `share` of the highest [Pa]."""
    stress = run.curve("tensile_stress_Pa")
    high, fall = 0.0, share * max(stress)
    for s in stress:
        high = max(high, s)
        if s < high - fall:
            return high
    return high


def splitting(report, found, of, what, tests):
    rows = []
    for text, workflow, variant, label, _ in tests:
        run = found.get(of[workflow, variant, label])
        if run and run.get("brazilian") is None:
            rows.append([text, run.get("particles"), "", megapascal(run), "", run.get("bonds_broken_tension"), run.get("bonds_broken_shear")])
        elif run:
            rows.append([text, run.get("particles"), f"{run.get('brazilian.platen_particles_at_peak'):.0f}", megapascal(run, "brazilian.peak_tensile_stress_Pa"),
                         f"{first_drop(run) * 1e-6:.1f}", run.get("bonds_broken_tension"), run.get("bonds_broken_shear")])
    if rows:
        report.text(f"### {what}: how tension is applied and read")
        report.table(["", "particles", "under a platen at the peak", "strength [MPa]", "load that first falls by 5 % of the strength [MPa]", "broken in tension", "in shear"], rows)


def tables(report, found, of):
    head = ["", "particles", "bonds a particle", "E' [GPa]", "nu'", "strength [MPa]", "broken in tension", "in shear"]
    report.text("## Experiments", "One thing changed at a time, one packing: a difference below the scatter over packings (above) may be chance. E' and nu' are slopes as measured, not those of plane strain.")
    for heading, group in COMPRESSION:
        rows = [compression_row(text, found[of[UCS, "", label]]) for text, label, _ in group if of[UCS, "", label] in found]
        if rows:
            report.text(f"### Discs in compression: {heading.lower()}")
            report.table(head, rows)
    splitting(report, found, of, "Discs", SPLITTING)
    rows = [compression_row(text, found[of[w, "", label]]) for text, w, label, _ in SPHERES if of[w, "", label] in found]
    if rows:
        report.text("### Spheres in compression")
        report.table(head, rows)
    splitting(report, found, of, "Spheres", SPLITTING_3D)
