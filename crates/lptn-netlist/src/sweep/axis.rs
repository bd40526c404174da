//! The axes of a sweep: a range, a list of values or a column of a file for each parameter.

use lptn_data::{Diagnostic, PlacedNumbers, Span};
use lptn_network::Value;
use lptn_units::Type;

use crate::fields::{Fields, Owner, wrong_shape};
use crate::listed::Names;
use crate::place::{Given, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::reading::all;
use crate::sweep::declaration::{AXIS, SCALES};
use crate::sweep::{SweepAxis, SweepMethod};
use crate::work::Elaboration;

/// The values of a parameter before they are evaluated: `--set` may change their parameters.
#[derive(Clone, Debug)]
pub(crate) enum AxisValues {
    /// From one value to another.
    Range {
        ends: [Value; 2],
        /// Number of values, both ends included; 0 if samples are taken from it.
        points: u64,
        /// True if their ratios are equal.
        log: bool,
        span: Span,
    },
    /// These, with the place of the list.
    List(Vec<Value>, Span),
    /// Those of a column.
    Column(PlacedNumbers),
}

impl<'a> Elaboration<'a> {
    /// `axes = { p = { from = …, to = …, points = 10 }, q = ["1 W", "2 W"] }`.
    pub(super) fn sweep_axes(
        &mut self,
        fields: &Fields<'a>,
        method: SweepMethod,
    ) -> Option<Vec<SweepAxis>> {
        let wanted = "a table of parameters";
        let names = self.listed(fields, "axes", Names::Table(wanted, wanted))?;
        let axes = names.into_iter().filter_map(|one| one.entry);
        all(axes.map(|entry| self.sweep_axis(fields, entry, method)))
    }

    fn sweep_axis(
        &mut self,
        fields: &Fields<'a>,
        entry: &'a RawEntry,
        method: SweepMethod,
    ) -> Option<SweepAxis> {
        let owner = fields.owner.inside("axes").inside(&entry.key);
        let ty = self.axis_type(fields, &entry.key, &entry.key_span);
        let values = match &entry.value.kind {
            RawKind::Array(items) if !method.is_sampled() => {
                self.axis_list(&owner, (items, &entry.value), ty?)
            }
            RawKind::Table(_) => self.axis_range(owner, entry, (ty, method)),
            _ => {
                let (wanted, example) = match method.is_sampled() {
                    true => ("a range", "{ from = \"1 W/K\", to = \"10 W/K\" }"),
                    false => ("a range or a list of values", AXIS.example),
                };
                let sample = format!("{} = {example}", entry.key);
                self.report(wrong_shape(&owner.words(), &entry.value, wanted, &sample));
                None
            }
        };
        ty?;
        Some(SweepAxis { name: entry.key.clone(), span: entry.key_span.clone(), values: values? })
    }

    /// The type of a parameter that an axis names.
    pub(super) fn axis_type(
        &mut self,
        fields: &Fields<'a>,
        name: &str,
        place: &Span,
    ) -> Option<Type> {
        if let Some(given) = self.gears.list.iter().find_map(|gearbox| gearbox.given_for(name)) {
            let message = format!(
                "{} names `{name}`, which follows from other values of its gearbox",
                fields.owner.field("axes")
            );
            self.refuse("netlist::gear_follows", message, place, format!("vary {given}"));
            return None;
        }
        if !self.is_parameter_here(&fields.owner.field("axes"), name, place)
            || self.names.has_failed(name)
        {
            return None;
        }
        self.type_here(name)
    }

    fn axis_list(
        &mut self,
        owner: &Owner<'_>,
        (items, raw): (&'a [RawValue], &'a RawValue),
        ty: Type,
    ) -> Option<AxisValues> {
        if items.is_empty() {
            let message = format!("{} is an empty list", owner.words());
            self.refuse("netlist::sweep_empty", message, &raw.span, "give it at least one value");
            return None;
        }
        let wanted = Wanted::like(ty);
        let values = all(items
            .iter()
            .map(|item| self.given_inside(owner, ("value", item), wanted).map(Given::value)));
        Some(AxisValues::List(values?, raw.span.clone()))
    }

    fn axis_range(
        &mut self,
        owner: Owner<'a>,
        entry: &'a RawEntry,
        (ty, method): (Option<Type>, SweepMethod),
    ) -> Option<AxisValues> {
        let range = self.inner(&AXIS, owner, entry)?;
        let points = self.axis_points(&range, method);
        let log = self.choice(&range, "scale", &SCALES);
        let ty = ty?;
        let ends = self.both_ends(&range, ty, None)?;
        Some(AxisValues::Range { ends, points: points?, log: log?, span: entry.value.span.clone() })
    }

    /// Number of values of a range: `points`, or one more than `steps`.
    fn axis_points(&mut self, range: &Fields<'a>, method: SweepMethod) -> Option<u64> {
        let keys = ["points", "steps"].into_iter().filter(|key| range.get(key).is_some());
        let given: Vec<&str> = keys.collect();
        if method.is_sampled() {
            let why = format!("has no effect if samples are taken: `{}`", method.word());
            self.refuse_keys(range, &given, &why);
            return given.is_empty().then_some(0);
        }
        let [key] = given.as_slice() else {
            if range.complete {
                let has = if given.is_empty() { "neither" } else { "both" };
                let and = if given.is_empty() { "nor" } else { "and" };
                let message = format!("{} has {has} `points` {and} `steps`", range.owner.words());
                self.report(Diagnostic::wrong(
                    "netlist::sweep_points",
                    message,
                    range.place,
                    "give the number of values, for example `points = 10`",
                ));
            }
            return None;
        };
        let least = if *key == "points" { 2 } else { 1 };
        let number = self.whole(range, key, least)?;
        Some(if *key == "points" { number } else { number + 1 })
    }

    /// A whole number of at least `least`.
    pub(super) fn whole(&mut self, fields: &Fields<'a>, key: &str, least: u64) -> Option<u64> {
        let raw = fields.get(key)?;
        let RawKind::Integer(text) = &raw.kind else {
            self.report(fields.wrong_shape(key, raw, "a whole number"));
            return None;
        };
        let number = text.replace('_', "").parse::<i128>().ok();
        match number.and_then(|number| u64::try_from(number).ok()) {
            Some(number) if number >= least && i64::try_from(number).is_ok() => Some(number),
            _ => {
                let message =
                    format!("{} has to be at least {least}, got {text}", fields.owner.field(key));
                let help = format!("write for example `{}`", fields.sample(key));
                self.refuse("netlist::sweep_count", message, &raw.span, help);
                None
            }
        }
    }
}
