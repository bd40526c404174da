//! The heap allocation that the callbacks of CVODES work on.

use std::ptr::NonNull;

use crate::callback::Shared;

/// Owner of the allocation, which the callbacks reach through the pointer in it.
pub(crate) struct SharedBox<S>(NonNull<Shared<S>>);

impl<S> SharedBox<S> {
    pub(crate) fn new(shared: Shared<S>) -> Self {
        Self(NonNull::from(Box::leak(Box::new(shared))))
    }

    pub(crate) fn as_ptr(&self) -> *mut Shared<S> {
        self.0.as_ptr()
    }

    pub(crate) fn get(&self) -> &Shared<S> {
        // SAFETY: allocated by `new`; callbacks run only inside methods that borrow the integrator
        // for writing and that keep no reference from here during the call.
        unsafe { self.0.as_ref() }
    }

    pub(crate) fn get_mut(&mut self) -> &mut Shared<S> {
        // SAFETY: as in `get`, and `self` is borrowed for writing.
        unsafe { self.0.as_mut() }
    }

    /// The contents. CVODES, which has the pointer too, must be gone.
    pub(crate) fn into_inner(self) -> Shared<S> {
        let pointer = self.0;
        std::mem::forget(self);
        // SAFETY: allocated by `new` with `Box`, and the owner was forgotten, so no one
        // frees it again.
        *unsafe { Box::from_raw(pointer.as_ptr()) }
    }
}

impl<S> Drop for SharedBox<S> {
    fn drop(&mut self) {
        // SAFETY: allocated by `new` with `Box`, freed once; CVODES, which has the pointer too, is
        // gone by then.
        drop(unsafe { Box::from_raw(self.0.as_ptr()) });
    }
}
