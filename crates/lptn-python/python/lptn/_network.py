"""Networks, and the questions to them."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _lptn
from ._frame import explain as explain_sweep
from ._frame import sweep as frame_sweep
from ._made import Tables, of_text
from ._made import keys as made_keys
from ._memory import File, merged, records
from ._memory import explain as explain_rows
from ._memory import files as memory_files
from ._messages import Error, Problem, problems
from ._questions import Questions, answered, paths
from ._result import Result
from ._values import given, values

if TYPE_CHECKING:
    from ._gradient import Function
    from ._simulation import Simulation


class Source(NamedTuple):
    """The netlist of a network: its text, or `None` for that of the file `name`."""

    text: str | None
    name: str
    parameters: dict[str, Any]
    files: list[File]

    def read(self, parameters: dict[str, Any]) -> _lptn.Netlist:
        """Reads it with these parameters."""
        if self.text is None:
            return _lptn.Netlist.read(self.name, parameters, self.files)
        return _lptn.Netlist.parse(self.text, self.name, parameters, self.files)

    def known(self) -> Source:
        """The same with parameters as the netlist reads them."""
        return self._replace(parameters=values(self.parameters, lambda: self.read({})))


class Network(Questions):
    """A network: loaded by `lptn.load`, or made in code.

    Each question of the command line is a method: `net.run(G_out="4 W/K", stop="2 h")`. A keyword is
    an option of the command or a parameter of the netlist.

        net = lptn.Network("A block in air")
        net.parameter("P", "40 W")
        block = net.node("block", C="500 J/K", T0="25 degC")
        air = net.boundary("air", T="25 degC")
        net.path("resistor", "cooling", block, air, G="2 W/K")
        net.source("heat", block, P="P")

    The netlist is checked with the first question. Errors name the entry and the line that made it.
    """

    def __init__(self, title: str | None = None, *, name: str = "network.toml") -> None:
        tables = Tables(name, {})
        if title is not None:
            tables.top("title", title)
        self._of_tables(tables)

    def _of_tables(self, tables: Tables) -> Network:
        self._tables: Tables | None = tables
        self._loaded: _lptn.Netlist | None = None
        self._source = Source(None, tables.name, tables.parameters, [])
        self._set = tables.parameters
        return self

    @classmethod
    def _of(cls, source: Source) -> Network:
        network = cls.__new__(cls)
        network._tables, network._loaded = None, source.read(source.parameters)
        network._source, network._set = source, source.parameters
        return network

    @classmethod
    def from_toml(
        cls,
        text: str,
        /,
        name: str = "netlist.toml",
        *,
        files: Mapping[str, Any] | None = None,
        **parameters: Any,
    ) -> Network:
        """The network of a text, to which entries can be added; `files` as in `lptn.parse`."""
        memory = memory_files(files)
        own = values(parameters, lambda: _lptn.Netlist.parse(text, name, {}, memory))
        return cls.__new__(cls)._of_tables(of_text(text, name, own, memory))

    @property
    def _netlist(self) -> _lptn.Netlist:
        return self._loaded if self._loaded is not None else self._entries.netlist

    @property
    def _files(self) -> list[File]:
        """The files in memory that the netlist names."""
        return self._source.files if self._tables is None else self._tables.files

    def _with(self, more: str = "", files: list[File] | None = None) -> _lptn.Netlist:
        """The netlist with more text and other files in memory."""
        text, name = self.text
        return _lptn.Netlist.parse(text + more, name, self._set, merged(self._files, files or []))

    def _with_data(self, question: str, study: str | None, data: Any) -> _lptn.Netlist:
        """The netlist with frames in the place of the records of a study."""
        section = question.partition(" ")[0]
        all = [of for of in self._netlist.records() if of[0] == section]
        found = [of for of in all if study is None or of[1] == study]
        # without one study, the question has its own error
        if len(found) != 1:
            return self._netlist
        _, name, names = found[0]
        return self._with(files=records(f"[{section}.{name}]", names, data))

    def _explain(self, of: Error | list[Problem], data: bool = False) -> None:
        folder, names = os.path.dirname(self._source.name), [name for name, _ in self._files]
        if data:
            names += [name for *_, records in self._netlist.records() for name in records]
        explain_rows(of, (os.path.join(folder, name) for name in names))
        if self._tables is None:
            return
        self._tables.explain(of.errors if isinstance(of, Error) else of)
        if isinstance(of, Error):
            of.refresh()

    @property
    def _entries(self) -> Tables:
        if self._tables is None:
            raise TypeError(
                "a network that was loaded does not change: "
                "lptn.Network.from_toml(text) makes one that does"
            )
        return self._tables

    def add(self, section: str, name: str, value: Any = None, /, **keys: Any) -> str:
        """Adds an entry to any section of the netlist, and gives its name.

            net.add("material", "steel", k="45 W/(m K)", rho="7850 kg/m^3", cp="470 J/(kg K)")

        A keyword is a key of the entry, with `from_` for `from`. An entry that is one value, such as
        a parameter, is given as `value`. `lptn.help(section)` lists the keys.
        """
        if value is not None and keys:
            raise TypeError("an entry is one value or has keys")
        self._entries.add(section, name, made_keys(keys) if value is None else value)
        return name

    def parameter(self, name: str, value: Any) -> str:
        """Adds a parameter: a quantity, a number or an expression of other parameters."""
        return self.add("param", name, value)

    def node(self, name: str, **keys: Any) -> str:
        """Adds a node: `net.node("steel", C="2659 J/K", T0="25 degC")`."""
        return self.add("node", name, **keys)

    def boundary(self, name: str, T: Any) -> str:
        """Adds a boundary with a temperature."""
        return self.add("boundary", name, T=T)

    def path(self, kind: str, name: str, from_: Any, to: Any, **keys: Any) -> str:
        """Adds a path of heat: `net.path("convection", "skin", "steel", "air", R="0.3 K/W")`."""
        return self.add(kind, name, from_=from_, to=to, **keys)

    def source(self, name: str, into: Any, P: Any, **keys: Any) -> str:
        """Adds a source of heat."""
        return self.add("source", name, into=into, P=P, **keys)

    def state(self, name: str, **keys: Any) -> str:
        """Adds a state: `net.state("charge", rate="-I", start="2 A h")`."""
        return self.add("state", name, **keys)

    def limit(self, name: str, of: Any, **keys: Any) -> str:
        """Adds a limit: `net.limit("hot", "steel.T", below="90 degC")`."""
        return self.add("limit", name, of=of, **keys)

    def settings(self, stop: Any, every: Any = None, **keys: Any) -> None:
        """Sets the times of runs, [run]."""
        rows = {"output": {"every": every}} if every is not None else {}
        for key, value in made_keys({"stop": stop, **rows, **keys}).items():
            self._entries.add("run", key, value)

    @property
    def file(self) -> str | None:
        """The file; `None` for a text or a network made in code."""
        return self._source.name if self._tables is None and self._source.text is None else None

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
        """The netlist: the entries that were made, or the flat netlist of one that was loaded, as
        `lptn check --expand` prints it.

        Raises `lptn.Error` if a network that was loaded, such as one with a grid, has no flat form.
        """
        return self._netlist.to_toml() if self._tables is None else self._tables.text

    @property
    def text(self) -> tuple[str, str]:
        """The text of the netlist, and its name."""
        if self._tables is not None:
            return self._tables.text, self._tables.name
        if self._source.text is not None:
            return self._source.text, self._source.name
        with open(self._source.name, encoding="utf-8") as file:
            return file.read(), self._source.name

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
        try:
            if name is None or isinstance(name, (str, os.PathLike)):
                if over is not None or report is not None:
                    raise TypeError("`over` and `report` belong to a frame: a study has its own")
                return super().sweep(name, **words)._of_frame(None, words)
            return frame_sweep(self, name, over or "steady", report, words)
        except Error as error:
            explain_sweep(self, error, words.get("case"))
            raise

    def value_and_grad(
        self,
        of: str | Sequence[str] | Mapping[str, str],
        by: str | Sequence[str],
        *,
        over: str | None = None,
        stop: Any = None,
        tolerance: Any = None,
        times: Any = None,
    ) -> Function:
        """Results as a function of parameters: `value, gradient = function(x)`.

            hot = net.value_and_grad("max(steel.T)", by=["G_out", "P_7000"])
            goal = lambda x: ((hot(x)[0] - 80) ** 2, 2 * (hot(x)[0] - 80) * hot(x)[1])
            scipy.optimize.minimize(goal, hot.x0, jac=True, bounds=[(1, 20), (100, 400)])

        `of` is an expression of the steady state, or `last`, `max`, `min`, `mean` or `integral` of
        one over the run, or `margin(LIMIT)` with `over`; a list or a dictionary gives several. The
        gradient is exact: by the adjoint of a steady state or of a run, through its switches. `stop`
        and `tolerance` are those of the run: `last` with `stop="10 min"` is a value at 10 min.
        Conductances and capacities are positive: give an optimiser bounds, or logarithms.

        With `times` (in s, or with their unit: `([1, 2, 5], "min")`) results are quantities such as
        "steel.T", and their values and derivatives at all times of one run are arrays:

            model = net.value_and_grad("steel.T", by=["G_out"], times=record["t"])
            least_squares(lambda x: model.value(x) - record["T"], model.x0, jac=model.jac)
        """
        from ._gradient import Function

        run = (_lptn.quantity_text("stop", stop), _lptn.quantity_text("tolerance", tolerance))
        return Function(self, of, by, over, run, times)

    def simulation(self) -> Simulation:
        """A simulation of the network, to be stepped."""
        from ._simulation import Simulation

        return Simulation(self)

    def __repr__(self) -> str:
        return f"<lptn.Network {self.title}>"

    def __reduce__(self) -> Any:
        if self._tables is not None:
            return (_of_tables, (self._tables,))
        return (Network._of, (self._source,))


def load(
    file: str | os.PathLike[str],
    /,
    *,
    files: Mapping[str, Any] | None = None,
    **parameters: Any,
) -> Network:
    """Reads a netlist; parameters get these values in every question.

    `files` has frames in the place of CSV files that the netlist names: `{"record.csv": frame}`.

    Raises `lptn.Error` with all problems of the netlist.
    """
    name = os.fsdecode(file)
    if "\n" in name:
        raise TypeError("lptn.load reads a file: lptn.parse reads a text")
    return Network._of(Source(None, name, parameters, memory_files(files)).known())


def parse(
    text: str,
    /,
    name: str = "netlist.toml",
    *,
    files: Mapping[str, Any] | None = None,
    **parameters: Any,
) -> Network:
    """Reads a netlist from a text; files that it names are relative to the place of `name`.

    `files` has frames in the place of CSV files that the netlist names: `{"record.csv": frame}`.
    """
    if not isinstance(text, str):
        raise TypeError(f"a netlist is a text, not {type(text).__name__}: lptn.load reads a file")
    return Network._of(Source(text, name, parameters, memory_files(files)).known())


def _of_tables(tables: Tables) -> Network:
    return Network.__new__(Network)._of_tables(tables)


def asked(
    question: str, files: list[Any], words: dict[str, Any], memory: list[File] | None = None
) -> Result:
    """Asks a question that is not about one network; its records may be in memory."""
    memory, names = memory or [], paths(tuple(files))
    if question == "compare" and names:
        words = given(words, lambda: _lptn.Netlist.read(names[0], {}, []), several=True)

    def explain(of: Error | list[Problem]) -> None:
        explain_rows(of, (name for name, _ in memory))

    try:
        answer = _lptn.ask(question, names, words, memory)
    except Error as error:
        explain(error)
        raise
    return answered(answer, question, words, 3, explain)
