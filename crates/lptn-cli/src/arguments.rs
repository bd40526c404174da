//! The words of the command line: those of the program, or those that Python passes on.

use std::ffi::OsString;
use std::sync::OnceLock;

static WORDS: OnceLock<Vec<OsString>> = OnceLock::new();

/// Keeps the words, the name of the program first.
pub(crate) fn are(words: Vec<OsString>) {
    // a second call in one program has no other words
    drop(WORDS.set(words));
}

/// The name of the program and the words after it.
pub(crate) fn all() -> &'static [OsString] {
    WORDS.get().map_or(&[], Vec::as_slice)
}

/// The words after the name of the program.
pub(crate) fn words() -> Vec<String> {
    all().iter().skip(1).map(|word| word.to_string_lossy().into_owned()).collect()
}
