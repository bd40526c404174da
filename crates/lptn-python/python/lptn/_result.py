"""Answers of questions."""

from __future__ import annotations

import html
import json
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

from . import _lptn
from ._messages import Error, Problem, problems

if TYPE_CHECKING:
    from ._column import Column

# Names the entries of a network made in code that problems are about.
Explain = Callable[[Error | list[Problem]], None]

# Most rows of a table in a notebook.
_SHOWN = 12


@cache
def _module() -> Any:
    """The module of columns, which imports NumPy."""
    from . import _column

    return _column


class Table:
    """The rows of an answer: columns of numbers with units, and columns of words."""

    def __init__(self, answer: Rows | Kept | _lptn.Answer, scalar: bool, index: Any = None) -> None:
        self._answer = answer
        self._scalar = scalar
        # of the frame of pandas that the rows belong to
        self._index = index
        self._numbers: dict[str, Column] = {}

    @cached_property
    def _columns(self) -> dict[str, str | None]:
        # of a table from which one column is read, they are not needed
        return dict(self._answer.columns())

    @cached_property
    def units(self) -> dict[str, str]:
        """The unit of each column of numbers."""
        return {name: unit for name, unit in self._columns.items() if unit is not None}

    @property
    def names(self) -> list[str]:
        """The names of all columns."""
        return list(self._columns)

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        if not self.names:
            return 0
        first: Any = self[self.names[0]]
        return len(first) if getattr(first, "ndim", 1) else 1

    def __getitem__(self, name: str) -> Column | Any:
        found = self._numbers.get(name)
        if found is None:
            found = self._column(name)
        if found is not None:
            return found
        words = self._answer.words(name) if name in self else None
        if words is None:
            raise KeyError(f"{name}: the columns are {', '.join(self.names[:20])}")
        return list(words)

    def _column(self, name: str) -> Column | None:
        """A column of numbers; `None` if it is one of words, or unknown."""
        read = self._answer.numbers(name) if isinstance(name, str) else None
        if read is None:
            return None
        unit, data = read
        index = None if name == "time" else self._numbers.get("time")
        if index is None and name != "time":
            index = self._column("time")
        made = _module().of_bytes(name, unit, data, index, self._scalar)
        self._numbers[name] = made
        return made

    def to_pandas(self, **words: Any) -> Any:
        """The rows as a pandas DataFrame; headings have the units, times are the index."""
        from . import _frames

        return _frames.pandas(self, words)

    def to_polars(self) -> Any:
        """The rows as a polars DataFrame; headings have the units."""
        from . import _frames

        return _frames.polars(self)

    def to_arrow(self) -> Any:
        """The rows as a table of Arrow, for Parquet too; fields have their unit as metadata."""
        from . import _frames

        return _frames.arrow(self)

    def to_xarray(self, title: str = "") -> Any:
        """The rows as an xarray Dataset over time; variables have the attribute `units`."""
        from . import _frames

        return _frames.xarray(self, title)

    @property
    def is_scalar(self) -> bool:
        """True if each column is one number, as in a steady state."""
        return self._scalar

    def head(self, name: str) -> str:
        """The heading of a column: `steel.T [degC]`."""
        return f"{name} [{self.units[name]}]" if name in self.units else name

    def __reduce__(self) -> Any:
        answer = self._answer
        kept = answer if isinstance(answer, Rows) else Kept.of(answer)
        return (Table, (kept, self._scalar, self._index))

    @property
    def index(self) -> Any:
        """The index of the frame of pandas that the rows belong to; `None` if there is none."""
        return self._index

    def __repr__(self) -> str:
        return f"<Table of {len(self)} rows: {', '.join(self.names[:8])}>"

    def _repr_html_(self) -> str:
        names = self.names[:_SHOWN]
        heads = "".join(f"<th>{html.escape(self.head(name))}</th>" for name in names)
        cells = [list(_cells(self[name])) for name in names]
        rows = list(zip(*cells))
        step = max(1, -(-len(rows) // _SHOWN))
        lines = ("".join(f"<td>{html.escape(cell)}</td>" for cell in row) for row in rows[::step])
        body = "".join(f"<tr>{line}</tr>" for line in lines)
        every = f"<p>every {step}th of {len(rows)} rows</p>" if step > 1 else ""
        return f"<table><thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>{every}"


def _cells(values: Any) -> Iterator[str]:
    if isinstance(values, list):
        yield from values
    else:
        yield from (f"{value:.6g}" for value in values.reshape(-1).tolist())


class Rows:
    """Columns of a table that no answer has: name, unit or `None` for words, cells."""

    def __init__(self, columns: Sequence[tuple[str, str | None, Sequence[Any]]]) -> None:
        self._cells = {name: (unit, list(cells)) for name, unit, cells in columns}

    def columns(self) -> list[tuple[str, str | None]]:
        return [(name, unit) for name, (unit, _) in self._cells.items()]

    def numbers(self, name: str) -> tuple[str, bytes] | None:
        unit, cells = self._cells.get(name, (None, []))
        return None if unit is None else (unit, array("d", cells).tobytes())

    def words(self, name: str) -> list[str] | None:
        unit, cells = self._cells.get(name, ("", []))
        return cells if unit is None else None


class Kept:
    """An answer that was pickled: its texts and numbers."""

    def __init__(self, answer: _lptn.Answer | Kept) -> None:
        self._texts = (answer.json(), answer.text(), answer.csv(), answer.svg(), answer.doubts())
        self._verdict = (answer.exit(), answer.reasons())
        self._columns = answer.columns()
        names = [name for name, _ in self._columns]
        self._cells = {name: (answer.numbers(name), answer.words(name)) for name in names}

    @classmethod
    def of(cls, answer: _lptn.Answer | Kept) -> Kept:
        """The same answer, kept."""
        return answer if isinstance(answer, Kept) else cls(answer)

    def json(self) -> str:
        return self._texts[0]

    def text(self) -> str:
        return self._texts[1]

    def csv(self) -> str:
        return self._texts[2]

    def svg(self) -> str | None:
        return self._texts[3]

    def doubts(self) -> str | None:
        return self._texts[4]

    def exit(self) -> int:
        return self._verdict[0]

    def reasons(self) -> list[str]:
        return self._verdict[1]

    def columns(self) -> list[tuple[str, str | None]]:
        return self._columns

    def numbers(self, name: str) -> tuple[str, bytes] | None:
        return self._cells.get(name, (None, None))[0]

    def words(self, name: str) -> list[str] | None:
        return self._cells.get(name, (None, None))[1]


def _again(kept: Kept, question: str, scalar: bool, title: str, index: Any) -> Result:
    return Result(kept, question, scalar, title=title)._of_frame(index)


class Result:
    """An answer: columns with units, limits, doubts, verdict, and its JSON.

    `result["steel.T"]` is a column. `print(result)` prints the table of the command line.
    """

    def __init__(
        self,
        answer: _lptn.Answer | Kept,
        question: str,
        scalar: bool,
        explain: Explain | None = None,
        title: Any = None,
    ) -> None:
        self._answer = answer
        self._explain = explain
        self._scalar = scalar
        self._table: Table | None = None
        self._data: dict[str, Any] | None = None
        self._doubts: list[Problem] | None = None
        self.question = question
        """The question: `run`, `fit network`."""
        # a network is asked for its title when it is needed
        self._titled: Any = title or question
        self._index: Any = None
        self._case: Any = None

    def _of_frame(self, index: Any, words: Mapping[str, Any] | None = None) -> Result:
        """The same of these words, whose rows have the index of the frame of candidates."""
        self._index, self._case = index, (words or {}).get("case")
        return self

    @property
    def title(self) -> str:
        """The title of the network, or the question if it is about several."""
        return self._titled if isinstance(self._titled, str) else self._titled.title

    def json(self) -> str:
        """The object that `--format json` prints, to the byte."""
        return self._answer.json()

    @property
    def data(self) -> dict[str, Any]:
        """The same object, read."""
        if self._data is None:
            self._data = json.loads(self._answer.json())
        return self._data or {}

    def csv(self) -> str:
        """The rows that `--format csv` prints."""
        return self._answer.csv()

    @property
    def table(self) -> Table:
        """The rows."""
        if self._table is None:
            self._table = Table(self._answer, self._scalar, self._index)
        return self._table

    def __getitem__(self, name: str) -> Column | Any:
        """A column; a list of texts if its cells are words.

        A run with `uncertainty` has for a node `steel.T`, the standard deviation `steel.T.sd` and
        the band of 95 %, `steel.T.low` and `steel.T.high`.
        """
        if name not in self.table:
            found = self._certain.get(name)
            if found is not None:
                return found
        return self.table[name]

    @cached_property
    def _certain(self) -> dict[str, Column]:
        """The columns without a band of a run with `uncertainty`, which its rows leave out."""
        if self.question != "run" or "uncertainty" not in self.data:
            return {}
        return _module().of_json(self.data["columns"], self.data["rows"])

    def __contains__(self, name: object) -> bool:
        return name in self.table or name in self._certain

    def __iter__(self) -> Iterator[str]:
        return iter(self.table)

    def keys(self) -> list[str]:
        """The names of the columns."""
        return self.table.names

    def to_pandas(self, **words: Any) -> Any:
        """The rows as a pandas DataFrame; headings have the units, times are the index."""
        return self.table.to_pandas(**words)

    def to_polars(self) -> Any:
        """The rows as a polars DataFrame; headings have the units."""
        return self.table.to_polars()

    def to_arrow(self) -> Any:
        """The rows as a table of Arrow, for Parquet too; fields have their unit as metadata."""
        return self.table.to_arrow()

    def to_xarray(self) -> Any:
        """The rows as an xarray Dataset over time; variables have the attribute `units`."""
        return self.table.to_xarray(self.title)

    @property
    def ledger(self) -> Table:
        """The energy balance of a run: heat of sources, boundaries, streams and masses into the
        network, heat stored in nodes, and the residual, each with its name.
        """
        from ._heats import ledger

        if "ledger" not in self.data:
            raise TypeError(f"`{self.question}` has no energy balance: a run has one")
        return ledger(self.data["ledger"])

    @property
    def balance(self) -> Table:
        """The heat balance of the node or boundary that was asked for, `net.run(balance="steel")`:
        power and heat of each of its paths and sources, positive into it.
        """
        from ._heats import balance

        if "balance" not in self.data:
            raise TypeError(
                'no balance was asked for: run(balance="steel") has that of a node, and run.ledger '
                "the energy balance of a run"
            )
        return balance(self.data["balance"])

    @property
    def failures(self) -> dict[int, Problem]:
        """The problem of each candidate of a sweep that failed, by its number, `case`."""
        from ._frame import failures

        network = None if isinstance(self._titled, str) else self._titled
        return failures(network, self)

    @property
    def limits(self) -> dict[str, Any]:
        """The limits by name: bound, worst value, margin, `kept` or not."""
        return self.data.get("limits") or {}

    @property
    def doubts(self) -> list[Problem]:
        """Doubts about the numbers."""
        if self._doubts is None:
            self._doubts = problems(self._answer.doubts())
            if self._explain is not None:
                self._explain(self._doubts)
        return self._doubts

    @property
    def ok(self) -> bool:
        """True if the answer is yes: no limit is broken, no error is too large."""
        return self._answer.exit() == 0

    @property
    def verdict(self) -> list[str]:
        """A sentence for each reason why the answer is no, such as a broken limit."""
        return self._answer.reasons()

    def svg(self) -> str | None:
        """The picture that `--plot` draws; `None` if there is none."""
        return self._answer.svg()

    def plot(self, *names: str, ax: Any = None, title: str | None = None, **words: Any) -> Any:
        """Draws columns, or all temperatures, with their limits and bands, by matplotlib.

        They are in `ax` or in a new figure, which has a panel for each unit and the title of the
        network. Gives the axes; an array of them for several panels.
        """
        from ._plot import drawn

        return drawn(self, names, ax, title, words)

    def __reduce__(self) -> Any:
        kept = Kept.of(self._answer)
        return (_again, (kept, self.question, self._scalar, self.title, self._index))

    def __str__(self) -> str:
        return self._answer.text()

    def __repr__(self) -> str:
        state = "" if self.ok else f", no: {'; '.join(self.verdict)}"
        return f"<{self.question}: {len(self.table.names)} columns{state}>"

    def _repr_html_(self) -> str:
        parts = [f"<pre>{html.escape(str(self))}</pre>", self.svg() or ""]
        parts += [f"<p><b>{html.escape(reason)}</b></p>" for reason in self.verdict]
        doubts = "".join(f"<li>{html.escape(str(doubt))}</li>" for doubt in self.doubts)
        return "".join(parts) + (f"<p>doubts</p><ul>{doubts}</ul>" if doubts else "")
