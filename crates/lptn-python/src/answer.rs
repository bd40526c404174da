//! An answer, as Python reads it.

use lptn::{Cells, Format, Look, Picture, Rows, problems_as_json, write};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::subject::Found;
use crate::trouble::Trouble;

/// Columns of characters of a text.
const WIDTH: usize = 80;

/// An answer. Everything is made when it is asked for.
#[pyclass(frozen, module = "lptn._lptn")]
pub(crate) struct Answer(Found);

impl Answer {
    pub(crate) fn of(found: Found) -> Self {
        Self(found)
    }

    fn written(&self, format: Format) -> String {
        let mut bytes = Vec::new();
        // a vector takes everything
        drop(write(&*self.0, format, Look::PLAIN, &mut bytes));
        String::from_utf8(bytes).unwrap_or_default()
    }
}

#[pymethods]
impl Answer {
    /// The object that `--format json` prints.
    fn json(&self, py: Python<'_>) -> String {
        py.detach(|| self.written(Format::Json))
    }

    /// The text that the command prints.
    fn text(&self, py: Python<'_>) -> String {
        py.detach(|| self.written(Format::Table))
    }

    /// The rows that `--format csv` prints.
    fn csv(&self, py: Python<'_>) -> String {
        py.detach(|| self.written(Format::Csv))
    }

    /// The exit code of the command.
    fn exit(&self) -> u8 {
        self.0.exit() as u8
    }

    /// A sentence for each reason why the answer is no.
    fn reasons(&self) -> Vec<String> {
        self.0.reasons()
    }

    /// The doubts as JSON; `None` without doubts.
    fn doubts(&self) -> Option<String> {
        let doubts = self.0.doubts();
        (!doubts.is_empty()).then(|| problems_as_json(self.0.files(), &doubts).to_string())
    }

    /// Names of the columns, with the unit of those of numbers.
    fn columns(&self) -> Vec<(String, Option<String>)> {
        match self.0.rows() {
            Rows::Table(table) => {
                let labels = table.labels().iter().map(|label| (label.name.clone(), None));
                let columns = table.columns().iter();
                labels.chain(columns.map(|of| (of.name.clone(), Some(of.unit.clone())))).collect()
            }
            Rows::Columns(columns) => columns.into_iter().map(|of| (of.name, of.unit)).collect(),
        }
    }

    /// The cells of a column of words.
    fn words(&self, name: &str) -> Option<Vec<String>> {
        match self.0.rows() {
            Rows::Table(table) => {
                table.labels().iter().find(|label| label.name == name).map(|of| of.cells.clone())
            }
            Rows::Columns(columns) => match columns.into_iter().find(|of| of.name == name)?.cells {
                Cells::Words(cells) => Some(cells.into_owned()),
                Cells::Numbers(_) | Cells::Counts(_) => None,
            },
        }
    }

    /// The unit of a column of numbers, and the numbers, each 8 bytes.
    fn numbers<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<Option<(String, Bound<'py, PyBytes>)>> {
        let given = |unit: &str, values| Ok(Some((unit.to_owned(), bytes(py, values)?)));
        match self.0.rows() {
            Rows::Table(table) => {
                let column = table.columns().iter().find(|column| column.name == name);
                column.map_or(Ok(None), |column| given(&column.unit, &column.values))
            }
            Rows::Columns(columns) => {
                let column = columns.iter().find(|column| column.name == name);
                let column = column.and_then(|of| Some((of.unit.as_ref()?, of.values()?)));
                column.map_or(Ok(None), |(unit, values)| given(unit, values))
            }
        }
    }

    /// The figures as one SVG; `None` if there is nothing to draw.
    fn svg(&self) -> PyResult<Option<String>> {
        let figures = self.0.figures();
        if figures.iter().all(|figure| figure.panels.is_empty()) {
            return Ok(None);
        }
        let drawn = Picture::Svg.draw(&figures, (WIDTH, false));
        let drawn = drawn.map_err(|error| Trouble::fault(&error.to_string()))?;
        Ok(Some(String::from_utf8_lossy(&drawn).into_owned()))
    }
}

fn bytes<'py>(py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyBytes>> {
    PyBytes::new_with(py, 8 * values.len(), |bytes| {
        for (place, value) in bytes.chunks_exact_mut(8).zip(values) {
            place.copy_from_slice(&value.to_ne_bytes());
        }
        Ok(())
    })
}
