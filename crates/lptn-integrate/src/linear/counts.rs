//! Size of exact factors, without the positions of their numbers.

use faer::dyn_stack::MemStack;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

use super::allocated;
use super::shape::short;
use crate::{FactorError, Pattern};

/// Number of slots above which nothing is ordered: the indices of the order have 31 bits.
const MOST: usize = 1 << 29;

/// The size of a Cholesky decomposition in approximate minimum degree order, as the ordering
/// estimates it: a little too large. Takes a quarter of the memory of the analysis.
pub(super) struct Counts {
    /// Numbers of the factors.
    pub(super) fill: f64,
    /// Products of a factorisation.
    pub(super) products: f64,
}

impl Counts {
    /// # Errors
    /// [`FactorError::OutOfMemory`].
    pub(super) fn of(pattern: &Pattern) -> Result<Self, FactorError> {
        if pattern.len() > MOST {
            return Ok(Self { fill: f64::INFINITY, products: f64::INFINITY });
        }
        let size = pattern.size();
        let mut rows = Vec::with_capacity((pattern.len() + size) / 2);
        let mut pointers = Vec::with_capacity(size + 1);
        pointers.push(0_u32);
        for column in 0..size {
            let slots = pattern.diagonal_slot(column)..pattern.column(column).end;
            rows.extend(pattern.row_indices()[slots].iter().map(|&row| short(row)));
            pointers.push(short(rows.len()));
        }
        let lower = SymbolicSparseColMatRef::new_checked(size, size, &pointers, None, &rows);
        let (mut order, mut inverse) = (vec![0; size], vec![0; size]);
        let mut memory = allocated(amd::order_scratch::<u32>(size, rows.len()))?;
        let stack = MemStack::new(&mut memory);
        let work = amd::order(&mut order, &mut inverse, lower, Default::default(), stack);
        let work = work.map_err(|_| FactorError::OutOfMemory)?;
        let fill = work.n_div + size as f64;
        Ok(Self { fill, products: 2.0 * work.n_mult_subs_ldl + fill })
    }
}
