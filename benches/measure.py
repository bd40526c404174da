"""What a run of a program takes, as a whole process, and the loosest tolerance that will do."""

import json
import os
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import tools


@dataclass
class Run:
    """What one run took: s of CPU, s on the clock, MB at most; `error` is relative to the range."""

    cpu: float
    wall: float
    memory: float
    error: float | None
    said: str = ""
    stderr: str = ""

    def ok(self):
        return self.error is not None


def run(tool, case, tolerance, limits):
    """Runs a tool on a case; `error` is None where it failed or was stopped."""
    seconds, gigabytes = limits[0] * tool.patience, limits[1]
    with tempfile.TemporaryDirectory(prefix="bench") as place:
        work = Path(place)
        report = work / "report"
        command = [str(word) for word in tool.command(case, tolerance, work)]
        launch = [
            tools.folder() / "build/launch",
            round(seconds),
            gigabytes,
            report,
            work / "stdout",
        ]
        environment = os.environ | {
            "OPENBLAS_NUM_THREADS": "1",
            "OMP_NUM_THREADS": "1",
            "LC_ALL": "C",
        }
        told = subprocess.run(
            [*map(str, launch), *command], env=environment, stderr=subprocess.PIPE, text=True
        )
        status, user, system, wall, peak = (float(word) for word in report.read_text().split())
        rows = tool.rows(case, work) if status == 0 else None
        error = None if rows is None else case.error(rows)
        said = f"stopped after {seconds:.0f} s" if user + system > 0.95 * seconds else "failed"
        return Run(user + system, wall, peak / 1024, error, said, told.stderr)


@dataclass
class Pick:
    """The loosest tolerance of a tool that keeps the target, or the last that worked."""

    tolerance: str
    error: float | None
    cpu: float
    said: str = ""


def pick(tool, case, target, limits):
    """Goes down the ladder until the error keeps the target; remembers what it found."""
    memory = case.file("picks.json")
    known = json.loads(memory.read_text()) if memory.exists() else {}
    key = f"{tool.name} {tool.stamp()} {target:g} {limits[0] * tool.patience:g} s"
    if key not in known:
        best = None
        for tolerance in tool.ladder:
            done = run(tool, case, tolerance, limits)
            if best is None or done.ok():
                best = Pick(tolerance, done.error, done.cpu, done.said)
            if done.cpu > 0.7 * limits[0] * tool.patience or (done.ok() and done.error <= target):
                break
        remember(memory, key, vars(best))
        return best
    return Pick(**known[key])


def remember(memory, key, value):
    """Adds an entry to a file that others may write at the same time."""
    known = json.loads(memory.read_text()) if memory.exists() else {}
    known[key] = value
    new = memory.with_suffix(f".{os.getpid()}")
    new.write_text(json.dumps(known, indent=1))
    os.replace(new, memory)


def turns_of(cpu, turns, budget):
    """How often a tool is run: fewer times where one run takes long."""
    return max(1, min(turns, int(budget / max(cpu, 1e-3))))


def median(numbers):
    return float(np.median(list(numbers)))
