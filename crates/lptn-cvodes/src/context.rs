//! A SUNDIALS context that prints nothing.

use std::cell::RefCell;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::ptr;

use sundials_sys as sys;

use lptn_integrate::IntegrateError;

/// The last message of SUNDIALS. Its address is known to SUNDIALS, hence the box in [`Context`].
type LastMessage = RefCell<String>;

/// One SUNDIALS context with its own error handler.
pub(crate) struct Context {
    raw: sys::SUNContext,
    message: Box<LastMessage>,
}

impl Context {
    pub(crate) fn new() -> Result<Self, IntegrateError> {
        let mut raw = ptr::null_mut();
        // SAFETY: `raw` is a valid place for the handle.
        let flag = unsafe { sys::SUNContext_Create(sys::comm_no_mpi(), &raw mut raw) };
        if flag != 0 || raw.is_null() {
            return Err(IntegrateError::OutOfMemory { function: "SUNContext_Create" });
        }
        let context = Self { raw, message: Box::default() };
        context.silence();
        Ok(context)
    }

    pub(crate) fn raw(&self) -> sys::SUNContext {
        self.raw
    }

    pub(crate) fn last_message(&self) -> String {
        self.message.borrow().clone()
    }

    /// The `data` of the error handlers.
    fn handler_data(&self) -> *mut c_void {
        ptr::from_ref::<LastMessage>(&self.message).cast_mut().cast()
    }

    /// In version 7 the handler belongs to the context; the logger, which prints warnings, is taken
    /// away.
    #[cfg(sundials7)]
    fn silence(&self) {
        // SAFETY: the context is alive, and the data outlives it: `drop` frees the context before
        // the box. Without a logger, messages to it return an error that CVODES ignores.
        unsafe {
            sys::SUNContext_ClearErrHandlers(self.raw);
            sys::SUNContext_PushErrHandler(self.raw, Some(keep_message), self.handler_data());
            sys::SUNContext_SetLogger(self.raw, ptr::null_mut());
        }
    }

    #[cfg(not(sundials7))]
    #[expect(clippy::unused_self, reason = "version 7 needs it")]
    fn silence(&self) {}

    /// In version 6 the handler belongs to the solver.
    #[cfg(not(sundials7))]
    pub(crate) fn attach(&self, cvode: *mut c_void) {
        // SAFETY: `cvode` was made by CVodeCreate with this context and is freed before it.
        unsafe { sys::CVodeSetErrHandlerFn(cvode, Some(keep_message), self.handler_data()) };
    }

    #[cfg(sundials7)]
    #[expect(clippy::unused_self, reason = "version 6 needs it")]
    pub(crate) fn attach(&self, _cvode: *mut c_void) {}
}

impl Drop for Context {
    fn drop(&mut self) {
        // SAFETY: made by SUNContext_Create; every object made with it is dropped earlier (field
        // order of the owner).
        unsafe { sys::SUNContext_Free(&raw mut self.raw) };
    }
}

#[cfg(sundials7)]
unsafe extern "C" fn keep_message(
    _line: c_int,
    _function: *const c_char,
    _file: *const c_char,
    message: *const c_char,
    _code: sys::SUNErrCode,
    data: *mut c_void,
    _context: sys::SUNContext,
) {
    // SAFETY: SUNDIALS passes its message and the data given to PushErrHandler.
    unsafe { store(message, data) };
}

#[cfg(not(sundials7))]
unsafe extern "C" fn keep_message(
    _code: c_int,
    _module: *const c_char,
    _function: *const c_char,
    message: *mut c_char,
    data: *mut c_void,
) {
    // SAFETY: SUNDIALS passes its message and the data given to CVodeSetErrHandlerFn.
    unsafe { store(message, data) };
}

/// # Safety
/// `message` is null or a C string, `data` points to a live [`LastMessage`].
unsafe fn store(message: *const c_char, data: *mut c_void) {
    if message.is_null() || data.is_null() {
        return;
    }
    // SAFETY: by the contract of this function.
    let (text, slot) = unsafe { (CStr::from_ptr(message), &*data.cast::<LastMessage>()) };
    if let Ok(mut slot) = slot.try_borrow_mut() {
        *slot = text.to_string_lossy().into_owned();
    }
}
