//! A report of a sweep about a candidate: a functional of the results.

use lptn_data::Span;
use lptn_network::{Functional, OverTime, Value};
use lptn_units::{Expression, Type};

use crate::functional::Taken;
use crate::place::{Given, Place, Text, Wanted};
use crate::raw::RawEntry;
use crate::sweep::SweepOver;
use crate::value::whole;
use crate::work::Elaboration;

/// A report about every candidate.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Its name, that of its column.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Its place.
    pub span: Span,
    /// The quantity that is followed. For a time above or below a level: the distance from it. For
    /// a life: the rate of ageing over that at the reference.
    pub of: Value,
    /// The type of the report.
    pub ty: Type,
    /// Its functional.
    pub over_time: OverTime,
}

impl Measure {
    /// Its functional.
    pub fn functional(&self) -> Functional {
        self.over_time.functional
    }

    /// True if it is a functional over time.
    pub fn is_over_time(&self) -> bool {
        self.functional() != Functional::Value
    }
}

const RESERVED: [&str; 6] = ["case", "limits", "worst_limit", "limit_margin", "outside", "failed"];

impl<'a> Elaboration<'a> {
    /// One entry of `report`.
    pub(super) fn measure(&mut self, entry: &'a RawEntry, over: SweepOver) -> Option<Measure> {
        let owner = crate::fields::Owner::element("report", &entry.key);
        let place = Place { owner: &owner, key: "", raw: &entry.value };
        if RESERVED.contains(&entry.key.as_str()) {
            let message = format!("`{}` is a column of every sweep", entry.key);
            let help = "give the report another name";
            self.refuse("netlist::report_name", message, &entry.key_span, help);
            return None;
        }
        let text = self.names.text(place, None);
        let text = self.kept(text)?;
        let (written, taken) = match text {
            Text::Quantity(quantity) => {
                let given = Given::Quantity(quantity);
                (String::new(), self.plain(given))
            }
            Text::Expression(expression) => {
                let taken = self.taken(place, &expression, over)?;
                (whole(&expression), taken)
            }
        };
        let (name, span) = (entry.key.clone(), entry.value.span.clone());
        let Taken { of: (of, _), ty, over_time } = taken;
        Some(Measure { name, text: written, span, of, ty, over_time })
    }

    fn plain(&self, given: Given) -> Taken {
        let ty = given.ty();
        let over_time = OverTime { functional: Functional::Value, of_ty: ty, life: None };
        Taken { of: (given.value(), ty), ty, over_time }
    }

    fn taken(&mut self, place: Place<'_>, whole: &Expression, over: SweepOver) -> Option<Taken> {
        let Some(called) = self.called(whole) else {
            return self.plain_of(place, whole, over);
        };
        if over == SweepOver::Steady {
            let inner = called.arguments.first().map_or("", |first| first.text().trim());
            let message = format!(
                "{} needs results over time, but a steady state is one \
                moment",
                place.words()
            );
            let help = format!(
                "write `{inner}`, which is its value there, or report `over = \"run\"` or `over = \
                 \"periodic\"`"
            );
            self.refuse("netlist::sweep_report", message, &place.raw.span, help);
            return None;
        }
        self.over_time(place, called)
    }

    /// An expression without a functional: its value in steady state. In a run it has to be the
    /// same all the time.
    fn plain_of(&mut self, place: Place<'_>, whole: &Expression, over: SweepOver) -> Option<Taken> {
        if over == SweepOver::Steady {
            let given =
                self.resolve(place, Text::Expression(whole.clone()), Wanted::of_results())?;
            return Some(self.plain(given));
        }
        let inner = whole.called().find(|call| self.functional_named(*call).is_some());
        let constant = |(name, _): &(String, _)| self.names.is_parameter(name);
        if inner.is_none() && whole.names().iter().all(constant) {
            let given =
                self.resolve(place, Text::Expression(whole.clone()), Wanted::parameter())?;
            return Some(self.plain(given));
        }
        let (message, help) = match inner {
            Some((name, _)) => (
                format!("{} has `{name}` inside of an expression", place.words()),
                format!("put it around the whole expression: `{name}(..)`"),
            ),
            None => (
                format!("{} varies over time: it needs a functional", place.words()),
                format!(
                    "write `max({0})`, `last({0})`, `mean({0})` or another functional around it",
                    whole.text().trim()
                ),
            ),
        };
        self.refuse("netlist::sweep_report", message, &place.raw.span, help);
        None
    }
}
