//! Massless nodes: what is left after their elimination, against balances solved in exact rational
//! numbers.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::networks;
use crate::rational;

use lptn_assembly::{AssemblyError, JacobianForm, ThermalSystem};
use lptn_network::{Conductance, End, HeatCapacity, HeatFlow, NetworkBuilder, Temperature};
use networks::{Random, dense, system};
use rational::{Rational, solved};

/// A network of constant conductances in whole numbers: vertices are nodes, then two boundaries.
struct Case {
    massless: Vec<bool>,
    links: Vec<(usize, usize, i128)>,
    heat: Vec<i128>,
}

/// Temperatures of the boundaries in K.
const BOUNDARIES: [i128; 2] = [290, 350];

impl Case {
    fn random(random: &mut Random) -> Self {
        let massless: Vec<bool> = (0..7).map(|i| i % 3 != 1).collect(); // states 1 and 4 stand between the others
        let mut links: Vec<(usize, usize, i128)> =
            (1..9).map(|v| (random.below(v.min(7)), v, 1)).collect();
        for _ in 0..9 {
            let (a, b) = (random.below(9), random.below(9));
            if a != b {
                links.push((a, b, 1 + random.below(9) as i128));
            }
        }
        links.push((7, 8, 4)); // a bridge
        let heat = massless.iter().map(|_| random.below(40) as i128 - 20).collect();
        Self { massless, links, heat }
    }

    fn states(&self) -> Vec<usize> {
        (0..self.massless.len()).filter(|&i| !self.massless[i]).collect()
    }

    fn assembled(&self) -> ThermalSystem {
        let mut b = NetworkBuilder::new();
        let mut ends: Vec<End> = Vec::new();
        for (i, massless) in self.massless.iter().enumerate() {
            let name = format!("n{i}");
            let node = if *massless {
                b.massless(&name)
            } else {
                b.node(&name, HeatCapacity(1.0), Temperature(300.0))
            };
            b.source(&format!("q{i}"), node, HeatFlow(self.heat[i] as f64));
            ends.push(node.into());
        }
        for (name, t) in ["cold", "hot"].into_iter().zip(BOUNDARIES) {
            ends.push(b.boundary(name, Temperature(t as f64)).into());
        }
        for (i, &(a, c, g)) in self.links.iter().enumerate() {
            b.resistor(&format!("r{i}"), ends[a], ends[c], Conductance(g as f64));
        }
        system(b)
    }

    /// Temperatures of all vertices for those of the states.
    fn temperatures(&self, states: &[i128]) -> Vec<Rational> {
        let count = self.massless.len();
        let mut known: Vec<Option<i128>> = vec![None; count + 2];
        self.states().into_iter().zip(states).for_each(|(i, t)| known[i] = Some(*t));
        known[count..].copy_from_slice(&BOUNDARIES.map(Some));
        let unknown: Vec<usize> = (0..count).filter(|&i| self.massless[i]).collect();
        let place = |v: usize| unknown.iter().position(|&u| u == v);
        let mut rows = vec![vec![Rational::whole(0); unknown.len() + 1]; unknown.len()];
        for (row, &v) in rows.iter_mut().zip(&unknown) {
            *row.last_mut().unwrap() = Rational::whole(self.heat[v]);
        }
        for &(a, b, g) in &self.links {
            for (v, other) in [(a, b), (b, a)] {
                let Some(row) = place(v) else { continue };
                rows[row][row] = rows[row][row] + Rational::whole(g);
                match known[other] {
                    Some(t) => {
                        let last = unknown.len();
                        rows[row][last] = rows[row][last] + Rational::whole(g * t);
                    }
                    None => {
                        let column = place(other).unwrap();
                        rows[row][column] = rows[row][column] - Rational::whole(g);
                    }
                }
            }
        }
        let found = solved(rows);
        let of = |v: usize| known[v].map_or_else(|| found[place(v).unwrap()], Rational::whole);
        (0..count + 2).map(of).collect()
    }

    /// Heat into every vertex but for what a source puts into a node.
    fn received(&self, states: &[i128]) -> Vec<Rational> {
        let temperatures = self.temperatures(states);
        let mut heat = vec![Rational::whole(0); temperatures.len()];
        for &(a, b, g) in &self.links {
            let q = Rational::whole(g) * (temperatures[a] - temperatures[b]);
            heat[a] = heat[a] - q;
            heat[b] = heat[b] + q;
        }
        heat
    }
}

fn near(found: f64, exact: Rational, scale: f64) {
    assert!((found - exact.number()).abs() <= 4e-15 * scale, "{found} is not {}", exact.number());
}

#[test]
fn what_is_left_is_the_schur_complement() {
    let mut random = Random(12);
    for _ in 0..40 {
        let case = Case::random(&mut random);
        let assembled = case.assembled();
        let states: Vec<i128> =
            case.states().iter().map(|_| 250 + random.below(200) as i128).collect();
        let y: Vec<f64> = states.iter().map(|t| *t as f64).collect();
        let mut work = assembled.workspace();
        assembled.read_inputs(&mut work, 0.0, 0.0).unwrap();
        let received = case.received(&states);

        let mut flow = vec![f64::NAN; y.len()];
        assembled.flow(&mut work, &y, &mut flow).unwrap();
        for (found, v) in flow.iter().zip(case.states()) {
            near(*found, received[v] + Rational::whole(case.heat[v]), 2e4);
        }
        let mut boundaries = [f64::NAN; 2];
        assembled.boundary_heat(&mut work, &y, &mut boundaries).unwrap();
        for (found, v) in boundaries.iter().zip(7..) {
            near(*found, Rational::whole(0) - received[v], 2e4);
        }
        assembled.recover(&mut work, &y);
        for (found, exact) in
            assembled.node_temperatures(&work).iter().zip(case.temperatures(&states))
        {
            near(*found, exact, 400.0);
        }
        let matrix = dense(&assembled, 0.0, &y, JacobianForm::Exact);
        for column in 0..y.len() {
            let mut moved = states.clone();
            moved[column] += 1;
            let changed = case.received(&moved);
            for (row, v) in case.states().into_iter().enumerate() {
                near(matrix[row][column], changed[v] - received[v], 200.0);
            }
        }
    }
}

/// Heats and temperatures put in place of the network's own, and back to its own.
#[test]
fn applied_heat_takes_the_place_of_the_inputs() {
    let mut random = Random(5);
    for _ in 0..10 {
        let mut case = Case::random(&mut random);
        let assembled = case.assembled();
        let own = case.heat.clone();
        let mut work = assembled.workspace();
        assembled.read_inputs(&mut work, 0.0, 0.0).unwrap();
        case.heat.iter_mut().for_each(|q| *q = random.below(60) as i128);
        let heat: Vec<f64> = case.heat.iter().map(|q| *q as f64).collect();
        assembled.apply(&mut work, &heat, &BOUNDARIES.map(|t| t as f64));
        let check = |work: &mut lptn_assembly::Workspace, case: &Case| {
            let mut flow = [f64::NAN; 2];
            assembled.flow(work, &[300.0, 310.0], &mut flow).unwrap();
            let received = case.received(&[300, 310]);
            for (found, v) in flow.iter().zip(case.states()) {
                near(*found, received[v] + Rational::whole(case.heat[v]), 2e4);
            }
        };
        check(&mut work, &case);
        assembled.read_inputs(&mut work, 0.0, 0.0).unwrap();
        case.heat = own;
        check(&mut work, &case);
    }
}

/// All that leads to boundaries: what the states feel of them, and what goes from one to the other.
#[test]
fn the_conductance_of_boundaries_is_what_is_left_of_it() {
    let mut random = Random(77);
    for _ in 0..10 {
        let mut case = Case::random(&mut random);
        case.heat.fill(0);
        let none = case.received(&[0, 0]);
        let feel = |v: usize| none[v]; // states at 0 K take in sum of g_b T_b
        let assembled = case.assembled();
        let mut work = assembled.workspace();
        assembled.read_inputs(&mut work, 0.0, 0.0).unwrap();
        let mut felt = [f64::NAN; 2];
        assembled.flow(&mut work, &[0.0, 0.0], &mut felt).unwrap();
        case.states().into_iter().zip(felt).for_each(|(v, q)| near(q, feel(v), 2e4));
        // with all boundaries 1 K above the states: ties; with one alone above the other: its ties
        // and its bridges
        let unit = |work: &mut lptn_assembly::Workspace, boundaries: [f64; 2]| {
            assembled.apply(work, &[0.0; 7], &boundaries);
            let mut given = [f64::NAN; 2];
            assembled.boundary_heat(work, &[0.0, 0.0], &mut given).unwrap();
            given
        };
        let all: f64 = unit(&mut work, [1.0, 1.0]).iter().sum();
        let bridge = -unit(&mut work, [1.0, 0.0])[1];
        let found = assembled.boundary_conductance();
        assert!((found - (all + bridge)).abs() < 1e-12, "{found} {all} {bridge}");
        assert!(bridge >= 4.0);
    }
}

#[test]
fn a_vertex_between_equal_temperatures_has_that_temperature_to_the_last_digit() {
    let mut b = NetworkBuilder::new();
    let middle = b.massless("middle");
    for (i, g) in [0.1, 0.3, 0.7, 1e-9, 3e5].into_iter().enumerate() {
        let node = b.node(&format!("n{i}"), HeatCapacity(1.0), Temperature(300.0));
        b.resistor(&format!("r{i}"), node, middle, Conductance(g));
    }
    let assembled = system(b);
    let mut work = assembled.workspace();
    assembled.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let t = 293.152_847_362_1;
    assembled.recover(&mut work, &[t; 5]);
    assert_eq!(assembled.node_temperatures(&work)[0].to_bits(), f64::to_bits(t));
}

/// Nine decades between the conductances around a junction: the weights are exact, 1 W/K of 1e9 W/K
/// is not lost.
#[test]
fn no_spread_of_conductances_costs_digits() {
    let mut b = NetworkBuilder::new();
    let (left, middle) =
        (b.node("left", HeatCapacity(1.0), Temperature(300.0)), b.massless("middle"));
    let air = b.boundary("air", Temperature(0.0));
    b.resistor("weak", left, middle, Conductance(1.0));
    b.resistor("strong", middle, air, Conductance(1e9));
    let assembled = system(b);
    let mut work = assembled.workspace();
    assembled.read_inputs(&mut work, 0.0, 0.0).unwrap();
    let mut flow = [f64::NAN];
    assembled.flow(&mut work, &[1.0], &mut flow).unwrap();
    let series = 1.0 / (1.0 + 1e-9);
    assert!((flow[0] + series).abs() < 3e-16, "{}", flow[0]);
}

#[test]
fn a_hub_that_would_link_millions_of_pairs_is_named() {
    let mut b = NetworkBuilder::new();
    let air = b.boundary("air", Temperature(300.0));
    let first = b.node("first", HeatCapacity(1.0), Temperature(300.0));
    let hub = b.massless("hub");
    b.resistor("out", first, air, Conductance(1.0));
    for i in 0..7000 {
        let node = b.node(&format!("n{i}"), HeatCapacity(1.0), Temperature(300.0));
        b.resistor(&format!("r{i}"), hub, node, Conductance(1.0));
    }
    let error = ThermalSystem::assemble(&b.build().unwrap()).unwrap_err();
    let expected =
        AssemblyError::TooManyNeighbours { node: hub, name: "hub".into(), neighbours: 7000 };
    assert_eq!(error, expected);
    assert_eq!(error.code(), "assembly::too_many_neighbours");
    assert!(error.to_string().contains("`hub` has 7000 neighbours"), "{error}");
    assert_eq!(
        error.help().as_deref(),
        Some("give `hub` and nodes like it a capacity, so that they become states")
    );
}
