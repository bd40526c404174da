//! A record whose rows arrive one by one; only the header and the last row are kept.

use crate::diagnostic::Diagnostic;
use crate::file::Files;
use crate::limits::Rejected;
use crate::record::rows::read;
use crate::record::{Extent, Record, RecordQuery};
use crate::text::CsvText;

/// Reads a record line by line. Comments, gaps, units, repeated rows and a last row that breaks off
/// are treated as in a record that is read as a whole. Checks that need all rows (holes, outliers,
/// a sensor at its end) are skipped.
#[derive(Debug)]
pub struct RecordLines {
    name: String,
    query: RecordQuery,
    /// Number of lines up to now.
    count: usize,
    /// The header, the last row, and one after it that breaks off, each with its line number.
    kept: Vec<(usize, String)>,
    /// True if the last of them breaks off.
    broken: bool,
    /// Number of rows up to now.
    rows: usize,
}

/// A row of the record.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordRow {
    /// The number of its line, from 1.
    pub line: usize,
    /// Time in s.
    pub time: f64,
    /// A value in SI units for each requested column, absolute temperatures in K; NaN for a gap.
    pub values: Vec<f64>,
}

/// The result of a line.
#[derive(Debug, Default)]
pub struct RecordLine {
    /// Its row, if it counts as one.
    pub row: Option<RecordRow>,
    /// Its warnings, and the texts to which their places refer.
    pub warnings: (Files, Vec<Diagnostic>),
}

impl RecordLines {
    /// Before the first line; `name` is the record's name in diagnostics.
    pub fn new(name: impl Into<String>, query: RecordQuery) -> Self {
        let (kept, name) = (Vec::new(), name.into());
        Self { name, query, count: 0, kept, broken: false, rows: 0 }
    }

    /// Number of rows up to now.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Reads a line, with or without its end.
    ///
    /// # Errors
    /// [`Rejected`] with its problems and their places.
    pub fn take(&mut self, bytes: &[u8]) -> Result<RecordLine, Rejected> {
        self.count += 1;
        let bytes = bytes.strip_suffix(b"\n").unwrap_or(bytes);
        let bytes = bytes.strip_suffix(b"\r").unwrap_or(bytes);
        let mark: &[u8] = if self.count == 1 { "\u{feff}".as_bytes() } else { &[] };
        let line = self.line(bytes.strip_prefix(mark).unwrap_or(bytes))?;
        if line.trim().is_empty() || line.starts_with('#') {
            return Ok(RecordLine::default());
        }
        self.kept.push((self.count, line));
        if self.kept.len() == 1 {
            return Ok(RecordLine::default());
        }
        let sound = self.read(false).ok().filter(|(_, record)| record.warnings.is_empty());
        // for diagnostics, places are those of all lines
        let (files, record) = sound.map_or_else(|| self.read(true), Ok)?;
        Ok(self.answer(files, &record))
    }

    /// The warnings if no more lines come: that the last one breaks off.
    ///
    /// # Errors
    /// [`Rejected`] with its other problems.
    pub fn end(self) -> Result<(Files, Vec<Diagnostic>), Rejected> {
        if !self.broken {
            return Ok((Files::new(), Vec::new()));
        }
        let (files, record) = self.read(true)?;
        Ok((files, record.warnings))
    }

    /// The text of a line.
    fn line(&self, bytes: &[u8]) -> Result<String, Rejected> {
        if let Some(line) = std::str::from_utf8(bytes).ok().filter(|line| !line.contains('\0')) {
            return Ok(line.to_owned());
        }
        let (mut files, mut all) = (Files::new(), vec![b'\n'; self.count - 1]);
        all.extend_from_slice(bytes);
        let problem = CsvText::refused(&mut files, &self.name, &all);
        Err(Rejected::new(files, vec![problem]))
    }

    /// The kept lines, one after the other or each at its own line.
    fn text(&self, placed: bool) -> String {
        let mut text = String::new();
        let mut at = 1;
        for (line, kept) in &self.kept {
            if placed {
                text.extend(std::iter::repeat_n('\n', line - at));
            }
            at = line + 1;
            text.push_str(kept);
            text.push('\n');
        }
        text
    }

    fn read(&self, placed: bool) -> Result<(Files, Record), Rejected> {
        let mut files = Files::new();
        let text = CsvText::of(&mut files, self.name.clone(), self.text(placed).as_bytes());
        match text
            .map_err(|problem| vec![problem])
            .and_then(|text| read(&text, &self.query, Extent::Part))
        {
            Ok(record) => Ok((files, record)),
            Err(problems) => Err(Rejected::new(files, problems)),
        }
    }

    /// The result of the last line, from the kept lines as a record.
    fn answer(&mut self, files: Files, record: &Record) -> RecordLine {
        let before = usize::from(self.rows > 0);
        let broke = record.warnings.iter().any(|warning| warning.code == "record::broken_off");
        if broke {
            // another line may come: then it is an error, and a warning at the end only
            self.broken = true;
            return RecordLine::default();
        }
        let place = record.time.len().checked_sub(1).filter(|place| *place >= before);
        let Some(place) = place else {
            self.kept.pop();
            return RecordLine { row: None, warnings: (files, record.warnings.clone()) };
        };
        self.rows += 1;
        self.kept.drain(1..self.kept.len() - 1);
        let values = record.columns.iter().map(|column| column.values[place]).collect();
        let row = RecordRow { line: self.count, time: record.time[place], values };
        RecordLine { row: Some(row), warnings: (files, record.warnings.clone()) }
    }
}
