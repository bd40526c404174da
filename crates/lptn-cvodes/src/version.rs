//! Version and linkage of SUNDIALS.

use std::ffi::{CStr, c_char, c_int};

/// Linkage of SUNDIALS.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Linkage {
    /// The shared libraries of the system.
    System,
    /// The copy inside sundials-sys, linked statically (cargo feature `bundled`).
    Bundled,
}

/// The SUNDIALS in use.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Linked {
    /// Version of the library itself, asked at run time, such as `6.4.1`.
    pub version: String,
    /// Version of the headers this crate was compiled against.
    pub headers: String,
    /// Linkage of the library.
    pub linkage: Linkage,
}

unsafe extern "C" {
    // Present in 6 and 7, but in no header that sundials-sys translates.
    fn SUNDIALSGetVersion(version: *mut c_char, len: c_int) -> c_int;
}

/// Compares at compile time: the build script read `found`, which may be empty; sundials-sys
/// translated `bindings`.
const fn same_version(found: &[u8], bindings: &[u8]) -> bool {
    let mut i = 0;
    while i < found.len() {
        if i >= bindings.len() || found[i] != bindings[i] {
            return false;
        }
        i += 1;
    }
    found.is_empty() || (i < bindings.len() && bindings[i] == 0)
}

const _: () = assert!(
    same_version(env!("LPTN_SUNDIALS_HEADER").as_bytes(), sundials_sys::SUNDIALS_VERSION),
    "sundials-sys was built against another SUNDIALS than the one of the system: install \
     libsundials-dev, or use the cargo feature `bundled`"
);
const _: () = assert!(
    (sundials_sys::SUNDIALS_VERSION_MAJOR >= 7) == cfg!(sundials7),
    "the bindings are of another major version of SUNDIALS than the build script expects"
);

/// The SUNDIALS this program runs with.
#[must_use]
pub fn linked() -> Linked {
    let headers = text_of(sundials_sys::SUNDIALS_VERSION);
    let mut buffer = [0_u8; 32];
    // SAFETY: the buffer is writable for the length passed on, and 32 bytes suffice for a version
    // text with its final zero; a longer one makes the function return an error and write nothing.
    let flag = unsafe { SUNDIALSGetVersion(buffer.as_mut_ptr().cast(), 32) };
    let version = if flag == 0 { text_of(&buffer) } else { headers.clone() };
    let linkage = if cfg!(feature = "bundled") { Linkage::Bundled } else { Linkage::System };
    Linked { version, headers, linkage }
}

fn text_of(bytes: &[u8]) -> String {
    CStr::from_bytes_until_nul(bytes)
        .map_or_else(|_| String::new(), |text| text.to_string_lossy().into_owned())
}
