"""SciPy's and scikit-sundae's integrators on net.npz, as one would write it in Python.

ode.py bdf|sundae NET.NPZ ROWS.BIN TOLERANCE
"""

import sys
from pathlib import Path

import numpy as np
import scipy.sparse as sparse

sys.path.insert(0, str(Path(__file__).parent.parent))
import arrays

ABSOLUTE_ZERO = 273.15


class Body:
    """Rates and slopes of a network from one event to the next."""

    def __init__(self, net):
        self.net, self.n = net, len(net["C"])
        values, rows, columns, self.bound_load = arrays.conductances(net)
        self.K = sparse.csr_matrix((values, (rows, columns)), (self.n, self.n))
        self.per_C = 1 / net["C"]
        self.constant = (sparse.diags(self.per_C) @ -self.K).tocsc()
        self.inside = net["rj"] < self.n

    def between(self, begin, end):
        self.begin = begin
        self.heat, self.slope = arrays.lines(self.net, self.bound_load, begin, end)

    def kelvin(self, T):
        """Absolute temperatures of both ends of all that radiates."""
        all_T = np.concatenate([T, self.net["bT"]]) + ABSOLUTE_ZERO
        return all_T[self.net["ri"]], all_T[self.net["rj"]]

    def rate(self, t, T):
        heat = self.heat + (t - self.begin) * self.slope - self.K @ T
        if len(self.net["rk"]):
            a, b = self.kelvin(T)
            flow = self.net["rk"] * (a**4 - b**4)
            heat -= np.bincount(self.net["ri"], flow, self.n)
            heat += np.bincount(self.net["rj"][self.inside], flow[self.inside], self.n)
        return heat * self.per_C

    def jacobian(self, t, T):
        if not len(self.net["rk"]):
            return self.constant
        a, b = self.kelvin(T)
        i, j, k, inside = self.net["ri"], self.net["rj"], self.net["rk"], self.inside
        da, db = 4 * k * a**3, 4 * k * b**3
        values = np.concatenate([-da, da[inside], -db[inside], db[inside]])
        rows = np.concatenate([i, j[inside], j[inside], i[inside]])
        columns = np.concatenate([i, i[inside], j[inside], j[inside]])
        radiating = sparse.csc_matrix((values, (rows, columns)), (self.n, self.n))
        return self.constant + sparse.diags(self.per_C) @ radiating


def by_scipy(body, tolerance):
    from scipy.integrate import solve_ivp

    slope = body.jacobian if len(body.net["rk"]) else body.constant

    def solve(begin, end, T, at):
        options = dict(method="BDF", rtol=tolerance, atol=tolerance, t_eval=at, jac=slope)
        return solve_ivp(body.rate, (begin, end), T, **options).y.T

    return solve


def by_sundae(body, tolerance):
    from sksundae.cvode import CVODE

    pattern = (body.jacobian(0.0, body.net["T0"]) != 0).astype(int)
    solver = CVODE(
        lambda t, T, rate: rate.__setitem__(slice(None), body.rate(t, T)),
        rtol=tolerance,
        atol=tolerance,
        linsolver="sparse",
        sparsity=pattern,
        max_num_steps=1_000_000,
    )

    def solve(begin, end, T, at):
        return solver.solve(np.concatenate([[begin], at]), T).y[1:]

    return solve


def main():
    method, file, to, tolerance = sys.argv[1:]
    net = dict(np.load(file))
    body = Body(net)
    events = [*net["brk"], float(net["t_end"])]
    rows, T = np.zeros((len(net["tout"]), len(net["probe"]))), net["T0"].copy()
    solve = None
    for begin, end in zip(events, events[1:]):
        body.between(begin, end)
        solve = solve or dict(bdf=by_scipy, sundae=by_sundae)[method](body, float(tolerance))
        within = np.flatnonzero(
            (net["tout"] > begin * (1 + 1e-14)) & (net["tout"] <= end * (1 + 1e-14))
        )
        at = np.minimum(net["tout"][within], end)
        passed = solve(begin, end, T, at if len(at) and at[-1] == end else np.append(at, end))
        rows[within] = passed[: len(within), net["probe"]]
        T = passed[-1].copy()
    rows.tofile(to)


main()
