"""A case: a folder with one network in every form, and its reference."""

import json
import os
import tempfile
from pathlib import Path

import numpy as np

import families
import forms
import laws
import reference
import tools


class Case:
    """What `case.json` tells, and the temperatures that are right."""

    def __init__(self, place):
        self.place = place
        about = json.loads(self.file("case.json").read_text())
        self.name, self.n, self.paths = about["name"], about["n"], about["paths"]
        self.steady, self.linear = about["steady"], about["linear"]
        self.t_end, self.probes = about["t_end"], about["probes"]
        self.columns, self.program = about["columns"], about.get("program")
        self.shape = (1 if self.steady else about["rows"], len(self.probes))
        self.right, self.known = None, ""

    def file(self, name):
        return self.place / name

    def netlist(self, integrator):
        """The netlist, or a copy of it that names an integrator; [run] is its last section."""
        plain = self.file("net.toml")
        if not integrator:
            return plain
        other = self.file(f"net.{integrator}.toml")
        other.write_text(plain.read_text() + f'integrator = "{integrator}"\n')
        return other

    def selected(self):
        """The probes, as options of lptn."""
        return [word for column in self.columns for word in ("--select", column)]

    def row_times(self):
        return np.linspace(0, self.t_end, self.shape[0] + 1)[1:]

    def error(self, rows):
        """The largest error of any probe at any row, relative to the range of all that is right."""
        error = np.abs(rows - self.right).max()
        return float(error / np.ptp(self.right)) if np.isfinite(error) else None


def load(name):
    """A case with its reference, made where it is not there yet."""
    place = tools.folder() / "cases" / name
    if not (place / "case.json").exists():
        make(name, place)
    case = Case(place)
    case.right, case.known = reference.load(case)
    return case


def make(name, place):
    """Writes a case beside its place and moves it there whole."""
    place.parent.mkdir(parents=True, exist_ok=True)
    new = Path(tempfile.mkdtemp(prefix=f".{name}", dir=place.parent))
    new.chmod(0o755)
    if laws.known(name):
        laws.make(name).write(name, new)
    else:
        forms.write(families.make(name), name, new)
    os.rename(new, place)
