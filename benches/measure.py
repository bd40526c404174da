"""One run of a program: CPU, memory and error of the whole process; and how runs are put together."""
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

    def ok(self):
        return self.error is not None


def run(tool, case, tolerance, limits):
    """Runs a tool on a case; `error` is None where it failed, was stopped or wrote something else."""
    seconds, gigabytes = limits
    with tempfile.TemporaryDirectory(prefix="bench") as place:
        work = Path(place)
        report = work / "report"
        command = [str(word) for word in tool.command(case, tolerance, work)]
        launch = [tools.folder() / "build/launch", seconds, gigabytes, report, work / "stdout"]
        environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "LC_ALL": "C"}
        told = subprocess.run([*map(str, launch), *command], env=environment, stderr=subprocess.PIPE, text=True)
        status, user, system, wall, peak = (float(word) for word in report.read_text().split())
        error = None
        if status == 0:
            rows = tool.rows(case, work)
            error = None if rows is None else case.error(rows)
        return Run(user + system, wall, peak / 1024, error, told.stderr.strip())


@dataclass
class Pick:
    """The loosest tolerance of a tool that keeps the target on a case, or the best that it reached."""

    tolerance: str
    error: float | None
    cpu: float
    said: str = ""


def pick(tool, case, target, limits):
    """Goes down the ladder until the error keeps the target; remembers what it found."""
    memory = case.file("picks.json")
    known = json.loads(memory.read_text()) if memory.exists() else {}
    key = f"{tool.name} {tool.stamp()} {target:g}"
    if key not in known:
        best = None
        for tolerance in tool.ladder:
            done = run(tool, case, tolerance, limits)
            if best is None or done.ok():
                best = Pick(tolerance, done.error, done.cpu, done.said[-300:])
            if done.cpu > 0.7 * limits[0] or (done.ok() and done.error <= target):
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
