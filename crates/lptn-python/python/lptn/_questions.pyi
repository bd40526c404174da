"""Questions to a network. Written by tests/stub.py from the declarations in src/verbs.rs."""

import os
from collections.abc import Sequence
from typing import Any, SupportsFloat

from . import _lptn
from ._messages import Error, Problem
from ._network import Network
from ._progress import Told
from ._result import Explain, Result

# A text, a path, a number, a number with its unit.
Text = str | os.PathLike[str] | SupportsFloat | tuple[float, str]
Netlist = str | os.PathLike[str] | Network

RECORDS: tuple[str, ...]

def answered(
    answer: _lptn.Answer,
    question: str,
    words: dict[str, Any],
    level: int,
    explain: Explain | None = None,
    network: Any = None,
) -> Result: ...
def more(question: str, sets: bool) -> list[tuple[str, str]]: ...
def paths(netlists: tuple[Any, ...]) -> list[str]: ...
def method_name(question: str) -> str: ...

class Questions:
    _set: dict[str, Any]
    @property
    def _files(self) -> list[tuple[str, bytes]]: ...
    @property
    def _netlist(self) -> _lptn.Netlist: ...
    def _with_data(self, question: str, study: str | None, data: Any) -> _lptn.Netlist: ...
    def _explain(self, of: Error | list[Problem], data: bool = False) -> None: ...
    def check(
        self,
        *netlists: Netlist,
        case: Text | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Check a netlist, and show all its problems: `lptn check`."""
    def run(
        self,
        *,
        case: Text | None = None,
        stop: Text | None = None,
        every: Text | None = None,
        select: Text | Sequence[Text] | None = None,
        temperature_unit: Text | None = None,
        time_unit: Text | None = None,
        balance: Text | None = None,
        tolerance: Text | None = None,
        certify: bool = False,
        uncertainty: Text | None = None,
        posterior: Text | None = None,
        samples: int | None = None,
        seed: int | None = None,
        threads: int | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Simulate a network over time: `lptn run`."""
    def steady(
        self,
        *,
        case: Text | None = None,
        select: Text | Sequence[Text] | None = None,
        temperature_unit: Text | None = None,
        balance: Text | None = None,
        certify: bool = False,
        periodic: bool = False,
        period: Text | None = None,
        tolerance: Text | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Find the steady state of a network: `lptn steady`."""
    def modes(
        self,
        *,
        case: Text | None = None,
        count: int | None = None,
        at: Text | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """List time constants and modes: `lptn modes`."""
    def verify(
        self,
        *,
        case: Text | None = None,
        tolerance: Text | None = None,
        at: Text | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Compare a run with an independent solution: `lptn verify`."""
    def compare(
        self,
        *netlists: Netlist,
        posterior: Text | None = None,
        uncertainty: bool = False,
        parts: Text | Sequence[Text] | None = None,
        cases: bool = False,
        periodic: bool = False,
        sort: Text | None = None,
        temperature_unit: Text | None = None,
        threads: int | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text | Sequence[Text] | tuple[Sequence[float], str],
    ) -> Result:
        """Compare designs: `lptn compare`."""
    def size(
        self,
        name: Text | None = None,
        *,
        posterior: Text | None = None,
        certify: bool = False,
        threads: int | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Find the value that keeps the limits: `lptn size`."""
    def rank(
        self,
        *,
        case: Text | None = None,
        of: Text | None = None,
        over: Text | None = None,
        temperature_unit: Text | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Rank the values that matter most for a node: `lptn rank`."""
    def sweep(
        self,
        name: Text | None = None,
        *,
        case: Text | None = None,
        temperature_unit: Text | None = None,
        shard: Text | None = None,
        threads: int | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Solve many candidates: `lptn sweep`."""
    def fit(
        self,
        name: Text | None = None,
        *,
        starts: int | None = None,
        data: Any = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Fit parameters to records: `lptn fit network`."""
    def fit_compare(
        self,
        *netlists: Netlist,
        fit: Text | Sequence[Text] | None = None,
        starts: int | None = None,
        threads: int | None = None,
    ) -> Result:
        """Choose between networks by records: `lptn fit compare`."""
    def infer(
        self,
        name: Text | None = None,
        *,
        data: Any = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Estimate heat or temperature over time from records: `lptn infer`."""
    def plan(
        self,
        name: Text | None = None,
        *,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Plan a measurement: `lptn plan`."""
    def reduce(
        self,
        port: Text | None = None,
        *,
        case: Text | None = None,
        keep: Text | Sequence[Text] | None = None,
        max_error: Text | None = None,
        error: Text | None = None,
        power: Text | None = None,
        nodes: int | None = None,
        for_: Text | None = None,
        definition: Text | None = None,
        bias: bool = False,
        window: Text | None = None,
        at: Text | None = None,
        temperature_unit: Text | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Replace a network by a few nodes: `lptn reduce`."""
    def impedance(
        self,
        port: Text | None = None,
        *,
        case: Text | None = None,
        to: Text | None = None,
        time: Text | None = None,
        duty: Text | None = None,
        omega: bool | Text | Sequence[Text] = False,
        foster: bool | Text | Sequence[Text] = False,
        cauer: bool | Text | Sequence[Text] = False,
        at: Text | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Compute step, pulse or frequency response: `lptn impedance`."""
    def gear(
        self,
        name: Text | None = None,
        *,
        case: Text | None = None,
        speed: Text | Sequence[Text] | None = None,
        torque: Text | Sequence[Text] | None = None,
        temperature: Text | Sequence[Text] | None = None,
        temperature_unit: Text | None = None,
        progress: bool | Told = False,
        set: dict[str, Any] | None = None,
        options: dict[str, Any] | None = None,
        **parameters: Text,
    ) -> Result:
        """Losses and efficiency of a gearbox: `lptn gear`."""
