//! Reads `[sweep.NAME]`.

use std::sync::Arc;

use lptn_data::{Asked, CsvFile, Diagnostic, PlacedNumbers, Span, list};
use lptn_network::Value;
use lptn_units::{Dimension, Type};

use crate::csv_form::FILE;
use crate::fields::Fields;
use crate::listed::Names;
use crate::place::Wanted;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::reading::all;
use crate::sweep::axis::AxisValues;
use crate::sweep::declaration::SWEEP;
use crate::sweep::{Measure, SweepAxis, SweepFile, SweepMethod, SweepOver, SweepStudy};
use crate::work::Elaboration;

impl<'a> Elaboration<'a> {
    pub(super) fn sweep_study(&mut self, entry: &'a RawEntry) -> Option<SweepStudy> {
        let fields = self.fields(&SWEEP, entry)?;
        self.all_there(&fields, &["axes"])?;
        let over = self.choice(&fields, "over", &SweepOver::WORDS);
        let reports = self.measures(&fields, over.unwrap_or(SweepOver::Run));
        self.require(&fields, "method")?;
        let method = self.choice(&fields, "method", &SweepMethod::WORDS)?;
        let sampling = self.sampling(&fields, method);
        let (axes, file) = match method {
            SweepMethod::Csv => self.csv_axes(&fields).unzip(),
            _ => {
                self.refuse_keys(&fields, &["file"], "is for `method = \"csv\"`");
                (self.sweep_axes(&fields, method), None)
            }
        };
        let period = self.sweep_period(&fields, over);
        self.report_of_axis(&reports, axes.as_deref().unwrap_or_default());
        self.run_for(over?, &fields)?;
        let (samples, seed) = sampling?;
        let reports = reports.filter(|reports| !reports.is_empty())?;
        let front = self.front(&fields, &reports)?;
        Some(SweepStudy {
            name: entry.key.clone(),
            span: entry.key_span.clone(),
            method,
            axes: axes?,
            samples,
            seed,
            over: over?,
            period: period?,
            reports,
            front,
            file,
        })
    }

    /// Number of samples, and their seed.
    fn sampling(&mut self, fields: &Fields<'a>, method: SweepMethod) -> Option<(u64, u32)> {
        if !method.is_sampled() {
            let why = format!("is for samples, and `{}` takes none", method.word());
            self.refuse_keys(fields, &["samples", "seed"], &why);
            return Some((0, 0));
        }
        self.require(fields, "samples")?;
        let samples = self.whole(fields, "samples", 1);
        let seed = match fields.get("seed") {
            None => Some(1),
            Some(_) => self.whole(fields, "seed", 0).and_then(|seed| self.seed(fields, seed)),
        };
        Some((samples?, seed?))
    }

    fn seed(&mut self, fields: &Fields<'a>, seed: u64) -> Option<u32> {
        let found = u32::try_from(seed).ok();
        if let (None, Some(raw)) = (found, fields.get("seed")) {
            let message = format!("{} has to be below 2^32", fields.owner.field("seed"));
            self.refuse("netlist::sweep_count", message, &raw.span, "write for example `seed = 7`");
        }
        found
    }

    /// The period that is given: `Some(None)` if none is.
    fn sweep_period(
        &mut self,
        fields: &Fields<'a>,
        over: Option<SweepOver>,
    ) -> Option<Option<Value>> {
        let Some(raw) = fields.get("period") else { return Some(None) };
        if over.is_some_and(|over| over != SweepOver::Periodic) {
            self.refuse_keys(fields, &["period"], "is for `over = \"periodic\"`");
            return None;
        }
        let wanted = Wanted::constant(Type::of(Dimension::TIME));
        Some(Some(self.given_inside(&fields.owner, ("period", raw), wanted)?.value()))
    }

    fn run_for(&mut self, over: SweepOver, fields: &Fields<'a>) -> Option<()> {
        if over != SweepOver::Run || self.raw.top.get("run").is_some() {
            return Some(());
        }
        let message = format!("{} is over a run, and there is no [run]", fields.owner.words());
        let place = fields.get("over").map_or(fields.place, |raw| &raw.span);
        let help = "add these lines, or report `over = \"steady\"`:\n\n[run]\nstop = \"25 min\"";
        self.refuse("netlist::sweep_no_run", message, place, help);
        None
    }

    fn measures(&mut self, fields: &Fields<'a>, over: SweepOver) -> Option<Vec<Measure>> {
        let raw = self.require(fields, "report")?;
        let RawKind::Table(table) = &raw.kind else {
            self.report(fields.wrong_shape("report", raw, "a table of expressions of results"));
            return None;
        };
        if table.entries.is_empty() {
            let message = format!(
                "{} is empty: there is nothing to \
                report",
                fields.owner.field("report")
            );
            let help = format!("write it like this: `{}`", fields.sample("report"));
            self.refuse("netlist::sweep_empty", message, &raw.span, help);
            return None;
        }
        all(table.entries.iter().map(|entry| self.measure(entry, over)))
    }

    /// The two reports of a front: `Some(None)` if none is asked for.
    fn front(&mut self, fields: &Fields<'a>, reports: &[Measure]) -> Option<Option<[usize; 2]>> {
        let Some(raw) = fields.get("front") else { return Some(None) };
        let items = self.list(fields, ("front", "a list of two reports"))?;
        let place = |item: &'a RawValue| match &item.kind {
            RawKind::String { text, .. } => reports.iter().position(|report| report.name == *text),
            _ => None,
        };
        if let [one, other] = items
            && let (Some(one), Some(other)) = (place(one), place(other))
            && one != other
        {
            return Some(Some([one, other]));
        }
        let names: Vec<&str> = reports.iter().map(|report| report.name.as_str()).collect();
        let message = format!("{} has to name two of the reports", fields.owner.field("front"));
        let help = match names.len() {
            1 => "a front weighs two reports: add another to `report`".to_owned(),
            _ => format!("the reports are {}", list(&names)),
        };
        self.refuse("netlist::sweep_front", message, &raw.span, help);
        None
    }

    /// Refuses a report with the name of a parameter: two columns would have one name.
    fn report_of_axis(&mut self, reports: &Option<Vec<Measure>>, axes: &[SweepAxis]) {
        for measure in reports.iter().flatten() {
            let Some(axis) = axes.iter().find(|axis| axis.name == measure.name) else { continue };
            let message = format!("report `{}` has the name of a parameter that varies", axis.name);
            let problem = Diagnostic::error("netlist::report_name", message)
                .at(measure.span.clone(), "")
                .also(axis.span.clone(), "varies");
            self.report(problem.help("give the report another name"));
        }
    }

    /// The columns of the file, or those that `axes` lists.
    fn csv_axes(&mut self, fields: &Fields<'a>) -> Option<(Vec<SweepAxis>, SweepFile)> {
        let (file, written) = self.candidates(fields)?;
        let wanted: Vec<(String, Span)> = match fields.get("axes") {
            None => self.all_columns(fields, &file)?,
            Some(_) => {
                let wanted = "a list of parameters: the columns to read";
                let names = self.listed(fields, "axes", Names::List(wanted))?;
                names.into_iter().map(|one| (one.name.to_owned(), one.span.clone())).collect()
            }
        };
        let known = all(wanted.into_iter().map(|(name, span)| {
            let ty = self.axis_type(fields, &name, &span)?;
            let words = format!("`{name}` of {}", fields.owner.words());
            Some((name, ty, Asked { words, span: Some(span) }))
        }))?;
        let asked: Vec<_> =
            known.iter().map(|(name, ty, asked)| (name.as_str(), Some(*ty), asked)).collect();
        let columns = file.columns(&asked);
        let axes = known.into_iter().zip(columns);
        let axes = all(axes.map(|(axis, column)| self.csv_axis(fields, axis, column)))?;
        Some((axes, written))
    }

    /// Every column of the file; each has to be a parameter.
    fn all_columns(&mut self, fields: &Fields<'a>, file: &CsvFile) -> Option<Vec<(String, Span)>> {
        let all: Vec<(String, Span)> =
            file.names().map(|(name, place)| (name.to_owned(), place.clone())).collect();
        let (known, others): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|(name, _)| self.names.is_parameter(name));
        let named: Vec<String> = known.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        for (name, place) in &others {
            let message = format!(
                "column `{name}` of the candidates of {} is not a parameter",
                fields.owner.words()
            );
            let help = match named.is_empty() {
                true => "give the value a name in [param] and use it in the element".to_owned(),
                false => format!(
                    "name the columns to read, `axes = [{}]`, or add `{name}` to [param]",
                    named.join(", ")
                ),
            };
            self.refuse("netlist::unknown_parameter", message, place, help);
        }
        others.is_empty().then_some(known)
    }

    fn candidates(&mut self, fields: &Fields<'a>) -> Option<(Arc<CsvFile>, SweepFile)> {
        let raw = self.require(fields, "file")?;
        let named = self.formed_file(fields, ("file", &FILE), raw)?;
        let csv: &'a crate::csv_files::CsvFiles = self.csv;
        let text = self.kept(csv.text(named.raw)?.map_err(Diagnostic::clone))?;
        let (csv, span) = (named.csv.to_owned(), named.raw.span.clone());
        let file = CsvFile::open(text, &span, &named.options);
        let file = self.kept(file.map_err(|problem| named.explained(problem)))?;
        self.problems.extend(file.note(None));
        Some((Arc::new(file), SweepFile { csv, span, options: named.options }))
    }

    fn csv_axis(
        &mut self,
        fields: &Fields<'a>,
        (name, _, asked): (String, Type, Asked),
        column: Result<PlacedNumbers, Vec<Diagnostic>>,
    ) -> Option<SweepAxis> {
        let column = column.map_err(|problems| self.problems.extend(problems)).ok()?;
        if column.numbers.is_empty() {
            let message = format!("{} has a header and no rows", fields.owner.field("file"));
            let help = "write one candidate a line below the header";
            self.refuse("netlist::sweep_empty", message, &column.whole, help);
            return None;
        }
        let span = asked.span.unwrap_or_else(|| column.whole.clone());
        Some(SweepAxis { name, span, values: AxisValues::Column(column) })
    }
}
