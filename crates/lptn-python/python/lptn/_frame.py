"""Candidates of a sweep from a frame: columns of parameters, a row for each candidate."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from . import _lptn
from ._messages import CANDIDATES, Error, Problem
from ._progress import shown
from ._questions import answered
from ._result import Result
from ._values import known, one_of

if TYPE_CHECKING:
    from ._numpy import np
    from ._network import Network

# Most temperatures that are reported without being asked for.
_REPORTED = 20


def sweep(
    network: Network,
    frame: Any,
    over: str,
    report: Mapping[str, str] | None,
    words: dict[str, Any],
) -> Result:
    """Solves the rows of a frame: a DataFrame, or a dictionary of columns."""
    one_of("over", over, ("steady", "run", "periodic"))
    columns = _columns(network, frame)
    text, _ = network.text
    study = "frame"
    # the netlist may have a study of this name
    while study in text:
        study += "_"
    lines = ["", f"[sweep.{study}]", 'method = "csv"', f"file = {json.dumps(CANDIDATES)}"]
    lines += [f"over = {json.dumps(over)}", f"[sweep.{study}.report]"]
    named = report or _temperatures(network, over)
    if not isinstance(named, Mapping):
        raise TypeError('report takes names and results: {"hot": "steel.T"}')
    lines += [f"{key} = {json.dumps(of)}" for key, of in named.items()]
    try:
        file = (CANDIDATES, _lptn.csv(columns))
        netlist = network._with("\n".join(lines) + "\n", [file])
        with shown(words) as words:
            answer = netlist.ask("sweep", [], {**words, "name": study})
    except Error as error:
        error.within(text.count("\n") + 1)
        raise
    result = answered(answer, "sweep", words, 3, network=network)
    return result._of_frame(frame.index if hasattr(frame, "reset_index") else None, words)


def explain(network: Network, error: Error, case: Any) -> None:
    """Says why the first candidate failed: it is solved alone."""
    result = error.result
    if result is None or "failed" not in result or not error.code:
        return
    first = next(place for place, code in enumerate(result["failed"]) if code)
    reason = _alone(network, result, first, case)
    if reason is not None and reason.code == error.code:
        problem = error.errors[0]
        problem.message = problem.message.removesuffix(problem.code) + reason.message
        problem.help = reason.help
        error.refresh()


def failures(network: Network | None, result: Result) -> dict[int, Problem]:
    """The problems of the candidates that failed: each is solved alone if the network is known."""
    if "failed" not in result:
        raise TypeError(f"`{result.question}` has no candidates")
    found: dict[int, Problem] = {}
    for place, code in enumerate(result["failed"]):
        if not code:
            continue
        reason = _alone(network, result, place, result._case) if network is not None else None
        known = reason is not None and reason.code == code
        own = {"code": code, "severity": "error", "message": f"the candidate failed: {code}"}
        found[int(result["case"][place])] = reason if known and reason else Problem(own)
    return found


def _alone(network: Network, result: Result, place: int, case: Any) -> Problem | None:
    """The problem of one candidate, solved alone."""
    study, units = result.data["sweep"], result.table.units
    values = {
        name: (float(result[name][place]), units[name])
        for name in network.parameters
        if name in units
    }
    question = "run" if study["over"] == "run" else "steady"
    words = {"periodic": True} if study["over"] == "periodic" else {}
    try:
        network._netlist.ask(question, [], {**words, "case": case, "set": values})
    except Error as reason:
        network._explain(reason)
        return reason.errors[0] if reason.errors else None
    return None


def _columns(network: Network, frame: Any) -> list[tuple[str, bytes]]:
    """The columns with the headings of a CSV file, such as `G_out [W/K]`, and their numbers."""
    columns: dict[str, np.ndarray] = {}
    if not hasattr(frame, "columns") and not isinstance(frame, Mapping):
        kind = type(frame).__name__
        raise TypeError(f'a frame is a DataFrame or a dictionary such as {{"G": [3, 4]}}, not {kind}')
    # polars has `columns`, dictionaries have `keys`, pandas both
    heads = list(frame.columns if hasattr(frame, "columns") else frame)
    names = [str(head).partition("[")[0].strip() for head in heads]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise TypeError(f"the frame has more than one column `{twice[0]}`")
    other = [name for name in names if name not in network.parameters]
    if other and any(name in network.parameters for name in names):
        own = [name for name in names if name not in other]
        raise TypeError(f"`{other[0]}` is not a parameter of the network: take frame[{own}]")
    for head, name, (_, unit) in zip(heads, names, known(network._netlist, names)):
        heading = str(head) if "[" in str(head) or not unit else f"{name} [{unit}]"
        columns[heading] = _numbers(name, frame[head])
        _finite(name, columns[heading], getattr(frame, "index", None))
    if len({len(numbers) for numbers in columns.values()}) != 1:
        lengths = ", ".join(f"{name} {len(of)}" for name, of in columns.items()) or "none"
        raise TypeError(f"a frame has columns of one length, at least one: it has {lengths}")
    return [(heading, numbers.tobytes()) for heading, numbers in columns.items()]


def _numbers(name: str, column: Any) -> np.ndarray:
    if isinstance(column, str) or not hasattr(column, "__iter__") or getattr(column, "ndim", 1) == 0:
        raise TypeError(f"column `{name}` of the frame is a list of numbers, not {column!r}")
    from ._numpy import np

    if getattr(getattr(column, "dtype", None), "kind", "") in ("f", "i", "u") and column.ndim == 1:
        return np.asarray(column, dtype=np.float64)
    cells = column.tolist() if hasattr(column, "tolist") else list(column)
    return np.array([_number(name, *cell) for cell in enumerate(cells)], dtype=np.float64)


def _number(name: str, row: int, value: Any) -> float:
    if isinstance(value, str):
        raise TypeError(f"column `{name}` has numbers, not {value!r}: its heading has the unit, {name} [W]")
    truth = type(value).__name__ in ("bool", "bool_")
    if truth or not hasattr(value, "__float__") or getattr(value, "ndim", 0):
        raise TypeError(f"column `{name}` of the frame has numbers, not {value!r} as in row {row}")
    return float(value)


def _finite(name: str, numbers: np.ndarray, index: Any) -> None:
    """Refuses the first number that is not finite; `index` is that of a frame of pandas."""
    from ._numpy import np

    wrong = np.flatnonzero(~np.isfinite(numbers))
    if len(wrong):
        row = int(wrong[0])
        label = f" ({index[row]!r})" if hasattr(index, "names") else ""
        raise ValueError(
            f"column `{name}` of the frame is {numbers[row]} in row {row}{label}: leave the row out"
        )


def _temperatures(network: Network, over: str) -> dict[str, str]:
    """The temperatures of the nodes, over a run their maxima."""
    nodes = [name for name in network.nodes if name.isidentifier()][:_REPORTED]
    form = "{}.T" if over == "steady" else "max({}.T)"
    return {f"{node}_T": form.format(node) for node in nodes}
