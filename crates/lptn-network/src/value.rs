//! Values of elements: a constant, or a compiled expression over parameters and time.

use std::sync::Arc;

use lptn_units::{EvalError, Program, Quantity, Type};

use crate::material::Lump;

/// Slots that every expression of a network shares; parameters follow at [`slot::PARAMETERS`], then, for
/// expressions of results, the temperatures of the nodes and of the boundaries.
pub mod slot {
    /// The run's time `t` in s.
    pub const TIME: u32 = 0;
    /// The time that comparisons see: a point inside the present segment. The truth of a comparison of `t`
    /// thus never changes while a step is being computed; the segments end where it does change.
    pub const SEGMENT: u32 = 1;
    /// The first parameter.
    pub const PARAMETERS: u32 = 2;
}

/// The value of one field in SI units.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number in SI units; an absolute temperature in K.
    Constant(f64),
    /// An expression over the slots of [`slot`].
    Expression(Arc<Program>),
    /// A product of values, such as a mass and a specific heat.
    Product(Arc<[Value]>),
}

impl Value {
    /// The value where `scope` stands, in SI units.
    ///
    /// # Errors
    /// What the expression's evaluation reports, such as a negative base under a non-integer exponent.
    pub fn at(&self, scope: &mut Evaluation) -> Result<f64, EvalError> {
        match self {
            Self::Constant(value) => Ok(*value),
            Self::Expression(program) => program.eval(&scope.slots, &mut scope.stack),
            Self::Product(factors) => factors.iter().try_fold(1.0, |product, f| Ok(product * f.at(scope)?)),
        }
    }

    /// Whether the value changes with time.
    pub fn depends_on_time(&self) -> bool {
        match self {
            Self::Constant(_) => false,
            Self::Expression(program) => {
                program.slots().iter().any(|&s| s == slot::TIME || s == slot::SEGMENT)
            }
            Self::Product(factors) => factors.iter().any(Self::depends_on_time),
        }
    }

    /// The slots an expression reads, sorted, each once; none for a constant.
    pub fn slots(&self) -> Vec<u32> {
        match self {
            Self::Constant(_) => Vec::new(),
            Self::Expression(program) => program.slots(),
            Self::Product(factors) => {
                let mut slots: Vec<u32> = factors.iter().flat_map(Self::slots).collect();
                slots.sort_unstable();
                slots.dedup();
                slots
            }
        }
    }
}

/// A value together with its type, as the builder takes it: units are checked there.
#[derive(Clone, Debug)]
pub struct Input {
    pub(crate) value: Value,
    pub(crate) ty: Type,
    pub(crate) deviation: Option<f64>,
    pub(crate) lump: Option<Lump>,
}

impl Input {
    /// Its type.
    pub fn ty(&self) -> Type {
        self.ty
    }
}

impl From<Quantity> for Input {
    fn from(quantity: Quantity) -> Self {
        Self {
            value: Value::Constant(quantity.value),
            ty: quantity.ty,
            deviation: quantity.deviation,
            lump: None,
        }
    }
}

impl From<Program> for Input {
    fn from(program: Program) -> Self {
        let ty = program.ty();
        Self { value: Value::Expression(Arc::new(program)), ty, deviation: None, lump: None }
    }
}

/// The numbers that expressions read: time and parameters, and for expressions of results the temperatures. One
/// per thread; reused, so that evaluating allocates nothing.
#[derive(Clone, Debug)]
pub struct Evaluation {
    slots: Vec<f64>,
    /// Where the temperatures begin.
    fixed: usize,
    stack: Vec<f64>,
}

impl Evaluation {
    /// An evaluation at time 0 with these parameters, in SI units and in the order of their ids.
    pub(crate) fn new(parameters: &[f64]) -> Self {
        let mut slots = vec![0.0; slot::PARAMETERS as usize];
        slots.extend_from_slice(parameters);
        Self { fixed: slots.len(), slots, stack: Vec::new() }
    }

    /// Sets the temperature of every node and boundary in K, in the order of their ids, for expressions of
    /// results.
    pub fn set_temperatures(&mut self, nodes: &[f64], boundaries: &[f64]) {
        self.slots.truncate(self.fixed);
        self.slots.extend_from_slice(nodes);
        self.slots.extend_from_slice(boundaries);
    }

    /// Moves to `time` [s]; comparisons of `t` keep the truth they have at `segment` [s].
    pub fn set_time(&mut self, time: f64, segment: f64) {
        self.slots[slot::TIME as usize] = time;
        self.slots[slot::SEGMENT as usize] = segment;
    }

    /// A program's value at `time` [s].
    pub(crate) fn evaluate(&mut self, program: &Program, time: f64) -> Result<f64, EvalError> {
        self.set_time(time, time);
        program.eval(&self.slots, &mut self.stack)
    }

    pub(crate) fn push_parameter(&mut self, value: f64) {
        self.slots.push(value);
        self.fixed = self.slots.len();
    }
}
