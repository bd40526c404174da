"""Questions that are not about one network."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from ._memory import FRAME, File, csv, files, is_frame, named
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
    """Fits one exponential to a record, or several (`terms`): a CSV file or a frame."""
    if not is_frame(record):
        return asked("fit step", [], {"record": named("record", record), **words})
    return asked("fit step", [], {"record": FRAME, **words}, [(FRAME, csv(record))])


def fit_law(points: Any = None, **words: Any) -> Result:
    """Fits laws over speed to points, a CSV file or a frame; or to records, a folder or a dictionary
    of frames by the names of files, with speeds in the names or in the frame "runs.csv":

        lptn.fit_law({"1000rpm.csv": slow, "2000rpm.csv": fast}, capacity="2659 J/K")
    """
    memory: list[File] = []
    if is_frame(points):
        memory = [(FRAME, csv(points))]
    elif isinstance(points, Mapping) and points:
        memory = [(os.path.join(FRAME, name), one) for name, one in files(points, "points")]
    about = FRAME if memory else named("points", points)
    return asked("fit law", [], {"points": about, **words}, memory)


def fit_compare(*netlists: Any, **words: Any) -> Result:
    """Chooses between networks by their records."""
    return asked("fit compare", list(netlists), words)
