//! Reads `data` of `[fit.NAME]`: the records.

use std::sync::Arc;

use lptn_data::{Diagnostic, Record, RecordName, RecordQuery, read_text};
use lptn_network::{Context, Value};
use lptn_units::Scope as _;

use crate::fields::{Fields, Owner, wrong_shape};
use crate::fit::read::Column;
use crate::fit::{FitRecord, FitSignal, RECORD, VariedName};
use crate::formed_file::FormedFile;
use crate::place::Wanted;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::work::Elaboration;

impl<'a> Elaboration<'a> {
    /// The records; `None` after an error in one, which is reported.
    pub(crate) fn fit_records(
        &mut self,
        fields: &Fields<'a>,
        (columns, signals, drop_outliers): (&[Column<'a>], &[FitSignal], bool),
        time: Option<(&str, &RawValue)>,
    ) -> Option<Vec<FitRecord>> {
        let raw = self.require(fields, "data")?;
        let items = match &raw.kind {
            RawKind::Array(list) if !list.is_empty() => list.as_slice(),
            RawKind::String { .. } | RawKind::Table(_) => std::slice::from_ref(raw),
            _ => {
                self.report(fields.wrong_shape("data", raw, "a CSV file or a list of them"));
                return None;
            }
        };
        let name = |column: &Column<'_>| RecordName {
            name: column.entry.key.clone(),
            ty: column.observed.as_ref().map(|observed| observed.ty),
            span: Some(column.entry.key_span.clone()),
        };
        let time = time.map(|(name, raw)| RecordName {
            span: Some(raw.span.clone()),
            ..RecordName::new(name)
        });
        let followed = |signal: &FitSignal| RecordName {
            name: signal.column.clone(),
            ty: Some(signal.ty),
            span: Some(signal.span.clone()),
        };
        let columns = columns.iter().map(name).chain(signals.iter().map(followed)).collect();
        let query = RecordQuery { time, columns, drop_outliers, ..RecordQuery::default() };
        let mut records: Vec<FitRecord> = Vec::new();
        let mut complete = true;
        for item in items {
            match self.fit_record(fields, item, &query) {
                Some(record) => {
                    if let Some(first) = records.iter().find(|other| other.csv == record.csv) {
                        let problem = twice(&record, first);
                        self.report(problem);
                    }
                    records.push(record);
                }
                None => complete = false,
            }
        }
        complete.then_some(records)
    }

    fn fit_record(
        &mut self,
        fields: &Fields<'a>,
        item: &'a RawValue,
        query: &RecordQuery,
    ) -> Option<FitRecord> {
        let named = self.formed_file(fields, ("data", &RECORD), item);
        let (mut set, mut sound) = (Vec::new(), true);
        if let RawKind::Table(table) = &item.kind
            && let Some(entry) = table.get("set")
        {
            let owner = fields.owner.inside("data").inside("set");
            sound = self.parameters_set(&owner, entry, &mut set);
        }
        let FormedFile { csv, raw, options: form, .. } = named?;
        let record = self.fit_file(raw, &RecordQuery { csv: form.clone(), ..query.clone() })?;
        let (csv, span) = (csv.to_owned(), raw.span.clone());
        sound.then_some(FitRecord { csv, record, set, form, span })
    }

    /// The record that a value names. Without columns to read, its contents cannot be checked.
    fn fit_file(&mut self, raw: &RawValue, query: &RecordQuery) -> Option<Arc<Record>> {
        let csv: &'a crate::csv_files::CsvFiles = self.csv;
        let text = self.kept(csv.text(raw)?.map_err(Diagnostic::clone))?;
        if query.columns.is_empty() {
            return None;
        }
        let record = read_text(text, query).map_err(|problems| self.problems.extend(problems));
        let mut record = record.ok()?;
        self.problems.append(&mut record.warnings);
        Some(Arc::new(record))
    }

    /// `set = { omega = "1000 rpm" }`: adds the parameters with their values; false after an
    /// error, which is reported.
    pub(crate) fn parameters_set(
        &mut self,
        owner: &Owner<'_>,
        entry: &'a RawEntry,
        set: &mut Vec<(String, Value)>,
    ) -> bool {
        let RawKind::Table(table) = &entry.value.kind else {
            let sample = "set = { omega = \"1000 rpm\" }";
            self.report(wrong_shape(&owner.words(), &entry.value, "a table of parameters", sample));
            return false;
        };
        let mut sound = true;
        for entry in &table.entries {
            let name = &entry.key;
            if !self.is_parameter_here(&owner.words(), name, &entry.key_span) {
                sound = false;
                continue;
            }
            let value = self.builder.scope(Context::Time).symbol(name).and_then(|symbol| {
                self.exactly_inside(owner, (name, &entry.value), Wanted::like(symbol.ty))
            });
            match value {
                Some(value) => set.push((name.clone(), value)),
                None => sound = false,
            }
        }
        sound
    }

    /// Refuses a parameter that is varied and has a value from a record.
    pub(crate) fn set_and_varied(
        &mut self,
        fields: &Fields<'a>,
        records: &[FitRecord],
        varied: &[VariedName],
    ) {
        for record in records {
            for (name, _) in &record.set {
                let Some(estimated) = varied.iter().find(|varied| varied.name == *name) else {
                    continue;
                };
                let message = format!(
                    "{} varies `{name}`, which the record {} sets",
                    fields.owner.words(),
                    record.csv
                );
                let problem = Diagnostic::error("netlist::fit_set_and_varied", message)
                    .at(estimated.span.clone(), "varied")
                    .also(record.span.clone(), "set for this record");
                self.report(
                    problem.help(format!("leave `{name}` out of `vary`, or out of every `set`")),
                );
            }
        }
    }
}

fn twice(record: &FitRecord, first: &FitRecord) -> Diagnostic {
    let message = format!("{} is named twice: its samples would count twice", record.csv);
    Diagnostic::error("netlist::fit_record_twice", message)
        .at(record.span.clone(), "again")
        .also(first.span.clone(), "first here")
        .help("name each record once")
}
