"""A network of the benchmark as arrays, and the heats of its sources over time.

Node i has the capacity C[i] in J/K and starts at T0[i] in degC. Conductor k joins node ei[k] with
ej[k], G[k] in W/K; radiating pair k joins ri[k] with rj[k], rk[k] in W/K^4. An end that is not
below the number of nodes n is the boundary with that number less n, at bT in degC:

    C_i dT_i/dt = P_i(t) + sum_j G_ij (T_j - T_i) + sum_j k_ij (Tabs_j^4 - Tabs_i^4)
"""

from dataclasses import dataclass, field

import numpy as np

STEFAN_BOLTZMANN = 5.670374419e-8
"""W/(m^2 K^4), CODATA 2018."""
EVENTS = 8
"""Times at which sources change, the start among them."""


@dataclass
class Source:
    """Heat into one node: points (s, W), held or joined by straight lines; the first is at 0."""

    node: int
    held: bool
    t: list[float]
    P: list[float]

    def corners(self, t_end):
        """(s, W) of a line through all corners; a time that stands twice is a jump."""
        points = [(self.t[0], self.P[0])]
        for before, t, P in zip(self.P, self.t[1:], self.P[1:]):
            points += [(t, before), (t, P)] if self.held else [(t, P)]
        return points if points[-1][0] >= t_end else points + [(t_end, points[-1][1])]


@dataclass
class Network:
    """What a family makes; `sources`, `events`, `rows` and `probes` follow with `drive`."""

    C: np.ndarray
    ei: np.ndarray
    ej: np.ndarray
    G: np.ndarray
    ri: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    rj: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    rk: np.ndarray = field(default_factory=lambda: np.zeros(0))
    t_end: float = 0.0
    events: np.ndarray = field(default_factory=lambda: np.zeros(1))
    sources: list[Source] = field(default_factory=list)
    rows: np.ndarray = field(default_factory=lambda: np.zeros(0))
    probes: np.ndarray = field(default_factory=lambda: np.zeros(0, int))

    def __post_init__(self):
        self.n = len(self.C)
        self.T0 = np.full(self.n, 25.0)
        self.bT = np.array([25.0])

    def linear(self):
        """Whether no heat depends on the fourth power of a temperature."""
        return len(self.rk) == 0


def six_digits(numbers):
    """Numbers rounded to six digits."""
    return np.array([float(f"{x:.5e}") for x in numbers])


def drive(net, rng, t_end, rows, power, sources=300, probes=50):
    """Sources that step, pulse or follow lines at shared times; half of the probes are on them."""
    net.t_end = float(t_end)
    net.rows = np.linspace(0, t_end, rows + 1)[1:]
    count = min(sources, max(1, net.n // 4))
    nodes = rng.choice(net.n, count, replace=False)
    inner = np.sort(rng.choice(np.arange(1, 16), EVENTS - 1, replace=False)) * (t_end / 16)
    net.events = np.concatenate([[0.0], inner])
    net.sources = [_source(net, rng, k, int(node), power) for k, node in enumerate(nodes)]
    chosen = rng.choice(net.n, min(net.n, probes), replace=False)
    on_sources = min(count, probes // 2)
    chosen[:on_sources] = nodes[:on_sources]
    net.probes = np.unique(chosen)
    return net


def _source(net, rng, k, node, power):
    events, P = net.events.tolist(), round(power * rng.uniform(0.1, 1.0), 4)
    if k % 3 == 0:
        t = events[rng.integers(0, len(events))]
        return Source(node, True, [0.0], [P]) if t == 0 else Source(node, True, [0.0, t], [0.0, P])
    if k % 3 == 1:
        return Source(node, True, events, [P if i % 2 == 0 else 0.0 for i in range(len(events))])
    t = events + [net.t_end]
    return Source(node, False, t, [round(power * rng.uniform(0, 1), 4) for _ in t])


def at_random_times(net, rng):
    """The same network and heats, but its events are not multiples of anything."""
    times = six_digits(np.sort(rng.uniform(0.01, 0.99, len(net.events) - 1)) * net.t_end)
    new = dict(zip(net.events.tolist(), [0.0, *times.tolist()]))
    for source in net.sources:
        source.t = [new.get(t, t) for t in source.t]
    net.events = np.array(sorted(new.values()))
    return net


def constant(net):
    """The same network under the largest heat of each source, all the time."""
    for source in net.sources:
        source.held, source.t, source.P = True, [0.0], [max(source.P)]
    net.events = np.zeros(1)
    return net
