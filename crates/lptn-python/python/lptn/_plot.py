"""Pictures of columns with matplotlib."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from ._frames import needed
from ._numpy import np

if TYPE_CHECKING:
    from ._result import Result


def drawn(
    result: Result, names: Sequence[str], ax: Any, title: str | None, words: dict[str, Any]
) -> Any:
    """Draws columns, those of one unit in one panel, with their bands and limits."""
    if result.table.is_scalar:
        raise TypeError("a steady state has no curves: svg() draws it, and table has its numbers")
    panels = _panels(result, names)
    if ax is not None and len(panels) > 1:
        units = ", ".join(panels)
        raise ValueError(f"one axes has one unit, not {units}: plot() without `ax` makes panels")
    all = [ax] if ax is not None else _axes(len(panels))
    shown = [_panel(result, panel, of, words) for panel, of in zip(all, panels.values())]
    if title is not None or ax is None:
        shown[0].set_title(result.title if title is None else title)
    for upper in shown[:-1]:
        upper.set_xlabel("")
    return shown[0] if len(shown) == 1 else np.array(shown)


def _panels(result: Result, names: Sequence[str]) -> dict[str, list[str]]:
    """The names by unit."""
    names = names or [name for name in result.table.units if name.endswith(".T")]
    if not names:
        raise TypeError(f"name the columns to plot: {', '.join(result.table.units)}")
    panels: dict[str, list[str]] = {}
    for name in names:
        column = result[name]
        if isinstance(column, list):
            raise TypeError(f"column `{name}` has words: only numbers have curves")
        panels.setdefault(column.unit, []).append(name)
    return panels


def _axes(count: int) -> list[Any]:
    plt = needed("matplotlib.pyplot", "plot()")
    size = {"figsize": (6.4, 2.0 + 2.4 * count), "layout": "constrained"} if count > 1 else {}
    return list(plt.subplots(count, sharex=True, squeeze=False, **size)[1][:, 0])


def _panel(result: Result, ax: Any, names: list[str], words: dict[str, Any]) -> Any:
    for name in names:
        column = result[name]
        ax = column.plot(ax=ax, **words)
        if f"{name}.low" in result.table and f"{name}.high" in result.table:
            low, high = (np.asarray(result[f"{name}.{end}"]) for end in ("low", "high"))
            color = ax.lines[-1].get_color()
            ax.fill_between(np.asarray(column.index), low, high, color=color, alpha=0.2, linewidth=0)
    for text, value in _bounds(result, names):
        ax.axhline(value, linestyle="--", color="black", linewidth=1, label=text)
        ax.legend()
    return ax


def _bounds(result: Result, names: list[str]) -> Iterator[tuple[str, float]]:
    """The constant bounds of the limits of these columns, in their units."""
    # a sweep counts its candidates
    judged = ((name, of) for name, of in result.limits.items() if isinstance(of, dict))
    for name, limit in judged:
        for side in ("below", "above"):
            bound = limit.get(side)
            if limit.get("of") in names and isinstance(bound, dict):
                value, unit = bound.get("value"), bound.get("unit")
                if value is not None and unit == result[limit["of"]].unit:
                    yield f"{name}: {side} {value:g} {unit}", value
