//! Rows of a sweep as lines of CSV.

use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::row::{Row, RowShape};
use crate::failure::Failure;

/// No row is longer, in bytes.
const LONGEST: u64 = 1 << 20;

/// The whole lines of a file, with their ends; a last line without one is left out.
#[derive(Debug)]
pub struct Lines {
    path: PathBuf,
    reader: BufReader<File>,
}

impl Lines {
    /// Opens a file.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        let file = File::open(path);
        let file = file.map_err(|error| Failure::cannot_read(path.display(), &error, None))?;
        Ok(Self { path: path.to_owned(), reader: BufReader::with_capacity(1 << 16, file) })
    }

    /// The next whole line; `None` at the end.
    ///
    /// # Errors
    /// A file that cannot be read further.
    pub fn next_line(&mut self) -> Result<Option<Vec<u8>>, Failure> {
        let mut line = Vec::new();
        let read = self.reader.by_ref().take(LONGEST).read_until(b'\n', &mut line);
        read.map_err(|error| Failure::cannot_read(self.path.display(), &error, None))?;
        Ok(line.ends_with(b"\n").then_some(line))
    }
}

/// A line that is not a row.
pub fn damaged(path: &Path, line: u64) -> Failure {
    let message = format!("line {line} of {} is not a row of this sweep", path.display());
    Failure::refused("sweep::damaged", message, "remove the file and start again")
}

/// The row in a line of this shape.
pub fn read_row(line: &[u8], shape: RowShape) -> Option<Row> {
    let text = std::str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let cells: Vec<&str> = text.split(',').collect();
    let [case, numbers @ .., failed] = cells.as_slice() else { return None };
    let (numbers, outside) = match (shape.ranged, numbers) {
        (true, [numbers @ .., outside]) => (numbers, *outside),
        _ => (numbers, ""),
    };
    let (numbers, limits, worst) = match (shape.judged, numbers) {
        (true, [numbers @ .., limits, worst]) => (numbers, *limits, *worst),
        _ => (numbers, "", ""),
    };
    let number = |cell: &&str| match *cell {
        "" => Some(f64::NAN),
        cell => cell.parse().ok(),
    };
    let numbers: Option<Vec<f64>> = numbers.iter().map(number).collect();
    let outside = if outside.is_empty() { Some(0) } else { outside.parse().ok() };
    let case = case.parse::<u64>().ok()?.checked_sub(1)?;
    let [limits, worst, failed] = [limits, worst, failed].map(str::to_owned);
    let row = Row { case, numbers: numbers?, limits, worst, outside: outside?, failed };
    (cells.len() == shape.columns).then_some(row)
}

/// A row as JSON: numbers, `null` for none, the code last.
pub(super) fn json_row(row: &Row, shape: RowShape) -> String {
    let word = |word: &str| if word.is_empty() { Value::Null } else { json!(word) };
    let mut cells = vec![json!(row.case + 1)];
    cells.extend(row.numbers.iter().map(|number| json!(number)));
    if shape.judged {
        cells.extend([word(&row.limits), word(&row.worst)]);
    }
    cells.extend(
        shape.ranged.then(|| if row.failed.is_empty() { json!(row.outside) } else { Value::Null }),
    );
    cells.push(word(&row.failed));
    Value::Array(cells).to_string()
}
