"""The temperatures that a case is compared with, and how well they are known."""
import subprocess

import numpy as np

import tools

MODAL = 1_100
"""The largest linear network that is solved by the eigenvalues of its whole matrix."""
KRYLOV = 8_000
"""Bodies from so many nodes on are integrated with a Krylov method."""


def load(case):
    """The rows of a reference and a sentence on it; computed once for each case."""
    rows, words = case.file("reference.bin"), case.file("reference.txt")
    if not words.exists():
        right, said = compute(case)
        right.tofile(rows)
        words.write_text(said)
    return np.fromfile(rows).reshape(case.shape), words.read_text()


def compute(case):
    """The best of two that are computed in different ways, or at different tolerances."""
    if case.steady:
        tight, other = steady(case, "1e-13"), steady(case, "1e-11")
        return tight, f"conjugate gradients to 1e-13; to 1e-11 differs by {difference(tight, other):.0e}"
    if case.linear and case.n <= MODAL:
        tight, other = modal(np.load(case.file("net.npz"))), cvode(case, "1e-10")
        return tight, f"exact, by eigenvalues; CVODE at 1e-10 differs by {difference(tight, other):.0e}"
    fine, coarse = ("1e-7", "1e-6") if case.n > 500_000 else ("1e-10", "1e-9")
    tight, other = cvode(case, fine), cvode(case, coarse)
    return tight, f"CVODE at {fine}; at {coarse} differs by {difference(tight, other):.0e}"


def difference(a, b):
    return np.abs(a - b).max() / np.ptp(a)


def cvode(case, tolerance):
    in_depth = "3d" in case.name or case.n > 500_000
    return peer(case, "cvode", tolerance, "spgmr" if in_depth and case.n >= KRYLOV else "klu")


def steady(case, residual):
    return peer(case, "steady", "pcg_ic0", residual)


def peer(case, program, *arguments):
    """The rows that a C peer writes."""
    rows = case.file(f"{program}.{'.'.join(arguments)}.bin")
    program = tools.folder() / "build" / program
    subprocess.run([program, case.file("net.bin"), rows, *arguments], check=True, stdout=subprocess.DEVNULL)
    read = np.fromfile(rows).reshape(case.shape)
    rows.unlink()
    return read


def modal(net):
    """The exact solution of a linear network whose heats are straight lines between events.

    With C = diag(c), S = C^-1/2 and S K S = V L V^T, T = S V z gives z' = -L z + V^T S heat."""
    K, load = dense(net)
    S = 1 / np.sqrt(net["C"])
    decay, V = np.linalg.eigh((K * S).T * S)
    T, rows = net["T0"].copy(), np.zeros((len(net["tout"]), len(net["probe"])))
    events = [*net["brk"], float(net["t_end"])]
    shown = V[net["probe"]] * S[net["probe"], None]
    for begin, end in zip(events, events[1:]):
        heat, slope = lines(net, load, begin, end)
        z, heat, slope = V.T @ (T / S), V.T @ (S * heat), V.T @ (S * slope)
        rising = slope / decay
        at_rest = (heat - rising) / decay
        within = np.flatnonzero((net["tout"] > begin * (1 + 1e-14)) & (net["tout"] <= end * (1 + 1e-14)))
        t = np.append(net["tout"][within], end) - begin
        z = np.exp(-np.outer(t, decay)) * (z - at_rest) + at_rest + np.outer(t, rising)
        rows[within] = z[:-1] @ shown.T
        T = S * (V @ z[-1])
    return rows


def dense(net):
    """The conductance matrix, and the heat from the boundaries at 0 degC."""
    n = len(net["C"])
    K, load = np.zeros((n, n)), np.zeros(n)
    np.add.at(K, (net["ei"], net["ei"]), net["G"])
    inside = net["ej"] < n
    i, j, G = net["ei"][inside], net["ej"][inside], net["G"][inside]
    np.add.at(K, (j, j), G)
    np.add.at(K, (i, j), -G)
    np.add.at(K, (j, i), -G)
    np.add.at(load, net["ei"][~inside], net["G"][~inside] * net["bT"][net["ej"][~inside] - n])
    return K, load


def lines(net, load, begin, end):
    """Heat into every node from one event to the next: `heat + (t - begin) * slope`."""
    heat, slope = load.copy(), np.zeros(len(load))
    for k, node in enumerate(net["src"]):
        corners = slice(net["ptr"][k], net["ptr"][k + 1])
        t, P = net["pt"][corners], net["pp"][corners]
        first, last = after(t, P, begin), before(t, P, end)
        heat[node] += first
        slope[node] += (last - first) / (end - begin)
    return heat, slope


def after(t, P, at):
    """The heat just after a time; a time that stands twice is a jump."""
    k = np.searchsorted(t, at, "right") - 1
    return P[k] if k == len(t) - 1 else P[k] + (P[k + 1] - P[k]) * (at - t[k]) / (t[k + 1] - t[k])


def before(t, P, at):
    """The heat just before a time."""
    k = np.searchsorted(t, at, "left")
    return P[0] if k == 0 else P[k - 1] + (P[k] - P[k - 1]) * (at - t[k - 1]) / (t[k] - t[k - 1])
