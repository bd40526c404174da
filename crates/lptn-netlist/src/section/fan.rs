//! `[fan]`: fans and pumps at a system, whose flow expressions call over their speed.

use std::sync::Arc;

use lptn_data::{Diagnostic, Span};
use lptn_laws::fan_duty;
use lptn_network::{Field, Item};
use lptn_units::{
    Dimension, Expression, LookupTable, PowerLaw, TableSymbol, Type, Unit, format_short,
};

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, Takes, key, number, shaped};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::work::Elaboration;

pub(crate) const FAN: SectionDeclaration = SectionDeclaration {
    name: "fan",
    sentence: "A fan or pump at a system: `NAME.flow(n)`, `NAME.pressure(n)`, `NAME.power(n)`.",
    role: Role::Substance,
    keys: &[
        shaped(
            "curve",
            "list",
            Takes::list(&Takes::List(&Takes::Text, 2, 2)),
            "points of flow, rising, and pressure, falling, at the rated speed",
            "[[\"0 m^3/h\", \"120 Pa\"], [\"300 m^3/h\", \"0 Pa\"]]",
        ),
        shaped(
            "system",
            "pair",
            Takes::List(&Takes::Text, 2, 2),
            "with `curve`: a flow and the pressure that the system takes for it",
            "[\"200 m^3/h\", \"60 Pa\"]",
        ),
        shaped(
            "duty",
            "pair",
            Takes::List(&Takes::Text, 2, 2),
            "instead of `curve` and `system`: flow and pressure at the rated speed",
            "[\"180 m^3/h\", \"48 Pa\"]",
        ),
        key("rated_speed", "rad/s", "the speed to which they belong", "\"2800 rpm\"").needed(),
        key("power", "W", "the power at the rated speed in this system", "\"9 W\""),
        number("efficiency", "instead of `power`: flow times pressure over power", "0.3"),
    ],
    either: &[&["duty", "curve"]],
    example: "{ curve = [[\"0 m^3/h\", \"120 Pa\"], [\"300 m^3/h\", \"0 Pa\"]], system = [\"200 m^3/h\", \
        \"60 Pa\"], rated_speed = \"2800 rpm\", efficiency = 0.3 }",
    elsewhere: &[
        ("resistance", "the system is `system`, one flow with the pressure that it takes"),
        (
            "speed",
            "the speed is the argument of `NAME.flow(n)`; the speed of the curve is `rated_speed`",
        ),
        ("into", "its heat is a [source]: `{ into = \"..\", P = \"NAME.power(n)\" }`"),
    ],
    ..SectionDeclaration::NEW
};

const SPEED: Type = Type::of(Dimension::ANGULAR_VELOCITY);
const FLOW: Type = Type::of(Dimension::VOLUME_FLOW);
const PRESSURE: Type = Type::of(Dimension::PRESSURE);
const POWER: Type = Type::of(Dimension::POWER);

/// The functions of a fan: ending of the name, power of the speed, type and usual unit.
const GIVEN: [(&str, u8, Type, &str); 3] =
    [("flow", 1, FLOW, "m^3/h"), ("pressure", 2, PRESSURE, "Pa"), ("power", 3, POWER, "W")];

/// Highest ratio of the speed of a fan to its rated speed.
const FASTEST: f64 = 2.0;

impl<'a> Elaboration<'a> {
    pub(crate) fn fans(&mut self) {
        for entry in self.elements(FAN.name) {
            if self.fan(entry).is_none() {
                GIVEN
                    .iter()
                    .for_each(|(what, ..)| self.names.fail(&format!("{}.{what}", entry.key)));
            }
        }
    }

    /// Gives the functions of a fan to the builder.
    fn fan(&mut self, entry: &'a RawEntry) -> Option<()> {
        let fields = self.fields(&FAN, entry)?;
        let speed = self.require(&fields, "rated_speed");
        let speed = speed.and_then(|raw| self.above_zero(&fields, ("rated_speed", raw), SPEED));
        let duty = self.duty(&fields);
        let power = self.power(&fields, duty.unwrap_or_default());
        let (speed, [flow, pressure], power) = (speed?, duty?, power?);
        let values = [Some(flow), Some(pressure), power];
        for (value, (what, exponent, ty, unit)) in values.into_iter().zip(GIVEN) {
            let Some(value) = value else { continue };
            let law = PowerLaw::through([speed, value], exponent, FASTEST * speed);
            let Some(law) = law else {
                let message = format!("the {what} of {} is not finite", fields.owner.words());
                self.refuse("network::not_finite", message, fields.place, "check the units");
                return None;
            };
            let units = ["rpm", unit].map(|text| Unit::parse(text).ok());
            let symbol = TableSymbol {
                table: Arc::new(LookupTable::PowerLaw(law)),
                arguments: vec![SPEED],
                ty,
                units: units.into_iter().collect::<Option<_>>().unwrap_or_default(),
            };
            let id = self.builder.table(&format!("{}.{what}", entry.key), symbol);
            self.map.insert(Item::Table(id), Field::Name, entry.key_span.clone());
        }
        Some(())
    }

    /// Notes the fans whose functions an expression calls, and reports a power that is unknown.
    pub(crate) fn learn_fans(&mut self, expression: &Expression, at: &Span) {
        for (call, _) in expression.calls() {
            let Some((name, what)) = call.rsplit_once('.') else { continue };
            let mut own = self.elements(FAN.name).iter();
            if !(GIVEN.iter().any(|(known, ..)| *known == what)
                && own.any(|entry| entry.key == name))
            {
                continue;
            }
            self.used.insert((FAN.name, name.to_owned()));
            if self.builder.has_table(&call) || self.names.has_failed(&call) {
                continue;
            }
            let message = format!("fan `{name}` has no `{what}`, which is needed here");
            let samples = ["power", "efficiency"].map(|key| FAN.sample(key));
            let help = format!("add `{}` or `{}` to the fan", samples[0], samples[1]);
            self.refuse("netlist::no_property", message, at, help);
            self.names.fail(&call);
        }
    }

    /// Flow and pressure at the rated speed.
    fn duty(&mut self, fields: &Fields<'a>) -> Option<[f64; 2]> {
        if let Some(raw) = fields.get("duty") {
            self.refuse_keys(fields, &["curve", "system"], "has no effect with `duty`");
            return self.pair_above_zero(fields, ("duty", raw));
        }
        let (curve, system) = (self.require(fields, "curve"), self.require(fields, "system"));
        let curve = curve.and_then(|raw| Some((self.curve_of(fields, raw)?, raw)));
        let system = system.and_then(|raw| self.pair_above_zero(fields, ("system", raw)));
        let ((curve, raw), [flow, pressure]) = (curve?, system?);
        let resistance = pressure / (flow * flow);
        let duty = fan_duty(&curve, resistance);
        if duty.is_none() {
            self.report(no_duty(fields, (&curve, resistance), &raw.span));
        }
        duty
    }

    /// The points of the curve; `None` if they are wrong.
    fn curve_of(&mut self, fields: &Fields<'a>, raw: &'a RawValue) -> Option<Vec<[f64; 2]>> {
        let RawKind::Array(items) = &raw.kind else {
            return self.not_points(fields, ("curve", raw));
        };
        let points: Option<Vec<[f64; 2]>> =
            items.iter().map(|item| self.pair(fields, ("curve", item))).collect();
        let points = points?;
        if points.len() < 2 {
            return self.not_points(fields, ("curve", raw));
        }
        let wrong = wrong_curve(&points);
        if let Some((message, help)) = &wrong {
            let message = format!("{} {message}", fields.owner.field("curve"));
            self.refuse("netlist::fan_curve", message, &raw.span, *help);
        }
        wrong.is_none().then_some(points)
    }

    /// A flow with a pressure, both above 0.
    fn pair_above_zero(
        &mut self,
        fields: &Fields<'a>,
        (key, raw): (&str, &'a RawValue),
    ) -> Option<[f64; 2]> {
        let pair = self.pair(fields, (key, raw))?;
        if pair.iter().all(|number| *number > 0.0) {
            return Some(pair);
        }
        let message = format!("{} must be more than zero, both of them", fields.owner.field(key));
        let help = "one point without flow or without pressure does not define the system";
        self.refuse("network::not_positive", message, &raw.span, help);
        None
    }

    /// A flow with a pressure.
    fn pair(&mut self, fields: &Fields<'a>, (key, raw): (&str, &'a RawValue)) -> Option<[f64; 2]> {
        let RawKind::Array(items) = &raw.kind else { return self.not_points(fields, (key, raw)) };
        let [flow, pressure] = items.as_slice() else { return self.not_points(fields, (key, raw)) };
        let flow = self.constant_at(fields, (key, flow), FLOW);
        let pressure = self.constant_at(fields, (key, pressure), PRESSURE);
        Some([flow?, pressure?])
    }

    fn not_points<T>(&mut self, fields: &Fields<'a>, (key, raw): (&str, &RawValue)) -> Option<T> {
        let wanted = if key == "curve" { "two or more pairs" } else { "a pair" };
        let message =
            format!("{} must be {wanted} of a flow and a pressure", fields.owner.field(key));
        let help = format!("write it like this: `{}`", fields.sample(key));
        self.refuse("netlist::fan_points", message, &raw.span, help);
        None
    }

    /// The power at the duty, if it is known; `None` if it is wrong.
    fn power(&mut self, fields: &Fields<'a>, [flow, pressure]: [f64; 2]) -> Option<Option<f64>> {
        match (fields.get("power"), fields.get("efficiency")) {
            (None, None) => Some(None),
            (Some(raw), other) => {
                if other.is_some() {
                    let why = "has no effect with `power`";
                    self.refuse_keys(fields, &["efficiency"], why);
                }
                let power = self.above_zero(fields, ("power", raw), POWER)?;
                if power < flow * pressure {
                    let message = format!(
                        "{} is less than its flow times its pressure, {} W",
                        fields.owner.field("power"),
                        format_short(flow * pressure)
                    );
                    let help = "no fan gives more than it takes: check the units of its points";
                    self.refuse("network::not_a_fraction", message, &raw.span, help);
                    return None;
                }
                Some(Some(power))
            }
            (None, Some(raw)) => {
                let share = self.above_zero(fields, ("efficiency", raw), Type::SCALAR)?;
                if share > 1.0 {
                    let message = format!(
                        "{} must be at most 1, got {}",
                        fields.owner.field("efficiency"),
                        format_short(share)
                    );
                    let help = "no fan gives more than it takes; percent are written `30 %`";
                    self.refuse("network::not_a_fraction", message, &raw.span, help);
                    return None;
                }
                Some(Some(flow * pressure / share))
            }
        }
    }

    /// A constant number above 0.
    fn above_zero(
        &mut self,
        fields: &Fields<'a>,
        (key, raw): (&str, &'a RawValue),
        ty: Type,
    ) -> Option<f64> {
        let value = self.constant_at(fields, (key, raw), ty)?;
        if value > 0.0 {
            return Some(value);
        }
        let message = format!("{} must be more than zero", fields.owner.field(key));
        let help = format!("write it like this: `{}`", fields.sample(key));
        self.refuse("network::not_positive", message, &raw.span, help);
        None
    }
}

/// The error in the points of a curve, and its help.
fn wrong_curve(points: &[[f64; 2]]) -> Option<(String, &'static str)> {
    if points.iter().flatten().any(|number| *number < 0.0) {
        let help = "a fan is described from no flow to no pressure: check the signs";
        return Some(("has a number below zero".to_owned(), help));
    }
    let pair = |wrong: fn(&[[f64; 2]]) -> bool| points.windows(2).find(|pair| wrong(pair));
    if let Some(pair) = pair(|pair| pair[1][0] <= pair[0][0]) {
        let [from, to] = [pair[0][0], pair[1][0]].map(flow);
        let message = format!("does not go to larger flows: {from} and then {to}");
        return Some((message, "write the points in the order of their flows"));
    }
    let pair = pair(|pair| pair[1][1] > pair[0][1])?;
    let [from, to] = [pair[0][1], pair[1][1]].map(pressure);
    let message = format!("rises with the flow: {from} and then {to}");
    let help = "if a curve rises, a fan may run at several flows: leave that part out, or check \
        whether flow and pressure are exchanged";
    Some((message, help))
}

/// Error for a fan and a system that do not meet.
fn no_duty(fields: &Fields<'_>, (curve, resistance): (&[[f64; 2]], f64), at: &Span) -> Diagnostic {
    let takes = |point: &[f64; 2]| resistance * point[0] * point[0];
    let (ends, begins) = (curve.last(), curve.first());
    let steep = begins.is_some_and(|first| takes(first) > first[1]);
    let (place, point) = if steep { ("begins", begins) } else { ("ends", ends) };
    let [at_flow, has] = point.copied().unwrap_or_default();
    let message = format!(
        "{} {place} at {} with {}, but the system takes {} there",
        fields.owner.field("curve"),
        flow(at_flow),
        pressure(has),
        pressure(resistance * at_flow * at_flow)
    );
    let help = match steep {
        true => "give the curve down to no flow, or check `system`",
        false => "give the curve down to no pressure, or check `system`",
    };
    Diagnostic::wrong("netlist::fan_duty", message, at, help)
}

fn flow(value: f64) -> String {
    format!("{} m^3/h", format_short(value * 3600.0))
}

fn pressure(value: f64) -> String {
    format!("{} Pa", format_short(value))
}
