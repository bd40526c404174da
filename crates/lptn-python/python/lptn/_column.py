"""Columns of a result as arrays of NumPy with a unit."""

from __future__ import annotations

from typing import Any

from . import _lptn
from ._numpy import np


class Column(np.ndarray):
    """Values of a column in the unit that is shown, as an array of NumPy.

    `name` and `unit` are those of the column, `si` has the values in SI units (temperatures in K).
    `index` is the column of times, if there is one. Arithmetic gives plain arrays.
    """

    name: str
    unit: str
    index: Column | None

    def __array_finalize__(self, obj: Any) -> None:
        self.name = getattr(obj, "name", "")
        self.unit = getattr(obj, "unit", "")
        index = getattr(obj, "index", None)
        # a part of a column has other times
        self.index = index if index is not None and index.shape == self.shape else None

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> Any:
        # a product or a difference has another unit: it is a plain array
        def plain(x: Any) -> Any:
            return x.view(np.ndarray) if isinstance(x, Column) else x

        if "out" in kwargs:
            kwargs["out"] = tuple(plain(x) for x in kwargs["out"])
        return getattr(ufunc, method)(*(plain(x) for x in inputs), **kwargs)

    @property
    def si(self) -> np.ndarray:
        """The values in SI units, temperatures in K."""
        scale, offset, _ = _lptn.unit(self.unit or "1")
        return (np.asarray(self) + offset) * scale

    @property
    def si_unit(self) -> str:
        """The SI unit of the values."""
        return _lptn.unit(self.unit or "1")[2]

    def to_pint(self, registry: Any = None) -> Any:
        """The values as a quantity of pint; `registry` is a `pint.UnitRegistry`."""
        from ._frames import needed

        pint = needed("pint", "to_pint()")
        registry = pint.get_application_registry() if registry is None else registry
        return registry.Quantity(np.asarray(self), self.unit)

    def plot(self, ax: Any = None, **words: Any) -> Any:
        """Draws the column over time with matplotlib, and returns the axes: `ax`, or the present
        ones if they show the same time.
        """
        ax = self._axes(ax)
        words.setdefault("label", self.name)
        values = np.atleast_1d(np.asarray(self))
        if self.index is None:
            ax.plot(values, **words)
        else:
            ax.plot(np.asarray(self.index), values, **words)
            ax.set_xlabel(self._over)
        ax.set_ylabel(f"{self.name} [{self.unit}]")
        return ax

    @property
    def _over(self) -> str:
        return f"{self.index.name} [{self.index.unit}]" if self.index is not None else ""

    def _axes(self, ax: Any) -> Any:
        """Axes whose time has the same unit."""
        from ._frames import needed

        plt = needed("matplotlib.pyplot", "plot()")
        there = ax if ax is not None else plt.gca()
        shown = there.get_xlabel()
        if not shown or shown == self._over or not shown.startswith("time ["):
            return there
        if ax is not None:
            raise ValueError(f"the axes show {shown}, the column is over {self._over}")
        return plt.subplots()[1]

    def __repr__(self) -> str:
        if self.ndim == 0:
            return f"{self.name} = {self.item():.6g} {self.unit}"
        values = np.array2string(np.asarray(self), threshold=12, edgeitems=3, precision=4)
        return f"{self.name} [{self.unit}] {values}"

    def __str__(self) -> str:
        return f"{self.item()}" if self.ndim == 0 else np.array2string(np.asarray(self))

    def __reduce__(self) -> Any:
        return (column, (self.name, self.unit, np.asarray(self).copy(), self.index))


def column(name: str, unit: str, values: Any, index: Column | None = None) -> Column:
    """A column of these values."""
    made = np.asarray(values, dtype=float).view(Column)
    made.name, made.unit, made.index = name, unit, index
    return made


def of_bytes(name: str, unit: str, data: bytes, index: Column | None = None) -> Column:
    """A column of these bytes, which are not copied."""
    return column(name, unit, np.frombuffer(data, dtype=np.float64), index)
