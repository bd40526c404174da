"""Questions to a network."""

from __future__ import annotations

import os
from typing import Any

from . import _lptn
from ._messages import Error, Problem, warn
from ._progress import shown
from ._result import Explain, Result
from ._values import given as given_values


# Options of every question with parameters.
MORE = [
    ("progress", "True shows a bar of tqdm; a function gets done, all and their unit"),
    ("set", 'parameters whose names Python cannot write: {"fan.G": "2 W/K"}'),
    ("options", 'options of the names of parameters: {"balance": "steel"}'),
]


# An option of questions that read records.
DATA = ("data", "frames in the place of the study's records: one, a list, or by their names")
RECORDS = ("fit network", "infer")


def answered(
    answer: _lptn.Answer,
    question: str,
    words: dict[str, Any],
    level: int,
    explain: Explain | None = None,
    network: Any = None,
) -> Result:
    """The result of an answer; doubts are warnings, an answer that is not whole is an error."""
    scalar = question == "steady" and not words.get("periodic")
    result = Result(answer, question, scalar, explain, network)
    exit = answer.exit()
    if exit > 1:
        errors = [Problem(data) for data in result.data.get("errors", [])]
        error = Error(errors or [_none(result)], exit, result.doubts, result)
        if explain is not None:
            explain(error)
        raise error
    if answer.doubts() is not None:
        warn(result.doubts, level + 1)
    return result


def more(question: str, sets: bool) -> list[tuple[str, str]]:
    """Options of a question that the package adds."""
    return [*([DATA] if question in RECORDS else []), *(MORE if sets else [])]


def _none(result: Result) -> Problem:
    """The problem of an answer that does not say its errors: of a sweep without a candidate."""
    codes = result.table["failed"] if "failed" in result else []
    message, code = "; ".join(result.verdict) or f"{result.question} has no whole answer", ""
    if any(codes):
        count, first = sum(map(bool, codes)), next(k for k, code in enumerate(codes) if code)
        case, code = int(result["case"][first]), codes[first]
        message = f"{count} of {len(codes)} candidates failed; candidate {case}: {code}"
    return Problem({"code": code, "severity": "error", "message": message})


def paths(netlists: tuple[Any, ...]) -> list[str]:
    """The files of netlists: names, paths, or networks that were loaded from files."""
    files: list[str] = []
    for netlist in netlists:
        if getattr(netlist, "_set", None):
            raise TypeError("a network with parameters is not a file: name the file, and write set={}")
        if getattr(netlist, "_files", None):
            raise TypeError("a network with frames is not a file: its frames are not on the disk")
        file = getattr(netlist, "file", netlist)
        if file is None:
            raise TypeError("a network from a text is not a file: write it into one")
        files.append(os.fspath(file))
    return files


def _method(name: str, first: str | None, several: bool) -> Any:
    """A method of this question. `first` is the option that needs no name."""

    def ask(self: Any, *given: Any, **words: Any) -> Result:
        others: list[str] = []
        call = f"{method_name(name)}()"
        if several:
            if given and self._set:
                raise TypeError(f"{call} would set the parameters of {self!r} in every netlist")
            if self._files:
                raise TypeError(f"{call} reads files: the frames of {self!r} are not on the disk")
            others = paths(given)
        elif given:
            if first is None or len(given) > 1 or first in words:
                raise TypeError(f"{call} takes no such argument without a name")
            words[first] = given[0]
        data = words.pop("data", None) if name in RECORDS else None
        explain = self._explain
        if data is not None:

            def explain(of: Error | list[Problem]) -> None:
                self._explain(of, data=True)

        asked = (others, data, explain)
        if "progress" in words:
            with shown(words) as words:
                answer, words = of(self, asked, words)
        else:
            answer, words = of(self, asked, words)
        about = None if several and given else self
        return answered(answer, name, words, 2, explain, about)

    def of(
        self: Any, asked: tuple[list[str], Any, Explain], words: dict[str, Any]
    ) -> tuple[_lptn.Answer, dict[str, Any]]:
        others, data, explain = asked
        try:
            words = given_values(words, lambda: self._netlist, name == "compare")
            netlist = self._netlist
            if data is not None:
                netlist = self._with_data(name, words.get("name"), data)
            return netlist.ask(name, others, words), words
        except Error as error:
            explain(error)
            raise

    return ask


class Questions:
    """The questions of the command line, each a method; `_lptn.questions` declares them."""

    _set: dict[str, Any]

    @property
    def _files(self) -> list[tuple[str, bytes]]:
        raise NotImplementedError

    @property
    def _netlist(self) -> _lptn.Netlist:
        raise NotImplementedError

    def _with_data(self, question: str, study: str | None, data: Any) -> _lptn.Netlist:
        raise NotImplementedError

    def _explain(self, of: Error | list[Problem], data: bool = False) -> None:
        """Names the entries of a network made in code that problems are about, and the rows of
        frames: those of all records with `data`.
        """


def _declare() -> None:
    for name, about, purpose, first, sets, options in _lptn.questions():
        if about == "nothing":
            continue
        lines = [f"{purpose}: `lptn {name}`.", "", "Options:"]
        lines += [f"    {option}: {means}" for option, _, means in options]
        lines += [f"    {option}: {means}" for option, means in more(name, sets)]
        lines += ["", "Other keywords are parameters of the netlist."] if sets else []
        method = _method(name, first, about == "netlists")
        method.__name__ = method_name(name)
        method.__qualname__ = f"Network.{method.__name__}"
        method.__doc__ = "\n".join(lines)
        setattr(Questions, method.__name__, method)


def method_name(question: str) -> str:
    """The name of a question in Python: `fit` is `fit network`."""
    return "fit" if question == "fit network" else question.replace(" ", "_")


_declare()
