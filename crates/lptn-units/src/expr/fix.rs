//! Errors of expressions that show the corrected text.
//!
//! A fix is tried before it is shown. The checker evaluates the tree with a literal of the proposed
//! type and counts the errors that remain.

use super::lexer::splice;
use super::scope::Scope;
use super::tree::{Id, Node, Operator, Tree};
use crate::dimension::Dimension;
use crate::error::{UnitError, UnitErrorKind as Kind};
use crate::format::{number, rounded};
use crate::kin::Kin;
use crate::kinship::{has_inverse, is_frequency_for_rotation, revolutions};
use crate::temperature::TemperatureScale;
use crate::types::Type;
use crate::unit::Unit;

const SPEED: Type = Type::of(Dimension::ANGULAR_VELOCITY);

fn is_frequency(ty: Type) -> bool {
    is_frequency_for_rotation(ty, SPEED)
}

/// The text and its tree.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) text: &'a str,
    pub(crate) tree: &'a Tree,
    /// Tries a correction; `None` while one is tried.
    pub(crate) judge: Option<Judge<'a>>,
}

/// The names and the type that a corrected text must fit.
#[derive(Clone, Copy)]
pub(crate) struct Judge<'a> {
    pub(crate) scope: &'a dyn Scope,
    pub(crate) expected: Option<Type>,
    /// Finds the mistakes of a tree.
    pub(crate) check: fn(Source<'_>, &dyn Scope, Option<Type>) -> Vec<UnitError>,
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

    /// Number of mistakes left if these names and numbers are of another type; `None` while that is
    /// tried.
    fn mistakes_with(&self, ids: &[Id], ty: Type) -> Option<usize> {
        let Judge { scope, expected, check } = self.judge?;
        let tree = self.tree.with_literals(ids, ty);
        let source = Source { tree: &tree, judge: None, ..*self };
        // an operation on a temperature shows that it should have been a difference
        let weight =
            |error: &UnitError| if let Kind::AbsoluteOperand { .. } = error.kind { 2 } else { 1 };
        Some(check(source, scope, expected).iter().map(weight).sum())
    }

    /// The text with its one frequency made a speed, if that makes it right.
    fn turning(&self) -> Option<String> {
        let scope = self.judge?.scope;
        let frequency = |node: &Node| match node {
            Node::Literal { ty, .. } => is_frequency(*ty),
            Node::Name(name) => scope.symbol(name).is_some_and(|symbol| is_frequency(symbol.ty)),
            _ => false,
        };
        let found = self.tree.nodes().enumerate().filter(|(_, (node, _))| frequency(node));
        let ids: Vec<Id> = found.map(|(id, _)| id).collect();
        let same = |id: &Id| self.text_of(*id) == self.text_of(ids[0]);
        let right =
            !ids.is_empty() && ids.iter().all(same) && self.mistakes_with(&ids, SPEED) == Some(0);
        let unit = self.turn(Type::of(Dimension::FREQUENCY)).filter(|_| right)?;
        let mut text = self.text.to_owned();
        for &id in ids.iter().rev() {
            let literal = self.literal_in_revolutions(id).filter(|_| unit == "rev");
            let turned = literal.unwrap_or_else(|| format!("({} * 1 [{unit}])", self.text_of(id)));
            text.replace_range(self.tree.span(id), &turned);
        }
        Some(text.trim().to_owned())
    }

    /// `rev` if a frequency of this type counts revolutions, `rad` if it was multiplied by 2π or is
    /// a power over a torque; `None` if an expression with π leaves both open.
    fn turn(&self, ty: Type) -> Option<&'static str> {
        if ty.dimension.kin() == Kin::Turning {
            return Some("rad");
        }
        let pi = |node: &Node| matches!(node, Node::Name(name) if name == "pi");
        if !self.tree.nodes().any(|(node, _)| pi(node)) {
            return Some("rev");
        }
        let text = self.text.replace(char::is_whitespace, "");
        let mut products = text.match_indices("2*pi");
        let whole = |at: usize| {
            !text[..at].ends_with(|c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_'))
        };
        products.any(|(at, _)| whole(at)).then_some("rad")
    }

    /// The text with this node, a frequency, as a rotational speed.
    fn as_speed(&self, id: Id, ty: Type) -> Option<String> {
        let unit = self.turn(ty)?;
        let literal = self.in_revolutions(id).filter(|_| unit == "rev");
        let turned = || self.replace(id, &format!("{} * 1 [{unit}]", self.factor(id)));
        Some(literal.unwrap_or_else(turned))
    }

    /// `[K]` for a temperature literal, or `[degR]` if it was in Fahrenheit.
    pub(crate) fn as_difference(&self, id: Id) -> Option<String> {
        let fahrenheit = self.text_of(id).contains('F');
        self.relabel(id, if fahrenheit { "degR" } else { "K" })
    }

    /// An absolute temperature in an operation. `signed` is true if a literal would be right with
    /// its sign directly before it.
    pub(crate) fn absolute(&self, id: Id, operation: &'static str, signed: bool) -> UnitError {
        let negative = || format!("-{}", self.text_of(id));
        let fix = match signed && self.literal_number(id).is_some() {
            true => Some(negative()),
            false => self.as_difference(id).or_else(|| self.less_a_point(id)),
        };
        self.absolute_operand(id, operation, fix)
    }

    /// With one correction, or with both numbers that a temperature can be.
    fn absolute_operand(&self, id: Id, operation: &'static str, fix: Option<String>) -> UnitError {
        let Some(fix) = fix else { return self.with_zeros(id, operation, (&[id], &[id])) };
        let kind = Kind::AbsoluteOperand { operation, fix, celsius: None };
        UnitError::new(kind, self.tree.span(id))
    }

    /// With both numbers that a temperature can be: the operands that count from 0 K in one text,
    /// and from 0 degC in the other, each in the order of the text.
    pub(crate) fn with_zeros(
        &self,
        id: Id,
        operation: &'static str,
        (kelvin, celsius): (&[Id], &[Id]),
    ) -> UnitError {
        let with = |ids: &[Id], plain: fn(&str) -> String| {
            ids.iter().rev().fold(self.text.to_owned(), |text, id| {
                splice(&text, &self.tree.span(*id), &plain(self.text_of(*id)))
            })
        };
        let fix = with(kelvin, |text| format!("kelvin({text})"));
        let from_ice = with(celsius, |text| format!("({text} - 0 [degC])"));
        let (fix, from_ice) = match self.is_scaled_point(id) {
            true if celsius.len() < kelvin.len() => (format!("absolute({fix})"), from_ice),
            true => (format!("absolute({fix})"), format!("{from_ice} + 0 [degC]")),
            false => (fix, from_ice),
        };
        let kind = Kind::AbsoluteOperand { operation, fix, celsius: Some(from_ice) };
        UnitError::new(kind, self.tree.span(id))
    }

    /// True if the whole text must be a point on the scale, and this operand is one of a sum of
    /// two, or times or over a number.
    fn is_scaled_point(&self, id: Id) -> bool {
        let wanted = self.judge.and_then(|judge| judge.expected);
        let plain = |other: &Id| matches!(self.tree.node(*other), Node::Number { .. });
        let scales = match self.tree.node(self.tree.root()) {
            Node::Binary(Operator::Add, x, y) => [x, y].contains(&&id),
            Node::Binary(Operator::Multiply, x, y) => {
                (*x == id && plain(y)) || (*y == id && plain(x))
            }
            Node::Binary(Operator::Divide, x, y) => *x == id && plain(y),
            _ => false,
        };
        scales && wanted.is_some_and(|wanted| wanted.absolute)
    }

    /// `(a + b) / 2` and `0.5 * (a + b)` as `mean(a, b)`, which also takes temperatures.
    pub(crate) fn as_mean(&self, a: Id, b: Id) -> Option<String> {
        let nodes = || self.tree.nodes().enumerate().map(|(id, (node, _))| (id, node));
        let sum = nodes()
            .find(
                |(_, node)| matches!(node, Node::Binary(Operator::Add, x, y) if (*x, *y) == (a, b)),
            )?
            .0;
        let number = |id: Id, wanted: f64| match self.tree.node(id) {
            Node::Number { value, .. } => (value - wanted).abs() < f64::EPSILON,
            _ => false,
        };
        let half = |node: &Node| match node {
            Node::Binary(Operator::Divide, x, y) => *x == sum && number(*y, 2.0),
            Node::Binary(Operator::Multiply, x, y) => {
                (*x == sum && number(*y, 0.5)) || (*y == sum && number(*x, 0.5))
            }
            _ => false,
        };
        let whole = nodes().find(|(_, node)| half(node))?.0;
        Some(self.replace(whole, &format!("mean({}, {})", self.text_of(a), self.text_of(b))))
    }

    /// `20 [K] - T` was meant to be `20 [degC] - T`.
    pub(crate) fn subtracted_from_difference(&self, left: Id, right: Id) -> UnitError {
        let operation = "subtracted from a temperature difference";
        let fix = self.as_difference(right).or_else(|| self.as_point(left));
        self.absolute_operand(right, operation, fix)
    }

    /// `T - 20 [K]` as `T - 20 [degC]`: the difference that was meant.
    fn less_a_point(&self, id: Id) -> Option<String> {
        match self.tree.node(id) {
            Node::Binary(Operator::Subtract, _, right) => self.as_point(*right),
            _ => None,
        }
    }

    /// The text with this difference of temperatures, a literal, as the point on the scale that is
    /// meant: `20 [K]` as `20 [degC]`, but `293 [K]` as 293 K.
    fn as_point(&self, id: Id) -> Option<String> {
        let Node::Literal { value, ty } = self.tree.node(id) else { return None };
        if !ty.is_temperature() || ty.absolute {
            return None;
        }
        let text = self.text_of(id);
        match TemperatureScale::of(*value) {
            TemperatureScale::Celsius if text.contains("degR") => self.relabel(id, "degF"),
            TemperatureScale::Celsius => self.relabel(id, "degC"),
            _ => Some(self.replace(id, &format!("absolute({text})"))),
        }
    }

    /// A node as a factor of a product.
    pub(crate) fn factor(&self, id: Id) -> String {
        let part = self.text_of(id);
        let sum = matches!(self.tree.node(id), Node::Binary(..) | Node::Compare(..));
        if sum { format!("({part})") } else { part.to_owned() }
    }

    /// The text with this node converted to the wanted type, if there is a probable way.
    pub(crate) fn converted(&self, id: Id, found: Type, wanted: Type) -> Option<String> {
        let part = self.factor(id);
        if is_frequency_for_rotation(found, wanted) {
            return self.as_speed(id, found);
        }
        match self.tree.node(id) {
            Node::Number { .. } => {
                Some(self.replace(id, &format!("{part} [{}]", wanted.usual_unit())))
            }
            _ if wanted.absolute && found.is_temperature() => {
                let made = || self.replace(id, &format!("absolute({})", self.text_of(id)));
                Some(self.as_point(id).unwrap_or_else(made))
            }
            _ if found.absolute && wanted.is_temperature() => {
                let made = || self.replace(id, &format!("{part} - 0 [degC]"));
                Some(self.as_difference(id).unwrap_or_else(made))
            }
            _ if wanted.is_scalar() && !found.absolute => Some(self.divided(id, found)),
            _ => None,
        }
    }

    /// The text with this node divided by a value of the same kind.
    pub(crate) fn divided(&self, id: Id, ty: Type) -> String {
        let part = self.factor(id);
        let scale = if ty == Type::of(Dimension::TIME) { 60 } else { 1 };
        self.replace(id, &format!("{part} / {scale} [{}]", ty.dimension.si_unit()))
    }

    /// A condition that is not a comparison.
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
            Kind::Rotation { fix: self.as_speed(root, found) }
        } else if wanted.absolute && found.is_temperature() {
            let fix = self.less_a_difference(root);
            let celsius = || match self.tree.node(root) {
                Node::Literal { .. } => self.as_point(root),
                _ => Some(format!("{whole} + 0 [degC]")),
            };
            let made = format!("absolute({whole})");
            let celsius = if fix.is_none() { celsius().filter(|text| *text != made) } else { None };
            Kind::AbsoluteWanted { fix: fix.unwrap_or(made), celsius }
        } else if found.absolute && wanted.is_temperature() {
            let fix = self.as_difference(root).unwrap_or_else(|| format!("{whole} - 0 [degC]"));
            Kind::DifferenceWanted { fix }
        } else if let Node::Number { .. } = self.tree.node(root) {
            // a side of a comparison is inside an expression
            let alone = whole.trim() == self.text.trim();
            let [open, close] = if alone { ["", ""] } else { ["[", "]"] };
            let made = format!("{whole} {open}{}{close}", wanted.usual_unit());
            Kind::BareNumber { wanted, fix: self.replace(root, &made) }
        } else {
            let inverse = || has_inverse(found, wanted).then(|| format!("1 / ({whole})"));
            let turning = || found.differs_by_radians(wanted).then(|| self.turning()).flatten();
            let fix = self.fraction(root, wanted).or_else(inverse).or_else(turning);
            Kind::Dimension { wanted: Box::new(wanted), found: Box::new(found), fix }
        };
        UnitError::new(kind, span)
    }

    /// `3/8 [in]`, a number over inches, as `0.375 [in]`, if inches are expected.
    fn fraction(&self, root: Id, wanted: Type) -> Option<String> {
        let Node::Binary(Operator::Divide, above, below) = self.tree.node(root) else {
            return None;
        };
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

    /// `T - 5 [degC]` as `T - 5 [K]`, if a temperature is expected.
    fn less_a_difference(&self, root: Id) -> Option<String> {
        let Node::Binary(Operator::Subtract, _, right) = self.tree.node(root) else { return None };
        let right_then = self.mistakes_with(&[*right], Type::of(Dimension::TEMPERATURE)) == Some(0);
        if right_then { self.as_difference(*right) } else { None }
    }

    /// Two values of different types that should have one.
    pub(crate) fn unlike(
        &self,
        operation: &'static str,
        a: (Id, Type),
        b: (Id, Type),
    ) -> UnitError {
        for (this, other) in [(a, b), (b, a)] {
            if is_frequency_for_rotation(this.1, other.1) {
                let fix = self.as_speed(this.0, this.1);
                return UnitError::new(Kind::Rotation { fix }, self.tree.span(this.0));
            }
        }
        let turning = || a.1.differs_by_radians(b.1).then(|| self.turning()).flatten();
        let fix =
            self.like(operation, b, a.1).or_else(|| self.like(operation, a, b.1)).or_else(turning);
        let span = self.tree.span(a.0).start..self.tree.span(b.0).end;
        let (left, right) = (Box::new(a.1), Box::new(b.1));
        UnitError::new(Kind::Operands { operation, left, right, fix }, span)
    }

    /// A plain number or a temperature made the type of the other operand.
    fn like(&self, operation: &str, this: (Id, Type), other: Type) -> Option<String> {
        let (id, ty) = this;
        match self.tree.node(id) {
            Node::Number { value, .. } if ty.is_scalar() => {
                let unit = match other.absolute && matches!(operation, "`+`" | "`-`") {
                    true => self.beside_temperature(id),
                    false => other.usual_unit(),
                };
                let kelvin = TemperatureScale::of(*value) == TemperatureScale::Kelvin;
                let number = self.text_of(id);
                Some(self.replace(
                    id,
                    &match unit == "degC" && kelvin {
                        true => format!("absolute({number} [K])"),
                        false => format!("{number} [{unit}]"),
                    },
                ))
            }
            Node::Literal { .. } if ty.is_temperature() && other.absolute => self.as_point(id),
            Node::Literal { .. } if ty.absolute && other.is_temperature() => self.as_difference(id),
            _ if ty.absolute && other.is_temperature() => {
                Some(self.replace(id, &format!("({} - 0 [degC])", self.text_of(id))))
            }
            _ => None,
        }
    }

    /// The unit of a number that is added to a temperature or subtracted: a difference, unless the
    /// result must not be a temperature again, as in `0.004 [1/K] * (T - 20)`.
    fn beside_temperature(&self, id: Id) -> String {
        let mistakes = |ty| self.mistakes_with(&[id], ty).unwrap_or(0);
        let absolute =
            mistakes(Type::ABSOLUTE_TEMPERATURE) < mistakes(Type::of(Dimension::TEMPERATURE));
        if absolute { "degC".to_owned() } else { "K".to_owned() }
    }

    /// The text with `50 [Hz]` as `50 [rev/s]`.
    fn in_revolutions(&self, id: Id) -> Option<String> {
        self.literal_in_revolutions(id).map(|literal| self.replace(id, &literal))
    }

    fn literal_in_revolutions(&self, id: Id) -> Option<String> {
        let Node::Literal { value, .. } = self.tree.node(id) else { return None };
        let (number, unit) = self.text_of(id).split_once('[')?;
        let scale = Unit::parse(unit.trim_end_matches(']')).ok()?.scale;
        Some(match revolutions(scale) {
            Some(unit) => format!("{} [{unit}]", number.trim()),
            None => format!("{} [rev/s]", rounded(*value, 12)),
        })
    }
}
