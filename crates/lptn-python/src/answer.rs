//! An answer, as Python reads it.

use std::borrow::Cow;

use lptn::{Format, Look, Picture, Rows, Table, problems_as_json, write};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::subject::Found;
use crate::trouble::Trouble;

/// Columns of characters of a text.
const WIDTH: usize = 80;

/// An answer. Everything is made when it is asked for.
#[pyclass(frozen, module = "lptn._lptn")]
pub(crate) struct Answer {
    found: Found,
}

impl Answer {
    pub(crate) fn of(found: Found) -> Self {
        Self { found }
    }

    fn written(&self, format: Format) -> String {
        let mut bytes = Vec::new();
        // a vector takes everything
        drop(write(&*self.found, format, Look::PLAIN, &mut bytes));
        String::from_utf8(bytes).unwrap_or_default()
    }

    /// The columns of numbers; none if the rows are words.
    fn table(&self) -> Option<Cow<'_, Table>> {
        match self.found.rows() {
            Rows::Table(table) => Some(table),
            Rows::Words(_) => None,
        }
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
        self.found.exit() as u8
    }

    /// A sentence for each reason why the answer is no.
    fn reasons(&self) -> Vec<String> {
        self.found.reasons()
    }

    /// The doubts as JSON; `None` without doubts.
    fn doubts(&self) -> Option<String> {
        let doubts = self.found.doubts();
        (!doubts.is_empty()).then(|| problems_as_json(self.found.files(), &doubts).to_string())
    }

    /// Names and units of the columns of numbers; `None` if the rows are words.
    fn columns(&self) -> Option<Vec<(String, String)>> {
        let table = self.table()?;
        Some(table.columns().iter().map(|c| (c.name.clone(), c.unit.clone())).collect())
    }

    /// The columns of words next to them: name and cells.
    fn labels(&self) -> Vec<(String, Vec<String>)> {
        let Some(table) = self.table() else { return Vec::new() };
        table.labels().iter().map(|label| (label.name.clone(), label.cells.clone())).collect()
    }

    /// The numbers of a column, each 8 bytes.
    fn numbers<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyBytes>>> {
        let Some(table) = self.table() else { return Ok(None) };
        let Some(column) = table.columns().iter().find(|column| column.name == name) else {
            return Ok(None);
        };
        let bytes = PyBytes::new_with(py, 8 * column.values.len(), |bytes| {
            for (place, value) in bytes.chunks_exact_mut(8).zip(&column.values) {
                place.copy_from_slice(&value.to_ne_bytes());
            }
            Ok(())
        })?;
        Ok(Some(bytes))
    }

    /// The figures as one SVG; `None` if there is nothing to draw.
    fn svg(&self) -> PyResult<Option<String>> {
        let figures = self.found.figures();
        if figures.iter().all(|figure| figure.panels.is_empty()) {
            return Ok(None);
        }
        let drawn = Picture::Svg.draw(&figures, (WIDTH, false));
        let drawn = drawn.map_err(|error| Trouble::fault(&error.to_string()))?;
        Ok(Some(String::from_utf8_lossy(&drawn).into_owned()))
    }
}
