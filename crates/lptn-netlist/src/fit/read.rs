//! Reads `[fit.NAME]`: varied parameters and observed results.

use lptn_data::{Diagnostic, Span, list};
use lptn_network::{End, Value};
use lptn_units::Type;

use crate::fields::{Fields, Owner, wrong_shape};
use crate::fit::{FIT, FIT_COLUMN, FitInitial, FitStudy, Observed, VariedName};
use crate::format::KeyDeclaration;
use crate::listed::{Listed, Names};
use crate::place::{Place, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::reading::all;
use crate::size::VARY;
use crate::work::Elaboration;

/// Words for outliers, which no time history explains; true if they are dropped.
pub(crate) const OUTLIERS: [(&str, bool); 2] = [("keep", false), ("drop", true)];

/// A column of the records; `None` if its result could not be read.
pub(crate) struct Column<'a> {
    pub(crate) entry: &'a RawEntry,
    pub(crate) observed: Option<Observed>,
}

/// A measured result, as it is written and as it is read.
pub(crate) struct Measured {
    pub(crate) text: String,
    pub(crate) end: Option<End>,
    pub(crate) value: Value,
    pub(crate) ty: Type,
}

impl<'a> Elaboration<'a> {
    pub(super) fn fit_study(&mut self, entry: &'a RawEntry) -> Option<FitStudy> {
        let fields = self.fields(&FIT, entry)?;
        self.all_there(&fields, &[])?;
        let initial = self.fit_initial(&fields);
        let drop_outliers = self.choice(&fields, "outliers", &OUTLIERS);
        let reads = self.recorded_columns(&fields, drop_outliers == Some(true));
        // after the columns, whose expressions may use the varied parameters
        let varied = self.varied(&fields);
        let reads = reads?;
        self.set_and_varied(&fields, &reads.records, varied.as_deref().unwrap_or_default());
        Some(FitStudy {
            name: entry.key.clone(),
            span: entry.key_span.clone(),
            varied: varied?,
            initial: initial?,
            drop_outliers: drop_outliers?,
            ..reads
        })
    }

    /// The records and the results that their columns measured, as a fit that varies nothing.
    pub(crate) fn recorded_columns(
        &mut self,
        fields: &Fields<'a>,
        drop_outliers: bool,
    ) -> Option<FitStudy> {
        let columns = self.observed(fields);
        let time =
            fields.get("time").map(|raw| (fields.text("time", raw, &mut self.problems), raw));
        let signals = self.fit_signals(fields);
        let time_name = time.map(|(text, raw)| (text.unwrap_or("t"), raw));
        let followed = signals.as_deref().unwrap_or_default();
        let columns_read = (columns.as_slice(), followed, drop_outliers);
        let records = self.fit_records(fields, columns_read, time_name)?;
        let observed: Option<Vec<Observed>> =
            columns.into_iter().map(|column| column.observed).collect();
        let observed = observed.filter(|observed| !observed.is_empty())?;
        Some(FitStudy {
            name: String::new(),
            span: fields.place.clone(),
            records,
            observed,
            varied: Vec::new(),
            signals: signals?,
            initial: FitInitial::Network,
            drop_outliers,
            time: time.and_then(|(text, _)| text).map(str::to_owned),
        })
    }

    /// Checks that the required keys are given; all that are missing are one problem, because it
    /// has one place. The help shows them, and `also`.
    pub(crate) fn all_there(&mut self, fields: &Fields<'a>, also: &[&str]) -> Option<()> {
        let is_missing = |key: &&KeyDeclaration| key.needed && fields.get(key.name).is_none();
        let keys = fields.declared().iter();
        let missing: Vec<&str> = keys.clone().filter(is_missing).map(|key| key.name).collect();
        if missing.len() < 2 || !fields.complete {
            return Some(());
        }
        let message = format!("{} has no {}", fields.owner.words(), list(&missing));
        let shown = keys.filter(|key| is_missing(key) || also.contains(&key.name));
        let lines: Vec<String> = shown.map(|key| fields.sample(key.name)).collect();
        let help = format!("add for example:\n\n{}", lines.join("\n"));
        self.refuse("netlist::missing_field", message, fields.place, help);
        None
    }

    /// `vary = { R_int = { from = …, to = … } }`, or a list of names.
    fn varied(&mut self, fields: &Fields<'a>) -> Option<Vec<VariedName>> {
        let wanted = "a table of parameters or a list of their names";
        let names = self.listed(fields, "vary", Names::Either(wanted))?;
        let all = all(names.into_iter().map(|one| self.varied_name(fields, one)))?;
        for (i, entry) in all.iter().enumerate() {
            if let Some(first) = all[..i].iter().find(|other| other.name == entry.name) {
                let message =
                    format!("{} names `{}` twice", fields.owner.field("vary"), entry.name);
                let problem = Diagnostic::error("netlist::fit_vary", message)
                    .at(entry.span.clone(), "again")
                    .also(first.span.clone(), "first here");
                self.report(problem.help("name each parameter once"));
                return None;
            }
        }
        Some(all)
    }

    fn varied_name(&mut self, fields: &Fields<'a>, one: Listed<'a>) -> Option<VariedName> {
        let Listed { name, span, entry } = one;
        let known = self.can_vary(&fields.owner.field("vary"), name, span);
        let owner = fields.owner.inside("vary").inside(name);
        let range = match entry {
            Some(entry) => Some(self.inner(&VARY, owner, entry)?),
            None => None,
        };
        known?;
        let ty = self.type_here(name)?;
        let [from, to] = range.map_or(Some([None, None]), |range| self.ends(&range, ty))?;
        Some(VariedName { name: name.to_owned(), span: span.clone(), from, to })
    }

    /// Checks that a name is that of a parameter that something depends on.
    pub(crate) fn can_vary(&mut self, words: &str, name: &str, place: &Span) -> Option<()> {
        if !self.is_parameter_here(words, name, place) {
            return None;
        }
        if !self.names.is_used(name) {
            let message = format!("{words} names `{name}`, which nothing in the network uses");
            let help = "use it in an element, or leave it out: no record can determine its value";
            self.refuse("netlist::fit_unused", message, place, help);
            return None;
        }
        (!self.names.has_failed(name)).then_some(())
    }

    /// `column = { ring_gear = "steel.T", housing = { of = "aluminium.T", sigma = "0.2 K" } }`.
    fn observed(&mut self, fields: &Fields<'a>) -> Vec<Column<'a>> {
        let wanted = "a table of columns and the results that they measure";
        let names = self.listed(fields, "column", Names::Table(wanted, wanted));
        let entries = names.into_iter().flatten().filter_map(|one| one.entry);
        let column = |entry| Column { entry, observed: self.observed_column(fields, entry) };
        let columns: Vec<Column<'a>> = entries.map(column).collect();
        self.one_kind_a_sensor(&columns);
        columns
    }

    /// Reports a sensor that measures quantities of two types.
    fn one_kind_a_sensor(&mut self, columns: &[Column<'a>]) {
        let observed: Vec<&Observed> = columns.iter().filter_map(|c| c.observed.as_ref()).collect();
        for (i, own) in observed.iter().enumerate().filter(|(_, own)| own.sensor.is_some()) {
            let same = observed[..i].iter().find(|other| other.sensor == own.sensor);
            let Some(other) = same.filter(|o| o.ty.dimension != own.ty.dimension) else { continue };
            let [first, second] = [other, own].map(|o| o.ty.dimension.si_unit());
            let sensor = own.sensor.as_deref().unwrap_or_default();
            let message = format!("sensor `{sensor}` gave a column in {first} and one in {second}");
            let problem = Diagnostic::error("netlist::fit_sensor", message)
                .at(own.span.clone(), format!("in {second}"))
                .also(other.span.clone(), format!("in {first}"));
            self.report(
                problem.help("an instrument measures one kind of thing: write two sensors"),
            );
        }
    }

    fn observed_column(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<Observed> {
        let owner = fields.owner.inside("column").inside(&entry.key);
        let inner = match &entry.value.kind {
            RawKind::Table(_) => Some(self.inner(&FIT_COLUMN, owner.clone(), entry)?),
            _ => None,
        };
        let of = match &inner {
            Some(inner) => self.require(inner, "of")?,
            None => &entry.value,
        };
        let Measured { text, end, value, ty } = self.fit_result(&owner, of)?;
        let (own, sensor) = match &inner {
            Some(inner) => (inner.get("sigma"), self.sensor_of(inner, Some(ty))?),
            None => (None, None),
        };
        let sigma = match own.or_else(|| fields.get("sigma")) {
            None => None,
            // the deviation of a temperature is a difference
            Some(raw) => {
                let wanted = Wanted::constant(Type::of(ty.dimension));
                Some(self.exactly_inside(&owner, ("sigma", raw), wanted)?)
            }
        };
        let column = entry.key.clone();
        let span = entry.key_span.clone();
        let sensor = sensor.map(|(name, _)| name.to_owned());
        Some(Observed { column, text, end, value, ty, sigma, sensor, span })
    }

    /// The result that a column measures.
    pub(crate) fn fit_result(&mut self, owner: &Owner<'_>, of: &RawValue) -> Option<Measured> {
        let RawKind::String { text, .. } = &of.kind else {
            self.report(wrong_shape(&owner.words(), of, "the name of a result", "\"steel.T\""));
            return None;
        };
        let given = self.given(Place { owner, key: "", raw: of }, Wanted::of_results())?;
        let (ty, text) = (given.ty(), text.trim());
        let end = text.strip_suffix(".T").and_then(|name| self.builder.end(name));
        Some(Measured { text: text.to_owned(), end, value: given.value(), ty })
    }
}
