# SPDX-License-Identifier: BSD-3-Clause
"""What the reports' figures have in common: drawn by `breccia render` and `breccia compare`, kept beside the results."""
import csv
import json
import shutil


class Drawing:
    """`folder`: where the pictures of the whole report are; it is emptied first. What of them is shown in the tree is
    chosen when the report is published (report.py)."""

    def __init__(self, runner, paper):
        self.runner, self.folder, self.work = runner, runner.folder / paper, runner.folder / "figures"
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        shutil.rmtree(self.work, ignore_errors=True)

    def _show(self, report, number, caption, files):
        if files:
            short = caption.split(". ")[0]
            report.text(f"**{number}.** {caption[0].upper() + caption[1:]}.", " ".join(f"![{short}]({self.folder.name}/{f})" for f in files))

    def _take(self, source, name):
        shutil.copy(source, self.folder / name)
        return name

    def _reduced(self, run, name, columns):
        """A result folder with columns of our own: {header: values}, at most 2000 rows."""
        folder = self.work / "reduced" / name / run.case.name
        folder.mkdir(parents=True, exist_ok=True)
        rows = list(zip(*columns.values()))
        rows = rows[::max(1, len(rows) // 2000)]
        with open(folder / "curves.csv", "w", newline="") as file:
            csv.writer(file).writerows([list(columns), *rows])
        shutil.copy(run.place / "summary.json", folder)
        return folder

    def _compare(self, folders, labels, name, comparisons, *settings):
        out = self.work / name
        given = ["--set", f"comparisons={json.dumps(comparisons)}"] if comparisons else []
        self.runner.call("compare", *folders, *[x for folder, text in zip(folders, labels) for x in ("--labels", f"{text}={folder}")], "-o", out, "--overwrite",
                         "--set", "size=900", *given, *settings)
        return out

    def _render(self, run, pictures, name, size=500):
        out = self.work / "render" / name
        self.runner.call("render", run.folder, "--output", out, "--set", f"pictures={json.dumps(pictures)}", "--set", f"size={size}")
        return out
