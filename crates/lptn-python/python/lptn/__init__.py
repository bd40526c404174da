"""Lumped-parameter thermal networks, with units checked and energy accounted for.

    import lptn

    net = lptn.load("gearbox.toml")
    run = net.run(G_out="4 W/K")
    print(run["steel.T"].max(), run["steel.T"].unit, run.limits, run.doubts)
"""

from ._lptn import __version__

# for checkers of types; the rest is imported when it is used, so that the program starts quickly
TYPE_CHECKING = False
if TYPE_CHECKING:
    from ._column import Column
    from ._functions import check, compare, fit_compare, fit_law, fit_step, size
    from ._gradient import Function
    from ._help import help
    from ._messages import Doubt, Error, Fix, Made, Place, Problem
    from ._network import Network, load, parse
    from ._result import Result, Table
    from ._simulation import Simulation

__all__ = [
    "Column",
    "Doubt",
    "Error",
    "Fix",
    "Function",
    "Made",
    "Network",
    "Place",
    "Problem",
    "Result",
    "Simulation",
    "Table",
    "__version__",
    "check",
    "compare",
    "fit_compare",
    "fit_law",
    "fit_step",
    "help",
    "load",
    "parse",
    "size",
]

_MODULES = {
    "_column": ["Column"],
    "_functions": ["check", "compare", "fit_compare", "fit_law", "fit_step", "size"],
    "_gradient": ["Function"],
    "_help": ["help"],
    "_messages": ["Doubt", "Error", "Fix", "Made", "Place", "Problem"],
    "_network": ["Network", "load", "parse"],
    "_result": ["Result", "Table"],
    "_simulation": ["Simulation"],
}
_HOME = {name: module for module, names in _MODULES.items() for name in names}


def __getattr__(name: str) -> object:
    if name not in _HOME:
        raise AttributeError(f"module 'lptn' has no attribute {name!r}")
    from importlib import import_module

    found = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
