"""Networks that a program steps."""

from __future__ import annotations

from threading import RLock
from typing import TYPE_CHECKING, Any

from . import _lptn
from ._messages import Error
from ._result import Rows, Table
from ._values import values

if TYPE_CHECKING:
    from ._network import Network


class Simulation:
    """A network with its state at a time, stepped by the program: a controller, a cosimulation.

    `sim["steel.T"]` is the present temperature in `sim.temperature_unit`. Threads may share it: one
    waits for the step of another.
    """

    def __init__(self, network: Network) -> None:
        self.network = network
        self._of = _lptn.Simulation(network._netlist)
        # a second thread waits until a step has ended
        self._lock = RLock()

    @property
    def time(self) -> float:
        """The time that was reached, in s."""
        with self._lock:
            return self._of.time

    @property
    def temperature_unit(self) -> str:
        """The unit of temperatures: that of the netlist."""
        with self._lock:
            return self._of.temperature_unit

    @property
    def events(self) -> list[tuple[float, str, str, bool, bool]]:
        """The events of the last step: time in s, kind, name, state before and after."""
        with self._lock:
            return self._of.events

    def __getitem__(self, name: str) -> float:
        """The present value of a column, in its unit in `table`: a temperature, `sim["steel.T"]`; the
        heat of a path, a source or a boundary, `sim["skin.Q"]`; a state, a signal, a report.
        """
        node, _, quantity = name.rpartition(".")
        if node and quantity != "T":
            return float(self.table[name])
        try:
            return self.temperature(name.removesuffix(".T"))
        except Error:
            if name in self.table:
                return float(self.table[name])
            raise

    @property
    def table(self) -> Table:
        """All columns at the present time, each a number with its unit, as in a steady state."""
        with self._lock:
            columns = self._of.table()
        rows = [(name, unit, [value]) for name, unit, value in columns]
        return Table(Rows(rows), scalar=True)

    @property
    def ledger(self) -> Table:
        """The energy balance of the last step, as `ledger` of a run; without rows before a step."""
        from ._heats import of_heats

        with self._lock:
            return of_heats(self._of.ledger)

    def temperature(self, node: str) -> float:
        """The temperature of a node or boundary, in the unit of temperatures."""
        with self._lock:
            return self._of.temperature(node)

    def state(self, name: str) -> float:
        """The value of a state of `[state]`, in its SI unit."""
        with self._lock:
            return self._of.state(name)

    def set(self, **inputs: Any) -> None:
        """Fixes parameters and signals from now on: `sim.set(P_7000=(220, "W"))`."""
        for name, value in values(inputs, lambda: self.network._netlist).items():
            with self._lock:
                self._of.set(name, value)

    def release(self, *names: str) -> None:
        """Gives signals their own time histories again, parameters their own values."""
        for name in names:
            with self._lock:
                self._of.release(name)

    def step(self, length: Any) -> None:
        """Steps by a time such as "10 s"."""
        with self._lock:
            self._of.step(length)

    def advance(self, to: Any) -> None:
        """Steps to a time such as "10 min"."""
        with self._lock:
            self._of.advance(to)

    def event_indicators(self) -> dict[str, tuple[float, str]]:
        """The distance to every event: number and unit, zero at the event."""
        with self._lock:
            found = self._of.event_indicators()
        return {name: (value, unit) for name, value, unit in found}

    def save(self) -> str:
        """The state, for `restore`."""
        with self._lock:
            return self._of.save()

    def restore(self, saved: str) -> None:
        """Goes to a state that a simulation of the same network saved."""
        try:
            with self._lock:
                self._of.restore(saved)
        except (TypeError, ValueError):
            raise ValueError("`restore` takes a text that `save` of a simulation gave") from None

    def __repr__(self) -> str:
        return f"<lptn.Simulation of {self.network.title} at {self.time:g} s>"

    def __reduce__(self) -> Any:
        return (_restored, (self.network, self.save()))


def _restored(network: Network, saved: str) -> Simulation:
    simulation = Simulation(network)
    simulation.restore(saved)
    return simulation
