"""What follows from the arrays of net.npz: the matrix of conductances and heats between events."""

import numpy as np


def conductances(net):
    """Entries of K to be summed, their rows and columns, and the load of the boundaries."""
    n, inside = len(net["C"]), net["ej"] < len(net["C"])
    i, j, G = net["ei"][inside], net["ej"][inside], net["G"][inside]
    to, edge = net["ej"][~inside] - n, net["ei"][~inside]
    load = np.bincount(edge, net["G"][~inside] * net["bT"][to], n)
    values = np.concatenate([net["G"], G, -G, -G])
    return values, np.concatenate([net["ei"], j, i, j]), np.concatenate([net["ei"], j, j, i]), load


def dense(net):
    """The matrix of conductances, and the heat from the boundaries at 0 degC."""
    values, rows, columns, load = conductances(net)
    K = np.zeros((len(load), len(load)))
    np.add.at(K, (rows, columns), values)
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
