//! Several vectors of one length, and the same values as blocks of one slice.

use sundials_sys as sys;
use sys::N_Vector;

use crate::context::Context;
use crate::vector::{Vector, values, values_mut};
use lptn_integrate::IntegrateError;

/// Owned vectors, one per sensitivity; may be none.
pub(crate) struct Vectors {
    owned: Vec<Vector>,
    /// The handles of `owned`, as SUNDIALS wants them.
    raw: Vec<N_Vector>,
}

impl Vectors {
    pub(crate) fn new(
        context: &Context,
        count: usize,
        length: usize,
    ) -> Result<Self, IntegrateError> {
        let owned =
            (0..count).map(|_| Vector::new(context, length)).collect::<Result<Vec<_>, _>>()?;
        let raw = owned.iter().map(Vector::raw).collect();
        Ok(Self { owned, raw })
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.owned.is_empty()
    }

    pub(crate) fn len(&self) -> usize {
        self.owned.len()
    }

    /// For calls that read the vectors or write to them; none keeps the array or changes it.
    pub(crate) fn raw(&self) -> *mut N_Vector {
        self.raw.as_ptr().cast_mut()
    }

    /// Writes the blocks of a slice into the vectors.
    pub(crate) fn set(&mut self, blocks: &[f64]) {
        // SAFETY: the vectors are ours, and `self` is borrowed for writing.
        unsafe { scatter(blocks, &self.raw) };
    }

    /// Writes the vectors into the blocks of a slice.
    pub(crate) fn copy_to(&self, blocks: &mut [f64]) {
        // SAFETY: the vectors are ours, and no one writes to them while `self` is borrowed.
        unsafe { gather(&self.raw, blocks) };
    }
}

/// Writes the vectors into the blocks of a slice.
///
/// # Safety
/// The vectors were made by this crate, and no one writes to them during the call.
pub(crate) unsafe fn gather(vectors: &[N_Vector], blocks: &mut [f64]) {
    let length = blocks.len() / vectors.len().max(1);
    for (&vector, block) in vectors.iter().zip(blocks.chunks_exact_mut(length.max(1))) {
        // SAFETY: by the contract of this function.
        block.copy_from_slice(unsafe { values(vector) });
    }
}

/// Writes the blocks of a slice into the vectors.
///
/// # Safety
/// The vectors were made by this crate, are different, and no one else uses them now.
pub(crate) unsafe fn scatter(blocks: &[f64], vectors: &[N_Vector]) {
    let length = blocks.len() / vectors.len().max(1);
    for (&vector, block) in vectors.iter().zip(blocks.chunks_exact(length.max(1))) {
        // SAFETY: by the contract of this function.
        unsafe { values_mut(vector) }.copy_from_slice(block);
    }
}
