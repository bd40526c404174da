//! Dimensions of unknown names, from the expected type of an expression.

use super::fold;
use super::function::{self, Function};
use super::scope::Scope;
use super::tree::{Id, Node, Operator, Tree};
use crate::dimension::Dimension;
use crate::rational::Rational;
use crate::types::Type;

/// The names that `scope` does not know, in order of appearance, each with its dimension if the
/// rest of the expression determines it.
pub(crate) fn unknown_names(
    tree: &Tree,
    scope: &dyn Scope,
    expected: Type,
) -> Vec<(String, Option<Dimension>)> {
    let mut inference = Inference { tree, scope, names: Vec::new(), exact: exact(tree) };
    for (node, _) in tree.nodes() {
        inference.note(node);
    }
    // each round settles one name at least, or is the last
    for _ in 0..=inference.names.len() {
        let known = inference.known();
        inference.settle(&known, expected.dimension);
    }
    inference.names
}

/// The constants without rounding.
fn exact(tree: &Tree) -> Vec<Option<Rational>> {
    let mut found: Vec<Option<Rational>> = Vec::new();
    for (node, _) in tree.nodes() {
        let value = match node {
            Node::Number { exact, .. } => *exact,
            Node::Negate(a) => found[*a].and_then(Rational::checked_neg),
            Node::Binary(operator, a, b) => fold::exact(*operator, found[*a], found[*b]),
            _ => None,
        };
        found.push(value);
    }
    found
}

struct Inference<'a> {
    tree: &'a Tree,
    scope: &'a dyn Scope,
    names: Vec<(String, Option<Dimension>)>,
    exact: Vec<Option<Rational>>,
}

impl Inference<'_> {
    fn note(&mut self, node: &Node) {
        if let Node::Name(name) = node
            && name != "pi"
            && self.scope.symbol(name).is_none()
            && !self.names.iter().any(|(known, _)| known == name)
        {
            self.names.push((name.clone(), None));
        }
    }

    /// The dimensions that follow from the operands.
    fn known(&self) -> Vec<Option<Dimension>> {
        let mut known = Vec::new();
        for (node, _) in self.tree.nodes() {
            let dimension = self.by_operands(node, &known);
            known.push(dimension);
        }
        known
    }

    fn by_operands(&self, node: &Node, known: &[Option<Dimension>]) -> Option<Dimension> {
        match node {
            Node::Number { .. } => Some(Dimension::NONE),
            Node::Literal { ty, .. } => Some(ty.dimension),
            Node::Name(name) => self.named(name),
            Node::Negate(a) => known[*a],
            Node::Binary(operator, a, b) => self.binary(*operator, *b, (known[*a], known[*b])),
            Node::Compare(..) => None,
            Node::Call { function, arguments, .. } => {
                let of = |i: usize| arguments.get(i).and_then(|&id| known[id]);
                self.call(function, &of, arguments.len())
            }
        }
    }

    fn named(&self, name: &str) -> Option<Dimension> {
        if name == "pi" {
            return Some(Dimension::NONE);
        }
        let settled =
            || self.names.iter().find(|(known, _)| known == name).and_then(|(_, found)| *found);
        self.scope.symbol(name).map(|symbol| symbol.ty.dimension).or_else(settled)
    }

    fn binary(
        &self,
        operator: Operator,
        right: Id,
        (a, b): (Option<Dimension>, Option<Dimension>),
    ) -> Option<Dimension> {
        match operator {
            Operator::Add | Operator::Subtract => a.or(b),
            Operator::Multiply => a?.checked_mul(b?),
            Operator::Divide => a?.checked_div(b?),
            Operator::Power if a?.is_none() => a,
            Operator::Power => a?.checked_pow(self.exact[right]?),
        }
    }

    fn call(
        &self,
        name: &str,
        of: &dyn Fn(usize) -> Option<Dimension>,
        count: usize,
    ) -> Option<Dimension> {
        match function::find(name) {
            None => self.scope.table(name).map(|table| table.ty.dimension),
            Some(Function::Abs) => of(0),
            Some(Function::Min | Function::Max | Function::Mean | Function::Sum) => {
                (0..count).find_map(of)
            }
            Some(Function::If) => of(1).or_else(|| of(2)),
            Some(Function::Sqrt) => of(0)?.checked_pow(Rational::HALF),
            Some(Function::Kelvin | Function::Absolute) => Some(Dimension::TEMPERATURE),
            Some(_) => Some(Dimension::NONE),
        }
    }

    /// Goes from the whole to its parts with the expected dimensions, and settles names.
    fn settle(&mut self, known: &[Option<Dimension>], expected: Dimension) {
        let mut due: Vec<Option<Dimension>> = vec![None; known.len()];
        due[self.tree.root()] = Some(expected);
        // operands come before the nodes that use them
        for id in (0..known.len()).rev() {
            match self.tree.node(id) {
                Node::Name(name) => {
                    let open = self
                        .names
                        .iter_mut()
                        .find(|(known, found)| known == name && found.is_none());
                    if let (Some((_, found)), Some(dimension)) = (open, due[id]) {
                        *found = Some(dimension.as_written());
                    }
                }
                node => {
                    for (operand, dimension) in self.operands(node, due[id].or(known[id]), known) {
                        due[operand] = dimension;
                    }
                }
            }
        }
    }

    /// The expected dimensions of the operands of a node of dimension `due`.
    fn operands(
        &self,
        node: &Node,
        due: Option<Dimension>,
        known: &[Option<Dimension>],
    ) -> Vec<(Id, Option<Dimension>)> {
        match node {
            Node::Negate(a) => vec![(*a, due)],
            Node::Binary(operator, a, b) => self.sides(*operator, (*a, *b), due, known),
            Node::Compare(_, a, b) => vec![(*a, known[*b]), (*b, known[*a])],
            Node::Call { function, arguments, .. } => {
                let one = match function::find(function) {
                    Some(
                        Function::Abs
                        | Function::Min
                        | Function::Max
                        | Function::Mean
                        | Function::Sum,
                    ) => due,
                    Some(Function::If) => {
                        return arguments.iter().skip(1).map(|&id| (id, due)).collect();
                    }
                    Some(Function::Sqrt) => due.and_then(|d| d.checked_mul(d)),
                    Some(Function::Kelvin | Function::Absolute) => Some(Dimension::TEMPERATURE),
                    Some(_) => Some(Dimension::NONE),
                    None => None,
                };
                arguments.iter().map(|&id| (id, one)).collect()
            }
            _ => Vec::new(),
        }
    }

    fn sides(
        &self,
        operator: Operator,
        (a, b): (Id, Id),
        due: Option<Dimension>,
        known: &[Option<Dimension>],
    ) -> Vec<(Id, Option<Dimension>)> {
        let (left, right) = match operator {
            Operator::Add | Operator::Subtract => (due, due),
            Operator::Multiply => (quotient(due, known[b]), quotient(due, known[a])),
            Operator::Divide => {
                (due.zip(known[b]).and_then(|(d, b)| d.checked_mul(b)), quotient(known[a], due))
            }
            Operator::Power => {
                let inverse = self.exact[b].and_then(|e| Rational::integer(1).checked_div(e));
                (due.zip(inverse).and_then(|(d, e)| d.checked_pow(e)), Some(Dimension::NONE))
            }
        };
        vec![(a, left), (b, right)]
    }
}

fn quotient(of: Option<Dimension>, by: Option<Dimension>) -> Option<Dimension> {
    of?.checked_div(by?)
}
