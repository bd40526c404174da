//! Checked tree to flat code.

use std::sync::Arc;

use super::check::Checked;
use super::function::{self, Function};
use super::program::{Arithmetic, NamedTable, Op, Operand, Origin, Program};
use super::tree::{Comparison, Id, Node, Operator, Tree};
use crate::types::Type;

/// The common part of the programs of one expression.
#[derive(Clone, Copy)]
pub(super) struct Common<'a> {
    pub(super) tree: &'a Tree,
    pub(super) checked: &'a [Checked],
    pub(super) tables: &'a Arc<[NamedTable]>,
}

pub(super) struct Generator<'a> {
    common: Common<'a>,
    /// True if comparisons load the slots meant for them.
    freezes: bool,
    /// Number of comparisons around the current node.
    comparing: usize,
    code: Vec<Op>,
    origins: Vec<Origin>,
    slots: Vec<u32>,
    waiting: usize,
    most_waiting: usize,
}

impl<'a> Generator<'a> {
    pub(super) fn new(common: Common<'a>, freezes: bool) -> Self {
        Self {
            common,
            freezes,
            comparing: 0,
            code: Vec::new(),
            origins: Vec::new(),
            slots: Vec::new(),
            waiting: 0,
            most_waiting: 0,
        }
    }

    pub(super) fn finish(mut self, text: &Arc<str>, ty: Type) -> Program {
        self.slots.sort_unstable();
        self.slots.dedup();
        Program {
            text: Arc::clone(text),
            ty,
            code: self.code,
            origins: self.origins,
            slots: self.slots,
            stack_size: self.most_waiting,
            tables: Arc::clone(self.common.tables),
            comparisons: Vec::new(),
            relations: Vec::new(),
            kinks: Vec::new(),
            table_calls: Vec::new(),
        }
    }

    pub(super) fn emit(&mut self, op: Op, origin: Id) {
        match op {
            Op::Push => self.waiting += 1,
            Op::Popped(_)
            | Op::PoppedPower
            | Op::PoppedTable(_)
            | Op::JumpUnless(..)
            | Op::JumpUnlessSet(..) => self.waiting -= 1,
            _ => {}
        }
        self.most_waiting = self.most_waiting.max(self.waiting);
        self.code.push(op);
        self.origins.push(Origin { node: origin, span: self.common.tree.span(origin) });
    }

    /// Leaves the value of a node in the accumulator. A long sum leans to the left: that side is
    /// walked in a loop, so that the recursion is as deep as the brackets and no deeper.
    pub(super) fn node(&mut self, id: Id) {
        let mut spine = Vec::new();
        let mut bottom = id;
        while let Some((operator, left, right)) = self.pending(bottom) {
            if operator != Operator::Power && self.leaf(left).is_some() {
                break;
            }
            spine.push((operator, right, bottom));
            bottom = left;
        }
        self.bottom(bottom);
        for (operator, right, origin) in spine.into_iter().rev() {
            self.with_right(operator, right, origin);
        }
    }

    /// A binary operation whose value is not a constant.
    fn pending(&self, id: Id) -> Option<(Operator, Id, Id)> {
        match self.common.tree.node(id) {
            Node::Binary(operator, left, right) if self.common.checked[id].constant.is_none() => {
                Some((*operator, *left, *right))
            }
            _ => None,
        }
    }

    fn bottom(&mut self, id: Id) {
        if let Some(operand) = self.leaf(id) {
            self.load(operand, id);
            return;
        }
        match self.common.tree.node(id) {
            Node::Negate(operand) => {
                self.node(*operand);
                self.emit(Op::Negate, id);
            }
            Node::Binary(operator, left, right) => self.pair(*operator, *left, *right, id),
            Node::Call { function, arguments, .. } => self.call(function, arguments, id),
            _ => {}
        }
    }

    /// A constant or a name.
    fn leaf(&self, id: Id) -> Option<Operand> {
        let Checked { constant, symbol, .. } = self.common.checked[id];
        constant.map(Operand::Constant).or_else(|| {
            let symbol = symbol?;
            let frozen = symbol.in_comparison.filter(|_| self.freezes && self.comparing > 0);
            Some(Operand::Slot(frozen.unwrap_or(symbol.slot)))
        })
    }

    fn load(&mut self, operand: Operand, origin: Id) {
        self.note(operand);
        self.emit(Op::Load(operand), origin);
    }

    fn note(&mut self, operand: Operand) {
        if let Operand::Slot(slot) = operand {
            self.slots.push(slot);
        }
    }

    /// Both sides of an operation, neither of them computed yet.
    pub(super) fn pair(&mut self, operator: Operator, left: Id, right: Id, origin: Id) {
        match (self.leaf(left), self.leaf(right), arithmetic(operator)) {
            (Some(operand), None, Some(arithmetic)) => {
                self.node(right);
                self.note(operand);
                self.emit(Op::Left(arithmetic, operand), origin);
            }
            _ => {
                self.node(left);
                self.with_right(operator, right, origin);
            }
        }
    }

    /// The left side is in the accumulator.
    fn with_right(&mut self, operator: Operator, right: Id, origin: Id) {
        match (arithmetic(operator), self.leaf(right)) {
            (Some(arithmetic), Some(operand)) => {
                self.note(operand);
                self.emit(Op::Right(arithmetic, operand), origin);
            }
            (None, Some(Operand::Constant(exponent))) => {
                self.emit(constant_power(exponent), origin)
            }
            (arithmetic, _) => {
                self.emit(Op::Push, origin);
                self.node(right);
                self.emit(arithmetic.map_or(Op::PoppedPower, Op::Popped), origin);
            }
        }
    }

    fn call(&mut self, name: &str, arguments: &[Id], origin: Id) {
        let Some(function) = function::find(name) else { return self.table(arguments, origin) };
        match (function, arguments) {
            (Function::If, [condition, then, otherwise]) => {
                self.conditional(*condition, *then, *otherwise)
            }
            (Function::Min, _) => self.fold(Arithmetic::Min, arguments, origin),
            (Function::Max, _) => self.fold(Arithmetic::Max, arguments, origin),
            (Function::Sum, _) => self.fold(Arithmetic::Add, arguments, origin),
            (Function::Mean, _) => {
                self.fold(Arithmetic::Add, arguments, origin);
                let count = u32::try_from(arguments.len()).unwrap_or(u32::MAX);
                self.emit(
                    Op::Right(Arithmetic::Divide, Operand::Constant(f64::from(count))),
                    origin,
                );
            }
            (_, [argument]) => {
                self.node(*argument);
                if !matches!(function, Function::Kelvin | Function::Absolute) {
                    self.emit(Op::Call(function), origin);
                }
            }
            _ => {}
        }
    }

    fn table(&mut self, arguments: &[Id], origin: Id) {
        match (self.common.checked[origin].table, arguments) {
            (Some(table), [argument]) => {
                self.node(*argument);
                self.emit(Op::Table(table), origin);
            }
            (Some(table), [first, second]) => {
                self.node(*first);
                self.emit(Op::Push, origin);
                self.node(*second);
                self.emit(Op::PoppedTable(table), origin);
            }
            _ => {}
        }
    }

    /// Combines the arguments from the first to the last.
    pub(super) fn fold(&mut self, arithmetic: Arithmetic, arguments: &[Id], origin: Id) {
        let [first, rest @ ..] = arguments else { return };
        self.node(*first);
        for &argument in rest {
            match self.leaf(argument) {
                Some(operand) => {
                    self.note(operand);
                    self.emit(Op::Right(arithmetic, operand), origin);
                }
                None => {
                    self.emit(Op::Push, origin);
                    self.node(argument);
                    self.emit(Op::Popped(arithmetic), origin);
                }
            }
        }
    }

    /// Only the branch taken runs.
    fn conditional(&mut self, condition: Id, then: Id, otherwise: Id) {
        let Node::Compare(comparison, left, right) = self.common.tree.node(condition) else {
            return;
        };
        let to_second = self.compare(*comparison, *left, *right, condition);
        self.node(then);
        let to_end = self.code.len();
        self.emit(Op::Jump(0), then);
        self.code[to_second] = Op::JumpUnless(*comparison, self.code.len());
        self.node(otherwise);
        self.code[to_end] = Op::Jump(self.code.len());
    }

    /// Index of the jump, whose target is not known yet.
    fn compare(&mut self, comparison: Comparison, left: Id, right: Id, origin: Id) -> usize {
        self.comparing += 1;
        self.node(left);
        self.emit(Op::Push, origin);
        self.node(right);
        self.comparing -= 1;
        self.emit(Op::JumpUnless(comparison, 0), origin);
        self.code.len() - 1
    }
}

fn arithmetic(operator: Operator) -> Option<Arithmetic> {
    Some(match operator {
        Operator::Add => Arithmetic::Add,
        Operator::Subtract => Arithmetic::Subtract,
        Operator::Multiply => Arithmetic::Multiply,
        Operator::Divide => Arithmetic::Divide,
        Operator::Power => return None,
    })
}

/// Whole exponents need no logarithm, and allow a negative base.
fn constant_power(exponent: f64) -> Op {
    let whole = exponent.fract() == 0.0 && exponent.abs() <= 64.0;
    #[expect(clippy::cast_possible_truncation, reason = "a whole number of at most 64")]
    if whole { Op::WholePower(exponent as i32) } else { Op::RealPower(exponent) }
}
