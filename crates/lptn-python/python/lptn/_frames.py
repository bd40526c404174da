"""Tables as frames of other packages, which are imported when they are asked for."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ._numpy import np

if TYPE_CHECKING:
    from ._result import Table


def needed(package: str, purpose: str) -> Any:
    """A package, or an error that says how to get it."""
    try:
        return importlib.import_module(package)
    except ImportError:
        name = package.partition(".")[0]
        raise ImportError(f"{purpose} needs {name}: pip install {name}") from None


def columns(table: Table) -> dict[str, Any]:
    """The columns with units in their headings: arrays, and lists of words."""

    def values(name: str) -> Any:
        return np.atleast_1d(np.asarray(table[name])) if name in table.units else table[name]

    return {table.head(name): values(name) for name in table.names}


def pandas(table: Table, words: dict[str, Any]) -> Any:
    """A pandas DataFrame; times are the index. The numbers are not copied."""
    made = needed("pandas", "to_pandas()").DataFrame(columns(table), **{"copy": False, **words})
    if table.index is not None and len(table.index) == len(made):
        made.index = table.index
    return made.set_index(table.head("time")) if "time" in table.units else made


def polars(table: Table) -> Any:
    """A polars DataFrame. The numbers are not copied."""
    return needed("polars", "to_polars()").DataFrame(columns(table))


def arrow(table: Table) -> Any:
    """A table of Arrow, with the unit in the metadata of each field."""
    pyarrow = needed("pyarrow", "to_arrow()")
    arrays, fields = [], []
    for name in table.names:
        number = name in table.units
        values = np.atleast_1d(np.asarray(table[name])) if number else table[name]
        array = pyarrow.array(values)
        unit = {"unit": table.units[name]} if number else None
        arrays.append(array)
        fields.append(pyarrow.field(name, array.type, metadata=unit))
    return pyarrow.table(arrays, schema=pyarrow.schema(fields))


def xarray(table: Table, title: str) -> Any:
    """An xarray Dataset: a variable for each column, with its unit as the attribute `units`."""
    package = needed("xarray", "to_xarray()")
    clock = "time" in table.units
    dims = [] if table.is_scalar else ["time" if clock else "row"]

    def variable(name: str) -> Any:
        unit = {"units": table.units[name]} if name in table.units else {}
        return (dims, np.asarray(table[name]), unit)

    names = [name for name in table.names if not (clock and name == "time")]
    times = {"time": variable("time")} if clock else {}
    return package.Dataset({name: variable(name) for name in names}, times, {"title": title})
