"""Writes `_questions.pyi`, the types of the questions, from their declarations.

    python stub.py ../python/lptn/_questions.pyi
"""

import keyword
import sys

from lptn import _lptn
from lptn._questions import RECORDS, method_name

HEAD = '''"""Questions to a network. Written by tests/stub.py from the declarations in src/verbs.rs."""

import os
from collections.abc import Sequence
from typing import Any, SupportsFloat

from . import _lptn
from ._messages import Error, Problem
from ._network import Network
from ._progress import Told
from ._result import Explain, Result

# A text, a path, a number, a number with its unit.
Text = str | os.PathLike[str] | SupportsFloat | tuple[float, str]
Netlist = str | os.PathLike[str] | Network

RECORDS: tuple[str, ...]

def answered(
    answer: _lptn.Answer,
    question: str,
    words: dict[str, Any],
    level: int,
    explain: Explain | None = None,
    network: Any = None,
) -> Result: ...
def more(question: str, sets: bool) -> list[tuple[str, str]]: ...
def paths(netlists: tuple[Any, ...]) -> list[str]: ...
def method_name(question: str) -> str: ...

class Questions:
    _set: dict[str, Any]
    @property
    def _files(self) -> list[tuple[str, bytes]]: ...
    @property
    def _netlist(self) -> _lptn.Netlist: ...
    def _with_data(self, question: str, study: str | None, data: Any) -> _lptn.Netlist: ...
    def _explain(self, of: Error | list[Problem], data: bool = False) -> None: ...
'''


def argument(option, kind):
    name = f"{option}_" if keyword.iskeyword(option) else option
    default = " = False" if kind.startswith("bool") else " = None"
    return f"        {name}: {kind}{default},\n"


def method(question):
    name, about, purpose, first, sets, options = question
    lines = ["        self,\n"]
    if about == "netlists":
        lines.append("        *netlists: Netlist,\n")
    else:
        lines += [argument(option, kind) for option, kind, _ in options if option == first]
        lines.append("        *,\n")
    lines += [argument(option, kind) for option, kind, _ in options if option != first]
    if name in RECORDS:
        lines.append("        data: Any = None,\n")
    if sets:
        several = " | Sequence[Text] | tuple[Sequence[float], str]" if name == "compare" else ""
        lines.append("        progress: bool | Told = False,\n")
        lines.append("        set: dict[str, Any] | None = None,\n")
        lines.append("        options: dict[str, Any] | None = None,\n")
        lines.append(f"        **parameters: Text{several},\n")
    return (
        f"    def {method_name(name)}(\n{''.join(lines)}    ) -> Result:\n"
        f'        """{purpose}: `lptn {name}`."""\n'
    )


def stub():
    """The text of the file."""
    questions = [question for question in _lptn.questions() if question[1] != "nothing"]
    return HEAD + "".join(method(question) for question in questions)


if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write(stub())
