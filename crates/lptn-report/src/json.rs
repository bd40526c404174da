//! Results as JSON: one object whose members are written one after the other.
//!
//! With `--format json` stdout contains one object in every case. A failure is an object too, with
//! code, place and help of each problem; stderr repeats it for people. All temperatures of an
//! object are in the unit that is shown.

use std::io::{self, Write};

use lptn_solve::Table;
use serde::Serialize;
use serde_json::Value;

use crate::number::Shortest;

/// The object of a page that is being written.
pub type Json<'a> = JsonWriter<&'a mut dyn Write>;

/// Writes one JSON object, a member at a time. Rows of a table are never all in memory as text.
///
/// Numbers read back as the same `f64`; those that are not finite are `null`.
pub struct JsonWriter<W: Write> {
    out: W,
    empty: bool,
}

impl<W: Write> JsonWriter<W> {
    /// Begins the object.
    pub fn new(out: W) -> Self {
        Self { out, empty: true }
    }

    /// Writes a member.
    ///
    /// # Errors
    /// Errors of the stream.
    pub fn member(&mut self, name: &str, value: &(impl Serialize + ?Sized)) -> io::Result<()> {
        self.key(name)?;
        // a line break inside a string is escaped, so every one here is layout
        self.out.write_all(serde_json::to_string_pretty(value)?.replace('\n', "\n  ").as_bytes())
    }

    /// Writes a member if there is one.
    ///
    /// # Errors
    /// Errors of the stream.
    pub fn optional(&mut self, name: &str, value: Option<impl Serialize>) -> io::Result<()> {
        value.map_or(Ok(()), |value| self.member(name, &value))
    }

    /// Writes a table as `columns`, each with name and unit, and `rows` of plain numbers.
    /// Columns of words come first, with `null` as unit.
    ///
    /// # Errors
    /// Errors of the stream.
    pub fn table(&mut self, table: &Table) -> io::Result<()> {
        self.key("columns")?;
        let labels = table.labels().iter().map(|label| (label.name.as_str(), None));
        let numbers =
            table.columns().iter().map(|column| (column.name.as_str(), Some(column.unit.as_str())));
        self.lines(labels.chain(numbers), |out, (name, unit)| {
            let (name, unit) = (Value::from(name), Value::from(unit));
            write!(out, "{{ \"name\": {name}, \"unit\": {unit} }}")
        })?;
        self.key("rows")?;
        let (mut number, mut line) = (Shortest::new(), String::new());
        self.lines(0..table.rows(), |out, row| {
            line.clear();
            for label in table.labels() {
                line += &Value::from(label.cells[row].as_str()).to_string();
                line += ", ";
            }
            for value in table.row(row) {
                line += if value.is_finite() { number.text(value) } else { "null" };
                line += ", ";
            }
            write!(out, "[{}]", line.trim_end_matches(", "))
        })
    }

    /// Writes a list whose items are JSON text already, one per line.
    /// The list may be larger than the memory.
    ///
    /// # Errors
    /// Errors of the items or the stream.
    pub fn texts(
        &mut self,
        name: &str,
        items: impl Iterator<Item = io::Result<String>>,
    ) -> io::Result<()> {
        self.key(name)?;
        self.lines(items, |out, item| out.write_all(item?.as_bytes()))
    }

    /// Ends the object, flushes the stream and returns it.
    ///
    /// # Errors
    /// Errors of the stream.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.write_all(if self.empty { b"{}\n" } else { b"\n}\n" })?;
        self.out.flush()?;
        Ok(self.out)
    }

    fn key(&mut self, name: &str) -> io::Result<()> {
        let start = if self.empty { "{" } else { "," };
        self.empty = false;
        write!(self.out, "{start}\n  {}: ", Value::from(name))
    }

    fn lines<T>(
        &mut self,
        items: impl Iterator<Item = T>,
        mut line: impl FnMut(&mut W, T) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut separator = "[\n    ";
        for item in items {
            self.out.write_all(separator.as_bytes())?;
            line(&mut self.out, item)?;
            separator = ",\n    ";
        }
        let none = separator.starts_with('[');
        self.out.write_all(if none { b"[]" } else { b"\n  ]" })
    }
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::JsonWriter;

    #[test]
    fn members_read_back() {
        let mut writer = JsonWriter::new(Vec::new());
        writer.member("a\"b", &json!({ "x": ["line\nbreak", 1e-7] })).unwrap();
        writer.member("c", &json!([])).unwrap();
        let text = writer.finish().unwrap();
        let value: Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(value, json!({ "a\"b": { "x": ["line\nbreak", 1e-7] }, "c": [] }));
    }

    #[test]
    fn an_empty_object_is_one() {
        assert_eq!(JsonWriter::new(Vec::new()).finish().unwrap(), b"{}\n");
    }
}
