//! The rows of a sweep as Parquet, for programs that read many: `case` and `outside` as integers,
//! reports of failed candidates as nulls, `failed` as text, the names with their units as in CSV.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::growing::{Lines, damaged, read_row};
use super::row::Row;
use crate::files::Folder;
use crate::files::names::{PARQUET, SWEEP};
use lptn_answer::failure::Failure;

/// Numbers of one group of rows: what is in memory at a time.
const NUMBERS: usize = 1 << 21;

/// Writes the rows beside those in CSV; `ranged` is whether there is a column that counts laws
/// outside of their ranges.
pub(crate) fn write(folder: &Folder, ranged: bool) -> Result<(), Failure> {
    let path = folder.path().join(SWEEP);
    let mut batch = folder.batch();
    let mut unread = None;
    batch.write(PARQUET, |out| {
        copy((&path, ranged), out).unwrap_or_else(|failure| {
            unread = Some(failure);
            Ok(())
        })
    })?;
    match unread {
        Some(failure) => Err(failure),
        None => batch.commit(&[]),
    }
}

/// The outer error is that of the rows, the inner one that of what is written.
fn copy(
    (path, ranged): (&Path, bool),
    out: &mut (dyn Write + Send),
) -> Result<io::Result<()>, Failure> {
    let mut lines = Lines::open(path)?;
    let heading = lines.next()?.unwrap_or_default();
    let heading = String::from_utf8_lossy(&heading).trim_end().to_owned();
    let mut file = match Rows::begin((&heading, ranged), out) {
        Ok(file) => file,
        Err(error) => return Ok(Err(error.into())),
    };
    let mut number = 1;
    while let Some(line) = lines.next()? {
        number += 1;
        let row = read_row(&line, file.columns, ranged).ok_or_else(|| damaged(path, number))?;
        if let Err(error) = file.push(row) {
            return Ok(Err(error.into()));
        }
    }
    Ok(file.finish().map_err(io::Error::from))
}

/// A file that grows by groups of rows.
struct Rows<'a> {
    writer: SerializedFileWriter<&'a mut (dyn Write + Send)>,
    columns: usize,
    ranged: bool,
    waiting: Vec<Row>,
}

impl<'a> Rows<'a> {
    fn begin(
        (heading, ranged): (&str, bool),
        out: &'a mut (dyn Write + Send),
    ) -> Result<Self, ParquetError> {
        let names: Vec<&str> = heading.split(',').collect();
        let counted = |place: usize| place == 0 || ranged && place + 2 == names.len();
        let fields: Result<Vec<_>, _> = names
            .iter()
            .enumerate()
            .map(|(place, name)| match place {
                _ if counted(place) => field(name, Physical::INT64, None),
                _ if place + 1 == names.len() => {
                    field(name, Physical::BYTE_ARRAY, Some(LogicalType::String))
                }
                _ => field(name, Physical::DOUBLE, None),
            })
            .collect();
        let schema = Type::group_type_builder("sweep").with_fields(fields?).build()?;
        let made = concat!("lptn ", env!("CARGO_PKG_VERSION"));
        let properties = WriterProperties::builder().set_created_by(made.to_owned()).build();
        let writer = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?;
        Ok(Self { writer, columns: names.len(), ranged, waiting: Vec::new() })
    }

    fn push(&mut self, row: Row) -> Result<(), ParquetError> {
        self.waiting.push(row);
        match self.waiting.len() * self.columns < NUMBERS {
            true => Ok(()),
            false => self.group(),
        }
    }

    /// Writes what waits as a group, column by column.
    fn group(&mut self) -> Result<(), ParquetError> {
        let rows = std::mem::take(&mut self.waiting);
        let mut group = self.writer.next_row_group()?;
        let cases = rows.iter().map(|row| i64::try_from(row.case + 1).ok());
        column::<Int64Type>(&mut group, cases)?;
        for place in 0..self.columns - 2 - usize::from(self.ranged) {
            let numbers = rows.iter().map(|row| row.numbers.get(place).copied());
            column::<DoubleType>(&mut group, numbers.map(|n| n.filter(|n| !n.is_nan())))?;
        }
        if self.ranged {
            let known = rows.iter().map(|row| row.failed.is_empty().then_some(row.outside));
            column::<Int64Type>(&mut group, known.map(|n| i64::try_from(n?).ok()))?;
        }
        let codes =
            rows.iter().map(|row| Some(row.failed.as_str()).filter(|code| !code.is_empty()));
        column::<ByteArrayType>(&mut group, codes.map(|code| code.map(ByteArray::from)))?;
        group.close().map(drop)
    }

    fn finish(mut self) -> Result<(), ParquetError> {
        if !self.waiting.is_empty() {
            self.group()?;
        }
        self.writer.close().map(drop)
    }
}

fn field(
    name: &str,
    physical: Physical,
    logical: Option<LogicalType>,
) -> Result<Arc<Type>, ParquetError> {
    Type::primitive_type_builder(name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical)
        .build()
        .map(Arc::new)
}

/// Writes the next column of a group, with nulls for what is not there.
fn column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, &mut (dyn Write + Send)>,
    values: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let (mut there, mut levels) = (Vec::new(), Vec::new());
    for value in values {
        levels.push(i16::from(value.is_some()));
        there.extend(value);
    }
    if let Some(mut column) = group.next_column()? {
        column.typed::<T>().write_batch(&there, Some(&levels), None)?;
        column.close()?;
    }
    Ok(())
}
