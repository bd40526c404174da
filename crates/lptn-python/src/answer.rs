//! An answer, as Python reads it.

use std::borrow::Cow;
use std::sync::OnceLock;

use lptn::{Format, Look, Picture, Rows, Table, problems_as_json, write};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::sheet::Sheet;
use crate::subject::Found;
use crate::trouble::Trouble;

/// Columns of characters of a text.
const WIDTH: usize = 80;

/// An answer. Everything is made when it is asked for.
#[pyclass(frozen, module = "lptn._lptn")]
pub(crate) struct Answer {
    found: Found,
    /// The columns of rows that are words.
    sheet: OnceLock<Option<Sheet>>,
}

impl Answer {
    pub(crate) fn of(found: Found) -> Self {
        Self { found, sheet: OnceLock::new() }
    }

    fn written(&self, format: Format) -> String {
        let mut bytes = Vec::new();
        // a vector takes everything
        drop(write(&*self.found, format, Look::PLAIN, &mut bytes));
        String::from_utf8(bytes).unwrap_or_default()
    }

    /// The columns of rows that are words; `None` if the rows are a table.
    fn sheet(&self) -> Option<&Sheet> {
        let read = || match self.found.rows() {
            Rows::Words(rows) => Some(Sheet::of(&rows)),
            Rows::Table(_) => None,
        };
        self.sheet.get_or_init(read).as_ref()
    }

    /// The columns of numbers, and labels, of rows that are a table.
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

    /// Names of the columns, with the unit of those of numbers.
    fn columns(&self) -> Vec<(String, Option<String>)> {
        if let Some(sheet) = self.sheet() {
            return sheet.columns();
        }
        let Some(table) = self.table() else { return Vec::new() };
        let labels = table.labels().iter().map(|label| (label.name.clone(), None));
        let columns = table.columns().iter();
        labels.chain(columns.map(|of| (of.name.clone(), Some(of.unit.clone())))).collect()
    }

    /// The cells of a column of words.
    fn words(&self, name: &str) -> Option<Vec<String>> {
        if let Some(sheet) = self.sheet() {
            return sheet.words(name).map(<[_]>::to_vec);
        }
        let table = self.table()?;
        table.labels().iter().find(|label| label.name == name).map(|label| label.cells.clone())
    }

    /// The unit of a column of numbers, and the numbers, each 8 bytes.
    fn numbers<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<Option<(Cow<'_, str>, Bound<'py, PyBytes>)>> {
        if let Some(sheet) = self.sheet() {
            let Some((unit, values)) = sheet.numbers(name) else { return Ok(None) };
            return Ok(Some((unit.into(), bytes(py, values)?)));
        }
        let Some(table) = self.table() else { return Ok(None) };
        let column = table.columns().iter().find(|column| column.name == name);
        let Some(column) = column else { return Ok(None) };
        Ok(Some((column.unit.clone().into(), bytes(py, &column.values)?)))
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

fn bytes<'py>(py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyBytes>> {
    PyBytes::new_with(py, 8 * values.len(), |bytes| {
        for (place, value) in bytes.chunks_exact_mut(8).zip(values) {
            place.copy_from_slice(&value.to_ne_bytes());
        }
        Ok(())
    })
}
