"""Columns of a result as arrays of NumPy with a unit."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal
from weakref import WeakKeyDictionary

from . import _lptn
from ._numpy import np

# Attributes of arrays that change all values when they are set.
_FIXED = {"data", "dtype", "flat", "imag", "real", "shape", "strides"}


# The columns that axes show, each with its line.
_shown: WeakKeyDictionary[Any, list[tuple[Any, Column]]] = WeakKeyDictionary()


class Column(np.ndarray[Any, np.dtype[np.float64]]):
    """Values of a column in the unit that is shown, as an array of NumPy that is read-only.

    `name` and `unit` are those of the column, `si` has the values in SI units (temperatures in K).
    `index` is the column of times, if there is one. A part, `column[10:20]` or `column[order]`, is
    a column with the same part of `index`; one value is a number. Everything else that NumPy does
    with a column gives a plain array; `np.array(column)` is one that can be changed.
    """

    # of an array that NumPy makes, in an order that is not known; `column` gives others
    _name: str = ""
    _unit: str | None = None
    _index: Column | None = None

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> Any:
        # a product or a difference has another unit
        return getattr(ufunc, method)(*_plain(inputs), **_plain(kwargs))

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        # a function may change unit and order
        return _plain(func(*_plain(args), **_plain(kwargs)))

    def __getitem__(self, key: Any) -> Any:
        found = np.asarray(self)[_plain(key)]
        if self._unit is None or not isinstance(found, np.ndarray) or found.ndim != self.ndim:
            return found
        index = None if self._index is None else self._index[key]
        return column(self._name, self._unit, found, index)

    def __iter__(self) -> Iterator[Any]:
        return iter(np.asarray(self))

    def __setattr__(self, name: str, value: Any) -> None:
        if name in _FIXED:
            raise AttributeError(f"a column is read-only: change the {name} of np.array(column)")
        super().__setattr__(name, value)

    @property
    def name(self) -> str:
        """The name of the column, such as `steel.T`."""
        return self._name

    @property
    def unit(self) -> str:
        """The unit of the values."""
        if self._unit is None:
            raise AttributeError("NumPy made this array of a column: its unit is not known")
        return self._unit

    @property
    def index(self) -> Column | None:
        """The times of the values; `None` if they have none."""
        return self._index

    @property
    def si(self) -> np.ndarray[Any, np.dtype[np.float64]]:
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
            (line,) = ax.plot(values, **words)
        else:
            (line,) = ax.plot(np.asarray(self.index), values, **words)
            ax.set_xlabel(self._over)
        shown = [one for one in _shown.get(ax, []) if one[0].axes is ax]
        _shown[ax] = [*shown, (line, self)]
        ax.set_ylabel(_label([column for _, column in _shown[ax]]))
        if shown:
            ax.legend()
        return ax

    @property
    def _over(self) -> str:
        return f"{self.index.name} [{self.index.unit}]" if self.index is not None else ""

    def _axes(self, ax: Any) -> Any:
        """Axes whose values and times have the same units."""
        from ._frames import needed

        plt = needed("matplotlib.pyplot", "plot()")
        there = ax if ax is not None else plt.gca()
        over = there.get_xlabel()
        shown = [column for line, column in _shown.get(there, []) if line.axes is there]
        others = [column for column in shown if column.unit != self.unit]
        of_other_times = over.startswith("time [") and over != self._over
        if not others and not of_other_times:
            return there
        if ax is None:
            return plt.subplots()[1]
        if others:
            raise ValueError(
                f"the axes show {_label(others)}, and `{self.name}` is in {self.unit}: give it axes "
                "of its own, such as ax.twinx()"
            )
        raise ValueError(f"the axes show {over}, the column is over {self._over}")

    def copy(self, order: Literal["K", "A", "C", "F"] | None = "C") -> Column:
        """The same column, with its own values."""
        return self.__copy__()

    def __copy__(self) -> Column:
        return _again(*self._parts(np.array(self)))

    def __deepcopy__(self, memo: Any) -> Column:
        return self.__copy__()

    def __reduce__(self) -> Any:
        return (_again, self._parts(np.array(self)))

    def _parts(self, values: np.ndarray) -> tuple[str, str | None, np.ndarray, Column | None]:
        return (self._name, self._unit, values, self._index)

    def __repr__(self) -> str:
        if self._unit is None:
            return repr(np.asarray(self))
        if self.ndim == 0:
            return f"{self.name} = {self.item():.6g} {self.unit}"
        values = np.array2string(np.asarray(self), threshold=12, edgeitems=3, precision=4)
        return f"{self.name} [{self.unit}] {values}"

    def __str__(self) -> str:
        return f"{self.item()}" if self.ndim == 0 else np.array2string(np.asarray(self))


def _label(columns: list[Column]) -> str:
    """The label of an axis with these columns: a name, or a noun, with each unit."""
    names: dict[str, list[str]] = {}
    for shown in columns:
        of_unit = names.setdefault(shown.unit, [])
        if shown.name not in of_unit:
            of_unit.append(shown.name)

    def noun(of_unit: list[str]) -> str:
        several = len(of_unit) > 1 and all(name.endswith(".T") for name in of_unit)
        return "temperature" if several else ", ".join(of_unit)

    return ", ".join(f"{noun(of_unit)} [{unit}]" for unit, of_unit in names.items())


def _plain(of: Any) -> Any:
    """The same with plain arrays for columns, in lists, tuples and dictionaries too."""
    if isinstance(of, Column):
        return np.asarray(of)
    if type(of) in (list, tuple):
        return type(of)([_plain(one) for one in of])
    return {key: _plain(one) for key, one in of.items()} if type(of) is dict else of


def _methods_are_plain() -> None:
    """Methods and attributes of arrays, such as `round` and `T`, give plain arrays."""

    def method(name: str) -> Any:
        return lambda self, *args, **words: _plain(
            getattr(np.asarray(self), name)(*_plain(args), **_plain(words))
        )

    for name, has in vars(np.ndarray).items():
        if name.startswith("_") or name in vars(Column):
            continue
        if callable(has):
            setattr(Column, name, method(name))
        elif name in ("T", "mT", "flat", "imag", "real"):
            setattr(Column, name, property(lambda self, name=name: getattr(np.asarray(self), name)))


_methods_are_plain()


def column(name: str, unit: str, values: Any, index: Column | None = None) -> Column:
    """A column of these values."""
    return _again(name, unit, np.asarray(values, dtype=float), index)


def _again(name: str, unit: str | None, values: np.ndarray, index: Column | None) -> Column:
    made = np.ndarray.view(values, Column)
    np.ndarray.setflags(made, write=False)
    return _named(made, name, unit, index)


def _named(made: Column, name: str, unit: str | None, index: Column | None) -> Column:
    made.__dict__.update(_name=name, _unit=unit, _index=index)
    return made


def of_bytes(name: str, unit: str, data: bytes, index: Column | None, scalar: bool) -> Column:
    """A column, or one number, of these bytes, which are not copied and cannot be changed."""
    shape = () if scalar else len(data) // 8
    return _named(np.ndarray.__new__(Column, shape, np.float64, data), name, unit, index)


def of_json(heads: list[dict[str, str]], rows: list[list[float | None]]) -> dict[str, Column]:
    """The columns of the rows of a result in JSON."""
    values = np.array(rows, dtype=float).reshape(-1, len(heads))
    made: dict[str, Column] = {}
    for place, head in enumerate(heads):
        index = made.get("time")
        made[head["name"]] = column(head["name"], head["unit"], values[:, place].copy(), index)
    return made
