# SPDX-License-Identifier: BSD-3-Clause
"""Texts, JSON and CSV of a results folder, and `breccia.json`, which says whose it is."""
from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .errors import Damaged, NotResults, NotThere

MANIFEST = "breccia.json"
FORMAT = "breccia results 1"
UNFINISHED = "unfinished"


def read_text(file: Path) -> str:
    """A text in UTF-8. NotThere if there is no such file, Damaged if it is no text."""
    try:
        return file.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise NotThere(f"{file}: is not there") from None
    except UnicodeDecodeError:
        raise Damaged(f"{file}: is not a text in UTF-8") from None
    except OSError as error:
        raise NotThere(f"{file}: cannot be read: {error.strerror}") from None


def read_json(file: Path) -> Any:
    """What a JSON file says. NotThere, Damaged."""
    try:
        return json.loads(read_text(file))
    except (json.JSONDecodeError, RecursionError) as error:
        where = f":{error.lineno}:{error.colno}" if isinstance(error, json.JSONDecodeError) else ""
        raise Damaged(f"{file}{where}: is no JSON: cut off, or changed by hand") from None


def read_object(file: Path) -> dict[str, Any]:
    """A JSON file that must be a mapping. NotThere, Damaged."""
    read = read_json(file)
    if not isinstance(read, dict):
        raise Damaged(f"{file}: is no JSON object")
    return read


def read_rows(file: Path, growing: bool = False) -> tuple[list[str], list[list[str]]]:
    """Head and rows of a CSV file. Each row has a cell for each of the head, or the file is Damaged; of one that
    is still `growing` the last row may be in the middle of being written, and is left out."""
    text = read_text(file)
    rows = [row for row in csv.reader(text.splitlines()) if row]
    if not rows:
        raise Damaged(f"{file}: is empty")
    head, body = rows[0], rows[1:]
    if growing and body and not text.endswith("\n"):
        body.pop()
    for number, row in enumerate(body, 2):
        if len(row) != len(head):
            raise Damaged(f"{file}:{number}: has {len(row)} cells where the head has {len(head)}")
    return head, body


@dataclass(frozen=True)
class Manifest:
    """`breccia.json`: what Breccia wrote into a folder."""

    kind: str  # run, study, comparison
    finished: bool
    files: tuple[str, ...]  # relative to the folder

    @staticmethod
    def read(folder: Path) -> Manifest | None:
        """None if the folder has none. Damaged if there is one that cannot be read or is of another format."""
        file = folder / MANIFEST
        if not file.is_file():
            return None
        read = read_object(file)
        said = read.get("format")
        if said != FORMAT:
            raise Damaged(f"{file}: is of the format `{said}`; this package reads `{FORMAT}`")
        files = read.get("files", [])
        return Manifest(str(read.get("kind", "run")), read.get("finished") is True,
                        tuple(f for f in files if isinstance(f, str)) if isinstance(files, list) else ())


def manifests(folder: Path) -> tuple[Manifest | None, Manifest | None]:
    """Of the results in a folder and of those that grow or were left in it. NotResults if it has neither."""
    if not folder.is_dir():
        is_file = "is a file; the folder that it is in is wanted" if folder.exists() else "there is no such folder"
        raise NotResults(f"{folder}: {is_file}")
    whole, growing = Manifest.read(folder), Manifest.read(folder / UNFINISHED)
    if whole is None and growing is None:
        hint = ""
        if (folder / "summary.json").is_file():
            hint = " (a `summary.json` alone does not say so: was the folder copied in part, or is it of version 0.1?)"
        raise NotResults(f"{folder}: is no folder of Breccia's results: it has no `{MANIFEST}`{hint}")
    return whole, growing
