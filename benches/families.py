"""The families of networks, each from its own seed: the same arrays on every machine.

two_node  ladder-N  stiff-N  grid2d-N  grid3d-N  radiation-N      runs
NAME-random          the same with events at random times instead of multiples of t_end/16
steady-grid2d-N      the steady state under constant heat
scale2d-N  scale3d-N      10 minutes and 10 rows of a large grid under constant heat
diffuse2d-N  diffuse3d-N  the same of aluminium, heated in the middle: heat spreads over many cells
"""

import numpy as np

from network import STEFAN_BOLTZMANN, Network, Source, at_random_times, constant, drive, six_digits

SEED = 20240517


def make(name):
    """The network that a name of the table above tells."""
    steady = name.startswith("steady-")
    random = name.endswith("-random")
    family, _, size = name.removeprefix("steady-").removesuffix("-random").partition("-")
    size = int(size or 2)
    net = FAMILIES[family](np.random.default_rng([SEED, size]), size)
    if random:
        net = at_random_times(net, np.random.default_rng([SEED, size, 1]))
    return constant(net) if steady else net


def spread(rng, low, high, count):
    """Numbers whose logarithms are uniform, of six digits: the same with every NumPy."""
    return six_digits(10.0 ** rng.uniform(np.log10(low), np.log10(high), count))


def two_node(rng, size):
    """The gearbox: a core heated by 223 W in a housing, 25 minutes, a row every 0.2 s."""
    net = Network(
        np.array([1100.0, 1559.0]),
        np.array([0, 1]),
        np.array([1, 2]),
        np.array([1 / 0.02, 1 / 0.3]),
    )
    net.t_end = 1500.0
    net.sources = [Source(0, True, [0.0], [223.0])]
    net.rows = np.linspace(0, net.t_end, 7501)[1:]
    net.probes = np.arange(2)
    return net


def ladder(rng, n):
    """A rod of n nodes with weak convection at every tenth."""
    C = spread(rng, 1, 100, n)
    i = np.arange(n - 1)
    along = spread(rng, 0.1, 10, n - 1)
    side = np.arange(0, n, 10)
    ei = np.concatenate([i, [0, n - 1], side])
    ej = np.concatenate([i + 1, [n, n], np.full(len(side), n)])
    G = np.concatenate([along, [1.0, 1.0], spread(rng, 1e-3, 1e-2, len(side))])
    return drive(Network(C, ei, ej, G), rng, 20000.0, 200, 20.0)


def stiff(rng, n):
    """A random tree with n/2 chords: capacities over nine decades, conductances over four."""
    C = spread(rng, 1e-4, 1e5, n)
    parent = np.array([rng.integers(max(0, i - 20), i) for i in range(1, n)])
    a = rng.integers(0, n, n // 2)
    b = np.clip(a + rng.integers(1, 30, n // 2), 0, n - 1)
    apart = a != b
    cooled = rng.choice(n, max(1, n // 20), replace=False)
    ei = np.concatenate([np.arange(1, n), a[apart], cooled])
    ej = np.concatenate([parent, b[apart], np.full(len(cooled), n)])
    chords = int(apart.sum())
    G = np.concatenate(
        [
            spread(rng, 1e-2, 1e2, n - 1),
            spread(rng, 1e-2, 1e2, chords),
            spread(rng, 0.1, 10, len(cooled)),
        ]
    )
    return drive(Network(C, ei, ej, G), rng, 20000.0, 200, 50.0)


def body(rng, shape):
    """A rectangular grid that is cooled at all of its faces."""
    n = int(np.prod(shape))
    at = np.arange(n).reshape(shape)
    axes = range(len(shape))
    C = spread(rng, 1, 100, n)
    ei = np.concatenate([at.take(range(shape[x] - 1), x).ravel() for x in axes])
    ej = np.concatenate([at.take(range(1, shape[x]), x).ravel() for x in axes])
    inside = spread(rng, 0.1, 10, len(ei))
    faces = np.concatenate([at.take(end, x).ravel() for x in axes for end in (0, shape[x] - 1)])
    return Network(
        C,
        np.concatenate([ei, faces]),
        np.concatenate([ej, np.full(len(faces), n)]),
        np.concatenate([inside, spread(rng, 0.01, 0.1, len(faces))]),
    )


def grid2d(rng, n):
    """A plate of n x n cells."""
    return drive(body(rng, (n, n)), rng, 2.0 * n * n, 200, 20.0)


def grid3d(rng, n):
    """A block of n x n x n cells."""
    return drive(body(rng, (n, n, n)), rng, 5.0 * n * n, 200, 20.0)


def scale2d(rng, n):
    """A plate for 10 minutes, 10 rows and the start."""
    return constant(drive(body(rng, (n, n)), rng, 600.0, 10, 20.0, 1000))


def scale3d(rng, n):
    """A block for 10 minutes, 10 rows and the start."""
    return constant(drive(body(rng, (n, n, n)), rng, 600.0, 10, 20.0, 1000))


def aluminium(rng, shape):
    """Cells of 1 mm with films of 50 W/(m^2 K) at all faces, 100 W in the middle, 10 minutes."""
    net = body(rng, shape)
    inside = net.ej < net.n
    net.C = np.full(net.n, 2700 * 900 * 1e-9)
    film = 1 / (1 / 50e-6 + 0.5e-3 / (237 * 1e-6))  # through half a cell
    net.G = six_digits(np.where(inside, 237 * 1e-3, film))
    net.t_end, net.rows, net.events = 600.0, np.linspace(0, 600.0, 11)[1:], np.zeros(1)
    middle = int(np.ravel_multi_index([cells // 2 for cells in shape], shape))
    net.sources = [Source(middle, True, [0.0], [100.0])]
    net.probes = np.unique(np.append(np.linspace(0, net.n - 1, 49, dtype=int), middle))
    return net


def diffuse2d(rng, n):
    """A plate of n x n cells of aluminium."""
    return aluminium(rng, (n, n))


def diffuse3d(rng, n):
    """A block of n x n x n cells of aluminium."""
    return aluminium(rng, (n, n, n))


def radiation(rng, n):
    """A plate whose cells all radiate to the sky and every tenth to a far one, up to 800 K."""
    net = drive(body(rng, (n, n)), rng, 2.0 * n * n, 200, 60.0)
    far = rng.choice(net.n, max(1, net.n // 10), replace=False)
    net.ri = np.concatenate([np.arange(net.n), far])
    net.rj = np.concatenate([np.full(net.n, net.n), (far + net.n // 2) % net.n])
    areas = [spread(rng, 0.001, 0.01, net.n), spread(rng, 0.001, 0.005, len(far))]
    net.rk = STEFAN_BOLTZMANN * np.concatenate(areas)
    return net


FAMILIES = {
    family.__name__: family
    for family in (
        two_node, ladder, stiff, grid2d, grid3d, radiation, scale2d, scale3d, diffuse2d, diffuse3d
    )
}
