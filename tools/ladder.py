#!/usr/bin/env python3
"""Writes the elements of Cauer ladders that `crates/lptn-network/tests/ladder.rs` compares with.

    pip install mpmath
    python3 tools/ladder.py

The impedance of each Foster chain is written as a quotient of polynomials, which long division
turns into the continued fraction: what lptn does not do, and what needs some thousand digits. The
digits suffice where 1500 and 2200 of them give the same 30. It also prints how exact the rotations
of the literature are in doubles.
"""

from pathlib import Path

import mpmath
from mpmath import mpf

FILE = Path(__file__).resolve().parent.parent / "crates/lptn-network/tests/ladder.csv"


def geometric(count, first, ratio):
    """Time constants in doubles, each the one before times the ratio, as the test makes them."""
    taus = [first]
    while len(taus) < count:
        taus.append(taus[-1] * ratio)
    return taus


CASES = {
    "decades_8": geometric(200, 1e-4, 1.0969858),
    "decades_16": geometric(200, 1e-8, 1.2033777),
    "close_steps": [1.0 + 0.01 * k for k in range(100)],
    "close_ratio": geometric(100, 1.0, 1.02),
}


def resistance(k):
    """Uneven, and exact in doubles."""
    return (1 + 7 * k % 11) / 8


def polynomials(terms):
    """Numerator and denominator of a Foster chain, constant first."""
    numerator, denominator = [mpf(0)], [mpf(1)]
    for resistance, tau in terms:
        n, d = [mpf(0)] * len(denominator), denominator + [mpf(0)]
        for k, c in enumerate(numerator):
            n[k] += c
            if k + 1 < len(n):
                n[k + 1] += c * tau
        for k, c in enumerate(denominator):
            n[k] += resistance * c
            d[k + 1] += c * tau
        numerator, denominator = n, d
    return numerator, denominator


def ladder(terms, digits):
    """Capacity and resistance of each rung, port first."""
    mpmath.mp.dps = digits
    n, d = polynomials([(mpf(r), mpf(tau)) for r, tau in terms])
    rungs = []
    while n:
        capacity = d[-1] / n[-1]
        d = [d[k] - (capacity * n[k - 1] if k else 0) for k in range(len(d) - 1)]
        resistance = n[-1] / d[-1]
        n = [n[k] - resistance * d[k] for k in range(len(n) - 1)]
        rungs.append((capacity, resistance))
    return rungs


def rotations(terms):
    """The same ladder by the rotations of Rutishauser, Kahan, Pal and Walker, in doubles (W. B.
    Gragg and W. J. Harwood, Numer. Math. 44 (1984) 317), for comparison."""
    rates, weights = [1 / tau for _, tau in terms], [r / tau for r, tau in terms]
    diagonal, beside = rates[:], [weights[0]] + [0.0] * (len(terms) - 1)
    for k in range(1, len(terms)):
        new, gamma, sigma, t = weights[k], 1.0, 0.0, 0.0
        for j in range(k + 1):
            rho, before = beside[j] + new, sigma
            old, beside[j] = beside[j], gamma * rho
            gamma, sigma = (old / rho, new / rho) if rho > 0 else (1.0, 0.0)
            change = sigma * (diagonal[j] - rates[k]) - gamma * t
            diagonal[j] -= change - t
            t = change
            new = t * t / sigma if sigma > 0 else before * old
    rungs, capacity, e = [], 1 / beside[0], 0.0
    for k, alpha in enumerate(diagonal):
        q = alpha - e
        rungs.append((capacity, 1 / (q * capacity)))
        if k + 1 < len(terms):
            e = beside[k + 1] / q
            capacity *= q / e
    return rungs


def worst(found, expected):
    """The largest relative error of an element."""
    return float(max(abs(a / b - 1) for f, x in zip(found, expected) for a, b in zip(f, x)))


def main():
    lines = ["case,capacity [J/K],resistance [K/W]"]
    for name, taus in CASES.items():
        terms = [(resistance(k), tau) for k, tau in enumerate(taus)]
        rungs = ladder(terms, 2200)
        for found, other in zip(rungs, ladder(terms, 1500)):
            assert all(mpmath.nstr(a, 30) == mpmath.nstr(b, 30) for a, b in zip(found, other))
            lines.append(f"{name},{mpmath.nstr(found[0], 17)},{mpmath.nstr(found[1], 17)}")
        first, last = (worst(rotations(t), rungs) for t in (terms, terms[::-1]))
        print(f"{name}: by rotations {first:.0e} with the fastest first, {last:.0e} last")
    FILE.write_text("\n".join(lines) + "\n")


main()
