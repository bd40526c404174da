"""The temperatures that a case is compared with, and how well they are known."""

import subprocess

import numpy as np

import arrays
import tools

MODAL = 1_100
"""The largest linear network that is also solved by the eigenvalues of its whole matrix."""
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
    """The better of two that are computed in different ways, or at different tolerances."""
    if case.program:
        return law(case)
    if case.steady:
        tight, other = steady(case, "1e-13"), steady(case, "1e-11")
        return (
            tight,
            f"conjugate gradients to 1e-13; to 1e-11 differs by {difference(tight, other):.0e}",
        )
    fine, coarse = tolerances(case)
    tight = cvode(case, fine)
    if case.linear and case.n <= MODAL:
        exact = modal(np.load(case.file("net.npz")))
        return tight, f"CVODE at {fine}; by eigenvalues differs by {difference(tight, exact):.0e}"
    return (
        tight,
        f"CVODE at {fine}; at {coarse} differs by {difference(tight, cvode(case, coarse)):.0e}",
    )


def law(case):
    """The C program of the family at a tight tolerance, and at ten times that."""
    mode = "steady" if case.steady else "run"
    tight, other = (peer(case, case.program, tolerance, mode) for tolerance in ("1e-11", "1e-10"))
    return tight, f"its C program at 1e-11; at 1e-10 differs by {difference(tight, other):.0e}"


def tolerances(case):
    """That of a reference, and one to judge it by."""
    return ("1e-10", "1e-9") if case.n > 3_000 else ("1e-11", "1e-10")


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
    subprocess.run(
        [program, case.file("net.bin"), rows, *arguments], check=True, stdout=subprocess.DEVNULL
    )
    read = np.fromfile(rows).reshape(case.shape)
    rows.unlink()
    return read


def modal(net):
    """The exact solution of a linear network whose heats are straight lines between events.

    With C = diag(c), S = C^-1/2 and S K S = V L V^T, T = S V z gives z' = -L z + V^T S heat.
    Rounding of L is what is left: 5e-7 of the range where time constants span twelve decades."""
    K, load = arrays.dense(net)
    S = 1 / np.sqrt(net["C"])
    decay, V = np.linalg.eigh((K * S).T * S)
    T, rows = net["T0"].copy(), np.zeros((len(net["tout"]), len(net["probe"])))
    events = [*net["brk"], float(net["t_end"])]
    shown = V[net["probe"]] * S[net["probe"], None]
    for begin, end in zip(events, events[1:]):
        heat, slope = arrays.lines(net, load, begin, end)
        z, heat, slope = V.T @ (T / S), V.T @ (S * heat), V.T @ (S * slope)
        rising = slope / decay
        at_rest = (heat - rising) / decay
        within = np.flatnonzero(
            (net["tout"] > begin * (1 + 1e-14)) & (net["tout"] <= end * (1 + 1e-14))
        )
        t = np.append(net["tout"][within], end) - begin
        z = np.exp(-np.outer(t, decay)) * (z - at_rest) + at_rest + np.outer(t, rising)
        rows[within] = z[:-1] @ shown.T
        T = S * (V @ z[-1])
    return rows
