# SPDX-License-Identifier: BSD-3-Clause
"""Charts and pictures of the report on Oñate et al. (2015)."""
import json
import math
import re

import numpy

from .figures import Drawing

LABELS = {"cement_ucs": "70 psi (jacket)", "concrete_ucs": "unconfined", "shale_ucs": "shale (unconfined)", "concrete_cyclic_40MPa": "40 MPa with cycles",
          "cement_bts": "cement (Brazilian)", "concrete_bts": "concrete (Brazilian)", "shale_bts": "shale (Brazilian)"}


def label(run):
    name = run.case.workflow.rsplit("/", 1)[1]
    pressure = re.search(r"triaxial_([\d.]+)(psi|MPa)", name)
    return LABELS.get(name) or (f"{pressure[1]} {pressure[2]}" if pressure else name)


def confined(run):
    """(strain, differential stress, stage) from the end of the confining stage on; without confinement the whole curve."""
    strain, stage = run.curve("platen_strain"), run.curve("stage")
    name = "deviatoric_platen_stress_Pa"
    stress = run.curve(name if run.has_curve(name) else "platen_stress_Pa")
    skip = 1 if run.get("triaxial_compression") else 0
    return [p for p in zip(strain, stress, stage) if p[2] >= skip]


class Figures(Drawing):
    def stress_strain(self, report, number, caption, runs, name, labels=None):
        if not runs:
            return
        folders = []
        for run in runs:
            points = confined(run)
            folders.append(self._reduced(run, name, {"axial_strain": [p[0] for p in points], "differential_stress_Pa": [p[1] for p in points]}))
        out = self._compare(folders, labels or [label(r) for r in runs], name, [{"x": "axial_strain", "y": "differential_stress", "name": "curves"}],
                            "--set", "strength_envelope=false")
        self._show(report, number, caption, [self._take(out / "curves.png", f"{name}.png")])

    def compaction(self, report, runs):
        for run in runs:
            strain, folders, labels = run.curve("platen_strain"), [], []
            for text, column in [("axial stress", "platen_stress_Pa"), ("differential stress", "deviatoric_platen_stress_Pa"), ("confining stress", "confining_pressure_Pa")]:
                folders.append(self._reduced(run, "usc/" + column, {"axial_strain": strain, "normal_stress_Pa": run.curve(column)}))
                labels.append(text)
            out = self._compare(folders, labels, "usc", [{"x": "axial_strain", "y": "normal_stress", "name": "curves"}], "--set", "strength_envelope=false")
            self._show(report, "Figs 12-14 and 19", "cement in uniaxial strain compression", [self._take(out / "curves.png", "cement_usc.png")])

    def brazilian(self, report, runs):
        if not runs:
            return
        out = self._compare([r.folder for r in runs], [label(r) for r in runs], "brazilian",
                            [{"x": "diametral_strain", "y": "tensile_stress", "name": "curves"}], "--set", "strength_envelope=false")
        self._show(report, "Figs 20, 24, 27", "Brazilian tests: tensile stress against the approach of the platens over the diameter",
                   [self._take(out / "curves.png", "brazilian.png")])

    def envelope(self, report, material, runs):
        if len(runs) < 2:
            return
        out = self._compare([r.folder for r in runs], [label(r) for r in runs], f"{material}_envelope", [{"x": "time", "y": "time"}])
        if not (out / "strength_envelope.json").exists():
            return
        e = json.loads((out / "strength_envelope.json").read_text())
        report.text(f"### Strength envelope of {material}",
                    f"sigma_1 = {e['uniaxial_strength_Pa'] * 1e-6:.1f} MPa + {e['slope']:.2f} sigma_3 by least squares over the compression tests: cohesion "
                    f"{e['cohesion_Pa'] * 1e-6:.2f} MPa, angle of friction {math.degrees(e['friction_angle_rad']):.1f}°; no test lies more than "
                    f"{e['largest_deviation_Pa'] * 1e-6:.1f} MPa off. The Brazilian circle, not fitted, is that of the elastic stress in the middle of the disc.")
        self._show(report, "Mohr circles", f"{material}: strength envelope", [self._take(out / "strength_envelope.png", f"{material}_envelope.png")])

    def contacts(self, report, runs):
        runs = [r for r in runs if "contact_stress_at_100_percent" in r.tables]
        report.text("## Stress of the contacts over the axial stress (Fig. 11)", "Paper: 0.55 to 0.65 at all angles, uniaxial and triaxial. "
                    "`contact_stress` gives the means of the normal stress over all contacts, the compressed, the tensile, and those at their limit (LCS1 or more).")
        if not runs:
            report.text("Not measured: no finished run has the post-processor `contact_stress`.")
            return
        rows, files = [], []
        for run in runs:
            for share in (50, 100):
                table = run.tables.get(f"contact_stress_at_{share}_percent")
                whole = run.get(f"contact_stress.at_{share}_percent") or {}
                if table is None:
                    continue
                cells = []
                for kind in ("all", "compressed", "yielded"):
                    by_angle = table[f"ratio_{kind}"]
                    one = whole.get(f"ratio_{kind}")
                    cells += [f"{one:.2f}" if one is not None else "",
                              f"{numpy.nanmin(by_angle):.2f} to {numpy.nanmax(by_angle):.2f}" if numpy.isfinite(by_angle).any() else ""]
                at_limit, compressed = whole.get("yielded"), whole.get("compressed")
                rows.append([label(run), f"{share} %", *cells, f"{at_limit / compressed:.1%}" if at_limit is not None and compressed else ""])
            out = self._render(run, [{"show": "tables"}], run.case.name + "_tables", 600)
            files.append(self._take(out / "contact_stress_at_100_percent.png", f"contact_stress_{len(files)}.png"))
        report.table(["", "of the peak", "all", "by angle", "compressed", "by angle", "at the limit", "by angle", "share at the limit"], rows)
        self._show(report, "Fig. 11", "stress of the contacts over the axial stress at the peak, by the angle of the normal from the plane across the axis: "
                   + ", ".join(label(r) for r in runs), files)

    def _frames_at(self, run, wanted):
        """{number of a frame: its strain between the platens} of the frames nearest to these strains."""
        time, strain = run.curve("time_s"), run.curve("platen_strain")
        of_frame = []
        for at in run.particles.times:
            of_frame.append(strain[min(range(len(time)), key=lambda k: abs(time[k] - at))])
        nearest = [min(range(len(of_frame)), key=lambda k: abs(of_frame[k] - e)) for e in wanted] if of_frame else []
        return {k: of_frame[k] for k in nearest}

    def failed(self, report, runs):
        report.text("## Failed specimens", "Of the first seed.")

        def has_frames(workflow):
            return next((r for r in runs[workflow] if r.has_frames), None)

        damage = {"low": 0, "high": 1}
        for number, workflow, caption in [("Fig. 17", "cement_ucs", "cement after uniaxial compression: damage, the same inside, displacement"),
                                          ("Beside Fig. 22", "concrete_ucs", "concrete after uniaxial compression: damage, the same inside, displacement")]:
            run = has_frames(workflow)
            if run:
                out = self._render(run, [{"show": "specimen", **damage}, {"show": "cutaway", "cut": "half", **damage}, {"show": "displacement"}], workflow)
                self._show(report, number, caption, [self._take(out / f"{n}.png", f"{workflow}_{n}.png") for n in ("specimen", "cutaway", "displacement")])
        run = has_frames("cement_triaxial_500psi")
        if run:
            frames = self._frames_at(run, (0.0128, 0.0155, 0.0180, 0.0200))
            pictures = [{"show": "specimen", "name": f"frame_{k}", "frame": k, **damage} for k in frames]
            if pictures:
                out = self._render(run, pictures, "cement_500psi")
                self._show(report, "Fig. 18", "cement at 500 psi, damage at " + ", ".join(f"{e:.2%}" for e in frames.values()) + " axial strain "
                           "(of the frames nearest to the paper's 1.28, 1.55, 1.80 and 2.00 %)",
                           [self._take(out / f"{p['name']}.png", f"cement_500psi_{p['name']}.png") for p in pictures])
        run = has_frames("cement_bts")
        if run:
            # The first frame in which the stress has fallen to half its peak; the colours end at a quarter of the way of the platens.
            time, stress, strain = run.curve("time_s"), run.curve("tensile_stress_Pa"), run.curve("diametral_strain")
            peak = int(stress.argmax())
            fallen = next((k for k in range(peak, len(stress)) if stress[k] < 0.5 * stress[peak]), len(stress) - 1)
            frames = run.particles.times
            frame = next((k for k, at in enumerate(frames) if at >= time[fallen]), len(frames) - 1)
            reach = 0.25 * strain[fallen] * run.get("brazilian.diameter_m")
            out = self._render(run, [{"show": "displacement", "field": "displacement_x", "colour_map": "blue_red", "frame": frame, "low": -reach, "high": reach},
                                     {"show": "cracks", "frame": frame}], "cement_bts")
            self._show(report, "Fig. 21", f"cement in the Brazilian test, loaded along y, {frames[frame] * 1e3:.1f} ms after the start: displacement across the load, cracks",
                       [self._take(out / f"{n}.png", f"cement_bts_{n}.png") for n in ("displacement", "cracks")])
