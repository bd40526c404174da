"""A network whose laws depend on temperature or time, as files for lptn and for its C program.

`net.bin` has the number of arrays, their lengths and their numbers. Array 0 holds t_end, rows,
nodes and the numbers of the law, array 1 the probes, array 2 the temperatures at the start; the
others are listed in the C program.
"""

import json
import struct
from dataclasses import dataclass, field

import numpy as np

from network import six_digits


@dataclass
class Law:
    """What a family makes. `columns` are the names of the probes in lptn's table."""

    program: str
    text: str
    n: int
    paths: int
    probes: list[int]
    columns: list[str]
    t_end: float
    rows: int
    numbers: list[float]
    start: np.ndarray
    arrays: list[np.ndarray] = field(default_factory=list)
    files: dict[str, str] = field(default_factory=dict)

    def binary(self):
        head = np.array([self.t_end, self.rows, self.n, *self.numbers])
        arrays = [head, np.array(self.probes, float), self.start, *self.arrays]
        lengths = struct.pack(f"<{1 + len(arrays)}q", len(arrays), *map(len, arrays))
        return lengths + b"".join(np.asarray(x, "<f8").tobytes() for x in arrays)

    def netlist(self):
        select = ", ".join(f'"{column}"' for column in self.columns)
        every = self.t_end / self.rows
        return (
            f'format = 1\n{self.text}\n[run]\nstop = "{self.t_end!r} s"\n'
            f'output = {{ every = "{every!r} s" }}\nselect = [{select}]\n'
        )

    def write(self, name, folder):
        """Writes netlist, numbers and CSV files into a folder; `case.json` last."""
        (folder / "net.toml").write_text(self.netlist())
        (folder / "net.bin").write_bytes(self.binary())
        for file, text in self.files.items():
            (folder / file).write_text(text)
        about = dict(
            name=name,
            program=self.program,
            steady=name.startswith("steady-"),
            n=self.n,
            paths=self.paths,
            linear=False,
            t_end=self.t_end,
            rows=self.rows,
            probes=self.probes,
            columns=self.columns,
        )
        (folder / "case.json").write_text(json.dumps(about))


def spread(rng, low, high, count):
    """Numbers between two, of six digits: the same with every NumPy."""
    return six_digits(rng.uniform(low, high, count))


def entries(section, lines):
    return f"\n[{section}]\n" + "\n".join(lines) + "\n"
