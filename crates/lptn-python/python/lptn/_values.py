"""Values of parameters: their names, and temperatures that count from 0 K."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import Any

from . import _lptn

_NUMBERS = (float, int)

# Reads the netlist whose parameters get the values.
Read = Callable[[], _lptn.Netlist]


def known(netlist: _lptn.Netlist, names: Iterable[str]) -> list[tuple[float, str]]:
    """Values and units of parameters, or the error of every question for an unknown one."""
    own = _parameters(netlist)

    def one(name: str) -> tuple[float, str]:
        if name not in own:
            netlist.ask("modes", [], {"set": {name: "1"}})
        return own[name]

    return [one(name) for name in names]


def one_of(name: str, word: str, words: tuple[str, ...]) -> None:
    """Refuses a word that is not one of these."""
    if word not in words:
        raise ValueError(f"`{name}` is one of {', '.join(words)}, not {word!r}")


def given(words: Mapping[str, Any], read: Read, several: bool = False) -> dict[str, Any]:
    """The words of a question; `several` values of a parameter are variants."""
    for name in ("set", "options"):
        if name in words and not isinstance(words[name], (Mapping, type(None))):
            kind = type(words[name]).__name__
            raise TypeError(f'`{name}` takes a dictionary such as {{"fan.G": "2 W/K"}}, not {kind}')
    inner = words.get("set")
    if inner is None and all(map(_is_ready, words.values())):
        return {**words}
    if inner is None:
        return values(words, read, several)
    others = {name: word for name, word in words.items() if name != "set"}
    return {**values(others, read, several), "set": values(inner, read, several)}


def values(words: Mapping[str, Any], read: Read, several: bool = False) -> dict[str, Any]:
    """The words, with a text for each number in K or degR that is an absolute temperature.

    Such a number is one of a parameter that is an absolute temperature, or that of a node in a
    result. The netlist is read only if a word needs it.
    """

    def one(name: str, word: Any) -> Any:
        pair = isinstance(word, tuple) and len(word) == 2 and isinstance(word[1], str)
        number, unit = word if pair else (word, getattr(word, "unit", None))
        if hasattr(word, "columns"):
            raise TypeError(
                f"`{name}` takes no frame: `data` of fit and infer takes one, `files` of lptn.load, "
                "and net.sweep(frame)"
            )
        many = isinstance(number, (list, tuple)) or getattr(number, "ndim", 0) > 0
        if many and name in _parameters(read()):
            if not several:
                raise TypeError(f"`{name}` takes one value: net.sweep({{{name!r}: [..]}}) solves many")
            return [one(name, part) for part in _variants(name, number, (unit, read))]
        kelvin = _kelvin(unit) if isinstance(unit, str) else None
        if many or kelvin is None:
            return [one(name, part) for part in word] if several and many else word
        if not (_is_absolute(read(), name) if pair else str(getattr(word, "name", "")).endswith(".T")):
            return word
        return f"{float(number) * kelvin - _lptn.unit('degC')[1]!r} degC"

    return {name: word if _is_ready(word) else one(name, word) for name, word in words.items()}


def _variants(name: str, given: Any, of: tuple[Any, Read]) -> list[Any]:
    """Several values of a parameter, each with the unit of all."""
    unit, read = of
    parts = given.tolist() if hasattr(given, "tolist") else list(given)
    if isinstance(unit, str):
        return [(part, unit) for part in parts]
    own = _parameters(read())[name][1]
    if own and any(type(part) in _NUMBERS for part in parts):
        texts = [part if isinstance(part, str) else f"{part} {own}" for part in parts]
        plain = all(type(part) in _NUMBERS for part in parts)
        right = f'({parts}, "{own}")' if plain else json.dumps(texts, ensure_ascii=False)
        raise TypeError(f"`{name}` takes values with their unit: {name}={right}")
    return parts


def _is_ready(word: Any) -> bool:
    """True for a text, a number, and a number with a unit that is not K or degR."""
    kind = type(word)
    if kind is tuple and len(word) == 2 and type(word[0]) in _NUMBERS and type(word[1]) is str:
        return _kelvin(word[1]) is None
    return kind in _NUMBERS or kind is str or word is None or kind is bool


def _parameters(netlist: _lptn.Netlist) -> dict[str, tuple[float, str]]:
    return {name: (value, unit) for name, value, unit in netlist.parameters()}


def _is_absolute(netlist: _lptn.Netlist, name: str) -> bool:
    """True if a parameter is an absolute temperature: its unit has a zero of its own."""
    unit = _parameters(netlist).get(name, (0.0, ""))[1]
    return bool(unit) and _lptn.unit(unit)[1] != 0


@lru_cache(maxsize=64)
def _kelvin(unit: str) -> float | None:
    """K per unit, for K and degR: units that count from 0 K or are differences."""
    try:
        scale, offset, si = _lptn.unit(unit)
    except ValueError:  # refused with its place by the question
        return None
    return scale if offset == 0 and si == "K" else None
