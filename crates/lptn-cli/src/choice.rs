//! Options whose values a library names.

use clap::builder::{PossibleValuesParser, TypedValueParser};

/// A choice of a library by its name there, so that the names stand in one place.
pub(crate) fn one_of<T: Copy + Send + Sync + 'static>(
    all: &'static [T],
    key: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let found = move |text: String| all.iter().copied().find(|choice| key(*choice) == text);
    PossibleValuesParser::new(all.iter().map(|choice| key(*choice)))
        .try_map(move |text| found(text).ok_or("this is no choice"))
}
