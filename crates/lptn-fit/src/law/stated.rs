//! Laws of the speed as they are stated: a coefficient whose unit determines the exponent, or an
//! expression.

use lptn_units::{
    Dimension, Expression, Program, Scope, Symbol, Type, parse_quantity, written_quantity,
};

use super::error::LawError;

lptn_units::words! {
/// Quantity that a law gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawOf {
    /// The rise of a temperature, in K.
    Rise = "dT",
    /// The time constant, in s.
    TimeConstant = "t_RC",
    /// The dissipated power, in W.
    Power = "P",
}
/// The paper's symbol: `dT`, `t_RC`, `P`.
pub fn symbol;
}

impl LawOf {
    /// The dimension of its values: temperature, time or power.
    pub fn dimension(self) -> Dimension {
        match self {
            Self::Rise => Dimension::TEMPERATURE,
            Self::TimeConstant => Dimension::TIME,
            Self::Power => Dimension::POWER,
        }
    }
}

/// An exponent, or its mean over a range: the growth of a quantity in per cent for one per cent of
/// speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent {
    /// Per cent of the quantity for one per cent of speed.
    pub value: f64,
    /// Its standard error; `None` if the exponent was not fitted but stated.
    pub standard_error: Option<f64>,
}

/// A law of the speed.
#[derive(Clone, Debug)]
pub struct StatedLaw {
    /// The quantity that it gives.
    pub of: LawOf,
    /// Its text as written.
    pub text: String,
    /// The relative standard error of its values, if one is stated.
    pub relative_error: Option<f64>,
    form: Form,
}

#[derive(Clone, Debug)]
enum Form {
    /// A coefficient in SI units and an exponent.
    Power(f64, f64),
    Written(Box<Program>),
}

/// The speed, under its usual name.
struct Omega;

impl Scope for Omega {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let ty = Type::of(Dimension::ANGULAR_VELOCITY);
        (name == "omega").then_some(Symbol { slot: 0, ty, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        vec!["omega".to_owned()]
    }
}

impl StatedLaw {
    /// Reads a law. The unit of a quantity determines its exponent: `0.0084 ± 0.0011 K/rpm` is
    /// proportional to the speed, `18.6 ± 3.8 min` does not depend on it, and `87 ± 15
    /// uW/rpm^(5/3)` is proportional to its power 5/3. Anything else is an expression in `omega`.
    ///
    /// # Errors
    /// [`LawError::Units`] if it cannot be read, [`LawError::NotALaw`] for another dimension.
    pub fn parse(of: LawOf, text: &str) -> Result<Self, LawError> {
        let refused = |errors| LawError::Units { law: text.to_owned(), errors };
        if written_quantity(text).is_none() {
            let expression = Expression::parse(text).map_err(|error| refused(error.into()))?;
            let program =
                expression.compile(&Omega, Some(Type::of(of.dimension()))).map_err(refused)?;
            return Ok(Self {
                of,
                text: text.to_owned(),
                relative_error: None,
                form: Form::Written(Box::new(program)),
            });
        }
        let quantity = parse_quantity(text, None).map_err(|error| refused(error.into()))?;
        let [.., angle] = quantity.ty.dimension.exponents();
        let exponent = angle.checked_neg();
        let speed = exponent.and_then(|e| Dimension::ANGULAR_VELOCITY.checked_pow(e));
        let whole = speed.and_then(|speed| quantity.ty.dimension.checked_mul(speed));
        match (exponent, whole) {
            (Some(exponent), Some(whole)) if whole == of.dimension() && !quantity.ty.absolute => {
                Ok(Self {
                    of,
                    text: text.to_owned(),
                    relative_error: quantity
                        .deviation
                        .map(|spread| spread.sigma(quantity.value) / quantity.value.abs()),
                    form: Form::Power(quantity.value, exponent.to_f64()),
                })
            }
            _ => Err(LawError::NotALaw { of: of.symbol(), found: quantity.ty }),
        }
    }

    /// A power of the speed through `value` (SI units) at `speed` (rad/s).
    pub(crate) fn through(
        of: LawOf,
        (speed, value): (f64, f64),
        exponent: f64,
        relative_error: f64,
    ) -> Self {
        let form = Form::Power(value * speed.powf(-exponent), exponent);
        Self { of, text: String::new(), relative_error: Some(relative_error), form }
    }

    /// Its value in SI units at a speed in rad/s.
    ///
    /// # Errors
    /// [`LawError::NotPositive`] if it has no positive value.
    pub fn value(&self, speed: f64) -> Result<f64, LawError> {
        let value = match &self.form {
            Form::Power(coefficient, exponent) => coefficient * speed.powf(*exponent),
            Form::Written(program) => program.eval(&[speed], &mut Vec::new()).unwrap_or(f64::NAN),
        };
        let positive = value.is_finite() && value > 0.0;
        if positive {
            Ok(value)
        } else {
            Err(LawError::NotPositive { of: self.of.symbol(), speed })
        }
    }

    /// Its exponent; for an expression, the mean over a range of speeds.
    ///
    /// # Errors
    /// [`LawError::NotPositive`] as for [`StatedLaw::value`].
    pub fn exponent(&self, (low, high): (f64, f64)) -> Result<f64, LawError> {
        match &self.form {
            Form::Power(_, exponent) => Ok(*exponent),
            Form::Written(_) => Ok((self.value(high)? / self.value(low)?).ln() / (high / low).ln()),
        }
    }
}
