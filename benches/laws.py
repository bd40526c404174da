"""Families whose laws depend on temperature or time: a netlist, and the numbers of its C program.

conductivity-N  a block of N^3 cells with k(T), convection and radiation; 400 W    run, steady
film-N          a rod of N nodes, natural convection h ~ dT^(1/4), two columns     run, steady
film_all-N      the same with every node in the table                                      run
stream-N        a duct of N cells with heated walls                                        run
pulsed-N        the same with a flow that varies by 30 %                                   run
melting-N       a rod of N nodes that melts from one end                                   run
thermostat-N    N rooms, each with a heater and a thermostat                               run
cycle           gears, oil and housing over 1801 points, churning falls with temperature   run
drive           gears, oil and housing over 900 points that repeat for 2 h                 run
"""

import numpy as np

from law import Law, entries, spread
from network import STEFAN_BOLTZMANN, six_digits

SEED = 20261126


def known(name):
    """Whether a case is of one of these families."""
    return family_and_size(name)[0] in FAMILIES


def family_and_size(name):
    family, _, size = name.removeprefix("steady-").partition("-")
    return family, size


def make(name):
    """The network of a case of one of these families."""
    family, size = family_and_size(name)
    size = int(size or 3)
    law = FAMILIES[family](np.random.default_rng([SEED, size]), size)
    if name.startswith("steady-"):
        law.rows = 1
    return law


def conductivity(rng, N):
    """The block of ../grids.md: steel of 0.1 m, k = 20 (1 + 0.001 (T - 20 degC))."""
    size, k0, b, density, cp, power, h, emissivity, air = (
        0.1,
        20,
        0.001,
        7800,
        475,
        400,
        150,
        0.8,
        20,
    )
    last, half = N - 1, N // 2
    cells = [(0, 0, 0), (last, last, last), (half, half, 0), (half, half, half), (half, half, last)]
    text = f"""
[grid.block]
size = ["{size} m", "{size} m", "{size} m"]
cells = [{N}, {N}, {N}]
k = "{k0} [W/(m K)] * (1 + {b} [1/K] * (T - 20 [degC]))"
density = "{density} kg/m^3"
cp = "{cp} J/(kg K)"
T0 = "{air} degC"

[boundary]
air = {{ T = "{air} degC" }}

[convection]
film = {{ from = "block.z1", to = "air", h = "{h} W/(m^2 K)" }}

[radiation]
glow = {{ from = "block.z1", to = "air", emissivity = {emissivity} }}

[source]
heater = {{ into = "block.z0", P = "{power} W" }}
"""
    side = size / N
    return Law(
        program="conductivity",
        text=text,
        n=N**3,
        paths=3 * N * N * (N - 1) + 3 * N * N,
        probes=[(z * N + y) * N + x for x, y, z in cells],
        columns=[f"block[{x + 1},{y + 1},{z + 1}].T" for x, y, z in cells],
        t_end=3600.0,
        rows=200,
        numbers=[
            side,
            k0,
            b,
            20,
            density * cp * side**3,
            power,
            h,
            emissivity * STEFAN_BOLTZMANN,
            air,
        ],
        start=np.full(N**3, float(air)),
    )


def film(rng, n, every=False):
    """Natural convection along a rod: h = 1.42 (dT / K)^(1/4) W/(m^2 K) of 0.01 m^2 a node."""
    C, G, air = spread(rng, 10, 100, n), spread(rng, 0.6, 2, n - 1), 20.0
    P = np.where(np.arange(n) % 10 == 0, 5.0, 0.0)
    nodes = [f'n{i} = {{ C = "{c!r} J/K" }}' for i, c in enumerate(C.tolist())]
    along = [
        f'r{i} = {{ from = "n{i}", to = "n{i + 1}", G = "{g!r} W/K" }}'
        for i, g in enumerate(G.tolist())
    ]
    h = "1.42 [W/(m^2 K)] * (abs(dT) / 1 [K])^(1/4)"
    films = [
        f'c{i} = {{ from = "n{i}", to = "air", h = "{h}", area = "0.01 m^2" }}' for i in range(n)
    ]
    heats = [f'p{i} = {{ into = "n{i}", P = "5 W" }}' for i in range(0, n, 10)]
    text = (
        entries("default", ['T0 = "20 degC"'])
        + entries("boundary", ['air = { T = "20 degC" }'])
        + entries("node", nodes)
        + entries("resistor", along)
        + entries("convection", films)
        + entries("source", heats)
    )
    probes = list(range(n)) if every else [0, n // 2]
    return Law(
        program="film",
        text=text,
        n=n,
        paths=2 * n - 1,
        probes=probes,
        columns=[f"n{i}.T" for i in probes],
        t_end=3600.0,
        rows=200,
        numbers=[0.0142, air],
        start=np.full(n, air),
        arrays=[C, G, P],
    )


def film_all(rng, n):
    """The same with all nodes in the table."""
    return film(rng, n, every=True)


def stream(rng, n, share=0.0):
    """A duct of n cells and their walls; fluid and wall of a cell follow each other."""
    mcp, period, inlet = 400.0, 600.0, 20.0
    C = np.ravel(np.column_stack([spread(rng, 30, 50, n), spread(rng, 100, 300, n)]))
    G, P = spread(rng, 3, 8, n), spread(rng, 5, 20, n)
    rate = (
        f"{mcp} W/K"
        if share == 0
        else f"{mcp} [W/K] * (1 + {share} * sin(2 * pi * t / {period} [s]))"
    )
    names = [f"{kind}{k}" for k in range(n) for kind in "fw"]
    nodes = [f'{name} = {{ C = "{c!r} J/K" }}' for name, c in zip(names, C.tolist())]
    before = ["inlet", *(f"f{k}" for k in range(n))]
    after = [*(f"f{k}" for k in range(n)), "outlet"]
    flows = [
        f'a{k} = {{ from = "{i}", to = "{j}", mcp = "mcp" }}'
        for k, (i, j) in enumerate(zip(before, after))
    ]
    walls = [
        f'h{k} = {{ from = "w{k}", to = "f{k}", G = "{g!r} W/K" }}'
        for k, g in enumerate(G.tolist())
    ]
    heats = [f'p{k} = {{ into = "w{k}", P = "{p!r} W" }}' for k, p in enumerate(P.tolist())]
    text = (
        entries("param", [f'mcp = "{rate}"'] if share == 0 else [])
        + entries("default", ['T0 = "20 degC"'])
        + entries("boundary", ['inlet = { T = "20 degC" }', 'outlet = { T = "20 degC" }'])
        + entries("node", nodes)
        + entries(
            "advection", [line.replace('"mcp"', f'"{rate}"') for line in flows] if share else flows
        )
        + entries("resistor", walls)
        + entries("source", heats)
    )
    probes = sorted({2 * k + kind for k in (0, n // 4, n // 2, n - 1) for kind in (0, 1)})
    return Law(
        program="stream",
        text=text,
        n=2 * n,
        paths=2 * n + 1,
        probes=probes,
        columns=[f"{names[i]}.T" for i in probes],
        t_end=3600.0,
        rows=200,
        numbers=[mcp, share, period, inlet],
        start=np.full(2 * n, inlet),
        arrays=[C, G, P],
    )


def pulsed(rng, n):
    """The same with a flow that varies by 30 % over 10 minutes."""
    return stream(rng, n, 0.3)


def melting(rng, n):
    """A rod of a substance that melts between 50 and 52 degC, 200 kJ/kg, heated at one end."""
    mass, cp, latent, solidus, liquidus, G, power = 0.02, 2000.0, 200e3, 50.0, 52.0, 2.0, 60.0
    text = (
        entries(
            "material.wax",
            [
                f'cp = "{cp} J/(kg K)"',
                'density = "900 kg/m^3"',
                'k = "0.2 W/(m K)"',
                f'solidus = "{solidus} degC"',
                f'liquidus = "{liquidus} degC"',
                f'latent_heat = "{latent} J/kg"',
                'source = "made up"',
            ],
        )
        + entries("default", ['T0 = "20 degC"'])
        + entries("node", [f'n{i} = {{ material = "wax", mass = "{mass} kg" }}' for i in range(n)])
        + entries(
            "resistor",
            [f'r{i} = {{ from = "n{i}", to = "n{i + 1}", G = "{G} W/K" }}' for i in range(n - 1)],
        )
        + entries("source", [f'heater = {{ into = "n0", P = "{power} W" }}'])
    )
    probes = sorted({k * (n - 1) // 9 for k in range(10)})
    P = np.zeros(n)
    P[0] = power
    return Law(
        program="melting",
        text=text,
        n=n,
        paths=n - 1,
        probes=probes,
        columns=[f"n{i}.T" for i in probes],
        t_end=7200.0,
        rows=200,
        numbers=[mass * cp, G, solidus, liquidus, latent / cp],
        start=np.full(n, 20.0),
        arrays=[P],
    )


def thermostat(rng, n):
    """A row of n rooms for 4 h; outside 5 degC, which swings by 5 K over a day."""
    C, out, P = spread(rng, 2e5, 8e5, n), spread(rng, 20, 60, n), spread(rng, 1500, 2500, n)
    below, above, start = np.full(n, 19.0), np.full(n, 21.0), spread(rng, 19.2, 20.8, n)
    along, mean, swing, period = 5.0, 5.0, 5.0, 86400.0
    outside = f"{mean} [degC] + {swing} [K] * sin(2 * pi * t / {period} [s])"
    text = (
        entries("boundary", [f'outside = {{ T = "{outside}" }}'])
        + entries(
            "node",
            [
                f'n{i} = {{ C = "{c!r} J/K", T0 = "{T!r} degC" }}'
                for i, (c, T) in enumerate(zip(C.tolist(), start.tolist()))
            ],
        )
        + entries(
            "resistor",
            [
                f'r{i} = {{ from = "n{i}", to = "n{i + 1}", G = "{along} W/K" }}'
                for i in range(n - 1)
            ]
            + [
                f'o{i} = {{ from = "n{i}", to = "outside", G = "{g!r} W/K" }}'
                for i, g in enumerate(out.tolist())
            ],
        )
        + entries(
            "control",
            [
                f'heat{i} = {{ sense = "n{i}", on_below = "{b!r} degC", '
                f'off_above = "{a!r} degC", start = "on" }}'
                for i, (b, a) in enumerate(zip(below.tolist(), above.tolist()))
            ],
        )
        + entries(
            "source",
            [
                f'p{i} = {{ into = "n{i}", P = "{p!r} [W] * heat{i}" }}'
                for i, p in enumerate(P.tolist())
            ],
        )
    )
    probes = sorted({k * (n - 1) // 9 for k in range(10)})
    return Law(
        program="thermostat",
        text=text,
        n=n,
        paths=2 * n - 1,
        probes=probes,
        columns=[f"n{i}.T" for i in probes],
        t_end=14400.0,
        rows=240,
        numbers=[along, mean, swing, period],
        start=start,
        arrays=[C, out, P, below, above, np.ones(n)],
    )


def gearbox(rng, points, step, t_end, rows, fall):
    """Gears, oil and housing; churning falls by `fall` a kelvin from 40 degC on."""
    t = step * np.arange(points)
    speed, torque, v = drive_cycle(rng, points)
    C, numbers = [2850.0, 2400.0, 6272.0], [
        0.011,
        45e-6,
        fall,
        40.0,
        0.025,
        0.018,
        6.0,
        3.5,
        0.18,
        35.0,
    ]
    mu, churn, _, _, R0, R1, h0, h1, area, air = numbers
    fading = "" if fall == 0 else f" * exp(-{fall} [1/K] * (oil.T - 40 [degC]))"
    reading = ", ".join(['csv = "cycle.csv"', 'time = "time"', 'after_end = "repeat"'])
    h = f"{h0} [W/(m^2 K)] + {h1} [W/(m^2 K)] * (v / 1 [m/s])^0.8"
    text = f"""
[signal]
speed = {{ {reading}, value = "speed" }}
torque = {{ {reading}, value = "torque" }}
v = {{ {reading}, value = "v" }}

[default]
T0 = "{air} degC"

[node]
gears = {{ C = "{C[0]} J/K" }}
oil = {{ C = "{C[1]} J/K" }}
housing = {{ C = "{C[2]} J/K" }}

[boundary]
air = {{ T = "{air} degC" }}

[resistor]
g_o = {{ from = "gears", to = "oil", R = "{R0} K/W" }}
o_h = {{ from = "oil", to = "housing", R = "{R1} K/W" }}

[convection]
skin = {{ from = "housing", to = "air", h = "{h}", area = "{area} m^2" }}

[source]
mesh = {{ into = "gears", P = "{mu} * speed * torque" }}
churn = {{ into = "oil", P = "{churn} [W/rpm^(5/3)] * speed^(5/3){fading}" }}
"""
    lines = [
        f"{a!r},{b!r},{c!r},{d!r}"
        for a, b, c, d in zip(*(x.tolist() for x in (t, speed, torque, v)))
    ]
    return Law(
        program="cycle",
        text=text,
        n=3,
        paths=3,
        probes=[0, 1, 2],
        columns=["gears.T", "oil.T", "housing.T"],
        t_end=t_end,
        rows=rows,
        numbers=numbers,
        start=np.full(3, air),
        arrays=[np.array(C), t, speed, torque, v],
        files={
            "cycle.csv": "\n".join(["time [s],speed [rpm],torque [N m],v [m/s]", *lines]) + "\n"
        },
    )


def drive_cycle(rng, points):
    """Stops and stretches of road: speed in rpm, torque in N m, v in m/s. It closes at its end."""
    at = np.arange(points) / (points - 1)
    road = np.abs(np.sin(9 * np.pi * at)) * (1 + at) + 0.15 * rng.uniform(-1, 1, points)
    speed = six_digits(np.clip(1600 * road, 0, None))
    torque = six_digits(
        np.clip(25 + 15 * np.cos(23 * np.pi * at) + 8 * rng.uniform(-1, 1, points), 0, None)
    )
    speed[0] = speed[-1] = 0.0
    torque[-1] = torque[0]
    return speed, torque, six_digits(speed * 0.0036)


def cycle(rng, size):
    """1801 points, one a second, churning falls by 2 % a kelvin."""
    return gearbox(rng, 1801, 1.0, 1800.0, 360, 0.02)


def drive(rng, size):
    """900 points, one every 2 s, repeated for 2 h; linear in temperature."""
    return gearbox(rng, 900, 2.0, 7200.0, 300, 0.0)


FAMILIES = {
    f.__name__: f
    for f in (conductivity, film, film_all, stream, pulsed, melting, thermostat, cycle, drive)
}
