//! The dependence of a program on a slot, from the form of its code.

use super::function::Function;
use super::program::{Arithmetic, Op, Operand, Program};

/// The dependence of a result on one variable.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Degree {
    /// No dependence.
    Constant,
    /// `a + b x`.
    Affine,
    /// Any other dependence, as far as the form of the code shows.
    Nonlinear,
}

impl Program {
    /// The dependence of the result on one slot, with the others fixed: an upper bound from the
    /// form of the code.
    pub fn degree_in(&self, slot: u32) -> Degree {
        degree(&self.code, slot, Smooth::Everywhere)
    }

    /// The same between the [kinks](Program::kinks) of `abs`, `min` and `max`: `abs(x) - 3` is
    /// affine there.
    pub fn degree_between_kinks(&self, slot: u32) -> Degree {
        degree(&self.code, slot, Smooth::BetweenKinks)
    }
}

/// The stretch over which a degree is that of the result.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Smooth {
    Everywhere,
    BetweenKinks,
}

/// A conditional part whose end has not been reached.
struct Branch {
    condition: Degree,
    /// Degree of the first branch, and the end of the second, once the first is through.
    first: Option<(Degree, usize)>,
}

/// Follows the code once, with degrees instead of values.
fn degree(code: &[Op], slot: u32, smooth: Smooth) -> Degree {
    let mut stack: Vec<Degree> = Vec::new();
    let mut branches: Vec<Branch> = Vec::new();
    let mut current = Degree::Constant;
    for (index, op) in code.iter().enumerate() {
        current = close(&mut branches, index, current);
        match *op {
            Op::Push => stack.push(current),
            Op::JumpUnless(..) => {
                let condition = stack.pop().unwrap_or(Degree::Nonlinear).max(current);
                branches.push(Branch { condition, first: None });
            }
            Op::JumpUnlessSet(held, _) => {
                stack.pop();
                let condition = if held == slot { Degree::Nonlinear } else { Degree::Constant };
                branches.push(Branch { condition, first: None });
            }
            Op::Jump(end) => {
                if let Some(branch) = branches.last_mut() {
                    branch.first = Some((current, end));
                }
            }
            _ => current = step(op, current, &mut stack, (slot, smooth)),
        }
    }
    close(&mut branches, code.len(), current)
}

/// Joins the branches that end here. Which one is taken must not depend on the variable.
fn close(branches: &mut Vec<Branch>, index: usize, mut current: Degree) -> Degree {
    while let Some(&Branch { condition, first: Some((first, end)) }) = branches.last()
        && end == index
    {
        branches.pop();
        let depends = condition > Degree::Constant;
        current = if depends { Degree::Nonlinear } else { current.max(first) };
    }
    current
}

fn step(
    op: &Op,
    current: Degree,
    stack: &mut Vec<Degree>,
    (slot, smooth): (u32, Smooth),
) -> Degree {
    let combine = |arithmetic, left, right| match (arithmetic, smooth) {
        (Arithmetic::Min | Arithmetic::Max, Smooth::BetweenKinks) => Degree::max(left, right),
        _ => combine(arithmetic, left, right),
    };
    let of = |operand: Operand| {
        if operand == Operand::Slot(slot) { Degree::Affine } else { Degree::Constant }
    };
    match *op {
        Op::Load(operand) => of(operand),
        Op::Right(arithmetic, operand) => combine(arithmetic, current, of(operand)),
        Op::Left(arithmetic, operand) => combine(arithmetic, of(operand), current),
        Op::Popped(arithmetic) => {
            combine(arithmetic, stack.pop().unwrap_or(Degree::Nonlinear), current)
        }
        Op::WholePower(1) | Op::Negate => current,
        Op::Call(Function::Abs) if smooth == Smooth::BetweenKinks => current,
        Op::PoppedPower | Op::PoppedTable(_) => {
            bent(stack.pop().unwrap_or(Degree::Nonlinear).max(current))
        }
        _ => bent(current),
    }
}

fn combine(arithmetic: Arithmetic, left: Degree, right: Degree) -> Degree {
    match arithmetic {
        Arithmetic::Add | Arithmetic::Subtract => left.max(right),
        Arithmetic::Multiply if left.min(right) == Degree::Constant => left.max(right),
        Arithmetic::Divide if right == Degree::Constant => left,
        _ => bent(left.max(right)),
    }
}

/// The degree of a function of an argument.
fn bent(degree: Degree) -> Degree {
    if degree == Degree::Constant { Degree::Constant } else { Degree::Nonlinear }
}
