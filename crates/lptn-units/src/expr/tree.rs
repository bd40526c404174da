//! The syntax tree, in one list: operands come before the nodes that use them, so that no walk over
//! it recurses.

use std::fmt;
use std::ops::Range;

use super::function::is_function;
use crate::rational::Rational;
use crate::types::Type;

/// Index of a node.
pub(crate) type Id = usize;

#[derive(Clone, Debug)]
pub(crate) enum Node {
    /// A number without unit.
    Number {
        value: f64,
        exact: Option<Rational>,
    },
    /// A number with its unit in brackets, in SI.
    Literal {
        value: f64,
        ty: Type,
    },
    Name(String),
    Negate(Id),
    Binary(Operator, Id, Id),
    Compare(Comparison, Id, Id),
    Call {
        function: String,
        name_span: Range<usize>,
        arguments: Vec<Id>,
    },
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

crate::words! {
/// A comparison of two values of one kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Comparison {
    /// `<`
    Less = "<",
    /// `<=`
    LessEqual = "<=",
    /// `>`
    Greater = ">",
    /// `>=`
    GreaterEqual = ">=",
    /// `==`
    Equal = "==",
    /// `!=`
    NotEqual = "!=",
}
/// Its symbol.
pub(crate) fn symbol;
}

impl Comparison {
    /// True if the comparison holds.
    #[expect(clippy::float_cmp, reason = "`==` in an expression means equal to the last bit")]
    pub fn holds(self, left: f64, right: f64) -> bool {
        match self {
            Self::Less => left < right,
            Self::LessEqual => left <= right,
            Self::Greater => left > right,
            Self::GreaterEqual => left >= right,
            Self::Equal => left == right,
            Self::NotEqual => left != right,
        }
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

/// The nodes with their places; the root is the last.
#[derive(Clone, Default, Debug)]
pub(crate) struct Tree {
    nodes: Vec<(Node, Range<usize>)>,
}

impl Tree {
    pub(crate) fn push(&mut self, node: Node, span: Range<usize>) -> Id {
        self.nodes.push((node, span));
        self.nodes.len() - 1
    }

    /// Appends the nodes of another tree, each at the place that `at` gives for its own; the index
    /// of the root.
    pub(crate) fn append(
        &mut self,
        other: &Self,
        at: impl Fn(&Range<usize>) -> Range<usize>,
    ) -> Id {
        let first = self.nodes.len();
        let places: Vec<Id> = (first..first + other.nodes.len()).collect();
        for (node, span) in &other.nodes {
            self.push(node.with_operands(&places), at(span));
        }
        self.nodes.len() - 1
    }

    pub(crate) fn node(&self, id: Id) -> &Node {
        &self.nodes[id].0
    }

    pub(crate) fn span(&self, id: Id) -> Range<usize> {
        self.nodes[id].1.clone()
    }

    /// The first node of the part below a node: operands are directly before it.
    pub(crate) fn first(&self, mut id: Id) -> Id {
        loop {
            id = match &self.nodes[id].0 {
                Node::Number { .. } | Node::Literal { .. } | Node::Name(_) => return id,
                Node::Negate(a) | Node::Binary(_, a, _) | Node::Compare(_, a, _) => *a,
                Node::Call { arguments, .. } => match arguments.first() {
                    Some(first) => *first,
                    None => return id,
                },
            };
        }
    }

    pub(crate) fn root(&self) -> Id {
        self.nodes.len() - 1
    }

    /// The nodes, operands first.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = &(Node, Range<usize>)> {
        self.nodes.iter()
    }

    /// The same tree with literals of a type instead of some nodes without operands.
    pub(crate) fn with_literals(&self, ids: &[Id], ty: Type) -> Self {
        let mut tree = self.clone();
        for &id in ids {
            tree.nodes[id].0 = Node::Literal { value: 1.0, ty };
        }
        tree
    }

    /// Renames the names that have a meaning; returns their places and the new names.
    pub(crate) fn rename(
        &mut self,
        meaning: &dyn Fn(&str) -> Option<String>,
    ) -> Vec<(Range<usize>, String)> {
        let mut renamed = Vec::new();
        for (node, span) in &mut self.nodes {
            let (name, place) = match node {
                Node::Name(name) if name != "pi" => (name, span.clone()),
                Node::Call { function, name_span, .. } if !is_function(function) => {
                    (function, name_span.clone())
                }
                _ => continue,
            };
            if let Some(other) = meaning(name) {
                renamed.push((place, other.clone()));
                *name = other;
            }
        }
        renamed
    }

    /// The nodes from `first` to `root`, if these are a separate tree: all operands of a node are
    /// directly before it.
    pub(crate) fn subtree(&self, first: Id, root: Id) -> Self {
        let nodes = self.nodes[first..=root].iter();
        let places: Vec<Id> = (0..=root).map(|id| id.saturating_sub(first)).collect();
        Self {
            nodes: nodes.map(|(node, span)| (node.with_operands(&places), span.clone())).collect(),
        }
    }
}

impl Node {
    /// The same node with its operands at their new places.
    pub(crate) fn with_operands(&self, place: &[Id]) -> Self {
        let mut node = self.clone();
        match &mut node {
            Self::Number { .. } | Self::Literal { .. } | Self::Name(_) => {}
            Self::Negate(operand) => *operand = place[*operand],
            Self::Binary(_, left, right) | Self::Compare(_, left, right) => {
                (*left, *right) = (place[*left], place[*right]);
            }
            Self::Call { arguments, .. } => {
                arguments.iter_mut().for_each(|argument| *argument = place[*argument])
            }
        }
        node
    }
}
