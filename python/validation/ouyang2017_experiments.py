# SPDX-License-Identifier: BSD-3-Clause
"""Ouyang et al. (2017): time step, loading rate, and the modulus that the paper's equations give without the engine."""
from .ouyang2017_network import Network
from .runs import Case, mean

UCS, TENSION = "ouyang2017/baseline_a_ucs", "ouyang2017/baseline_a_tension"
SHARES = (0.8, 0.4, 0.2, 0.1)          # of the critical time step; 0.8 is the engine's default
PRESSURES = (10, 40)                   # MPa, beside the workflow's 20


def variation(workflow, label, *settings):
    return Case(workflow, None, settings, label)


def of_time_step(workflow, plain):
    return [(share, plain if share == 0.8 else variation(workflow, f"time_step_{share}", f"engine.time_step_safety={share}")) for share in SHARES]


def of_rate(plain):
    slow_tension = variation(TENSION, "rate_0p02", "protocol.plate_velocity=0.02 m/s")
    slow = variation(UCS, "rate_0p05", "protocol.platen_velocity=0.05 m/s")
    stiff = variation(UCS, "platen_10x", "protocol.platen_stiffness=500 GN/m")
    return [("compression, 0.1 m/s, as in the paper", plain[UCS]), ("compression, 0.05 m/s", slow), ("compression, platens of 500 GN/m, about 10 times the default", stiff),
            ("tension, 0.1 m/s, as in the paper", plain[TENSION]), ("tension, 0.02 m/s", slow_tension),
            ("quartzite in tension, 0.1 m/s instead of 0.01", variation("ouyang2017/quartzite_tension", "rate_0p1", "protocol.plate_velocity=0.1 m/s"))]


def biaxial():
    return {p: variation("ouyang2017/baseline_biaxial", f"{p}MPa", f"protocol.confining_pressure={p} MPa") for p in PRESSURES}


def cases(plain):
    flat = [c for w in (TENSION, UCS) for _, c in of_time_step(w, plain[w])] + [c for _, c in of_rate(plain)] + list(biaxial().values())
    return [c for c in dict.fromkeys(flat) if c not in plain.values()]


def row(run):
    return [f"{run.get('youngs_modulus_Pa') / 1e9:.2f}", f"{run.get('poisson_ratio'):.3f}", f"{run.get('peak_stress_Pa') / 1e6:.2f}", f"{run.get('peak_strain'):.4%}"]


HEAD = ["modulus [GPa]", "Poisson's ratio", "strength [MPa]", "strain at the peak"]


def tables(report, found, plain):
    report.text("## Time step", "The paper steps by 10 ns, far below its critical step. The engine takes a share of the critical step that it computes from the "
                "particles' linearised stiffness, 0.8 by default. Specimen A with smaller shares:")
    rows = []
    for word, workflow in (("compression", UCS), ("tension", TENSION)):
        present = [(share, found[c]) for share, c in of_time_step(workflow, plain[workflow]) if c in found]
        for share, run in present:
            rows.append([word, share, f"{run.get('time_step_s') * 1e9:.1f}", *row(run)])
        if len(present) > 1:
            moduli, strengths, ratios = ([r.get(k) for _, r in present] for k in ("youngs_modulus_Pa", "peak_stress_Pa", "poisson_ratio"))
            spread = [max(v) / min(v) - 1 for v in (moduli, strengths)] + [max(ratios) - min(ratios)]
            report_row = [word, "all", "", f"within {spread[0]:.2%}", f"within {spread[2]:.4f}", f"within {spread[1]:.2%}", ""]
            rows.append(report_row)
            if spread[0] > 0.01 or spread[1] > 0.05:
                report.missed.append(f"time step, {word}: modulus within {spread[0]:.1%} (asked here: 1 %), strength within {spread[1]:.1%} (5 %)")
    report.table(["", "share of the critical step", "time step [ns]", *HEAD], rows)
    report.text("## Loading rate and platens", "Specimen A, one thing changed at a time.")
    report.table(["", *HEAD], [[text, *row(found[c])] for text, c in of_rate(plain) if c in found])


def initial_modulus(run):
    """Least squares through the origin of the first 8 % of the peak [Pa]."""
    stress, strain = run.curve("platen_stress_Pa"), run.curve("platen_strain")
    past = abs(stress) > 0.08 * abs(stress).max()
    e, s = strain[:past.argmax()], stress[:past.argmax()]
    return (e * s).sum() / (e * e).sum()


def network(report, tension, inferred):
    """tension: {material: a run in tension with frames}; the first is varied. inferred: {material: a run of that reading}."""
    rows = []
    for k, (material, run) in enumerate(tension.items()):
        if not run or not run.has_frames:
            continue
        law = run.summary["nonlinear_tension"]
        kn, ks, km = law["normal_stiffness_N"], law["shear_stiffness_N"], law["bending_stiffness_N_m_rad"]
        diameter = 2 * law["reference_radius_m"]
        readings = [("equations as printed", {}, (kn, ks, km)), ("k_n x/R_max, x the harmonic mean", {"harmonic": True}, (kn, ks, km))]
        if k == 0:
            readings += [("without bending stiffness", {}, (kn, ks, 0)), ("without rotations", {"rotations": False}, (kn, ks, km)),
                         ("displacements over 2 R_max instead of d0", {"reference_length": diameter}, (kn, ks, km)),
                         ("a sixth of the bonds left out at random", {"drop": 1 / 6}, (kn, ks, km))]
        net = Network(run)
        rows.append([material, "the engine, first 8 % of the strength", f"{initial_modulus(run) / 1e9:.2f}", ""])
        for text, how, stiffness in readings:
            e, nu = net.tension(*stiffness, **how)
            rows.append(["", text, f"{e / 1e9:.2f}", f"{nu:.3f}"])
        rows.append(["", "uniform strain, an upper bound", f"{net.uniform_strain(kn, ks) / 1e9:.2f}", ""])
        if inferred.get(material):
            rows.append(["", "the engine with k_n x/R_max, first 8 % of the strength", f"{initial_modulus(inferred[material]) / 1e9:.2f}", ""])
        rows.append(["", "the engine, secant at half the strength", f"{run.get('youngs_modulus_Pa') / 1e9:.2f}", f"{run.get('poisson_ratio'):.3f}"])
        ratio = run.reference.get("poisson_ratio")
        rows.append(["", "the paper, secant at half the strength", f"{run.reference['youngs_modulus_Pa'] / 1e9:.2f}", "" if ratio is None else f"{ratio:.3f}"])
    if rows:
        report.text("## The modulus without the engine", "The bonds of the specimen as a linear network (Eqs. 1 to 5 at small strain), its ends held as in direct tension, "
                    "solved at rest by conjugate gradients in `python/validation/ouyang2017_network.py`, which shares no code with the engine. "
                    "Secants at half the strength lie below by the bend of the tension curve.")
        report.table(["", "", "modulus in tension [GPa]", "Poisson's ratio"], rows)


def confinement(report, found, ucs, middle):
    """Strength against confinement: `ucs` the unconfined run, `middle` that of the workflow (20 MPa). Returns (MPa, run) of each."""
    runs = {0: ucs, 20: middle} | {p: found.get(c) for p, c in biaxial().items()}
    present = [(p, r) for p, r in sorted(runs.items()) if r]
    if len(present) < 2:
        return []
    axial = []
    for p, run in present:
        name = "deviatoric_platen_stress_Pa"
        axial.append(p + max(run.curve(name if run.has_curve(name) else "platen_stress_Pa")) / 1e6)
    centre, height = mean([p for p, _ in present]), mean(axial)
    slope = sum((p - centre) * (a - height) for (p, _), a in zip(present, axial)) / sum((p - centre) ** 2 for p, _ in present)
    report.table(["confining pressure [MPa]", "axial stress at the peak [MPa]", "bonds broken in tension", "in shear"],
                 [[p, f"{a:.1f}", r.get("bonds_broken_tension"), r.get("bonds_broken_shear")] for (p, r), a in zip(present, axial)])
    report.text(f"By least squares sigma_1 = {height - slope * centre:.0f} MPa + {slope:.2f} sigma_3.")
    return present
