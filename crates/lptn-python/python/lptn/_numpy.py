"""NumPy, or an error that says how to get it."""

from __future__ import annotations

try:
    import numpy as np
except ImportError:
    raise ImportError("columns of lptn need numpy: pip install numpy") from None

__all__ = ["np"]
