# SPDX-License-Identifier: BSD-3-Clause
"""The contact law of Oñate et al. (2015) along prescribed paths: Figures 7 to 10 from the pair driver."""
import shutil

import breccia

WORKFLOW = "workflows/onate2015/concrete_ucs.yaml"
E, NU, TENSION, SHEAR, MU1, MU2, DELTA = 28e9, 0.2, 5e6, 16e6, 0.9, 0.25, 0.2   # Table 5
RADIUS = 3.6e-3
D0 = 2 * RADIUS
U_TENSION, U_SHEAR = TENSION / E * D0, SHEAR / E * 2 * (1 + NU) * D0   # where damage begins
AREA = 3.141592653589793 * RADIUS ** 2


def drive(runner, name, header, points):
    """The folder and the curves along the way points."""
    folder = runner.folder / "law" / name
    folder.parent.mkdir(parents=True, exist_ok=True)
    path = folder.with_suffix(".path.csv")
    path.write_text(header + "\n" + "\n".join(",".join(f"{x:.9g}" for x in p) for p in points) + "\n")
    runner.call("drive", WORKFLOW, "--path", path, "-o", folder, "--overwrite", "--radius", "3.6 mm", "--steps", "400")
    return folder, breccia.open_run(folder).curves


def law(report, runner, pictures):
    report.text("## The contact law, from the pair driver (Figures 7 to 10)",
                "One contact of two concrete particles of 3.6 mm, led along a path by `breccia drive`; parameters of Table 5.")
    for name, caption, header, points, chart in [
        ("tension", "Figure 8a: tension, unloaded twice on the softening line", "normal_m",
         [[1.07 * U_TENSION], [0], [1.14 * U_TENSION], [0], [1.25 * U_TENSION]], "normal_force"),
        ("shear", "Figure 8b: shear without pressure, unloaded and turned round", "shear_m",
         [[1.07 * U_SHEAR], [0], [1.14 * U_SHEAR], [-0.5 * U_SHEAR], [1.25 * U_SHEAR]], "shear_force"),
        ("compression", "Figure 10: compression, unloaded on each branch", "normal_m",
         [[-x * D0] for x in (0.002, 0.0015, 0.008, 0.007, 0.022, 0.0205, 0.026)], "normal_force"),
    ]:
        folder, _ = drive(runner, name, header, points)
        shutil.copy(folder / f"{chart}.png", pictures / f"law_{name}.png")
        report.text(f"**{caption}**", f"![{caption}](onate2015/law_{name}.png)")
    envelope(report, runner)


def envelope(report, runner):
    """Peak and remaining shear force under several pressures, against the failure lines of Figures 7a and 9."""
    rows, worst = [], 0
    for stress in (0, 5e6, 10e6, 15e6):
        normal = -stress / E * D0
        limit = U_SHEAR * (1 + MU1 * stress / SHEAR)
        points = ([[normal, 0]] if normal else []) + [[normal, 1.3 * limit], [normal, 1.3 * limit + 3 * U_SHEAR]]
        _, curve = drive(runner, f"envelope_{stress / 1e6:.0f}MPa", "normal_m,shear_m", points)
        force = abs(curve["shear_force"]) / AREA
        peak, last = force.max(), force[-1]
        asked, after = SHEAR + MU1 * stress, MU2 * stress
        worst = max(worst, abs(peak / asked - 1))
        rows.append([f"{stress / 1e6:.0f}", f"{peak / 1e6:.3f}", f"{asked / 1e6:.3f}", f"{last / 1e6:.3f}", f"{after / 1e6:.3f}"])
    report.text("**Figures 7a and 9**: shear stress at failure and after it, against the pressure on the contact.")
    report.table(["pressure [MPa]", "peak, driven [MPa]", "tau + mu1 p", "after failure, driven", "mu2 p"], rows)
    report.text(f"The peaks lie within {worst:.2%} of the line (the step of the path), below it by the part of a step.")
