"""Results, errors, doubts and simulations in Python."""

import math
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings

import numpy as np

import lptn
import stub
from lptn import _column

NETWORKS = pathlib.Path(__file__).resolve().parents[3] / "networks"
GEARBOX = NETWORKS / "gearbox.toml"

# One body: C = 500 J/K, 2 W/K to 25 degC, heated by P.
BODY = """
format = 1
[param]
P = "40 W"
G = "2 W/K"
[node]
block = { T0 = "25 degC", C = "500 J/K" }
[boundary]
air = { T = "25 degC" }
[resistor]
cooling = { from = "block", to = "air", G = "G" }
[source]
heat = { into = "block", P = "P" }
[limit]
warm = { of = "block.T", below = "60 degC" }
[run]
stop = "30 min"
output = { every = "1 min" }
"""


# A node that follows a wall with Ta + lift: 10 J/K over 1 K/W.
WALL = """
format = 1
[param]
Ta = "20 degC"
lift = "5 K"
[node]
hot = { T0 = "20 degC", C = "10 J/K" }
[boundary]
wall = { T = "Ta + lift" }
[resistor]
to_wall = { from = "hot", to = "wall", R = "1 K/W" }
[run]
stop = "1 h"
"""


class Frame:
    """A frame as pandas and polars have them: `columns`, and each by its name."""

    def __init__(self, **values):
        self.columns = list(values)
        self.values = values

    def __getitem__(self, name):
        return np.asarray(self.values[name])


class Results(unittest.TestCase):
    def test_a_run_has_its_closed_form(self):
        # T = 25 + 20 (1 - exp(-t/250 s)): one body
        run = lptn.parse(BODY).run(tolerance="1e-8 K")
        heat, clock = run["block.T"], run["time"]
        expected = 25 + 20 * (1 - np.exp(-np.asarray(clock) / 250))
        self.assertLess(np.abs(np.asarray(heat) - expected).max(), 1e-6)
        self.assertEqual((heat.unit, clock.unit, heat.name), ("degC", "s", "block.T"))
        self.assertLess(np.abs(heat.si - expected - 273.15).max(), 1e-6)
        self.assertIs(heat.index, clock)
        self.assertEqual(list(heat[3:5].index), [180.0, 240.0])
        self.assertIs(type(heat * 2), np.ndarray)

    def test_a_steady_state_has_its_closed_form(self):
        # 25.5 degC + P / G_out + 1.7 K, networks/gearbox.toml
        net = lptn.load(GEARBOX)
        for conductance in (3.0, 4.0, 5.5):
            steel = net.steady(G_out=(conductance, "W/K"))["steel.T"]
            self.assertAlmostEqual(float(steel), 27.2 + 220.6 / conductance, places=9)
            self.assertEqual((steel.shape, steel.unit), ((), "degC"))
        # a result is a value with its unit
        hot = net.steady(T_amb=net.steady()["steel.T"])
        self.assertAlmostEqual(float(hot["bed.T"]), 27.2 + 65.5, places=9)

    def test_a_number_in_kelvin_is_absolute_for_an_absolute_parameter(self):
        # the wall has Ta + lift, 300.15 K = 27 degC = 540.27 degR, and the node its temperature
        net = lptn.parse(WALL)
        kelvin, rankine = (net.steady(temperature_unit=unit)["wall.T"] for unit in ("K", "degR"))
        for words, expected in [
            ({"Ta": (300.15, "K")}, 32),
            ({"set": {"Ta": (300.15, "K")}}, 32),
            ({"Ta": (540.27, "degR")}, 32),
            ({"Ta": (27, "degC")}, 32),
            ({"Ta": kelvin}, 30),
            ({"Ta": rankine}, 30),
            ({"lift": (7, "K")}, 27),
            ({"lift": (9, "degR")}, 25),
        ]:
            self.assertAlmostEqual(float(net.steady(**words)["wall.T"]), expected, places=9)
        swept = net.sweep({"Ta [K]": [300.15], "lift [K]": [7]}, report={"hot": "wall.T"})
        np.testing.assert_allclose(swept["hot"], [34], rtol=1e-12)
        loaded = lptn.parse(WALL, Ta=(300.15, "K"))
        self.assertAlmostEqual(float(loaded.steady()["wall.T"]), 32, places=9)
        sim = net.simulation()
        sim.set(Ta=(300.15, "K"))
        sim.step("1 h")  # 100 time constants
        self.assertAlmostEqual(sim["hot"], 32, delta=1e-3)
        # an absolute temperature is not a difference, nor the other way round
        bound = _column.column("hot.T.bound", "K", 0.1)
        for words in [{"lift": kelvin}, {"lift": net.steady()["wall.T"]}, {"Ta": "300 K"},
                      {"Ta": bound}]:
            with self.assertRaises(lptn.Error) as caught:
                net.steady(**words)
            self.assertIn(caught.exception.code, {"units::absolute_wanted", "units::difference_wanted"})

    def test_limits_and_verdict(self):
        net = lptn.parse(BODY)
        kept, broken = net.run(), net.run(P="100 W")
        self.assertTrue(kept.ok and kept.limits["warm"]["kept"] and not kept.verdict)
        self.assertFalse(broken.ok or broken.limits["warm"]["kept"])
        self.assertIn("warm", broken.verdict[0])
        self.assertIn("block", str(kept))
        for page in (kept._repr_html_(), kept.table._repr_html_()):
            self.assertIn("block", page)
        self.assertTrue(kept.svg().startswith("<svg"))

    def test_rows_of_words_become_columns(self):
        swept = lptn.load(NETWORKS / "gearbox_fan.toml").compare()
        self.assertEqual(len(swept.table), 1)
        self.assertIsInstance(swept.table[swept.table.names[0]], list)

    def test_a_frame_of_candidates(self):
        # T = 25 + P / G; over 30 min 1 - exp(-1800 G / 500 J/K) of it
        net = lptn.parse(BODY, G="4 W/K")
        steady = net.sweep({"P": [20, 30], "G [mW/K]": [2000, 3000.0]})
        np.testing.assert_allclose(steady["block_T"], [35, 35], rtol=1e-9)
        self.assertEqual(steady["block_T"].unit, "degC")
        hot = {"hot": "max(block.T)"}
        run = net.sweep({"P": [20, 30]}, over="run", report=hot, threads=1)
        expected = 25 + np.array([20, 30]) / 4 * (1 - math.exp(-1800 * 4 / 500))
        np.testing.assert_allclose(run["hot"], expected, rtol=1e-6)
        for wrong in [{}, {"P": [1, 2], "G": [1]}]:
            self.assertRaises(TypeError, net.sweep, wrong)
        self.assertRaises(TypeError, net.sweep, over="run")
        # the netlist has a study of the name that frames have
        own = 'method = "grid", over = "steady", axes = { P = ["1 W"] }, report = { T = "block.T" }'
        for study in ["[sweep.frame]\n" + own.replace(", ", "\n"), f"[sweep]\nframe = {{ {own} }}"]:
            found = lptn.parse(f"{BODY}\n{study}\n", G="4 W/K").sweep({"P": [20, 30]})
            np.testing.assert_allclose(found["block_T"], [30, 32.5], rtol=1e-9)
        # a file next to the netlist is still found, and the frame need not be a dictionary
        curves = lptn.load(NETWORKS / "gearbox.toml").sweep(Frame(G_out=[4.0]))
        np.testing.assert_allclose(curves["steel_T"], [27.2 + 220.6 / 4], rtol=1e-9)

    def test_parameters(self):
        net = lptn.parse(BODY, G="4 W/K")
        self.assertEqual(net.parameters, {"P": "40.0 W", "G": "4.0 W/K"})
        self.assertEqual(net.nodes, ["block"])
        self.assertEqual(float(net.steady()["block.T"]), 35.0)
        again = pickle.loads(pickle.dumps(net))
        self.assertEqual(again.steady().json(), net.steady().json())
        self.assertEqual(float(lptn.parse(net.to_toml()).steady()["block.T"]), 35.0)

    def test_a_network_that_was_asked_answers_as_a_new_one(self):
        net = lptn.load(GEARBOX)
        for words in [{}, {"temperature_unit": "K"}, {"G_out": "3 W/K"}, {"select": ["steel.T"]},
                      {"temperature_unit": "degF", "P_7000": "100 W"}, {"G_out": "3 W/K"}, {}]:
            own, new = net.steady(**words), lptn.load(GEARBOX).steady(**words)
            self.assertEqual(own.json(), new.json(), words)
            self.assertEqual([(name, own[name].unit, float(own[name])) for name in own],
                             [(name, new[name].unit, float(new[name])) for name in new], words)


class Refusals(unittest.TestCase):
    def test_errors_are_exceptions(self):
        wrong = BODY.replace('into = "block"', 'into = "blok"').replace("30 min", "30 mins")
        with self.assertRaises(lptn.Error) as caught:
            lptn.parse(wrong)
        error = caught.exception
        codes = {problem.code for problem in error.errors}
        self.assertEqual(codes, {"netlist::unknown_node", "units::unknown_unit"})
        self.assertEqual(error.exit, 2)
        self.assertEqual(error.places[0].file, "netlist.toml")
        self.assertEqual((error.fix.place.text, error.fix.text), ('"blok"', '"block"'))
        self.assertEqual(pickle.loads(pickle.dumps(error)).code, error.code)

    def test_a_value_without_its_unit(self):
        with self.assertRaises(lptn.Error) as caught:
            lptn.load(GEARBOX).steady(G_out=4)
        self.assertTrue(caught.exception.code.startswith("units::"))

    def test_arguments(self):
        net = lptn.parse(BODY)
        for call, words in [
            (lambda: net.run(select=True), "select"),
            (lambda: net.run(temperatur_unit="K"), "temperature_unit"),
            (lambda: net.run(every=object()), "every"),
            (lambda: net.run("x"), "run"),
            (lambda: net.run(samples=64), "uncertainty"),
            (lambda: lptn.fit_step("a.csv", colum="x"), "column"),
            (lambda: lptn.compare(net), "text"),
            (lambda: lptn.load(GEARBOX, G_out="4 W/K").compare(GEARBOX), "every netlist"),
            (lambda: lptn.compare(lptn.load(GEARBOX, G_out="4 W/K")), "parameters"),
        ]:
            with self.assertRaises(TypeError) as caught:
                call()
            self.assertIn(words, str(caught.exception))
        with self.assertRaises(ValueError):
            net.run(time_unit="year")
        # one name for two things
        twice = lptn.parse(BODY.replace('P = "40 W"', 'P = "40 W"\nbalance = "1 W"'))
        with self.assertRaises(TypeError):
            twice.run(balance="block")
        self.assertIn("balance", twice.run(options={"balance": "block"}).data)

    def test_doubts_are_warnings(self):
        doubtful = BODY.replace('C = "500 J/K"', 'C = "500 J/K ± 5 %"')
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = lptn.parse(doubtful).run(uncertainty=None)
        self.assertEqual([str(w.message) for w in caught], [str(d) for d in result.doubts])
        # inputs that change: the steady state is that at the start
        net = lptn.load(NETWORKS / "duty_cycle.toml")
        with warnings.catch_warnings():
            warnings.simplefilter("error", lptn.Doubt)
            with self.assertRaises(lptn.Doubt) as caught:
                net.steady()
        self.assertTrue(caught.exception.code)


class Simulations(unittest.TestCase):
    def test_a_pi_controller_has_its_closed_form(self):
        # between two samples T relaxes to 25 + P/2 with 250 s: exact steps of a first-order lag
        sim = lptn.Simulation(lptn.parse(BODY))
        expected, integral = 25.0, 0.0
        for _ in range(60):
            self.assertAlmostEqual(sim["block.T"], expected, delta=2e-4)
            error = 50.0 - sim["block.T"]
            integral += error * 10.0
            power = min(max(8.0 * error + 0.03 * integral, 0.0), 200.0)
            sim.set(P=(power, "W"))
            sim.step("10 s")
            settled = 25.0 + power / 2
            expected = settled + (expected - settled) * math.exp(-10 / 250)
        self.assertEqual(sim.time, 600.0)
        self.assertAlmostEqual(sim["block.T"], 50.0, delta=0.5)

    def test_a_state_is_kept(self):
        sim = lptn.load(GEARBOX).simulation()
        sim.advance("5 min")
        again = pickle.loads(pickle.dumps(sim))
        saved = sim.save()
        sim.step("5 min")
        again.step("5 min")
        self.assertEqual(again["steel.T"], sim["steel.T"])
        sim.restore(saved)
        self.assertEqual(sim.time, 300.0)

    def test_boundaries_have_temperatures(self):
        # 20 degC + 5 K + 0.01 K/s t; a jump at 600 s is over there
        text = WALL.replace("Ta + lift", "Ta + lift + 0.01 [K/s] * t")
        sim = lptn.parse(text).simulation()
        self.assertAlmostEqual(sim["wall.T"], 25, places=9)
        sim.step("10 min")
        self.assertAlmostEqual(sim["wall.T"], 31, places=9)
        sim.set(lift="7 K")
        self.assertAlmostEqual(sim.temperature("wall"), 33, places=9)
        jump = lptn.parse(WALL.replace("Ta + lift", "if(t < 600 [s], Ta, Ta + lift)")).simulation()
        self.assertAlmostEqual(jump["wall.T"], 20, places=9)
        jump.advance("10 min")
        self.assertAlmostEqual(jump["wall.T"], 25, places=9)

    def test_events_and_refusals(self):
        sim = lptn.parse(BODY).simulation()
        sim.set(P="200 W")
        sim.advance("30 min")
        # 25 + 100 (1 - exp(-t/250 s)) reaches 60 degC
        time_of, kind, name, before, after = sim.events[0]
        self.assertAlmostEqual(time_of, -250 * math.log(0.65), delta=1e-2)
        self.assertEqual((kind, name, before, after), ("limit", "warm", False, True))
        for wrong in [lambda: sim.set(Q="3 W"), lambda: sim.set(P="3 W/K"), lambda: sim["x.T"]]:
            with self.assertRaises(lptn.Error):
                wrong()


class Work(unittest.TestCase):
    def test_other_threads_go_on(self):
        net = lptn.load(NETWORKS / "thermostat.toml")
        done = threading.Event()
        thread = threading.Thread(target=lambda: (net.run(stop="60 d"), done.set()))
        thread.start()
        turns = 0
        while not done.is_set():
            time.sleep(0.001)
            turns += 1
        thread.join()
        self.assertGreater(turns, 5)

    def test_ctrl_c_ends_a_run(self):
        net = lptn.load(NETWORKS / "thermostat.toml")
        # a shell ignores it for jobs in the background
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
        timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        begun = time.monotonic()
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            net.run(stop="60 d", tolerance="1e-9 K")
        self.assertLess(time.monotonic() - begun, 5)

    def test_calls_are_quick(self):
        # 10^4 calls in 0.5 s on an idle machine; four times that on a busy one
        net = lptn.load(GEARBOX)
        best = math.inf
        for _ in range(5):
            begun = time.process_time()
            for k in range(1000):
                net.steady(G_out=(4 + 1e-4 * k, "W/K"))
            best = min(best, time.process_time() - begun)
        print(f"\n10^4 calls of steady: {10 * best:.2f} s", file=sys.stderr)
        self.assertLess(10 * best, 2.0)

    def test_import_is_quick(self):
        # NumPy is imported with the first column
        code = "import sys, lptn; assert 'numpy' not in sys.modules, 'NumPy is imported'"
        subprocess.run([sys.executable, "-c", code], check=True)

    def test_the_stub_is_that_of_the_declarations(self):
        folder = pathlib.Path(lptn.__file__).parent
        self.assertEqual((folder / "_questions.pyi").read_text(encoding="utf-8"), stub.stub())
        self.assertTrue((folder / "py.typed").exists())


if __name__ == "__main__":
    unittest.main()
