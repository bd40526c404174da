"""Energy balances as tables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ._result import Rows, Table

# The parts of the energy balance: sources + boundaries + streams + masses = stored + residual.
_PARTS = ("sources", "boundaries", "streams", "masses", "stored")


def ledger(data: dict[str, Any]) -> Table:
    """The energy balance of a run, from its JSON."""
    heats = [
        (part, name, heat["value"])
        for part in _PARTS
        for name, heat in data.get(part, {}).items()
    ]
    return of_heats([*heats, ("residual", "", data["residual"]["value"])])


def of_heats(heats: Sequence[tuple[str, str, float]]) -> Table:
    """Heats in J, each with its part of the balance and its name."""
    parts, names, values = ([heat[place] for heat in heats] for place in range(3))
    return Table(Rows([("part", None, parts), ("name", None, names), ("heat", "J", values)]), False)


def balance(data: dict[str, Any]) -> Table:
    """The heat balance of a node or boundary, from its JSON: a row for each path and source."""
    terms = data["terms"]
    columns: list[tuple[str, str | None, list[Any]]] = [
        ("name", None, [term["name"] for term in terms]),
        ("other", None, [term["other"] or "" for term in terms]),
    ]
    for name in ("power", "power_share", "heat", "heat_share"):
        cells = [term[name] for term in terms]
        # a steady state has no heat over time
        unit = next((cell["unit"] for cell in cells if cell), None)
        if unit is not None:
            numbers = [cell["value"] if cell else float("nan") for cell in cells]
            columns.append((name, unit, numbers))
    return Table(Rows(columns), False)
