//! Grids against closed forms written out here: the slab series, Kirchhoff's transform, walls of
//! two materials.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::support;

use lptn::prelude::*;
use lptn_netlist::Netlist;

use support::{close, column, heat, parsed, settled};

fn temperature(netlist: &Netlist, steady: &SteadyState, node: &str) -> f64 {
    steady.temperatures[netlist.network.node(node).unwrap().index()]
}

/// The dimensionless temperature of a slab of half-thickness 1, insulated in its middle (x = 0),
/// that cools by convection at x = 1: the Fourier series of H. S. Carslaw and J. C. Jaeger,
/// Conduction of Heat in Solids, 2nd edition, Oxford 1959, section 3.11, with the roots of z tan z =
/// Bi.
fn slab(x: f64, fourier: f64, biot: f64) -> f64 {
    let pi = std::f64::consts::PI;
    let term = |n: u32| {
        // the n-th root lies between n pi and (n + 1/2) pi
        let (mut low, mut high) = (f64::from(n) * pi, (f64::from(n) + 0.5) * pi);
        for _ in 0..200 {
            let z = 0.5 * (low + high);
            if z * z.tan() > biot {
                high = z;
            } else {
                low = z;
            }
        }
        let z = 0.5 * (low + high);
        4.0 * z.sin() / (2.0 * z + (2.0 * z).sin()) * (z * x).cos() * (-z * z * fourier).exp()
    };
    (0..40).map(term).sum()
}

#[test]
fn the_series_that_grids_are_held_against_is_that_of_the_books() {
    // F. P. Incropera and D. P. DeWitt, Fundamentals of Heat and Mass Transfer, table 5.1: for Bi =
    // 1 the first root is 0.8603 and the first coefficient 1.1191
    let late: f64 = slab(0.0, 5.0, 1.0) * (0.8603_f64 * 0.8603 * 5.0).exp();
    close(late, 1.1191, 2e-3);
    close(slab(0.0, 0.01, 1.0), 1.0, 1e-9);
}

/// A wall of 0.1 m with k = 2 W/(m K), rho c = 2e6 J/(m^3 K) and h = 20 W/(m^2 K): Bi = 1, and Fo =
/// 1 after 10 000 s.
fn cooling_wall(cells: usize) -> String {
    format!(
        r#"
format = 1
[grid.wall]
size = ["0.1 m", "0.7 m", "0.5 m"]
cells = [{cells}]
k = "2 W/(m K)"
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "100 degC"
[boundary]
air = {{ T = "0 degC" }}
[convection]
skin = {{ from = "wall.x1", to = "air", h = "20 W/(m^2 K)" }}
"#
    )
}

/// Errors at the surface and in the middle at Fo = 0.3, as parts of the start's difference.
fn errors(cells: usize) -> [f64; 2] {
    let (netlist, system) = parsed(&cooling_wall(cells));
    let run =
        Transient::until(Time(3000.0)).every(Time(3000.0)).tolerance(1e-9).solve(&system).unwrap();
    let columns = ["wall.x1.T".to_owned(), "wall.x0.T".to_owned()];
    let selection = Selection::matching(&netlist.network, &columns).unwrap();
    let table = Table::of_solution(&run, &selection, &netlist.temperature_unit);
    let last = |name: &str| column(&table, name)[1] / 100.0;
    [last("wall.x1.T") - slab(1.0, 0.3, 1.0), last("wall.x0.T") - slab(0.0, 0.3, 1.0)]
}

#[test]
fn a_meshed_wall_converges_to_the_slab_series_with_order_2() {
    let found = [5, 10, 20, 40].map(errors);
    for place in 0..2 {
        for pair in found.windows(2) {
            let order = (pair[0][place] / pair[1][place]).log2();
            assert!((1.9..2.1).contains(&order), "order {order} from {found:?}");
        }
    }
    assert!(found[3].iter().all(|error| error.abs() < 2e-4), "{found:?}");
}

/// A block that cools on three of its faces: the product of three slabs (Incropera, section 5.8).
fn brick(cells: usize) -> f64 {
    let text = format!(
        r#"
format = 1
[grid.brick]
size = ["0.1 m", "0.2 m", "0.05 m"]
cells = [{cells}, {cells}, {cells}]
k = ["2 W/(m K)", "4 W/(m K)", "1 W/(m K)"]
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "100 degC"
[boundary]
air = {{ T = "0 degC" }}
[convection]
a = {{ from = "brick.x1", to = "air", h = "20 W/(m^2 K)" }}
b = {{ from = "air", to = "brick.y0", h = "20 W/(m^2 K)" }}
c = {{ from = "brick.z1", to = "air", h = "20 W/(m^2 K)" }}
"#
    );
    let (netlist, system) = parsed(&text);
    let run =
        Transient::until(Time(1000.0)).every(Time(1000.0)).tolerance(1e-8).solve(&system).unwrap();
    // the cell in the insulated corner; its middle is half a cell from there
    let corner = netlist.network.node(&format!("brick[1,{cells},1]")).unwrap();
    let at = 0.5 / cells as f64;
    let product =
        slab(at, 0.1, 1.0) * slab(at, 0.2 * 0.25, 1.0) * slab(at, 0.5e-6 * 1000.0 / 0.0025, 1.0);
    (run.temperature(corner).unwrap()[1] - 273.15) / 100.0 - product
}

#[test]
fn a_brick_converges_to_the_product_of_three_slabs_with_order_2() {
    let found = [3, 6, 12].map(brick);
    let orders = [found[0] / found[1], found[1] / found[2]].map(f64::log2);
    assert!((1.85..2.15).contains(&orders[1]), "orders {orders:?} of {found:?}");
}

/// A wall of bricks and wool, each cut along its three axes, against the sum of its resistances.
fn wall_of_two_materials(brick: [usize; 3], wool: [usize; 3]) {
    let text = format!(
        r#"
format = 1
[default]
T0 = "0 degC"
[grid.brick]
size = ["0.24 m", "2 m", "1.5 m"]
cells = {brick:?}
k = "0.8 W/(m K)"
density = "1800 kg/m^3"
cp = "900 J/(kg K)"
[grid.wool]
size = ["0.12 m", "2 m", "1.5 m"]
cells = {wool:?}
k = "0.04 W/(m K)"
density = "30 kg/m^3"
cp = "1000 J/(kg K)"
[boundary]
inside = {{ T = "20 degC" }}
outside = {{ T = "-10 degC" }}
[convection]
in = {{ from = "inside", to = "brick.x0", h = "8 W/(m^2 K)" }}
out = {{ from = "wool.x1", to = "outside", h = "25 W/(m^2 K)" }}
[contact]
glue = {{ from = "brick.x1", to = "wool.x0", h = "50 W/(m^2 K)" }}
"#
    );
    let (netlist, steady) = settled(&text);
    let area = 3.0;
    let parts = [1.0 / 8.0, 0.24 / 0.8, 1.0 / 50.0, 0.12 / 0.04, 1.0 / 25.0].map(|r| r / area);
    let q = 30.0 / parts.iter().sum::<f64>();
    for name in ["in", "glue", "out"] {
        close(heat(&netlist, &steady, name), q, 1e-10 * q);
    }
    let value = |name: &str| {
        let found =
            netlist.network.grid_values().find(|value| value.name(&netlist.network) == name);
        netlist.network.grid_value(found.unwrap(), &steady.temperatures) - 273.15
    };
    let places = ["brick.x0.T", "brick.x1.T", "wool.x0.T", "wool.x1.T"];
    let mut t = 20.0;
    for (name, r) in places.into_iter().zip(parts) {
        t -= q * r;
        close(value(name), t, 1e-10);
    }
    // linear in between
    close(value("brick.mean"), 20.0 - q * (parts[0] + 0.5 * parts[1]), 1e-10);
    close(value("brick.max"), 20.0 - q * (parts[0] + parts[1] * 0.5 / brick[0] as f64), 1e-10);
    close(value("wool.min"), -10.0 + q * (parts[4] + parts[3] * 0.5 / wool[0] as f64), 1e-10);
}

#[test]
fn a_wall_of_two_materials_is_exact_in_steady_state() {
    wall_of_two_materials([7, 2, 3], [5, 2, 3]);
    // so large that it is iterated
    wall_of_two_materials([24, 20, 12], [12, 20, 12]);
}

#[test]
fn conductivity_that_is_linear_in_temperature_is_exact_by_kirchhoffs_transform() {
    // k = 1 + 0.01 (T - 273.15 K) W/(m K) between 0 and 100 degC: its mean is 1.5
    let text = r#"
format = 1
[grid.wall]
size = ["0.1 m", "1 m", "1 m"]
cells = [9]
k = "1 [W/(m K)] + 0.01 [W/(m K^2)] * (T - 0 [degC])"
density = "2000 kg/m^3"
cp = "1000 J/(kg K)"
T0 = "20 degC"
[boundary]
cold = { T = "0 degC" }
hot = { T = "100 degC" }
[resistor]
left = { from = "cold", to = "wall.x0", R = "1e-9 K/W" }
right = { from = "wall.x1", to = "hot", R = "1e-9 K/W" }
"#;
    let (netlist, steady) = settled(text);
    close(heat(&netlist, &steady, "left"), -1500.0, 1e-4);
    // theta + 0.005 theta^2 is linear in x
    let theta: f64 = temperature(&netlist, &steady, "wall[5]") - 273.15;
    let integral = theta + 0.005 * theta * theta;
    let middle = 0.5 * (100.0 + 0.005 * 100.0 * 100.0);
    close(integral, middle, 1e-5);
}

/// The same wall by hand: what a grid stands for, written as nodes and resistors.
fn ladder(cells: usize) -> String {
    let (n, area) = (cells as f64, 0.7 * 0.5);
    let capacity = 0.1 / n * area * 2e6;
    let (whole, half) = (2.0 * area / (0.1 / n), 2.0 * area / (0.05 / n));
    let mut text =
        "format = 1\n[boundary]\nair = { T = \"0 degC\" }\n[node]\nsurface = { massless = true }\n"
            .to_owned();
    for i in 1..=cells {
        text += &format!("c{i} = {{ C = \"{capacity} J/K\", T0 = \"100 degC\" }}\n");
    }
    text += "[resistor]\n";
    for i in 1..cells {
        text +=
            &format!("p{i} = {{ from = \"c{i}\", to = \"c{}\", G = \"{whole} W/K\" }}\n", i + 1);
    }
    text += &format!("half = {{ from = \"c{cells}\", to = \"surface\", G = \"{half} W/K\" }}\n");
    text += "[convection]\nskin = { from = \"surface\", to = \"air\", h = \"20 W/(m^2 K)\", area \
        = \"0.35 m^2\" }\n";
    text
}

#[test]
fn a_grid_of_one_axis_is_the_ladder_written_by_hand() {
    let (grid, of_grid) = parsed(&cooling_wall(12));
    let (hand, of_hand) = parsed(&ladder(12));
    let run = |system: &ThermalSystem| {
        Transient::until(Time(3000.0)).every(Time(300.0)).tolerance(1e-7).solve(system).unwrap()
    };
    let (a, b) = (run(&of_grid), run(&of_hand));
    let name = |i: usize| (format!("wall[{i}]"), format!("c{i}"));
    let names = (1..=12).map(name).chain([("wall.x1".to_owned(), "surface".to_owned())]);
    for (ours, theirs) in names {
        let (ours, theirs) =
            (grid.network.node(&ours).unwrap(), hand.network.node(&theirs).unwrap());
        let (capacity, other) = (grid.network.capacity(ours), hand.network.capacity(theirs));
        close(capacity, other, 1e-15 * other);
        let far = support::distance(&a.temperature(ours).unwrap(), &b.temperature(theirs).unwrap());
        assert!(far < 1e-9, "{far:e}");
    }
    assert_eq!(a.statistics().steps, b.statistics().steps);
}
