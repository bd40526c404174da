#!/usr/bin/env python3
"""Shows in seconds that the bench works: two small cases, lptn beside their eigenvalues.

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

        for name in ("ladder-30", "grid2d-12-random"):
            solve(name, [tools.Lptn(sys.argv[1], "lptn", False)])
    return "the bench works"


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
