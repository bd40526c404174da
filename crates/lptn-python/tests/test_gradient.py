"""Gradients against closed forms, and with optimisers."""

import cmath
import importlib.util
import math
import unittest
from datetime import timedelta

import numpy as np

import lptn
from test_lptn import GEARBOX
from test_made import block

STOP = 1800.0


def closed(power, conductance):
    """Last and mean temperature, margin and mean heat of the block over its run."""
    decay = np.exp(-conductance * STOP / 500)
    last = 25 + power / conductance * (1 - decay)
    rise = power / conductance * (1 - 500 / conductance / STOP * (1 - decay))
    return np.array([last, 25 + rise, 60 - last, conductance * rise])


def heated(power, conductance):
    """Last temperature of the block in degC, and the switches of a heater between 34 and 35 degC."""
    tau, time, rise, on, switches = 500 / conductance, 0, 0, True, 0
    while True:
        target, threshold = (power / conductance, 10) if on else (0, 9)
        lasts = tau * cmath.log((rise - target) / (threshold - target))
        if (time + lasts).real >= 1000:
            return 25 + target + (rise - target) * cmath.exp(-(1000 - time) / tau), switches
        time, rise, on, switches = time + lasts, threshold, not on, switches + 1


RESULTS = ["last(block.T)", "mean(block.T)", "margin(warm)", "mean(cooling.Q)"]


def installed(package):
    return importlib.util.find_spec(package) is not None


class Gradients(unittest.TestCase):
    def test_a_run_has_its_closed_form(self):
        function = block().value_and_grad(
            RESULTS, by=["P", "G"], over="run", tolerance="1e-9 K"
        )
        x = np.array([40.0, 2.0])
        np.testing.assert_array_equal(function.x0, x)
        values, gradient = function(x)
        np.testing.assert_allclose(values, closed(*x), rtol=1e-9)
        for k, h in enumerate([1e-3, 1e-4]):
            # fourth order: exact to 1e-11 or so
            side = lambda n: closed(*(x + n * h * np.eye(2)[k]))
            slope = (8 * (side(1) - side(-1)) - (side(2) - side(-2))) / (12 * h)
            np.testing.assert_allclose(gradient[:, k], slope, rtol=1e-8)
        self.assertEqual(function.units, ["degC", "degC", "K", "W"])
        self.assertEqual(function.x_units, ["W", "W/K"])

    def test_a_steady_state_in_other_units(self):
        net = lptn.Network.from_toml(block().to_toml().replace('"40 W"', '"0.04 kW"'))
        # T = 25 degC + P / G
        value, gradient = net.value_and_grad("block.T", by="P")(0.05)
        self.assertAlmostEqual(value, 50.0, places=9)
        self.assertAlmostEqual(gradient[0], 500.0, places=7)

    def test_a_margin_alone(self):
        # 60 degC - T
        value, gradient = block().value_and_grad("margin(warm)", by=["P", "G"], over="steady")([40, 2])
        self.assertAlmostEqual(value, 15, places=9)
        np.testing.assert_allclose(gradient, [-0.5, 10], rtol=1e-8)
        margin = block().value_and_grad("margin(warm)", by=["P", "G"], over="run", tolerance="1e-9 K")
        self.assertAlmostEqual(margin.value([40, 2]), closed(40, 2)[2], places=7)
        self.assertEqual(margin.units, ["K"])

    def test_many_times_of_one_run(self):
        decay = lambda t: np.exp(-2.0 * t / 500)
        times = np.array([600.0, 0.0, 60.0, 60.0, 1800.0])
        tolerance = "1e-9 K"
        model = block().value_and_grad("block.T", by=["P", "G"], times=times, tolerance=tolerance)
        value, gradient = model([40, 2])
        np.testing.assert_allclose(value, 25 + 20 * (1 - decay(times)), rtol=1e-9)
        by_g = -10 * (1 - decay(times)) + 20 * decay(times) * times / 500
        expected = np.stack([(1 - decay(times)) / 2, by_g], axis=1)
        np.testing.assert_allclose(gradient, expected, rtol=1e-7, atol=1e-8)
        both = {"T": "block.T", "Q": "cooling.Q"}
        model = block().value_and_grad(both, by="P", times=([1, 30], "min"), tolerance=tolerance)
        value, gradient = model(40)
        self.assertEqual((value.shape, gradient.shape), ((2, 2), (2, 2, 1)))
        np.testing.assert_allclose(value[1], 40 * (1 - decay(np.array([60, 1800]))), rtol=1e-9)
        np.testing.assert_allclose(gradient[1, :, 0], value[1] / 40, rtol=1e-7)
        run = block().run(every="10 min", tolerance=tolerance)
        model = block().value_and_grad("block.T", by="P", times=run["time"], tolerance=tolerance)
        np.testing.assert_allclose(model.value(40), run["block.T"], rtol=1e-9)

    def test_times_are_those_of_a_run(self):
        net = block()
        for wrong in [{"stop": "1 h"}, {"over": "steady"}]:
            self.assertRaises(TypeError, net.value_and_grad, "block.T", by="P", times=[1.0], **wrong)
        for wrong in ["max(block.T)", "margin(warm)"]:
            self.assertRaises(TypeError, net.value_and_grad, wrong, by="P", times=[1.0])
        for wrong in [[math.nan], [], ([1.0], "K")]:
            self.assertRaises(ValueError, net.value_and_grad, "block.T", by="P", times=wrong)
        with self.assertRaises(lptn.Error) as caught:
            net.value_and_grad("block.T", by="P", times=[-5.0, 10.0])(40.0)
        self.assertEqual(caught.exception.code, "gradient::outside")

    def test_functionals_of_results_with_commas(self):
        net = block()
        for of in ["mean(max(block.T, 20 [degC]))", "last(if(t > 5 [s], 1, 2) * cooling.Q)"]:
            self.assertEqual(net.value_and_grad(of, by="P").over, "run")
        self.assertEqual(net.value_and_grad("max(block.T, 20 [degC])", by="P").over, "steady")
        with self.assertRaises(lptn.Error) as caught:
            net.value_and_grad("time_over(block.T, 30 [degC])", by="P")(40.0)
        self.assertEqual(caught.exception.code, "gradient::functional")

    def test_stop_is_that_of_a_run(self):
        for stop in ["600 s", (10, "min"), timedelta(minutes=10)]:
            function = block().value_and_grad("last(block.T)", by="P", stop=stop)
            self.assertAlmostEqual(function.value(40), 25 + 20 * (1 - np.exp(-2.4)), places=3)
        self.assertRaises(ValueError, function, math.nan)

    def test_a_thousand_parameters_cost_few_solutions(self):
        # a chain of 1 K/W each, 1 W at its end: dT_end/dR_k = 1 W
        count = 1000
        net = lptn.Network()
        before = net.boundary("wall", T="0 degC")
        for k in range(count):
            net.parameter(f"R{k}", "1 K/W")
            node = net.node(f"n{k}", massless=True)
            net.path("resistor", f"r{k}", before, node, R=f"R{k}")
            before = node
        net.source("heat", before, P="1 W")
        function = net.value_and_grad(f"{before}.T", by=[f"R{k}" for k in range(count)])
        value, gradient = function(function.x0)
        self.assertAlmostEqual(value, count, places=6)
        np.testing.assert_allclose(gradient, np.ones(count), rtol=1e-8)

    def test_refusals(self):
        net = block()
        self.assertRaises(TypeError, net.value_and_grad, "margin(warm)", by="P")
        with self.assertRaises(ValueError):
            net.value_and_grad("margin(cold)", by="P", over="run")
        function = net.value_and_grad("block.T", by=["P", "G"])
        self.assertRaises(ValueError, function, [1.0])
        with self.assertRaises(lptn.Error):
            function([40.0, -1.0])
        with self.assertRaises(lptn.Error) as caught:
            net.value_and_grad("peak(block.T)", by="P")
        self.assertIn("`peak(block.T)`: unknown function `peak`", str(caught.exception))
        for wrong in ["time_over(block.T, 30 [degC])", "max(blok.T)"]:
            with self.assertRaises(lptn.Error):
                net.value_and_grad(wrong, by="P", over="run")(40.0)

    @unittest.skipUnless(installed("scipy"), "SciPy is not installed")
    def test_scipy_works_with_it(self):
        from scipy.optimize import least_squares, minimize, root_scalar

        # 25.5 degC + P / G_out + 1.7 K, networks/gearbox.toml
        hot = lptn.load(GEARBOX).value_and_grad("steel.T", by="G_out")
        found = root_scalar(
            lambda g: (hot.value(g) - 80, hot.jac(g)[0]), x0=4, fprime=True, method="newton"
        )
        self.assertAlmostEqual(found.root, 220.6 / (80 - 27.2), places=8)
        # two readings of the block give back the values that made them
        function = block().value_and_grad(
            ["last(block.T)", "mean(block.T)"], by=["P", "G"], tolerance="1e-9 K"
        )
        wanted = closed(55.0, 1.4)[:2]
        fit = least_squares(lambda x: function.value(x) - wanted, [40, 2], jac=function.jac)
        np.testing.assert_allclose(fit.x, [55, 1.4], rtol=1e-6)
        # the cost P^2 + penalty has its minimum where the constraint is met
        warm = block().value_and_grad("block.T", by=["P"])
        square = lambda x: ((warm.value(x) - 50) ** 2, 2 * (warm.value(x) - 50) * warm.jac(x))
        self.assertAlmostEqual(minimize(square, [40.0], jac=True).x[0], 50.0, places=4)

    @unittest.skipUnless(installed("jax"), "JAX is not installed")
    def test_jax_works_with_it(self):
        import jax

        jax.config.update("jax_enable_x64", True)
        # T = 25 + P / G
        hot = block().value_and_grad("block.T", by=["P", "G"]).jax()
        slope = jax.grad(lambda x: hot(x * 2.0) ** 2)(np.array([20.0, 1.0]))
        np.testing.assert_allclose(slope, [2 * 45 * 2 / 2, -2 * 45 * 2 * 40 / 4], rtol=1e-8)
        both = block().value_and_grad(["block.T", "cooling.Q"], by=["P", "G"]).jax()
        rows = jax.jacrev(both)(np.array([40.0, 2.0]))
        np.testing.assert_allclose(rows, [[0.5, -10], [1, 0]], atol=1e-8)

    def test_a_run_through_30_switches_has_its_closed_form(self):
        net = lptn.Network()
        net.parameter("P", "40 W")
        net.parameter("G", "2 W/K")
        net.boundary("air", T="25 degC")
        net.node("block", C="500 J/K", T0="25 degC")
        net.path("resistor", "cooling", "block", "air", G="G")
        net.add("control", "heater", sense="block", on_below="34 degC", off_above="35 degC",
                start="on")
        net.source("heat", "block", P="P * heater")
        # the network has no [run]
        function = net.value_and_grad(
            "last(block.T)", by=["P", "G"], stop="1000 s", tolerance="1e-10 K"
        )
        x = [40.0, 2.0]
        value, gradient = function(x)
        # an imaginary step gives the derivative without a difference
        step = 1e-30
        self.assertAlmostEqual(value, heated(*x)[0].real, places=7)
        slopes = [heated(x[0] + step * 1j, x[1])[0].imag, heated(x[0], x[1] + step * 1j)[0].imag]
        np.testing.assert_allclose(gradient, np.array(slopes) / step, rtol=1e-7)
        self.assertGreater(heated(*x)[1], 30)

    def test_a_pipe_is_refused(self):
        net = block()
        net.boundary("inlet", T="20 degC")
        net.add("pipe", "supply", **{"from": "inlet", "to": "block"}, mcp="1 W/K", C="9 J/K", T0="20 degC")
        net.path("advection", "out", "block", "air", mcp="1 W/K")
        function = net.value_and_grad("last(block.T)", by="P")
        with self.assertRaises(lptn.Error) as caught:
            function(100.0)
        self.assertEqual(caught.exception.code, "gradient::differences")
        self.assertTrue(math.isfinite(function.x0[0]))


if __name__ == "__main__":
    unittest.main()
