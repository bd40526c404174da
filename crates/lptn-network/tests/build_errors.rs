//! Builder: every way in which a network can be wrong, by its code.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{Fault, codes, cooled, every, link, own, power, quantity, thermostat, time};
use lptn_network::{
    Acts, Area, BoundaryId, BuildErrorKind, Conductance, ConductorKind, Context, Formula,
    HeatCapacity, HeatFlow, Item, Melting, NetworkBuilder, NodeId, Path, Properties, Resistance,
    Temperature,
};

fn conduct(b: &mut NetworkBuilder, (a, air): (NodeId, BoundaryId), path: Path) {
    b.conductor("x", ConductorKind::Conduction, (a.into(), air.into()), path);
}

fn cylinder(inner: &str, outer: &str) -> Path {
    let shape =
        |k| Path::new(Formula::Cylinder, [k, quantity(inner), quantity(outer), quantity("1 m")]);
    shape(quantity("1 W/(m K)"))
}

fn surfaces(emissivity: &str, view_factor: &str) -> Path {
    Path::new(
        Formula::GreySurfaces,
        [quantity(emissivity), quantity("1 m^2"), quantity(view_factor)],
    )
}

#[test]
fn a_network_without_a_fault_is_built() {
    let (b, ..) = cooled();
    assert_eq!(codes(b), [""; 0]);
}

#[test]
fn names() {
    every(&[
        ("duplicate_name", |b, _, _| _ = b.boundary("a", Temperature(1.0))),
        ("duplicate_name", |b, a, _| _ = b.source("cool", a, HeatFlow(1.0))),
        ("duplicate_name", |b, _, _| {
            b.parameter("p", HeatFlow(1.0));
            let value = time(b, "2 * t");
            b.signal_expression("p", value);
        }),
        ("", |b, _, _| _ = b.parameter("a", HeatFlow(1.0))), // names of values are apart from those of elements
        ("bad_name", |b, a, _| _ = b.source("1x", a, HeatFlow(1.0))),
        ("bad_name", |b, _, _| _ = b.parameter("p q", HeatFlow(1.0))),
        ("reserved_name", |b, _, _| _ = b.parameter("t", HeatFlow(1.0))),
        ("reserved_name", |b, a, _| _ = b.source("import.source[3]", a, HeatFlow(1.0))),
        ("", |b, a, _| _ = b.source("import.other[3]", a, HeatFlow(1.0))),
    ]);
}

#[test]
fn numbers_out_of_range() {
    every(&[
        ("not_positive", |b, a, air| _ = b.resistor("x", a, air, Conductance(0.0))),
        ("not_positive", |b, a, air| _ = b.resistor("x", a, air, Conductance(-1.0))),
        ("not_positive", |b, a, air| _ = b.resistor("x", a, air, Conductance(f64::INFINITY))),
        ("not_positive", |b, a, air| _ = b.resistor("x", a, air, Resistance(f64::NAN))),
        ("not_positive", |b, a, air| _ = b.resistor("x", a, air, Resistance(0.0))),
        ("not_positive", |b, a, air| {
            let path = Path::film(quantity("1e300 W/(m^2 K)"), quantity("1e300 m^2"));
            b.convection("x", a, air, path);
        }),
        ("not_positive", |b, a, _| _ = b.capacitor("x", a, HeatCapacity(0.0))),
        ("not_positive", |b, _, _| _ = b.node("x", HeatCapacity(-2.0), Temperature(300.0))),
        ("not_positive", |b, a, _| b.length(a, quantity("0 m"))),
        ("not_finite", |b, a, _| _ = b.source("x", a, HeatFlow(f64::NAN))),
        ("not_finite", |b, a, _| _ = b.source("x", a, HeatFlow(f64::INFINITY))),
        ("not_finite", |b, _, _| _ = b.boundary("x", Temperature(f64::INFINITY))),
        ("not_finite", |b, _, _| _ = b.parameter("x", HeatFlow(f64::NEG_INFINITY))),
        ("not_finite", |b, a, air| conduct(b, (a, air), Path::stream(Conductance(f64::NAN)))),
        ("below_absolute_zero", |b, _, _| _ = b.boundary("x", Temperature(-0.5))),
        ("below_absolute_zero", |b, _, _| _ = b.parameter("x", Temperature(-0.5))),
        ("below_absolute_zero", |b, _, _| _ = b.node("x", HeatCapacity(2.0), Temperature(-300.0))),
        ("", |b, _, _| _ = b.boundary("x", Temperature(0.0))),
        ("not_a_fraction", |b, a, air| conduct(b, (a, air), surfaces("1.5", "1"))),
        ("not_a_fraction", |b, a, air| conduct(b, (a, air), surfaces("0.5", "0"))),
        ("", |b, a, air| conduct(b, (a, air), surfaces("1", "1"))),
        ("radii", |b, a, air| conduct(b, (a, air), cylinder("2 m", "1 m"))),
        ("radii", |b, a, air| conduct(b, (a, air), cylinder("2 m", "2 m"))),
        ("", |b, a, air| conduct(b, (a, air), cylinder("1 m", "2 m"))),
        ("not_positive", |b, a, air| conduct(b, (a, air), cylinder("0 m", "2 m"))),
        ("shares", |b, a, _| _ = b.shared_source("x", &[(a, 0.9)], HeatFlow(1.0))),
        ("shares", |b, a, _| _ = b.shared_source("x", &[(a, 1.1)], HeatFlow(1.0))),
        ("shares", |b, a, _| _ = b.shared_source("x", &[(a, 1.5), (a, -0.5)], HeatFlow(1.0))),
        ("shares", |b, _, _| _ = b.shared_source("x", &[], HeatFlow(1.0))),
        ("", |b, a, _| _ = b.shared_source("x", &[(a, 1.0), (a, 0.0)], HeatFlow(1.0))),
    ]);
}

/// A law takes one value for each of its fields, and a fluid only where it carries one: more or
/// less is told, not read.
#[test]
fn values_that_are_not_those_of_the_law() {
    let told = |path: Path| {
        let (mut b, a, air) = cooled();
        conduct(&mut b, (a, air), path);
        codes(b)
    };
    let h = || quantity("5 W/(m^2 K)");
    let fluid = cooled().0.fluid("oil", None, quantity("2000 J/(kg K)"), None);
    for path in [
        Path::new(Formula::Film, [h()]),
        Path::new(Formula::Film, vec![h(); 9]),
        Path::new(Formula::Conductance, Vec::new()),
        Path::new(Formula::MassFlow, [quantity("1 kg/s")]),
        Path::of_fluid(Formula::Conductance, fluid, [quantity("1 W/K")]),
    ] {
        assert_eq!(told(path.clone()), ["network::law_values"], "{path:?}");
    }
    assert_eq!(told(Path::film(h(), quantity("1 m^2"))), [""; 0]);
    let of_another = Path::of_fluid(Formula::MassFlow, fluid, [quantity("1 kg/s")]);
    assert_eq!(told(of_another), ["network::foreign_id"]);
}

#[test]
fn types_of_every_field() {
    let wrong = |fault: Fault, count: usize| {
        let (mut b, a, air) = cooled();
        fault(&mut b, a, air);
        let errors = b.build().unwrap_err().0;
        let of_type = errors.iter().filter(|error| error.code() == "network::wrong_type").count();
        assert_eq!(of_type, count, "{errors:?}");
    };
    wrong(|b, a, air| _ = b.resistor("x", a, air, Path::resistance(quantity("1 W/K"))), 1);
    wrong(|b, a, air| _ = b.resistor("x", a, air, Path::conductance(quantity("1 K/W"))), 1);
    wrong(
        |b, a, air| _ = b.convection("x", a, air, Path::film(quantity("1 m"), quantity("1 m"))),
        2,
    );
    wrong(|b, _, _| _ = b.node("x", quantity("1 W"), quantity("1 K")), 2);
    wrong(|b, a, _| _ = b.source("x", a, quantity("1 J")), 1);
    wrong(|b, a, _| _ = b.capacitor("x", a, quantity("1 W")), 1);
    wrong(|b, _, _| _ = b.boundary("x", quantity("300 K")), 1);
    wrong(|b, a, _| b.length(a, quantity("1 s")), 1);
    wrong(
        |b, a, air| {
            let m = || quantity("1 s");
            let shape = |k| Path::new(Formula::Cylinder, [k, m(), m(), m()]);
            conduct(b, (a, air), shape(m()));
        },
        4,
    );
    wrong(|b, a, air| conduct(b, (a, air), Path::radiation(quantity("1 m"))), 1);
    wrong(
        |b, a, air| {
            let m = [(); 4].map(|()| quantity("1 m"));
            conduct(b, (a, air), Path::new(Formula::ParallelPlates, m));
        },
        4,
    );
    wrong(|b, a, air| conduct(b, (a, air), Path::stream(quantity("1 kg/s"))), 1);
    wrong(
        |b, a, air| {
            let fluid = b.fluid("water", Some(quantity("1 kg")), quantity("1 J/K"), None);
            let mass = Path::of_fluid(Formula::MassFlow, fluid, [quantity("1 m^3/s")]);
            conduct(b, (a, air), mass);
            let volume =
                Path::of_fluid(Formula::VolumeFlow, fluid, [quantity("1 kg/s"), quantity("1 K")]);
            b.conductor("y", ConductorKind::Advection, (a.into(), air.into()), volume);
        },
        5,
    );
    wrong(
        |b, _, _| {
            let melting = Melting {
                solidus: quantity("1 K"),
                liquidus: quantity("1 K"),
                heat: quantity("1 J"),
            };
            let [density, cp, k] = [(); 3].map(|()| Some(quantity("1 m")));
            let melting = Some(melting);
            b.material("m", Properties { density, cp, k, melting, ..Properties::default() });
        },
        6,
    );
}

#[test]
fn what_depends_on_time_or_on_results_where_it_cannot() {
    every(&[
        ("depends_on_time", |b, a, _| {
            let c = time(b, "1 [J/K] * (1 + t / 1 [s])");
            b.capacitor("x", a, c);
        }),
        ("depends_on_time", |b, _, _| {
            let c = own(b, "1 [J/K] * (1 + t / 1 [s]) * kelvin(T) / 1 [K]");
            b.node("x", c, Temperature(300.0));
        }),
        ("depends_on_result", |b, a, _| {
            let q = link(b, "1 [W/K] * dT");
            b.source("x", a, q);
        }),
        ("depends_on_result", |b, _, _| {
            let t = power(b, "a.T");
            b.boundary("x", t);
        }),
        ("depends_on_result", |b, a, air| {
            let r = own(b, "1 [K/W] * kelvin(T) / 1 [K]");
            b.resistor("x", a, air, Path::resistance(r));
        }),
        ("which_temperature", |b, a, _| {
            let q = power(b, "1 [W/K] * kelvin(T)");
            b.shared_source("x", &[(a, 0.5), (a, 0.5)], q);
        }),
        ("comparison_not_linear", |b, a, _| {
            let q = time(b, "if(t * t > 4 [s^2], 1 [W], 2 [W])");
            b.source("x", a, q);
        }),
        ("compares_temperature", |b, a, _| {
            let q = power(b, "if(T == absolute(300 [K]), 1 [W], 2 [W])");
            b.source("x", a, q);
        }),
        ("compares_temperature", |b, _, _| {
            let c = own(b, "if(T > absolute(300 [K]), 1 [J/K], 2 [J/K])");
            b.node("x", c, Temperature(300.0));
        }),
        ("", |b, a, _| {
            let q = power(b, "if(T > absolute(300 [K]), 1 [W], if(t > 3 [s], 4 [W], 5 [W]))");
            b.source("x", a, q);
        }),
    ]);
}

#[test]
fn structure() {
    every(&[
        ("self_link", |b, a, _| _ = b.resistor("x", a, a, Conductance(1.0))),
        ("source_into_boundary", |b, _, air| _ = b.source("x", air, HeatFlow(1.0))),
        ("no_capacity", |b, _, _| _ = b.node_of_parts("x", Temperature(300.0))),
        ("massless_with_capacity", |b, a, _| {
            let x = b.massless("x");
            b.capacitor("part", x, HeatCapacity(1.0));
            b.resistor("r", x, a, Conductance(1.0));
        }),
        ("no_initial_temperature", |b, _, _| {
            _ = b.add_node("x", Some(HeatCapacity(1.0).into()), None, false)
        }),
        ("floating_island", |b, _, _| {
            let [x, y] = ["x", "y"].map(|n| b.massless(n));
            b.resistor("xy", x, y, Conductance(1.0));
        }),
        ("floating_island floating_island", |b, _, _| {
            b.massless("x");
            b.massless("y");
        }),
        ("", |b, a, _| {
            let [x, y] = ["x", "y"].map(|n| b.massless(n));
            b.resistor("xy", x, y, Conductance(1.0));
            b.resistor("xa", y, a, Conductance(1.0));
        }),
        ("", |b, _, air| {
            let [x, y] = ["x", "y"].map(|n| b.massless(n));
            b.resistor("xy", x, y, Conductance(1.0));
            b.resistor("xa", air, y, Conductance(1.0));
        }),
        ("", |b, a, _| {
            let x = b.node_of_parts("x", Temperature(300.0));
            b.capacitor("part", x, HeatCapacity(1.0));
            b.capacitor("more", a, HeatCapacity(1.0));
        }),
    ]);
}

#[test]
fn islands_name_their_nodes() {
    let (mut b, ..) = cooled();
    let [x, y, z] = ["x", "y", "z"].map(|n| b.massless(n));
    b.resistor("zx", z, x, Conductance(1.0));
    let errors = b.build().unwrap_err().0;
    let islands: Vec<_> = errors
        .iter()
        .map(|error| match &error.kind {
            BuildErrorKind::FloatingIsland { nodes, names } => {
                (nodes.clone(), names.join(" "), error.name.as_str())
            }
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(islands, [(vec![x, z], "x z".to_owned(), "x"), (vec![y], "y".to_owned(), "y")]);
}

#[test]
fn an_empty_network_and_one_of_two_boundaries() {
    let mut b = NetworkBuilder::new();
    b.boundary("air", Temperature(290.0));
    assert_eq!(codes(b), ["network::empty"]);
    let mut b = NetworkBuilder::new();
    let (air, sky) = (b.boundary("air", Temperature(290.0)), b.boundary("sky", Temperature(270.0)));
    b.resistor("r", air, sky, Conductance(1.0));
    assert_eq!(codes(b), [""; 0]);
}

#[test]
fn ids_of_another_builder_are_refused_before_anything_is_looked_up() {
    let (mut other, ..) = cooled();
    let far = other.node("far", HeatCapacity(1.0), Temperature(300.0));
    let high = other.boundary("high", Temperature(300.0));
    let with = |fault: &dyn Fn(&mut NetworkBuilder, NodeId)| {
        let (mut b, a, _) = cooled();
        fault(&mut b, a);
        codes(b)
    };
    assert_eq!(
        with(&|b, a| _ = b.resistor("x", a, far, Conductance(1.0))),
        ["network::foreign_id"]
    );
    assert_eq!(
        with(&|b, a| _ = b.resistor("x", high, a, Conductance(1.0))),
        ["network::foreign_id"]
    );
    assert_eq!(with(&|b, _| _ = b.source("x", far, HeatFlow(1.0))), ["network::foreign_id"]);
    assert_eq!(
        with(&|b, _| _ = b.shared_source("x", &[(far, 1.0)], HeatFlow(1.0))),
        ["network::foreign_id"]
    );
    assert_eq!(with(&|b, _| _ = b.capacitor("x", far, HeatCapacity(1.0))), ["network::foreign_id"]);
    let fan = other.control("fan");
    let own = |node| thermostat(node, Acts::Cooling, 310.0, 300.0);
    assert_eq!(with(&|b, a| b.thermostat(fan, own(a))), ["network::foreign_id"]);
    let sensing = with(&|b, _| {
        let x = b.control("x");
        b.thermostat(x, own(far));
    });
    assert_eq!(sensing, ["network::foreign_id"]);
}

#[test]
fn all_problems_are_reported_at_once_each_with_its_name() {
    let (mut b, a, air) = cooled();
    b.parameter("t", HeatFlow(1.0));
    b.resistor("zero", a, air, Conductance(0.0));
    b.source("cold", a, HeatFlow(f64::NAN));
    b.convection("flat", a, air, Path::film(quantity("5 W/(m^2 K)"), Area(0.0)));
    b.massless("lonely");
    let errors = b.build().unwrap_err();
    let mut found: Vec<(&str, &str)> =
        errors.0.iter().map(|e| (e.name.as_str(), e.code())).collect();
    found.sort_unstable();
    assert_eq!(
        found,
        [
            ("cold", "network::not_finite"),
            ("flat", "network::not_positive"),
            ("lonely", "network::floating_island"),
            ("t", "network::reserved_name"),
            ("zero", "network::not_positive"),
        ]
    );
    assert_eq!(errors.to_string().lines().count(), 5);
}

#[test]
fn expressions_report_unknown_names_of_their_place() {
    let (b, ..) = cooled();
    for (context, text) in [
        (Context::Time, "a.T"),
        (Context::Time, "T"),
        (Context::Own, "a.T"),
        (Context::Own, "dT"),
        (Context::Control, "T"),
        (Context::Source, "T_from"),
        (Context::Link, "T"),
        (Context::Result, "dT"),
        (Context::Link, "cool.Q"),
        (Context::Result, "cool.P"),
        (Context::Result, "cool.T"),
    ] {
        let errors = b.expression_in(context, text, None).unwrap_err();
        assert_eq!(errors[0].code(), "units::unknown_name", "{context:?} {text}");
    }
    for (context, text) in [
        (Context::Own, "T"),
        (Context::Control, "a.T - air.T"),
        (Context::Source, "T - a.T"),
        (Context::Link, "T_from - T_to + (T_mean - air.T) + dT"),
        (Context::Result, "a.T"),
    ] {
        assert!(b.expression_in(context, text, None).is_ok(), "{context:?} {text}");
    }
    assert!(matches!(b.item("cool"), Some(Item::Conductor(_))));
}
