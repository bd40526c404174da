//! Limits: what the results of a network have to keep.

use lptn_units::Type;

use crate::evaluation::Evaluation;
use crate::id::{Field, Item, LimitId};
use crate::input_error::{InputError, InputProblem};
use crate::network::Network;
use crate::scope::{Context, NetworkScope};
use crate::value::Value;

/// The side on which a limited quantity has to stay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// It has to stay below the value.
    Below,
    /// It has to stay above the value.
    Above,
}

impl Bound {
    /// The field that holds the value.
    pub fn field(self) -> Field {
        match self {
            Self::Below => Field::Below,
            Self::Above => Field::Above,
        }
    }
}

/// What a broken limit means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// The answer is no.
    Error,
    /// It is worth a look.
    Warning,
}

/// A quantity of the results that has to stay below or above a value.
#[derive(Clone, Debug)]
pub struct Limit {
    /// Its name.
    pub name: String,
    /// The quantity: an expression over parameters, `t`, signals, tables, temperatures and heat flows of the results.
    pub of: Value,
    /// The type of `of` and of `value`.
    pub ty: Type,
    /// The side on which it has to stay.
    pub bound: Bound,
    /// What it has to stay below or above; constant for one set of parameters.
    pub value: Value,
    /// What it means if it is broken.
    pub severity: Severity,
    /// `of` as it was written.
    pub text: String,
}

impl Limit {
    /// The type of the limit's margin: like `of`, but for temperatures a difference.
    pub fn margin_type(&self) -> Type {
        Type { absolute: false, ..self.ty }
    }
}

impl Network {
    /// The limits.
    pub fn limits(&self) -> &[Limit] {
        &self.parts.limits
    }

    /// Ids of all limits.
    pub fn limit_ids(&self) -> impl ExactSizeIterator<Item = LimitId> + use<> {
        (0..self.parts.limits.len()).map(LimitId::from_len)
    }

    /// How far a limit is from being broken where `scope` stands: positive while it is kept, in SI units of
    /// `of`, a difference in K for temperatures. `scope` needs the temperatures of the time that is asked for,
    /// see [`Evaluation::set_temperatures`].
    ///
    /// # Errors
    /// [`InputError`] if an expression fails or gives no number.
    pub fn limit_margin(&self, id: LimitId, scope: &mut Evaluation) -> Result<f64, InputError> {
        let limit = &self.limits()[id.index()];
        let item = Item::Limit(id);
        let of = self.number(item, Field::Of, &limit.of, scope)?;
        let value = self.number(item, limit.bound.field(), &limit.value, scope)?;
        Ok(match limit.bound {
            Bound::Below => value - of,
            Bound::Above => of - value,
        })
    }

    pub(crate) fn number(
        &self,
        item: Item,
        field: Field,
        value: &Value,
        at: &mut Evaluation,
    ) -> Result<f64, InputError> {
        match value.at(at) {
            Ok(x) if x.is_finite() => Ok(x),
            Ok(x) => Err(self.failed(item, (field, InputProblem::NotFinite(x)), at)),
            Err(error) => Err(self.failed(item, (field, error.into()), at)),
        }
    }

    /// The names that expressions of results may use: parameters, `t`, and `NAME.T` of every node and boundary.
    /// What is compiled against it is evaluated in [`Network::evaluation`] after
    /// [`Evaluation::set_temperatures`].
    pub fn post_scope(&self) -> NetworkScope<'_> {
        NetworkScope::new(&self.parts, Context::Result)
    }
}
