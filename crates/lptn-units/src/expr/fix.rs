//! Errors of expressions that show the corrected text.

use super::check::is_temperature;
use super::lexer::splice;
use super::tree::{Id, Node, Operator, Tree};
use crate::dimension::Dimension;
use crate::error::{UnitError, UnitErrorKind as Kind};
use crate::format::{number, rounded};
use crate::quantity::{has_inverse, is_frequency_for_rotation};
use crate::types::Type;

/// The text and its tree.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) text: &'a str,
    pub(crate) tree: &'a Tree,
}

impl Source<'_> {
    pub(crate) fn text_of(&self, id: Id) -> &str {
        self.text.get(self.tree.span(id)).unwrap_or_default()
    }

    /// The whole text with this node replaced.
    pub(crate) fn replace(&self, id: Id, replacement: &str) -> String {
        splice(self.text, &self.tree.span(id), replacement)
    }

    /// The number of a literal, as written, if it is one with a unit.
    fn literal_number(&self, id: Id) -> Option<&str> {
        match self.tree.node(id) {
            Node::Literal { .. } => self.text_of(id).split('[').next().map(str::trim),
            _ => None,
        }
    }

    /// A literal with another unit.
    pub(crate) fn relabel(&self, id: Id, unit: &str) -> Option<String> {
        self.literal_number(id).map(|number| self.replace(id, &format!("{number} [{unit}]")))
    }

    /// `[K]` for a temperature literal, or `[degR]` if it was in Fahrenheit.
    pub(crate) fn as_difference(&self, id: Id) -> Option<String> {
        let fahrenheit = self.text_of(id).contains('F');
        self.relabel(id, if fahrenheit { "degR" } else { "K" })
    }

    /// An absolute temperature that something was to be done to. `signed` tells that a literal would be right
    /// with its sign directly before it.
    pub(crate) fn absolute(&self, id: Id, operation: &'static str, signed: bool) -> UnitError {
        let kelvin = || self.replace(id, &format!("kelvin({})", self.text_of(id)));
        let fix = if signed && self.literal_number(id).is_some() {
            format!("-{}", self.text_of(id))
        } else {
            self.as_difference(id).unwrap_or_else(kelvin)
        };
        UnitError::new(Kind::AbsoluteOperand { operation, fix }, self.tree.span(id))
    }

    /// A node as it can stand in a product.
    pub(crate) fn factor(&self, id: Id) -> String {
        let part = self.text_of(id);
        let sum = matches!(self.tree.node(id), Node::Binary(..) | Node::Compare(..));
        if sum { format!("({part})") } else { part.to_owned() }
    }

    /// The text with this node made what is wanted, where there is a way that is probably meant.
    pub(crate) fn converted(&self, id: Id, found: Type, wanted: Type) -> Option<String> {
        let part = self.factor(id);
        if is_frequency_for_rotation(found, wanted) {
            let turned = || self.replace(id, &format!("{part} * 1 [rev]"));
            return Some(self.in_revolutions(id).unwrap_or_else(turned));
        }
        match self.tree.node(id) {
            Node::Number { .. } => Some(self.replace(id, &format!("{part} [{}]", wanted.usual_unit()))),
            _ if wanted.absolute && is_temperature(found) => {
                let made = || self.replace(id, &format!("absolute({})", self.text_of(id)));
                Some(self.relabel(id, "degC").unwrap_or_else(made))
            }
            _ if found.absolute && is_temperature(wanted) => {
                let made = || self.replace(id, &format!("{part} - 0 [degC]"));
                Some(self.as_difference(id).unwrap_or_else(made))
            }
            _ if wanted.is_scalar() && !found.absolute => Some(self.divided(id, found)),
            _ => None,
        }
    }

    /// The text with this node divided by a value of its own kind.
    pub(crate) fn divided(&self, id: Id, ty: Type) -> String {
        let part = self.factor(id);
        let scale = if ty == Type::of(Dimension::TIME) { 60 } else { 1 };
        self.replace(id, &format!("{part} / {scale} [{}]", ty.dimension.si_unit()))
    }

    /// A condition that is no comparison.
    pub(crate) fn truth_wanted(&self, id: Id, ty: Type) -> UnitError {
        let limit = match (ty.absolute, ty.is_scalar()) {
            (true, _) => "0 [degC]".to_owned(),
            (false, true) => "0.5".to_owned(),
            (false, false) => format!("0 [{}]", ty.dimension.si_unit()),
        };
        let fix = self.replace(id, &format!("{} > {limit}", self.text_of(id)));
        UnitError::new(Kind::TruthWanted { fix }, self.tree.span(id))
    }

    /// The whole is of the wrong type.
    pub(crate) fn mismatch(&self, root: Id, found: Type, wanted: Type) -> UnitError {
        let span = self.tree.span(root);
        let whole = self.text.get(span.clone()).unwrap_or_default();
        let kind = if is_frequency_for_rotation(found, wanted) {
            Kind::Rotation { fix: Some(self.in_revolutions(root).unwrap_or(format!("({whole}) * 1 [rev]"))) }
        } else if wanted.absolute && is_temperature(found) {
            Kind::AbsoluteWanted { fix: format!("absolute({whole})") }
        } else if found.absolute && is_temperature(wanted) {
            let fix = self.as_difference(root).unwrap_or_else(|| format!("{whole} - 0 [degC]"));
            Kind::DifferenceWanted { fix }
        } else if let Node::Number { .. } = self.tree.node(root) {
            Kind::BareNumber { wanted, fix: format!("{whole} {}", wanted.usual_unit()) }
        } else {
            let inverse = || has_inverse(found, wanted).then(|| format!("1 / ({whole})"));
            let fix = self.fraction(root, wanted).or_else(inverse);
            Kind::Dimension { wanted: Box::new(wanted), found: Box::new(found), fix }
        };
        UnitError::new(kind, span)
    }

    /// `3/8 [in]`, a number over inches, as `0.375 [in]`, where inches are due.
    fn fraction(&self, root: Id, wanted: Type) -> Option<String> {
        let Node::Binary(Operator::Divide, above, below) = self.tree.node(root) else { return None };
        let (Node::Number { value, .. }, Node::Literal { ty, .. }) =
            (self.tree.node(*above), self.tree.node(*below))
        else {
            return None;
        };
        let divisor: f64 = self.literal_number(*below)?.replace('_', "").parse().ok()?;
        let unit = self.text_of(*below).split_once('[')?.1;
        let fits = *ty == wanted && divisor.abs() > 0.0;
        fits.then(|| format!("{} [{unit}", number(value / divisor)))
    }

    /// Two values of different types that should have one.
    pub(crate) fn unlike(&self, operation: &'static str, a: (Id, Type), b: (Id, Type)) -> UnitError {
        for (this, other) in [(a, b), (b, a)] {
            if is_frequency_for_rotation(this.1, other.1) {
                let fix = self.in_revolutions(this.0);
                return UnitError::new(Kind::Rotation { fix }, self.tree.span(this.0));
            }
        }
        let fix = self.like(b, a.1).or_else(|| self.like(a, b.1));
        let span = self.tree.span(a.0).start..self.tree.span(b.0).end;
        let (left, right) = (Box::new(a.1), Box::new(b.1));
        UnitError::new(Kind::Operands { operation, left, right, fix }, span)
    }

    /// A plain number or a temperature made the type of the other operand.
    fn like(&self, this: (Id, Type), other: Type) -> Option<String> {
        let (id, ty) = this;
        match self.tree.node(id) {
            Node::Number { .. } if ty.is_scalar() => {
                Some(self.replace(id, &format!("{} [{}]", self.text_of(id), other.usual_unit())))
            }
            Node::Literal { .. } if is_temperature(ty) && other.absolute => self.relabel(id, "degC"),
            Node::Literal { .. } if ty.absolute && is_temperature(other) => self.as_difference(id),
            _ if ty.absolute && is_temperature(other) => {
                Some(self.replace(id, &format!("({} - 0 [degC])", self.text_of(id))))
            }
            _ => None,
        }
    }

    /// `50 [Hz]` as `50 [rev/s]`.
    fn in_revolutions(&self, id: Id) -> Option<String> {
        match self.tree.node(id) {
            Node::Literal { value, .. } => {
                Some(self.replace(id, &format!("{} [rev/s]", rounded(*value, 12))))
            }
            _ => None,
        }
    }
}
