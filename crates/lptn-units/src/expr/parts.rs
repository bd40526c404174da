//! Programs of parts of an expression; the whole has a kink or a jump at their roots.

use std::sync::Arc;

use super::check::Resolved;
use super::codegen::{Common, Generator};
use super::function::{self, Function};
use super::program::{Arithmetic, Op, Program, TableCall};
use super::tree::{Id, Node, Operator, Tree};
use crate::dimension::Dimension;
use crate::types::Type;

/// Most arguments of a `min` or `max` for which every pair has a program: the number of pairs grows
/// with the square.
const MOST_IN_PAIRS: usize = 16;

/// The program of a checked tree, with those of its parts.
pub(crate) fn generate(text: &str, tree: &Tree, resolved: Resolved) -> Program {
    let text: Arc<str> = Arc::from(text);
    let (checked, tables) = (resolved.nodes, Arc::from(resolved.tables));
    let common = Common { tree, checked: &checked, tables: &tables };
    let mut main = Generator::new(common, true);
    main.node(tree.root());
    let ty = checked[tree.root()].ty.unwrap_or(Type::SCALAR);
    let mut program = main.finish(&text, ty);
    Parts { common, text: &text }.add_to(&mut program);
    program
}

pub(super) struct Parts<'a> {
    pub(super) common: Common<'a>,
    pub(super) text: &'a Arc<str>,
}

impl Parts<'_> {
    pub(super) fn add_to(&self, program: &mut Program) {
        for (id, (node, _)) in self.common.tree.nodes().enumerate() {
            match node {
                Node::Compare(relation, left, right) => {
                    program.relations.push(*relation);
                    program.comparisons.push(self.difference(*left, *right, id));
                }
                Node::Call { function, arguments, .. } => {
                    self.call(function, arguments, id, program)
                }
                _ => {}
            }
        }
    }

    fn call(&self, name: &str, arguments: &[Id], id: Id, program: &mut Program) {
        let constant = self.common.checked[id].constant.is_some();
        match (function::find(name), arguments) {
            (Some(Function::Abs), [argument]) if !constant => {
                program.kinks.push(self.value(*argument))
            }
            (Some(Function::Min), _) => {
                self.extreme(Arithmetic::Min, arguments, id, &mut program.kinks)
            }
            (Some(Function::Max), _) => {
                self.extreme(Arithmetic::Max, arguments, id, &mut program.kinks)
            }
            (None, _) => program.table_calls.extend(self.table_call(arguments, id)),
            _ => {}
        }
    }

    fn table_call(&self, arguments: &[Id], id: Id) -> Option<TableCall> {
        let named = self.common.tables.get(self.common.checked[id].table?)?;
        let arguments = arguments.iter().map(|argument| self.value(*argument)).collect();
        Some(TableCall { table: Arc::clone(&named.table), arguments })
    }

    fn extreme(&self, which: Arithmetic, arguments: &[Id], id: Id, kinks: &mut Vec<Program>) {
        if arguments.len() > MOST_IN_PAIRS {
            let (left, right) = arguments.split_at(arguments.len() / 2);
            self.extreme(which, left, id, kinks);
            self.extreme(which, right, id, kinks);
            kinks.push(self.between(which, left, right, id));
            return;
        }
        let constant = |argument: Id| self.common.checked[argument].constant.is_some();
        for (index, &left) in arguments.iter().enumerate() {
            for &right in &arguments[index + 1..] {
                if !(constant(left) && constant(right)) {
                    kinks.push(self.difference(left, right, id));
                }
            }
        }
    }

    fn value(&self, id: Id) -> Program {
        let mut part = Generator::new(self.common, false);
        part.node(id);
        part.finish(self.text, self.common.checked[id].ty.unwrap_or(Type::SCALAR))
    }

    fn difference(&self, left: Id, right: Id, origin: Id) -> Program {
        let mut part = Generator::new(self.common, false);
        part.pair(Operator::Subtract, left, right, origin);
        part.finish(self.text, self.type_of_difference(left, right))
    }

    /// The extreme of some values minus that of others.
    fn between(&self, which: Arithmetic, left: &[Id], right: &[Id], origin: Id) -> Program {
        let mut part = Generator::new(self.common, false);
        part.fold(which, left, origin);
        part.emit(Op::Push, origin);
        part.fold(which, right, origin);
        part.emit(Op::Popped(Arithmetic::Subtract), origin);
        part.finish(self.text, self.type_of_difference(left[0], right[0]))
    }

    /// The one of two conforming types that lacks the spare radian.
    fn type_of_difference(&self, left: Id, right: Id) -> Type {
        let checked = self.common.checked;
        let (Some(a), Some(b)) = (checked[left].ty, checked[right].ty) else { return Type::SCALAR };
        match (a.absolute, a.conforms_to(b)) {
            (true, _) => Type::of(Dimension::TEMPERATURE),
            (false, true) => b,
            (false, false) => a,
        }
    }
}
