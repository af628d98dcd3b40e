# SPDX-License-Identifier: BSD-3-Clause
"""Runs workflows in parallel and reads what they leave."""
import concurrent.futures
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Case:
    """One run: a workflow, a seed, and settings changed for an experiment."""
    workflow: str                 # below workflows/, without .yaml
    seed: int = 1
    settings: tuple = ()          # "path=value"
    label: str = ""               # of an experiment
    pictures: bool = False

    @property
    def name(self):
        return "_".join(filter(None, [pathlib.Path(self.workflow).name, self.label, f"seed{self.seed}"]))


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


class Runner:
    def __init__(self, root, folder, jobs, keep):
        self.root, self.folder, self.jobs, self.keep = root, folder, jobs, keep
        self.program = root / "build/bin/breccia"
        if not self.program.exists():
            sys.exit("build Breccia first: tools/quickstart")

    def call(self, *arguments):
        """Any other verb of the program; its words are shown only when it fails."""
        done = subprocess.run([self.program, *map(str, arguments)], cwd=self.root, capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"breccia {arguments[0]} failed:\n{done.stdout}{done.stderr}")

    def run(self, cases):
        """Results by case, in the order of the cases; a failed run ends it all, with its log."""
        start = time.time()
        results = {}
        self.folder.mkdir(parents=True, exist_ok=True)
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            waiting = {pool.submit(self._run, case): case for case in cases}
            for done in concurrent.futures.as_completed(waiting):
                result = done.result()
                if result is None:
                    pool.shutdown(cancel_futures=True)
                    sys.exit(f"{waiting[done].name} failed: see {self.folder / (waiting[done].name + '.log')}")
                results[result.case] = result
                print(f"[{time.time() - start:6.0f} s] {len(results)}/{len(waiting)} {result.case.name}", flush=True)
        return [results[c] for c in cases]

    def _run(self, case):
        folder = self.folder / case.name
        if not (self.keep and (folder / "summary.json").exists()):
            settings = list(case.settings) if case.pictures else [*case.settings, "outputs=[]", "renderers=[]"]
            command = [self.program, "run", self.root / f"workflows/{case.workflow}.yaml", "--output", folder, "--overwrite",
                       "--threads", "1", "--set", f"seed={case.seed}"]
            for s in settings:
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
