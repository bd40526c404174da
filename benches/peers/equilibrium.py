"""The steady state of a linear network by SciPy's SuperLU or by pyamg, from net.npz.

equilibrium.py splu|amg NET.NPZ ROWS.BIN -
"""

import sys
from pathlib import Path

import numpy as np
import scipy.sparse as sparse

sys.path.insert(0, str(Path(__file__).parent.parent))
import arrays

RESIDUAL = 1e-10


def by_splu(K, heat):
    from scipy.sparse.linalg import splu

    symmetric = dict(
        permc_spec="MMD_AT_PLUS_A", options=dict(SymmetricMode=True), diag_pivot_thresh=0.0
    )
    return splu(K.tocsc(), **symmetric).solve(heat)


def by_amg(K, heat):
    import pyamg

    return pyamg.smoothed_aggregation_solver(K).solve(heat, tol=RESIDUAL, accel="cg")


def main():
    method, file, to, _ = sys.argv[1:]
    net = dict(np.load(file))
    values, rows, columns, load = arrays.conductances(net)
    K = sparse.csr_matrix((values, (rows, columns)), (len(load), len(load)))
    heat, _ = arrays.lines(net, load, 0.0, float(net["t_end"]))
    dict(splu=by_splu, amg=by_amg)[method](K, heat)[net["probe"]].tofile(to)


main()
