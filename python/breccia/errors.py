# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong with results, in one line each: what, where, what to do instead."""
from __future__ import annotations

import difflib
from collections.abc import Iterable


class ResultsError(Exception):
    """Of everything below; its text is made to be shown to a person as it stands."""


class NotResults(ResultsError):
    """A folder that Breccia did not write, or one of another kind than asked for."""


class Damaged(ResultsError):
    """A file that Breccia wrote and that is not whole any more, or of a format that this package does not know."""


class NotThere(ResultsError, KeyError):
    """A result, curve, array or file that these results do not have."""

    def __str__(self) -> str:
        return str(self.args[0])  # KeyError would show it in quotes


class NeedsPackage(ResultsError):
    """A Python package that is not installed."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """The end of a message: the known name that looks most like this one, or how many there are."""
    names = list(known)
    near = difflib.get_close_matches(name, names, n=1)
    if near:
        return f"; did you mean `{near[0]}`?"
    if 0 < len(names) <= 12:
        return "; there are " + ", ".join(f"`{n}`" for n in names)
    return f"; there are {len(names)} others" if names else ""
