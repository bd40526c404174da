"""A network as files: a netlist for lptn, arrays for programs in C and Python, a deck for SPICE."""

import json
import struct

import numpy as np

from network import STEFAN_BOLTZMANN

ABSOLUTE_ZERO = 273.15
PLAIN = 100
"""Networks of fewer nodes are written as a plain netlist, larger ones with [import]."""
SPICE = 10_000
"""Networks of more nodes get no deck."""


def write(net, name, folder):
    """Writes every form of a network into a folder, `case.json` last: with it a case is whole."""
    steady = name.startswith("steady-")
    (folder / "net.bin").write_bytes(binary(net))
    np.savez(folder / "net.npz", **arrays(net))
    netlist(net, name, folder)
    if net.n <= SPICE and not steady:
        (folder / "deck.cir").write_text(deck(net))
    about = dict(
        name=name,
        steady=steady,
        n=net.n,
        paths=len(net.ei) + len(net.rk),
        linear=net.linear(),
        events=len(net.events),
        t_end=net.t_end,
        rows=len(net.rows),
        probes=net.probes.tolist(),
        columns=[f"n{i}.T" for i in net.probes.tolist()],
    )
    (folder / "case.json").write_text(json.dumps(about))


def arrays(net):
    """The arrays of net.bin by name; corners of sources follow each other from `ptr` on."""
    corners = [source.corners(net.t_end) for source in net.sources]
    ptr = np.cumsum([0] + [len(points) for points in corners])
    pt, pp = np.array([point for points in corners for point in points]).T
    src = np.array([source.node for source in net.sources])
    return dict(
        C=net.C,
        T0=net.T0,
        ei=net.ei,
        ej=net.ej,
        G=net.G,
        ri=net.ri,
        rj=net.rj,
        rk=net.rk,
        bT=net.bT,
        src=src,
        ptr=ptr,
        pt=pt,
        pp=pp,
        probe=net.probes,
        tout=net.rows,
        brk=net.events,
        t_end=net.t_end,
    )


def binary(net):
    """Twelve int64 (a mark, nine counts, 0, 0), then float64, then int32; little endian."""
    a = arrays(net)
    counts = [len(a[k]) for k in "C G rk bT src pt probe tout brk".split()]
    floats = [a[k] for k in "t_end C T0 G rk bT pt pp tout brk".split()]
    whole = [a[k] for k in "ei ej ri rj src ptr probe".split()]
    parts = [struct.pack("<12q", 0x4C50544E, *counts, 0, 0)]
    parts += [np.asarray(x, "<f8").tobytes() for x in floats]
    parts += [np.asarray(x, "<i4").tobytes() for x in whole]
    return b"".join(parts)


def node(net, i):
    """The name of a node or boundary."""
    return f"n{i}" if i < net.n else f"b{i - net.n}"


def netlist(net, name, folder):
    """net.toml, with nodes and conductors in CSV files beside it where there are many."""
    plain = net.n < PLAIN
    constant = all(len(source.P) == 1 for source in net.sources)
    files = [] if plain else ["nodes", "conductors"] + ["sources"] * constant
    lines = ["format = 1", f'title = "{name}"']
    lines += section("import", {file: f'"{file}.csv"' for file in files})
    if plain:
        nodes = {f"n{i}": f'{{ C = "{c!r} J/K" }}' for i, c in enumerate(net.C.tolist())}
        lines += section("node", nodes)
        lines += section("resistor", dict(resistors(net)))
    else:
        tables(net, folder)
    boundaries = {f"b{k}": f'{{ T = "{T!r} degC" }}' for k, T in enumerate(net.bT.tolist())}
    lines += section("boundary", boundaries)
    lines += section("default", {"T0": '"25.0 degC"'})
    lines += section("radiation", dict(radiating(net)))
    if "sources" in files:
        rows = [f"n{s.node},{s.P[0]!r}" for s in net.sources]
        (folder / "sources.csv").write_text("\n".join(["into,P [W]", *rows]) + "\n")
    else:
        lines += section("signal", dict(signals(net)))
        lines += section("source", dict(heats(net)))
    probes = ", ".join(f'"{node(net, i)}.T"' for i in net.probes.tolist())
    every = net.t_end / len(net.rows)
    lines += section(
        "run",
        {
            "stop": f'"{net.t_end!r} s"',
            "output": f'{{ every = "{every!r} s" }}',
            "select": f"[{probes}]",
        },
    )
    (folder / "net.toml").write_text("\n".join(lines) + "\n")


def section(name, entries):
    """The lines of a section, or none."""
    return (
        ["", f"[{name}]", *(f"{key} = {value}" for key, value in entries.items())]
        if entries
        else []
    )


def resistors(net):
    for k, (i, j, G) in enumerate(zip(net.ei.tolist(), net.ej.tolist(), net.G.tolist())):
        yield f"r{k}", f'{{ from = "{node(net, i)}", to = "{node(net, j)}", G = "{G!r} W/K" }}'


def radiating(net):
    areas = (net.rk / STEFAN_BOLTZMANN).tolist()
    for k, (i, j, A) in enumerate(zip(net.ri.tolist(), net.rj.tolist(), areas)):
        yield f"g{k}", f'{{ from = "{node(net, i)}", to = "{node(net, j)}", Gr = "{A!r} m^2" }}'


def signals(net):
    for k, s in enumerate(net.sources):
        if len(s.P) > 1:
            how = 'interp = "previous", after_end = "hold"' if s.held else 'interp = "linear"'
            yield f"p{k}", f'{{ t = {s.t}, v = {s.P}, t_unit = "s", v_unit = "W", {how} }}'


def heats(net):
    for k, s in enumerate(net.sources):
        P = f"p{k}" if len(s.P) > 1 else f"{s.P[0]!r} W"
        yield f"s{k}", f'{{ into = "{node(net, s.node)}", P = "{P}" }}'


def tables(net, folder):
    """nodes.csv and conductors.csv, in digits that read back as the same numbers."""
    with open(folder / "nodes.csv", "w") as out:
        out.write("name,C [J/K],T0 [degC]\n")
        out.writelines(
            f"n{i},{c!r},{t!r}\n" for i, (c, t) in enumerate(zip(net.C.tolist(), net.T0.tolist()))
        )
    with open(folder / "conductors.csv", "w") as out:
        out.write("from,to,G [W/K]\n")
        ends = zip(net.ei.tolist(), net.ej.tolist(), net.G.tolist())
        out.writelines(f"{node(net, i)},{node(net, j)},{G!r}\n" for i, j, G in ends)


def deck(net):
    """The network as a circuit: V = degC, I = W, R = K/W, C = J/K; @..@ are filled in for a run."""
    lines = ["thermal network (V = degC, I = W)"]
    lines += [
        f"C{i} n{i} 0 {c!r} IC={t!r}"
        for i, (c, t) in enumerate(zip(net.C.tolist(), net.T0.tolist()))
    ]
    ends = zip(net.ei.tolist(), net.ej.tolist(), (1 / net.G).tolist())
    lines += [f"R{k} {node(net, i)} {node(net, j)} {R!r}" for k, (i, j, R) in enumerate(ends)]
    lines += [f"VB{k} b{k} 0 {T!r}" for k, T in enumerate(net.bT.tolist())]
    lines += [radiating_source(net, k) for k in range(len(net.rk))]
    lines += [f"I{k} 0 n{s.node} PWL({ramped(net, s)})" for k, s in enumerate(net.sources)]
    probes = [f"v(n{i})" for i in net.probes.tolist()]
    lines += [".save " + " ".join(probes[k : k + 10]) for k in range(0, len(probes), 10)]
    lines += [
        ".options reltol=@RELTOL@ abstol=1e-9 vntol=1e-6 method=trap",
        f".tran @STEP@ {net.t_end!r} 0 @LARGEST@ uic",
        ".end",
    ]
    return "\n".join(lines) + "\n"


def radiating_source(net, k):
    a, b = node(net, net.ri[k]), node(net, net.rj[k])
    power = "({}+%s)^4" % ABSOLUTE_ZERO
    return f"B{k} {a} {b} I={net.rk[k]!r}*({power.format(f'v({a})')}-{power.format(f'v({b})')})"


def ramped(net, source):
    """The corners of a source; SPICE knows no jump, so that one takes 1e-7 of the run."""
    words, last = [], -1.0
    for t, P in source.corners(net.t_end):
        t = t if t > last else last + 1e-7 * net.t_end
        words.append(f"{t!r} {P!r}")
        last = t
    return " ".join(words)
