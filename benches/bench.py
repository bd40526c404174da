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
import os
import sys
import time
from pathlib import Path

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
    lptn = [
        tools.Lptn(program, name, steady)
        for program, name in zip(options.lptn, names(options))
        for steady in (False, True)
    ]
    return lptn, peers


def names(options):
    """What each lptn is called: by its file, or by its whole path where files share a name."""
    short = ["lptn" if options.record else Path(program).name for program in options.lptn]
    return short if len(set(short)) == len(short) else options.lptn


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
    runs = {tool: {} for tool, pick in picks.items() if pick.error is not None}
    for turn in range(options.turns):
        for tool, done in runs.items():
            if turn < measure.turns_of(picks[tool].cpu, options.turns, options.budget):
                done[turn] = measure.run(tool, case, picks[tool].tolerance, limits)
    runs = {
        tool: {turn: one for turn, one in done.items() if one.ok()} for tool, done in runs.items()
    }
    ours = [runs.get(tool, {}) for tool in lptn if tool.fits(case)]
    return [row(tool.name, pick, runs.get(tool, {}), ours) for tool, pick in picks.items()]


def row(name, pick, done, ours):
    """The figures of a tool: medians over its turns, and the ratio of each lptn to it."""
    figures = dict(tool=name, tolerance=pick.tolerance, error=pick.error, said=pick.said)
    if not done:
        return figures | dict(error=None, said=pick.said or "failed")
    return figures | dict(
        turns=len(done),
        cpu=measure.median(one.cpu for one in done.values()),
        memory=measure.median(one.memory for one in done.values()),
        ratios=[ratio(one, done) for one in ours],
    )


def ratio(ours, theirs):
    """The median of the ratios of the turns that both made, or nothing."""
    both = ours.keys() & theirs.keys()
    ratios = [ours[turn].cpu / max(theirs[turn].cpu, 1e-5) for turn in both]
    return measure.median(ratios) if ratios else None


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
        *("" if x is None else f"{x:.2f}" for x in figures["ratios"]),
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
    stamp = tools.Lptn(options.lptn[0], "lptn", False).stamp()
    about = dict(
        case=case.name,
        n=case.n,
        paths=case.paths,
        steady=case.steady,
        target=options.target,
        known=case.known,
        range=float(np.ptp(case.right)),
        date=time.strftime("%Y-%m-%d"),
        load=os.getloadavg()[0],
        lptn=stamp,
    )
    (place / f"{case.name}@{options.target:g}.json").write_text(
        json.dumps(about | dict(rows=rows), indent=1)
    )


def main():
    options = arguments()
    if options.record and len(options.lptn) != 1:
        sys.exit("--record keeps the figures of one --lptn")
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
