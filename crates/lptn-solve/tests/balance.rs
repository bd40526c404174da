//! Conservation and property: heat balances on random networks of every element, at every state and
//! over every run.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::elements_helper as elements;

use elements::{Random, link, of, own, power, quantity, radiation, stream, system, table};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    AfterEnd, Conductance, ConductorKind, Course, End, Formula, HeatCapacity, Melting,
    NetworkBuilder, NodeId, Path, Properties, Size, Temperature, Time,
};
use lptn_solve::{SteadyState, Transient};
use lptn_units::{Dimension, Interpolation, Outside, Table1};

struct Build {
    b: NetworkBuilder,
    random: Random,
    nodes: Vec<NodeId>,
    count: usize,
}

impl Build {
    fn name(&mut self) -> String {
        self.count += 1;
        format!("e{}", self.count)
    }

    fn node(&mut self, i: usize, wax: lptn_network::MaterialId) -> NodeId {
        let name = format!("n{i}");
        let start = Temperature(self.random.between(280.0, 420.0));
        let c = self.random.between(5.0, 500.0);
        match self.random.below(6) {
            0 => self.b.massless(&name),
            1 => {
                let c = own(&self.b, &format!("{c} [J/K] * (1 + 1e-3 [1/K] * (T - 20 [degC]))"));
                self.b.node(&name, c, start)
            }
            2 => {
                let lump = self.b.lump(wax, Size::Mass(quantity("20 g"))).unwrap();
                self.b.node(&name, lump, start)
            }
            _ => self.b.node(&name, HeatCapacity(c), start),
        }
    }

    fn path(&mut self, a: End, c: End) {
        let name = self.name();
        let g = self.random.between(0.1, 5.0);
        match self.random.below(6) {
            0 => {
                radiation(&mut self.b, &name, (a, c), &format!("{} m^2", 0.02 * g));
            }
            1 => {
                let h = link(&self.b, &format!("{g} [W/(m^2 K^1.25)] * abs(dT)^0.25"));
                self.b.convection(&name, a, c, Path::film(h, quantity("0.5 m^2")));
                let name = self.name();
                self.b.resistor(&name, a, c, Conductance(0.1));
            }
            2 => {
                let r = link(&self.b, &format!("{g} [K/W] * kelvin(T_mean) / 300 [K]"));
                self.b.resistor(&name, a, c, Path::resistance(r));
            }
            3 => {
                let g = link(&self.b, &format!("{g} [W/K] * (1 + 0.5 * sin(t / 7 [s]))"));
                self.b.resistor(&name, a, c, Path::conductance(g));
            }
            _ => {
                self.b.resistor(&name, a, c, Conductance(g));
            }
        }
    }

    /// A stream from the inlet through some nodes and out.
    fn river(&mut self, inlet: End, outlet: End) {
        let mut places = vec![inlet];
        for _ in 0..1 + self.random.below(4) {
            let next: End = self.nodes[self.random.below(self.nodes.len())].into();
            if !places.contains(&next) {
                places.push(next);
            }
        }
        places.push(outlet);
        let fluid = own(&self.b, "2000 [J/(kg K)] + 3 [J/(kg K^2)] * (T - 20 [degC])");
        let name = format!("fluid{}", self.count);
        let fluid = self.b.fluid(&name, None, fluid, None);
        let constant = self.random.below(2) == 0;
        let rate = self.random.between(-0.004, 0.004);
        for pair in places.windows(2) {
            let name = self.name();
            let flow = quantity(&format!("{rate} kg/s"));
            let rate = quantity(&format!("{} W/K", 2000.0 * rate));
            let path = if constant {
                Path::stream(rate)
            } else {
                Path::of_fluid(Formula::MassFlow, fluid, [flow])
            };
            self.b.conductor(&name, ConductorKind::Advection, (pair[0], pair[1]), path);
        }
    }

    fn sources(&mut self) {
        let [a, c, d] = [0; 3].map(|_| self.random.below(self.nodes.len()));
        let p = self.random.between(-20.0, 60.0);
        let heat = power(&self.b, &format!("{p} [W] + 0.1 [W/K] * (n{c}.T - n{d}.T)"));
        let name = self.name();
        self.b.source(&name, self.nodes[a], heat);
        let drive = power(&self.b, "drive");
        let name = self.name();
        self.b.shared_source(&name, &[(self.nodes[c], 0.25), (self.nodes[d], 0.75)], drive);
    }
}

fn network(seed: u64, size: usize, grounded: bool) -> ThermalSystem {
    let mut build = Build {
        b: NetworkBuilder::new(),
        random: Random(seed * 7919 + 13),
        nodes: vec![],
        count: 0,
    };
    let melting = Melting {
        solidus: Temperature(330.0).into(),
        liquidus: Temperature(if seed.is_multiple_of(2) { 330.0 } else { 334.0 }).into(),
        heat: quantity("200 kJ/kg"),
    };
    let cp = Some(quantity("2000 J/(kg K)"));
    let wax =
        build.b.material("wax", Properties { cp, melting: Some(melting), ..Properties::default() });
    let course = Course::Curve {
        points: Table1::new(
            vec![0.0, 3.0, 8.0],
            vec![0.0, 40.0, 5.0],
            Interpolation::Linear,
            Outside::Error,
        )
        .unwrap(),
        after: AfterEnd::Repeat(20.0),
    };
    build.b.signal("drive", of(Dimension::POWER), course);
    build.nodes = (0..size).map(|i| build.node(i, wax)).collect();
    for i in 1..size {
        let j = build.random.below(i);
        build.path(build.nodes[i].into(), build.nodes[j].into());
    }
    for _ in 0..size / 2 {
        let (i, j) = (build.random.below(size), build.random.below(size));
        if i != j {
            build.path(build.nodes[i].into(), build.nodes[j].into());
        }
    }
    if grounded {
        let room: End = build.b.boundary("room", Temperature(300.0)).into();
        let warm =
            build.b.expression("310 [K] * 1 + 0 [degC] + 5 [K] * sin(t / 11 [s]) - 290 [K]", None);
        let warm: End = build.b.boundary("warm", warm.unwrap()).into();
        build.path(build.nodes[0].into(), room);
        build.path(build.nodes[size - 1].into(), warm);
        build.b.resistor("foot", build.nodes[size / 2], room, Conductance(1.0));
        build.river(room, warm);
        build.sources();
    }
    system(build.b)
}

#[test]
fn heat_into_nodes_and_boundaries_is_that_of_sources_and_streams() {
    for seed in 0..40_u64 {
        let system = network(seed, 12, true);
        let mut random = Random(seed + 5);
        let mut work = system.workspace();
        let y: Vec<f64> = system.unknowns().iter().map(|_| random.between(260.0, 440.0)).collect();
        system.read_inputs(&mut work, 1.5, 1.5).unwrap();
        let mut flow = vec![0.0; y.len()];
        system.flow(&mut work, &y, &mut flow).unwrap();
        let mut boundaries = vec![0.0; 2];
        system.boundary_heat(&mut work, &y, &mut boundaries).unwrap();
        let mut streams = vec![0.0; system.streams().len()];
        system.stream_heat(&mut work, &mut streams).unwrap();
        let sum = |v: &[f64]| v.iter().sum::<f64>();
        let sources = sum(system.source_powers(&work));
        let left = sources + sum(&boundaries) + sum(&streams) - sum(&flow);
        let size = |v: &[f64]| v.iter().map(|q| q.abs()).sum::<f64>();
        let most = size(&flow) + size(&boundaries) + size(&streams) + sources.abs();
        assert!(left.abs() <= 1e-13 * most * 10.0, "{seed}: {left} of {most}");
    }
}

#[test]
fn books_of_random_networks_close() {
    let mut worst = 0.0_f64;
    for seed in 0..16_u64 {
        let system = network(seed, 10, !seed.is_multiple_of(3));
        for tolerance in [1e-3, 1e-5, 1e-7] {
            let run = Transient::until(Time(60.0)).tolerance(tolerance).solve(&system);
            let run = run.unwrap_or_else(|e| panic!("{seed} at {tolerance}: {e}"));
            let (ledger, relative) =
                (run.ledger(), run.ledger().relative_residual().unwrap_or(0.0));
            assert!(
                ledger.closes(),
                "{seed} at {tolerance}: {relative:e} above {:e}",
                ledger.bound
            );
            worst = worst.max(relative.abs() / ledger.bound);
        }
    }
    println!("worst residual: {worst:.2e} of its bound");
}

#[test]
fn random_runs_agree_with_finer_ones() {
    let mut worst = 0.0_f64;
    for seed in 0..16_u64 {
        if seed.is_multiple_of(3) {
            continue;
        }
        let system = network(seed, 10, true);
        let run =
            |tolerance| Transient::until(Time(60.0)).tolerance(tolerance).solve(&system).unwrap();
        let fine = run(1e-8);
        for tolerance in [1e-3, 1e-5] {
            let coarse = run(tolerance);
            for row in 0..fine.times().len() {
                for (a, b) in coarse.row(row).iter().zip(fine.row(row)) {
                    let part = (a - b).abs() / tolerance;
                    worst = worst.max(part);
                    assert!(
                        part <= 10.0,
                        "{seed} at {tolerance}: {a} {b} at {} s",
                        fine.times()[row]
                    );
                }
            }
        }
    }
    println!("worst difference: {worst:.2} tolerances");
}

#[test]
fn steady_states_of_random_networks_balance() {
    let mut found = 0;
    for seed in 0..40_u64 {
        let system = network(seed, 15, !seed.is_multiple_of(4));
        match SteadyState::solve(&system, 0.0) {
            Ok(steady) => {
                assert!(steady.imbalance().abs() <= 1e-9 * steady.turned_over() + 1e-9, "{seed}");
                found += 1;
            }
            Err(error) => panic!("{seed}: {} {error}", error.code()),
        }
    }
    assert_eq!(found, 40);
}

#[test]
fn cool_downs_and_islands_close_at_every_tolerance() {
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let mut b = NetworkBuilder::new();
        let capacity = own(&b, "100 [J/K] * (1 + 2e-3 [1/K] * (T - 20 [degC]))");
        let a = b.node("a", capacity, Temperature(900.0));
        let c = b.node("c", HeatCapacity(300.0), Temperature(290.0));
        let room = b.boundary("room", Temperature(290.0));
        let (d, e) = (
            b.node("d", HeatCapacity(40.0), Temperature(700.0)),
            b.node("e", HeatCapacity(9.0), Temperature(300.0)),
        );
        radiation(&mut b, "ac", (a, c), "0.02 m^2");
        b.resistor("cr", c, room, Conductance(0.3));
        radiation(&mut b, "de", (d, e), "0.02 m^2");
        stream(&mut b, "there", (d, e), quantity("2 W/K"));
        stream(&mut b, "back", (e, d), quantity("2 W/K"));
        let found = elements::run(&system(b), 2000.0, tolerance);
        let ledger = found.ledger();
        // the island keeps its energy
        let kept = ledger.stored[d.index()] + ledger.stored[e.index()];
        assert!(
            kept.abs() <= 10.0 * tolerance * 49.0 + 1e-8 * ledger.turned_over,
            "{kept} at {tolerance}"
        );
    }
}

#[test]
fn the_same_network_gives_the_same_digits() {
    let run = || {
        let system = network(11, 12, true);
        let found = Transient::until(Time(40.0)).solve(&system).unwrap();
        let bits = |row: usize| found.row(row).iter().map(|t| t.to_bits()).collect::<Vec<u64>>();
        (0..found.times().len()).map(bits).collect::<Vec<_>>()
    };
    assert_eq!(run(), run());
}

#[test]
fn tables_over_temperature_are_left_with_a_name() {
    // the table is a guard: a random network may not leave it silently
    let mut b = NetworkBuilder::new();
    let types = (elements::ABSOLUTE, of(Dimension::CONDUCTANCE));
    b.table("g", table(&[290.0, 320.0], &[1.0, 2.0], Interpolation::Linear, types));
    let node = b.node("node", HeatCapacity(10.0), Temperature(300.0));
    let room = b.boundary("room", Temperature(300.0));
    let g = link(&b, "g(T_from)");
    b.resistor("wall", node, room, Path::conductance(g));
    b.source("heater", node, quantity("100 W"));
    let error = SteadyState::solve(&system(b), 0.0).map(|s| s.state.temperatures).unwrap_err();
    assert_eq!(error.code(), "solve::input");
    assert!(error.to_string().contains("`wall`") && error.to_string().contains("`g`"), "{error}");
}

#[test]
fn natural_convection_starts_from_ambient() {
    // regression: the slope of abs(dT)^0.25 is infinite at dT = 0
    let mut b = NetworkBuilder::new();
    let plate = b.node("plate", HeatCapacity(500.0), Temperature(300.0));
    let room = b.boundary("room", Temperature(300.0));
    let h = link(&b, "1.3 [W/(m^2 K^1.25)] * abs(dT)^0.25");
    b.convection("film", plate, room, Path::film(h, quantity("1 m^2")));
    b.source("heater", plate, quantity("100 W"));
    let found = elements::run(&system(b), 20_000.0, 1e-6);
    // 1.3 x^1.25 = 100
    let rise = (100.0_f64 / 1.3).powf(0.8);
    assert!((elements::last(&found, plate) - 300.0 - rise).abs() < 1e-3, "{rise}");
}
