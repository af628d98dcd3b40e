# SPDX-License-Identifier: BSD-3-Clause
"""The results of one run."""
from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Any

from .columns import Table, read_table
from .errors import Damaged, NeedsPackage, NotResults, NotThere, ResultsError, did_you_mean
from .files import UNFINISHED, manifests, read_text
from .frames import Cracks, Frames
from .summary import Quantity, Summary

FINISHED, INTERRUPTED, UNFINISHED_RUN = "finished", "interrupted", "unfinished"


class Run:
    """What a run left in its folder. Each part is read when it is first asked for, and kept.

    folder  as it was given
    place   where the files are: the folder, or `unfinished` within it
    state   "finished"; "interrupted": stopped on request, with its files complete; "unfinished": it failed, was
            killed, or is still at work: there is no summary, and the curves go as far as they were written
    """

    def __init__(self, folder: str | Path) -> None:
        """NotResults if the folder is not one of a run of Breccia; Damaged if that cannot be told."""
        self.folder = Path(folder)
        whole, growing = manifests(self.folder)
        manifest = whole or growing
        assert manifest is not None  # one of the two is there
        if manifest.kind != "run":
            what = "; read it by `open_study`" if manifest.kind == "study" else ""
            raise NotResults(f"{self.folder}: holds a {manifest.kind}, not a run{what}")
        self.place = self.folder if whole is not None else self.folder / UNFINISHED
        if (self.place / "summary.json").is_file():
            stopped = self.summary.get("interrupted", False) or not manifest.finished
            self.state = INTERRUPTED if stopped else FINISHED
        elif whole is not None and whole.finished:
            raise Damaged(f"{self.folder}: its `summary.json` was removed after the run")
        else:
            self.state = UNFINISHED_RUN
        self._newer = growing is not None and whole is not None

    @property
    def finished(self) -> bool:
        """Whether the run came to its own end."""
        return self.state == FINISHED

    @property
    def newer_unfinished(self) -> bool:
        """Whether a later run in the same folder came to no end (or is at work); these results are the earlier ones."""
        return self._newer

    @property
    def name(self) -> str:
        """Of the folder."""
        return self.folder.resolve().name

    @cached_property
    def summary(self) -> Summary:
        """The numbers. NotThere if the run came to no end, Damaged."""
        file = self.place / "summary.json"
        if not file.is_file():
            raise NotThere(f"{self.folder}: has no summary: the run has not come to its end")
        return Summary.load(file)

    def quantity(self, name: str) -> Quantity:
        """A number of the summary with its unit: `run.quantity("peak_stress")`. NotThere, Damaged."""
        return self.summary.quantity(name)

    @cached_property
    def curves(self) -> Table:
        """curves.csv, a row for each sample; of a run that came to no end, what was written. NotThere, Damaged."""
        for name, growing in (("curves.csv", self.state == UNFINISHED_RUN), ("curves.csv.partial", True)):
            if (self.place / name).is_file():
                return read_table(self.place / name, self.place / "curves.json", growing)
        raise NotThere(f"{self.place}: has no curves")

    @cached_property
    def tables(self) -> dict[str, Table]:
        """Tables of post-processors by name, of the files in `tables/`. Damaged."""
        return {file.stem: read_table(file, file.with_suffix(".json"))
                for file in sorted((self.place / "tables").glob("*.csv"))}

    def frames(self, what: str = "particles", output: str = "") -> Frames:
        """The frames of "particles", "bonds" or "walls". `output`: of an output that has a name (`fine`), or of the
        folder that it wrote (`fine_vtk`). NotThere, Damaged."""
        folders = [self.place] if not output else [self.place / output, *sorted(self.place.glob(f"{output}_*"))]
        for folder in folders:
            if (folder / f"{what}.pvd").is_file():
                return Frames.load(folder / f"{what}.pvd")
        there = sorted(f.relative_to(self.place).as_posix() for f in
                       (*self.place.glob("*.pvd"), *self.place.glob("*/*.pvd")))
        raise NotThere(f"{self.folder}: has no frames of {what}" + (f" by an output `{output}`" if output else "")
                       + (f"; there are {', '.join(there)}" if there else ": the run wrote no output `vtk`"))

    @property
    def particles(self) -> Frames:
        """NotThere if the run wrote none, Damaged."""
        return self.frames("particles")

    @property
    def bonds(self) -> Frames:
        """The bonds that were made at the start, intact and broken. NotThere if the run wrote none, Damaged."""
        return self.frames("bonds")

    @property
    def walls(self) -> Frames:
        """NotThere if the run wrote none, Damaged."""
        return self.frames("walls")

    @property
    def cracks(self) -> Cracks:
        """All bonds that had broken when the last frame was written. NotThere if the run wrote none, Damaged."""
        bonds = self.bonds
        if not len(bonds):
            raise NotThere(f"{bonds.file}: has no frames")
        return Cracks.of(bonds[-1])

    @cached_property
    def workflow(self) -> dict[str, Any]:
        """`resolved.yaml`: the whole input with all defaults; quantities are texts with units (`10 GPa`).
        NotThere, Damaged, NeedsPackage."""
        try:
            import yaml
        except ImportError:
            raise NeedsPackage("the resolved workflow needs PyYAML (Debian: python3-yaml)") from None
        file = self.place / "resolved.yaml"
        try:
            read = yaml.safe_load(read_text(file))
        except yaml.YAMLError:
            raise Damaged(f"{file}: is no YAML: cut off, or changed by hand") from None
        if not isinstance(read, dict):
            raise Damaged(f"{file}: is no workflow")
        return read

    def setting(self, path: str) -> Any:
        """A value of the resolved workflow by the path that `--set` takes: `contact_law.friction`, `outputs[0].type`.
        NotThere, Damaged, NeedsPackage."""
        at: Any = self.workflow
        done = ""
        for part in path.replace("[", ".").replace("]", "").split("."):
            known: list[str] = []
            if isinstance(at, (dict, list)):
                known = [str(k) for k in (at if isinstance(at, dict) else range(len(at)))]
            if part not in known:
                where = f"`{done}`" if done else "the workflow"
                raise NotThere(f"{self.place / 'resolved.yaml'}: {where} has no `{part}`{did_you_mean(part, known)}")
            at = at[part] if isinstance(at, dict) else at[int(part)]
            done = f"{done}.{part}".lstrip(".")
        return at

    def __repr__(self) -> str:
        return f"<run {self.folder}, {self.state}>"


def is_run(folder: Path) -> bool:
    """Whether a folder holds a run of Breccia that can be opened."""
    try:
        Run(folder)
    except ResultsError:
        return False
    return True
