//! The pieces of kinks and tables that a program goes through, without its value.

use super::program::{Program, TableCall};

/// An odd number without a pattern.
const FACTOR: u64 = 0x517c_c1b7_2722_0a95;

impl Program {
    /// A number for the sides of its kinks and the pieces of its tables at these slots, of those
    /// that read a slot for which `varies` holds. `None` if one of them cannot be evaluated, or the
    /// program has branches.
    ///
    /// If two numbers differ, a kink may lie between. If they are the same, and every argument is
    /// monotonic, none does.
    pub fn pieces(
        &self,
        slots: &[f64],
        stack: &mut Vec<f64>,
        varies: impl Fn(u32) -> bool,
    ) -> Option<u64> {
        if !self.runs_on_lanes() {
            return None;
        }
        let mut number = 0;
        let reads = |program: &Program| program.slots.iter().any(|slot| varies(*slot));
        for kink in self.kinks.iter().filter(|kink| reads(kink)) {
            let below = kink.eval(slots, stack).ok()? < 0.0;
            number = mixed(number, below.into());
        }
        for TableCall { table, arguments } in &self.table_calls {
            for (i, argument) in arguments.iter().enumerate().filter(|(_, own)| reads(own)) {
                let piece = table.piece(i, argument.eval(slots, stack).ok()?);
                number = mixed(number, piece as u64);
            }
        }
        Some(number)
    }
}

/// The order matters.
fn mixed(number: u64, piece: u64) -> u64 {
    (number.rotate_left(5) ^ (piece + 1)).wrapping_mul(FACTOR)
}
