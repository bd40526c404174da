"""The package gives the bytes of the command line.

Both come from lptn: these tests compare two ways to one number, they do not say that it is right.
"""

import json
import pathlib
import re
import subprocess
import sysconfig
import tempfile
import unittest
import warnings

import numpy as np

import lptn
from lptn import _lptn

NETWORKS = pathlib.Path(__file__).resolve().parents[3] / "networks"
PROGRAM = pathlib.Path(sysconfig.get_path("scripts")) / "lptn"
ALL = sorted(NETWORKS.glob("*.toml")) + [NETWORKS / "lap" / "lap.toml"]


def program(*words):
    """What the program prints, and its exit code."""
    files = [] if words[0] == "check" else ["--no-files"]
    words = [PROGRAM, *words, *files, "--format", "json"]
    done = subprocess.run(words, capture_output=True, cwd=NETWORKS.parent, check=False)
    return done.stdout.decode(), done.returncode


def package(ask):
    """The same by the package: JSON, or the codes of the errors; and the exit code."""
    try:
        result = ask()
        return result.json(), 0 if result.ok else 1
    except lptn.Error as error:
        text = error.result.json() if error.result else None
        return text or [problem.code for problem in error.errors], error.exit


class Same(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("ignore", lptn.Doubt)

    def same(self, words, ask):
        """Asserts that both say the same; true if there is a result."""
        text, code = program(*words)
        found, exit = package(ask)
        self.assertEqual(exit, code, f"{words}: {text}")
        if isinstance(found, list):
            text = [problem["code"] for problem in json.loads(text)["errors"]]
        self.assertEqual(found, text, words)
        return code <= 1

    def each(self, words, ask, least):
        """The same for all networks; `least` of them have a result."""
        there = 0
        for file in ALL:
            with self.subTest(network=file.name):
                net = lptn.load(file)
                there += self.same([*words(file)], lambda net=net: ask(net))
        self.assertGreaterEqual(there, least)

    def test_check(self):
        self.each(lambda file: ["check", file], lambda net: net.check(), 38)
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "wrong.toml"
            file.write_text((NETWORKS / "gearbox.toml").read_text().replace("steel =", "stel ="))
            self.assertTrue(self.same(["check", file], lambda: lptn.check(file)))
            self.assertFalse(lptn.check(file).ok)

    def test_a_flat_netlist_reads_back(self):
        """The same numbers in both directions, or an error with a code."""
        there, refused = 0, set()
        for file in [*ALL, *sorted((NETWORKS.parent / "docs" / "netlists").glob("*.toml"))]:
            with self.subTest(network=file.name):
                try:
                    net = lptn.load(file)
                    text = net.to_toml()
                except lptn.Error as error:
                    self.assertTrue(error.code)
                    refused.add(file.name)
                    continue
                try:
                    expected = net.steady()
                except lptn.Error as error:
                    with self.assertRaises(lptn.Error) as caught:
                        lptn.parse(text, str(file)).steady()
                    self.assertEqual(caught.exception.code, error.code)
                    continue
                found = lptn.parse(text, str(file)).steady()
                self.assertEqual(set(found), set(expected))
                for name in expected.table.units:
                    np.testing.assert_allclose(found[name], expected[name], 1e-9, 1e-9)
                there += 1
        self.assertGreaterEqual(there, 50)
        self.assertLessEqual({"sunlit_wall.toml", "board.toml", "wall.toml"}, refused)

    def test_a_grid_has_no_flat_form(self):
        with self.assertRaises(lptn.Error) as caught:
            lptn.load(NETWORKS / "sunlit_wall.toml").to_toml()
        self.assertEqual(caught.exception.code, "netlist::not_flat")

    def test_run(self):
        self.each(lambda file: ["run", file], lambda net: net.run(), 30)

    def test_steady(self):
        self.each(lambda file: ["steady", file], lambda net: net.steady(), 25)

    def test_periodic(self):
        self.each(
            lambda file: ["steady", file, "--periodic"], lambda net: net.steady(periodic=True), 3
        )

    def test_modes(self):
        self.each(lambda file: ["modes", file], lambda net: net.modes(), 20)

    def test_uncertainty(self):
        self.each(
            lambda file: ["run", file, "--uncertainty", "linear"],
            lambda net: net.run(uncertainty="linear"),
            1,
        )

    def test_studies(self):
        """Where a network has no such study, both refuse with the same code."""
        for verb, method in [("size", "size"), ("fit network", "fit")]:
            with self.subTest(verb=verb):
                self.each(
                    lambda file, verb=verb: [*verb.split(), file],
                    lambda net, method=method: getattr(net, method)(),
                    1,
                )

    def test_sweep(self):
        """Rows are the same too, and become columns."""
        study = '[sweep.out]\nmethod = "grid"\nover = "steady"\n'
        study += 'axes.G_out = { from = "3 W/K", to = "6 W/K", points = 7 }\n'
        study += 'report.hot = "steel.T"\n'
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "swept.toml"
            file.write_text((NETWORKS / "gearbox.toml").read_text() + study)
            net = lptn.load(file)
            self.assertTrue(self.same(["sweep", file], lambda: net.sweep("out")))
            swept = net.sweep(threads=1)
        # 25.5 degC + P / G_out + 1.7 K, networks/gearbox.toml
        expected = 27.2 + 220.6 / swept["G_out"]
        np.testing.assert_allclose(swept["hot"], expected, rtol=1e-9)

    def test_rank_and_reduce(self):
        self.each(lambda file: ["rank", file], lambda net: net.rank(), 10)
        file = NETWORKS / "gearbox.toml"
        net = lptn.load(file)
        words = ["reduce", file, "--port", "steel"]
        self.same(words, lambda: net.reduce("steel"))
        self.same([*words, "--for", "run"], lambda: net.reduce(port="steel", for_="run"))
        keep = ["reduce", file, "--keep", "steel,aluminium"]
        self.same(keep, lambda: net.reduce(keep=["steel", "aluminium"]))
        ladder = ["impedance", file, "--port", "steel", "--cauer", "2"]
        self.same(ladder, lambda: net.impedance("steel", cauer=2))
        self.same(["verify", file], lambda: net.verify())

    def test_compare(self):
        files = sorted((NETWORKS / "candidates").glob("*.toml"))
        self.same(["compare", *files], lambda: lptn.compare(*files))
        self.same(
            ["compare", *files, "--sort", "peak"],
            lambda: lptn.load(files[0]).compare(*files[1:], sort="peak"),
        )
        fan = NETWORKS / "gearbox_fan.toml"
        self.same(
            ["compare", fan, "--set", "G_fan=1 W/K,2 W/K"],
            lambda: lptn.compare(fan, G_fan=["1 W/K", "2 W/K"]),
        )

    def test_without_a_network(self):
        words = ["--power", "500 W", "--limit", "80 degC", "--ambient", "25 degC"]
        self.same(
            ["size", *words], lambda: lptn.size(power="500 W", limit="80 degC", ambient="25 degC")
        )
        record = NETWORKS / "records" / "coffee.csv"
        self.same(["fit", "step", record], lambda: lptn.fit_step(record))

    def test_options(self):
        """Options and parameters do the same."""
        file = NETWORKS / "gearbox.toml"
        net = lptn.load(file, T_amb="30 degC")
        words = ["run", file, "--set", "T_amb=30 degC", "--set", "G_out=4.5 W/K", "--stop", "2 h"]
        words += ["--select", "*.T", "--temperature-unit", "K", "--balance", "steel"]
        self.same(
            words,
            lambda: net.run(
                G_out=(4.5, "W/K"), stop="2 h", select="*.T", temperature_unit="K", balance="steel"
            ),
        )

    def test_every_option_has_its_name(self):
        """Options are those of the help, but for files, formats and values that are set."""
        left_out = {"set", "format", "no_files", "output", "report", "write", "quiet", "verbose"}
        left_out |= {"color", "plot", "help", "resume", "worst", "recover", "follow", "decimal"}
        left_out |= {"expand", "dates", "start", "unit", "posterior", "at", "slurm", "version", "live"}
        for name, *_, options in _lptn.questions():
            done = subprocess.run(
                [PROGRAM, *name.split(), "--help"], capture_output=True, text=True, check=True
            )
            there = {word.replace("-", "_") for word in re.findall(r"--([A-Za-z_-]+)", done.stdout)}
            ours = {option for option, _, _ in options}
            words = re.findall(r"^  \[?<?([A-Z]+)>?\]?  ", done.stdout, re.MULTILINE)
            there |= {word.lower() for word in words}
            self.assertLessEqual(ours, there, name)
            if name not in ("size", "fit compare"):
                self.assertLessEqual(there - ours - left_out - {"file"}, set(), name)


if __name__ == "__main__":
    unittest.main()
