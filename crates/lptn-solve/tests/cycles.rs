//! Random gearboxes over drive cycles of many points, against classical Runge-Kutta steps with the
//! formulas of this test.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use crate::elements_helper::Random;

use lptn_assembly::ThermalSystem;
use lptn_network::{IntegratorChoice, Time};
use lptn_solve::{Method, Solution, Transient};

const ZERO: f64 = 273.15;
const SIGMA: f64 = 5.670_374_419e-8;

/// Steps of the oracle between two points of the cycle.
const FINE: u32 = 80;

/// Gears, oil and housing in a row; a film that the wind blows at and radiation to air at 20 degC.
struct Gearbox {
    /// In J/K.
    capacity: [f64; 3],
    /// In W/K.
    conductance: [f64; 2],
    /// `h0 + kv v^0.8` in W/K, and the emitting area times the emissivity in m2.
    film: [f64; 2],
    glows: f64,
    /// Losses by `mu speed torque` in the gears, by `k speed^(5/3) (1 - a (T - 20 degC))` in the oil.
    losses: [f64; 3],
    /// Distance of points in s, and speed in rad/s, torque in N m and wind in m/s at each.
    every: f64,
    points: Vec<[f64; 3]>,
}

impl Gearbox {
    fn new(random: &mut Random) -> Self {
        let points = 40 + random.below(120);
        let mut point = || {
            let stands = random.below(5) == 0;
            let speed = if stands { 0.0 } else { random.between(50.0, 600.0) };
            [speed, random.between(0.0, 80.0), random.between(0.0, 30.0)]
        };
        let points = (0..points).map(|_| point()).collect();
        Self {
            capacity: [
                10.0_f64.powf(random.between(1.0, 3.5)),
                10.0_f64.powf(random.between(1.0, 3.5)),
                10.0_f64.powf(random.between(2.0, 4.0)),
            ],
            conductance: [random.between(5.0, 60.0), random.between(5.0, 60.0)],
            film: [random.between(0.5, 3.0), random.between(0.0, 3.0)],
            glows: [0.0, random.between(0.1, 0.4)][random.below(2)],
            losses: [0.01, random.between(0.001, 0.01), [0.0, 0.004][random.below(2)]],
            every: random.between(0.5, 5.0),
            points,
        }
    }

    fn text(&self) -> String {
        let list = |of: &dyn Fn(usize) -> f64| {
            let values: Vec<String> =
                (0..self.points.len()).map(|k| format!("{:?}", of(k))).collect();
            values.join(", ")
        };
        let signal = |name: &str, column: usize, unit: &str| {
            let (t, v) = (list(&|k| k as f64 * self.every), list(&|k| self.points[k][column]));
            format!("{name} = {{ t = [{t}], v = [{v}], t_unit = \"s\", v_unit = \"{unit}\" }}\n")
        };
        let [gears, oil, housing] = self.capacity;
        let ([inner, outer], [h0, kv], [mu, k, a]) = (self.conductance, self.film, self.losses);
        let radiation = match self.glows > 0.0 {
            true => format!(
                "[radiation]\nglow = {{ from = \"housing\", to = \"air\", emissivity = 1, area = \
                 \"{:?} m^2\" }}\n",
                self.glows
            ),
            false => String::new(),
        };
        format!(
            "format = 1\n[default]\nT0 = \"20 degC\"\n[signal]\n{}{}{}[node]\ngears = {{ C = \"{gears:?} \
             J/K\" }}\noil = {{ C = \"{oil:?} J/K\" }}\nhousing = {{ C = \"{housing:?} J/K\" \
             }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n[resistor]\ng_o = {{ from = \"gears\", to = \
             \"oil\", G = \"{inner:?} W/K\" }}\no_h = {{ from = \"oil\", to = \"housing\", G = \
             \"{outer:?} W/K\" }}\n[convection]\nskin = {{ from = \"housing\", to = \"air\", h = \"{h0:?} \
             [W/(m^2 K)] + {kv:?} [W/(m^2 K)] * (v / 1 [m/s])^0.8\", area = \"1 m^2\" \
             }}\n{radiation}[source]\nmesh = {{ into = \"gears\", P = \"{mu:?} * speed * torque\" \
             }}\nchurn = {{ into = \"oil\", P = \"{k:?} [W] * (speed / 1 [rad/s])^(5/3) * (1 - {a:?} \
             [1/K] * (oil.T - 20 [degC]))\" }}\n",
            signal("speed", 0, "rad/s"),
            signal("torque", 1, "N m"),
            signal("v", 2, "m/s"),
        )
    }

    fn stop(&self) -> f64 {
        (self.points.len() - 1) as f64 * self.every
    }

    /// K/s at a share of the way from one point to the next.
    fn rates(&self, point: usize, share: f64, t: [f64; 3]) -> [f64; 3] {
        let (a, b) = (self.points[point], self.points[point + 1]);
        let [speed, torque, wind] = [0, 1, 2].map(|k| a[k] + share * (b[k] - a[k]));
        let [inner, outer] = [0, 1].map(|k| self.conductance[k] * (t[k] - t[k + 1]));
        let air = 20.0 + ZERO;
        let film = (self.film[0] + self.film[1] * wind.powf(0.8)) * (t[2] - air);
        let glow = SIGMA * self.glows * (t[2].powi(4) - air.powi(4));
        let [mu, k, a] = self.losses;
        let churn = k * speed.powf(5.0 / 3.0) * (1.0 - a * (t[1] - air));
        let heat = [mu * speed * torque - inner, churn + inner - outer, outer - film - glow];
        [0, 1, 2].map(|k| heat[k] / self.capacity[k])
    }

    /// Temperatures in K at every point.
    fn right(&self) -> Vec<[f64; 3]> {
        let mut t = [20.0 + ZERO; 3];
        let mut all = vec![t];
        for point in 0..self.points.len() - 1 {
            for fine in 0..FINE {
                t = self.fine_step(point, fine, t);
            }
            all.push(t);
        }
        all
    }

    fn fine_step(&self, point: usize, fine: u32, t: [f64; 3]) -> [f64; 3] {
        let h = self.every / f64::from(FINE);
        let share = |part: f64| (f64::from(fine) + part) / f64::from(FINE);
        let moved = |k: [f64; 3], by: f64| [0, 1, 2].map(|i| t[i] + by * k[i]);
        let k1 = self.rates(point, share(0.0), t);
        let k2 = self.rates(point, share(0.5), moved(k1, h / 2.0));
        let k3 = self.rates(point, share(0.5), moved(k2, h / 2.0));
        let k4 = self.rates(point, share(1.0), moved(k3, h));
        [0, 1, 2].map(|i| t[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    }

    fn run(&self, tolerance: f64, integrator: IntegratorChoice) -> Solution {
        let text = self.text();
        let netlist =
            lptn_netlist::parse("net.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        let system = ThermalSystem::assemble(&netlist.network).unwrap();
        let times: Vec<f64> = (0..self.points.len()).map(|k| k as f64 * self.every).collect();
        let run = Transient::until(Time(self.stop())).at(&times).tolerance(tolerance);
        let solution = Transient { integrator, ..run }.solve(&system).unwrap();
        assert!(solution.ledger().relative_residual().unwrap().abs() < 1e-8);
        solution
    }
}

/// The largest error in K.
fn error_of(solution: &Solution, right: &[[f64; 3]]) -> f64 {
    let rows = (0..right.len()).flat_map(|row| solution.row(row).iter().zip(right[row]));
    rows.map(|(found, right)| (found - right).abs()).fold(0.0, f64::max)
}

#[test]
fn drive_cycles_are_right_to_ten_tolerances() {
    let (mut random, mut worst) = (Random(7), 0.0_f64);
    for case in 0..40 {
        let gearbox = Gearbox::new(&mut random);
        let right = gearbox.right();
        for tolerance in [1e-2, 1e-3, 1e-5] {
            let solution = gearbox.run(tolerance, IntegratorChoice::Auto);
            assert_eq!(solution.method(), Some(Method::Esdirk));
            let error = error_of(&solution, &right) / tolerance;
            worst = worst.max(error);
            assert!(error < 10.0, "case {case}: {error} tolerances of {tolerance}");
        }
    }
    println!("largest error: {worst} tolerances");
}

/// What the points cost: BDF begins anew at each of them.
#[test]
fn a_step_reaches_from_point_to_point() {
    let mut random = Random(11);
    for _ in 0..10 {
        let gearbox = Gearbox::new(&mut random);
        let [own, bdf] = [IntegratorChoice::Auto, IntegratorChoice::Cvode]
            .map(|integrator| gearbox.run(1e-4, integrator).statistics().steps);
        assert!(3 * own < bdf, "{own} steps, {bdf} with CVODE");
    }
}
