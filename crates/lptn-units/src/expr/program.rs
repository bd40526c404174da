//! Flat code: the compiled form of an expression.

use std::ops::Range;
use std::sync::Arc;

use super::function::Function;
use super::tree::{Comparison, Id};
use crate::table::LookupTable;
use crate::types::Type;
use crate::unit::Unit;

/// The right operand of an operation.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Operand {
    Constant(f64),
    Slot(u32),
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Arithmetic {
    Add,
    Subtract,
    Multiply,
    Divide,
    Min,
    Max,
}

/// One operation on the accumulator and the stack.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Op {
    /// accumulator = operand
    Load(Operand),
    /// Puts the accumulator on the stack.
    Push,
    /// accumulator = accumulator op operand
    Right(Arithmetic, Operand),
    /// accumulator = operand op accumulator
    Left(Arithmetic, Operand),
    /// accumulator = popped op accumulator
    Popped(Arithmetic),
    Negate,
    WholePower(i32),
    /// An exponent that is not whole, or large.
    RealPower(f64),
    /// accumulator = popped ^ accumulator
    PoppedPower,
    Call(Function),
    /// accumulator = table(accumulator)
    Table(usize),
    /// accumulator = table(popped, accumulator)
    PoppedTable(usize),
    /// Goes on at the target unless `popped comparison accumulator` holds.
    JumpUnless(Comparison, usize),
    Jump(usize),
    /// Goes on at the target if the slot contains 0; drops the compared value.
    JumpUnlessSet(u32, usize),
}

/// The source of an operation. Several nodes may have one place, as inside a named value.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    pub(crate) node: Id,
    /// The part of the text.
    pub(crate) span: Range<usize>,
}

/// A table that an expression calls.
#[derive(Clone, Debug)]
pub(crate) struct NamedTable {
    pub(crate) name: String,
    pub(crate) table: Arc<LookupTable>,
    /// The units of [`crate::TableSymbol::units`].
    pub(crate) units: Arc<[Unit]>,
}

/// One call of a table, with its arguments.
#[derive(Clone, Debug)]
pub struct TableCall {
    /// The table that is called.
    pub table: Arc<LookupTable>,
    /// One program per argument. It loads the ordinary slots of its symbols, inside comparisons
    /// too, so that the call crosses a knot at a root of its value minus the knot.
    pub arguments: Vec<Program>,
}

/// A compiled expression. It has no reference to the network and can be shared between threads.
#[derive(Clone, Debug)]
pub struct Program {
    pub(crate) text: Arc<str>,
    pub(crate) ty: Type,
    pub(crate) code: Vec<Op>,
    /// One per operation.
    pub(crate) origins: Vec<Origin>,
    pub(crate) slots: Vec<u32>,
    pub(crate) stack_size: usize,
    pub(crate) tables: Arc<[NamedTable]>,
    pub(crate) comparisons: Vec<Program>,
    pub(crate) relations: Vec<Comparison>,
    pub(crate) kinks: Vec<Program>,
    pub(crate) table_calls: Vec<TableCall>,
}

impl Program {
    /// Type of the result.
    pub fn ty(&self) -> Type {
        self.ty
    }

    /// The slots it loads, sorted, each once; those that comparisons load are among them.
    pub fn slots(&self) -> Vec<u32> {
        self.slots.clone()
    }

    /// The same without a copy.
    pub fn slot_list(&self) -> &[u32] {
        &self.slots
    }

    /// Most values on the stack at once; a stack with this capacity is never reallocated.
    pub fn stack_size(&self) -> usize {
        self.stack_size
    }

    /// The expression it was compiled from.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// One program per comparison, nested ones included: left side minus right side, in the order
    /// of the text. They load the ordinary slots of their symbols, so that the truth of the
    /// comparison changes at a root of theirs.
    pub fn comparisons(&self) -> &[Program] {
        &self.comparisons
    }

    /// The same program with the truth of some comparisons read from slots, 0 for false: `slot_of`
    /// gives the slot of each of [`Program::comparisons`] by its position. Comparisons inside
    /// others are fixed in these too.
    #[must_use]
    pub fn with_held_comparisons(&self, slot_of: &mut dyn FnMut(usize) -> Option<u32>) -> Self {
        let mut held = self.clone();
        for (index, comparison) in self.comparisons.iter().enumerate() {
            let Some(slot) = slot_of(index) else { continue };
            // both end with the operation that comes from the comparison as a whole
            let Some(&Origin { node, .. }) = comparison.origins.last() else { continue };
            held.hold(node, slot);
            held.comparisons.iter_mut().for_each(|outer| outer.hold(node, slot));
        }
        held
    }

    /// Reads the truth of a comparison, a node of the tree, from a slot.
    fn hold(&mut self, comparison: Id, slot: u32) {
        let ops = self.code.iter_mut().zip(&self.origins);
        for (op, _) in ops.filter(|(_, origin)| origin.node == comparison) {
            if let Op::JumpUnless(_, target) = *op {
                *op = Op::JumpUnlessSet(slot, target);
                self.slots.push(slot);
            }
        }
        self.slots.sort_unstable();
        self.slots.dedup();
    }

    /// True if it may have narrow features: a table, a kink, a quotient, or a function that is not
    /// almost a straight line or a low power.
    pub fn may_be_narrow(&self) -> bool {
        let narrow = |op: &Op| match *op {
            Op::Table(_)
            | Op::PoppedTable(_)
            | Op::PoppedPower
            | Op::RealPower(_)
            | Op::Left(Arithmetic::Divide, _)
            | Op::Popped(Arithmetic::Divide | Arithmetic::Min | Arithmetic::Max)
            | Op::Right(Arithmetic::Min | Arithmetic::Max, _)
            | Op::Left(Arithmetic::Min | Arithmetic::Max, _) => true,
            Op::WholePower(power) => !(0..=3).contains(&power),
            Op::Right(Arithmetic::Divide, Operand::Slot(_)) => true,
            Op::Call(function) => !matches!(function, Function::Kelvin | Function::Absolute),
            _ => false,
        };
        self.code.iter().any(narrow)
    }

    /// The relations between the two sides of each of [`Program::comparisons`].
    pub fn relations(&self) -> &[Comparison] {
        &self.relations
    }

    /// Programs for the kinks of the result: for every `abs` its argument, for every pair of
    /// arguments of a `min` or `max` their difference, inner calls before those around them and
    /// otherwise in the order of the text. They load the ordinary slots of their symbols, so that a
    /// kink is at a root of theirs. Not every root is a kink: the pair may not be the smallest or
    /// largest, the branch not the one that is taken; there a program may also fail to evaluate.
    ///
    /// Pairs of constants are left out. Lists of more than 16 arguments are halved until they have
    /// no more; the difference of the halves' extremes gives the kinks between them.
    pub fn kinks(&self) -> &[Program] {
        &self.kinks
    }

    /// The same, with the end values of all tables outside their knots.
    pub fn holding(&self) -> Self {
        let each = |programs: &[Self]| programs.iter().map(Self::holding).collect::<Vec<_>>();
        let table = |table: &Arc<LookupTable>| Arc::new(table.holding());
        let named = |named: &NamedTable| NamedTable { table: table(&named.table), ..named.clone() };
        let call = |call: &TableCall| TableCall {
            table: table(&call.table),
            arguments: each(&call.arguments),
        };
        Self {
            tables: self.tables.iter().map(named).collect(),
            comparisons: each(&self.comparisons),
            kinks: each(&self.kinks),
            table_calls: self.table_calls.iter().map(call).collect(),
            ..self.clone()
        }
    }

    /// The calls of tables, inner ones before those around them and otherwise in the order of the
    /// text. In a branch that is not taken the programs of the arguments may fail to evaluate.
    pub fn table_calls(&self) -> &[TableCall] {
        &self.table_calls
    }
}
