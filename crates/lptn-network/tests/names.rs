//! Names and ids: what is found by which name, what is suggested, numbers for names, what results
//! can be asked for.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{cooled, near, quantity, time};
use lptn_network::{
    Conductance, ConductorKind, End, HeatCapacity, HeatFlow, HeatOf, Item, NetworkBuilder,
    ParameterError, Path, Temperature, Time, list_of, list_of_names,
};
use lptn_units::{Dimension, Expression, Type, parse_quantity};

#[test]
fn items_nodes_and_parameters_by_name() {
    let (mut b, a, air) = cooled();
    b.title("a cooled body");
    let part = b.capacitor("part", a, HeatCapacity(1.0));
    let heat = b.source("heat", a, HeatFlow(1.0));
    let scale = b.parameter("scale", HeatFlow(3.0));
    let junction = b.massless("junction");
    let link = b.resistor("link", a, junction, Conductance(1.0));
    assert_eq!(b.item("part"), Some(Item::Capacitor(part)));
    assert_eq!(
        (b.end("a"), b.end("air"), b.end("heat"), b.end("b")),
        (Some(a.into()), Some(air.into()), None, None)
    );
    assert_eq!(b.end_names(false).collect::<Vec<_>>(), ["a", "junction", "air"]);
    assert_eq!(b.end_names(true).collect::<Vec<_>>(), ["a", "junction"]);
    let counts = (b.node_count(), b.boundary_count(), b.conductor_count(), b.source_count());
    assert_eq!(counts, (2, 1, 2, 1));
    assert_eq!(b.node_ids().collect::<Vec<_>>(), [a, junction]);
    assert!(b.is_massless(junction) && !b.is_massless(a) && !b.is_part(Item::Node(a)));
    b.start_at(a, Temperature(333.0));
    b.start_at(junction, Temperature(333.0));
    let network = b.build().unwrap();
    near(network.initial(a), 333.0);
    assert!(network.initial(junction).is_nan());
    assert_eq!(network.nodes()[junction.index()].stood, Some(333.0));
    assert_eq!(network.title(), Some("a cooled body"));
    for (name, item) in [
        ("a", Item::Node(a)),
        ("air", Item::Boundary(air)),
        ("part", Item::Capacitor(part)),
        ("heat", Item::Source(heat)),
        ("link", Item::Conductor(link)),
    ] {
        assert_eq!(network.item(name), Ok(item));
        assert_eq!(network.name_of(item), name);
    }
    assert_eq!(network.name_of(Item::Parameter(scale)), "scale");
    let unknown = network.item("heet").unwrap_err();
    assert_eq!((unknown.name.as_str(), unknown.suggestion.as_deref()), ("heet", Some("heat")));
    assert_eq!(unknown.to_string(), "nothing is named `heet`, did you mean `heat`?");
    assert_eq!(network.item("zzzzzz").unwrap_err().to_string(), "nothing is named `zzzzzz`");
    assert_eq!(network.node("junction"), Ok(junction));
    assert_eq!(network.node("junctoin").unwrap_err().suggestion.as_deref(), Some("junction"));
    assert!(network.node("air").is_err() && network.node("scale").is_err());
    assert_eq!(network.parameter("scale"), Ok(scale));
    assert_eq!(network.parameter("scala").unwrap_err().suggestion.as_deref(), Some("scale"));
    let counts =
        (network.node_ids().len(), network.boundary_ids().len(), network.conductor_ids().len());
    assert_eq!(counts, (2, 1, 2));
    assert_eq!(
        (network.source_ids().len(), network.parameter_ids().len(), network.table_ids().len()),
        (1, 1, 0)
    );
    assert_eq!(network.node_ids().map(|id| id.index()).collect::<Vec<_>>(), [0, 1]);
    assert_eq!(
        (network.vertex(a.into()), network.vertex(junction.into()), network.vertex(air.into())),
        (0, 1, 2)
    );
    assert_eq!(network.linear_massless(), [false, true]);
}

#[test]
fn lists_of_names() {
    let names: Vec<String> = ["a", "b", "c", "d", "e"].map(str::to_owned).to_vec();
    assert_eq!(list_of_names(&[]), "");
    assert_eq!(list_of_names(&names[..1]), "`a`");
    assert_eq!(list_of_names(&names[..2]), "`a` and `b`");
    assert_eq!(list_of_names(&names[..3]), "`a`, `b` and `c`");
    assert_eq!(list_of_names(&names), "`a`, `b` and 3 more nodes");
    assert_eq!(list_of(&names, "limits"), "`a`, `b` and 3 more limits");
}

#[test]
fn conductors_and_sources_without_names_are_called_by_their_numbers() {
    let (mut b, a, air) = cooled();
    let ends: (End, End) = (a.into(), air.into());
    let path = || Path::conductance(Conductance(2.0));
    let ids: Vec<_> =
        [4, 5, 9].map(|n| b.numbered_conductor(n, ConductorKind::Resistor, ends, path())).to_vec();
    let sources: Vec<_> =
        [2, 3].map(|n| b.numbered_source(n, a.into(), HeatFlow(1.0).into())).to_vec();
    let named = b.resistor("named", a, air, Conductance(1.0));
    let network = b.build().unwrap();
    let conductor = |n: u32| network.item(&format!("import.conductor[{n}]"));
    assert_eq!(conductor(4), Ok(Item::Conductor(ids[0])));
    assert_eq!(conductor(5), Ok(Item::Conductor(ids[1])));
    assert_eq!(conductor(9), Ok(Item::Conductor(ids[2])));
    for nowhere in [1, 3, 6, 7, 10] {
        assert!(conductor(nowhere).is_err(), "{nowhere}");
    }
    assert!(
        network.item("import.conductor[04]").is_err()
            && network.item("import.conductor[+4]").is_err()
    );
    assert_eq!(network.item("import.source[3]"), Ok(Item::Source(sources[1])));
    assert!(network.item("import.source[4]").is_err() && network.item("import.node[3]").is_err());
    assert_eq!(network.item("named"), Ok(Item::Conductor(named)));
    assert_eq!(network.name_of(Item::Conductor(ids[2])), "import.conductor[9]");
    assert_eq!(network.name_of(Item::Source(sources[0])), "import.source[2]");
    near(network.conductance(ids[1]).unwrap(), 2.0);
}

#[test]
fn sets_of_nodes_that_reach_no_boundary() {
    let (mut b, a, _) = cooled();
    let [w, x, y, z] =
        ["w", "x", "y", "z"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(300.0)));
    b.resistor("zx", z, x, Conductance(1.0));
    b.resistor("aw", a, w, Conductance(1.0));
    assert_eq!(b.build().unwrap().ungrounded(), [vec![x, z], vec![y]]);
    let (b, ..) = cooled();
    assert!(b.build().unwrap().ungrounded().is_empty());
}

/// Which heat flows there are, and the order in which those that are named are handed over.
#[test]
fn heat_flows_of_results() {
    let (mut b, a, air) = cooled();
    let rate = Path::stream(quantity("5 W/K"));
    let wind = b.conductor("wind", ConductorKind::Advection, (air.into(), a.into()), rate);
    let heat = b.source("heat", a, HeatFlow(4.0));
    let value = b.post_expression("heat.P - 2 * cool.Q + wind.Q_to + heat.P", None).unwrap();
    let total = b.report("total", value.into(), "heat.P - ...");
    let value = b.post_expression("(a.T - air.T) * (1 [W/K]) + air.Q", None).unwrap();
    let other = b.report("other", value.into(), "(a.T - ...");
    let scope = b.scope(lptn_network::Context::Result);
    let names = lptn_units::Scope::names(&scope);
    for name in ["cool.Q", "wind.Q_from", "wind.Q_to", "heat.P", "air.Q", "a.T", "air.T", "t"] {
        assert!(names.iter().any(|known| known == name), "{name} {names:?}");
    }
    assert!(!names.iter().any(|known| known == "wind.Q"));
    for wrong in ["wind.Q", "cool.Q_to", "cool.P", "heat.Q", "a.Q", "air.P"] {
        let expression = Expression::parse(wrong).unwrap();
        b.name_heats(&expression);
        let error = expression.compile(&b.post_scope(), None).unwrap_err();
        assert_eq!(error[0].code(), "units::unknown_name", "{wrong}");
    }
    let network = b.build().unwrap();
    let named: Vec<String> = network.named_heats().map(|of| of.name(&network)).collect();
    assert_eq!(named, ["heat.P", "cool.Q", "wind.Q_to", "air.Q"]);
    assert_eq!(network.heats_of(wind), [HeatOf::ReceivedFrom(wind), HeatOf::ReceivedTo(wind)]);
    assert_eq!(HeatOf::ReceivedFrom(wind).name(&network), "wind.Q_from");
    assert_eq!(HeatOf::Source(heat).item(), Item::Source(heat));
    assert_eq!(HeatOf::ReceivedTo(wind).item(), Item::Conductor(wind));
    assert_eq!(HeatOf::Boundary(air).item(), Item::Boundary(air));
    let mut scope = network.evaluation();
    scope.set_heats(&[10.0, 1.0, 300.0, 5000.0]);
    scope.set_temperatures(&[320.0], &[290.0]);
    near(network.report_value(total, &mut scope).unwrap(), 10.0 - 2.0 + 300.0 + 10.0);
    near(network.report_value(other, &mut scope).unwrap(), 30.0 + 5000.0);
    assert_eq!((network.reports().len(), network.report_ids().len()), (2, 2));
    assert_eq!(network.reports()[0].ty, Type::of(Dimension::POWER));
    let error = network.report_value(total, &mut network.evaluation()).unwrap_err();
    assert_eq!(error.name, "total");
}

#[test]
fn no_report_prints_a_negative_zero() {
    let (mut b, ..) = cooled();
    let value = b.post_expression("(-1) * air.Q", None).unwrap();
    let id = b.report("zero", value.into(), "");
    let network = b.build().unwrap();
    let mut scope = network.evaluation();
    scope.set_heats(&[0.0]);
    assert!(network.report_value(id, &mut scope).unwrap().is_sign_positive());
}

#[test]
fn parameters_are_set_by_name_id_and_text() {
    let mut b = NetworkBuilder::new();
    let r = b.parameter("R", parse_quantity("2 ± 0.1 K/W", None).unwrap());
    let g_text = b.expression("4 / R", None).unwrap();
    let g = b.parameter("G", g_text);
    let a = b.node("a", HeatCapacity(10.0), Temperature(300.0));
    let air = b.boundary("air", Temperature(290.0));
    let value = time(&b, "G");
    let cool = b.resistor("cool", a, air, Path::conductance(value));
    let network = b.build().unwrap();
    let numbers = |n: &lptn_network::Network| {
        (n.parameter_value(r), n.parameter_value(g), n.conductance(cool).unwrap())
    };
    assert_eq!(numbers(&network), (2.0, 2.0, 2.0));
    assert!((network.parameters()[0].deviation.unwrap().sigma(2.0) - 0.1).abs() < 1e-12);
    let mut other = network.overrides();
    assert_eq!(other.set_text("R", "8 ± 0.2 K/W").unwrap(), r);
    assert!(
        (other.deviation(r).unwrap().sigma(8.0) - 0.2).abs() < 1e-12
            && other.deviation(g).is_none()
    );
    let second = network.with(&other).unwrap();
    assert_eq!(numbers(&second), (8.0, 0.5, 0.5));
    let mut third = second.given();
    third.set(g, 7.0);
    assert_eq!(numbers(&second.with(&third).unwrap()), (8.0, 7.0, 7.0));
    let plain = network.given();
    assert_eq!(numbers(&network.with(&plain).unwrap()), (2.0, 2.0, 2.0));
    other.set(r, -1.0);
    let errors = network.with(&other).unwrap_err().0;
    assert_eq!(errors[0].code(), "network::not_positive");
    other.set(r, f64::NAN);
    assert_eq!(network.with(&other).unwrap_err().0[0].code(), "network::not_finite");
    let ParameterError::Unknown(unknown) = other.set_text("r", "1 K/W").unwrap_err() else {
        panic!()
    };
    assert_eq!((unknown.name.as_str(), unknown.suggestion.as_deref()), ("r", Some("R")));
    let error = other.set_text("R", "1 W/K").unwrap_err();
    assert!(matches!(&error, ParameterError::Unit { name, .. } if name == "R"));
    assert!(error.to_string().starts_with("`R`: "), "{error}");
    let (stranger, ..) = cooled();
    let errors = stranger.build().unwrap().with(&network.overrides()).unwrap_err().0;
    assert_eq!(errors[0].code(), "network::foreign_parameters");
    assert!(network.parameter_slot(r) != network.parameter_slot(g));
    let mut scope = network.evaluation();
    near(lptn_network::Value::Expression(b_expression(&network)).at(&mut scope).unwrap(), 4.0);
}

fn b_expression(network: &lptn_network::Network) -> std::sync::Arc<lptn_units::Program> {
    Expression::parse("R * G").unwrap().compile(&network.post_scope(), None).unwrap().into()
}

#[test]
fn typed_numbers_are_si() {
    near(Temperature::celsius(25.0).0, 298.15);
    near(Temperature(300.0).in_celsius(), 26.85);
    near(Time::minutes(2.5).0, 150.0);
    near(Time::hours(2.0).0, 7200.0);
}
