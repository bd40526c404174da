//! The formats in which a page is written.

use std::io::{self, Write};

use crate::colour::Look;
use crate::json::JsonWriter;
use crate::page::Page;
use crate::{csv, text};

lptn_units::words! {
/// Format of a written result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Text for a terminal of 80 columns.
    Table = "table",
    /// Comma-separated values.
    Csv = "csv",
    /// One JSON object.
    Json = "json",
}
/// Its name on the command line.
pub fn key;
}

/// Writes a page in a format.
///
/// # Errors
/// Errors of the stream.
pub fn write(page: &dyn Page, format: Format, look: Look, out: &mut dyn Write) -> io::Result<()> {
    match format {
        Format::Table => text::write(&page.text(), look, out),
        Format::Csv => csv::write(&page.rows(), out),
        Format::Json => {
            let mut json = JsonWriter::new(out);
            page.json(&mut json)?;
            json.finish().map(drop)
        }
    }
}

#[cfg(test)]
mod tests {
    use lptn_solve::Table;

    use super::{Format, write};
    use crate::{Json, Look, Page, Rows, Text};

    struct Answer;

    impl Page for Answer {
        fn text(&self) -> Text {
            Text::titled("hot")
        }

        fn rows(&self) -> Rows<'_> {
            let mut table = Table::of(&[300.5, f64::NAN]);
            table.column("steel.T", "K", |value| *value);
            table.done().into()
        }

        fn json(&self, json: &mut Json<'_>) -> std::io::Result<()> {
            json.member("format", &1)?;
            json.optional("limits", None::<f64>)?;
            json.member("none", &f64::NAN)
        }
    }

    /// A format that is missing from the list would never be written.
    #[test]
    fn every_format_has_a_name_and_a_writer() {
        let written = Format::ALL.map(|format| {
            let mut out = Vec::new();
            write(&Answer, format, Look::PLAIN, &mut out).unwrap();
            (format.key(), String::from_utf8(out).unwrap())
        });
        let csv = "steel.T [K]\n300.5\nNaN\n".to_owned();
        let json = "{\n  \"format\": 1,\n  \"none\": null\n}\n".to_owned();
        assert_eq!(written, [("table", "hot\n".to_owned()), ("csv", csv), ("json", json)]);
    }
}
