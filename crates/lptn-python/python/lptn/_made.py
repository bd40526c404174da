"""Networks made in code: the tables of a netlist, which the reader of netlists then checks."""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Mapping
from typing import Any

from . import _lptn
from ._memory import File, csv, is_frame
from ._messages import Error, Made, Problem

# The folder of this package, whose own lines are not places.
_HERE = os.path.dirname(os.path.abspath(__file__))


# Keys that name files: a frame may stand there.
_FILES = ("csv", "data", "file")


class Tables:
    """The sections of a netlist with their entries, and the line of the program of each."""

    def __init__(self, name: str, parameters: dict[str, Any]) -> None:
        self.name = name
        self.parameters = parameters
        self.files: list[File] = []
        self._top: dict[str, Any] = {"format": 1}
        self._sections: dict[str, dict[str, Any]] = {}
        self._made: dict[tuple[str, str], Made] = {}
        self._netlist: _lptn.Netlist | None = None

    def __getstate__(self) -> dict[str, Any]:
        # the netlist is read again
        return {**self.__dict__, "_netlist": None}

    def top(self, key: str, value: Any) -> None:
        """Sets a key in front of all sections."""
        self._top[key] = value
        self._netlist = None

    def add(self, section: str, name: str, value: Any) -> None:
        """Adds an entry to a section."""
        for text in (section, name):
            if not isinstance(text, str):
                raise TypeError(f"names are texts, not {type(text).__name__}: {text!r}")
        entries = self._sections.setdefault(section, {})
        if name in entries:
            raise ValueError(f"{section} {name!r} is there already: {self._made[section, name]}")
        entries[name] = self._filed("", value, f"{section}.{name}")
        self._made[section, name] = _made(section, name)
        self._netlist = None

    def _filed(self, key: str, value: Any, stem: str) -> Any:
        """A value with the name of a file for each frame, which is a file in memory."""
        if key in _FILES and is_frame(value):
            count = len(self.files)
            self.files.append((f"{stem}.csv" if not count else f"{stem}.{count}.csv", csv(value)))
            return self.files[-1][0]
        if isinstance(value, Mapping):
            return {inner: self._filed(inner, one, stem) for inner, one in value.items()}
        if isinstance(value, list):
            return [self._filed(key, one, stem) for one in value]
        return value

    @property
    def netlist(self) -> _lptn.Netlist:
        """The netlist, read again if something was added."""
        if self._netlist is None:
            try:
                self._netlist = _lptn.Netlist.parse(
                    self.text, self.name, self.parameters, self.files
                )
            except Error as error:
                self.explain(error.errors)
                error.refresh()
                raise
        return self._netlist

    @property
    def text(self) -> str:
        """The netlist as a text, an entry a line."""
        return "\n".join(line for line, _ in self._lines()) + "\n"

    def explain(self, problems: list[Problem]) -> None:
        """Names the entry of each problem, and the line of the program that made it."""
        entries = [key for _, key in self._lines()]
        for problem in problems:
            for place in problem.places:
                line = place.line - 1
                if place.primary and place.file == self.name and line < len(entries):
                    key = entries[line]
                    problem.made = self._made[key] if key else None

    def _lines(self) -> list[tuple[str, tuple[str, str] | None]]:
        lines: list[tuple[str, tuple[str, str] | None]] = []
        lines += [(f"{_key(key)} = {toml(value)}", None) for key, value in self._top.items()]
        for section, entries in self._sections.items():
            # a section that is wrong is that of its first entry
            lines += [("", None), (f"[{_key(section)}]", (section, next(iter(entries))))]
            for name, value in entries.items():
                lines.append((f"{_key(name)} = {toml(value)}", (section, name)))
        return lines


def of_text(text: str, name: str, parameters: dict[str, Any], files: list[File]) -> Tables:
    """The tables of a netlist."""
    try:
        import tomllib
    except ImportError:  # Python 3.10
        raise ImportError("reading the tables of a text needs Python 3.11 or newer") from None
    # its problems have places in the text
    _lptn.Netlist.parse(text, name, parameters, files)
    made = Tables(name, parameters)
    made.files = files
    for key, value in tomllib.loads(text).items():
        if not isinstance(value, dict):
            made.top(key, value)
            continue
        for entry, right in value.items():
            made.add(key, entry, right)
    return made


def _made(section: str, name: str) -> Made:
    """The line of the program that is being executed."""
    frame = sys._getframe(1)
    while frame.f_back and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == _HERE:
        frame = frame.f_back
    return Made(section, name, frame.f_code.co_filename, frame.f_lineno)


def keys(words: Mapping[str, Any]) -> dict[str, Any]:
    """Keys of an entry; `from_` is `from`, which Python reserves. `None` is left out."""
    return {key.removesuffix("_"): word for key, word in words.items() if word is not None}


def _key(key: str) -> str:
    plain = key.isascii() and key.replace("_", "a").replace("-", "a").isalnum()
    return key if plain else toml(key)


def toml(value: Any) -> str:
    """A value as TOML writes it; `(4.5, "W/K")` and results are quantities."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[1], str):
        return toml(f"{float(value[0])!r} {value[1]}".strip())
    if isinstance(value, Mapping):
        inner = ", ".join(f"{_key(str(key))} = {toml(one)}" for key, one in value.items())
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, os.PathLike):
        return toml(os.fspath(value))
    if getattr(value, "ndim", 0) > 0 or isinstance(value, (list, tuple)):
        return f"[{', '.join(toml(one) for one in value)}]"
    return _number(value)


def _number(value: Any) -> str:
    unit = getattr(value, "unit", "")
    if isinstance(unit, str) and unit:
        return toml((float(value), unit))
    if hasattr(value, "isoformat"):
        return str(value.isoformat())
    if hasattr(value, "__index__"):
        return str(int(value))
    if not hasattr(value, "__float__"):
        raise TypeError(f"a netlist has no {type(value).__name__}: write a text or a number")
    number = float(value)
    return repr(number) if math.isfinite(number) else str(number)
