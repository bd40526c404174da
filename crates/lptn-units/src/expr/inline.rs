//! Expressions in the place of names: named values, and states of one's own.
//!
//! A tree keeps its order, operands directly before the node that uses them, because each name is
//! replaced where it is.

use std::borrow::Cow;
use std::ops::Range;

use super::Expression;
use super::scope::Scope;
use super::tree::{Node, Operator, Tree};
use crate::dimension::Dimension;
use crate::format_number;
use crate::rational::Rational;
use crate::types::Type;

impl Expression {
    /// The same expression with the meaning of each name that has one in `scope`.
    /// Every place inside such a meaning is that of the name.
    pub fn inlined(&self, scope: &dyn Scope) -> Cow<'_, Self> {
        let stands = |(node, _): &(Node, Range<usize>)| match node {
            Node::Name(name) => scope.meaning(name).is_some(),
            _ => false,
        };
        if !self.tree.nodes().any(stands) {
            return Cow::Borrowed(self);
        }
        let meaning = |name: &str| Some(Cow::Owned(scope.meaning(name)?.tree.clone()));
        Cow::Owned(self.replaced(&meaning))
    }

    /// The same expression with others in the place of some of its names. Every place inside them
    /// is that of the name.
    #[must_use]
    pub fn with(&self, others: &[(&str, &Self)]) -> Self {
        let other = |name: &str| others.iter().find(|(known, _)| *known == name);
        self.replaced(&|name| other(name).map(|(_, other)| Cow::Borrowed(&other.tree)))
    }

    /// The same expression with a whole number in the place of a name, in [`Expression::meant`] too.
    #[must_use]
    pub fn with_number(mut self, name: &str, number: usize) -> Self {
        let named = |(found, _): &(String, Range<usize>)| found == name;
        let places: Vec<_> = self.names().into_iter().filter(named).collect();
        if places.is_empty() {
            return self;
        }
        let text = number.to_string();
        let exact = Rational::from_decimal(&text);
        let mut tree = Tree::default();
        tree.push(Node::Number { value: number as f64, exact }, 0..text.len());
        let whole = self.replaced(&|found| (found == name).then_some(Cow::Borrowed(&tree)));
        self.tree = whole.tree;
        self.renamed.extend(places.into_iter().map(|(_, place)| (place, text.clone())));
        self.renamed.sort_by_key(|(span, _)| span.start);
        self
    }

    fn replaced<'t>(&self, meaning: &dyn Fn(&str) -> Option<Cow<'t, Tree>>) -> Self {
        let mut tree = Tree::default();
        let mut place = Vec::new();
        for (node, span) in self.tree.nodes() {
            let meaning = match node {
                Node::Name(name) => meaning(name),
                _ => None,
            };
            let last = match meaning {
                Some(meaning) => tree.append(&meaning, |_| span.clone()),
                None => tree.push(node.with_operands(&place), span.clone()),
            };
            place.push(last);
        }
        Self { tree, ..self.clone() }
    }

    /// A constant in SI units, as it could be written.
    pub fn literal(value: f64, ty: Type) -> Self {
        let number = format_number(value);
        let text = match ty {
            ty if ty.absolute => format!("absolute({number} [K])"),
            ty if ty.is_scalar() => number,
            ty => format!("{number} [{}]", ty.dimension.si_unit()),
        };
        let mut tree = Tree::default();
        tree.push(Node::Literal { value, ty }, 0..text.len());
        Self { part: 0..text.len(), text, tree, renamed: Vec::new() }
    }

    /// This expression inside another one, in the place of each `name` there. Text and places are
    /// those of this expression; all else of the other has the place of the whole.
    #[must_use]
    pub fn inside(&self, outer: &Self, name: &str) -> Self {
        let mut tree = Tree::default();
        let mut place = Vec::new();
        let whole = self.tree.span(self.tree.root());
        for (node, _) in outer.tree.nodes() {
            let last = match node {
                Node::Name(found) if found == name => tree.append(&self.tree, |span| span.clone()),
                _ => tree.push(node.with_operands(&place), whole.clone()),
            };
            place.push(last);
        }
        Self { tree, ..self.clone() }
    }

    /// The value of type `ty` that a plain temperature difference `name` represents: `scale` SI
    /// units for 1 K. An absolute temperature is that number of kelvin.
    ///
    /// `None` if the dimension of the scale has exponents that are too large.
    pub fn scaled(name: &str, scale: f64, ty: Type) -> Option<Self> {
        let (mut tree, span) = (Tree::default(), 0..name.len());
        let named = Node::Name(name.to_owned());
        if ty.absolute {
            let argument = tree.push(named, span.clone());
            let (function, name_span) = ("absolute".to_owned(), span.clone());
            tree.push(Node::Call { function, name_span, arguments: vec![argument] }, span);
        } else {
            let per_kelvin = ty.dimension.checked_div(Dimension::TEMPERATURE)?;
            let literal = Node::Literal { value: scale, ty: Type::of(per_kelvin) };
            let factor = tree.push(literal, span.clone());
            let value = tree.push(named, span.clone());
            tree.push(Node::Binary(Operator::Multiply, factor, value), span);
        }
        Some(Self { text: name.to_owned(), part: 0..name.len(), tree, renamed: Vec::new() })
    }
}
