//! Laws by which conductors carry heat and sources put it into nodes, with their values, and their
//! results on numbers or dual numbers.

use std::sync::Arc;

use lptn_laws::{Carries, Formula, Range};
use lptn_units::{Dimension, EvalError, Scalar, Type};

use crate::along::Along;
use crate::evaluation::Evaluation;
use crate::id::{Field, FluidId};
use crate::input_error::InputProblem;
use crate::slot;
use crate::value::{Input, Value};

/// The law of a conductor or source, with one value for each of its fields. Heat flow is positive
/// from `from` to `to`, and into the nodes of a source; that of a stream goes one way only.
///
/// A builder takes a law of [`Input`]s, a network has one of [`Value`]s in SI units.
#[derive(Clone, Debug)]
pub struct Law<V = Value> {
    values: Values<V>,
    /// [`NO_FLUID`] if there is none: an option is twice as large, in every conductor.
    fluid: FluidId,
    formula: Formula,
}

const NO_FLUID: FluidId = FluidId(u32::MAX);

/// Nearly all laws of a large network have one value.
#[derive(Clone, Debug)]
enum Values<V> {
    One([V; 1]),
    /// Shared by the paths of a body, which are alike.
    Several(Arc<Vec<V>>),
}

impl<V> Values<V> {
    fn as_slice(&self) -> &[V] {
        match self {
            Self::One(value) => value,
            Self::Several(values) => values,
        }
    }
}

impl<V> From<Vec<V>> for Values<V> {
    fn from(values: Vec<V>) -> Self {
        match <[V; 1]>::try_from(values) {
            Ok(value) => Self::One(value),
            Err(values) => Self::Several(Arc::new(values)),
        }
    }
}

impl<V> Law<V> {
    /// A law with a value for each of its fields, in their order.
    pub fn new(formula: Formula, values: impl Into<Vec<V>>) -> Self {
        Self { formula, fluid: NO_FLUID, values: values.into().into() }
    }

    /// A law of a stream of a fluid.
    pub fn of_fluid(formula: Formula, fluid: FluidId, values: impl Into<Vec<V>>) -> Self {
        Self { fluid, ..Self::new(formula, values) }
    }

    /// The formula of the law.
    pub fn formula(&self) -> Formula {
        self.formula
    }

    /// Meaning of the value of its formula: a conductance, an exchange area, a flow.
    pub fn carries(&self) -> Carries {
        self.formula.declaration().carries
    }

    /// The fluid that it carries.
    pub fn fluid(&self) -> Option<FluidId> {
        Some(self.fluid).filter(|fluid| *fluid != NO_FLUID)
    }

    /// True if heat goes with a fluid that flows from one end to the other.
    pub fn is_stream(&self) -> bool {
        self.carries().is_stream()
    }

    /// Its values, in the order of its fields.
    pub fn values(&self) -> &[V] {
        self.values.as_slice()
    }

    /// Its values with their fields.
    pub fn parts(&self) -> impl Iterator<Item = (Field, &V)> {
        self.values().iter().enumerate().map(|(i, value)| (Field::law(self.formula, i), value))
    }

    /// The value of the field of this key.
    pub fn value(&self, key: &str) -> Option<&V> {
        self.values().get(self.formula.position(key)?)
    }

    /// The value of which it takes the mean along its path.
    pub(crate) fn along(&self) -> Option<&V> {
        let fields = self.formula.declaration().fields;
        self.values().get(fields.iter().position(|field| field.along)?)
    }

    /// The same law with other values.
    pub fn map<U>(self, mut f: impl FnMut(Field, V) -> U) -> Law<U>
    where
        V: Clone,
    {
        let Self { formula, fluid, values } = self;
        let values = match values {
            Values::One([value]) => Values::One([f(Field::law(formula, 0), value)]),
            Values::Several(values) => {
                let others = Arc::unwrap_or_clone(values).into_iter().enumerate();
                Values::Several(Arc::new(
                    others.map(|(i, value)| f(Field::law(formula, i), value)).collect(),
                ))
            }
        };
        Law { formula, fluid, values }
    }

    /// The same law with another value for the field of this key.
    #[must_use]
    pub(crate) fn with(self, key: &str, change: impl Fn(V) -> V) -> Self
    where
        V: Clone,
    {
        if self.values().len() != self.formula.declaration().fields.len() {
            return self; // which is told when the path is added
        }
        self.map(|field, value| if field.key() == key { change(value) } else { value })
    }
}

impl Law<Input> {
    /// A resistance in K/W.
    pub fn resistance(value: impl Into<Input>) -> Self {
        Self::new(Formula::Resistance, [value.into()])
    }

    /// A conductance in W/K.
    pub fn conductance(value: impl Into<Input>) -> Self {
        Self::new(Formula::Conductance, [value.into()])
    }

    /// A film coefficient in W/(m^2 K) and an area in m^2, of a wetted surface or a contact.
    pub fn film(coefficient: impl Into<Input>, area: impl Into<Input>) -> Self {
        Self::new(Formula::Film, [coefficient.into(), area.into()])
    }

    /// Two surfaces with an exchange area in m^2.
    pub fn radiation(area: impl Into<Input>) -> Self {
        Self::new(Formula::ExchangeArea, [area.into()])
    }

    /// A given heat in W.
    pub fn heat(power: impl Into<Input>) -> Self {
        Self::new(Formula::Given, [power.into()])
    }

    /// A stream of a capacity rate in W/K, positive from `from` to `to`.
    pub fn stream(capacity_rate: impl Into<Input>) -> Self {
        Self::new(Formula::CapacityRate, [capacity_rate.into()])
    }
}

impl Law {
    /// True if it is a constant resistance or conductance, as nearly all of a large network are.
    pub(crate) fn is_number(&self) -> bool {
        matches!(self.formula, Formula::Resistance | Formula::Conductance)
            && matches!(self.values(), [Value::Constant(_)])
    }

    /// The conductance in W/K of a constant resistance or conductance, if it is valid.
    pub(crate) fn number(&self) -> Option<f64> {
        let [Value::Constant(value)] = self.values() else { return None };
        let conductance = match self.formula {
            Formula::Conductance => *value,
            Formula::Resistance if *value > 0.0 => 1.0 / value,
            _ => return None,
        };
        (conductance.is_finite() && conductance > 0.0).then_some(conductance)
    }

    /// True if it is the same law with the same values; `false` for laws that are not compared.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let (own, others) = (self.values(), other.values());
        let comparable =
            !self.is_stream() && self.formula == other.formula && own.len() == others.len();
        comparable && own.iter().zip(others).all(|(a, b)| a.is_same(b))
    }

    /// The conductance in W/K at the state of `scope`; 0 for a stream.
    ///
    /// # Errors
    /// The error of the evaluation of an expression; a value that its field cannot have counts as
    /// not a number.
    pub fn conductance_at(&self, scope: &mut Evaluation) -> Result<f64, EvalError> {
        At::new(scope.plain()).conductance(self).map_err(|(_, problem)| match problem {
            InputProblem::Evaluation(error) => *error,
            _ => EvalError::NotFinite { value: f64::NAN, span: 0..0 },
        })
    }
}

/// The problem of a value of a field that may change during a run.
pub(crate) fn impossible(field: &lptn_laws::FieldDeclaration, value: f64) -> Option<InputProblem> {
    const CONDUCTANCE: Type = Type::of(Dimension::CONDUCTANCE);
    const RESISTANCE: Type = Type::of(Dimension::RESISTANCE);
    match field.range {
        Range::Finite => None,
        Range::Fraction => {
            (!(0.0..=1.0).contains(&value)).then_some(InputProblem::NotAFraction(value))
        }
        range @ Range::Degrees(..) => {
            (!range.has_angle(value)).then_some(InputProblem::Angle(value.to_degrees()))
        }
        _ if value >= 0.0 || value.is_nan() => None,
        Range::Temperature => Some(InputProblem::BelowAbsoluteZero(value)),
        Range::Positive if field.ty == CONDUCTANCE => {
            Some(InputProblem::NegativeConductance(value))
        }
        Range::Positive if field.ty == RESISTANCE => {
            Some(InputProblem::NegativeConductance(value.recip()))
        }
        Range::Positive | Range::NotNegative | Range::Count => Some(InputProblem::Negative(value)),
    }
}

/// Most fields of laws that are not correlations: room for more takes time to clear.
const FEW_FIELDS: usize = 4;

/// Slots on numbers or dual numbers, with the stack that programs need.
pub(crate) struct At<'a, S> {
    pub(crate) slots: &'a mut [S],
    pub(crate) stack: &'a mut Vec<S>,
    /// The property that a path takes the mean of; without one it is taken at the mean of the ends.
    pub(crate) along: Option<&'a Along>,
    /// True if slots other than temperatures have derivatives too.
    pub(crate) by_parameters: bool,
}

impl<'a, S> At<'a, S> {
    /// These slots, for a law that takes no mean along a path.
    pub(crate) fn new((slots, stack): (&'a mut [S], &'a mut Vec<S>)) -> Self {
        Self { slots, stack, along: None, by_parameters: false }
    }

    /// The same for a path.
    pub(crate) fn path(slots: (&'a mut [S], &'a mut Vec<S>), along: Option<&'a Along>) -> Self {
        Self { along, ..Self::new(slots) }
    }
}

impl<S: Scalar> At<'_, S> {
    /// The value of a field of a law, which has to be one that it can have.
    pub(crate) fn get(&mut self, law: &Law, position: usize) -> Result<S, (Field, InputProblem)> {
        let failed = |problem| (Field::law(law.formula, position), problem);
        let declared = &law.formula.declaration().fields[position];
        if let (true, Some(along)) = (declared.along, self.along) {
            let value = &law.values()[position];
            return self.mean(along, value, declared).map_err(failed);
        }
        let value = law.values()[position].on(self.slots, self.stack);
        let value = value.map_err(|error| failed(error.into()))?;
        match impossible(declared, value.sample()) {
            Some(problem) => Err(failed(problem)),
            None => Ok(value),
        }
    }

    /// The mean of a property between the temperatures of the ends.
    fn mean(
        &mut self,
        along: &Along,
        value: &Value,
        declared: &lptn_laws::FieldDeclaration,
    ) -> Result<S, InputProblem> {
        let [from, to] = self.ends();
        let ends = [from.value(), to.value()];
        match along.mean(ends, self.slots) {
            Ok(mean) if self.by_parameters => {
                let change = along.change(ends, self.slots, self.stack)?;
                Ok(from.chain2(to, mean.value, mean.slopes) + change)
            }
            Ok(mean) => Ok(from.chain2(to, mean.value, mean.slopes)),
            Err(temperature) => {
                self.slots[slot::OWN as usize] = S::from_f64(temperature);
                let there = value.on(self.slots, self.stack)?.value();
                let refused = impossible(declared, there);
                Err(refused.unwrap_or(InputProblem::NoMean { temperature }))
            }
        }
    }

    /// The value of a law for these slots; [`Law::carries`] gives its meaning.
    pub(crate) fn value(&mut self, law: &Law) -> Result<S, (Field, InputProblem)> {
        let of = |values: &[S], ends| law.formula.value(values, ends);
        match law.values().len() {
            0..=FEW_FIELDS => self.of_values::<FEW_FIELDS, S>(law, of),
            _ => self.of_values::<{ Formula::MOST_FIELDS }, S>(law, of),
        }
    }

    /// A function of the values of a law, of which there are `MOST` at most, and of its ends.
    pub(crate) fn of_values<const MOST: usize, R>(
        &mut self,
        law: &Law,
        function: impl FnOnce(&[S], [S; 2]) -> R,
    ) -> Result<R, (Field, InputProblem)> {
        let mut values = [S::from_f64(0.0); MOST];
        let count = law.values().len();
        for (i, value) in values[..count].iter_mut().enumerate() {
            *value = self.get(law, i)?;
        }
        Ok(function(&values[..count], self.ends()))
    }

    /// The heat of a law of sources in W for these slots.
    pub(crate) fn heat(&mut self, law: &Law) -> Result<S, (Field, InputProblem)> {
        let heat = match law.formula {
            Formula::Given => self.get(law, 0)?,
            _ => self.value(law)?,
        };
        match heat.is_finite() {
            true => Ok(heat),
            false => Err((Field::law(law.formula, 0), InputProblem::NotFinite(heat.value()))),
        }
    }

    fn ends(&self) -> [S; 2] {
        [self.slots[slot::FROM as usize], self.slots[slot::TO as usize]]
    }

    /// The conductance of a law that is not a stream, in W/K, for these slots.
    pub(crate) fn conductance(&mut self, law: &Law) -> Result<S, (Field, InputProblem)> {
        match law.carries() {
            Carries::Conductance | Carries::Radiation => {
                let value = self.value(law)?;
                Ok(self.conductance_of(law, value))
            }
            _ => Ok(S::from_f64(0.0)),
        }
    }

    /// The same if the value of the law is known.
    pub(crate) fn conductance_of(&self, law: &Law, value: S) -> S {
        let [from, to] = self.ends();
        match law.carries() {
            Carries::Radiation => lptn_laws::radiation_conductance(value, from, to),
            _ => value,
        }
    }
}

/// The heat flow of a conductor, as far as it is known before a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConductorFlow {
    /// `q = G (T_from - T_to)` with this constant conductance in W/K.
    Conductance(f64),
    /// `q = sigma Gr (T_from^4 - T_to^4)` with this constant exchange area in m^2.
    Radiation(f64),
    /// A stream of this constant capacity rate in W/K: `to` receives `mcp (T_from - T_to)`; for a
    /// negative one `from` receives `-mcp (T_to - T_from)`.
    Stream(f64),
    /// Anything else: [`Network::exchange`](crate::Network::exchange).
    Variable,
}

/// Heat received by the two ends of a conductor in W.
pub type Received<S = f64> = [S; 2];
