"""Frames as CSV files in memory, for everything that reads files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import Any

from . import _lptn
from ._messages import Error, Problem
from ._result import Result, Table

# The path of a frame, and its bytes.
File = tuple[str, bytes]

# The path of a frame that has none of its own.
FRAME = "frame"


def is_frame(value: Any) -> bool:
    """True for a DataFrame, a result, a table, and a dictionary of columns."""
    if isinstance(value, Mapping):
        return bool(value) and all(map(_is_column, value.values()))
    return hasattr(value, "columns") or isinstance(value, (Result, Table))


def _is_column(value: Any) -> bool:
    values = value[0] if _is_pair(value) else value
    if isinstance(values, (list, tuple)):
        return not any(map(is_frame, values))
    return getattr(values, "ndim", 0) == 1 or hasattr(values, "to_numpy") and not is_frame(values)


def _is_pair(value: Any) -> bool:
    """True for values with their unit: `([0, 10], "min")`."""
    return isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str)


def files(given: Mapping[str, Any] | None, word: str = "files") -> list[File]:
    """Files in memory: frames by their paths."""
    if given is None:
        return []
    if not isinstance(given, Mapping) or not all(map(is_frame, given.values())):
        raise TypeError(f'`{word}` takes frames by their names: {{"record.csv": frame}}')
    return [(os.fspath(path), csv(frame)) for path, frame in given.items()]


def named(word: str, value: Any) -> Any:
    """The name of a file, perhaps `None`."""
    if value is not None and not isinstance(value, (str, bytes, os.PathLike)):
        kind = type(value).__name__
        raise TypeError(f"`{word}` takes a CSV file, a DataFrame or a dictionary of columns, not {kind}")
    return os.fsdecode(value) if value is not None else None


def csv(frame: Any) -> bytes:
    """The bytes of the CSV file with the columns of a frame."""
    columns = [_cells(heading, column) for heading, column in _columns(frame)]
    lengths = {heading: count for heading, count, _ in columns}
    if len(set(lengths.values())) != 1:
        listed = ", ".join(f"{heading} {count}" for heading, count in lengths.items()) or "none"
        raise TypeError(f"a frame has columns of one length, at least one: it has {listed}")
    return _lptn.csv([(heading, cells) for heading, _, cells in columns])


def _columns(frame: Any) -> Iterable[tuple[str, Any]]:
    """The headings, with units where the columns have them, and the columns."""
    frame = frame.table if isinstance(frame, Result) else frame
    if isinstance(frame, Table):
        return [(name, frame[name]) for name in frame.names]
    if hasattr(frame, "reset_index"):
        frame = _with_index(frame)
    # polars has `columns`, dictionaries have `keys`, pandas both
    heads = frame.columns if hasattr(frame, "columns") else frame
    return [(_heading(head), frame[head]) for head in heads]


def _with_index(frame: Any) -> Any:
    """A frame of pandas with the index as a column, if it has names or times."""
    index = frame.index
    kind = getattr(index.dtype, "kind", "")
    if all(name is None for name in index.names) and kind not in "mM":
        return frame
    if index.names == [None]:
        frame = frame.rename_axis("time")
    return frame.reset_index()


def _heading(head: Any) -> str:
    """`ring [degC]`; pint-pandas has names and units as pairs."""
    if isinstance(head, tuple) and len(head) == 2:
        return f"{head[0]} [{head[1]}]"
    return str(head)


def _cells(heading: str, column: Any) -> tuple[str, int, bytes | list[str]]:
    """The heading with its unit, the number of cells, and the cells."""
    from ._numpy import np

    unit = getattr(column, "unit", None)
    if _is_pair(column):
        column, unit = column
    # a steady state has one number
    values = np.atleast_1d(np.asarray(column))
    if values.ndim != 1:
        raise TypeError(f"column `{heading}` of the frame has {values.ndim} dimensions, not one")
    if values.dtype.kind in "OSU":
        values = _of_objects(values)
    if values.dtype.kind == "m":
        # times since the start, in s
        values, unit = values / np.timedelta64(1, "s"), "s"
    if isinstance(unit, str) and "[" not in heading:
        heading = f"{heading} [{'-' if unit in ('', '1') else unit}]"
    if values.dtype.kind in "fiu":
        return heading, len(values), np.ascontiguousarray(values, dtype=np.float64).tobytes()
    return heading, len(values), _words(values)


def _words(values: Any) -> list[str]:
    from ._numpy import np

    if values.dtype.kind != "M":
        return [" ".join(str(cell).split()) for cell in values.tolist()]
    texts = np.datetime_as_string(values).tolist()
    return ["" if text == "NaT" else text.replace("T", " ") for text in texts]


def _of_objects(values: Any) -> Any:
    """Numbers, durations or texts of Python; a cell that is missing is empty."""
    from ._numpy import np

    cells = values.tolist()
    missing = [cell is None or str(cell) in ("<NA>", "NaT") for cell in cells]
    there = [cell for cell, no in zip(cells, missing) if not no]
    if there and all(hasattr(cell, "total_seconds") for cell in there):
        return np.array([None if no else cell for cell, no in zip(cells, missing)], dtype="m8[us]")
    if all(hasattr(cell, "__float__") for cell in there):
        return np.array([np.nan if no else float(cell) for cell, no in zip(cells, missing)])
    return np.array(["" if no else str(cell) for cell, no in zip(cells, missing)])


def merged(old: list[File], new: list[File]) -> list[File]:
    """All files; a new one takes the place of an old one of its name."""
    return list({**dict(old), **dict(new)}.items())


def records(question: str, names: list[str], given: Any) -> list[File]:
    """The frames in the place of the records of a study: one, a list, or by their names."""
    frames: dict[str, Any]
    if is_frame(given):
        given = [given]
    if isinstance(given, Mapping):
        other = [name for name in given if name not in names]
        if other:
            raise TypeError(f"`data`: {question} has no record {other[0]!r}: {', '.join(names)}")
        frames = dict(given)
    elif isinstance(given, (list, tuple)) and len(given) == len(names):
        frames = dict(zip(names, given))
    elif isinstance(given, (list, tuple)):
        by = ", ".join(f'"{name}": frame' for name in names)
        count = f"{len(names)} record{'s' if len(names) > 1 else ''}"
        raise TypeError(f"`data`: {question} has {count}: data={{{by}}}")
    else:
        raise TypeError(f"`data` takes a DataFrame or a dictionary of columns, not {given!r}")
    wrong = [frame for frame in frames.values() if not is_frame(frame)]
    if wrong:
        raise TypeError(f"`data` takes a DataFrame or a dictionary of columns, not {wrong[0]!r}")
    return [(name, csv(frame)) for name, frame in frames.items()]


def explain(of: Error | list[Problem], names: Iterable[str]) -> None:
    """Places in frames are rows, not lines."""
    known = set(names)
    for problem in of.errors if isinstance(of, Error) else of:
        for place in problem.places:
            # the first line is the heading
            if place.file in known:
                place.row = place.line - 2
    if isinstance(of, Error):
        of.refresh()
