//! A branch of a flow network: its ends, its fluid, and the choice of its law.

use lptn_data::{Diagnostic, list};
use lptn_units::{Dimension, Expression, Type, suggest};

use crate::fields::Fields;
use crate::hydraulic::{BRANCH, JUNCTION, PRESSURE, law, pump};
use crate::names::ValueKind;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::template::Structure;
use crate::written_out::WrittenOut;

const MASS_FLOW: Type = Type::of(Dimension::MASS_FLOW);
const VOLUME_FLOW: Type = Type::of(Dimension::VOLUME_FLOW);

/// A branch that was written out.
#[derive(Debug)]
pub(super) struct Branch {
    /// Its full name.
    pub(super) name: String,
    /// The full names of the junctions at `from` and `to`.
    pub(super) ends: [String; 2],
    /// True if its flow depends on the pressure difference.
    pub(super) yields: bool,
}

/// The properties of its fluid that a law needs.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Needs {
    Nothing,
    Density,
    Viscosity,
}

/// The keys of a law: the one that selects it, those that it needs, and those that it may have.
struct Keys {
    selector: &'static str,
    needs: &'static [&'static str],
    may: &'static [&'static str],
    fluid: Needs,
}

const fn keys(
    selector: &'static str,
    needs: &'static [&'static str],
    may: &'static [&'static str],
    fluid: Needs,
) -> Keys {
    Keys { selector, needs, may, fluid }
}

const LAWS: [Keys; 8] = [
    keys("flow", &[], &[], Needs::Nothing),
    keys("resistance", &[], &[], Needs::Density),
    keys("zeta", &["area"], &["dp_small"], Needs::Density),
    keys("C_d", &["area"], &["dp_small"], Needs::Density),
    keys("K_v", &[], &["dp_small"], Needs::Density),
    keys("length", &["diameter"], &["roughness"], Needs::Viscosity),
    keys("curve", &[], &["speed", "efficiency"], Needs::Density),
    keys("p_0", &[], &["a", "b", "speed", "efficiency", "dp_small"], Needs::Density),
];

/// Keys that every law may have.
const COMMON: [&str; 6] = ["from", "to", "lubricant", "flow_T", "density", "viscosity"];

/// Defaults that become parameters, so that they can be set.
const DEFAULTS: [(&str, &str); 4] =
    [("dp_small", "0.01 Pa"), ("roughness", "0 m"), ("speed", "1"), ("efficiency", "1")];

/// A branch while it is read.
struct Reading<'f, 'r> {
    fields: &'f Fields<'f>,
    out: WrittenOut<'r>,
}

impl Branch {
    pub(super) fn read<'r>(
        (structure, junctions): (&Structure, &[RawEntry]),
        (entry, fields): (&RawEntry, &Fields<'_>),
        out: WrittenOut<'r>,
        problems: &mut Vec<Diagnostic>,
    ) -> Option<(Self, WrittenOut<'r>)> {
        let known = |key| end((structure, junctions), (fields, key), problems);
        let ends = ["from", "to"].map(known);
        let keys = chosen(fields, problems);
        let [Some(from), Some(to)] = ends else { return None };
        if from == to {
            let message = format!("{} begins and ends at one junction", fields.owner.words());
            let help = "let it lead to another junction";
            problems.push(Diagnostic::wrong(
                "netlist::branch_ends",
                message,
                &entry.key_span,
                help,
            ));
            return None;
        }
        let keys = keys.filter(|_| fields.complete)?;
        let mut reading = Reading { fields, out };
        let fluid = reading.fluid(keys.fluid, problems)?;
        let yields = reading.law(keys, fluid, problems)?;
        let branch = Self { name: entry.key.clone(), ends: [from, to], yields };
        Some((branch, reading.out))
    }
}

/// The full name of the junction at an end.
fn end(
    (structure, junctions): (&Structure, &[RawEntry]),
    (fields, key): (&Fields<'_>, &str),
    problems: &mut Vec<Diagnostic>,
) -> Option<String> {
    let raw = fields.require(key, problems)?;
    let name = fields.text(key, raw, problems)?;
    let full = structure.resolve(&raw.span, name);
    if junctions.iter().any(|junction| junction.key == full) {
        return Some(full);
    }
    let owner = fields.owner.field(key);
    let message = format!("no junction named `{name}`, which {owner} refers to");
    let problem = Diagnostic::error("netlist::unknown_junction", message).at(raw.span.clone(), "");
    let near = suggest(&full, junctions.iter().map(|junction| junction.key.as_str()));
    problems.push(problem.help(match near {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("add it to [{}]: `{name} = {{}}`", JUNCTION.name),
    }));
    None
}

/// The one law that the keys choose.
fn chosen(fields: &Fields<'_>, problems: &mut Vec<Diagnostic>) -> Option<&'static Keys> {
    let given: Vec<&Keys> = LAWS.iter().filter(|law| fields.has(law.selector)).collect();
    let [law] = given[..] else {
        let names: Vec<&str> = LAWS.iter().map(|law| law.selector).collect();
        if given.is_empty() && fields.complete {
            let message = format!("{} has no law for its flow", fields.owner.words());
            let help = format!("add one of {}", list(&names));
            problems.push(Diagnostic::wrong("netlist::branch_law", message, fields.place, help));
        } else if !given.is_empty() {
            let message = "has more than one law for its flow".to_owned();
            let keys = given.iter().map(|law| law.selector);
            let problem = fields.several("netlist::branch_law", message, keys);
            let help = "keep one; laws in series are branches with a junction between them";
            problems.push(problem.help(help));
        }
        return None;
    };
    let before = problems.len();
    law.needs.iter().for_each(|key| _ = fields.require(key, problems));
    for key in BRANCH.names() {
        let belongs = key == law.selector || COMMON.contains(&key);
        if belongs || law.needs.contains(&key) || law.may.contains(&key) {
            continue;
        }
        useless(fields, key, &format!("has no effect with `{}`", law.selector), problems);
    }
    (problems.len() == before).then_some(law)
}

/// Reports a key that has no effect.
fn useless(fields: &Fields<'_>, key: &str, why: &str, problems: &mut Vec<Diagnostic>) {
    if let Some(at) = fields.key(key) {
        let message = format!("{} {why}", fields.owner.field(key));
        let help = format!("remove `{key}`");
        problems.push(Diagnostic::wrong("netlist::useless_key", message, at, help));
    }
}

impl Reading<'_, '_> {
    /// A key that is written, as `NAME.key`; a default if it is not.
    fn given(&mut self, key: &str) {
        let default = DEFAULTS.iter().find(|(name, _)| *name == key);
        let ty = BRANCH.key(key).map_or(Type::SCALAR, |key| key.ty());
        match (self.fields.get(key), default) {
            (Some(value), _) => self.out.given(key, value),
            (None, Some((_, text))) => {
                self.out.text(ValueKind::Parameter.section(), key, (*text).to_owned());
            }
            (None, None) => return,
        }
        self.out.typed(key, ty);
    }

    /// Density and viscosity, as far as they are known.
    fn fluid(&mut self, needs: Needs, problems: &mut Vec<Diagnostic>) -> Option<Needs> {
        let fields = self.fields;
        if let Some(raw) = fields.get("lubricant") {
            let why = "has no effect with `lubricant`";
            ["density", "viscosity"].iter().for_each(|key| useless(fields, key, why, problems));
            let oil = fields.text("lubricant", raw, problems)?.to_owned();
            fields.require("flow_T", problems)?;
            self.given("flow_T");
            self.oil((&oil, raw), needs);
            return Some(Needs::Viscosity);
        }
        useless(fields, "flow_T", "has no effect without `lubricant`", problems);
        let wanted = match needs {
            Needs::Viscosity => &["density", "viscosity"][..],
            _ => {
                let why = "has no effect: only a pipe, with `length`, reads it";
                useless(fields, "viscosity", why, problems);
                if needs == Needs::Density { &["density"][..] } else { &[][..] }
            }
        };
        for key in wanted {
            if !fields.has(key) {
                let message =
                    format!("{} has neither `lubricant` nor `{key}`", fields.owner.words());
                problems.push(fields.missing(key, message));
                return None;
            }
        }
        self.given("density");
        self.given("viscosity");
        Some(if fields.has("density") { needs.max_of(Needs::Density) } else { Needs::Nothing })
    }

    fn oil(&mut self, (oil, raw): (&str, &RawValue), needs: Needs) {
        let h = self.out.here;
        let value = ValueKind::Value.section();
        let density = format!("{oil}.density({h}.flow_T)");
        self.out.put(value, "density", RawValue::text(density, &raw.span));
        self.out.typed("density", Type::of(Dimension::DENSITY));
        if needs == Needs::Viscosity {
            let viscosity = format!("{oil}.nu({h}.flow_T) * {h}.density");
            self.out.put(value, "viscosity", RawValue::text(viscosity, &raw.span));
            self.out.typed("viscosity", Type::of(Dimension::DYNAMIC_VISCOSITY));
        }
    }

    /// The flow; true if it depends on the pressure difference.
    fn law(&mut self, keys: &Keys, fluid: Needs, problems: &mut Vec<Diagnostic>) -> Option<bool> {
        let selector = keys.selector;
        if selector == "flow" {
            return Some(self.given_flow(fluid));
        }
        self.dp();
        let keys = [selector].into_iter().chain(keys.needs.iter().chain(keys.may).copied());
        keys.filter(|key| *key != "curve").for_each(|key| self.given(key));
        let h = self.out.here;
        match selector {
            "resistance" => self.volume(format!("{h}.dp / {h}.resistance")),
            "zeta" | "C_d" | "K_v" => {
                let mass = law::quadratic(&mut self.out, selector);
                self.mass(mass);
            }
            "length" => {
                let mass = law::pipe(&mut self.out);
                self.mass(mass);
            }
            "curve" => {
                let volume = pump::curve(h, self.fields, problems)?;
                self.pump(volume);
            }
            _ => {
                let given = ["a", "b"].map(|key| self.fields.has(key));
                let Some(volume) = law::parabola(&mut self.out, given) else {
                    let message = format!("{} has neither `a` nor `b`", self.fields.owner.words());
                    problems.push(self.fields.missing("b", message));
                    return None;
                };
                self.pump(volume);
            }
        }
        Some(true)
    }

    /// The pressure difference, from the text of both ends.
    fn dp(&mut self) {
        let end = |key| match self.fields.get(key).map(|raw| &raw.kind) {
            Some(RawKind::String { text, .. }) => text.clone(),
            _ => String::new(),
        };
        let text = format!("{} - {}", end("from"), end("to"));
        self.out.value("dp", PRESSURE, text);
    }

    /// A flow that is written: of volume if there is a density.
    fn given_flow(&mut self, fluid: Needs) -> bool {
        let Some(raw) = self.fields.get("flow") else { return false };
        let (name, ty) = match fluid {
            Needs::Nothing => ("", MASS_FLOW),
            _ => ("volume_flow", VOLUME_FLOW),
        };
        let h = self.out.here;
        let text = with_difference(raw, h);
        match &text {
            Some(text) => {
                self.dp();
                let value = RawValue::text(text.clone(), &raw.span);
                self.out.put(ValueKind::Value.section(), name, value);
            }
            None => self.out.given(name, raw),
        }
        self.out.typed(name, ty);
        if fluid != Needs::Nothing {
            self.out.value("", MASS_FLOW, format!("{h}.volume_flow * {h}.density"));
        }
        text.is_some()
    }

    fn volume(&mut self, volume: String) {
        let h = self.out.here;
        self.out.value("volume_flow", VOLUME_FLOW, volume);
        self.out.value("", MASS_FLOW, format!("{h}.volume_flow * {h}.density"));
    }

    fn mass(&mut self, mass: String) {
        let h = self.out.here;
        self.out.value("", MASS_FLOW, mass);
        self.out.value("volume_flow", VOLUME_FLOW, format!("{h} / {h}.density"));
    }

    /// A pump takes the power of its flow and pressure, over its efficiency; none if the flow drives
    /// it: no power comes back.
    fn pump(&mut self, volume: String) {
        let h = self.out.here;
        self.volume(volume);
        let power = format!("max(-{h}.dp * {h}.volume_flow, 0 [W]) / {h}.efficiency");
        self.out.value("power", Type::of(Dimension::POWER), power);
    }
}

impl Needs {
    fn max_of(self, other: Self) -> Self {
        if self > other { self } else { other }
    }
}

/// The expression of a flow with the difference of its branch in the place of `dp`; `None` if it
/// does not read it.
fn with_difference(raw: &RawValue, here: &str) -> Option<String> {
    let RawKind::String { text, .. } = &raw.kind else { return None };
    let expression = Expression::parse(text).ok()?;
    let names = expression.names().into_iter();
    let places: Vec<_> = names.filter(|(name, _)| name == "dp").map(|(_, place)| place).collect();
    let mut whole = text.clone();
    places.iter().rev().for_each(|place| whole.replace_range(place.clone(), &format!("{here}.dp")));
    (!places.is_empty()).then_some(whole)
}
