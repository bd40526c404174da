"""What is run: lptn and its peers, how each is called, and how its temperatures are read."""

import csv
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

PEERS = Path(__file__).parent / "peers"
RELATIVE = ["1e-3"] + [f"{d}e-{p}" for p in range(4, 12) for d in (3, 1)]
KELVIN = ["1"] + [f"{d}e-{p}" for p in range(1, 10) for d in (3, 1)]
SMALL = 10_000
"""Larger networks are not given to programs in Python."""


class Tool:
    """A program that solves a case. `ladder` are its tolerances, loosest first; `steady` its kind.

    `patience` is how much of the limit it may take: what is not a rival is not waited for."""

    ladder = RELATIVE
    steady = False
    patience = 1.0

    def __init__(self, name, program):
        self.name, self.program = name, program

    def missing(self):
        """Why it cannot run, or nothing."""
        return None if self.program and Path(self.program).exists() else "not built"

    def fits(self, case):
        """Whether it can or should solve a case."""
        return self.steady == case.steady and not case.program

    def stamp(self):
        """What tells this build of the program from another."""
        return hashlib.sha256(Path(self.program).read_bytes()).hexdigest()[:12]

    def rows(self, case, work):
        """The temperatures of the probes in degC, a row of the run each."""
        rows = np.fromfile(work / "rows.bin")
        return rows.reshape(case.shape) if rows.size == np.prod(case.shape) else None


class Lptn(Tool):
    """lptn as it is used: a netlist in, CSV out. PROGRAM:NAME runs it with that integrator."""

    ladder = KELVIN

    def __init__(self, called, name, steady):
        program, _, self.integrator = called.partition(":")
        super().__init__(name, program)
        self.steady = steady
        if steady:
            self.ladder = [""]

    def fits(self, case):
        return self.steady == case.steady

    def command(self, case, tolerance, work):
        file = case.netlist(self.integrator)
        if self.steady:
            return [self.program, "steady", file, "--format", "csv", *case.selected()]
        return [
            self.program,
            "run",
            file,
            "--no-files",
            "--format",
            "csv",
            "--tolerance",
            f"{tolerance}K",
        ]

    def rows(self, case, work):
        with open(work / "stdout") as text:
            columns = next(csv.reader([text.readline()]))
            rows = np.loadtxt(text, delimiter=",", ndmin=2)
        wanted = [columns.index(f"{name} [degC]") for name in case.columns]
        rows = rows[:, wanted] if self.steady else rows[1:, wanted]
        return rows if rows.shape == case.shape else None


class Cvode(Tool):
    """The C program on SUNDIALS; `method` is its linear solver."""

    def __init__(self, name, program, method):
        super().__init__(name, program)
        self.method = method

    def fits(self, case):
        if self.method == "klu" and case.n > 500_000:
            return False  # the fill of a million nodes takes hours in three dimensions
        return super().fits(case) and (case.linear or self.method == "klu")

    def command(self, case, tolerance, work):
        return [self.program, case.file("net.bin"), work / "rows.bin", tolerance, self.method]


class Law(Tool):
    """The C program for one family of laws.py."""

    def __init__(self, name, steady):
        super().__init__(name, folder() / "build")
        self.steady = steady
        if steady:
            self.ladder = ["1e-9"]

    def fits(self, case):
        return self.steady == case.steady and case.program is not None

    def stamp(self):
        """The time of the build that `program` names."""
        return str((self.program / "laws.built").stat().st_mtime_ns)

    def missing(self):
        return None if (self.program / "laws.built").exists() else "not built"

    def command(self, case, tolerance, work):
        mode = "steady" if self.steady else "run"
        return [
            self.program / case.program,
            case.file("net.bin"),
            work / "rows.bin",
            tolerance,
            mode,
        ]


class Steady(Tool):
    """The C program on CHOLMOD, KLU and its own conjugate gradients."""

    ladder = [""]
    steady = True

    def __init__(self, name, method, program, most):
        super().__init__(name, program)
        self.method, self.most = method, most

    def fits(self, case):
        return super().fits(case) and case.n <= self.most

    def command(self, case, tolerance, work):
        return [self.program, case.file("net.bin"), work / "rows.bin", self.method]


class Python(Tool):
    """A Python program of peers/; `needs` are the modules without which it cannot run."""

    patience = 0.3

    def __init__(self, name, script, method, needs, most=SMALL, steady=False):
        super().__init__(name, python_with(needs))
        self.script, self.method, self.needs, self.most = PEERS / script, method, needs, most
        self.steady = steady
        if steady:
            self.ladder = [""]

    def missing(self):
        return None if self.program else f"no {self.needs} for Python"

    def fits(self, case):
        return super().fits(case) and case.n <= self.most

    def stamp(self):
        return hashlib.sha256(self.script.read_bytes()).hexdigest()[:12]

    def command(self, case, tolerance, work):
        return [
            self.program,
            self.script,
            self.method,
            case.file("net.npz"),
            work / "rows.bin",
            tolerance or "-",
        ]


class Spice(Tool):
    """ngspice in batch mode: trapezoidal rule, tenth of a row as its suggested step."""

    patience = 0.1

    def missing(self):
        return None if self.program else "not installed"

    def fits(self, case):
        return super().fits(case) and case.file("deck.cir").exists()

    def command(self, case, tolerance, work):
        row = case.t_end / case.shape[0]
        largest = (
            case.t_end if float(tolerance) > 1e-5 else row / (1 if float(tolerance) > 1e-6 else 4)
        )
        deck = case.file("deck.cir").read_text()
        for mark, value in (
            ("@RELTOL@", tolerance),
            ("@STEP@", f"{row / 10:.6g}"),
            ("@LARGEST@", f"{largest:.6g}"),
        ):
            deck = deck.replace(mark, value)
        (work / "run.cir").write_text(deck)
        return [self.program, "-b", "-r", work / "raw", work / "run.cir"]

    def rows(self, case, work):
        names, values = raw(work / "raw")
        t, first = np.unique(values[:, 0], return_index=True)
        wanted = [names.index(f"v(n{i})") for i in case.probes]
        return between(t, values[first][:, wanted], case.row_times())


def raw(path):
    """Names and columns of ngspice's binary file."""
    text = path.read_bytes()
    at = text.index(b"Binary:\n")
    head = text[:at].decode("latin1").splitlines()
    said = {line.split(":")[0]: line.split(":")[1] for line in head if ":" in line}
    columns, points = int(said["No. Variables"]), int(said["No. Points"])
    begin = head.index("Variables:") + 1
    names = [line.split()[1] for line in head[begin : begin + columns]]
    return names, np.frombuffer(text, "<f8", columns * points, at + 8).reshape(points, columns)


def between(t, values, at):
    """Values at other times, by monotone cubics."""
    from scipy.interpolate import PchipInterpolator  # ngspice alone needs it

    return PchipInterpolator(t, values)(np.minimum(at, t[-1]))


def python_with(modules):
    """A Python that has some modules: this one, or that of the bench's own folder; or nothing."""
    for python in (sys.executable, str(folder() / "venv/bin/python")):
        wanted = f"import {modules}"
        if (
            Path(python).exists()
            and subprocess.run([python, "-c", wanted], capture_output=True).returncode == 0
        ):
            return python
    return None


def folder():
    """Where cases, builds and references are kept."""
    root = Path(__file__).parent.parent
    return Path(os.environ.get("BENCH_DIR", root / "target/bench"))


def peers():
    """Every peer, installed or not."""
    build = folder() / "build"
    cvode, steady = build / "cvode", build / "steady"
    return [
        Cvode("CVODE+KLU", cvode, "klu"),
        Cvode("CVODE+SPGMR+IC(0)", cvode, "spgmr"),
        Law("C for the family", False),
        Law("C for the family", True),
        Spice("ngspice", shutil.which("ngspice")),
        Python("SciPy BDF", "ode.py", "bdf", "numpy, scipy"),
        Python("scikit-sundae", "ode.py", "sundae", "sksundae, scipy"),
        Steady("CHOLMOD, AMD", "chol_amd", steady, 200_000),
        Steady("CHOLMOD, METIS", "chol_metis", steady, 200_000),
        Steady("KLU, AMD", "klu", steady, 50_000),
        Steady("CG+IC(0)", "pcg_ic0", steady, 10**8),
        Python("SciPy splu", "equilibrium.py", "splu", "numpy, scipy", 50_000, True),
        Python("pyamg", "equilibrium.py", "amg", "pyamg", 10**8, True),
    ]
