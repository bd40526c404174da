//! Expressions: text, then tree, then types, then flat code.

mod call;
mod check;
mod codegen;
mod degree;
mod enclose;
mod eval;
mod eval_error;
mod families;
mod fix;
mod fold;
mod function;
mod infer;
mod inline;
mod lanes;
mod lexer;
mod operands;
mod parser;
mod parts;
mod pieces;
mod program;
mod scope;
mod split;
mod tree;
mod trend;
mod turns;

use std::ops::Range;

use crate::dimension::Dimension;
use crate::error::UnitError;
use crate::problems::Problems;
use crate::types::Type;
use tree::{Node, Tree};

pub use degree::Degree;
pub use eval_error::EvalError;
pub use function::is_function;
pub use lanes::{LANES, Lanes};
pub use program::{Program, TableCall};
pub use scope::{NoNames, RESERVED, Scope, Symbol};
pub use split::{SlotKind, Split};
pub use tree::Comparison;
pub use trend::Trend;

/// An expression as parsed: syntax checked, names and dimensions not yet.
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    /// The part of the text with this expression; the whole unless it was split off.
    part: Range<usize>,
    tree: Tree,
    /// Places of renamed names, with the new ones, in the order of the text.
    renamed: Vec<(Range<usize>, String)>,
}

impl Expression {
    /// Parses an expression.
    ///
    /// Precedence, from the loosest: comparison, `+ -`, `* /`, sign, `^` (right to left). Units are
    /// in brackets directly after a number, `5 [W/K]`. A sign directly before a number belongs to
    /// it (`-20 [degC]`), so `-2^2` is refused.
    ///
    /// # Errors
    ///
    /// The first mistake in the syntax, an unknown unit, a literal temperature below absolute zero.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        let tree = parser::parse(text)?;
        Ok(Self { text: text.to_owned(), part: 0..text.len(), tree, renamed: Vec::new() })
    }

    /// The same expression with other names: `meaning` gives the new name for one, if any, for
    /// values and for tables that are called. Spans still count in the text that was parsed;
    /// [`Program::text`] has the new names.
    #[must_use]
    pub fn renamed(mut self, meaning: &dyn Fn(&str) -> Option<String>) -> Self {
        let renamed = self.tree.rename(meaning);
        self.renamed.extend(renamed);
        self.renamed.sort_by_key(|(span, _)| span.start);
        self
    }

    /// The text with the new names, for a reader who does not know the old ones.
    pub fn meant(&self) -> String {
        self.text_of(&self.part, &self.renamed)
    }

    /// A part of the text with new names, which are in the order of the text.
    fn text_of(&self, part: &Range<usize>, renamed: &[(Range<usize>, String)]) -> String {
        let (mut text, mut at) = (String::new(), part.start);
        for (span, name) in renamed.iter().filter(|(span, _)| part.contains(&span.start)) {
            text += self.text.get(at..span.start).unwrap_or_default();
            text += name;
            at = span.end;
        }
        text + self.text.get(at..part.end).unwrap_or_default()
    }

    /// The text that was parsed. Spans are byte ranges of it; those of a side that
    /// [`Expression::split_comparison`] returns are byte ranges of the text that was split.
    pub fn text(&self) -> &str {
        self.text.get(self.part.clone()).unwrap_or_default()
    }

    /// The names used, in order of appearance: identifiers and paths such as `steel.T` and
    /// `planet[1].gear.T` (without spaces), functions and `pi` left out.
    pub fn names(&self) -> Vec<(String, Range<usize>)> {
        let named = self.tree.nodes().filter_map(|(node, span)| match node {
            Node::Name(name) if name != "pi" => Some((name.clone(), span.clone())),
            _ => None,
        });
        named.collect()
    }

    /// The names that `scope` does not know, in order of appearance, each with the dimension it
    /// must have so that the whole is of type `expected`: with a rotation `omega`,
    /// `a * omega + b * omega^3` is a power only if `a` is in W s/rad and `b` in W s^3/rad^3.
    /// `None` if the expression leaves a choice, as in `a * b`.
    pub fn unknown_names(
        &self,
        scope: &dyn Scope,
        expected: Type,
    ) -> Vec<(String, Option<Dimension>)> {
        infer::unknown_names(&self.inlined(scope).tree, scope, expected)
    }

    /// The names that are called and are not functions, in order of appearance: tables, such as
    /// `loss` in `2 * loss(speed)`.
    pub fn calls(&self) -> Vec<(String, Range<usize>)> {
        let called = self.tree.nodes().filter_map(|(node, _)| match node {
            Node::Call { function: name, name_span, .. } if !is_function(name) => {
                Some((name.clone(), name_span.clone()))
            }
            _ => None,
        });
        called.collect()
    }

    /// All calls, of functions and tables, with the number of their arguments.
    pub fn called(&self) -> impl Iterator<Item = (&str, usize)> {
        self.tree.nodes().filter_map(|(node, _)| match node {
            Node::Call { function, arguments, .. } => Some((function.as_str(), arguments.len())),
            _ => None,
        })
    }

    /// The comparisons by `==` or `!=` in which this name occurs: if it is a time, they hold, or
    /// fail to, for a moment that has no length.
    pub fn equalities(&self, name: &str) -> Vec<Range<usize>> {
        let named = |node: &Node| matches!(node, Node::Name(found) if found == name);
        let uses: Vec<&Range<usize>> =
            self.tree.nodes().filter(|(node, _)| named(node)).map(|(_, span)| span).collect();
        let equal = self.tree.nodes().filter(|(node, span)| {
            matches!(node, Node::Compare(Comparison::Equal | Comparison::NotEqual, ..))
                && uses.iter().any(|at| span.start <= at.start && at.end <= span.end)
        });
        equal.map(|(_, span)| span.clone()).collect()
    }

    /// Resolves the names, checks the dimensions and translates to flat code.
    ///
    /// `expected` is the expected type, if known; see [`Type::conforms_to`].
    ///
    /// # Errors
    ///
    /// Every unknown name, wrong dimension and misuse of an absolute temperature, in order of
    /// place. Parts that contain an error raise no further ones.
    pub fn compile(
        &self,
        scope: &dyn Scope,
        expected: Option<Type>,
    ) -> Result<Program, Problems<UnitError>> {
        let whole = self.inlined(scope);
        let checked = check::check(&self.text, &whole.tree, scope, expected).map_err(Problems)?;
        Ok(parts::generate(&self.meant(), &whole.tree, checked))
    }

    /// For `a <= b`: the two sides as expressions, and the comparison between them. `None` if the
    /// expression as a whole is not a comparison. Spans still count from the start of the original
    /// text.
    pub fn split_comparison(&self) -> Option<(Expression, Comparison, Expression)> {
        let Node::Compare(comparison, left, right) = self.tree.node(self.tree.root()) else {
            return None;
        };
        let (left, right) = (self.tree.subtree(0, *left), self.tree.subtree(left + 1, *right));
        Some((self.part(left), *comparison, self.part(right)))
    }

    /// For `f(a, b)`: the name, and the arguments as expressions. `None` if the expression as a
    /// whole is not a call. Spans still count from the start of the original text.
    pub fn split_call(&self) -> Option<(&str, Vec<Expression>)> {
        let Node::Call { function, arguments, .. } = self.tree.node(self.tree.root()) else {
            return None;
        };
        let firsts = std::iter::once(0).chain(arguments.iter().map(|root| root + 1));
        let parts = firsts.zip(arguments).map(|(first, root)| self.tree.subtree(first, *root));
        Some((function, parts.map(|tree| self.part(tree)).collect()))
    }

    /// A part of this expression as a separate one.
    fn part(&self, tree: Tree) -> Self {
        Self {
            part: tree.span(tree.root()),
            text: self.text.clone(),
            tree,
            renamed: self.renamed.clone(),
        }
    }
}
