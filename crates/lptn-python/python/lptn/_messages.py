"""Problems of a question: errors are exceptions, doubts are warnings."""

from __future__ import annotations

import json
import keyword
import os
import re
import shlex
import warnings
from functools import lru_cache
from typing import Any

from . import _lptn

# The file of the candidates of a frame.
CANDIDATES = "lptn-candidates.csv"

# A command of the program, which stays as it is.
_COMMAND = re.compile(r"(`lptn [^`]*`|\blptn [a-z]+ [^`;:]*)")
# A parameter that is set: `--set "P=3 W"`.
_SET = re.compile(r"""--set ("?)([\w.]+)=([^"`]*[^"`\s])\1""")
# A remark about the option of a command, where Python has a keyword or nothing.
_REMARK = re.compile(r" \(a command: [^)]*\)")
# An option, perhaps with its value: `--stop "2 h"`, `--at 1 h`, `--keep steel,housing`, `--to NODE`.
_VALUE = r"\d[\w.%]*(?: (?:ms|s|min|h|d|K|degC|J/K|W)\b)?(?:,[\w.]+)*|[A-Z]{4,}|\w+(?:,\w+)+"
_OPTION = re.compile(rf"""(`?)--([a-z][a-z-]*)(?:[ =](?:["']([^"']*)["']|({_VALUE})))?(`?)""")


@lru_cache(maxsize=1)
def _options() -> set[str]:
    return {"set", *(option for question in _lptn.questions() for option, *_ in question[5])}


def _keyword(name: str) -> str:
    """The keyword for an option: Python reserves `for` and `from`."""
    return f"{name}_" if keyword.iskeyword(name) else name


def in_python(text: str) -> str:
    """A sentence with the words of Python: `stop="2 h"` for `--stop "2 h"`."""

    def option(match: re.Match[str]) -> str:
        name = match[2].replace("-", "_")
        if name not in _options():
            return match[0]
        value, name = match[3] or match[4], _keyword(name)
        if value:
            name = f"{name}={value}" if value.isdigit() else f'{name}="{value}"'
            return f"{match[1]}{name}{match[5]}"
        # a word alone is marked as one, unless it is a part of what is marked
        return f"`{name}`" if match[1] == match[5] else f"{match[1]}{name}{match[5]}"

    parts = _COMMAND.split(_REMARK.sub("", text))
    parts[::2] = [_OPTION.sub(option, _SET.sub(r'\2="\3"', part)) for part in parts[::2]]
    parts[1::2] = [_call(part) for part in parts[1::2]]
    return "".join(parts)


def _call(command: str) -> str:
    """A command in backticks as a call: `net.steady(periodic=True)`; others stay as they are."""
    try:
        words = shlex.split(command.strip("`"))[1:]
    except ValueError:
        return command
    for name, about, _, first, _, options in _lptn.questions() if command[0] == "`" else ():
        verb = name.split()
        if words[: len(verb)] == verb and (about != "nothing" or len(verb) > 1):
            kinds = {option: kind for option, kind, _ in options}
            made = _arguments(words[len(verb) :], kinds, first if about == "nothing" else None)
            if made is not None:
                method = "fit" if name == "fit network" else name.replace(" ", "_")
                return f"`{'lptn' if about == 'nothing' else 'net'}.{method}({made})`"
    return command


def _arguments(words: list[str], kinds: dict[str, str], first: str | None) -> str | None:
    """The words of a command as arguments of a call; `None` if a call has none of them."""
    made: list[str] = []
    left = iter(words)
    for word in left:
        name = word.removeprefix("--").replace("-", "_")
        if not word.startswith("--"):
            # the network is that of the method
            made += [json.dumps(word)] if first else []
        elif name == "set":
            key, _, value = next(left, "").partition("=")
            made.append(f"{key}={json.dumps(value)}")
        elif name not in kinds:
            return None
        else:
            value = "True" if kinds[name] == "bool" else json.dumps(next(left, ""))
            made.append(f"{_keyword(name)}={value}")
    return ", ".join(made)


class Place:
    """A place in a netlist: file, line and column from 1, and the text there.

    In a frame `row` counts its rows from 0, and is -1 for the headings.
    """

    def __init__(self, data: dict[str, Any]) -> None:
        self.file: str = data["file"]
        self.line: int = data["line"]
        self.column: int = data["column"]
        self.end_line: int = data["end_line"]
        self.end_column: int = data["end_column"]
        self.text: str = data["text"]
        self.label: str = data.get("label", "")
        self.primary: bool = data.get("primary", True)
        self.row: int | None = None

    def __repr__(self) -> str:
        if self.row is not None:
            return f"{self.file}, {f'row {self.row}' if self.row >= 0 else 'headings'}"
        return f"{self.file}:{self.line}:{self.column}"


class Fix:
    """The text to write, and the place whose text it replaces (`None`: an argument)."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.text: str = data["text"]
        self.place: Place | None = Place(data["place"]) if data.get("place") else None

    def __repr__(self) -> str:
        return self.text if self.place is None else f"{self.place.text} -> {self.text}"


class Made:
    """An entry of a network made in code: section, name, and the line of the program."""

    def __init__(self, section: str, name: str, file: str, line: int) -> None:
        self.section = section
        self.name = name
        self.file = file
        self.line = line

    def __repr__(self) -> str:
        return f"{self.section} {self.name}, made at {os.path.basename(self.file)}:{self.line}"


class Problem:
    """A problem: its code, sentence, places, help and fix; `made` if it is about an entry of a
    network made in code."""

    def __init__(self, data: dict[str, Any]) -> None:
        self.code: str = data["code"]
        self.severity: str = data["severity"]
        self.message: str = in_python(data["message"])
        self.help: str | None = in_python(data["help"]) if data.get("help") else None
        self.notes: list[str] = [in_python(note) for note in data.get("notes", [])]
        self.places: list[Place] = [Place(place) for place in data.get("places", [])]
        self.fix: Fix | None = Fix(data["fix"]) if data.get("fix") else None
        self.made: Made | None = None
        if self.code == "netlist::csv_not_found" and self.help and self.places:
            self.help += f"; a frame may take its place: files={{{self.places[0].text}: frame}}"

    def __str__(self) -> str:
        primary = [place for place in self.places if place.primary]
        where = f"{self.made or primary[0]!r}: " if primary else ""
        # the place of an argument is an option of the command line
        if primary and primary[0].file.startswith("--"):
            name = in_python(primary[0].file)
            where = "" if name in self.message or "--set" in primary[0].file else f"{name}: "
        help = f"\n  help: {self.help}" if self.help else ""
        return f"{where}{self.message} [{self.code}]{help}"

    def __repr__(self) -> str:
        return f"<{self.severity} {self.code}>"


def problems(text: str | None) -> list[Problem]:
    """The problems of a list in JSON."""
    return [Problem(data) for data in json.loads(text)] if text else []


class Error(Exception):
    """A question without a whole answer.

    `code`, `message`, `places`, `help` and `fix` are those of the first problem; `errors` has all.
    `exit` is the exit code of the command. `result` is the part that was computed, if there is one.
    """

    def __init__(
        self,
        errors: list[Problem],
        exit: int = 2,
        doubts: list[Problem] | None = None,
        result: Any = None,
    ) -> None:
        super().__init__("\n".join(str(error) for error in errors))
        self.errors = errors
        self.exit = exit
        self.doubts = doubts or []
        self.result = result

    def refresh(self) -> None:
        """Writes the text again, after problems were explained."""
        self.args = ("\n".join(str(error) for error in self.errors),)

    def within(self, lines: int) -> None:
        """Leaves out places after the user's own lines; a row of a frame is a candidate."""
        for problem in self.errors:
            rows = [p.line - 1 for p in problem.places if os.path.basename(p.file) == CANDIDATES]
            if any(rows):
                problem.message = f"candidate {max(rows)}: {problem.message}"
            problem.places = [
                place
                for place in problem.places
                if place.line <= lines and os.path.basename(place.file) != CANDIDATES
            ]
        self.refresh()

    @classmethod
    def _of(cls, errors: str, exit: int, doubts: str) -> Error:
        return cls(problems(errors), exit, problems(doubts))

    @property
    def code(self) -> str:
        return self.errors[0].code if self.errors else ""

    @property
    def message(self) -> str:
        return self.errors[0].message if self.errors else ""

    @property
    def help(self) -> str | None:
        return self.errors[0].help if self.errors else None

    @property
    def places(self) -> list[Place]:
        return self.errors[0].places if self.errors else []

    @property
    def fix(self) -> Fix | None:
        return self.errors[0].fix if self.errors else None

    def __reduce__(self) -> Any:
        return (Error, (self.errors, self.exit, self.doubts))


class Doubt(UserWarning):
    """A doubt about a result that is there: `problem` has its code, places and help."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(str(problem))
        self.problem = problem
        self.code = problem.code
        self.places = problem.places
        self.help = problem.help
        self.fix = problem.fix


def warn(doubts: list[Problem], stacklevel: int) -> None:
    """Warns of each doubt at the line of the caller."""
    for doubt in doubts:
        warnings.warn(Doubt(doubt), stacklevel=stacklevel + 1)
