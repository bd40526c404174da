//! The core of live pages.

/// The core as WebAssembly, packed by `xz --format=lzma`; `None` if the program was built without it.
#[cfg(live_core)]
pub(crate) const CORE: Option<&[u8]> = Some(include_bytes!(env!("LPTN_LIVE_CORE")));

/// The core as WebAssembly, packed by `xz --format=lzma`; `None` if the program was built without it.
#[cfg(not(live_core))]
pub(crate) const CORE: Option<&[u8]> = None;
