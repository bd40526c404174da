//! The search of [`smooth`](super::smooth) where its library is left out. For WebAssembly it would
//! bring the functions of a browser into a page, which asks for no size.

/// As in `smooth.rs`.
pub(crate) type Values = (f64, Vec<f64>);

/// As in `smooth.rs`.
#[derive(Clone, Copy, Debug)]
#[expect(dead_code, reason = "nothing is searched")]
pub(crate) struct Effort {
    pub(crate) step: f64,
    pub(crate) accuracy: f64,
    pub(crate) iterations: u64,
}

/// The start: a search that breaks off leaves the last place that it accepted.
#[expect(clippy::unnecessary_wraps, reason = "as in `smooth.rs`")]
pub(crate) fn minimise<E: 'static>(
    _: &dyn Fn(&[f64]) -> Result<Values, E>,
    (start, _): (&[f64], usize),
    _: Effort,
) -> Result<Vec<f64>, E> {
    Ok(start.to_vec())
}
