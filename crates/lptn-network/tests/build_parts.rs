//! Builder: controls, signals, substances and limits that are wrong, by their codes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{celsius, codes, cooled, every, link, own, quantity, thermostat, time};
use lptn_network::{
    Acts, AfterEnd, Bound, ConductorKind, Course, Formula, LimitSeverity, Melting, NetworkBuilder,
    Path, Properties, Size, Temperature, Thermostat, Time,
};
use lptn_units::{Dimension, Interpolation, Outside, Table1, Type};

fn conduct(
    b: &mut NetworkBuilder,
    (a, air): (lptn_network::NodeId, lptn_network::BoundaryId),
    path: Path,
) {
    b.conductor("x", ConductorKind::Advection, (a.into(), air.into()), path);
}

#[test]
fn controls() {
    every(&[
        ("no_thermostat", |b, _, _| _ = b.control("x")),
        ("thresholds_crossed", |b, a, _| {
            let x = b.control("x");
            b.thermostat(x, thermostat(a, Acts::Cooling, 300.0, 310.0));
        }),
        ("thresholds_crossed", |b, a, _| {
            let x = b.control("x");
            b.thermostat(x, thermostat(a, Acts::Heating, 310.0, 300.0));
        }),
        ("thresholds_crossed", |b, a, _| {
            let x = b.control("x");
            b.thermostat(x, thermostat(a, Acts::Cooling, 300.0, 300.0));
        }),
        ("thresholds_crossed", |b, a, _| {
            let x = b.control("x");
            b.thermostat(x, thermostat(a, Acts::Heating, 300.0, 300.0));
        }),
        ("negative", |b, a, _| {
            let x = b.control("x");
            let own = thermostat(a, Acts::Cooling, 310.0, 300.0);
            b.thermostat(x, Thermostat { min_dwell: Time(-1.0).into(), ..own });
        }),
        ("", |b, a, _| {
            let x = b.control("x");
            let own = thermostat(a, Acts::Cooling, 310.0, 300.0);
            b.thermostat(x, Thermostat { min_dwell: Time(0.0).into(), ..own });
            let y = b.control("y");
            b.thermostat(y, thermostat(a, Acts::Heating, 300.0, 310.0));
        }),
        ("below_absolute_zero", |b, a, _| {
            let x = b.control("x");
            b.thermostat(x, thermostat(a, Acts::Cooling, 310.0, -1.0));
        }),
        ("depends_on_result", |b, a, _| {
            let x = b.control("x");
            let on = link(b, "T_from");
            b.thermostat(x, Thermostat { on, ..thermostat(a, Acts::Cooling, 310.0, 300.0) });
        }),
    ]);
}

#[test]
fn substances() {
    every(&[
        ("not_positive", |b, _, _| {
            let density = Some(quantity("-1 kg/m^3"));
            b.material("m", Properties { density, ..Properties::default() });
        }),
        ("not_positive not_positive", |b, _, _| {
            let (cp, k) = (Some(quantity("0 J/(kg K)")), Some(quantity("0 W/(m K)")));
            b.material("m", Properties { cp, k, ..Properties::default() });
        }),
        ("melting", |b, _, _| wax(b, 320.0, 310.0, "2e5 J/kg")),
        ("not_positive", |b, _, _| wax(b, 320.0, 330.0, "0 J/kg")),
        ("", |b, _, _| wax(b, 320.0, 320.0, "2e5 J/kg")),
        ("not_positive not_positive", |b, _, _| {
            _ = b.fluid("water", Some(quantity("0 kg/m^3")), quantity("-1 J/(kg K)"), None)
        }),
        ("not_finite", |b, a, air| {
            let fluid = b.fluid("water", None, quantity("4e3 J/(kg K)"), None);
            let path = Path::of_fluid(
                Formula::VolumeFlow,
                fluid,
                [quantity("1 m^3/s"), celsius("20 degC")],
            );
            conduct(b, (a, air), path);
        }),
        ("fluid_unknown", |b, a, air| {
            let cp = own(b, "-1 [J/(kg K)] * kelvin(T) / 1 [K]");
            let fluid = b.fluid("water", None, cp, None);
            conduct(b, (a, air), Path::of_fluid(Formula::MassFlow, fluid, [quantity("1 kg/s")]));
        }),
        ("not_positive", |b, _, _| {
            let c = own(b, "1 [J/K] * (kelvin(T) / 300 [K] - 2)");
            b.node("x", c, Temperature(700.0));
            let c = own(b, "1 [J/K] * (kelvin(T) / 300 [K] - 2)");
            b.node("y", c, Temperature(300.0));
        }),
        ("not_a_fraction not_melting", |b, a, _| b.molten(a, 1.5)),
        ("not_a_fraction", |b, a, _| b.molten(a, -0.1)),
        ("not_melting", |b, a, _| b.molten(a, 0.5)),
        ("", |b, a, _| b.molten(a, 0.0)),
        ("not_positive", |b, _, _| {
            let cp = Some(quantity("-1 J/(kg K)"));
            b.material("m", Properties { cp, ..Properties::default() });
        }),
        ("not_positive", |b, _, _| {
            let cp = Some(quantity("1 J/(kg K)"));
            let m = b.material("m", Properties { cp, ..Properties::default() });
            let c = b.lump(m, Size::Mass(quantity("-1 kg"))).unwrap();
            b.node("x", c, Temperature(300.0));
        }),
    ]);
}

fn wax(b: &mut NetworkBuilder, solidus: f64, liquidus: f64, heat: &str) {
    let (solidus, liquidus) = (Temperature(solidus).into(), Temperature(liquidus).into());
    let melting = Some(Melting { solidus, liquidus, heat: quantity(heat) });
    b.material("wax", Properties { melting, ..Properties::default() });
}

#[test]
fn signals() {
    let points = |times: &[f64], values: &[f64]| Course::Steps {
        times: times.to_vec(),
        values: values.to_vec(),
        after: AfterEnd::Hold,
    };
    let with = |course: Course| {
        let (mut b, ..) = cooled();
        b.signal("s", Type::of(Dimension::POWER), course);
        codes(b)
    };
    assert_eq!(with(points(&[0.0, 1.0], &[1.0, 2.0])), [""; 0]);
    for (times, values) in [
        (&[][..], &[][..]),
        (&[0.0, 1.0], &[1.0]),
        (&[0.0, 0.0], &[1.0, 2.0]),
        (&[1.0, 0.0], &[1.0, 2.0]),
        (&[0.0, f64::INFINITY], &[1.0, 2.0]),
        (&[0.0, 1.0], &[1.0, f64::NAN]),
    ] {
        assert_eq!(with(points(times, values)), ["network::signal_points"], "{times:?} {values:?}");
    }
    let repeated = |period: f64| {
        let points =
            Table1::new(vec![2.0, 8.0], vec![1.0, 2.0], Interpolation::Linear, Outside::Error)
                .unwrap();
        with(Course::Curve { points, after: AfterEnd::Repeat(period) })
    };
    assert_eq!(repeated(6.0), [""; 0]);
    assert_eq!(repeated(7.0), [""; 0]);
    for period in [5.0, 0.0, -6.0, f64::INFINITY, f64::NAN] {
        assert_eq!(repeated(period), ["network::period_too_short"], "{period}");
    }
}

#[test]
fn limits_are_constants_of_the_same_type() {
    every(&[
        ("depends_on_time", |b, _, _| {
            let of = b.post_expression("a.T", None).unwrap();
            let value = time(b, "absolute(300 [K]) + 1 [K/s] * t");
            b.limit("x", (of.into(), "a.T"), (Bound::Below, value), LimitSeverity::Error);
        }),
        ("wrong_type", |b, _, _| {
            let of = b.post_expression("a.T", None).unwrap();
            b.limit(
                "x",
                (of.into(), "a.T"),
                (Bound::Below, quantity("300 K")),
                LimitSeverity::Error,
            );
        }),
        ("below_absolute_zero", |b, _, _| {
            let of = b.post_expression("a.T", None).unwrap();
            b.limit(
                "x",
                (of.into(), "a.T"),
                (Bound::Below, Temperature(-3.0).into()),
                LimitSeverity::Error,
            );
        }),
    ]);
}
