//! The functions that a page calls.
//!
//! The page asks for room, writes a text there, calls `lptn_open` or `lptn_ask`, and reads the text
//! of the answer.

use std::cell::RefCell;

use crate::live::{self, Live};

#[derive(Default)]
struct State {
    /// A text from the page, then the text for it.
    text: Vec<u8>,
    live: Option<Live>,
}

thread_local! {
    static STATE: RefCell<State> = RefCell::default();
}

/// The place for a text of `length` bytes.
#[unsafe(no_mangle)]
extern "C" fn lptn_room(length: usize) -> *mut u8 {
    STATE.with_borrow_mut(|state| {
        state.text = vec![0; length];
        state.text.as_mut_ptr()
    })
}

/// Opens the contents of a page, and returns the length of the answer.
#[unsafe(no_mangle)]
extern "C" fn lptn_open() -> usize {
    answered(|state, text| match Live::open(&text) {
        Ok(live) => {
            let answer = live.answer("{}");
            state.live = Some(live);
            answer
        }
        Err(failure) => live::refused(&failure).to_string(),
    })
}

/// Answers a question to the contents, and returns the length of the answer.
#[unsafe(no_mangle)]
extern "C" fn lptn_ask() -> usize {
    answered(|state, text| state.live.as_ref().map_or_else(String::new, |live| live.answer(&text)))
}

/// The place of the answer.
#[unsafe(no_mangle)]
extern "C" fn lptn_answer() -> *const u8 {
    STATE.with_borrow(|state| state.text.as_ptr())
}

fn answered(work: impl FnOnce(&mut State, String) -> String) -> usize {
    STATE.with_borrow_mut(|state| {
        let text = String::from_utf8(std::mem::take(&mut state.text)).unwrap_or_default();
        state.text = work(state, text).into_bytes();
        state.text.len()
    })
}
