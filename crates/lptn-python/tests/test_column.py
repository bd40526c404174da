"""Columns keep their unit and their times, or they become plain arrays."""

import copy
import pickle
import unittest
import warnings

import numpy as np

import lptn
from test_lptn import BODY

# Functions that ask, write files, print, or fill the memory.
_NOT_ASKED = {"save", "savetxt", "savez", "savez_compressed", "test", "info", "show_config",
              "show_runtime", "tile", "tofile", "dump", "lookfor", "source", "printoptions"}


class Columns(unittest.TestCase):
    def setUp(self):
        # T = 25 + 20 (1 - exp(-t/250 s)) rises: each value has one time
        self.run = lptn.parse(BODY).run(every="3 min")
        self.hot = self.run["block.T"]
        self.values, self.times = np.array(self.hot), np.array(self.run["time"])
        self.order = np.random.default_rng(1).permutation(len(self.values))

    def right(self, made, by):
        """A column has the values of its times in its unit; everything else has neither."""
        if isinstance(made, (list, tuple)):
            for one in made:
                self.right(one, by)
        if not isinstance(made, lptn.Column):
            self.assertFalse(hasattr(made, "unit"), by)
            return
        if not hasattr(made, "unit"):
            self.assertIsNone(made.index, by)
            return
        self.assertIn((made.name, made.unit), [("block.T", "degC"), ("time", "s")], by)
        np.testing.assert_allclose(made.si, np.asarray(made) + 273.15 * (made.unit == "degC"))
        if made.name == "block.T":
            self.assertEqual((made.index.name, made.index.unit), ("time", "s"), by)
            of_times = dict(zip(self.times, self.values))
            self.assertEqual([of_times[t] for t in made.index], list(made), by)

    def test_a_part_has_its_times(self):
        for key in [slice(None, None, -1), slice(10, 20), slice(3, None, 2), ..., (), self.order,
                    self.order.tolist(), self.values > 30, self.hot > 30, [0, 0, 5]]:
            part = self.hot[key]
            self.assertIsInstance(part, lptn.Column)
            np.testing.assert_array_equal(np.asarray(part), self.values[np.asarray(key)
                if isinstance(key, lptn.Column) else key])
            self.right(part, key)
            again = part[::-1][1:]
            np.testing.assert_array_equal(np.asarray(again), np.array(part)[::-1][1:])
            self.right(again, key)
        for key in [3, np.int64(3)]:
            self.assertEqual((type(self.hot[key]), self.hot[key]), (np.float64, self.values[3]))
        for key in [None, (..., None), [[0, 1], [2, 3]]]:
            self.assertIs(type(self.hot[key]), np.ndarray)

    def test_every_function_of_numpy_gives_plain_arrays(self):
        """Whatever is a column afterwards has the right unit and times."""
        r, t = self.hot, self.hot.index
        given = [(r,), (r, t), (r, 1), (r, self.order), ([r, r],), ((r, r),), (r, 0, 1), (t, r),
                 (self.values > 30, r), (r > 30, r, t)]
        called = 0
        calls = [(name, getattr(np, name)) for name in sorted(vars(np))]
        calls += [(f"fft.{name}", getattr(np.fft, name)) for name in ("fft", "fftshift", "hfft")]
        calls += [(f"linalg.{name}", getattr(np.linalg, name)) for name in ("norm", "outer")]
        methods = [name for name in sorted(dir(np.ndarray)) if name not in _NOT_ASKED]
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            for name, function in calls:
                if name in _NOT_ASKED or not callable(function) or isinstance(function, type):
                    continue
                called += self.all_right(name, function, given)
            for name in methods:
                if not name.startswith("__") and callable(getattr(np.ndarray, name)):
                    rest = [(), *(rest for _, *rest in given)]
                    called += self.all_right(name, getattr(r, name), rest)
        self.assertGreater(called, 1000)
        np.testing.assert_array_equal(np.asarray(r), self.values)

    def all_right(self, name, function, given):
        """Calls it with all arguments that it takes, and counts the calls."""
        called = 0
        for args in given:
            try:
                made = function(*args)
            except Exception:  # not for these arguments
                continue
            called += 1
            if made is not self.hot and made is not self.hot.index:
                self.right(made, f"{name} of {len(args)}")
        return called

    def test_known_results(self):
        r = lptn.parse(BODY).run()["block.T"]
        # dT/dt = 20 K/250 s exp(-t/250 s)
        slope = np.gradient(r, r.index)
        self.assertIs(type(slope), np.ndarray)
        expected = 20 / 250 * np.exp(-np.array(r.index) / 250)
        np.testing.assert_allclose(slope[1:-1], expected[1:-1], rtol=0.02)
        for made in [np.flip(r), np.roll(r, 3), np.sort(r)[::-1], np.diff(r), r.reshape(1, -1),
                     np.cumsum(r), np.tile(r, 2), r.repeat(2), r.T, r.round(1), r.view(), -r, np.array(r)]:
            self.assertIs(type(made), np.ndarray)
        self.assertAlmostEqual(r.max(), 25 + 20 * (1 - np.exp(-1800 / 250)), delta=1e-3)
        lost = np.array(r[::-1], subok=True)
        for made in [r.T, r.real, r.imag, r.flat[:]]:
            self.assertIs(type(made), np.ndarray)
        self.assertRaises(AttributeError, lambda: lost.unit)
        self.assertRaises(AttributeError, lambda: lost.si)
        self.assertEqual(repr(lost), repr(np.array(r)[::-1]))

    def test_a_column_does_not_change(self):
        for r in [self.hot, self.hot[self.order], self.hot.copy(), lptn.parse(BODY).sweep(
                {"P": [1, 2]})["block_T"]]:
            before = np.array(r)

            def add():
                r2 = r
                r2 += 1
                return r2

            for change in [r.sort, lambda: r.fill(0), lambda: np.multiply(r, 2, out=r), add,
                           lambda: np.random.default_rng(1).shuffle(r),
                           lambda: r.__setitem__(0, 1.0), lambda: np.copyto(r, 0)]:
                self.assertRaises(ValueError, change)
            with self.assertRaises(AttributeError):
                r.shape = (1, -1)
            with self.assertRaises(AttributeError):
                r.unit = "K"
            np.testing.assert_array_equal(np.asarray(r), before)

    def test_copies_keep_both(self):
        steady = lptn.parse(BODY).steady()["block.T"]
        for again in [copy.copy, copy.deepcopy, lambda c: c.copy(),
                      lambda c: pickle.loads(pickle.dumps(c))]:
            back = again(self.hot[self.order])
            self.assertIsInstance(back, lptn.Column)
            np.testing.assert_array_equal(np.asarray(back), self.values[self.order])
            self.right(back, again)
            one = again(steady)
            self.assertEqual((one.shape, one.unit, float(one)), ((), "degC", float(steady)))


if __name__ == "__main__":
    unittest.main()
