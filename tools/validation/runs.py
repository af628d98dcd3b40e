# SPDX-License-Identifier: BSD-3-Clause
"""Runs workflows in parallel and reads what they leave."""
import concurrent.futures
import csv
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Case:
    """One run: a workflow, a seed, and settings changed for an experiment."""
    workflow: str                 # below workflows/, without .yaml
    seed: int | None = 1          # None: the workflow's own
    settings: tuple = ()          # "path=value"
    label: str = ""               # of an experiment
    pictures: bool = False
    variant: str = ""             # of the workflow

    @property
    def name(self):
        return "_".join(filter(None, [pathlib.Path(self.workflow).name, self.variant, self.label, "" if self.seed is None else f"seed{self.seed}"]))


@dataclass
class Result:
    case: Case
    folder: pathlib.Path
    summary: dict
    _curves: dict = field(default=None, repr=False)

    def get(self, path):
        """A number of the summary by its dotted path, or None."""
        value = self.summary
        for part in path.split("."):
            value = value.get(part) if isinstance(value, dict) else None
        return value

    @property
    def reference(self):
        return self.summary["reference"]

    def curve(self, name):
        """All values of a column of curves.csv; its header carries the unit."""
        if self._curves is None:
            with open(self.folder / "curves.csv") as file:
                rows = list(csv.reader(file))
            self._curves = {head: [float(v) if v else float("nan") for v in values]
                            for head, values in zip(rows[0], zip(*rows[1:]))}
        return self._curves[name]

    def has_curve(self, name):
        self.curve("time_s")
        return name in self._curves


class Runner:
    def __init__(self, root, folder, jobs, keep, only="", report=False, variant="", program=None):
        self.root, self.folder, self.jobs, self.keep = root, folder, jobs, keep
        self.only, self.report, self.variant = only, report, variant
        self.missing = []             # names of the cases that were neither run nor there
        self.program = program or root / "build/bin/breccia"
        if not self.program.exists():
            sys.exit("build Breccia first: tools/quickstart")

    def call(self, *arguments):
        """Any other verb of the program; its words are shown only when it fails."""
        done = subprocess.run([self.program, *map(str, arguments)], cwd=self.root, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"breccia {' '.join(map(str, arguments))} failed:\n{done.stdout}{done.stderr}")

    def run(self, cases):
        """Results in the order of the cases; a failed run ends it all, with its log. Of a part (`only`), or when no runs are
        to be made (`report`), the others are read if they are finished, or else missing."""
        start = time.time()
        results = {}
        self.folder.mkdir(parents=True, exist_ok=True)
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            possible = [c for c in dict.fromkeys(cases) if not self.report and self._is_wanted(c) or self._is_finished(c)]
            waiting = {pool.submit(self._run, case): case for case in possible}
            for done in concurrent.futures.as_completed(waiting):
                result = done.result()
                if result is None:
                    pool.shutdown(cancel_futures=True)
                    sys.exit(f"{waiting[done].name} failed: see {self.folder / (waiting[done].name + '.log')}")
                results[result.case] = result
                if not self.report and self._is_wanted(result.case):
                    print(f"[{time.time() - start:6.0f} s] {len(results)}/{len(waiting)} {result.case.name}", flush=True)
        self.missing += [c.name for c in cases if c not in results]
        return [results[c] for c in cases if c in results]

    def sweep(self, study, expected, label="", variant="", fixed=()):
        """Rows of results.csv of a study below workflows/ (without .yaml), values as text: those of its finished cases.
        Without --keep it is run anew, with it (and where it was stopped) it goes on; `expected` is its number of cases. With a
        `label`: of the workflows' `variant` and with values `fixed` ("path: value") beside those of the study."""
        file = self.root / f"workflows/{study}.yaml"
        folder = self.folder / "_".join(filter(None, [file.stem, label]))
        if label:
            file = self._changed_study(file, folder.with_suffix(".yaml"), variant, fixed)
        wanted = not self.report and (not self.only or any(part in folder.name for part in self.only.split(",")))
        if wanted and not self.keep and folder.exists():
            shutil.rmtree(folder)
        rows = []
        if wanted or folder.exists():
            command = [self.program, "sweep", file, "--output", folder]
            with open(self.folder / (folder.name + ".log"), "w") as log:
                done = subprocess.run([*command, *(["--jobs", str(self.jobs)] if wanted else ["--collect"])], cwd=self.root,
                                      stdout=log, stderr=subprocess.STDOUT)
            if done.returncode not in (0, 1):
                sys.exit(f"{folder.name} failed: see {self.folder / (folder.name + '.log')}")
            with open(folder / "results.csv") as file:
                rows = [row for row in csv.DictReader(file) if row["status"] == "finished"]
        if len(rows) < expected:
            self.missing.append(f"{folder.name} ({expected - len(rows)} of {expected} cases)")
        return rows

    @staticmethod
    def _changed_study(file, changed, variant, fixed):
        """A study names no base, so its text is taken; its workflows are found from anywhere."""
        text = file.read_text().replace("file: ", f"file: {file.parent}/")
        for section, lines in (("fixed:\n", fixed), ("grid:\n", [f"variants: [{variant}]"] if variant else [])):
            if lines and text.count("\n" + section) != 1:
                sys.exit(f"{file}: has no `{section.strip()}` to add to")
            text = text.replace("\n" + section, "\n" + section + "".join(f"  {line}\n" for line in lines))
        changed.parent.mkdir(parents=True, exist_ok=True)
        changed.write_text(text)
        return changed

    def _is_wanted(self, case):
        return not self.only or any(part in case.name for part in self.only.split(","))

    def _is_finished(self, case):
        file = self.folder / case.name / "summary.json"
        return file.exists() and not json.loads(file.read_text()).get("interrupted")

    def _run(self, case):
        folder = self.folder / case.name
        wanted = not self.report and self._is_wanted(case)
        if wanted and not (self.keep and self._is_finished(case)):
            settings = list(case.settings) if case.pictures else [*case.settings, "outputs=[]", "renderers=[]"]
            command = [self.program, "run", self.root / f"workflows/{case.workflow}.yaml", "--output", folder, "--overwrite",
                       "--threads", "1"] + (["--variant", case.variant] if case.variant else [])
            for s in settings if case.seed is None else [f"seed={case.seed}", *settings]:
                command += ["--set", s]
            with open(self.folder / (case.name + ".log"), "w") as log:
                if subprocess.run(command, cwd=self.root, stdout=log, stderr=subprocess.STDOUT).returncode:
                    return None
        with open(folder / "summary.json") as file:
            return Result(case, folder, json.load(file))


def mean(values):
    return statistics.fmean(values)


def spread(values):
    """Sample standard deviation; 0 of one value."""
    return statistics.stdev(values) if len(values) > 1 else 0.0
