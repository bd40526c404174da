"""Questions that are not about one network."""

from __future__ import annotations

from typing import Any

from ._network import asked
from ._result import Result


def check(file: Any, **words: Any) -> Result:
    """Checks a netlist and shows all its problems; `result.ok` is false if there are errors."""
    return asked("check", [file], words)


def compare(*netlists: Any, **words: Any) -> Result:
    """Compares designs: `lptn.compare("a.toml", "b.toml", sort="peak")`."""
    return asked("compare", list(netlists), words)


def size(**words: Any) -> Result:
    """Finds the flow that removes a heat: power, limit and ambient, perhaps rise."""
    return asked("size", [], words)


def fit_step(record: Any, **words: Any) -> Result:
    """Fits one exponential to a record, or several (`terms`)."""
    return asked("fit step", [], {"record": record, **words})


def fit_law(points: Any = None, **words: Any) -> Result:
    """Fits laws over speed to points or to a folder of records."""
    return asked("fit law", [], {"points": points, **words})


def fit_compare(*netlists: Any, **words: Any) -> Result:
    """Chooses between networks by their records."""
    return asked("fit compare", list(netlists), words)
