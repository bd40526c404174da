#!/usr/bin/env python3
"""Shows in seconds that the bench works: two small cases, lptn beside their eigenvalues, and each
family whose laws depend on temperature or time beside its C program.

smoke.py LPTN        prints SKIPPED, and why, where NumPy or a C compiler is missing
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

PLACE = Path(__file__).parent


def main():
    try:
        import numpy  # noqa: F401
    except ImportError:
        return "SKIPPED: no NumPy for this Python (python3-numpy)"
    with tempfile.TemporaryDirectory() as folder:
        os.environ["BENCH_DIR"] = folder
        launch = Path(folder) / "build/launch"
        launch.parent.mkdir()
        compiler = ["gcc", "-Wall", "-Werror", PLACE / "peers/launch.c", "-o", launch]
        try:
            subprocess.run(compiler, check=True)
        except FileNotFoundError:
            return "SKIPPED: no gcc"
        import tools

        lptn = tools.Lptn(sys.argv[1], "lptn", False)
        for name in ("ladder-30", "grid2d-12-random"):
            solve(name, [lptn])
        compare_with_c(launch.parent, tools.Lptn(sys.argv[1], "lptn", True), lptn)
    return "the bench works"


TOLERANCE = "1e-6"
"""K; the error of a run is promised to stay below ten times that."""
LAWS = [
    "conductivity-5",
    "film-30",
    "film_all-10",
    "stream-20",
    "pulsed-20",
    "melting-12",
    "thermostat-4",
    "cycle",
    "drive",
    "steady-conductivity-5",
    "steady-film-30",
]


def compare_with_c(build, *lptn):
    """Each family whose laws depend on temperature or time: lptn against its C program."""
    libraries = ["cvode", "nvecserial", "sunmatrixband", "sunmatrixdense"]
    libraries += ["sunlinsolband", "sunlinsoldense", "sunlinsolspgmr"]
    links = [f"-lsundials_{name}" for name in libraries]
    core = ["-lsundials_core"] if has_library("sundials_core") else []
    subprocess.run([PLACE / "laws", build, "-O2", "--", *links, *core], check=True)
    import numpy as np

    import cases
    import measure

    for name in LAWS:
        case = cases.load(name)
        for tool in lptn:
            if tool.fits(case):
                done = measure.run(tool, case, TOLERANCE, (60, 8))
                assert done.ok(), (name, done)
                error = done.error * np.ptp(case.right)
                assert error < 10 * float(TOLERANCE), (name, error)
                print(f"{name}: error {error:.0e} K; reference: {case.known}")


def has_library(name):
    """Whether the linker finds a library: SUNDIALS 7 has a core, 6 has none."""
    command = ["gcc", "-shared", f"-l{name}", "-o", os.devnull]
    return subprocess.run(command, capture_output=True).returncode == 0


def solve(name, lptn):
    """Two errors are kept, the smaller one with a smaller tolerance."""
    import numpy as np

    import bench
    import cases
    import reference
    import tools

    place = tools.folder() / "cases" / name
    cases.make(name, place)
    case = cases.Case(place)
    case.right, case.known = reference.modal(np.load(place / "net.npz")), "by eigenvalues"
    found = []
    for target in (1e-3, 1e-7):
        options = bench.arguments(["--target", str(target), "--turns", "2", name])
        rows = bench.bench(case, lptn, [], options)
        bench.show(case, rows, lptn, target)
        assert rows[0]["error"] <= target, rows
        assert rows[0]["turns"] == 2 and rows[0]["cpu"] > 0 and rows[0]["memory"] > 0, rows
        found.append(float(rows[0]["tolerance"]))
    assert found[1] < found[0] / 100, found


if __name__ == "__main__":
    print(main())
