//! The curve of a pump or fan as an expression for its flow.

use lptn_data::Diagnostic;
use lptn_units::{Dimension, Expression, Type, format_short, parse_quantity};

use crate::fields::Fields;
use crate::raw::{RawKind, RawValue};

/// Volume flow over the pressure of the pump, by straight lines between the points of its curve.
/// The first and the last line go on: a pump that is overcome flows back.
///
/// At the speed ratio s the point (V, p) is (s V, s^2 p) (affinity laws; W. Bohl, Strömungsmaschinen
/// 1, section 4). The speed may not be zero: the curve is then a point.
pub(super) fn curve(
    h: &str,
    fields: &Fields<'_>,
    problems: &mut Vec<Diagnostic>,
) -> Option<String> {
    let raw = fields.get("curve")?;
    let points = points(fields, raw, problems)?;
    if let Some((message, help)) = wrong(&points) {
        let message = format!("{} {message}", fields.owner.field("curve"));
        problems.push(Diagnostic::wrong("netlist::fan_curve", message, &raw.span, help));
        return None;
    }
    let flow = |value: f64| literal(value, Dimension::VOLUME_FLOW);
    let pressure = |value: f64| literal(value, Dimension::PRESSURE);
    let lines = points.windows(2).len();
    let mut sum = flow(points[0][0]);
    for (i, pair) in points.windows(2).enumerate() {
        let ([v0, p0], [v1, p1]) = (pair[0], pair[1]);
        let mut share =
            format!("({} + {h}.dp / {h}.speed^2) / {}", pressure(p0), pressure(p0 - p1));
        if i > 0 {
            share = format!("max({share}, 0)");
        }
        if i + 1 < lines {
            share = format!("min({share}, 1)");
        }
        sum += &format!(" + {} * {share}", flow(v1 - v0));
    }
    // the root refuses a speed below 0
    Some(format!("sqrt({h}.speed)^2 * ({sum})"))
}

fn literal(value: f64, dimension: Dimension) -> String {
    Expression::literal(value, Type::of(dimension)).text().to_owned()
}

/// Pairs of a flow and a pressure in SI units.
fn points(
    fields: &Fields<'_>,
    raw: &RawValue,
    problems: &mut Vec<Diagnostic>,
) -> Option<Vec<[f64; 2]>> {
    let pair = |item: &RawValue| match &item.kind {
        RawKind::Array(pair) => match pair.as_slice() {
            [flow, p] => {
                Some([number(flow, Dimension::VOLUME_FLOW)?, number(p, Dimension::PRESSURE)?])
            }
            _ => None,
        },
        _ => None,
    };
    let points: Option<Vec<[f64; 2]>> = match &raw.kind {
        RawKind::Array(items) if items.len() > 1 => items.iter().map(pair).collect(),
        _ => None,
    };
    if points.is_none() {
        let message = format!(
            "{} must be two or more pairs of a volume flow and a pressure",
            fields.owner.field("curve")
        );
        let help = format!("write it like this: `{}`", fields.sample("curve"));
        problems.push(Diagnostic::wrong("netlist::fan_points", message, &raw.span, help));
    }
    points
}

fn number(raw: &RawValue, dimension: Dimension) -> Option<f64> {
    let RawKind::String { text, .. } = &raw.kind else { return None };
    let quantity = parse_quantity(text.trim(), Some(Type::of(dimension))).ok()?;
    Some(quantity.value)
}

/// The error in the points of a curve, and its help.
fn wrong(points: &[[f64; 2]]) -> Option<(String, &'static str)> {
    let pair = |is: fn(&[[f64; 2]]) -> bool| points.windows(2).find(|pair| is(pair));
    if let Some(pair) = pair(|pair| pair[1][0] <= pair[0][0]) {
        let [from, to] = [pair[0][0], pair[1][0]].map(|v| format_short(v * 3600.0));
        let message = format!("does not go to larger flows: {from} m^3/h and then {to} m^3/h");
        return Some((message, "write the points in the order of their flows"));
    }
    let pair = pair(|pair| pair[1][1] >= pair[0][1])?;
    let [from, to] = [pair[0][1], pair[1][1]].map(format_short);
    let message = format!("does not fall with the flow: {from} Pa and then {to} Pa");
    let help = "if a curve does not fall, a pump may run at several flows: leave that part out, or \
        check whether flow and pressure are exchanged";
    Some((message, help))
}
