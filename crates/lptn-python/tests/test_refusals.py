"""Messages say the reason in the words of Python."""

import unittest

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


if __name__ == "__main__":
    unittest.main()
