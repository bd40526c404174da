#!/usr/bin/env python3
"""Writes the tables of docs/speed.md, between its two marks, and every figure into figures.csv, from
what `bench.py --record` kept.

page.py PROGRAM      the lptn that was measured; results of other builds are left out
"""

import csv
import json
import platform
import subprocess
import sys
from pathlib import Path

import laws
import tools

PAGE = Path(__file__).parent.parent / "docs/speed.md"
FIGURES = Path(__file__).parent / "figures.csv"
BEGIN, END = "<!-- written by make bench: begin -->", "<!-- written by make bench: end -->"
ORDER = ["two_node", "ladder", "stiff", "grid2d", "grid3d", "radiation", "scale2d", "scale3d"]
ORDER += ["diffuse2d", "diffuse3d"]
ORDER += list(laws.FAMILIES)


def main():
    stamp = tools.Lptn(sys.argv[1], "lptn", False).stamp()
    results = [json.loads(file.read_text()) for file in (tools.folder() / "results").glob("*.json")]
    results = sorted((result for result in results if result["lptn"] == stamp), key=place)
    if not results:
        sys.exit(f"nothing was recorded with {sys.argv[1]}")
    text = "\n\n".join(["", conditions(sys.argv[1], results), *chapters(results), ""])
    before, _, rest = PAGE.read_text().partition(BEGIN)
    PAGE.write_text(before + BEGIN + text + END + rest.partition(END)[2])
    every_figure(results)


def place(result):
    """Where a result stands in a table: by family and size."""
    family, _, size = result["case"].removeprefix("steady-").removesuffix("-random").partition("-")
    return ORDER.index(family), int(size or 0), result["target"]


def chapters(results):
    """A heading and a table for every kind of measurement that was made."""
    special = [result for result in results if laws.known(result["case"])]
    results = [result for result in results if result not in special]
    runs = [result for result in results if not result["steady"] and "scale" not in result["case"]]
    # smaller errors and events at random times are in figures.csv only
    for target in sorted({result["target"] for result in runs}, reverse=True)[:1]:
        at = [result for result in runs if result["target"] == target]
        regular = [result for result in at if not result["case"].endswith("-random")]
        yield from table(f"At an error of {power(target)}", regular)
    yield from table(
        "Ten minutes of a million nodes",
        [result for result in results if "scale" in result["case"]],
    )
    yield from table("Steady states", [result for result in results if result["steady"]])
    for target in sorted({result["target"] for result in special}, reverse=True):
        at = [result for result in special if result["target"] == target]
        yield from table(f"Laws over temperature or time, at an error of {power(target)}", at)


def table(heading, results):
    if not results:
        return
    yield f"### {heading}"
    names = list(dict.fromkeys(row["tool"] for result in results for row in result["rows"]))
    rows = []
    for result in results:
        by_name = {row["tool"]: row for row in result["rows"]}
        cells = [cell(by_name.get(name), result["target"]) for name in names]
        rows.append([f"`{result['case']}`", *cells, best(result)])
    yield markdown(["CPU, s", *names, "lptn / the best other"], rows)


def cell(row, target):
    """CPU of a tool; in brackets the error of one that did not keep the target."""
    if row is None or row["error"] is None:
        return ""
    return digits(row["cpu"]) + ("" if row["error"] <= target else f" ({row['error']:.0e})")


def best(result):
    """The ratio of lptn to the other program that does best, of those that keep the target."""
    others = [row for row in result["rows"] if row["tool"] != "lptn" and row["error"] is not None]
    ratios = [row["ratios"][0] for row in others if row["error"] <= result["target"]]
    ratios = [ratio for ratio in ratios if ratio is not None]
    return f"{max(ratios):.2f}" if ratios else ""


def power(target):
    """1e-4, not 0.0001."""
    return f"{target:.0e}".replace("e-0", "e-")


def digits(seconds):
    """Seconds with three digits."""
    return f"{seconds:.{4 if seconds < 0.1 else 3 if seconds < 1 else 2 if seconds < 10 else 1}f}"


def every_figure(results):
    heads = [
        "Case",
        "Error at most",
        "Program",
        "Tolerance",
        "Error",
        "CPU, s",
        "MB",
        "Turns",
        "lptn / it",
    ]
    rows = [figures(result, row) for result in results for row in result["rows"]]
    with FIGURES.open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([heads, *rows])


def figures(result, row):
    head = [result["case"], power(result["target"]), row["tool"]]
    if row["error"] is None:
        return [*head, row["said"], "", "", "", "", ""]
    ratio = "" if row["ratios"][0] is None else f"{row['ratios'][0]:.2f}"
    return [
        *head,
        row["tolerance"],
        f"{row['error']:.1e}",
        digits(row["cpu"]),
        f"{row['memory']:.0f}",
        str(row["turns"]),
        ratio,
    ]


def markdown(heads, rows):
    lines = ["| " + " | ".join(cells) + " |" for cells in (heads, *rows)]
    return "\n".join([lines[0], "|---" * len(heads) + "|", *lines[1:]])


def conditions(program, results):
    """Date, machine and versions, a row each."""
    dates = sorted({result["date"] for result in results})
    doubt, case = max((float(result["known"].split()[-1]), result["case"]) for result in results)
    loads = [result["load"] for result in results if "load" in result]
    load = f"{min(loads):.1f} to {max(loads):.1f}" if loads else "not recorded"
    rows = [
        ["Date", ", ".join(dates)],
        ["Load of the machine, the bench included", load],
        ["Machine", f"{processor()}, {platform.machine()}, {system()}"],
        ["lptn", f"{said([program, '--version'])}; {origin(program)}"],
        ["SUNDIALS of the C programs", sundials()],
        ["Debian's packages", packages()],
        ["Python's packages", modules()],
        [
            "Compilers",
            f"{said(['gcc', '--version']).splitlines()[0]}; {said(['rustc', '--version'])}",
        ],
        [
            "References",
            f"computed in two ways, which differ by {doubt:.0e} of the range at most (`{case}`)",
        ],
    ]
    return markdown(["", ""], [[name, text.replace("\n", "; ")] for name, text in rows])


def origin(program):
    """The commit of a program that was built here, else its SHA-256."""
    root, file = PAGE.parent.parent, Path(program).resolve()
    if file.is_relative_to(root):
        return "commit " + said(["git", "describe", "--always", "--dirty"])
    return "built elsewhere, SHA-256 " + tools.Lptn(program, "lptn", False).stamp() + ".."


def said(command):
    """What a command prints, or that it is not there."""
    try:
        return subprocess.run(
            command, capture_output=True, text=True, cwd=PAGE.parent
        ).stdout.strip()
    except OSError:
        return "not installed"


def processor():
    lines = Path("/proc/cpuinfo").read_text().splitlines()
    names = [line.split(":")[1].strip() for line in lines if line.startswith("model name")]
    return f"{len(names)} x {names[0]}" if names else "unknown processor"


def system():
    lines = dict(
        line.split("=", 1)
        for line in Path("/etc/os-release").read_text().splitlines()
        if "=" in line
    )
    return lines.get("PRETTY_NAME", "unknown system").strip('"')


def sundials():
    header = tools.folder() / "build/sundials/include/sundials/sundials_config.h"
    if not header.exists():
        return "not built"
    version = [
        line.split('"')[1]
        for line in header.read_text().splitlines()
        if "define SUNDIALS_VERSION " in line
    ]
    return f"{version[0]}, built with -O3 -march=native"


def packages():
    names = ["libsuitesparse-dev", "libopenblas0", "ngspice", "python3-numpy", "python3-scipy"]
    return said(["dpkg-query", "-W", "-f", "${Package} ${Version}\n", *names]) or "not a Debian"


def modules():
    python = tools.folder() / "venv/bin/python"
    return (
        said([str(python), "-m", "pip", "freeze"]) if python.exists() else "no virtual environment"
    )


if __name__ == "__main__":
    main()
