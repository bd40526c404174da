//! Tree to types: resolves names, checks dimensions, folds constants.

use std::ops::Range;
use std::sync::Arc;

use super::call;
use super::fix::{Judge, Source};
use super::fold;
use super::function::{self, Function};
use super::operands;
use super::program::NamedTable;
use super::scope::{Scope, Symbol};
use super::tree::{Id, Node, Operator, Tree};
use crate::error::{UnitError, UnitErrorKind as Kind};
use crate::rational::Rational;
use crate::suggest::suggest;
use crate::types::Type;

/// The results for a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Checked {
    /// The type; `None` for the truth of a comparison.
    pub(crate) ty: Option<Type>,
    /// The value, if it does not depend on any name.
    pub(crate) constant: Option<f64>,
    /// The constant without rounding, if it is a short fraction.
    pub(crate) exact: Option<Rational>,
    /// The symbol of a name.
    pub(crate) symbol: Option<Symbol>,
    /// Index of the table that is called.
    pub(crate) table: Option<usize>,
}

impl Checked {
    pub(crate) fn of(ty: Type) -> Self {
        Self { ty: Some(ty), constant: None, exact: None, symbol: None, table: None }
    }
}

/// The results for a tree.
pub(crate) struct Resolved {
    /// One entry per node, in the order of the tree.
    pub(crate) nodes: Vec<Checked>,
    /// The tables that are called, each once.
    pub(crate) tables: Vec<NamedTable>,
}

pub(crate) fn check(
    text: &str,
    tree: &Tree,
    scope: &dyn Scope,
    expected: Option<Type>,
) -> Result<Resolved, Vec<UnitError>> {
    types(
        Source { text, tree, judge: Some(Judge { scope, expected, check: mistakes }) },
        scope,
        expected,
    )
}

fn mistakes(source: Source<'_>, scope: &dyn Scope, expected: Option<Type>) -> Vec<UnitError> {
    types(source, scope, expected).err().unwrap_or_default()
}

/// The types of all nodes, or every mistake.
fn types(
    source: Source<'_>,
    scope: &dyn Scope,
    expected: Option<Type>,
) -> Result<Resolved, Vec<UnitError>> {
    let mut checker =
        Checker { source, scope, found: Vec::new(), tables: Vec::new(), errors: Vec::new() };
    for (id, (node, _)) in source.tree.nodes().enumerate() {
        let found = checker.node(id, node);
        checker.found.push(found);
    }
    checker.result(expected);
    let Checker { found, tables, mut errors, .. } = checker;
    if errors.is_empty() {
        return Ok(Resolved { nodes: found.into_iter().flatten().collect(), tables });
    }
    errors.sort_by_key(|error| error.span.start);
    Err(errors)
}

struct Checker<'a> {
    source: Source<'a>,
    scope: &'a dyn Scope,
    /// `None` after an error, here or in an operand.
    found: Vec<Option<Checked>>,
    tables: Vec<NamedTable>,
    errors: Vec<UnitError>,
}

impl Checker<'_> {
    fn node(&mut self, id: Id, node: &Node) -> Option<Checked> {
        match node {
            Node::Number { value, exact } => {
                Some(Checked { constant: Some(*value), exact: *exact, ..Checked::of(Type::SCALAR) })
            }
            Node::Literal { value, ty } => {
                Some(Checked { constant: Some(*value), ..Checked::of(*ty) })
            }
            Node::Name(name) => self.name(name, self.source.tree.span(id)),
            Node::Negate(operand) => self.negate(*operand),
            Node::Binary(operator, left, right) => self.binary(*operator, *left, *right),
            Node::Compare(comparison, left, right) => {
                let (a, b) = (self.value(*left), self.value(*right));
                let checked =
                    operands::common(&self.source, comparison.symbol(), (*left, a?), (*right, b?));
                self.keep(checked)?;
                Some(Checked { ty: None, ..Checked::of(Type::SCALAR) })
            }
            Node::Call { function, name_span, arguments } => {
                self.call(id, function, name_span, arguments)
            }
        }
    }

    fn keep<T>(&mut self, result: Result<T, UnitError>) -> Option<T> {
        result.map_err(|error| self.errors.push(error)).ok()
    }

    fn fail<T>(&mut self, kind: Kind, span: Range<usize>) -> Option<T> {
        self.errors.push(UnitError::new(kind, span));
        None
    }

    /// The type of an operand; an error if it is a comparison.
    fn value(&mut self, id: Id) -> Option<Type> {
        let found = self.found.get(id).copied().flatten()?;
        match found.ty {
            Some(ty) => Some(ty),
            None => {
                let fix =
                    self.source.replace(id, &format!("if({}, 1, 0)", self.source.text_of(id)));
                self.fail(Kind::TruthValue { fix }, self.source.tree.span(id))
            }
        }
    }

    fn constant(&self, id: Id) -> Option<f64> {
        self.found.get(id).copied().flatten()?.constant
    }

    fn exact(&self, id: Id) -> Option<Rational> {
        self.found.get(id).copied().flatten()?.exact
    }

    fn name(&mut self, name: &str, span: Range<usize>) -> Option<Checked> {
        if name == "pi" {
            return Some(Checked {
                constant: Some(std::f64::consts::PI),
                ..Checked::of(Type::SCALAR)
            });
        }
        if let Some(symbol) = self.scope.symbol(name) {
            return Some(Checked { symbol: Some(symbol), ..Checked::of(symbol.ty) });
        }
        if let Some(function) = function::find(name) {
            let wanted = function.wrong_arity(0).unwrap_or_default();
            return self.fail(Kind::Arity { function: function.name(), wanted, found: 0 }, span);
        }
        if let Some(symbol) = self.scope.table(name) {
            let error = call::wrong_arity(&self.source, self.scope, (name, &symbol), (span, &[]));
            return self.keep(Err(error));
        }
        let names = self.scope.names();
        let candidates = names.iter().map(String::as_str).chain(["pi"]);
        let near = suggest(name, candidates).map(str::to_owned);
        let suggestion = near.or_else(|| call::near_table(self.scope, name));
        self.fail(Kind::UnknownName { name: name.to_owned(), suggestion }, span)
    }

    fn negate(&mut self, operand: Id) -> Option<Checked> {
        let ty = self.value(operand)?;
        if ty.absolute {
            let error = self.source.absolute(operand, "negated", true);
            return self.keep(Err(error));
        }
        let constant = self.constant(operand).map(|value| -value);
        let exact = self.exact(operand).and_then(Rational::checked_neg);
        Some(Checked { constant, exact, ..Checked::of(ty) })
    }

    fn binary(&mut self, operator: Operator, left: Id, right: Id) -> Option<Checked> {
        let (a, b) = (self.value(left), self.value(right));
        let (a, b) = ((left, a?), (right, b?));
        let checked = match operator {
            Operator::Add | Operator::Subtract => operands::sum(&self.source, operator, a, b),
            Operator::Multiply | Operator::Divide => {
                operands::product(&self.source, operator, a, b)
            }
            Operator::Power => operands::power(&self.source, a, b, self.exact(right)),
        };
        let ty = self.keep(checked)?;
        let constant = fold::binary(operator, self.constant(left), self.constant(right));
        let exact = fold::exact(operator, self.exact(left), self.exact(right));
        Some(Checked { constant, exact, ..Checked::of(ty) })
    }

    fn call(
        &mut self,
        id: Id,
        name: &str,
        span: &Range<usize>,
        arguments: &[Id],
    ) -> Option<Checked> {
        let Some(function) = function::find(name) else { return self.table(id, name, arguments) };
        if let Some(wanted) = function.wrong_arity(arguments.len()) {
            let kind = Kind::Arity { function: function.name(), wanted, found: arguments.len() };
            return self.fail(kind, span.clone());
        }
        match (function, arguments) {
            (Function::If, [condition, values @ ..]) => self.conditional(*condition, values),
            (Function::Min | Function::Max | Function::Mean | Function::Sum, _) => {
                self.several(function, arguments)
            }
            (_, [argument]) => self.single(function, *argument),
            _ => None,
        }
    }

    fn table(&mut self, id: Id, name: &str, arguments: &[Id]) -> Option<Checked> {
        let Some(symbol) = self.scope.table(name) else {
            let error = call::no_table(&self.source, self.scope, id);
            return self.keep(Err(error));
        };
        let mut types = Vec::new();
        for &argument in arguments {
            types.push((argument, self.value(argument)));
        }
        if arguments.len() != symbol.table.dimension() {
            let given = (self.source.tree.span(id), types.as_slice());
            let error = call::wrong_arity(&self.source, self.scope, (name, &symbol), given);
            return self.keep(Err(error));
        }
        let mut right = Some(());
        for (index, (argument, ty)) in types.into_iter().enumerate() {
            let checked =
                ty.map(|ty| call::argument(&self.source, (name, &symbol), index, (argument, ty)));
            right = right.and(checked.and_then(|checked| self.keep(checked)));
        }
        right?;
        let known = self.tables.iter().position(|table| table.name == name);
        let index = known.unwrap_or_else(|| {
            let (table, units) = (Arc::clone(&symbol.table), symbol.units.clone().into());
            self.tables.push(NamedTable { name: name.to_owned(), table, units });
            self.tables.len() - 1
        });
        Some(Checked { table: Some(index), ..Checked::of(symbol.ty) })
    }

    fn conditional(&mut self, condition: Id, values: &[Id]) -> Option<Checked> {
        let truth = self.found.get(condition).copied().flatten();
        if let Some(Checked { ty: Some(ty), .. }) = truth {
            let error = self.source.truth_wanted(condition, ty);
            self.errors.push(error);
        }
        let common = self.common_type("`if`", values);
        truth.filter(|found| found.ty.is_none())?;
        common.map(Checked::of)
    }

    fn several(&mut self, function: Function, arguments: &[Id]) -> Option<Checked> {
        let operation = match function {
            Function::Min => "`min`",
            Function::Max => "`max`",
            Function::Sum => "`sum`",
            _ => "`mean`",
        };
        let ty = self.common_type(operation, arguments)?;
        if function == Function::Sum && ty.absolute {
            let error = self.source.absolute(arguments[0], "added to another one", false);
            return self.keep(Err(error));
        }
        let constants: Option<Vec<f64>> = arguments.iter().map(|id| self.constant(*id)).collect();
        let constant = constants.and_then(|values| fold::several(function, &values));
        Some(Checked { constant, ..Checked::of(ty) })
    }

    /// The common type of these values.
    fn common_type(&mut self, operation: &'static str, ids: &[Id]) -> Option<Type> {
        let mut types = Vec::new();
        for &id in ids {
            types.push((id, self.value(id)));
        }
        let mut common: Option<(Id, Type)> = None;
        for (id, ty) in types {
            let this = (id, ty?);
            let ty = match common {
                None => this.1,
                Some(first) => {
                    let checked = operands::common(&self.source, operation, first, this);
                    self.keep(checked)?
                }
            };
            common = Some((common.map_or(id, |(first, _)| first), ty));
        }
        common.map(|(_, ty)| ty)
    }

    fn single(&mut self, function: Function, argument: Id) -> Option<Checked> {
        let given = self.value(argument)?;
        let checked = operands::argument(&self.source, function, (argument, given));
        let ty = self.keep(checked)?;
        let constant = self.constant(argument).and_then(|value| fold::single(function, value));
        Some(Checked { constant, ..Checked::of(ty) })
    }

    /// Checks the whole against the expected type.
    fn result(&mut self, expected: Option<Type>) {
        let root = self.source.tree.root();
        let (Some(found), Some(wanted)) = (self.value(root), expected) else { return };
        if !found.conforms_to(wanted) {
            let error = self.source.mismatch(root, found, wanted);
            self.errors.push(error);
        } else if let Some(Some(root)) = self.found.get_mut(root) {
            root.ty = Some(wanted);
        }
    }
}
