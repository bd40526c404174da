#!/usr/bin/env python3
"""Runs lptn and its peers side by side, each at the loosest tolerance that keeps an error.

    bench.py --lptn target/release/lptn [--lptn OTHER] [--target 1e-4] [--turns 5] CASE..

An error is the largest over all probes and rows, relative to the range of the reference. All tools
of a case run in turn, one turn after another; figures are medians over the turns, ratios medians of
the ratios of each turn. CPU is user plus system time of the whole process. `--lptn FILE:cvode` runs
lptn with `integrator = "cvode"`; two or more `--lptn` are compared with each other. Cases, builds
and references are kept in BENCH_DIR, target/bench unless set; families.py tells the names of cases.
"""

import argparse
import json
import sys
import time

import numpy as np

import cases
import measure
import tools


def arguments(words=None):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--lptn", action="append", default=[], help="a program, or PROGRAM:INTEGRATOR"
    )
    parser.add_argument("--target", type=float, default=1e-4, help="the error to keep")
    parser.add_argument("--turns", type=int, default=5, help="how often each tool runs")
    parser.add_argument(
        "--budget", type=float, default=25, help="s of CPU of a tool over all turns of a case"
    )
    parser.add_argument(
        "--limit", type=float, default=60, help="s of CPU at which a run is stopped"
    )
    parser.add_argument("--memory", type=float, default=8, help="GB at which a run is stopped")
    parser.add_argument(
        "--tools", help="peers whose names have one of these words in them: klu,spgmr"
    )
    parser.add_argument(
        "--ladder", action="store_true", help="only the errors of lptn at every tolerance"
    )
    parser.add_argument(
        "--record",
        action="store_true",
        help="keep the figures for page.py; lptn is then called lptn",
    )
    parser.add_argument("cases", nargs="+")
    return parser.parse_args(words)


def chosen(options):
    """lptn in both its kinds, and the peers that are asked for."""
    words = options.tools.lower().split(",") if options.tools is not None else [""]
    peers = [tool for tool in tools.peers() if any(word in tool.name.lower() for word in words)]
    name = "lptn" if options.record else None
    lptn = [
        tools.Lptn(program, steady, name) for program in options.lptn for steady in (False, True)
    ]
    return lptn, peers


def bench(case, lptn, peers, options):
    """One case: picks tolerances, takes turns, and returns a row of figures for every tool."""
    limits = (options.limit, options.memory)
    picks = {}
    for tool in [tool for tool in lptn + peers if tool.fits(case)]:
        why = tool.missing()
        if why:
            picks[tool] = measure.Pick("", None, 0, why)
        else:
            picks[tool] = measure.pick(tool, case, options.target, limits)
    runs = {tool: [] for tool, pick in picks.items() if pick.error is not None}
    for turn in range(options.turns):
        for tool, done in runs.items():
            if turn < measure.turns_of(picks[tool].cpu, options.turns, options.budget):
                one = measure.run(tool, case, picks[tool].tolerance, limits)
                done += [one] if one.ok() else []
    return [row(tool, picks[tool], runs, [one for one in lptn if one in runs]) for tool in picks]


def row(tool, pick, runs, lptn):
    """The figures of a tool: medians over its turns, and the ratio of each lptn to it."""
    done = runs.get(tool, [])
    figures = dict(
        tool=tool.name, tolerance=pick.tolerance, error=pick.error, said=pick.said, turns=len(done)
    )
    if done:
        figures["cpu"] = measure.median(one.cpu for one in done)
        figures["memory"] = measure.median(one.memory for one in done)
        figures["ratios"] = [ratio(runs[one], done) for one in lptn]
    return figures


def ratio(ours, theirs):
    return measure.median(a.cpu / max(b.cpu, 1e-5) for a, b in zip(ours, theirs))


def show(case, rows, lptn, target):
    """The table of a case."""
    names = [tool.name for tool in lptn if tool.fits(case)]
    heads = [
        "tool",
        "tolerance",
        "error",
        "CPU, s",
        "MB",
        "turns",
        *(f"{name} / it" for name in names),
    ]
    print(
        f"\n{case.name}: {case.n} nodes, {case.paths} paths, error at most {target:.0e}; "
        f"reference: {case.known}"
    )
    print("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|")
    for figures in rows:
        print("| " + " | ".join(cells(figures, target, len(names))) + " |", flush=True)


def cells(figures, target, ratios):
    if figures["error"] is None:
        return [figures["tool"], figures["said"]] + [""] * (4 + ratios)
    met = "" if figures["error"] <= target else " (not met)"
    return [
        figures["tool"],
        figures["tolerance"],
        f"{figures['error']:.1e}{met}",
        f"{figures['cpu']:.4f}",
        f"{figures['memory']:.0f}",
        str(figures["turns"]),
        *(f"{x:.2f}" for x in figures["ratios"]),
    ]


def ladder(case, lptn, options):
    """Errors of lptn in K at every tolerance: they fall if netlist and arrays are one network."""
    print(f"\n{case.name}, range {np.ptp(case.right):.4g} K; reference: {case.known}")
    for tool in [tool for tool in lptn if tool.fits(case)]:
        for tolerance in tool.ladder[1:-2:2]:
            done = measure.run(tool, case, tolerance, (options.limit, options.memory))
            error = (
                f"{done.error * np.ptp(case.right):.1e} K"
                if done.ok()
                else done.said + ": " + done.stderr
            )
            print(f"{tool.name}, {tolerance} K: error {error}, {done.cpu:.3f} s", flush=True)


def record(case, rows, options):
    """Keeps the figures of a case, with all that the page says about them."""
    place = tools.folder() / "results"
    place.mkdir(exist_ok=True)
    stamp = tools.Lptn(options.lptn[0], False).stamp()
    about = dict(
        case=case.name,
        n=case.n,
        paths=case.paths,
        steady=case.steady,
        target=options.target,
        known=case.known,
        range=float(np.ptp(case.right)),
        date=time.strftime("%Y-%m-%d"),
        lptn=stamp,
    )
    (place / f"{case.name}@{options.target:g}.json").write_text(
        json.dumps(about | dict(rows=rows), indent=1)
    )


def main():
    options = arguments()
    lptn, peers = chosen(options)
    for tool in lptn:
        if tool.missing():
            sys.exit(f"{tool.program} is not there")
    for name in options.cases:
        case = cases.load(name)
        if options.ladder:
            ladder(case, lptn, options)
            continue
        rows = bench(case, lptn, peers, options)
        show(case, rows, lptn, options.target)
        if options.record:
            record(case, rows, options)


if __name__ == "__main__":
    main()
