//! Adds states and named values.

use std::sync::Arc;

use lptn_laws::Kind;
use lptn_units::{Dimension, Expression, Problems, Program, Type, Unit, UnitError};

use crate::builder::{NetworkBuilder, Path};
use crate::error::BuildErrorKind;
use crate::id::{Item, NodeId, SourceId, StateId, ValueId};
use crate::parts::named_value::NamedValue;
use crate::parts::result::Report;
use crate::parts::state::{State, inner_name, scale_of};
use crate::scope::Context;
use crate::value::{Input, Value};

const POWER: Type = Type::of(Dimension::POWER);

/// Rate of a state that no bound stops, in SI units.
const FREE: f64 = 1e300;

/// Heat in W that stands for one SI unit of a balance: for flows in kg/s the balances of pressures
/// are then as large as those of heat.
const HEAT_OF_BALANCE: f64 = 1e3;

/// The start, the rate and the bounds of a state, with types that were checked.
#[derive(Clone, Copy, Debug)]
pub struct StateLaw<'a> {
    /// Its value at the start, over parameters.
    pub start: &'a Expression,
    /// Its change in its unit per second; for a state with a balance the expression that is zero,
    /// for a sampled state its value from the next sample on.
    pub rate: &'a Expression,
    /// The time between samples, over parameters, of a sampled state.
    pub every: Option<&'a Expression>,
    /// Its least and its greatest value, over parameters.
    pub bounds: [Option<&'a Expression>; 2],
}

impl NetworkBuilder {
    /// Adds a state of a type and a usual size in SI units, from which its tolerance follows: an
    /// error of 1e-5 K is about 1e-7 of the size. The size of a temperature is not used.
    ///
    /// Expressions that are compiled afterwards may use its name where they may use the temperature
    /// of a node. [`NetworkBuilder::state_law`] gives its start and its rate.
    pub fn state(&mut self, name: &str, ty: Type, size: f64) -> StateId {
        let id = self.push_state(name, ty, (size, false));
        let node = self.parts.states[id.index()].node;
        self.parts.nodes[node.index()].capacity = Some(Value::Constant(1.0));
        id
    }

    /// Adds a state that has at every moment the value at which its balance is zero, such as the
    /// pressure of a junction. The balance has to fall while the value rises.
    pub fn balanced_state(&mut self, name: &str, ty: Type, size: f64) -> StateId {
        let id = self.push_state(name, ty, (size, true));
        let node = self.parts.states[id.index()].node;
        self.parts.nodes[node.index()].massless = true;
        id
    }

    fn push_state(&mut self, name: &str, ty: Type, (size, balanced): (f64, bool)) -> StateId {
        let id = StateId::from_len(self.parts.states.len());
        let item = Item::State(id);
        if !(size.is_finite() && size > 0.0) {
            self.error(name, BuildErrorKind::StateSize { state: id, size });
        }
        let scale = scale_of(size, ty, balanced);
        let meaning = Expression::scaled(&inner_name(name), scale, ty);
        if meaning.is_none() {
            self.error(name, BuildErrorKind::StateSize { state: id, size });
        }
        let node = self.push_node(name, None, None, false);
        self.parts.states.push(State {
            name: name.to_owned(),
            ty,
            scale,
            balanced,
            every: None,
            node,
            source: None,
            start: None,
            bounds: [None, None],
            unit: None,
            meaning: Arc::new(meaning.unwrap_or_else(|| Expression::literal(1.0, Type::SCALAR))),
        });
        self.register_value(name, item);
        id
    }

    /// The node that contains a state.
    pub fn node_of_state(&self, id: StateId) -> NodeId {
        self.parts.states[id.index()].node
    }

    /// True for the node of a state.
    pub fn is_state(&self, node: NodeId) -> bool {
        self.parts.state_at(node).is_some()
    }

    /// Starts a state at a value in SI units, in place of its own start.
    pub fn start_state_at(&mut self, id: StateId, value: f64) {
        let state = &mut self.parts.states[id.index()];
        state.start = Some(Value::Constant(value));
        let (node, kelvin) = (state.node, state.kelvin(value));
        self.start_at(node, crate::Temperature(kelvin));
    }

    /// Sets the unit in which a state is shown; a unit of another dimension is ignored.
    pub fn show_state_in(&mut self, id: StateId, unit: Unit) {
        let state = &mut self.parts.states[id.index()];
        if unit.ty.dimension == state.ty.dimension {
            state.unit = Some(unit);
        }
    }

    /// Gives a state its start, its rate and its bounds. At a bound the rate counts only inwards.
    ///
    /// # Errors
    /// Every problem of the texts: unknown names, dimensions.
    pub fn state_law(
        &mut self,
        id: StateId,
        law: StateLaw<'_>,
    ) -> Result<SourceId, Problems<UnitError>> {
        let (name, ty, scale, balanced) = {
            let state = &self.parts.states[id.index()];
            (state.name.clone(), state.ty, state.scale, state.balanced)
        };
        let start = law.start.compile(&self.scope(Context::Time), Some(ty))?;
        let bound = |bound: Option<&Expression>| {
            let scope = self.scope(Context::Time);
            bound.map(|bound| bound.compile(&scope, Some(ty))).transpose()
        };
        let bounds = [bound(law.bounds[0])?, bound(law.bounds[1])?];
        let every = law.every.map(|every| {
            every.compile(&self.scope(Context::Time), Some(Type::of(Dimension::TIME)))
        });
        let every = every.transpose()?;
        let inner = law.start.inside(&in_kelvin(ty, scale), HOLE);
        let inner = inner.compile(&self.scope(Context::Time), None)?;
        let frame = match law.every {
            _ if balanced => {
                balance_as_heat(law.rate.compile(&self.scope(Context::Control), None)?.ty())
            }
            Some(every) => change_as_heat(&name, (ty, scale), every),
            None => as_heat(&name, ty, scale, law.bounds),
        };
        let rate = law.rate.inside(&frame, HOLE);
        let heat = rate.compile(&self.scope(Context::Control), Some(POWER))?;
        let node = self.parts.states[id.index()].node;
        self.parts.nodes[node.index()].initial = Some(Value::Expression(Arc::new(inner)));
        let into = [(node.into(), 1.0)];
        let source = self.push_source(name.as_str().into(), Kind::Source, &into, Path::heat(heat));
        let state = &mut self.parts.states[id.index()];
        state.source = Some(source);
        state.start = Some(number(start));
        state.every = every.map(number);
        state.bounds = bounds.map(|bound| bound.map(number));
        Ok(source)
    }

    /// Adds a named value over parameters, signals, controls, states and temperatures. Expressions
    /// that are compiled afterwards may use it where they may use the temperature of a node. It is
    /// a report too if it is `shown`.
    ///
    /// # Errors
    /// Every problem of the text: unknown names, dimensions.
    pub fn named_value(
        &mut self,
        name: &str,
        expression: &Expression,
        shown: bool,
    ) -> Result<ValueId, Problems<UnitError>> {
        let scope = self.scope(Context::Control);
        let (program, meaning) =
            (expression.compile(&scope, None)?, expression.inlined(&scope).into_owned());
        let ty = program.ty();
        let id = ValueId::from_len(self.parts.named_values.len());
        let text = expression.meant();
        if shown {
            let (name, text) = (name.to_owned(), text.clone());
            let value = Value::Expression(Arc::new(program));
            self.parts.reports.push(Report { name, value, ty, over_time: None, text });
        }
        self.parts.named_values.push(NamedValue {
            name: name.to_owned(),
            ty,
            text,
            meaning: Arc::new(meaning),
        });
        self.register_value(name, Item::Value(id));
        Ok(id)
    }

    /// The value of an input in SI units with the parameters added up to now at their own values;
    /// `None` if it depends on more.
    pub fn nominal(&self, input: &Input) -> Option<f64> {
        let mut scope = crate::evaluation::Evaluation::new(&self.parts.layout, &[]);
        for (i, parameter) in self.parts.parameters.iter().enumerate() {
            let value = parameter.value.at(&mut scope).ok()?;
            scope.set_parameter(i, value);
        }
        input.value.at(&mut scope).ok().filter(|value| value.is_finite())
    }
}

fn number(program: Program) -> Value {
    Value::Expression(program.into()).folded()
}

/// The place of the rate or of the start in a template.
const HOLE: &str = "x?";

/// An expression with others in the place of its names. Its own names become ones that cannot be
/// written, so that those of the others are never meant.
fn template(text: &str, parts: &[(&str, &Expression)]) -> Expression {
    let hidden = |name: &str| format!("{name}?");
    let template = Expression::parse(text);
    let template = template.unwrap_or_else(|_| Expression::literal(f64::NAN, Type::SCALAR));
    let parts: Vec<(String, &Expression)> =
        parts.iter().map(|(name, part)| (hidden(name), *part)).collect();
    let parts: Vec<(&str, &Expression)> =
        parts.iter().map(|(name, part)| (name.as_str(), *part)).collect();
    template.renamed(&|name| Some(hidden(name))).with(&parts)
}

/// The temperature of the node of a state in K, as a difference, for the value `x`.
fn in_kelvin(ty: Type, scale: f64) -> Expression {
    if ty.absolute {
        return template("kelvin(x)", &[]);
    }
    template("x * one / scale", &[("one", &kelvin()), ("scale", &Expression::literal(scale, ty))])
}

fn kelvin() -> Expression {
    Expression::literal(1.0, Type::of(Dimension::TEMPERATURE))
}

/// The heat in W into the node of a state for the balance `x` of this type.
fn balance_as_heat(ty: Type) -> Expression {
    let heat = Expression::literal(HEAT_OF_BALANCE, POWER);
    let one = Expression::literal(1.0, Type::of(ty.dimension));
    template("x * heat / one", &[("heat", &heat), ("one", &one)])
}

/// The heat in W into the node of a sampled state, of 1 J/K, for the value `x` from the next sample
/// on.
fn change_as_heat(name: &str, (ty, scale): (Type, f64), every: &Expression) -> Expression {
    let own = template("own", &[]).renamed(&|_| Some(name.to_owned()));
    let (energy, scale) = (
        Expression::literal(1.0, Type::of(Dimension::ENERGY)),
        Expression::literal(scale, Type::of(ty.dimension)),
    );
    let parts = [("own", &own), ("every", every), ("energy", &energy), ("scale", &scale)];
    template("(x - own) / every * energy / scale", &parts)
}

/// The heat in W into the node of a state, of 1 J/K, for the rate `x`.
fn as_heat(name: &str, ty: Type, scale: f64, bounds: [Option<&Expression>; 2]) -> Expression {
    let plain = Type::of(ty.dimension);
    let per_second = ty.dimension.checked_div(Dimension::TIME).unwrap_or(Dimension::NONE);
    let rate = |value: f64| Expression::literal(value, Type::of(per_second));
    let (stopped, up, down) = (rate(0.0), rate(FREE), rate(-FREE));
    let text = match bounds {
        [None, None] => "x",
        [Some(_), None] => "max(x, if(own < least, stopped, down))",
        [None, Some(_)] => "min(x, if(own > most, stopped, up))",
        [Some(_), Some(_)] => {
            "max(min(x, if(own > most, stopped, up)), if(own < least, stopped, down))"
        }
    };
    let own = template("own", &[]).renamed(&|_| Some(name.to_owned()));
    let mut parts = vec![("stopped", &stopped), ("up", &up), ("down", &down), ("own", &own)];
    parts.extend(bounds[0].map(|least| ("least", least)));
    parts.extend(bounds[1].map(|most| ("most", most)));
    let (energy, scale) =
        (Expression::literal(1.0, Type::of(Dimension::ENERGY)), Expression::literal(scale, plain));
    let rate = template(text, &parts);
    template("rate * energy / scale", &[("rate", &rate), ("energy", &energy), ("scale", &scale)])
}
