//! Which integrator computes a run, and that both find the same.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common;
use crate::elements_helper as elements;

use common::{gearbox, nafems_t3, one_node, rc_ladder, stiff, two_masses};
use elements::{Random, radiation, system};
use lptn_assembly::ThermalSystem;
use lptn_network::{
    Conductance, HeatCapacity, IntegratorChoice, Network, NetworkBuilder, NodeId, Temperature, Time,
};
use lptn_solve::{Method, SettingsError, Solution, Transient, TransientError};

fn run(network: &Network, stop: f64, settings: impl FnOnce(&mut Transient)) -> Solution {
    let mut transient = Transient::until(Time(stop));
    settings(&mut transient);
    transient.solve(&ThermalSystem::assemble(network).unwrap()).unwrap()
}

fn with(network: &Network, stop: f64, integrator: IntegratorChoice) -> Solution {
    run(network, stop, |transient| transient.integrator = integrator)
}

/// The largest difference of any temperature at any row in K.
fn apart(a: &Solution, b: &Solution) -> f64 {
    assert_eq!(a.times(), b.times());
    let rows = 0..a.times().len();
    let pairs = rows.flat_map(|row| a.row(row).iter().zip(b.row(row)));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn linear_networks_take_the_one_step_method_and_others_cvode() {
    let method = |network: &Network| run(network, 100.0, |_| ()).method();
    for network in [gearbox(), rc_ladder(), stiff(), two_masses()] {
        assert_eq!(method(&network), Some(Method::OneStep));
    }
    let straight = one_node(50.0, "20 [degC]", "if(t < 30 [s], 5 [W], 2 [W/s] * t)");
    assert_eq!(method(&straight), Some(Method::OneStep));
    // inputs that curve
    assert_eq!(method(&nafems_t3()), Some(Method::Cvode));
    let curved = one_node(50.0, "20 [degC]", "1e-3 [W/s^2] * t^2");
    assert_eq!(method(&curved), Some(Method::Cvode));
    let mut b = NetworkBuilder::new();
    let ball = b.node("ball", HeatCapacity(500.0), Temperature(1000.0));
    let space = b.boundary("space", Temperature(0.0));
    radiation(&mut b, "glow", (ball, space), "0.05 m^2");
    let glowing = Transient::until(Time(10.0)).solve(&system(b)).unwrap();
    assert_eq!(glowing.method(), Some(Method::Cvode));
}

#[test]
fn cvode_is_taken_where_it_is_asked_for() {
    let solution = with(&gearbox(), 1500.0, IntegratorChoice::Cvode);
    assert_eq!(solution.method(), Some(Method::Cvode));
    assert!(apart(&solution, &run(&gearbox(), 1500.0, |_| ())) < 1e-4);
}

#[test]
fn the_one_step_method_is_refused_where_it_does_not_serve() {
    let mut transient = Transient::until(Time(10.0));
    transient.integrator = IntegratorChoice::OneStep;
    let refused = transient.solve(&ThermalSystem::assemble(&nafems_t3()).unwrap()).unwrap_err();
    let TransientError::Settings(SettingsError::OneStep { curved: true }) = refused else {
        panic!("{refused}")
    };
}

/// In J/K.
fn capacity(network: &Network) -> f64 {
    ThermalSystem::assemble(network).unwrap().capacity().iter().sum()
}

/// A random tree, sources that jump and ramp at odd times, massless nodes to eliminate; and the heat
/// of each source over 400 s.
fn random_network(random: &mut Random) -> (Network, Vec<f64>) {
    let mut b = NetworkBuilder::new();
    let count = 3 + random.below(40);
    let air = b.expression("20 [degC] + if(t < 137 [s], 0 [K], 5 [K])", None).unwrap();
    let air = b.boundary("air", air);
    let nodes: Vec<NodeId> = (0..count)
        .map(|i| match random.below(8) {
            0 if i > 0 => b.massless(&format!("n{i}")),
            _ => {
                let c = 10.0_f64.powf(random.between(-3.0, 3.0));
                b.node(&format!("n{i}"), HeatCapacity(c), Temperature(random.between(280.0, 330.0)))
            }
        })
        .collect();
    for i in 1..count {
        let g = Conductance(10.0_f64.powf(random.between(-2.0, 2.0)));
        b.resistor(&format!("r{i}"), nodes[random.below(i)], nodes[i], g);
    }
    let mut heats = Vec::new();
    for i in 0..=count / 8 {
        let node = nodes[random.below(count)];
        b.resistor(&format!("skin{i}"), node, air, Conductance(random.between(0.1, 2.0)));
        let (at, power) = (random.between(5.0, 390.0), random.between(1.0, 20.0));
        let (text, exact) = match random.below(2) {
            0 => (format!("if(t < {at} [s], 0 [W], {power} [W])"), power * (400.0 - at)),
            _ => (
                format!("if(t < {at} [s], {power} [W], {power} [W] - 0.02 [W/s] * t)"),
                power * 400.0 - 0.01 * (160_000.0 - at * at),
            ),
        };
        heats.push(exact);
        let heat = b.expression(&text, None).unwrap();
        b.source(&format!("heat{i}"), node, heat);
    }
    (b.build().unwrap(), heats)
}

/// Temperatures agree within the tolerances of both, the books close, and the heat of every source
/// is that of its closed form. With CVODE it was a tenth too small where tiny capacities followed a
/// ramp at once: nothing held the steps of the running integrals.
#[test]
fn all_integrators_find_the_same_on_random_networks() {
    let (mut random, mut compared) = (Random(16), 0);
    for _ in 0..60 {
        let (network, heats) = random_network(&mut random);
        for tolerance in [1e-3, 1e-6] {
            let of = |integrator| {
                run(&network, 400.0, |transient| {
                    (transient.tolerance, transient.integrator) = (tolerance, integrator);
                })
            };
            let (own, cvode) = (of(IntegratorChoice::Auto), of(IntegratorChoice::Cvode));
            let esdirk = of(IntegratorChoice::Esdirk);
            assert_eq!(esdirk.method(), Some(Method::Esdirk));
            for other in [&cvode, &esdirk] {
                assert!(apart(&own, other) < 10.0 * tolerance, "{}", apart(&own, other));
            }
            let sources = cvode.ledger().sources.iter().zip(&heats);
            for (found, exact) in sources.chain(esdirk.ledger().sources.iter().zip(&heats)) {
                let allowed = 10.0 * tolerance * (exact.abs() / 10.0 + capacity(&network));
                assert!((found - exact).abs() < allowed, "{found} {exact} {tolerance}");
            }
            if own.method() == Some(Method::Cvode) {
                continue; // eliminated nodes have left conductances that are too far apart
            }
            compared += 1;
            let open = own.ledger().relative_residual().unwrap();
            assert!(open.abs() < 1e-11, "{open}");
            for (found, exact) in own.ledger().sources.iter().zip(&heats) {
                assert!((found - exact).abs() < 1e-9 * exact.abs(), "{found} {exact}");
            }
        }
    }
    assert!(compared > 80, "{compared}");
}

/// A ball of 500 J/K that radiates to space, with a heat that jumps so often in 100 s, and a joint.
fn jumping(jumps: u32, more: &str) -> ThermalSystem {
    let parts = f64::from(jumps + 1);
    let jump = |k: u32| {
        let sign = if k.is_multiple_of(2) { '-' } else { '+' };
        format!(" {sign} if(t < {:?} [s], 5 [W], 0 [W])", 100.0 * f64::from(k) / parts)
    };
    let jumps: String = (1..=jumps).map(jump).collect();
    let text = format!(
        "format = 1\n[node]\nball = {{ C = \"500 J/K\", T0 = \"300 K\" }}\n[boundary]\nspace = \
         {{ T = \"absolute(4 [K])\" \
         }}\n[radiation]\nglow = {{ from = \"ball\", to = \"space\", emissivity = \"1\", area = \
         \"0.05 m^2\" }}\n[source]\nheat = \
         {{ into = \"ball\", P = \"10 [W]{jumps}\" }}\n{more}[run]\nstop = \"100 s\"\n"
    );
    let text = text.replace("\"300 K\"", "\"absolute(300 [K])\"");
    let netlist = lptn_netlist::parse("jumps.toml", &text).unwrap_or_else(|r| panic!("{r}"));
    ThermalSystem::assemble(&netlist.network).unwrap()
}

/// From twenty parts between jumps on; not where massless nodes have several solutions, nor where
/// a state is a heat content.
#[test]
fn many_parts_are_taken_by_a_runge_kutta_method() {
    let method = |system: &ThermalSystem, integrator| {
        let settings = Transient { integrator, ..Transient::until(Time(100.0)) };
        settings.at(&[]).solve(system).map(|solution| solution.method().unwrap())
    };
    let auto = |system: &ThermalSystem| method(system, IntegratorChoice::Auto).unwrap();
    assert_eq!(
        [18, 19, 40].map(|jumps| auto(&jumping(jumps, ""))),
        [Method::Cvode, Method::Esdirk, Method::Esdirk]
    );
    let joint = "[node.joint]\nmassless = true\n[resistor]\nlead = { from = \"joint\", to = \
        \"ball\", G = \"2 W/K\" }\n[source.own]\ninto = \
                 \"joint\"\nP = \"10 [W] * tanh((T - absolute(340 [K])) / 2 [K])\"\n";
    let several = jumping(30, joint);
    assert_eq!(auto(&several), Method::Cvode);
    let melts = "[node.wax]\nT0 = \"absolute(300 [K])\"\nC = \"100 [J/K] * factor(T - absolute(0 \
        [K]))\"\n[table]\nfactor = { x = [200, 400], x_unit = \
                 \"K\", y = [1, 2], outside = \"hold\" }\n[resistor]\nlead = { from = \"wax\", \
                 to = \"ball\", G = \"2 W/K\" }\n";
    let melts = jumping(30, melts);
    assert_eq!(auto(&melts), Method::Cvode);
    let refused = method(&melts, IntegratorChoice::Esdirk).unwrap_err();
    assert!(matches!(refused, TransientError::Settings(SettingsError::Esdirk)), "{refused}");
    assert_eq!(method(&jumping(3, ""), IntegratorChoice::Esdirk).unwrap(), Method::Esdirk);
}
