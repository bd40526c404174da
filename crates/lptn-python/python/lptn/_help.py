"""Help about sections of netlists and questions."""

from __future__ import annotations

import difflib
import inspect
from typing import Any

from . import _lptn
from ._questions import method_name, more


# Methods of a network that are not a question.
_METHODS = ("simulation", "to_toml", "value_and_grad")


def _network() -> Any:
    from . import _network

    return _network


def help(topic: str | None = None) -> None:
    """Prints the keys of a section of netlists, or the options of a question.

        lptn.help("conduction")
        lptn.help("run")
    """
    print(text(topic))


def text(topic: str | None) -> str:
    """The same as a text."""
    sections = {section[0]: section for section in _lptn.sections()}
    questions = {method_name(question[0]): question for question in _lptn.questions()}
    if topic is None:
        names = [f"Sections of a netlist:\n  {_wrapped(list(sections))}"]
        names.append(f"Questions:\n  {_wrapped(list(questions))}")
        return "\n".join([*names, 'lptn.help("node") has the keys, lptn.help("run") the options.'])
    name = topic.strip("[] ")
    parts = []
    if name in sections:
        parts.append(_section(*sections[name]))
    if name.replace(" ", "_") in questions:
        parts.append(_question(*questions[name.replace(" ", "_")]))
    if not parts and name in _METHODS:
        return inspect.getdoc(getattr(_network().Network, name)) or ""
    if parts:
        return "\n\n".join(parts)
    near = difflib.get_close_matches(name, [*sections, *questions], n=1)
    hint = f": did you mean {near[0]!r}?" if near else "; lptn.help() lists them"
    raise ValueError(f"there is no section or question {name!r}{hint}")


def _section(
    name: str, sentence: str, example: str, keys: list[tuple[str, str, str, str, str, bool]]
) -> str:
    lines = [f"[{name}]  {sentence}"]
    width = max((len(key[0]) for key in keys), default=0)
    for key, takes, meaning, default, sample, needed in keys:
        more = " (required)" if needed else f" (default: {default})" if default else ""
        lines.append(f"  {key:<{width}}  {takes}: {meaning}{more}")
        lines.append(f"  {'':<{width}}  {key} = {sample}")
    return "\n".join([*lines, f"example: NAME = {example}"] if example else lines)


def _question(
    name: str,
    about: str,
    purpose: str,
    first: str | None,
    sets: bool,
    options: list[tuple[str, str, str]],
) -> str:
    lines = [f"lptn {name}  {purpose}"]
    lines += [f"  {option}: {means}" for option, _, means in options]
    lines += [f"  {option}: {means}" for option, means in more(name, sets)]
    return "\n".join([*lines, "  other keywords are parameters of the netlist"] if sets else lines)


def _wrapped(names: list[str]) -> str:
    lines, line = [], ""
    for name in names:
        if len(line) + len(name) > 76:
            lines.append(line)
            line = ""
        line = f"{line}, {name}" if line else name
    return ",\n  ".join([*lines, line])
