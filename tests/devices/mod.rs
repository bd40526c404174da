//! Closed forms of the pages of what removes heat.

use super::{Closed, relaxed};

/// NTU = 5 and C_r = 0.7 against each other, side by side, across, in a shell, past a bath.
fn effectivenesses() -> [f64; 5] {
    let (n, ratio) = (5.0_f64, 0.7_f64);
    let against = (-n * (1.0 - ratio)).exp();
    let root = (1.0 + ratio * ratio).sqrt();
    let shell = (-n * root).exp();
    [
        (1.0 - against) / (1.0 - ratio * against),
        (1.0 - (-n * (1.0 + ratio)).exp()) / (1.0 + ratio),
        0.844_482_179_974_855, // the integral, by the library ht 1.2.0
        2.0 / (1.0 + ratio + root * (1.0 + shell) / (1.0 - shell)),
        1.0 - (-n).exp(),
    ]
}

pub(crate) fn cooler() -> Vec<Closed> {
    let e = effectivenesses();
    let all = 70.0 * e.iter().sum::<f64>();
    let bath = |t: f64| relaxed(20.0, 20.0 + 14e3 / all, t, 100e3 / all);
    let above = bath(f64::INFINITY) - 20.0;
    // each of the ring leaves 1 - e of what is above the water, and the last what the heat adds
    let [first, second, rest] =
        [1.0 - e[1], 1.0 - e[0], (1.0 - e[2]) * (1.0 - e[3]) * (1.0 - e[4])];
    let sump = 4900.0 / 70.0 / (1.0 - first * second * rest);
    let ring2 = 70.0 * e[0] * first * sump;
    vec![
        ("bath.T", "5 min", bath(300.0)),
        ("bath.T", "steady", bath(f64::INFINITY)),
        ("plates.Q", "steady", 70.0 * e[0] * above),
        ("pipe.Q", "steady", 70.0 * e[1] * above),
        ("finned.Q", "steady", 70.0 * e[2] * above),
        ("shell.Q", "steady", 70.0 * e[3] * above),
        ("coil.Q", "steady", 70.0 * e[4] * above),
        ("plates.T_out_from", "steady", 20.0 + (1.0 - e[0]) * above),
        ("plates.T_out_to", "steady", 20.0 + 0.7 * e[0] * above),
        ("sump.T", "steady", 20.0 + sump),
        ("out1.T", "steady", 20.0 + first * sump),
        ("out2.T", "steady", 20.0 + first * second * sump),
        ("ring2.Q", "steady", ring2),
        ("ring2.T_in_from", "steady", 20.0 + first * sump),
        ("ring2.T_out_to", "steady", 20.0 + ring2 / 100.0),
        ("out5.T", "steady", 20.0 + first * second * rest * sump),
    ]
}

pub(crate) fn convection() -> Vec<Closed> {
    // C dx/dt = -c x^(5/4): x = x0 (1 + c x0^(1/4) t / (4 C))^(-4), x0 = 80 K
    let c = 1.42 * (1.0_f64 / 0.25).powf(0.25) * 0.1;
    let still = |t: f64| 20.0 + 80.0 * (1.0 + c * 80.0_f64.powf(0.25) * t / (4.0 * 800.0)).powi(-4);
    let blown = |t| relaxed(100.0, 20.0, t, 800.0 / 4.0);
    let closed = vec![
        ("blown.T", "5 min", blown(300.0)),
        ("still.T", "5 min", still(300.0)),
        ("still.T", "30 min", still(1800.0)),
        ("still.T", "steady", 20.0),
    ];
    [closed, correlations(), bodies(), walls(), sinks(), draughts()].concat()
}

/// The gas of the page, whose film is at 50 degC: k, density, cp, viscosity, expansion.
const GAS: [f64; 5] = [0.0277, 1.1, 1007.0, 19.5e-6, 1.0 / 323.15];

fn prandtl() -> f64 {
    GAS[3] * GAS[2] / GAS[0]
}

/// The Rayleigh number of a length at 60 K.
fn ra(l: f64) -> f64 {
    let [k, rho, cp, mu, beta] = GAS;
    9.80665 * beta * 60.0 * l.powi(3) * rho * rho * cp / (mu * k)
}

fn re(u: f64, l: f64) -> f64 {
    GAS[1] * u * l / GAS[3]
}

/// The heat from 0.1 m^2 at 60 K.
fn heat(nu: f64, l: f64) -> f64 {
    nu * GAS[0] / l * 0.1 * 60.0
}

/// Churchill and Chu, with the Rayleigh number of the length.
fn upright(ra: f64) -> f64 {
    let weight = (1.0 + (0.492 / prandtl()).powf(9.0 / 16.0)).powf(8.0 / 27.0);
    (0.825 + 0.387 * ra.powf(1.0 / 6.0) / weight).powi(2)
}

/// 3000 rpm in rad/s.
const TURNS: f64 = 100.0 * std::f64::consts::PI;

/// 0.1 m^2 at 80 degC in the gas of the page at 20 degC.
fn correlations() -> Vec<Closed> {
    let pr = prandtl();
    let third = pr.powf(1.0 / 3.0);
    let blown: f64 = re(2.0, 0.05);
    let late = (1.0 + (blown / 282_000.0).powf(0.625)).powf(0.8);
    let rod =
        0.3 + 0.62 * blown.sqrt() * third / (1.0 + (0.4 / pr).powf(2.0 / 3.0)).powf(0.25) * late;
    let flow = re(6.0, 0.03);
    let f = (0.79 * flow.ln() - 1.64).powi(-2) / 8.0;
    let channel = f * (flow - 1000.0) * pr / (1.0 + 12.7 * f.sqrt() * (pr.powf(2.0 / 3.0) - 1.0));
    let pipe = (1.0 + (0.559 / pr).powf(9.0 / 16.0)).powf(8.0 / 27.0);
    let skin: f64 = re(TURNS * 0.02, 0.04);
    let ta = (TURNS * GAS[1] / GAS[3]).powi(2) * 0.04 * 0.002_f64.powi(3);
    vec![
        ("plate.Q", "steady", heat(upright(ra(0.3)), 0.3)),
        ("pipe.Q", "steady", heat((0.6 + 0.387 * ra(0.05).powf(1.0 / 6.0) / pipe).powi(2), 0.05)),
        ("lid.Q", "steady", heat(0.54 * ra(0.04).powf(0.25), 0.04)),
        ("floor.Q", "steady", heat(0.27 * ra(0.08).powf(0.25), 0.08)),
        ("rod.Q", "steady", heat(rod, 0.05)),
        ("rod_by_powers.Q", "steady", heat(0.193 * blown.powf(0.618) * third, 0.05)),
        ("board.Q", "steady", heat(0.664 * re(10.0, 0.5).sqrt() * third, 0.5)),
        ("board_end.Q", "steady", {
            heat(0.664 * (re(10.0, 0.5).sqrt() - re(10.0, 0.4).sqrt()) * third, 0.1)
        }),
        ("bar.Q", "steady", heat(0.158 * re(10.0, 0.04).powf(0.66) * third, 0.04)),
        ("bar_on_edge.Q", "steady", heat(0.304 * re(10.0, 0.04).powf(0.59) * third, 0.04)),
        ("channel.Q", "steady", heat(channel, 0.03)),
        ("shaft.Q", "steady", {
            heat(0.11 * (0.5 * skin * skin * pr + ra(0.04)).powf(0.35), 0.04)
        }),
        ("gap.Q", "steady", heat(0.409 * ta.powf(0.241), 2.0 * 0.002)),
    ]
}

/// Spheres, an inclined plate, a disc, a jet and gaps in the same gas.
fn bodies() -> Vec<Closed> {
    let pr = prandtl();
    let ball =
        2.0 + 0.589 * ra(0.05).powf(0.25) / (1.0 + (0.469 / pr).powf(0.5625)).powf(4.0 / 9.0);
    let flow = re(2.0, 0.05);
    let blown = 2.0 + (0.4 * flow.sqrt() + 0.06 * flow.cbrt().powi(2)) * pr.powf(0.4);
    // Nu = 2 times the integral of the local Nu over x = r/R, whose Re is Re x^2
    let spin = re(TURNS * 0.12, 0.12);
    let [first, last] = [1.95e5, 2.5e5].map(|re: f64| (re / spin).sqrt());
    let disc = 0.340 * spin.sqrt() * first.powi(2)
        + 2e-19 / 9.0 * spin.powi(4) * (last.powi(9) - first.powi(9))
        + 2.0 * 0.0188 / 2.6 * spin.powf(0.8) * (1.0 - last.powf(2.6));
    let nozzle = re(30.0, 0.01);
    let share = 0.25 * (1.0 - 1.1 * 0.25) / (1.0 + 0.1 * (5.0 - 6.0) * 0.25);
    let jet = share * 2.0 * (nozzle + 0.005 * nozzle.powf(1.55)).sqrt() * pr.powf(0.42);
    let gap = ra(0.02);
    let layer = 1.44 * (1.0 - 1708.0 / gap) + (gap / 5830.0).cbrt();
    let pane = (1.0 + (0.104 * gap.powf(0.293) / (1.0 + (6310.0 / gap).powf(1.36))).powi(3)).cbrt();
    vec![
        ("ball.Q", "steady", heat(ball, 0.05)),
        ("blown_ball.Q", "steady", heat(blown, 0.05)),
        ("roof.Q", "steady", heat(upright(ra(0.25) * 0.75_f64.sqrt()), 0.25)),
        ("disc.Q", "steady", heat(disc, 0.12)),
        ("jet.Q", "steady", heat(jet, 0.01)),
        ("layer.Q", "steady", heat(layer, 0.02)),
        ("pane.Q", "steady", heat(pane, 0.02)),
    ]
}

/// A wall in a draught, gearboxes and a heat sink.
fn walls() -> Vec<Closed> {
    let k = GAS[0];
    vec![
        ("draught.Q", "steady", {
            let forced = 0.664 * re(2.0, 0.5).sqrt() * prandtl().powf(1.0 / 3.0);
            6.0 * ((upright(ra(0.3)) * k / 0.3).powi(3) + (forced * k / 0.5).powi(3)).cbrt()
        }),
        ("gearbox.Q", "steady", {
            6.0 * 18.0 * 0.3_f64.powf(-0.1) * (60.0_f64 / 293.15).powf(0.3)
        }),
        ("blown_gearbox.Q", "steady", {
            let gr = ra(0.5) / prandtl();
            6.0 * 0.0086 * (re(2.0, 0.5).powi(2) + gr / 2.5).sqrt().powf(0.64) / 0.5
        }),
        ("sink.Q", "steady", {
            let ml = (2.0 * 10.0 / (167.0 * 1.5e-3_f64)).sqrt() * 0.03;
            10.0 * (0.01 + 0.2 * ml.tanh() / ml) * 60.0
        }),
    ]
}

/// The same wall in a flow of 2 m/s up and down.
fn draughts() -> Vec<Closed> {
    let (k, rho, cp, mu): (f64, f64, f64, f64) = (0.0277, 1.1, 1007.0, 19.5e-6);
    let pr = mu * cp / k;
    let ra = 9.80665 / 323.15 * 60.0 * 0.5_f64.powi(3) * rho.powi(2) * cp / (mu * k);
    let weight = (1.0 + (0.492 / pr).powf(9.0 / 16.0)).powf(8.0 / 27.0);
    let natural = (0.825 + 0.387 * ra.powf(1.0 / 6.0) / weight).powi(2) * k / 0.5;
    let forced = 0.664 * (rho * 2.0 * 0.5 / mu).sqrt() * pr.cbrt() * k / 0.5;
    let [f, n] = [forced, natural].map(|h: f64| h.powi(3));
    let heat = |cube: f64| 6.0 * (cube.powi(2) + (0.01 * (f + n)).powi(2)).powf(1.0 / 6.0);
    vec![("updraught.Q", "steady", heat(f + n)), ("downdraught.Q", "steady", heat(f - n))]
}

/// Heat sinks in the same gas.
fn sinks() -> Vec<Closed> {
    let (k, rho, cp, mu): (f64, f64, f64, f64) = (0.0277, 1.1, 1007.0, 19.5e-6);
    let pr = mu * cp / k;
    let el = 9.80665 / 323.15 * 60.0 * 0.008_f64.powi(4) / 0.15 * rho.powi(2) * cp / (mu * k);
    let still = (576.0 / el.powi(2) + 2.873 / el.sqrt()).powf(-0.5);
    let re = rho * 4.0 * 0.0025_f64.powi(2) / 0.1 / mu;
    let flat = 0.664 * re.sqrt() * pr.cbrt() * (1.0 + 3.65 / re.sqrt()).sqrt();
    let blown = ((re * pr / 2.0).powi(-3) + flat.powi(-3)).powf(-1.0 / 3.0);
    // 60 K over aluminium fins of 30 mm: gap, length along the flow, thickness
    let sink = |h: f64, [gap, along, thickness]: [f64; 3], fins: f64| {
        let ml = (2.0 * h / (167.0 * thickness)).sqrt() * 0.03;
        h * ((fins - 1.0) * gap + ml.tanh() / ml * 2.0 * fins * 0.03) * along * 60.0
    };
    let upright = sink(still * k / 0.008, [0.008, 0.15, 1.5e-3], 12.0);
    let blown = sink(blown * k / 0.0025, [0.0025, 0.1, 0.8e-3], 20.0);
    vec![("upright_sink.Q", "steady", upright), ("blown_sink.Q", "steady", blown)]
}

pub(crate) fn fan() -> Vec<Closed> {
    // 240 - 1.2 Q = 60 (Q/100)^2 in m^3/h and Pa, by the usual form of the root
    let flow = ((1.2_f64.powi(2) + 4.0 * 0.006 * 240.0).sqrt() - 1.2) / 0.012;
    let power = flow / 3600.0 * (240.0 - 1.2 * flow) / 0.3 / 8.0;
    let rate = 1200.0 * flow / 2.0 / 3600.0;
    let end = 20.0 + (100.0 + power) / rate;
    vec![
        ("fan_heat.P", "steady", power),
        ("case.T", "steady", end),
        ("case.T", "30 s", relaxed(20.0, end, 30.0, 500.0 / rate)),
    ]
}
