"""Networks, and the questions to them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from . import _lptn
from ._frame import sweep as frame_sweep
from ._messages import Problem, problems
from ._questions import Questions, answered, paths
from ._result import Result


class Network(Questions):
    """A network of a netlist: load it by `lptn.load`.

    Each question of the command line is a method: `net.run(G_out="4 W/K", stop="2 h")`. A keyword is
    an option of the command or a parameter of the netlist.
    """

    def __init__(self, netlist: _lptn.Netlist, source: tuple[Any, ...]) -> None:
        self._netlist = netlist
        self._source = source
        self._set = source[-1]

    @property
    def file(self) -> str | None:
        """The file; `None` for a text."""
        return self._source[1] if self._source[0] == "load" else None

    @property
    def title(self) -> str:
        """The title, or the name of the file."""
        return self._netlist.title()

    @property
    def doubts(self) -> list[Problem]:
        """Doubts about the netlist."""
        return problems(self._netlist.doubts())

    @property
    def parameters(self) -> dict[str, str]:
        """The parameters with their values."""
        of = self._netlist.parameters()
        return {name: f"{value!r} {unit}".strip() for name, value, unit in of}

    @property
    def nodes(self) -> list[str]:
        """The names of the nodes."""
        return self._netlist.nodes()

    def to_toml(self) -> str:
        """The flat netlist of the network, as `lptn check --expand` prints it."""
        return self._netlist.to_toml()

    @property
    def text(self) -> tuple[str, str]:
        """The text of the netlist, and its name."""
        if self._source[0] == "parse":
            return self._source[1], self._source[2]
        with open(self._source[1], encoding="utf-8") as file:
            return file.read(), self._source[1]

    def sweep(
        self,
        name: Any = None,
        *,
        over: str | None = None,
        report: Mapping[str, str] | None = None,
        **words: Any,
    ) -> Result:
        """Solve many candidates: `lptn sweep`, or the rows of a frame.

            net.sweep({"G_out": [3, 4, 5]}, report={"hot": "steel.T"})

        A frame is a DataFrame or a dictionary of columns, each with the name of a parameter, or with
        its unit too: `"G_out [W/K]"`. A number is in the unit of the parameter in the netlist. `over`
        is "steady", "run" or "periodic"; without `report` the temperatures of the nodes are reported.
        """
        if name is None or isinstance(name, (str, os.PathLike)):
            if over is not None or report is not None:
                raise TypeError("`over` and `report` belong to a frame: a study has its own")
            return super().sweep(name, **words)
        return frame_sweep(self, name, over or "steady", report, words)

    def simulation(self) -> Simulation:
        """A simulation of the network, to be stepped."""
        return Simulation(self)

    def __repr__(self) -> str:
        return f"<lptn.Network {self.title}>"

    def __reduce__(self) -> Any:
        return (_again, self._source)


def load(file: str | os.PathLike[str], /, **parameters: Any) -> Network:
    """Reads a netlist; parameters get these values in every question.

    Raises `lptn.Error` with all problems of the netlist.
    """
    name = os.fspath(file)
    return Network(_lptn.Netlist.read(name, parameters), ("load", name, parameters))


def parse(text: str, /, name: str = "netlist.toml", **parameters: Any) -> Network:
    """Reads a netlist from a text; files that it names are relative to the place of `name`."""
    netlist = _lptn.Netlist.parse(text, name, parameters)
    return Network(netlist, ("parse", text, name, parameters))


def _again(how: str, text: str, *rest: Any) -> Network:
    return load(text, **rest[0]) if how == "load" else parse(text, rest[0], **rest[1])


def asked(question: str, files: list[Any], words: dict[str, Any]) -> Result:
    """Asks a question that is not about one network."""
    return answered(_lptn.ask(question, paths(tuple(files)), words), question, words, 2)


class Simulation:
    """A network with its state at a time, stepped by the program: a controller, a cosimulation.

    `sim["steel.T"]` is the present temperature in `sim.temperature_unit`.
    """

    def __init__(self, network: Network) -> None:
        self.network = network
        self._of = _lptn.Simulation(network._netlist)

    @property
    def time(self) -> float:
        """The time that was reached, in s."""
        return self._of.time

    @property
    def temperature_unit(self) -> str:
        """The unit of temperatures: that of the netlist."""
        return self._of.temperature_unit

    @property
    def events(self) -> list[tuple[float, str, str, bool, bool]]:
        """The events of the last step: time in s, kind, name, state before and after."""
        return self._of.events

    def __getitem__(self, name: str) -> float:
        """The temperature of a node: `sim["steel.T"]`."""
        return self._of.temperature(name.removesuffix(".T"))

    def temperature(self, node: str) -> float:
        """The temperature of a node, in the unit of temperatures."""
        return self._of.temperature(node)

    def state(self, name: str) -> float:
        """The value of a state of `[state]`, in its SI unit."""
        return self._of.state(name)

    def set(self, **inputs: Any) -> None:
        """Fixes parameters and signals from now on: `sim.set(P_7000=(220, "W"))`."""
        for name, value in inputs.items():
            self._of.set(name, value)

    def release(self, *names: str) -> None:
        """Gives signals their own time histories again, parameters their own values."""
        for name in names:
            self._of.release(name)

    def step(self, length: Any) -> None:
        """Steps by a time such as "10 s"."""
        self._of.step(length)

    def advance(self, to: Any) -> None:
        """Steps to a time such as "10 min"."""
        self._of.advance(to)

    def event_indicators(self) -> dict[str, tuple[float, str]]:
        """The distance to every event: number and unit, zero at the event."""
        return {name: (value, unit) for name, value, unit in self._of.event_indicators()}

    def save(self) -> str:
        """The state, for `restore`."""
        return self._of.save()

    def restore(self, saved: str) -> None:
        """Goes to a state that a simulation of the same network saved."""
        self._of.restore(saved)

    def __repr__(self) -> str:
        return f"<lptn.Simulation of {self.network.title} at {self.time:g} s>"

    def __reduce__(self) -> Any:
        return (_restored, (self.network, self.save()))


def _restored(network: Network, saved: str) -> Simulation:
    simulation = Simulation(network)
    simulation.restore(saved)
    return simulation
