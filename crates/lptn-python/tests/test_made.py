"""Networks made in code, and the tables of a text."""

import pathlib
import pickle
import sys
import unittest
import warnings

import lptn
from test_same import ALL


def block():
    """One body: C = 500 J/K, 2 W/K to 25 degC, heated by P."""
    net = lptn.Network("A block in air")
    net.parameter("P", "40 W")
    net.parameter("G", (2, "W/K"))
    body = net.node("block", C="500 J/K", T0="25 degC")
    air = net.boundary("air", T="25 degC")
    net.path("resistor", "cooling", body, air, G="G")
    net.source("heat", body, P="P")
    net.limit("warm", "block.T", below="60 degC")
    net.settings("30 min", every="1 min")
    return net


class Made(unittest.TestCase):
    def test_a_network_made_in_code_has_its_closed_form(self):
        net = block()
        # T = 25 degC + P / G
        self.assertAlmostEqual(float(net.steady()["block.T"]), 45.0, places=9)
        self.assertAlmostEqual(float(net.steady(P="60 W")["block.T"]), 55.0, places=9)
        self.assertTrue(net.run().limits["warm"]["kept"])
        self.assertEqual(net.parameters, {"P": "40.0 W", "G": "2.0 W/K"})
        # what is added later counts: another 2 W/K
        net.path("convection", "fan", "block", "air", R="0.5 K/W")
        self.assertAlmostEqual(float(net.steady()["block.T"]), 35.0, places=9)
        again = pickle.loads(pickle.dumps(net))
        self.assertEqual(again.steady().json(), net.steady().json())
        self.assertIsNone(net.file)

    def test_states_and_other_sections(self):
        net = block()
        # dE/dt = P: 40 W for 30 min
        net.state("energy", rate="P", start="0 J", size="1 kJ")
        net.add("value", "rise", "block.T - air.T")
        self.assertAlmostEqual(net.run()["energy"][-1], 40 * 1800, delta=1)

    def test_the_text_is_a_netlist(self):
        net = block()
        text = net.to_toml()
        self.assertEqual(lptn.parse(text, "network.toml").steady().json(), net.steady().json())
        again = lptn.Network.from_toml(text, "network.toml")
        self.assertEqual(again.to_toml(), text)

    def test_errors_name_what_was_made(self):
        net = block()
        net.path("resistor", "wrong", "blok", "air", G="2 W")
        line = sys._getframe().f_lineno - 1
        with self.assertRaises(lptn.Error) as caught:
            net.steady()
        codes = {problem.code for problem in caught.exception.errors}
        self.assertEqual(codes, {"netlist::unknown_node", "units::dimension"})
        for problem in caught.exception.errors:
            made = problem.made
            self.assertEqual((made.section, made.name), ("resistor", "wrong"))
            self.assertEqual((pathlib.Path(made.file).name, made.line), ("test_made.py", line))
        self.assertIn(f"resistor wrong, made at test_made.py:{line}", str(caught.exception))

    def test_errors_of_questions_name_what_was_made(self):
        net = block()
        net.node("alone", C="1 J/K", T0="25 degC")
        net.source("more", "alone", P="1 W")
        with self.assertRaises(lptn.Error) as caught:
            net.steady()
        self.assertIn("node alone, made at test_made.py", str(caught.exception))

    def test_refusals(self):
        net = block()
        with self.assertRaises(ValueError) as caught:
            net.node("block", C="1 J/K")
        self.assertIn("made at test_made.py", str(caught.exception))
        self.assertRaises(TypeError, net.add, "node", "x", "1 W", C="1 J/K")
        self.assertRaises(TypeError, lptn.parse(net.to_toml()).node, "x", C="1 J/K")
        net.add("table", "curve", points=[[1, object()]])
        with self.assertRaises(TypeError):
            net.to_toml()

    def test_values_become_toml(self):
        from lptn._made import toml

        steel = lptn.parse(block().to_toml()).steady()["block.T"]
        for value, text in [
            (True, "true"),
            (3, "3"),
            (0.1, "0.1"),
            (float("inf"), "inf"),
            ('a "b"\n', '"a \\"b\\"\\n"'),
            ((4.5, "W/K"), '"4.5 W/K"'),
            (steel, f'"{float(steel)!r} degC"'),
            ([1, "x"], '[1, "x"]'),
            ({"a b": {}}, '{ "a b" = {} }'),
        ]:
            self.assertEqual(toml(value), text)

    @unittest.skipIf(sys.version_info < (3, 11), "tables of a text need Python 3.11")
    def test_all_shipped_networks_survive_the_round_trip(self):
        """Text, tables, text: the same results. Both come from lptn: two ways to one number."""
        warnings.simplefilter("ignore", lptn.Doubt)
        there = 0
        for file in ALL:
            with self.subTest(network=file.name):
                text = file.read_text(encoding="utf-8")
                whole = lptn.parse(text, str(file))
                made = lptn.Network.from_toml(text, str(file))
                again = lptn.Network.from_toml(made.to_toml(), str(file))
                self.assertEqual(again.to_toml(), made.to_toml())
                try:
                    expected = whole.run() if "[run]" in text else whole.steady()
                except lptn.Error as error:
                    with self.assertRaises(lptn.Error) as caught:
                        again.run() if "[run]" in text else again.steady()
                    self.assertEqual(caught.exception.code, error.code)
                    continue
                found = again.run() if "[run]" in text else again.steady()
                self.assertEqual(found.csv(), expected.csv())
                there += 1
        self.assertGreaterEqual(there, 30)


if __name__ == "__main__":
    unittest.main()
