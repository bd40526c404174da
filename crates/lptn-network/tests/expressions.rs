//! Expressions: tables and values of grids by name, and what helps where an input has no value.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{celsius, cooled, near, quantity, time};
use lptn_network::{
    ConductorKind, Context, Face, GridBlock, GridFace, GridValue, InputProblem, NetworkBuilder,
    Path, Substance,
};
use lptn_units::{
    Dimension, Expression, Interpolation, LookupTable, Outside, Scope, Table1, TableSymbol, Type,
};

fn ramp() -> TableSymbol {
    let table = Table1::new(vec![0.0, 10.0], vec![1.0, 5.0], Interpolation::Linear, Outside::Error)
        .unwrap();
    let arguments = vec![Type::of(Dimension::TIME)];
    TableSymbol {
        table: LookupTable::One(table).into(),
        arguments,
        ty: Type::of(Dimension::POWER),
        units: Vec::new(),
    }
}

#[test]
fn tables_are_called_by_their_names() {
    let (mut b, a, _) = cooled();
    let id = b.table("ramp", ramp());
    let scope = b.scope(Context::Time);
    assert_eq!(scope.table_names(), ["ramp"]);
    assert!(
        scope.table("ramp").is_some()
            && scope.table("a").is_none()
            && scope.table("other").is_none()
    );
    let p = time(&b, "ramp(t) + 1 [W]");
    b.source("p", a, p);
    let network = b.build().unwrap();
    assert_eq!(network.table_ids().collect::<Vec<_>>(), [id]);
    let names: Vec<&str> = network.tables().map(|(name, _)| name).collect();
    assert_eq!(names, ["ramp"]);
    let mut scope = network.evaluation();
    scope.set_time(2.5, 2.5);
    let mut out = [f64::NAN];
    network.source_powers(&mut scope, &mut out).unwrap();
    near(out[0], 3.0);
    scope.set_time(11.0, 11.0);
    assert!(network.source_powers(&mut scope, &mut out).is_err());
}

#[test]
fn values_of_grids_have_names_in_results() {
    let mut b = NetworkBuilder::new();
    let block = |cells: &[usize]| GridBlock {
        size: ["0.6 m", "0.4 m", "0.2 m"].map(quantity),
        cells: cells.to_vec(),
        conductivity: ["1 W/(m K)", "1 W/(m K)", "1 W/(m K)"].map(quantity),
        substance: Substance::Properties {
            density: quantity("1 kg/m^3"),
            cp: quantity("1 J/(kg K)"),
        },
        initial: Some(celsius("20 degC")),
    };
    let (wall, other) = (b.grid("wall", block(&[2, 2])), b.grid("other", block(&[2])));
    let air = b.boundary("air", celsius("10 degC"));
    let film = Path::film(quantity("5 W/(m^2 K)"), quantity("0.08 m^2"));
    b.connect(
        "film",
        ConductorKind::Convection,
        (GridFace { grid: wall, face: Face::X1 }, air),
        film,
    );
    let mut report = |name: &str, text: &str| {
        let value = b.post_expression(text, None).unwrap_or_else(|e| panic!("{text}: {e:?}"));
        b.report(name, value.into(), text)
    };
    let ids = [
        report("a", "wall.mean - wall.min"),
        report("b", "wall.max - wall.mean"),
        report("c", "wall.x1.T - wall.x0.T"),
        report("d", "other.mean - wall.y1.T"),
        report("e", "film.Q"),
        report("f", "wall[2,1].T - other[2].T"),
    ];
    let names = b.scope(Context::Result).names();
    for name in ["wall.mean", "other.max", "wall.x1.T", "other.z0.T", "film.Q", "wall[1,2].T"] {
        assert!(names.iter().any(|known| known == name), "{name}");
    }
    for wrong in ["wall.median", "wall.x2.T", "air.mean", "film.mean", "wall.Q"] {
        assert!(b.post_expression(wrong, None).is_err(), "{wrong}");
    }
    assert!(b.expression_in(Context::Link, "wall.mean", None).is_err());
    let network = b.build().unwrap();
    let mut scope = network.evaluation();
    // wall[1,1] .. wall[2,2], other[1], other[2], the two surfaces of wall.x1
    scope.set_temperatures(&[300.0, 310.0, 330.0, 360.0, 400.0, 420.0, 340.0, 380.0], &[283.0]);
    scope.set_heats(&[77.0]);
    let expected = [25.0, 35.0, 360.0 - 305.0, 410.0 - 335.0, 77.0, 330.0 - 420.0];
    for (id, expected) in ids.into_iter().zip(expected) {
        near(network.report_value(id, &mut scope).unwrap(), expected);
    }
    assert_eq!(network.grid_value_members(GridValue::Mean(other)), [4, 5]);
    let named: Vec<String> = network.named_heats().map(|of| of.name(&network)).collect();
    assert_eq!(named, ["film.Q"]);
}

#[test]
fn values_name_the_slots_and_programs_they_read() {
    let (mut b, a, _) = cooled();
    b.parameter("k", quantity("2 W/s"));
    let p = time(&b, "k * t + k * 1 [s]");
    b.source("p", a, p);
    let network = b.build().unwrap();
    let value = network.sources()[0].power().unwrap();
    let k = network.parameter_slot(network.parameter("k").unwrap());
    assert_eq!(value.slots(), [lptn_network::slot::TIME, k]);
    assert_eq!(value.programs().len(), 1);
    assert!(network.depends_on_time(value));
    let plain = Expression::parse("k").unwrap().compile(&network.post_scope(), None).unwrap();
    assert!(!network.depends_on_time(&lptn_network::Value::Expression(plain.into())));
}

#[test]
fn every_problem_that_can_be_mended_has_a_help() {
    let range = (250.0, 400.0);
    for (problem, word) in [
        (InputProblem::AfterSignal { time: 3.0, last: 2.0 }, "after_end"),
        (InputProblem::TooManyPoints(1e9), ""),
        (InputProblem::Negative(-1.0), ""),
        (InputProblem::OutsideFluid { temperature: 500.0, range }, ""),
        (InputProblem::OutsideCapacity { range }, ""),
    ] {
        assert!(
            problem.help().is_some_and(|help| !help.is_empty() && help.contains(word)),
            "{problem:?}"
        );
    }
}
