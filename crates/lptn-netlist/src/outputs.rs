//! Reports of a run in addition to its columns: expressions of results, and windows of time.

use lptn_data::{Diagnostic, Span};
use lptn_network::{Field, Input, Item, WindowSettings};

use crate::fields::{Fields, Owner};
use crate::format::{SectionDeclaration, key};
use crate::functional::Taken;
use crate::place::{Place, Text, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::setting::{Setting, TIME};
use crate::value::whole;
use crate::work::Elaboration;

/// `climb = { from = …, to = … }` in `window` of `[run]`.
pub(crate) const WINDOW: SectionDeclaration = SectionDeclaration {
    name: "window",
    keys: &[
        key("from", "s", "when it begins", "\"10 min\"").needed(),
        key("to", "s", "when it ends", "\"20 min\"").needed(),
    ],
    example: "{ from = \"10 min\", to = \"20 min\" }",
    ..SectionDeclaration::NEW
};

/// A window before its expressions are evaluated.
#[derive(Clone, Debug)]
pub(crate) struct WindowPlan {
    name: String,
    from: Setting,
    to: Setting,
}

impl<'a> Elaboration<'a> {
    /// `report = { rise = "ring.T - air.T" }`: each becomes a column, a functional a number.
    pub(crate) fn reports(&mut self, fields: &Fields<'a>) {
        for entry in self.members(fields, "report") {
            self.report_column(entry);
        }
    }

    fn report_column(&mut self, entry: &'a RawEntry) -> Option<()> {
        let owner = Owner::element("report", &entry.key);
        let place = Place { owner: &owner, key: "", raw: &entry.value };
        if entry.key == "time" {
            let message = "`time` is the column of the time";
            self.refuse(
                "netlist::report_name",
                message,
                &entry.key_span,
                "give the report another name",
            );
            return None;
        }
        let text = self.names.text(place, None);
        let text = self.kept(text)?;
        let called = match &text {
            Text::Expression(expression) => self.called(expression).map(|c| (whole(expression), c)),
            Text::Quantity(_) => None,
        };
        let id = if let Some((written, called)) = called {
            let Taken { of: (of, _), ty, over_time } = self.over_time(place, called)?;
            let id = self.builder.report(&entry.key, Input::of_type(of, ty), &written);
            self.builder.report_over_time(id, over_time);
            id
        } else {
            let input = self.resolve(place, text, Wanted::of_results())?.input();
            self.builder.report(&entry.key, input, as_written(&entry.value))
        };
        let item = Item::Report(id);
        self.map.insert(item, Field::Name, entry.key_span.clone());
        self.map.value(item, Field::Value, &entry.value);
        Some(())
    }

    /// `window = { climb = { from = "10 min", to = "20 min" } }`.
    pub(crate) fn windows(&mut self, fields: &Fields<'a>) -> Vec<WindowPlan> {
        let windows = self
            .members(fields, "window")
            .iter()
            .map(|entry| self.window(entry))
            .collect::<Vec<_>>();
        windows.into_iter().flatten().collect()
    }

    fn window(&mut self, entry: &'a RawEntry) -> Option<WindowPlan> {
        let fields = self.fields(&WINDOW, entry)?;
        let (from, to) = (self.window_end(&fields, "from"), self.window_end(&fields, "to"));
        Some(WindowPlan { name: entry.key.clone(), from: from?, to: to? })
    }

    fn window_end(&mut self, fields: &Fields<'a>, key: &str) -> Option<Setting> {
        let Some(raw) = fields.get(key) else {
            if fields.complete {
                let message = format!("{} has no `{key}`", fields.owner.words());
                self.report(fields.missing(key, message).help(HELP));
            }
            return None;
        };
        // without a key: elsewhere `from` and `to` are names of nodes
        let mut setting = self.setting(&fields.owner.inside(key), ("", raw), TIME)?;
        HELP.clone_into(&mut setting.help);
        Some(setting)
    }

    /// The entries of a table in `[run]`.
    fn members(&mut self, fields: &Fields<'a>, key: &str) -> &'a [RawEntry] {
        self.table_of(fields, (key, "a table")).map_or(&[], |table| &table.entries)
    }
}

/// The text of a report.
fn as_written(raw: &RawValue) -> &str {
    match &raw.kind {
        RawKind::String { text, .. } | RawKind::Integer(text) | RawKind::Float(text) => text.trim(),
        _ => "",
    }
}

const HELP: &str =
    "write it like this: `window = { climb = { from = \"10 min\", to = \"20 min\" } }`";

impl WindowPlan {
    /// Its name.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Both ends, for evaluation.
    pub(crate) fn ends(&self) -> [&Setting; 2] {
        [&self.from, &self.to]
    }

    /// The window between these times in s, or an error if a run from `start` to `stop` lacks it.
    pub(crate) fn settings(
        &self,
        (from, to): (f64, f64),
        (start, stop): (f64, f64),
    ) -> Result<WindowSettings, Diagnostic> {
        let name = &self.name;
        let at = |span: &Span| span.clone();
        let problem = |message| Diagnostic::error("netlist::run_window", message);
        if to <= from {
            let message = format!("window `{name}` ends at {to} s, but begins at {from} s");
            let error = problem(message)
                .at(at(&self.to.span), "ends here")
                .also(at(&self.from.span), "begins here");
            return Err(error.help(
                "`to` has to be after `from`: swap the two if they are the wrong way round",
            ));
        }
        if from < start || to > stop {
            let (end, time) = if from < start { (&self.from, from) } else { (&self.to, to) };
            let message = format!(
                "window `{name}` is not inside the run, which lasts from {start} s to {stop} s: \
                 {time} s"
            );
            return Err(problem(message)
                .at(at(&end.span), "outside the run")
                .help("change the window, or `start` and `stop` of the run"));
        }
        Ok(WindowSettings { name: name.clone(), from, to })
    }
}
