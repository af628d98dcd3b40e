# SPDX-License-Identifier: BSD-3-Clause
"""A validation report: Markdown for people, the same numbers as JSON, and which of its pictures the tree has."""
import collections
import dataclasses
import fnmatch
import json
import math
import re
import shutil

from .runs import mean, spread

PICTURE = re.compile(r"!\[[^\]]*\]\(([^)]+)\)")


class Report:
    def __init__(self):
        self.lines = []
        self.missed = []      # targets that were not met
        self.comparisons = []  # of `compared`
        self.tables = []
        self.heading = ""

    def text(self, *paragraphs):
        for p in paragraphs:
            if p.startswith("#"):
                self.heading = p.strip().split("\n")[0].lstrip("# ")
            self.lines += [p.strip(), ""]

    def table(self, head, rows):
        rows = [list(map(str, row)) for row in rows]
        self.tables.append({"under": self.heading, "columns": list(map(str, head)), "rows": rows})
        self.lines += ["| " + " | ".join(row) + " |" for row in [list(map(str, head)), ["---"] * len(head), *rows]] + [""]

    def compared(self, what, values, published, unit=1, digits=2, target=None):
        """A row: mean and spread of the runs beside the published number, and whether the target (a share) is met."""
        values = [v / unit for v in values]
        published /= unit
        away = mean(values) / published - 1 if published else float("nan")
        verdict = "" if target is None else "yes" if abs(away) <= target else "**no**"
        if verdict == "**no**":
            self.missed.append(f"{what}: {away:+.1%} (asked: within {target:.0%})")
        scatter = f" ± {spread(values):.{digits}f}" if len(values) > 1 else ""
        self.comparisons.append({"under": self.heading, "what": what, "values": values, "mean": mean(values), "deviation": spread(values),
                                 "published": published, "distance": away, "within": target, "met": None if target is None else verdict == "yes"})
        return [what, f"{mean(values):.{digits}f}{scatter}", f"{published:.{digits}f}",
                f"{away:+.1%}", verdict]

    def finish(self, runner, paper, head, shown):
        """Puts what was missed and what was not run before line `head` and writes the report: whole, with all pictures and
        the numbers, beside the results; if it is of the whole paper also into docs, with the pictures that are `shown`."""
        targets = ["## Targets not met", ""] + ([f"- {m}" for m in self.missed] or ["None of those that were measured."]) + [""]
        if runner.missing:
            targets += ["Not run, and left out below: " + ", ".join(f"`{m}`" for m in runner.missing) + ".", ""]
        earlier = [c for cases in runner.studies.values() for c in cases if c.earlier]
        if earlier:
            programs = collections.Counter(c.program for c in earlier)
            targets += [f"Of the {sum(map(len, runner.studies.values()))} cases of the studies these are of earlier sittings, known again by the hash of their inputs: "
                        + ", ".join(f"{n} by version {p}" for p, n in sorted(programs.items())) + ".", ""]
        self.lines[head:head] = targets
        text = "\n".join(self.lines).rstrip() + "\n"
        file = runner.folder / f"{paper}.md"
        file.write_text(text)
        file.with_suffix(".json").write_text(written(self.numbers(runner, paper)))
        if not runner.is_part:
            docs = runner.root / "docs/validation"
            (docs / f"{paper}.md").write_text(published(text, paper, runner.folder, docs, shown))
            shutil.copy(file.with_suffix(".json"), docs)
            file = docs / f"{paper}.md"
        print(f"wrote {file}; {len(self.missed)} targets not met, {len(runner.missing)} missing")

    def numbers(self, runner, paper):
        """All that was measured, as data; SI where a key ends in a unit."""
        units, runs = {}, {}
        for case, result in sorted(runner.results.items(), key=lambda item: item[0].name):
            found = {key: q for key, q in result.summary.quantities().items() if "." not in key}
            units |= {key: q.unit for key, q in found.items() if q.unit != "1"}
            runs[case.name] = {"workflow": case.workflow, "variant": case.variant, "settings": list(case.settings), "values": {key: q.value for key, q in found.items()}}
        studies = {name: [{k: v for k, v in dataclasses.asdict(c).items() if k != "earlier"} for c in cases] for name, cases in runner.studies.items()}
        return {"format": 1, "paper": paper, "made_by": f"tools/validate {paper}" + (f" --variant {runner.variant}" if runner.variant else ""),
                "comparisons": self.comparisons, "targets_not_met": self.missed, "not_run": runner.missing, "tables": self.tables,
                "runs": runs, "units": units, "studies": studies}


def written(numbers):
    """As JSON: a line for each run, comparison, table; nine digits; what was not measured is null."""
    def plain(value):
        if isinstance(value, dict):
            return {k: plain(v) for k, v in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(v) for v in value]
        if isinstance(value, float):
            return float(f"{value:.9g}") if math.isfinite(value) else None
        return value

    def one_line(value):
        return json.dumps(plain(value), ensure_ascii=False)
    parts = []
    for key, value in numbers.items():
        if isinstance(value, list) and value:
            parts.append(f'"{key}": [\n  ' + ",\n  ".join(map(one_line, value)) + "\n ]")
        elif isinstance(value, dict) and value:
            parts.append(f'"{key}": {{\n  ' + ",\n  ".join(f"{json.dumps(k)}: {one_line(v)}" for k, v in value.items()) + "\n }")
        else:
            parts.append(f'"{key}": {one_line(value)}')
    return "{\n " + ",\n ".join(parts) + "\n}\n"


def published(text, paper, source, docs, shown):
    """The report for the tree: with those of its pictures whose names match one of the patterns `shown`; these are copied
    from `source`. A figure of which nothing is shown goes with its caption. Says where the numbers are."""
    folder, kept = docs / paper, set()

    def is_shown(file):
        return any(fnmatch.fnmatch(file.rpartition("/")[2], pattern) for pattern in shown)
    lines, left_out = [], 0
    for line in text.split("\n"):
        pictures = list(PICTURE.finditer(line))
        if pictures and line.startswith("!["):
            here = [p for p in pictures if is_shown(p[1])]
            left_out += len(pictures) - len(here)
            kept |= {p[1].rpartition("/")[2] for p in here}
            if not here:
                while lines and not lines[-1].strip():
                    lines.pop()
                if lines and lines[-1].startswith("**"):
                    lines.pop()  # the caption
                continue
            line = " ".join(p[0] for p in here)
        lines.append(line)
    more = f"; the report that `tools/validate {paper}` leaves beside the results has {left_out} pictures more" if left_out else ""
    first = next((k for k, line in enumerate(lines) if line.startswith("## ")), len(lines))
    lines[first:first] = [f"The same numbers as data: [{paper}.json]({paper}.json){more}.", ""]
    pictures = {name: (source / paper / name).read_bytes() for name in sorted(kept)}
    shutil.rmtree(folder, ignore_errors=True)
    for name, data in pictures.items():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines))


def kept(holds):
    return "kept" if holds else "**not kept**"


def tables_of(text):
    """The tables of a report's Markdown, as `Report.tables` has them."""
    tables, heading, before = [], "", ""
    for line in text.split("\n"):
        cells = [c.strip() for c in line.strip().removeprefix("|").removesuffix("|").split(" | ")]
        if line.startswith("#"):
            heading = line.lstrip("# ")
        elif line.startswith("| ") and not before.startswith("|"):
            tables.append({"under": heading, "columns": cells, "rows": []})
        elif line.startswith("| ") and set(cells) != {"---"}:
            tables[-1]["rows"].append(cells)
        before = line
    return tables
