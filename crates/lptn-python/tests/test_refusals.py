"""Messages say the reason in the words of Python."""

import unittest

import numpy as np

import lptn
from test_lptn import BODY, GEARBOX


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

    def test_columns_of_a_frame(self):
        for column in [[3, None], [[3, 4]], 3, ["3 W"], np.ones((2, 2)), np.array(3), "3 W"]:
            self.refused(TypeError, lambda: self.net.sweep({"P": column}), "column `P`")
        self.refused(TypeError, lambda: self.net.sweep({"P": [1, 2], "G": [1]}), "P [W] 2")
        self.refused(ValueError, lambda: self.net.sweep({"P": [1]}, over="runn"), "'runn'")

    def test_kinds_of_arguments(self):
        self.refused(TypeError, lambda: self.net.run(set="x"), "`set` takes a dictionary")
        self.refused(TypeError, lambda: lptn.parse(b"format = 1"), "a text, not bytes")
        self.assertEqual(lptn.load(str(GEARBOX).encode()).nodes, lptn.load(GEARBOX).nodes)

    def test_gradients(self):
        ask = self.net.value_and_grad
        self.refused(TypeError, lambda: ask("block.T", by=[]), "`by`", "at least one")
        self.refused(TypeError, lambda: ask([], by="P"), "`of`", "at least one")
        self.refused(TypeError, lambda: ask("block.T", by=["P", "P"]), "`P` more than once")
        self.refused(ValueError, lambda: ask("block.T", by="P", over="runn"), "'runn'", "steady")
        for words in [{"stop": "1 s"}, {"tolerance": "1 K"}]:
            self.refused(TypeError, lambda: ask("block.T", by="P", **words), "those of a run")


if __name__ == "__main__":
    unittest.main()
