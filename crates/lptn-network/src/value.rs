//! Values of elements: a constant, or a compiled expression.

use std::sync::Arc;

use lptn_units::{EvalError, Program, Quantity, Scalar, Spread, Taylor, Type};

use crate::id::{Field, MaterialId};
use crate::slot;

/// The value of one field in SI units.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number in SI units; an absolute temperature in K.
    Constant(f64),
    /// An expression over the slots of [`slot`](crate::slot).
    Expression(Arc<Program>),
    /// A product of values, such as a mass and a specific heat.
    Product(Arc<Vec<Value>>),
}

impl Value {
    /// A number instead of an expression that reads nothing.
    pub(crate) fn folded(self) -> Self {
        match &self {
            Self::Expression(program) if program.slots().is_empty() => {
                program.eval(&[], &mut Vec::new()).map_or(self, Self::Constant)
            }
            _ => self,
        }
    }

    /// The value for these slots, on numbers or on dual numbers.
    pub(crate) fn on<S: Scalar>(&self, slots: &[S], stack: &mut Vec<S>) -> Result<S, EvalError> {
        match self {
            Self::Constant(value) => Ok(S::from_f64(*value)),
            Self::Expression(program) => program.eval(slots, stack),
            Self::Product(factors) => factors
                .iter()
                .try_fold(S::from_f64(1.0), |product, f| Ok(product * f.on(slots, stack)?)),
        }
    }

    /// Bounds on the value while the temperature that is its own runs through an interval, in SI
    /// units.
    pub(crate) fn enclose(&self, over: [f64; 2], slots: &[f64]) -> Taylor {
        match self {
            Self::Constant(value) => Taylor::constant(*value),
            Self::Expression(program) => program.enclose(slot::OWN, over, slots),
            Self::Product(factors) => factors
                .iter()
                .fold(Taylor::constant(1.0), |product, f| product * f.enclose(over, slots)),
        }
    }

    /// True if it is the same number, or the same expression in the same memory.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Constant(a), Self::Constant(b)) => a.to_bits() == b.to_bits(),
            (Self::Expression(a), Self::Expression(b)) => Arc::ptr_eq(a, b),
            (Self::Product(a), Self::Product(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }

    /// Its address in memory: values that share it are the same. 0 for a constant.
    pub(crate) fn address(&self) -> usize {
        match self {
            Self::Constant(_) => 0,
            Self::Expression(program) => Arc::as_ptr(program).addr(),
            Self::Product(factors) => Arc::as_ptr(factors).addr(),
        }
    }

    /// The compiled expressions in it; none for a constant.
    pub fn programs(&self) -> Vec<&Arc<Program>> {
        match self {
            Self::Constant(_) => Vec::new(),
            Self::Expression(program) => vec![program],
            Self::Product(factors) => factors.iter().flat_map(Self::programs).collect(),
        }
    }

    /// The slots an expression reads, sorted, each once; none for a constant.
    pub fn slots(&self) -> Vec<u32> {
        let mut slots = Vec::new();
        self.each_slot(&mut |slot| slots.push(slot));
        slots.sort_unstable();
        slots.dedup();
        slots
    }

    /// Calls `read` with the slots of each expression in it, program by program.
    pub(crate) fn each_slot(&self, read: &mut dyn FnMut(u32)) {
        match self {
            Self::Constant(_) => {}
            Self::Expression(program) => program.slot_list().iter().for_each(|slot| read(*slot)),
            Self::Product(factors) => factors.iter().for_each(|factor| factor.each_slot(read)),
        }
    }
}

/// A value together with its type, as the builder takes it: units are checked there.
#[derive(Clone, Debug)]
pub struct Input {
    pub(crate) value: Value,
    pub(crate) ty: Type,
    pub(crate) deviation: Option<Spread>,
    pub(crate) lump: Option<Lump>,
}

impl Input {
    /// The type that the builder checks against that of the field.
    pub fn ty(&self) -> Type {
        self.ty
    }

    /// A value of a type that was checked before, such as the quantity of a number over time with
    /// the type of that number.
    pub fn of_type(value: Value, ty: Type) -> Self {
        Self { value, ty, deviation: None, lump: None }
    }

    /// A plain number.
    pub fn number(value: f64) -> Self {
        Self { value: Value::Constant(value), ty: Type::SCALAR, deviation: None, lump: None }
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
        Arc::new(program).into()
    }
}

impl From<Arc<Program>> for Input {
    fn from(program: Arc<Program>) -> Self {
        let ty = program.ty();
        Self { value: Value::Expression(program), ty, deviation: None, lump: None }
    }
}

/// The amount of a material.
#[derive(Clone, Debug)]
pub enum Size<T = Value> {
    /// By mass; in kg.
    Mass(T),
    /// By volume; in m^3.
    Volume(T),
}

/// A lump of a material, from which a capacity was computed.
#[derive(Clone, Debug)]
pub struct Lump {
    /// The material of the lump.
    pub material: MaterialId,
    /// Its amount.
    pub size: Size,
}

impl Lump {
    /// True if it is the same amount of the same material.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let ((own, size), (others, same)) = (self.size.field(), other.size.field());
        self.material == other.material && own == others && size.is_same(same)
    }
}

impl Size {
    pub(crate) fn field(&self) -> (Field, &Value) {
        match self {
            Self::Mass(mass) => (Field::Mass, mass),
            Self::Volume(volume) => (Field::Volume, volume),
        }
    }
}
