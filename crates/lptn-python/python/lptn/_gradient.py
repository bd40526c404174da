"""Results as functions of parameters, with gradients, for optimisers."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _lptn
from ._messages import Error
from ._numpy import np
from ._values import known, one_of

if TYPE_CHECKING:
    from ._network import Network

# Functionals of one quantity, and those that have a level too and no gradient.
_OVER_TIME = re.compile(r"\s*(?:last|max|min|mean|integral)\((.*)\)\s*$")
_LEVELS = re.compile(r"\s*(?:time_over|time_under|life)\(.*\)\s*$")
_MARGIN = re.compile(r"\s*margin\((.*)\)\s*$")
# a periodic steady state has no gradient, which its own error says
_OVER = ("steady", "run", "periodic")
_RUN = re.compile(r"^\s*(\[\s*run\s*\]|run\s*[=.])", re.MULTILINE)


class Function:
    """Results of a network as a function of parameters: `value, gradient = function(x)`.

    `x` are the values of `parameters` in the units `x_units`. For one result the value is a number
    and the gradient an array; for several the values are an array, and the gradient has a row for
    each. `value(x)` and `jac(x)` give one of the two. With `times` values and gradients have one more
    axis for them, in front of that of the parameters.
    """

    def __init__(
        self,
        network: Network,
        of: str | Sequence[str] | Mapping[str, str],
        by: str | Sequence[str],
        over: str | None,
        run: tuple[str | None, str | None],
        times: Any = None,
    ) -> None:
        self._made = (network, of, by, over, run, times)
        texts = _named(of)
        self.times: np.ndarray | None = None
        if times is not None:
            texts, over, run = self._at_times(texts, times, over, run)
        self.names = list(texts)
        self.parameters = [by] if isinstance(by, str) else list(by)
        _check(texts, self.parameters, over)
        self.over = over or _over(list(texts.values()))
        if self.over != "run" and run != (None, None):
            raise TypeError(
                "`stop` and `tolerance` are those of a run, and the results are those of a steady "
                'state: leave them out, or write functionals such as "max(steel.T)"'
            )
        self._one = isinstance(of, str)
        margins, reports = _split(texts)
        text = _study(network, self.parameters, reports, self.over)
        source, _ = network.text
        stop, _ = run
        if self.over == "run" and stop is not None and not _RUN.search(source):
            text += f"[run]\nstop = {json.dumps(stop)}\n"
        try:
            netlist = network._with(f"\n{text}")
            study = ("lptn_gradient", len(reports))
            self._of = _lptn.Gradient(netlist, study, list(margins.values()), run)
        except Error as error:
            _rename(error, list(reports.values()), source.count("\n") + 1)
            raise
        order = [*reports, *margins]
        self._order = [order.index(name) for name in self.names]
        self.x_units, units = self._of.units()
        self.units = [units[place] for place in self._order]
        self._last: tuple[bytes, Any] | None = None

    def _at_times(
        self, texts: dict[str, str], times: Any, over: str | None, run: tuple[str | None, str | None]
    ) -> tuple[dict[str, str], str, tuple[str | None, str | None]]:
        """The results as quantities over a run that lasts until the last of the times."""
        self.times = np.atleast_1d(np.asarray(_seconds(times), dtype=float))
        if not np.isfinite(self.times).all() or self.times.ndim != 1 or not self.times.size:
            raise ValueError(f"`times` are numbers in s, not {times!r}")
        if over not in (None, "run") or any(map(_is_over_time, texts.values())):
            raise TypeError("`times` are those of a run, and results are quantities such as \"steel.T\"")
        if any(map(_MARGIN.match, texts.values())):
            raise TypeError("a margin has no time: write its quantity")
        stop, tolerance = run
        self._order_of_times = np.unique(self.times, return_inverse=True)
        if stop is not None:
            raise TypeError("a run with `times` lasts until the last of them: leave out `stop`")
        stop = f"{float(self.times.max())!r} s"
        return {name: f"last({text})" for name, text in texts.items()}, "run", (stop, tolerance)

    @property
    def x0(self) -> np.ndarray:
        """The values of the parameters in the netlist."""
        return np.array(self._of.own())

    def __call__(self, x: Any) -> tuple[Any, np.ndarray]:
        """The value and its gradient."""
        at = np.atleast_1d(np.asarray(x, dtype=float)).reshape(-1)
        if not np.isfinite(at).all():
            raise ValueError(f"the parameters are numbers, not {at.tolist()}")
        if self._last is None or self._last[0] != at.tobytes():
            of, by = self._found(at) if self.times is None else self._series(at)
            self._last = (at.tobytes(), (of[0], by[0]) if self._one else (of, by))
        value, gradient = self._last[1]
        return (float(value) if value.ndim == 0 else value.copy()), gradient.copy()

    def _found(self, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, slopes = self._of.at(at.tolist())
        return np.array(values)[self._order], np.reshape(slopes, (-1, len(at)))[self._order]

    def _series(self, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        times, place = self._order_of_times
        found = self._of.series(at.tolist(), times.tolist())
        of = np.array([values for values, _ in found])[self._order]
        by = np.moveaxis(np.array([slopes for _, slopes in found])[self._order], 1, 2)
        return of[:, place], by[:, place]

    def value(self, x: Any) -> Any:
        """The value alone."""
        return self(x)[0]

    def jac(self, x: Any) -> np.ndarray:
        """The gradient alone, kept from the last call at the same values."""
        return self(x)[1]

    def jax(self) -> Any:
        """A function of JAX, which `jax.grad` and `jax.jacrev` differentiate once."""
        return _jax(self)

    def __reduce__(self) -> Any:
        return (Function, self._made)

    def __repr__(self) -> str:
        of = ", ".join(f"{name} [{unit}]" for name, unit in zip(self.names, self.units))
        by = ", ".join(f"{name} [{unit}]" for name, unit in zip(self.parameters, self.x_units))
        return f"<lptn.Function {of} of {by}>"


def _seconds(times: Any) -> Any:
    """Times in s: numbers, a column with its unit, or numbers with one, `([0, 10], "min")`."""
    numbers, unit = times, getattr(times, "unit", None)
    if isinstance(times, tuple) and len(times) == 2 and isinstance(times[1], str):
        numbers, unit = times
    scale, _, si = _lptn.unit(unit or "s")
    if si != "s":
        raise ValueError(f"`times` are in a unit of time, not {unit}")
    return np.asarray(numbers, dtype=float) * scale


def _check(texts: dict[str, str], by: list[str], over: str | None) -> None:
    twice = [name for name in by if by.count(name) > 1]
    if not texts or not by:
        raise TypeError("a gradient needs a result and a parameter: `of` and `by` name at least one")
    if twice:
        raise TypeError(f"`by` names `{twice[0]}` more than once")
    if over is not None:
        one_of("over", over, _OVER)


def _rename(error: Error, results: list[str], lines: int) -> None:
    """Problems of the study name the results."""
    for problem in error.errors:
        for place, text in enumerate(results):
            problem.message = problem.message.replace(f"report `lptn_result_{place}`", f"`{text}`")
    error.within(lines)


def _named(of: str | Sequence[str] | Mapping[str, str]) -> dict[str, str]:
    if isinstance(of, str):
        return {of: of}
    return dict(of) if isinstance(of, Mapping) else {text: text for text in of}


def _over(texts: list[str]) -> str:
    """Over a run if a result is a functional over time."""
    if any(map(_is_over_time, texts)):
        return "run"
    if any(_MARGIN.match(text) for text in texts):
        raise TypeError('a margin is one of a steady state or of a run: say over="steady" or "run"')
    return "steady"


def _is_over_time(text: str) -> bool:
    """True for `mean(max(a.T, b.T))`, false for `max(a.T, b.T)` and `max(a.T) - max(b.T)`."""
    found, depth = _OVER_TIME.match(text), 0
    for character in found[1] if found else "":
        depth += {"(": 1, ")": -1}.get(character, 0)
        if depth < 0 or depth == 0 and character == ",":
            return False
    return found is not None or _LEVELS.match(text) is not None


def _split(texts: dict[str, str]) -> tuple[dict[str, str], dict[str, str]]:
    found = {name: _MARGIN.match(text) for name, text in texts.items()}
    margins = {name: match[1].strip() for name, match in found.items() if match}
    return margins, {name: text for name, text in texts.items() if name not in margins}


def _study(network: Network, by: list[str], reports: dict[str, str], over: str) -> str:
    """A sweep of one candidate: the parameters at their own values, the results as reports."""
    own = [f"{value!r} {unit}".strip() for value, unit in known(network._netlist, by)]
    axes = [f"{json.dumps(name)} = [{json.dumps(text)}]" for name, text in zip(by, own)]
    lines = ["[sweep.lptn_gradient]", 'method = "list"', f"over = {json.dumps(over)}"]
    lines += ["[sweep.lptn_gradient.axes]", *axes, "[sweep.lptn_gradient.report]"]
    named = [f"lptn_result_{place} = {json.dumps(text)}" for place, text in enumerate(reports.values())]
    # a study has at least one report; this one is not evaluated
    return "\n".join([*lines, *(named or ["lptn_result = 0"])]) + "\n"


def _jax(function: Function) -> Any:
    try:
        import jax
        import jax.numpy as jnp
    except ImportError:
        raise ImportError("a function of JAX needs JAX: pip install jax") from None

    shape = () if function._one else (len(function.names),)
    shape += () if function.times is None else (len(function.times),)
    size = len(function.parameters)

    def asked(x: Any) -> Any:
        kind = jnp.result_type(float)
        shapes = (jax.ShapeDtypeStruct(shape, kind), jax.ShapeDtypeStruct((*shape, size), kind))

        def ask(x: Any) -> Any:
            value, gradient = function(np.asarray(x))
            return np.asarray(value, dtype=kind), np.asarray(gradient, dtype=kind)

        return jax.pure_callback(ask, shapes, x, vmap_method="sequential")

    @jax.custom_vjp
    def value(x: Any) -> Any:
        return asked(x)[0]

    def forward(x: Any) -> Any:
        return asked(x)

    def backward(gradient: Any, by: Any) -> Any:
        return (jnp.tensordot(by, gradient, len(shape)),)

    value.defvjp(forward, backward)
    return value
