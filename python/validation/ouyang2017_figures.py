# SPDX-License-Identifier: BSD-3-Clause
"""Charts and pictures of the report on Ouyang et al. (2017)."""
from .figures import Drawing

NO_ENVELOPE = ("--set", "strength_envelope=false")


def peak(run):
    """Number of the sample at which the load was largest."""
    stress = run.curve(next(c for c in ("deviatoric_platen_stress_Pa", "platen_stress_Pa", "tensile_stress_Pa") if run.has_curve(c)))
    return int(abs(stress).argmax())


def broken_at(run, time):
    times = run.curve("time_s")
    return int(run.curve("bonds_broken")[abs(times - time).argmin()])


class Figures(Drawing):
    def load_displacement(self, report, compression, tension):
        """Fig. 7: load on the plates, 50 mm by 1 m, against their displacement."""
        files = []
        for run, name, sign in ((compression, "compression", 1), (tension, "tension", -1)):
            if run:
                height = run.get("direct_tension.free_length_m") or 0.05
                columns = {"displacement_m": sign * height * run.curve("platen_strain"), "load_N": sign * 0.05 * run.curve("platen_stress_Pa")}
                out = self._compare([self._reduced(run, "load_" + name, columns)], [f"specimen A in {name}"], "load_" + name, [{"x": "displacement", "y": "load", "name": "curves"}], *NO_ENVELOPE)
                files.append(self._take(out / "curves.png", f"load_{name}.png"))
        self._show(report, "Fig. 7", "load against displacement of the plates, specimen A", files)

    def rock(self, report, number, rock, title, compression, tension):
        """Figs 14 and 16: stress against axial and lateral strain (extension negative), and tension by itself."""
        files = []
        if compression:
            axial, lateral = compression.curve("platen_strain"), compression.curve("gauge_lateral_strain")
            stress, last = compression.curve("platen_stress_Pa"), peak(compression) + 1
            parts = [(axial, "axial strain", "axial"), (-lateral, "lateral strain", "lateral")]
            folders = [self._reduced(compression, f"{rock}/{name}", {"strain": strain[:last], "axial_stress_Pa": stress[:last]}) for strain, _, name in parts]
            out = self._compare(folders, [text for _, text, _ in parts], rock + "_compression", [{"x": "strain", "y": "axial_stress", "name": "curves"}], *NO_ENVELOPE)
            files.append(self._take(out / "curves.png", rock + "_compression.png"))
        if tension:
            columns = {"strain": -tension.curve("platen_strain"), "tensile_stress_Pa": -tension.curve("platen_stress_Pa")}
            out = self._compare([self._reduced(tension, rock + "_tension", columns)], ["axial strain"], rock + "_tension",
                                [{"x": "strain", "y": "tensile_stress", "name": "curves"}], *NO_ENVELOPE)
            files.append(self._take(out / "curves.png", rock + "_tension.png"))
        self._show(report, number, f"{title}: stress against strain in compression up to the peak and in direct tension", files)

    def cracks(self, report, number, title, run, name, later, size=360):
        """The specimen at the peak and `later` [s] after it, as far as the run went, particles coloured by the share of their bonds that broke."""
        if not run or not run.has_frames:
            return
        frames, at_peak = run.particles.times, run.curve("time_s")[peak(run)]
        pictures, texts = [], []
        for k, after in enumerate([0, *later]):
            if at_peak + after > frames[-1] + 2e-5:
                continue
            frame = int(abs(frames - at_peak - after).argmin())
            pictures.append({"show": "specimen", "name": f"frame_{k}", "frame": frame, "field": "damage", "low": 0, "high": 1, "colour_map": "orange_red"})
            distance = frames[frame] - at_peak
            texts.append(f"{distance * 1e6:+.0f} µs ({broken_at(run, frames[frame])} bonds broken)")
        out = self._render(run, pictures + [{"show": "cracks"}], name, size)
        files = [self._take(out / f"{p['name']}.png", f"{name}_{p['name']}.png") for p in pictures] + [self._take(out / "cracks.png", f"{name}_cracks.png")]
        self._show(report, number, f"{title}. Damage: share of a particle's bonds that are broken (the paper's black is 0, its red 1), at the peak load and after it: "
                   + ", ".join(texts) + "; last the broken bonds at the end of the run", files)

    def curves(self, report, number, caption, runs, labels, name, x, y):
        runs = [(r, text) for r, text in zip(runs, labels) if r]
        if runs:
            out = self._compare([r.folder for r, _ in runs], [text for _, text in runs], name, [{"x": x, "y": y, "name": "curves"}], *NO_ENVELOPE)
            self._show(report, number, caption, [self._take(out / "curves.png", f"{name}.png")])

    def envelope(self, report, runs, labels):
        runs, labels = zip(*((r, text) for r, text in zip(runs, labels) if r))
        out = self._compare([r.folder for r in runs], labels, "envelope", [{"x": "time", "y": "time"}])
        if (out / "strength_envelope.png").exists():
            self._show(report, "Mohr circles", "strength envelope of the baseline material", [self._take(out / "strength_envelope.png", "envelope.png")])

    def study(self, report, name, number, caption, charts):
        folder, files = self.runner.folder / name, []
        for chart in charts:
            if (folder / f"{chart}.png").exists():
                files.append(self._take(folder / f"{chart}.png", f"{name}_{chart}.png"))
        self._show(report, number, caption, files)
