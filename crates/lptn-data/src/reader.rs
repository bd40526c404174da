//! The rows of a CSV text, with their places.

use crate::dialect::Dialect;

/// Reads the records of a text from some byte on. Lines that are empty or begin with `#` are left
/// out; positions are those in the whole text.
pub(crate) struct Reader<'t> {
    csv: csv::Reader<&'t [u8]>,
    /// The byte of the text at which it began.
    base: u64,
    /// The memory of the last record.
    spare: csv::StringRecord,
}

impl<'t> Reader<'t> {
    /// Before the record at `start`.
    pub(crate) fn at(text: &'t str, start: usize, separator: u8) -> Self {
        let csv = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(separator)
            .comment(Some(b'#'))
            .from_reader(text.get(start..).unwrap_or_default().as_bytes());
        let base = u64::try_from(start).unwrap_or_default();
        Self { csv, base, spare: csv::StringRecord::new() }
    }

    /// Before the header.
    pub(crate) fn header(text: &'t str, dialect: &Dialect) -> Self {
        Self::at(text, dialect.start, dialect.separator)
    }

    /// Before the first row.
    pub(crate) fn rows(text: &'t str, dialect: &Dialect) -> Self {
        let text = dialect.end.and_then(|end| text.get(..end)).unwrap_or(text);
        if let Some(rows) = dialect.rows {
            return Self::at(text, rows, dialect.separator);
        }
        let mut reader = Self::header(text, dialect);
        reader.read(&mut csv::StringRecord::new());
        reader
    }

    /// Reads the next record; false at the end.
    #[inline]
    pub(crate) fn read(&mut self, record: &mut csv::StringRecord) -> bool {
        // the text is UTF-8 and rows may be of any length: nothing can fail
        let found = self.csv.read_record(record).unwrap_or(false);
        if self.base > 0 { found && placed(record, self.base) } else { found }
    }
}

/// Sets the position of a record in the whole text, of which the first bytes were left out.
#[cold]
fn placed(record: &mut csv::StringRecord, base: u64) -> bool {
    if let Some(position) = record.position() {
        let (mut moved, byte) = (position.clone(), position.byte());
        moved.set_byte(byte + base);
        record.set_position(Some(moved));
    }
    true
}

impl Iterator for Reader<'_> {
    type Item = csv::StringRecord;

    fn next(&mut self) -> Option<Self::Item> {
        let mut found = self.csv.read_record(&mut self.spare).unwrap_or(false);
        if self.base > 0 {
            found = found && placed(&mut self.spare, self.base);
        }
        // a clone takes the memory that it needs; a new record grows by steps
        found.then(|| self.spare.clone())
    }
}

/// The byte at which the reader started to look for a record.
pub(crate) fn position(cells: &csv::StringRecord) -> usize {
    cells.position().map_or(0, |position| usize::try_from(position.byte()).unwrap_or(0))
}

/// The line of the record that the reader looked for from this byte on.
pub(crate) fn line(text: &str, from: usize) -> std::ops::Range<usize> {
    let mut start = from.min(text.len());
    if start == 0 && text.starts_with('\u{feff}') {
        // the reader skips a byte order mark at the beginning, and only there
        start = '\u{feff}'.len_utf8();
    }
    // the reader notes where it started to look for a record, not where the record is
    let ends = ['\r', '\n'];
    let mut rest = text.get(start..).unwrap_or_default();
    while rest.starts_with(ends) || rest.starts_with('#') {
        // a comment goes on to the line feed, an empty line to either
        let end = if rest.starts_with('#') { rest.find('\n') } else { Some(0) };
        start += end.map_or(rest.len(), |end| end + 1);
        rest = text.get(start..).unwrap_or_default();
    }
    start..start + rest.find(ends).unwrap_or(rest.len())
}
