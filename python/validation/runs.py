# SPDX-License-Identifier: BSD-3-Clause
"""Runs workflows and studies in parallel; what they leave is read by the package `breccia`."""
import concurrent.futures
import csv
import io
import json
import pathlib
import shutil
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, replace

import breccia


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
        """Of the folder of its results; a finished one is found by it again."""
        return "_".join(filter(None, [pathlib.Path(self.workflow).name, self.variant, self.label, "" if self.seed is None else f"seed{self.seed}"]))


class Result(breccia.Run):
    """What a case left."""

    def __init__(self, case, folder):
        super().__init__(folder)
        self.case = case

    def get(self, path):
        """A number of the summary by its dotted path, or None."""
        return self.summary.get(path)

    @property
    def reference(self):
        return self.summary["reference"]

    def curve(self, name):
        """All samples of a curve, by its header, which carries the unit: an array."""
        return self.curves[name]

    def has_curve(self, name):
        return name in self.curves

    @property
    def has_frames(self):
        return (self.place / "particles.pvd").exists()


@dataclass(frozen=True)
class StudyCase:
    """A finished case of a study as a report keeps it: its numbers, without its folder."""
    workflow: str
    inputs: dict
    values: dict
    inputs_sha256: str            # of all that the program was given: a case with this is the same case
    program: str                  # version and commit
    earlier: bool = False         # run for an earlier report


def recorded_in(file):
    """The cases of studies in the JSON of an earlier report, by the hash of their inputs."""
    try:
        studies = json.loads(file.read_text())["studies"]
        read = [StudyCase(**c, earlier=True) for cases in studies.values() for c in cases]
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as fault:
        sys.exit(f"{file}: is no data of a report that holds studies, each case with the hash of its inputs: {fault!r}")
    return {c.inputs_sha256: replace(c, values={k: float("nan") if v is None else v for k, v in c.values.items()}) for c in read}


class Runner:
    def __init__(self, root, folder, jobs, keep, only="", report=False, variant="", program=None, record=None):
        self.root, self.folder, self.jobs, self.keep = root, folder, jobs, keep
        self.only, self.report, self.variant = only, report, variant
        self.results, self.studies = {}, {}   # all that was read: by case, by the name of the study's folder
        self.recorded = recorded_in(record) if record else {}   # cases of studies that are not run again
        self.missing = []             # names of the cases that were neither run nor there
        self.program = program or root / "build/bin/breccia"
        if not self.program.exists():
            sys.exit("build Breccia first: tools/quickstart")

    @property
    def is_part(self):
        """Whether what comes out is no whole report of the paper's own workflows: it stays beside its results."""
        return bool(self.variant or self.missing and self.only)

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
            possible = [c for c in dict.fromkeys(cases) if not self.report and self._is_wanted(c.name) or self._finished(c)]
            waiting = {pool.submit(self._run, case): case for case in possible}
            for done in concurrent.futures.as_completed(waiting):
                result = done.result()
                if result is None:
                    pool.shutdown(cancel_futures=True)
                    sys.exit(f"{waiting[done].name} failed: see {self.folder / (waiting[done].name + '.log')}")
                results[result.case] = result
                if not self.report and self._is_wanted(result.case.name):
                    print(f"[{time.time() - start:6.0f} s] {len(results)}/{len(waiting)} {result.case.name}", flush=True)
        self.missing += [c.name for c in cases if c not in results]
        self.results |= results
        return [results[c] for c in cases if c in results]

    def sweep(self, study, expected, label="", variant="", fixed=()):
        """The finished cases of a study below workflows/ (without .yaml). Without --keep it is run anew, with it (and where it
        was stopped) it goes on; a case whose inputs are those of one in the record is not run. `expected` is its number of
        cases. With a `label`: of the workflows' `variant` and with values `fixed` ((path, value), ...) beside those of the study."""
        self.folder.mkdir(parents=True, exist_ok=True)
        file = self.root / f"workflows/{study}.yaml"
        folder = self.folder / "_".join(filter(None, [file.stem, label]))
        if label:
            file = self._changed_study(file, folder.with_suffix(".yaml"), variant, fixed)
        wanted = not self.report and self._is_wanted(folder.name)
        if wanted and not self.keep and folder.exists():
            shutil.rmtree(folder)
        cases = self._cases(file, folder)
        open_cases = [c for c in cases if c["inputs_sha256"] not in self.recorded]
        if wanted and open_cases == cases:
            self._swept(file, folder, folder.name, "--jobs", str(self.jobs))
        elif wanted:
            with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
                list(pool.map(lambda c: self._swept(file, folder, f"{folder.name}_{c['case']}", "--case", c["case"]), open_cases))
        here = {}
        if folder.exists():
            self._swept(file, folder, folder.name, "--collect")
            here = {c.number: c for c in breccia.open_study(folder).finished}
        finished = []
        for c in cases:
            if found := here.get(int(c["case"])):
                made = found.run.summary["environment"]
                finished.append(StudyCase(found.workflow, dict(found.inputs), dict(found.values), c["inputs_sha256"], f"{made['breccia']} {made['commit']}".strip()))
            elif c["inputs_sha256"] in self.recorded:
                finished.append(self.recorded[c["inputs_sha256"]])
        if len(finished) < expected:
            self.missing.append(f"{folder.name} ({expected - len(finished)} of {expected} cases)")
        self.studies[folder.name] = finished
        return finished

    def _cases(self, file, folder):
        """What the program lists of a study: case, folder, inputs and their hash."""
        listed = subprocess.run([self.program, "sweep", file, "--output", folder, "--cases"], cwd=self.root, capture_output=True, text=True)
        if listed.returncode:
            sys.exit(f"{file}: {listed.stderr}")
        return list(csv.DictReader(io.StringIO(listed.stdout)))

    def _swept(self, file, folder, name, *how):
        """Some cases may not finish (1); whatever else goes wrong ends it all."""
        if self._logged([self.program, "sweep", file, "--output", folder, *how], name) not in (0, 1):
            sys.exit(f"{name} failed: see {self.folder / (name + '.log')}")

    @staticmethod
    def _changed_study(file, changed, variant, fixed):
        """The study with its own workflows, found from anywhere, in a variant and with more that is fixed."""
        import yaml
        study = yaml.safe_load(file.read_text())
        for workflow in study["workflows"]:
            workflow["file"] = str(file.parent / workflow["file"])
        study["fixed"] = dict(fixed) | study["fixed"]
        study["grid"] = ({"variants": [variant]} if variant else {}) | study["grid"]
        changed.parent.mkdir(parents=True, exist_ok=True)
        changed.write_text(yaml.safe_dump(study, sort_keys=False))
        return changed

    def _is_wanted(self, name):
        return not self.only or any(part in name for part in self.only.split(","))

    def _finished(self, case):
        """What a case left, if it came to its end; else None."""
        try:
            result = Result(case, self.folder / case.name)
        except breccia.ResultsError:
            return None
        return result if result.finished else None

    def _logged(self, command, name):
        with open(self.folder / (name + ".log"), "w") as log:
            return subprocess.run(command, cwd=self.root, stdout=log, stderr=subprocess.STDOUT).returncode

    def _run(self, case):
        folder = self.folder / case.name
        wanted = not self.report and self._is_wanted(case.name)
        if wanted and not (self.keep and self._finished(case)):
            settings = list(case.settings) if case.pictures else [*case.settings, "outputs=[]", "renderers=[]"]
            command = [self.program, "run", self.root / f"workflows/{case.workflow}.yaml", "--output", folder, "--overwrite",
                       "--threads", "1"] + (["--variant", case.variant] if case.variant else [])
            for s in settings if case.seed is None else [f"seed={case.seed}", *settings]:
                command += ["--set", s]
            if self._logged(command, case.name):
                return None
        return Result(case, folder)


def mean(values):
    return statistics.fmean(values)


def spread(values):
    """Sample standard deviation; 0 of one value."""
    return statistics.stdev(values) if len(values) > 1 else 0.0
