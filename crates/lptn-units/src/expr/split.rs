//! The parts of a program that read only some of its slots.

use std::sync::Arc;

use super::program::{Arithmetic, Op, Operand, Origin, Program};

/// The role of a slot in [`Program::split`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SlotKind {
    /// It never changes.
    Fixed,
    /// It changes, and belongs to the wanted parts.
    Varying,
    /// It does not belong to them.
    Foreign,
}

/// The result of [`Program::split`].
#[derive(Clone, Debug, Default)]
pub struct Split {
    /// The largest parts that read no foreign slot and some varying one, in the order of the code.
    /// Parts of branches that are not taken may fail to evaluate.
    pub parts: Vec<Program>,
    /// True if something other than a sum, a product or a choice uses a value that reads both
    /// varying and foreign slots, so that the parts do not show how the whole varies.
    pub entangled: bool,
}

/// A value during the walk, and the code that computes it.
#[derive(Clone, Copy)]
struct Held {
    from: usize,
    to: usize,
    varies: bool,
    foreign: bool,
}

/// A conditional part whose end has not been reached.
struct Branch {
    condition: Held,
    /// The first branch and the end of the second, once the first is through.
    first: Option<(Held, usize)>,
}

struct Walk<'a> {
    program: &'a Program,
    kind: &'a dyn Fn(u32) -> SlotKind,
    stack: Vec<Held>,
    branches: Vec<Branch>,
    found: Split,
}

impl Program {
    /// The parts that read no slot of the kind [`SlotKind::Foreign`]: in `a(t) * (1 + b * T)` with
    /// `T` foreign it is `a(t)`, in any position.
    pub fn split(&self, kind: &dyn Fn(u32) -> SlotKind) -> Split {
        let mut walk = Walk {
            program: self,
            kind,
            stack: Vec::new(),
            branches: Vec::new(),
            found: Split::default(),
        };
        walk.run();
        walk.found
    }

    /// A text that distinguishes it from other programs over the same slots and tables.
    pub fn fingerprint(&self) -> String {
        let tables: Vec<&str> = self.tables.iter().map(|named| named.name.as_str()).collect();
        format!("{:?} {tables:?}", self.code)
    }

    /// A part of the code that computes one value.
    fn part(&self, from: usize, to: usize) -> Self {
        let shifted = |op: &Op| match *op {
            Op::JumpUnless(comparison, target) => Op::JumpUnless(comparison, target - from),
            Op::JumpUnlessSet(slot, target) => Op::JumpUnlessSet(slot, target - from),
            Op::Jump(target) => Op::Jump(target - from),
            other => other,
        };
        self.of_code(
            self.code[from..to].iter().map(shifted).collect(),
            self.origins[from..to].to_vec(),
        )
    }

    fn of_code(&self, code: Vec<Op>, origins: Vec<Origin>) -> Self {
        let mut slots: Vec<u32> = code.iter().filter_map(slot_of).collect();
        slots.sort_unstable();
        slots.dedup();
        Self {
            text: Arc::clone(&self.text),
            ty: self.ty,
            code,
            origins,
            slots,
            stack_size: self.stack_size,
            tables: Arc::clone(&self.tables),
            comparisons: Vec::new(),
            relations: Vec::new(),
            kinks: Vec::new(),
            table_calls: Vec::new(),
        }
    }
}

fn slot_of(op: &Op) -> Option<u32> {
    match *op {
        Op::Load(Operand::Slot(slot))
        | Op::Right(_, Operand::Slot(slot))
        | Op::Left(_, Operand::Slot(slot))
        | Op::JumpUnlessSet(slot, _) => Some(slot),
        _ => None,
    }
}

impl Walk<'_> {
    fn run(&mut self) {
        let mut current = Held { from: 0, to: 0, varies: false, foreign: false };
        for (index, op) in self.program.code.iter().enumerate() {
            current = self.close(index, current);
            current = self.step(index, op, current);
        }
        let whole = self.close(self.program.code.len(), current);
        self.keep(whole);
    }

    fn step(&mut self, index: usize, op: &Op, current: Held) -> Held {
        let until = Held { to: index + 1, ..current };
        match *op {
            Op::Load(operand) => self.operand(operand, index, index + 1),
            Op::Push => {
                self.stack.push(current);
                current
            }
            Op::Right(arithmetic, operand) | Op::Left(arithmetic, operand) => {
                let other = self.operand(operand, index, index);
                let divides = matches!(op, Op::Left(Arithmetic::Divide, _)).then_some(current);
                self.join(divides.or((arithmetic == Arithmetic::Divide).then_some(other)));
                self.meet(current, other, index)
            }
            Op::Popped(arithmetic) => {
                let left = self.pop(current);
                self.join((arithmetic == Arithmetic::Divide).then_some(current));
                self.meet(left, current, index)
            }
            Op::PoppedPower | Op::PoppedTable(_) => {
                let left = self.pop(current);
                let both = self.meet(left, current, index);
                self.join(Some(both));
                both
            }
            Op::Negate | Op::WholePower(1) => until,
            Op::WholePower(_) | Op::RealPower(_) | Op::Call(_) | Op::Table(_) => {
                self.join(Some(current));
                until
            }
            Op::JumpUnless(..) => {
                let left = self.pop(current);
                self.branch(left, current, false)
            }
            Op::JumpUnlessSet(slot, _) => {
                let left = self.pop(current);
                let foreign = (self.kind)(slot) == SlotKind::Foreign;
                self.branch(left, current, foreign)
            }
            Op::Jump(end) => {
                if let Some(branch) = self.branches.last_mut() {
                    branch.first = Some((current, end));
                }
                current
            }
        }
    }

    fn operand(&self, operand: Operand, from: usize, to: usize) -> Held {
        let kind = match operand {
            Operand::Constant(_) => SlotKind::Fixed,
            Operand::Slot(slot) => (self.kind)(slot),
        };
        Held { from, to, varies: kind == SlotKind::Varying, foreign: kind == SlotKind::Foreign }
    }

    fn pop(&mut self, or: Held) -> Held {
        self.stack.pop().unwrap_or(or)
    }

    /// A nonlinear operation on this value.
    fn join(&mut self, value: Option<Held>) {
        self.found.entangled |= value.is_some_and(|value| value.varies && value.foreign);
    }

    /// Two values become one with the operation at `index`.
    fn meet(&mut self, left: Held, right: Held, index: usize) -> Held {
        if left.foreign != right.foreign {
            self.keep(left);
            self.keep(right);
        }
        Held {
            from: left.from.min(right.from),
            to: index + 1,
            varies: left.varies || right.varies,
            foreign: left.foreign || right.foreign,
        }
    }

    fn branch(&mut self, left: Held, right: Held, foreign: bool) -> Held {
        let foreign = foreign || left.foreign || right.foreign;
        self.branches
            .push(Branch { condition: Held { varies: false, foreign, ..left }, first: None });
        right
    }

    /// Joins the branches that end here.
    fn close(&mut self, index: usize, mut current: Held) -> Held {
        while let Some(&Branch { condition, first: Some((first, end)) }) = self.branches.last()
            && end == index
        {
            self.branches.pop();
            let foreign = condition.foreign || first.foreign || current.foreign;
            if foreign {
                self.keep(first);
                self.keep(current);
            }
            let varies = first.varies || current.varies;
            current = Held { from: condition.from, to: index, varies, foreign };
        }
        current
    }

    /// Keeps a value of maximal size.
    fn keep(&mut self, value: Held) {
        if value.foreign || !value.varies {
            return;
        }
        // an operand that is only a name has no separate code
        let part = if value.from < value.to {
            self.program.part(value.from, value.to)
        } else {
            let operand = self.program.code.get(value.from).and_then(slot_of).map(Operand::Slot);
            let origins = self.program.origins.get(value.from..=value.from).unwrap_or_default();
            self.program.of_code(operand.map(Op::Load).into_iter().collect(), origins.to_vec())
        };
        self.found.parts.push(part);
    }
}
