"""Frames in the place of files: the answers are those of the same CSV files."""

import importlib.util
import os
import pathlib
import pickle
import tempfile
import unittest
import warnings
from datetime import datetime, timedelta

import numpy as np

import lptn
from test_data import needs
from test_lptn import BODY, NETWORKS, Frame

COFFEE = NETWORKS / "coffee.toml"
RECORD = NETWORKS / "records" / "coffee.csv"
GEARS = NETWORKS / "records" / "synthetic_gearbox"


def columns(file):
    """The columns of a CSV file of numbers by their headings."""
    lines = [line for line in file.read_text(encoding="utf-8").splitlines() if line[0] != "#"]
    rows = [[float(cell) for cell in line.split(",")] for line in lines[1:]]
    return dict(zip(lines[0].split(","), map(list, zip(*rows))))


class Frames(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore", lptn.Doubt)
        self.addCleanup(warnings.resetwarnings)
        self.net = lptn.load(COFFEE)
        self.record = columns(RECORD)

    def all_kinds(self):
        """The record as every kind of frame."""
        heads = {head: head.partition(" [") for head in self.record}
        yield self.record
        yield {head: np.array(values) for head, values in self.record.items()}
        yield {heads[h][0]: (values, heads[h][2][:-1]) for h, values in self.record.items()}
        yield Frame(**self.record)
        if importlib.util.find_spec("pandas"):
            import pandas

            frame = pandas.DataFrame(self.record)
            yield from [frame, frame.set_index("time [s]"), frame.astype(object)]
            pairs = [(heads[head][0], heads[head][2][:-1]) for head in self.record]
            yield frame.set_axis(pandas.MultiIndex.from_tuples(pairs), axis=1)
            times = pandas.to_timedelta(frame["time [s]"], unit="s")
            yield frame.drop(columns="time [s]").set_index(pandas.TimedeltaIndex(times, name=None))
        if importlib.util.find_spec("polars"):
            import polars

            yield polars.DataFrame(self.record)

    def test_a_fit_has_the_bytes_of_the_file(self):
        whole = self.net.fit().json()
        for frame in self.all_kinds():
            self.assertEqual(self.net.fit("cooling", data=frame).json(), whole)
        by_name = {"records/coffee.csv": self.record}
        for data in [by_name, [self.record], (self.record,)]:
            self.assertEqual(self.net.fit(data=data).json(), whole)

    def test_netlists_name_frames(self):
        text = COFFEE.read_text(encoding="utf-8").replace("records/coffee.csv", "cups.csv")
        with self.assertRaises(lptn.Error) as caught:
            lptn.parse(text)
        self.assertIn('files={"cups.csv": frame}', caught.exception.help)
        whole = self.net.fit().csv()
        for make in [lptn.parse, lptn.Network.from_toml]:
            net = make(text, files={"cups.csv": self.record})
            self.assertEqual(net.fit().csv(), whole)
            self.assertEqual(pickle.loads(pickle.dumps(net)).fit().csv(), whole)
            self.assertEqual(net.fit(data=self.record).csv(), whole)
            # further text is read with the same files
            np.testing.assert_allclose(net.sweep({"G_black": [0.4]})["black_T"], [17], rtol=1e-9)
            self.assertEqual(net.value_and_grad("black.T", by="G_black")([4e-4])[0], 17.0)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "cups.toml")
            file.write_text(text, encoding="utf-8")
            net = lptn.load(file, files={"cups.csv": self.record})
            self.assertEqual(net.fit().csv(), whole)
        with self.assertRaises(ValueError) as caught:
            lptn.parse(text, files={"cups.csv": self.record, "other.csv": self.record})
        self.assertIn("no file `other.csv`: it reads cups.csv", str(caught.exception))

    def test_networks_in_code_have_frames(self):
        net = lptn.Network()
        net.parameter("G", "0.5 mW/K")
        net.node("black", C="1 J/K", T0="82.3 degC")
        net.path("resistor", "skin", "black", net.boundary("room", "17 degC"), G="G")
        net.settings("46 min")
        more = {"column": {"black": "black.T"}, "vary": {"G": {}}}
        net.add("fit", "frame", data=self.record, **more)
        net.add("fit", "table", data=[{"csv": self.record, "decimal": "."}], **more)
        net.add("fit", "file", data=str(RECORD), **more)
        values = [net.fit(name)["value"].tolist() for name in ("frame", "table", "file")]
        self.assertEqual(values[0], values[2])
        self.assertEqual(values[1], values[2])
        self.assertEqual(pickle.loads(pickle.dumps(net)).fit("frame")["value"].tolist(), values[2])

    def test_signals_and_inference_read_frames(self):
        # P(t) = 20 W, then 40 W: the steady state of the end is 25 + 40 / 2
        text = BODY.replace('P = "40 W"', "").replace('P = "P"', 'P = "load"')
        text += '[signal]\nload = { csv = "load.csv", value = "P", time = "t", interp = "previous", after_end = "hold" }\n'
        net = lptn.parse(text, files={"load.csv": {"t [s]": [0, 60], "P [W]": [20, 40]}})
        self.assertAlmostEqual(net.run(stop="3 h")["block.T"][-1], 45, delta=1e-3)
        power = NETWORKS.parent / "docs" / "power.toml"
        net, record = lptn.load(power), columns(GEARS / "7000rpm_a.csv")
        whole = net.infer().json()
        self.assertEqual(net.infer(data=record).json(), whole)
        self.assertEqual(net.infer("power", data=record).json(), whole)

    def test_records_of_steps_and_points(self):
        found, own = lptn.fit_step(self.record), lptn.fit_step(RECORD)
        self.assertEqual(found.csv(), own.csv())
        frame = lptn.fit_step({"t": ([0, 1, 2, 3, 4], "min"), "T": ([20, 30, 35, 37.5, 38.75], "degC")})
        # a half of the rest in each minute: T = 40 - 20 2^(-t/min)
        self.assertAlmostEqual(frame["t_RC"][0], 60 / np.log(2), delta=1e-6)
        impedance = {"time [s]": np.linspace(0, 5, 100)}
        noise = np.random.default_rng(1).normal(0, 1e-4, 100)
        impedance["Zth [K/W]"] = 2 * (1 - np.exp(-impedance["time [s]"])) + noise
        terms = lptn.fit_step(impedance, terms=1)
        self.assertAlmostEqual(terms["tau"][0], 1, places=3)
        points = {"omega [rpm]": [1000, 2000, 3000, 4000], "P [W]": [8.0, 16, 24, 32]}
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "points.csv")
            rows = "\n".join(f"{n},{p}" for n, p in zip(*points.values()))
            file.write_text(f"{','.join(points)}\n{rows}\n", encoding="utf-8")
            self.assertEqual(lptn.fit_law(points).csv(), lptn.fit_law(file).csv())
        words = {"capacity": "2659 J/K ± 5 %"}
        records = {file.name: columns(file) for file in GEARS.glob("*.csv")}
        self.assertEqual(lptn.fit_law(records, **words).csv(), lptn.fit_law(GEARS, **words).csv())
        named = dict(zip("abc", (records[f"{speed}000rpm_a.csv"] for speed in (1, 2, 3))))
        named = {f"{name}.csv": record for name, record in named.items()}
        sheet = {"file": list(named), "omega [rpm]": [1000, 2000, 3000]}
        by_sheet = lptn.fit_law({**named, "runs.csv": sheet}, **words)
        by_name = {f"{k}000rpm.csv": one for k, one in enumerate(named.values(), 1)}
        names = list(by_sheet.table.units)
        for name, other in [(name, lptn.fit_law(by_name, **words)[name]) for name in names]:
            np.testing.assert_array_equal(np.asarray(by_sheet[name]), np.asarray(other))

    def test_results_are_frames(self):
        run = self.net.run(every="2 min", G_black="0.4 mW/K", G_cream="0.3 mW/K")
        text = COFFEE.read_text(encoding="utf-8").replace("records/coffee.csv", "run.csv")
        text = text.replace("{ black = \"b", '{ "black.T" = "b').replace(", cream", ', "cream.T"')
        for data in [run, run.table, {name: run[name] for name in ("time", "black.T", "cream.T")}]:
            found = lptn.parse(text, files={"run.csv": data}).fit()
            np.testing.assert_allclose(found["value"], [0.4, 0.3], rtol=1e-5)

    def test_dates_and_gaps(self):
        whole = self.net.fit()["value"].tolist()
        start = datetime(2026, 5, 3, 9)
        dates = [start + timedelta(seconds=seconds) for seconds in self.record["time [s]"]]
        rest = {head: values for head, values in self.record.items() if head != "time [s]"}
        for times in [dates, np.array(dates, dtype="datetime64[ms]"), [str(date) for date in dates]]:
            self.assertEqual(self.net.fit(data={"time": times, **rest})["value"].tolist(), whole)
        lengths = [timedelta(seconds=seconds) for seconds in self.record["time [s]"]]
        nothing = [None] * len(lengths)
        for times in [lengths, np.array(lengths, dtype="timedelta64[ns]")]:
            data = {"t": times, "note": nothing, **rest}
            self.assertEqual(self.net.fit(data=data)["value"].tolist(), whole)
        gaps = {**self.record, "black [degC]": [None, *self.record["black [degC]"][1:]]}
        self.assertIn("1 gap", str(self.net.fit(data=gaps).doubts[0]))

    @needs("pandas")
    def test_missing_values_of_pandas(self):
        import pandas

        frame = pandas.DataFrame(self.record).convert_dtypes()
        frame.loc[3, "black [degC]"] = pandas.NA
        (doubt,) = self.net.fit(data=frame).doubts
        self.assertIn("coffee.csv, row 3: column `black` has 1 gap", str(doubt))

    def test_places_are_rows(self):
        wrong = {**self.record, "time [s]": [0, 240, 120, *self.record["time [s]"][3:]]}
        for ask, place in [(lambda: self.net.fit(data=wrong), f"{RECORD}, row 2: "),
                           (lambda: lptn.fit_step(wrong), "frame, row 2: ")]:
            with self.assertRaises(lptn.Error) as caught:
                ask()
            self.assertTrue(str(caught.exception).startswith(place), str(caught.exception))
            self.assertEqual(caught.exception.places[0].row, 2)
        bare = {head.partition(" ")[0]: values for head, values in self.record.items()}
        with self.assertRaises(lptn.Error) as caught:
            lptn.fit_step(bare)
        self.assertIn("frame, headings: column `time` has no unit", str(caught.exception))
        self.assertNotIn("a command", str(caught.exception))

    def test_wrong_frames(self):
        for data, words in [(3, "not 3"), ([1, 2], "1 record:"), ([self.record] * 2, "1 record:"),
                            ({"x.csv": self.record}, "no record 'x.csv'"), ({"a": 1}, "no record 'a'"),
                            ({"a [s]": [1], "b [K]": [1, 2]}, "a [s] 1, b [K] 2"),
                            ({"records/coffee.csv": 3}, "not 3"), ({"a": np.ones((2, 2))}, "'a'")]:
            with self.assertRaises(TypeError) as caught:
                self.net.fit(data=data)
            self.assertIn(words, str(caught.exception))
        for ask, words in [
            (lambda: lptn.fit_step([1, 2]), "`record` takes a CSV file, a DataFrame"),
            (lambda: lptn.fit_step({}), "not dict"),
            (lambda: lptn.fit_step(None), "`record` is missing"),
            (lambda: lptn.fit_law({"a.csv": 3}), "`points` takes frames by their names"),
            (lambda: self.net.run(data=Frame(**self.record)), "`data` takes no frame"),
            (lambda: self.net.fit(dat=Frame(**self.record)), "`dat` takes no frame"),
            (lambda: lptn.load(COFFEE, files={"records/coffee.csv": self.record}).check(), "on the disk"),
        ]:
            with self.assertRaises(TypeError) as caught:
                ask()
            self.assertIn(words, str(caught.exception))
        for files in [3, {"a.csv": 3}, {"a.csv": "b.csv"}]:
            self.assertRaises(TypeError, lptn.load, COFFEE, files=files)
        with self.assertRaises(lptn.Error) as caught:
            self.net.fit("heating", data=self.record)
        self.assertEqual(caught.exception.code, "fit::no_study")


class Candidates(unittest.TestCase):
    @needs("pandas")
    def test_rows_keep_their_index(self):
        import pandas

        net = lptn.parse(BODY)
        frame = pandas.DataFrame({"G": [4.0, -1, 2]}, index=["big", "wrong", "small"])
        swept = net.sweep(frame)
        for result in [swept, pickle.loads(pickle.dumps(swept))]:
            table = result.to_pandas()
            self.assertEqual(list(table.index), ["big", "wrong", "small"])
            # 25 degC + 40 W / G
            self.assertAlmostEqual(table.loc["big", "block_T [degC]"], 35, places=9)
            self.assertEqual(list(table["failed"]), ["", "network::not_positive", ""])

    def test_failures_have_words(self):
        for net, code in [(lptn.parse(BODY), "network::not_positive")]:
            swept = net.sweep({"G": [4, -1, 2, -3]})
            self.assertEqual(list(swept.failures), [2, 4])
            self.assertEqual({problem.code for problem in swept.failures.values()}, {code})
            self.assertIn("got -3 W/K", swept.failures[4].message)
            kept = pickle.loads(pickle.dumps(swept)).failures
            self.assertEqual((list(kept), kept[2].code), ([2, 4], code))
            self.assertEqual(net.sweep({"G": [4]}).failures, {})
        self.assertRaises(TypeError, lambda: lptn.parse(BODY).run().failures)


class Heats(unittest.TestCase):
    """One body: T = 25 + 20 (1 - exp(-t/250 s)) degC, C = 500 J/K, 2 W/K to the air, 40 W."""

    def test_heats_of_a_simulation(self):
        sim = lptn.parse(BODY).simulation()
        self.assertEqual((len(sim.ledger), sim["cooling.Q"], sim["heat.P"]), (0, 0.0, 40.0))
        sim.step("250 s")
        rise = 20 * (1 - np.exp(-1))
        for name, expected, unit in [("block.T", 25 + rise, "degC"), ("air.T", 25, "degC"),
                                     ("cooling.Q", 2 * rise, "W"), ("heat.P", 40, "W"),
                                     ("air.Q", -2 * rise, "W")]:
            self.assertAlmostEqual(sim[name], expected, delta=2e-3)
            self.assertEqual((float(sim.table[name]), sim.table[name].unit), (sim[name], unit))
        heats = dict(zip(zip(sim.ledger["part"], sim.ledger["name"]), sim.ledger["heat"]))
        self.assertEqual(sim.ledger["heat"].unit, "J")
        for key, expected in [(("sources", "heat"), 1e4), (("stored", "block"), 500 * rise),
                              (("boundaries", "air"), 500 * rise - 1e4), (("residual", ""), 0)]:
            self.assertAlmostEqual(heats[key], expected, delta=1)
        sim.set(P="0 W")
        self.assertEqual(sim["heat.P"], 0)
        sim.step("0 s")
        self.assertEqual(len(sim.ledger), 0)

    def test_states_and_signals_of_a_simulation(self):
        text = BODY + '[signal]\nspeed = "100 rpm"\n[state]\nx = { rate = "1 [1/s]", start = "2" }\n'
        sim = lptn.parse(text).simulation()
        sim.step("3 s")
        self.assertAlmostEqual(sim["x"], 5, places=9)
        self.assertAlmostEqual(sim["speed"], 100 * 2 * np.pi / 60, places=9)
        self.assertEqual(sim.table["speed"].unit, "rad/s")

    def test_energy_balance_of_a_run(self):
        run = lptn.parse(BODY).run(balance="block", tolerance="1e-8 K")
        stored = 500 * 20 * (1 - np.exp(-1800 / 250))
        self.assertEqual(run.ledger["part"], ["sources", "boundaries", "stored", "residual"])
        self.assertEqual(run.ledger["name"], ["heat", "air", "block", ""])
        expected = [40 * 1800, stored - 40 * 1800, stored, 0]
        np.testing.assert_allclose(run.ledger["heat"], expected, rtol=1e-8, atol=1e-4)
        self.assertEqual(run.balance["name"], ["heat", "cooling"])
        self.assertEqual(run.balance["other"], ["", "air"])
        self.assertEqual(run.balance["heat"].unit, "J")
        np.testing.assert_allclose(run.balance["heat"], expected[:2], rtol=1e-8)
        steady = lptn.parse(BODY).steady(balance="block").balance
        self.assertEqual(dict(zip(steady["name"], steady["power"])), {"heat": 40, "cooling": -40})
        self.assertNotIn("heat", steady)
        again = pickle.loads(pickle.dumps(run.ledger))
        self.assertEqual(again["heat"].tolist(), run.ledger["heat"].tolist())
        for wrong in [lambda: lptn.parse(BODY).run().balance, lambda: lptn.parse(BODY).steady().ledger]:
            self.assertRaises(TypeError, wrong)

    def test_bands_are_columns(self):
        net = lptn.parse(BODY.replace("2 W/K", "2 W/K ± 0.1 W/K"))
        run, certain = net.run(uncertainty="linear", tolerance="1e-8 K"), net.run(tolerance="1e-8 K")
        t = np.array(run["time"])
        left = np.exp(-t / 250)
        # T - 25 degC = P/G (1 - exp(-G t/C)): its derivative by G, times 0.1 W/K
        sd = 0.1 * np.abs(-10 * (1 - left) + 20 * t / 500 * left)
        np.testing.assert_allclose(run["block.T.sd"], sd, atol=1e-6)
        np.testing.assert_allclose(run["block.T.high"] - run["block.T.low"], 2 * 1.959964 * sd, atol=1e-5)
        self.assertEqual((run["block.T.sd"].unit, run["block.T.low"].unit), ("K", "degC"))
        for name in ("block.T", "heat.P", "air.Q"):
            self.assertIn(name, run)
            np.testing.assert_allclose(run[name], certain[name], atol=1e-6)
            self.assertEqual((run[name].unit, list(run[name].index)), (certain[name].unit, t.tolist()))
        self.assertRaises(KeyError, lambda: run["x"])
        heads = [os.path.commonprefix([head, head.partition(" [")[0]]) for head in
                 run.csv().splitlines()[0].split(",")]
        self.assertEqual(list(run), heads)


if __name__ == "__main__":
    unittest.main()
