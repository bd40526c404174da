"""Messages say the reason in the words of Python."""

import pathlib
import sys
import tempfile
import threading
import unittest
from datetime import timedelta

import numpy as np

import lptn
from lptn._help import text as help_text
from lptn._messages import in_python
from test_lptn import BODY, GEARBOX
from test_made import block


class Sweeps(unittest.TestCase):
    def test_a_sweep_without_a_candidate_says_why(self):
        net = lptn.load(GEARBOX)
        for words in [{}, {"over": "run", "report": {"hot": "max(steel.T)"}}]:
            with self.assertRaises(lptn.Error) as caught:
                net.sweep({"G_out": [-3, -4]}, **words)
            error = caught.exception
            self.assertEqual(error.code, "network::not_positive")
            self.assertIn("2 of 2 candidates failed; candidate 1: ", str(error))
            # 0.7 of -3 W/K, networks/gearbox.toml
            self.assertIn("must be more than zero, got -2.1 W/K", str(error))
            self.assertIn("sign", error.help)
            self.assertEqual(len(error.result["failed"]), 2)


class Arguments(unittest.TestCase):
    def setUp(self):
        self.net = lptn.parse(BODY)

    def refused(self, kind, ask, *words):
        """An argument is refused, and the message has these words."""
        with self.assertRaises(kind) as caught:
            ask()
        for word in words:
            self.assertIn(word, str(caught.exception))
        return caught.exception

    def test_an_unknown_parameter_is_one_error(self):
        net = lptn.load(GEARBOX)
        for ask in [
            lambda: net.run(G_ot="4 W/K"),
            lambda: net.run(set={"G_ot": "4 W/K"}),
            lambda: net.sweep({"G_ot": [3]}),
            lambda: net.sweep({"G_ot [W/K]": [3]}),
            lambda: net.value_and_grad("steel.T", by="G_ot"),
        ]:
            error = self.refused(lptn.Error, ask, "no parameter `G_ot`", "did you mean `G_out`?")
            self.assertEqual(error.code, "netlist::unknown_parameter")

    def test_several_values_are_a_sweep(self):
        for value in [["3 W", "4 W"], [3, 4], np.array([3, 4]), (np.array([3, 4]), "W"),
                      ([3, 4], "W"), self.net.run()["heat.P"]]:
            self.refused(TypeError, lambda: self.net.run(P=value), "`P` takes one value", "sweep")
            self.refused(TypeError, lambda: self.net.run(set={"P": value}), "`P` takes one value")
        self.refused(TypeError, lambda: lptn.parse(BODY, P=["3 W", "4 W"]), "`P` takes one value")

    def test_variants_have_units(self):
        files = sorted((GEARBOX.parent / "candidates").glob("*.toml"))[:2]
        net = lptn.load(GEARBOX)
        for value, right in [([3, 4], '([3, 4], "W")'), (np.array([3.5, 4]), '([3.5, 4.0], "W")'),
                             (["3 W", 4], '["3 W", "4 W"]')]:
            for ask in [net.compare, lambda **words: lptn.compare(GEARBOX, *files, **words)]:
                self.refused(TypeError, lambda: ask(P_7000=value), f"with their unit: P_7000={right}")
        for value in [([200, 250], "W"), (np.array([200, 250]), "W"), ["200 W", "250 W"]]:
            self.assertEqual(net.compare(P_7000=value).csv(), net.compare(P_7000=["200 W", "250 W"]).csv())

    def test_options_are_named(self):
        net = lptn.load(GEARBOX)
        for words in [{"time": "x"}, {"at": "x"}, {"duty": "x"}]:
            (name,) = words
            error = self.refused(lptn.Error, lambda: net.impedance("steel", **words))
            self.assertTrue(str(error).startswith(f"`{name}`: expected a number"), str(error))

    def test_columns_of_a_frame(self):
        for column in [[3, None], [[3, 4]], 3, ["3 W"], np.ones((2, 2)), np.array(3), "3 W"]:
            self.refused(TypeError, lambda: self.net.sweep({"P": column}), "column `P`")
        self.refused(TypeError, lambda: self.net.sweep({"P": [1, 2], "G": [1]}), "P [W] 2")
        self.refused(ValueError, lambda: self.net.sweep({"P": [1]}, over="runn"), "'runn'")
        # places in the study and the file that the package wrote are of no use
        for frame, words in [({"P": [1]}, {"over": "run", "report": {"a": "block.T"}}),
                             ({"P [W/K]": [1]}, {})]:
            error = self.refused(lptn.Error, lambda: self.net.sweep(frame, **words))
            self.assertTrue(error.code and not error.places)
            self.assertFalse(str(error).startswith("netlist.toml"))
        self.refused(TypeError, lambda: self.net.sweep({"P": [True, 2.0]}), "column `P`", "True")
        self.refused(TypeError, lambda: self.net.sweep({"P": ["3 W"]}), "its heading has the unit")
        for frame in [np.ones(3), [1, 2]]:
            self.refused(TypeError, lambda: self.net.sweep(frame), "a dictionary such as")
        self.refused(TypeError, lambda: self.net.sweep({"P": [1], "P [W]": [2]}), "more than one")
        self.refused(TypeError, lambda: self.net.sweep({"P": [1], "note": ["a"]}), "take frame[['P']]")
        frame = {"P": [1.0, float("nan")]}
        self.refused(ValueError, lambda: self.net.sweep(frame), "column `P`", "nan in row 1")

    def test_plots_and_durations(self):
        self.refused(TypeError, self.net.steady().plot, "a steady state has no curves")
        self.refused(TypeError, lambda: self.net.run(stop={"a": 1}), "(10, \"min\")")
        last = self.net.run(stop=timedelta(minutes=2))["time"][-1]
        self.assertEqual(last, 120.0)
        self.refused(TypeError, lambda: lptn.load(BODY), "lptn.parse reads a text")
        self.assertIn("margin", help_text("value_and_grad"))

    def test_kinds_of_arguments(self):
        self.refused(TypeError, lambda: self.net.run(set="x"), "`set` takes a dictionary")
        self.refused(TypeError, lambda: self.net.run(options="x"), "`options` takes a dict")
        self.refused(TypeError, lambda: lptn.parse(b"format = 1"), "a text, not bytes")
        self.assertEqual(lptn.load(str(GEARBOX).encode()).nodes, lptn.load(GEARBOX).nodes)

    def test_a_folder_is_not_a_netlist(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "Cargo.toml").write_text("[package]\n", encoding="utf-8")
            error = self.refused(lptn.Error, lambda: lptn.load(folder), "directory")
            self.assertIsNone(error.help)
            pathlib.Path(folder, "body.toml").write_text(BODY, encoding="utf-8")
            self.refused(lptn.Error, lambda: lptn.load(folder), "body.toml")

    def test_gradients(self):
        ask = self.net.value_and_grad
        self.refused(TypeError, lambda: ask("block.T", by=[]), "`by`", "at least one")
        self.refused(TypeError, lambda: ask([], by="P"), "`of`", "at least one")
        self.refused(TypeError, lambda: ask("block.T", by=["P", "P"]), "`P` more than once")
        self.refused(ValueError, lambda: ask("block.T", by="P", over="runn"), "'runn'", "steady")
        for words in [{"stop": "1 s"}, {"tolerance": "1 K"}]:
            self.refused(TypeError, lambda: ask("block.T", by="P", **words), "those of a run")

    def test_messages_have_the_words_of_python(self):
        for text, expected in [
            ('write `--set "T_amb=absolute(300 [K])"`, or so', 'write `T_amb="absolute(300 [K])"`, or so'),
            ("`--stop` must be a time", "`stop` must be a time"),
            ('write `--temperature-unit "K"`', 'write `temperature_unit="K"`'),
            ("write for example --keep steel,housing", 'write for example keep="steel,housing"'),
            ("more --samples, smaller ones", "more `samples`, smaller ones"),
            ("`lptn impedance a.toml --port steel`", '`net.impedance(port="steel")`'),
            ("let `lptn steady --periodic` find it", "let `net.steady(periodic=True)` find it"),
            ('`lptn run --set "P=3 W"`', '`net.run(P="3 W")`'),
            ("`lptn fit step a.csv --from '30 s'`", '`lptn.fit_step("a.csv", from_="30 s")`'),
            ("`lptn graph a.toml`", "`lptn graph a.toml`"),
            ("`lptn run a.toml --report`", "`lptn run a.toml --report`"),
            ("--at 1 h is outside", 'at="1 h" is outside'),
            ("write --duty 0.5,0.2,0.1", 'write duty="0.5,0.2,0.1"'),
            ("name it: --to NODE", 'name it: to="NODE"'),
            ("without `--foster 4`, or --foster 4", "without `foster=4`, or foster=4"),
            ("give a unit (a command: `--unit t=s`)", "give a unit"),
            ("run without --certify, or --slice z=1", "run without `certify`, or --slice z=1"),
        ]:
            self.assertEqual(in_python(text), expected)
        error = self.refused(lptn.Error, lambda: self.net.run(stop="2"), "`stop` must be a time")
        self.assertNotIn("--", str(error))

    def test_networks_in_code(self):
        net = block()
        self.refused(TypeError, lambda: net.node(3, C="1 J/K"), "names are texts, not int")
        net.path("resistr", "wrong", "block", "air", R="1 K/W")
        line = sys._getframe().f_lineno - 1
        self.refused(lptn.Error, net.steady, f"made at test_refusals.py:{line}", "`[resistor]`")

    def test_simulations(self):
        sim = self.net.simulation()
        self.refused(KeyError, lambda: sim["cooling.x"], "the columns are block.T")
        for call, words in [
            (lambda: sim.step("10 m"), "`length` must be a time"),
            (lambda: sim.advance("x"), "`to`: expected a number"),
            (lambda: sim.set(P=3), "`P` must be a power"),
        ]:
            error = self.refused(lptn.Error, call, words)
            self.assertTrue(str(error).startswith("`") and not error.places)
        self.refused(lptn.Error, lambda: sim.release("Q"), "`Q`")
        sim.advance("0 s")
        sim.step("0 s")
        self.refused(ValueError, lambda: sim.step("-1 s"), "cannot go back")
        for wrong in ["x", '{"a": 1}', 3, None]:
            self.refused(ValueError, lambda: sim.restore(wrong), "that `save` of a simulation gave")
        failed = []

        def steps():
            try:
                for _ in range(50):
                    sim.step("1 s")
                    sim["block.T"]
            except BaseException as error:
                failed.append(error)

        threads = [threading.Thread(target=steps) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual((failed, sim.time), ([], 200.0))
        # T = 25 + 20 (1 - exp(-t/250 s))
        self.assertAlmostEqual(sim["block.T"], 25 + 20 * (1 - np.exp(-0.8)), delta=2e-2)


if __name__ == "__main__":
    unittest.main()
