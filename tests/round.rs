//! Round grids against closed forms written out here: the hollow cylinder, the rod with a uniform
//! heat, the Bessel series of a rod that cools, harmonics around the axis.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::f64::consts::PI;

use crate::support;

use lptn::prelude::*;
use lptn_netlist::Netlist;

use support::{celsius, close, column, heat, parsed, settled};

/// A round cell of 21 mm x 70 mm, k = 1 W/(m K), 5 W in its volume, h = 30 W/(m^2 K) at its mantle.
fn cell(rings: &str) -> String {
    format!(
        r#"
format = 1
[grid.cell]
shape = "cylinder"
r_out = "10.5 mm"
length = "70 mm"
cells = {rings}
k = "1 W/(m K)"
density = "2700 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "25 degC"
[boundary]
air = {{ T = "25 degC" }}
[convection]
skin = {{ from = "cell.outer", to = "air", h = "30 W/(m^2 K)" }}
[source]
loss = {{ into = "cell", P = "5 W" }}
"#
    )
}

/// T = T_s + g (R^2 - r^2) / 4 k, T_s = 25 degC + P / (h 2 pi R L): 61.0895563 degC at the mantle,
/// 66.7594511 degC in the middle of the first of ten rings (Incropera et al., Fundamentals of Heat
/// and Mass Transfer, 6th edition, equation 3.53).
#[test]
fn a_round_cell_with_a_uniform_heat_is_exact() {
    for (rings, cells) in [("[10]", ""), ("[10, 3, 2]", ",2,1")] {
        let (netlist, steady) = settled(&cell(rings));
        let surface = 25.0 + 5.0 / (30.0 * 2.0 * PI * 0.0105 * 0.07);
        let rise = 5.0 / (PI * 0.07) / 4.0;
        for ring in 1..=10 {
            let share = (f64::from(ring) - 0.5) / 10.0;
            let found = celsius(&netlist, &steady, &format!("cell[{ring}{cells}]"));
            close(found, surface + rise * (1.0 - share * share), 1e-9);
        }
        let name = if cells.is_empty() { "cell.outer" } else { "cell.outer.T" };
        close(celsius(&netlist, &steady, name), surface, 1e-9);
        close(celsius(&netlist, &steady, name), 61.089_556_3, 1e-7);
        close(celsius(&netlist, &steady, &format!("cell[1{cells}]")), 66.759_451_1, 1e-7);
        close(heat(&netlist, &steady, "skin"), 5.0, 1e-9);
    }
}

/// A wall of 20 to 50 mm with a heat of its own between two temperatures, and without:
/// T = a + b ln r - g r^2 / 4 k.
fn pipe(rings: usize, watts: f64) -> (Netlist, SteadyState) {
    settled(&format!(
        r#"
format = 1
[grid.pipe]
shape = "cylinder"
r_in = "20 mm"
r_out = "50 mm"
length = "0.3 m"
cells = [{rings}]
k = "2 W/(m K)"
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "25 degC"
[boundary]
oil = {{ T = "80 degC" }}
air = {{ T = "20 degC" }}
[convection]
inside = {{ from = "oil", to = "pipe.inner", h = "100 W/(m^2 K)" }}
outside = {{ from = "pipe.outer", to = "air", h = "15 W/(m^2 K)" }}
[source]
loss = {{ into = "pipe", P = "{watts} W" }}
"#
    ))
}

#[test]
fn a_pipe_is_exact_for_any_number_of_rings() {
    let (r1, r2, l, k): (f64, f64, f64, f64) = (0.02, 0.05, 0.3, 2.0);
    let r = [
        1.0 / (100.0 * 2.0 * PI * r1 * l),
        (r2 / r1).ln() / (2.0 * PI * k * l),
        1.0 / (15.0 * 2.0 * PI * r2 * l),
    ];
    for rings in [1, 2, 7] {
        let (netlist, steady) = pipe(rings, 0.0);
        let q = 60.0 / r.iter().sum::<f64>();
        close(heat(&netlist, &steady, "inside"), q, 1e-11 * q);
        close(celsius(&netlist, &steady, "pipe.inner"), 80.0 - q * r[0], 1e-10);
        close(celsius(&netlist, &steady, "pipe.outer"), 20.0 + q * r[2], 1e-10);
        // with 40 W: the flow q0 enters at the inside, q0 + 40 W leaves
        let (netlist, steady) = pipe(rings, 40.0);
        let g = 40.0 / (PI * (r2 * r2 - r1 * r1) * l);
        // 2 pi L r q(r) = q0 + g pi L (r^2 - r1^2), and the fall from r1 to r
        let fall = |q0: f64, to: f64| {
            (q0 / (PI * l) - g * r1 * r1) / (2.0 * k) * (to / r1).ln()
                + g * (to * to - r1 * r1) / (4.0 * k)
        };
        let all = |q0: f64| q0 * r[0] + fall(q0, r2) + (q0 + 40.0) * r[2] - 60.0;
        let q0 = -all(0.0) / (all(1.0) - all(0.0));
        close(heat(&netlist, &steady, "inside"), q0, 1e-10);
        for ring in 1..=rings {
            let at = r1 + (r2 - r1) * (ring as f64 - 0.5) / rings as f64;
            let found = celsius(&netlist, &steady, &format!("pipe[{ring}]"));
            close(found, 80.0 - q0 * r[0] - fall(q0, at), 1e-9);
        }
    }
}

/// A grid whose first face is at 100 degC and second at 0 degC, by the paths `left` and `right`.
fn between(grid: &str, [hot, cold]: [&str; 2]) -> String {
    format!(
        r#"{grid}
[boundary]
cold = {{ T = "0 degC" }}
hot = {{ T = "100 degC" }}
[resistor]
left = {{ from = "hot", to = "{hot}", R = "1e-9 K/W" }}
right = {{ from = "{cold}", to = "cold", R = "1e-9 K/W" }}
"#
    )
}

/// k = 1 + 0.01 (T - 0 degC) W/(m K): the integral of k falls with ln r (Kirchhoff).
#[test]
fn a_conductivity_over_temperature_is_exact_in_a_pipe() {
    let text = r#"
format = 1
[grid.pipe]
shape = "cylinder"
r_in = "20 mm"
r_out = "60 mm"
length = "0.3 m"
angle = "90 deg"
cells = [40, 2]
k = "1 [W/(m K)] + 0.01 [W/(m K^2)] * (T - 0 [degC])"
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "20 degC"
"#;
    let (netlist, steady) = settled(&between(text, ["pipe.inner", "pipe.outer"]));
    let exact = 1.5 * 100.0 * PI / 2.0 * 0.3 / 3_f64.ln();
    close(heat(&netlist, &steady, "left"), exact, 1e-5 * exact);
    let theta = celsius(&netlist, &steady, "pipe[13,1]");
    let at: f64 = 0.02 + 0.04 * 12.5 / 40.0;
    let share = (0.06 / at).ln() / 3_f64.ln();
    close(theta + 0.005 * theta * theta, 150.0 * share, 1e-5);
}

/// Heat around a sector between its cuts: k L ln(r_out / r_in) / angle, at every radius linear in
/// the angle.
#[test]
fn a_sector_conducts_around_the_axis() {
    let text = r#"
format = 1
[grid.bend]
shape = "cylinder"
r_in = "30 mm"
r_out = "60 mm"
angle = "120 deg"
length = "0.2 m"
cells = [5, 4]
k = ["7 W/(m K)", "2 W/(m K)", "7 W/(m K)"]
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "20 degC"
"#;
    let (netlist, steady) = settled(&between(text, ["bend.phi0", "bend.phi1"]));
    let exact = 100.0 * 2.0 * 0.2 * 2_f64.ln() / (2.0 * PI / 3.0);
    close(heat(&netlist, &steady, "left"), exact, 1e-6 * exact);
    close(celsius(&netlist, &steady, "bend[4,1]"), 87.5, 1e-5);
}

/// J0 and J1 for arguments up to 40 (Abramowitz and Stegun, section 9.12).
fn bessel(order: u32, x: f64) -> f64 {
    // Miller's recurrence downwards, normalised by J0 + 2 (J2 + J4 + ..) = 1
    let (mut above, mut here, mut sum, mut found) = (0.0_f64, 1e-300, 0.0, 0.0);
    let start = 2 * ((x as u32 + 60) / 2);
    for n in (1..=start).rev() {
        let below = 2.0 * f64::from(n) / x * here - above;
        (above, here) = (here, below);
        if n - 1 == order {
            found = here;
        }
        if (n - 1) % 2 == 0 {
            sum += if n == 1 { here } else { 2.0 * here };
        }
    }
    found / sum
}

/// The dimensionless temperature of a rod of radius 1 that cools by convection: H. S. Carslaw and
/// J. C. Jaeger, Conduction of Heat in Solids, 2nd edition, Oxford 1959, section 7.7, with the
/// roots of z J1(z) = Bi J0(z).
fn rod(r: f64, fourier: f64, biot: f64) -> f64 {
    let of = |z: f64| z * bessel(1, z) - biot * bessel(0, z);
    let (mut roots, mut z) = (Vec::new(), 1e-6);
    while roots.len() < 10 {
        let next = z + 0.05;
        if of(z) < 0.0 && of(next) >= 0.0 || of(z) > 0.0 && of(next) <= 0.0 {
            let (mut low, mut high) = (z, next);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                let same = (of(middle) > 0.0) == (of(low) > 0.0);
                if same { low = middle } else { high = middle }
            }
            roots.push(low);
        }
        z = next;
    }
    let term = |z: &f64| {
        let scale = bessel(0, *z).powi(2) + bessel(1, *z).powi(2);
        let at = if r > 0.0 { bessel(0, z * r) } else { 1.0 };
        2.0 * bessel(1, *z) / (z * scale) * at * (-z * z * fourier).exp()
    };
    roots.iter().map(term).sum()
}

#[test]
fn the_series_of_the_rod_is_that_of_the_books() {
    // Incropera et al., table 5.1: for Bi = 1 the first root is 1.2558 and the first coefficient
    // 1.2071; J0(2.4048) = 0
    let late = rod(0.0, 3.0, 1.0) * (1.2558_f64 * 1.2558 * 3.0).exp();
    close(late, 1.2071, 2e-3);
    close(bessel(0, 2.404_825_557_7), 0.0, 1e-9);
    close(rod(0.5, 0.02, 1.0), rod(0.5, 0.02, 1.0).clamp(0.0, 1.0), 0.0);
}

/// Errors of a rod of 0.1 m with Bi = 1 at Fo = 0.2, at its mantle and at the node of its first
/// ring, as parts of the difference at the start.
fn cooled(rings: usize) -> [f64; 2] {
    let text = format!(
        r#"
format = 1
[grid.rod]
shape = "cylinder"
r_out = "0.1 m"
length = "0.5 m"
cells = [{rings}]
k = "2 W/(m K)"
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "100 degC"
[boundary]
air = {{ T = "0 degC" }}
[convection]
skin = {{ from = "rod.outer", to = "air", h = "20 W/(m^2 K)" }}
"#
    );
    let (netlist, system) = parsed(&text);
    let run =
        Transient::until(Time(2000.0)).every(Time(2000.0)).tolerance(1e-9).solve(&system).unwrap();
    let columns = ["rod.outer.T".to_owned(), "rod[1].T".to_owned()];
    let selection = Selection::matching(&netlist.network, &columns).unwrap();
    let table = Table::of_solution(&run, &selection, &netlist.temperature_unit);
    let last = |name: &str| column(&table, name)[1] / 100.0;
    let first = 0.5 / rings as f64;
    [last("rod.outer.T") - rod(1.0, 0.2, 1.0), last("rod[1].T") - rod(first, 0.2, 1.0)]
}

#[test]
fn a_rod_that_cools_converges_to_the_bessel_series_with_order_2() {
    let found = [5, 10, 20, 40].map(cooled);
    for place in 0..2 {
        for pair in found.windows(2) {
            let order = (pair[0][place] / pair[1][place]).log2();
            assert!((1.9..2.1).contains(&order), "order {order} from {found:?}");
        }
    }
    assert!(found[3].iter().all(|error| error.abs() < 2e-4), "{found:?}");
}

/// A rod whose mantle is held at cos(n phi), cell by cell: inside it is (r / R)^n cos(n phi).
fn harmonic(n: u32, cells: usize) -> f64 {
    let around = 4 * cells;
    let mut text = format!(
        r#"
format = 1
[grid.rod]
shape = "cylinder"
r_out = "1 m"
length = "1 m"
cells = [{cells}, {around}]
k = "2 W/(m K)"
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "0 degC"
[boundary]
far = {{ T = "0 degC" }}
[contact]
skin = {{ from = "rod.outer", to = "far", h = "1e-9 W/(m^2 K)" }}
"#
    );
    let angle = |j: usize| 2.0 * PI * (j as f64 + 0.5) / around as f64;
    for j in 0..around {
        let value = (f64::from(n) * angle(j)).cos();
        text += &format!(
            "[boundary.b{j}]\nT = \"{} K\"\n[resistor.r{j}]\nfrom = \"b{j}\"\nto = \
             \"rod.outer[{}]\"\nR = \"1e-9 K/W\"\n",
            273.15 + value,
            j + 1
        );
    }
    let (netlist, steady) = settled(&text);
    // the mean error of both rings beside half the radius, as a part of the mantle's temperature
    let error = |ring: usize| {
        let r: f64 = (ring as f64 - 0.5) / cells as f64;
        let found = celsius(&netlist, &steady, &format!("rod[{ring},2]"));
        found / (f64::from(n) * angle(1)).cos() - r.powi(n as i32)
    };
    0.5 * (error(cells / 2) + error(cells / 2 + 1))
}

#[test]
fn harmonics_around_the_axis_converge_with_order_2() {
    for n in 1..=3 {
        let found = [6, 12, 24].map(|cells| harmonic(n, cells));
        let order = (found[1] / found[2]).log2();
        assert!((1.8..2.2).contains(&order), "{n}: order {order} of {found:?}");
        assert!(found[2].abs() < 1e-3, "{n}: {found:?}");
    }
}

/// A rod of two materials end to end, heated at one end: each ring conducts along the axis as if
/// it were alone.
#[test]
fn rods_end_to_end() {
    let body = |name: &str, k: f64, cells: usize| {
        format!(
            "[grid.{name}]\nshape = \"cylinder\"\nr_out = \"20 mm\"\nlength = \"0.1 m\"\ncells = \
             [3, 2, {cells}]\nk = \"{k} W/(m K)\"\ndensity = \"2000 kg/m^3\"\ncp = \"1000 J/(kg \
             K)\"\nT0 = \"20 degC\"\n"
        )
    };
    let text = format!(
        "format = 1\n{}{}{}",
        body("hot", 15.0, 4),
        body("cold", 60.0, 3),
        r#"
[boundary]
water = { T = "10 degC" }
[contact]
joint = { from = "hot.z1", to = "cold.z0", h = "2000 W/(m^2 K)" }
[convection]
film = { from = "cold.z1", to = "water", h = "500 W/(m^2 K)" }
[source]
heater = { into = "hot.z0", P = "10 W" }
"#
    );
    let (netlist, steady) = settled(&text);
    let flux = 10.0 / (PI * 0.02 * 0.02);
    let end = 10.0 + flux / 500.0;
    let joint = end + flux * (0.1 / 60.0 + 1.0 / 2000.0);
    close(celsius(&netlist, &steady, "cold.z1.T"), end, 1e-9);
    close(celsius(&netlist, &steady, "hot.z1.T"), joint, 1e-9);
    close(celsius(&netlist, &steady, "hot.mean"), joint + flux * 0.05 / 15.0, 1e-9);
    close(celsius(&netlist, &steady, "hot[3,2,1]"), joint + flux * 0.0875 / 15.0, 1e-9);
    close(heat(&netlist, &steady, "joint"), 10.0, 1e-9);
}

/// A rod of one ring whose radius is a parameter: one exponential, T = P R (1 - exp(-t / (R C)))
/// over the air, with R = 1 / (2 pi h L r) + ln(2) / (2 pi k L) and C = rho c pi r^2 L.
#[test]
fn a_radius_has_the_sensitivity_of_the_closed_form() {
    let text = r#"
format = 1
[param]
r = "30 mm"
[grid.rod]
shape = "cylinder"
r_out = "r"
length = "0.5 m"
cells = [1]
k = "2 W/(m K)"
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "0 degC"
[boundary]
air = { T = "0 degC" }
[convection]
skin = { from = "rod.outer", to = "air", h = "20 W/(m^2 K)" }
[source]
heat = { into = "rod[1]", P = "40 W" }
"#;
    let (netlist, system) = parsed(text);
    let ids: Vec<_> = netlist.network.parameter_ids().collect();
    let run = Transient::until(Time(3000.0)).every(Time(500.0)).tolerance(1e-8);
    let run = run.sensitivities(&ids).solve(&system).unwrap();
    let node = netlist.network.node("rod[1]").unwrap();
    let found = run.sensitivity(ids[0], node).unwrap();
    let (r, l, p) = (0.03, 0.5, 40.0);
    let film = 1.0 / (2.0 * PI * 20.0 * l * r);
    let whole = film + 2_f64.ln() / (2.0 * PI * 2.0 * l);
    let slow = whole * 2e6 * PI * r * r * l;
    let slope = slow * (2.0 / r - film / r / whole);
    for (&t, found) in run.times().iter().zip(found) {
        let e = (-t / slow).exp();
        let exact = -p * film / r * (1.0 - e) - p * whole * e * t / (slow * slow) * slope;
        close(found, exact, 1e-6 * p * whole / r);
    }
}

/// A rod that is heated evenly and cooled nowhere warms up alike in all rings, also while it melts.
#[test]
fn an_even_heat_warms_all_rings_alike() {
    let text = r#"
format = 1
[material.wax]
density = "900 kg/m^3"
cp = "2000 J/(kg K)"
k = "0.3 W/(m K)"
solidus = "49 degC"
liquidus = "51 degC"
latent_heat = "200 kJ/kg"
[grid.rod]
shape = "cylinder"
r_in = "1 cm"
r_out = "4 cm"
length = "0.2 m"
cells = [5, 2]
material = "wax"
T0 = "20 degC"
[source]
heat = { into = "rod", P = "50 W" }
"#;
    let (netlist, system) = parsed(text);
    let run =
        Transient::until(Time(4000.0)).every(Time(500.0)).tolerance(1e-7).solve(&system).unwrap();
    let mass = 900.0 * PI * (0.04 * 0.04 - 0.01 * 0.01) * 0.2;
    let nodes = ["rod[1,1]", "rod[3,2]", "rod[5,1]"].map(|n| netlist.network.node(n).unwrap());
    for node in nodes {
        for (&t, kelvin) in run.times().iter().zip(run.temperature(node).unwrap()) {
            // J/kg: sensible to 49 degC, then over 2 K the latent heat as well, then sensible
            let heat = 50.0 * t / mass;
            let melted = ((heat - 58_000.0) / 204_000.0).clamp(0.0, 1.0);
            let warm = (heat.min(58_000.0) + (heat - 262_000.0).max(0.0)) / 2000.0;
            close(kelvin - 273.15, 20.0 + warm + 2.0 * melted, 1e-4);
        }
    }
}
