//! Frames of Python as files in memory.

use lptn::RowColumn;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// Files in memory by their paths.
pub(crate) type Files = Vec<(String, Vec<u8>)>;

/// The bytes of a CSV file with these columns: headings, and numbers of 8 bytes each or words.
#[pyfunction]
pub(crate) fn csv(py: Python<'_>, columns: Vec<(String, Cells)>) -> PyResult<Bound<'_, PyBytes>> {
    let number = |bytes: &[u8]| bytes.try_into().map_or(f64::NAN, f64::from_ne_bytes);
    let columns = columns.into_iter().map(|(name, cells)| {
        let cells = match cells {
            Cells::Words(words) => lptn::Cells::Words(words.into()),
            Cells::Numbers(bytes) => {
                let numbers = bytes.chunks_exact(size_of::<f64>()).map(number);
                lptn::Cells::Numbers(numbers.collect())
            }
        };
        RowColumn { name, unit: None, cells }
    });
    let columns: Vec<RowColumn<'_>> = columns.collect();
    let bytes = py.detach(|| RowColumn::csv(&columns));
    Ok(PyBytes::new(py, &bytes))
}

/// The cells of a column of a frame.
#[derive(FromPyObject)]
pub(crate) enum Cells {
    /// Numbers, each 8 bytes.
    Numbers(Vec<u8>),
    /// Texts.
    Words(Vec<String>),
}
