"""Results as frames of other packages, pickles, progress and help."""

import contextlib
import importlib.util
import io
import os
import pickle
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

import lptn
from test_lptn import BODY, GEARBOX


def needs(*packages):
    missing = [name for name in packages if importlib.util.find_spec(name) is None]
    return unittest.skipIf(missing, f"not installed: {', '.join(missing)}")


class Data(unittest.TestCase):
    def setUp(self):
        self.net = lptn.parse(BODY)
        self.run = self.net.run()
        self.hot = np.asarray(self.run["block.T"])

    def test_numbers_are_not_copied(self):
        first, second = self.run["block.T"], self.run["block.T"]
        self.assertTrue(np.shares_memory(first, second))

    @needs("pandas")
    def test_pandas(self):
        frame = self.run.to_pandas()
        self.assertEqual(frame.index.name, "time [s]")
        np.testing.assert_array_equal(frame["block.T [degC]"], self.hot)
        self.assertEqual(len(self.net.steady().to_pandas()), 1)
        swept = self.net.sweep(frame.iloc[:2].rename(columns={"heat.P [W]": "P"})[["P"]])
        self.assertEqual(len(swept.to_pandas()), 2)

    @needs("polars")
    def test_polars(self):
        import polars

        frame = self.run.to_polars()
        np.testing.assert_array_equal(frame["block.T [degC]"].to_numpy(), self.hot)
        # T = 25 + P / 2
        swept = self.net.sweep(polars.DataFrame({"P": [20.0, 40.0]}))
        np.testing.assert_allclose(swept["block_T"], [35, 45], rtol=1e-9)

    @needs("pyarrow")
    def test_arrow_and_parquet(self):
        import pyarrow.parquet as parquet

        table = self.run.to_arrow()
        self.assertEqual(table.schema.field("block.T").metadata, {b"unit": b"degC"})
        with tempfile.TemporaryDirectory() as folder:
            parquet.write_table(table, os.path.join(folder, "run.parquet"))
            again = parquet.read_table(os.path.join(folder, "run.parquet"))
        np.testing.assert_array_equal(again["block.T"].to_numpy(), self.hot)

    @needs("xarray")
    def test_xarray(self):
        data = self.run.to_xarray()
        self.assertEqual(data["block.T"].attrs["units"], "degC")
        self.assertEqual(data["time"].attrs["units"], "s")
        self.assertEqual(data.attrs["title"], self.net.title)
        np.testing.assert_array_equal(data["block.T"].sel(time=600), self.hot[10])
        self.assertEqual(self.net.steady().to_xarray()["block.T"].shape, ())

    @needs("pint")
    def test_pint(self):
        hot = self.run["block.T"].to_pint()
        np.testing.assert_allclose(hot.to("kelvin").magnitude, self.hot + 273.15)

    @needs("matplotlib")
    def test_axes_have_one_unit_of_time(self):
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        minutes = self.net.run(time_unit="min")
        first = self.run["block.T"].plot()
        self.assertIs(self.run["block.T"].plot(), first)
        self.assertEqual(first.get_xlabel(), "time [s]")
        self.assertIsNot(minutes.plot(), first)
        self.assertEqual(plt.gca().get_xlabel(), "time [min]")
        with self.assertRaises(ValueError):
            minutes["block.T"].plot(ax=first)
        plt.close("all")

    @needs("matplotlib")
    def test_labels_and_limits_of_axes(self):
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        self.addCleanup(plt.close, "all")
        axes = self.run.plot()
        self.assertEqual(axes.get_ylabel(), "temperature [degC]")
        texts = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertEqual(texts, ["block.T", "air.T", "warm: below 60 degC"])
        self.assertEqual(set(axes.lines[-1].get_ydata()), {60.0})
        kelvin = self.net.run(temperature_unit="K").plot("block.T")
        self.assertEqual((kelvin.get_ylabel(), kelvin.lines[-1].get_ydata()[0]), ("block.T [K]", 333.15))
        one = plt.subplots()[1]
        for names, label in [("block.T", "block.T [degC]"), ("air.T", "temperature [degC]")]:
            self.run[names].plot(ax=one)
            self.assertEqual(one.get_ylabel(), label)
        one.cla()
        self.run["air.T"].plot(ax=one)
        self.assertEqual(one.get_ylabel(), "air.T [degC]")
        # a reversed column is drawn at its own times
        back = self.run["block.T"][::-1].plot(ax=plt.subplots()[1]).lines[0]
        np.testing.assert_array_equal(back.get_xdata(), np.array(self.run["time"])[::-1])
        np.testing.assert_array_equal(back.get_ydata(), self.hot[::-1])

    @needs("matplotlib")
    def test_each_unit_has_its_panel(self):
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        self.addCleanup(plt.close, "all")
        panels = self.run.plot("block.T", "heat.P", "air.T")
        self.assertEqual([ax.get_ylabel() for ax in panels], ["temperature [degC]", "heat.P [W]"])
        self.assertEqual([ax.get_xlabel() for ax in panels], ["", "time [s]"])
        self.assertEqual([ax.get_title() for ax in panels], ["netlist", ""])
        self.assertEqual(self.run.plot("block.T", title="One body").get_title(), "One body")
        one = plt.subplots()[1]
        self.assertEqual(self.run.plot(ax=one).get_title(), "")
        for wrong in [lambda: self.run.plot("block.T", "heat.P", ax=one),
                      lambda: self.run["heat.P"].plot(ax=one)]:
            self.assertRaises(ValueError, wrong)
        self.run["heat.P"].plot(ax=one.twinx())
        # the present axes are those of a temperature
        plt.sca(one)
        self.assertIsNot(self.run["heat.P"].plot(), one)
        swept = self.net.sweep({"P": [1]})
        for wrong in [swept.plot, lambda: swept.plot("failed")]:
            self.assertRaises(TypeError, wrong)

    @needs("matplotlib")
    def test_bands_are_drawn(self):
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt

        self.addCleanup(plt.close, "all")
        run = lptn.parse(BODY.replace("2 W/K", "2 W/K ± 5 %")).run(uncertainty="linear")
        (band,) = run.plot().collections
        ends = band.get_paths()[0].vertices[:, 1]
        self.assertAlmostEqual(ends.max(), run["block.T.high"].max(), places=9)

    def test_titles(self):
        net = lptn.parse('title = "A body"\n' + BODY)
        for result in [net.run(), net.steady(), net.sweep({"P": [1]}), lptn.load(GEARBOX).run()]:
            again = pickle.loads(pickle.dumps(result))
            self.assertEqual((result.title, again.title), 2 * (str(result).splitlines()[0],))

    def test_a_missing_package_has_an_error(self):
        for package, ask in [("polars", self.run.to_polars), ("pyarrow", self.run.to_arrow)]:
            with mock.patch.dict(sys.modules, {package: None}):
                with self.assertRaises(ImportError) as caught:
                    ask()
                self.assertIn(f"pip install {package}", str(caught.exception))
        with mock.patch.dict(sys.modules, {"tqdm.auto": None}):
            self.assertRaises(ImportError, self.net.run, progress=True)

    def test_without_numpy_a_column_says_how_to_get_it(self):
        code = (
            "import sys; sys.modules['numpy'] = None; import lptn; "
            f"lptn.parse({BODY!r}).run()['block.T']"
        )
        ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(ran.returncode, 1)
        self.assertIn("ImportError: columns of lptn need numpy: pip install numpy", ran.stderr)

    def test_results_are_pickled(self):
        for result in [self.run, self.net.steady(), self.net.run(P="100 W"), self.net.modes()]:
            again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result))))
            same = [result.json(), result.csv(), str(result), result.ok, result.svg()]
            self.assertEqual(
                [again.json(), again.csv(), str(again), again.ok, again.svg()], same
            )
            self.assertEqual(list(again), list(result))
        kept = pickle.loads(pickle.dumps(self.run))
        np.testing.assert_array_equal(kept["block.T"], self.hot)
        self.assertEqual(kept["block.T"].unit, "degC")

    def test_tables_and_functions_are_pickled(self):
        table = pickle.loads(pickle.dumps(self.run.table))
        self.assertEqual((table.names, table.units), (self.run.table.names, self.run.table.units))
        np.testing.assert_array_equal(table["block.T"], self.hot)
        # T = 25 + P / G, G = 2 W/K
        function = pickle.loads(pickle.dumps(self.net.value_and_grad("block.T", by="P")))
        np.testing.assert_allclose(np.hstack(function(60.0)), [55, 0.5], rtol=1e-9)

    def test_progress(self):
        told = []
        self.net.run(progress=lambda *reached: told.append(reached))
        self.assertEqual(told[-1], (1800.0, 1800.0, "s"))
        self.net.sweep({"P": [20, 30]}, progress=lambda *reached: told.append(reached))
        self.assertEqual(told[-1], (2.0, 2.0, "candidates"))

        def stop(*reached):
            raise RuntimeError("enough")

        self.assertRaises(RuntimeError, self.net.run, progress=stop)
        self.net.run(progress=False)

    @needs("tqdm")
    def test_progress_by_tqdm(self):
        out = io.StringIO()
        with contextlib.redirect_stderr(out):
            self.net.run(progress=True)
        self.assertIn("1800", out.getvalue())

    def test_help(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            lptn.help("conduction")
            lptn.help("run")
            lptn.help()
        words = ["W/(m K)", "stop", "temperature_unit", "convection", "progress", "set", "options"]
        for word in words:
            self.assertIn(word, out.getvalue())
        with self.assertRaises(ValueError) as caught:
            lptn.help("conducton")
        self.assertIn("conduction", str(caught.exception))


class Memory(unittest.TestCase):
    def test_a_cycle_leaves_nothing(self):
        """100,000 times load, run and free grow by less than 1 MB: here 2,000, and a twentieth."""
        code = """
import gc, lptn, sys
def size():
    gc.collect()
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))
def cycle(count):
    for _ in range(count):
        lptn.parse(text, "x.toml").run(every="30 min")["block.T"]
text = sys.stdin.read()
cycle(500)
before = size()
cycle(int(sys.argv[1]))
print(size() - before)
"""
        if not os.path.exists("/proc/self/status"):
            self.skipTest("the size of a process is read from /proc")
        count = os.environ.get("LPTN_CYCLES", "2000")
        done = subprocess.run(
            [sys.executable, "-c", code, count],
            input=BODY,
            capture_output=True,
            text=True,
            check=True,
        )
        print(f"\n{count} cycles: {done.stdout.strip()} kB more", file=sys.stderr)
        self.assertLess(int(done.stdout), 1024)


if __name__ == "__main__":
    unittest.main()
