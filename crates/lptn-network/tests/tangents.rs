//! Tangents: derivatives of heat flows and heat contents by parameters against central differences,
//! and what has none.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{celsius, cooled, link, near, own, power, quantity, time};
use lptn_network::{
    Acts, Conductance, ConductorKind, Evaluation, Formula, HeatCapacity, Item, Melting, Network,
    NetworkBuilder, NoTangents, NodeId, ParameterId, Path, Positions, Properties, Size, Tangents,
    Temperature, Variable,
};

/// Heat into every vertex in W.
fn heat(network: &Network, at: f64, nodes: &[f64]) -> Vec<f64> {
    let mut scope = network.evaluation();
    scope.set_time(at, at);
    let mut temperatures = nodes.to_vec();
    temperatures.resize(nodes.len() + network.boundaries().len(), f64::NAN);
    network.boundary_temperatures(&mut scope, &mut temperatures[nodes.len()..]).unwrap();
    let mut out = vec![0.0; temperatures.len()];
    for id in network.conductor_ids() {
        let conductor = &network.conductors()[id.index()];
        let ends = [conductor.from, conductor.to].map(|end| network.vertex(end));
        let difference = temperatures[ends[0]] - temperatures[ends[1]];
        let received = match network.flow(id) {
            lptn_network::ConductorFlow::Conductance(g) => [-g * difference, g * difference],
            lptn_network::ConductorFlow::Radiation(gr) => {
                let q = 5.670_374_419e-8
                    * gr
                    * (temperatures[ends[0]].powi(4) - temperatures[ends[1]].powi(4));
                [-q, q]
            }
            lptn_network::ConductorFlow::Stream(rate) if rate > 0.0 => [0.0, rate * difference],
            lptn_network::ConductorFlow::Stream(rate) => [rate * difference, 0.0],
            lptn_network::ConductorFlow::Variable => {
                network.exchange(id, &mut scope, &temperatures).unwrap()
            }
        };
        ends.into_iter().zip(received).for_each(|(vertex, q)| out[vertex] += q);
    }
    let mut powers = vec![0.0; network.sources().len()];
    network.source_powers(&mut scope, &mut powers).unwrap();
    for id in network.source_ids() {
        if !network.source_variables(id).is_empty() {
            powers[id.index()] = network.source_heat(id, &mut scope, &temperatures).unwrap();
        }
        network.sources()[id.index()]
            .into
            .iter()
            .for_each(|(node, share)| out[node.index()] += share * powers[id.index()]);
    }
    out
}

fn moved(network: &Network, id: ParameterId, by: f64) -> Network {
    let mut other = network.given();
    other.set(id, network.parameter_value(id) + by);
    network.with(&other).unwrap()
}

/// Compares the derivatives by temperatures that are kept with differences, and the changes that are
/// kept with those that are not.
fn kept_agree(
    network: &Network,
    tangents: &mut Tangents,
    (scope, temperatures): (&mut Evaluation, &mut [f64]),
    changes: &[f64],
) -> usize {
    const STEP: f64 = 1e-3;
    tangents.keep_heats(network, scope, temperatures).unwrap();
    let weights: Vec<f64> = (1_u32..).map(f64::from).take(temperatures.len()).collect();
    let mut summed = vec![0.0; tangents.variables().len()];
    tangents.add_kept_against(&weights, &mut summed);
    for (sum, block) in summed.iter().zip(changes.chunks(weights.len())) {
        let expected: f64 = block.iter().zip(&weights).map(|(change, w)| change * w).sum();
        assert!((sum - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{sum} {expected}");
    }
    let mut checked = 0;
    for id in network.conductor_ids() {
        let Some(slopes) = tangents.kept_slopes(id) else { continue };
        checked += 1;
        let variables = network.conductor_variables(id);
        assert_eq!(slopes.len(), variables.len());
        for (&vertex, slope) in variables.iter().zip(slopes) {
            let own = temperatures[vertex as usize];
            let heats = [-STEP, STEP].map(|by| {
                temperatures[vertex as usize] = own + by;
                network.exchange(id, scope, temperatures).unwrap()
            });
            temperatures[vertex as usize] = own;
            for (end, slope) in slope.iter().enumerate() {
                let found = (heats[1][end] - heats[0][end]) / (2.0 * STEP);
                assert!((found - slope).abs() <= 1e-6 * slope.abs().max(1e-2), "{found} {slope}");
            }
        }
    }
    checked
}

/// Compares the derivatives of all heats and heat contents with differences, for all parameters
/// together. Returns the number of conductors whose derivatives by temperatures are kept.
fn agrees(network: &Network, ids: &[ParameterId], at: f64, nodes: &[f64]) -> usize {
    let mut tangents = network.tangents(ids).unwrap();
    assert!(tangents.variables().iter().copied().eq(ids.iter().copied().map(Variable::Parameter)));
    let mut scope = network.evaluation();
    scope.set_time(at, at);
    let vertices = nodes.len() + network.boundaries().len();
    let mut temperatures = nodes.to_vec();
    temperatures.resize(vertices, f64::NAN);
    network.boundary_temperatures(&mut scope, &mut temperatures[nodes.len()..]).unwrap();
    let mut found = vec![f64::NAN; vertices * ids.len()];
    tangents.heat(network, &scope, &temperatures, &mut found).unwrap();
    let kept = kept_agree(network, &mut tangents, (&mut scope, &mut temperatures), &found);
    let mut contents = vec![f64::NAN; nodes.len() * ids.len()];
    tangents.contents(network, &temperatures, &mut contents);
    for (k, &id) in ids.iter().enumerate() {
        let h = 1e-4 * network.parameter_value(id).abs();
        let (up, down) = (moved(network, id, h), moved(network, id, -h));
        let name = &network.parameters()[id.index()].name;
        let (a, b) = (heat(&up, at, nodes), heat(&down, at, nodes));
        for v in 0..vertices {
            let slope = (a[v] - b[v]) / (2.0 * h);
            let found = found[k * vertices + v];
            assert!(
                (found - slope).abs() <= 1e-6 * slope.abs().max(1e-2),
                "{name} {v}: {found} {slope}"
            );
        }
        for (v, &t) in nodes.iter().enumerate() {
            let slope = (content(&up, v, t) - content(&down, v, t)) / (2.0 * h);
            let found = contents[k * nodes.len() + v];
            assert!(
                (found - slope).abs() <= 1e-5 * slope.abs().max(1e-1),
                "content {name} {v}: {found} {slope}"
            );
        }
    }
    kept
}

/// The heat content of a node at a temperature, zero at its start.
fn content(network: &Network, node: usize, t: f64) -> f64 {
    let id = network.node_ids().nth(node).unwrap();
    if network.nodes()[node].massless {
        return 0.0;
    }
    match network.enthalpy(id) {
        Some(curve) => curve.heat(t).unwrap(),
        None => network.capacity(id) * (t - network.initial(id)),
    }
}

fn parameters(b: &mut NetworkBuilder, all: &[(&str, &str)]) -> Vec<ParameterId> {
    all.iter()
        .map(|(name, text)| {
            let value = if text.ends_with("degC") { celsius(text) } else { quantity(text) };
            b.parameter(name, value)
        })
        .collect()
}

fn three(b: &mut NetworkBuilder) -> [NodeId; 3] {
    ["x", "y", "z"].map(|n| b.node(n, HeatCapacity(5.0), Temperature(300.0)))
}

const AT: [f64; 3] = [350.0, 320.0, 305.0];

/// A variable that is an expression of another one is a separate one, in whichever pass both are.
#[test]
fn variables_that_follow_others_are_separate_in_every_order() {
    let mut b = NetworkBuilder::new();
    let mut ids = parameters(&mut b, &[("p", "1 W"), ("q", "2 W"), ("r", "3 W"), ("s", "4 W")]);
    let twice = time(&b, "2 * p");
    ids.push(b.parameter("double", twice));
    let x = b.node("x", HeatCapacity(5.0), Temperature(300.0));
    let sum = power(&b, "p + q + r + s + double");
    b.source("heat", x, sum);
    let network = b.build().unwrap();
    for shift in 0..ids.len() {
        ids.rotate_left(1);
        let variables: Vec<Variable> = ids.iter().copied().map(Variable::Parameter).collect();
        let mut tangents = network.tangents_at_a_moment(&variables).unwrap();
        let mut found = vec![f64::NAN; ids.len()];
        tangents.heat(&network, &network.evaluation(), &[300.0], &mut found).unwrap();
        assert_eq!(found, [1.0; 5], "{shift}");
    }
}

/// A chain of 40 nodes with a conductance each, of which some are shared, summed or scaled together:
/// variables that change nothing in common are followed in one place, and each column is that of
/// its variable alone. The heat of a conductance changes by the difference of its ends.
#[test]
fn variables_with_nothing_in_common_keep_their_columns() {
    let mut b = NetworkBuilder::new();
    let names: Vec<String> = (0..40).map(|k| format!("G{k}")).collect();
    let all: Vec<(&str, &str)> = names.iter().map(|name| (name.as_str(), "2 W/K")).collect();
    let mut ids = parameters(&mut b, &all);
    ids.extend(parameters(&mut b, &[("scale", "1.5"), ("C", "7 J/K"), ("T_air", "15 degC")]));
    let sum = time(&b, "G3 + G4");
    b.parameter("sum", sum);
    let t_air = time(&b, "T_air");
    let air = b.boundary("air", t_air);
    let mut before: lptn_network::End = air.into();
    for k in 0..40 {
        let content = if k % 8 == 0 { time(&b, "C") } else { quantity("5 J/K") };
        let node = b.node(&format!("n{k}"), content, Temperature(300.0));
        let law = match k {
            7 => time(&b, "sum"),
            _ if k % 10 == 9 => time(&b, &format!("scale * G{k}")),
            _ => time(&b, &format!("G{k}")),
        };
        b.resistor(&format!("r{k}"), before, node, Path::conductance(law));
        before = node.into();
    }
    let network = b.build().unwrap();
    let nodes: Vec<f64> = (0..40).map(|k| 300.0 + f64::from(k * k % 17)).collect();
    agrees(&network, &ids, 0.0, &nodes);
    let temperatures: Vec<f64> = nodes.iter().copied().chain([288.15]).collect();
    let columns = |ids: &[ParameterId]| {
        let mut heats = vec![f64::NAN; ids.len() * temperatures.len()];
        let mut tangents = network.tangents(ids).unwrap();
        tangents.heat(&network, &network.evaluation(), &temperatures, &mut heats).unwrap();
        heats
    };
    let together = columns(&ids);
    for (id, column) in ids.iter().zip(together.chunks(temperatures.len())) {
        assert_eq!(columns(&[*id]), column, "{}", network.parameters()[id.index()].name);
    }
    near(together[2 * temperatures.len() + 2], nodes[1] - nodes[2]);
    near(together[4 * temperatures.len() + 7], nodes[6] - nodes[7]);
}

/// More parameters than one pass takes, one of them an expression of another.
#[test]
fn every_law_by_its_parameters() {
    let mut b = NetworkBuilder::new();
    let mut ids = parameters(
        &mut b,
        &[
            ("R", "2 K/W"),
            ("h", "8 W/(m^2 K)"),
            ("area", "0.5 m^2"),
            ("e", "0.7"),
            ("mcp", "3 W/K"),
            ("T_air", "15 degC"),
            ("P", "40 W"),
            ("slope", "0.3 W/K"),
        ],
    );
    let twice = time(&b, "2 * R");
    b.parameter("R2", twice);
    let [x, y, z] = three(&mut b);
    let t = time(&b, "T_air + 1 [K/s] * t");
    let air = b.boundary("air", t);
    let (r, r2, h, area) = (time(&b, "R"), time(&b, "R2"), time(&b, "h"), time(&b, "area"));
    b.resistor("r", x, y, Path::resistance(r));
    b.resistor("r2", y, z, Path::resistance(r2));
    b.resistor("fixed", z, air, Conductance(0.7));
    b.convection("film", x, air, Path::film(h, area.clone()));
    let exchange =
        Path::new(Formula::ParallelPlates, [time(&b, "e"), quantity("0.9"), area, quantity("0.8")]);
    b.conductor("glow", ConductorKind::Radiation, (y.into(), air.into()), exchange);
    let rate = Path::stream(time(&b, "mcp * (1 + t / 10 [s])"));
    b.conductor("wind", ConductorKind::Advection, (air.into(), x.into()), rate);
    let g = link(&b, "slope * kelvin(T_mean) / 300 [K] + 0.001 [W/K^2] * (z.T - air.T)");
    b.resistor("varying", x, z, Path::conductance(g));
    let p = time(&b, "P * (1 + t / 5 [s])");
    b.shared_source("p", &[(x, 0.25), (z, 0.75)], p);
    let p = power(&b, "slope * (T - air.T)");
    b.source("own", y, p);
    let course = time(&b, "P / 2 + slope * t * 1 [K/s]");
    b.signal_expression("course", course);
    let p = time(&b, "course");
    b.source("by_signal", z, p);
    let network = b.build().unwrap();
    assert!(agrees(&network, &ids, 2.0, &AT) > 0);
    ids.reverse();
    agrees(&network, &ids[..3], 0.0, &AT);
    agrees(&network, &[], 0.0, &AT);
    // given in place of its expression it no longer follows
    let given = {
        let mut other = network.overrides();
        other.set(network.parameter("R2").unwrap(), 5.0);
        network.with(&other).unwrap()
    };
    agrees(&given, &ids, 1.0, &AT);
    agrees(&given, &[network.parameter("R2").unwrap()], 1.0, &AT);
}

/// Bodies whose conductivity depends on its own temperature and on parameters, on time too.
#[test]
fn conductivities_over_temperature() {
    let mut b = NetworkBuilder::new();
    let ids = parameters(
        &mut b,
        &[("k0", "15 W/(m K)"), ("c", "40 K"), ("area", "0.01 m^2"), ("T_air", "15 degC")],
    );
    let [x, y, z] = three(&mut b);
    let t = time(&b, "T_air");
    let air = b.boundary("air", t);
    let bent = "k0 * (exp((T - absolute(300 [K])) / c) + 0.02 [1/K] * abs(T - absolute(331 [K])))";
    let timed = "k0 * (1 + t / 9 [s]) * (kelvin(T) / 300 [K])^2";
    for (name, k, ends) in
        [("bar", bent, (x.into(), y.into())), ("rod", timed, (z.into(), air.into()))]
    {
        let values = [own(&b, k), time(&b, "area"), quantity("30 mm")];
        b.conductor(name, ConductorKind::Conduction, ends, Path::new(Formula::Slab, values));
    }
    b.resistor("r", y, z, Conductance(1.0));
    let network = b.build().unwrap();
    agrees(&network, &ids, 2.0, &AT);
    agrees(&network, &ids, 2.0, &[320.0, 320.0, 370.0]);
}

#[test]
fn streams_of_fluids() {
    let mut b = NetworkBuilder::new();
    let ids = parameters(
        &mut b,
        &[
            ("flow", "0.02 kg/s"),
            ("cp", "2000 J/(kg K)"),
            ("rho", "900 kg/m^3"),
            ("T_air", "15 degC"),
        ],
    );
    let [x, y, z] = three(&mut b);
    let t = time(&b, "T_air");
    let air = b.boundary("air", t);
    b.resistor("r", y, z, Conductance(1.0));
    let (cp, density) = (time(&b, "cp"), own(&b, "rho * (1 - 7e-4 [1/K] * (T - 20 [degC]))"));
    let oil = b.fluid("oil", Some(density), cp, None);
    let flow = time(&b, "flow");
    let mut stream = |name: &str, from: lptn_network::End, to: lptn_network::End, of: Path| {
        b.conductor(name, ConductorKind::Advection, (from, to), of);
    };
    stream("mass", x.into(), y.into(), Path::of_fluid(Formula::MassFlow, oil, [flow]));
    stream(
        "volume",
        air.into(),
        x.into(),
        Path::of_fluid(Formula::VolumeFlow, oil, [quantity("1e-5 m^3/s"), celsius("40 degC")]),
    );
    agrees(&b.build().unwrap(), &ids, 0.0, &AT);
}

#[test]
fn capacities_of_every_form() {
    let mut b = NetworkBuilder::new();
    let ids = parameters(
        &mut b,
        &[
            ("C", "5 J/K"),
            ("m", "2 kg"),
            ("T_start", "25 degC"),
            ("slope", "0.02 J/K^2"),
            ("cp", "400 J/(kg K)"),
        ],
    );
    let (c, start) = (time(&b, "C"), time(&b, "T_start"));
    let x = b.node("x", c, start.clone());
    b.capacitor("more", x, HeatCapacity(3.0));
    // a size times a property of temperature
    let cp = own(&b, "500 [J/(kg K)] * kelvin(T) / 300 [K]");
    let density = Some(quantity("8000 kg/m^3"));
    let steel = b.material("steel", Properties { density, cp: Some(cp), ..Properties::default() });
    let mass = time(&b, "m");
    let lump = b.lump(steel, Size::Mass(mass)).unwrap();
    b.node("y", lump, start.clone());
    // a property that changes by itself, and a part beside it
    let own_c = own(&b, "10 [J/K] + slope * (T - 0 [degC]) + C");
    let z = b.node("z", own_c, start);
    let part = time(&b, "m * cp");
    b.capacitor("part", z, part);
    b.boundary("air", Temperature(290.0));
    agrees(&b.build().unwrap(), &ids, 0.0, &AT);
}

#[test]
fn what_has_no_tangents() {
    // events, wherever they are
    let (mut b, a, _) = cooled();
    let ids = parameters(&mut b, &[("P", "5 W"), ("t_on", "20 s")]);
    let fan = b.control("fan");
    b.thermostat(fan, common::thermostat(a, Acts::Cooling, 310.0, 300.0));
    let p = time(&b, "P");
    b.source("p", a, p);
    let network = b.build().unwrap();
    let refusal = network.tangents(&ids[..1]).unwrap_err();
    assert_eq!(refusal, NoTangents::Events { item: Item::Control(fan) });
    assert_eq!(
        refusal.describe(&network),
        "`fan` switches, at times that move with the parameters"
    );
    // a jump that moves
    let (mut b, a, _) = cooled();
    let ids = parameters(&mut b, &[("P", "5 W"), ("t_on", "20 s")]);
    let p = time(&b, "if(t < t_on, 0 [W], P)");
    let jump = b.source("jump", a, p);
    let network = b.build().unwrap();
    assert_eq!(
        network.tangents(&ids).unwrap_err(),
        NoTangents::MovingJump { item: Item::Source(jump) }
    );
    assert!(network.tangents(&ids).unwrap_err().describe(&network).starts_with("`jump` jumps"));
    agrees(&network, &ids[..1], 30.0, &[300.0]);
    // melting that changes
    let mut b = NetworkBuilder::new();
    let ids = parameters(&mut b, &[("T_melt", "50 degC"), ("m", "2 kg")]);
    let (solidus, liquidus) = (time(&b, "T_melt"), time(&b, "T_melt + 5 [K]"));
    let melting = Some(Melting { solidus, liquidus, heat: quantity("2e5 J/kg") });
    let wax = b.material(
        "wax",
        Properties { cp: Some(quantity("2000 J/(kg K)")), melting, ..Properties::default() },
    );
    let mass = time(&b, "m");
    let lump = b.lump(wax, Size::Mass(mass)).unwrap();
    let node = b.node("x", lump, Temperature(300.0));
    let network = b.build().unwrap();
    assert_eq!(network.tangents(&ids[..1]).unwrap_err(), NoTangents::Melting { node });
    assert!(
        network.tangents(&ids[..1]).unwrap_err().describe(&network).starts_with("how `x` melts")
    );
    agrees(&network, &ids[1..], 0.0, &[310.0]);
    // a fluid whose heat content changes
    let mut b = NetworkBuilder::new();
    let ids = parameters(&mut b, &[("scale", "2 J/(kg K)")]);
    let cp = own(&b, "scale * kelvin(T) / 1 [K]");
    let fluid = b.fluid("gas", None, cp, None);
    let [x, y, _] = three(&mut b);
    let path = Path::of_fluid(Formula::MassFlow, fluid, [quantity("1 kg/s")]);
    b.conductor("s", ConductorKind::Advection, (x.into(), y.into()), path);
    let network = b.build().unwrap();
    assert_eq!(network.tangents(&ids).unwrap_err(), NoTangents::Fluid { fluid });
    assert!(network.tangents(&ids).unwrap_err().describe(&network).contains("`gas`"));
}

/// At one moment events do not matter, and a signal is a variable: `scale drive (1 + fan)` W.
#[test]
fn a_moment_has_tangents_by_signals_in_every_position() {
    let (mut b, a, _) = cooled();
    let [scale] = parameters(&mut b, &[("scale", "5 W")])[..] else { panic!("one parameter") };
    let own = time(&b, "2 + t / 10 [s]");
    let drive = b.signal_expression("drive", own);
    let follows = time(&b, "3 * drive");
    b.signal_expression("follows", follows);
    let fan = b.control("fan");
    b.thermostat(fan, common::thermostat(a, Acts::Cooling, 310.0, 300.0));
    let heat = power(&b, "scale * follows * (1 + fan)");
    b.source("p", a, heat);
    let network = b.build().unwrap();
    let variables = [Variable::Signal(drive), Variable::Parameter(scale)];
    let mut tangents = network.tangents_at_a_moment(&variables).unwrap();
    assert_eq!(tangents.variables(), variables);
    for (is_on, factor) in [(false, 1.0), (true, 2.0)] {
        let mut scope = network.evaluation();
        let positions = Positions { controls: vec![is_on], switches: vec![] };
        scope.set_positions(&positions);
        scope.set_time(10.0, 10.0);
        let mut out = vec![0.0; 4];
        tangents.heat(&network, &scope, &[320.0, 290.0], &mut out).unwrap();
        assert!((out[0] - 5.0 * 3.0 * factor).abs() < 1e-12, "{out:?}");
        assert!((out[2] - 9.0 * factor).abs() < 1e-12, "{out:?}");
    }
}
