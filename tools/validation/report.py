# SPDX-License-Identifier: BSD-3-Clause
"""Markdown of a validation report."""
from .runs import mean, spread


class Report:
    def __init__(self):
        self.lines = []
        self.missed = []      # targets that were not met

    def text(self, *paragraphs):
        for p in paragraphs:
            self.lines += [p.strip(), ""]

    def table(self, head, rows):
        self.lines += ["| " + " | ".join(map(str, row)) + " |" for row in [head, ["---"] * len(head), *rows]] + [""]

    def compared(self, what, values, published, unit=1, digits=2, target=None):
        """A row: mean and spread of the runs beside the published number, and whether the target (a share) is met."""
        values = [v / unit for v in values]
        published /= unit
        away = mean(values) / published - 1 if published else float("nan")
        verdict = "" if target is None else "yes" if abs(away) <= target else "**no**"
        if verdict == "**no**":
            self.missed.append(f"{what}: {away:+.1%} (asked: within {target:.0%})")
        scatter = f" ± {spread(values):.{digits}f}" if len(values) > 1 else ""
        return [what, f"{mean(values):.{digits}f}{scatter}", f"{published:.{digits}f}",
                f"{away:+.1%}", verdict]

    def finish(self, path, head, missing):
        """Puts what was missed and what was not run before line `head`, writes the file and says so."""
        targets = ["## Targets not met", ""] + ([f"- {m}" for m in self.missed] or ["None of those that were measured."]) + [""]
        if missing:
            targets += ["Not run, and left out below: " + ", ".join(f"`{m}`" for m in missing) + ".", ""]
        self.lines[head:head] = targets
        self.write(path)
        print(f"wrote {path}; {len(self.missed)} targets not met, {len(missing)} missing")

    def write(self, path):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(self.lines).rstrip() + "\n")


def kept(holds):
    return "kept" if holds else "**not kept**"
