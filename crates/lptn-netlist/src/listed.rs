//! Parameters and other names that a key of a study lists: `vary`, `axes`, `find`, `know`, `only`.
//!
//! They have one form: a list of names, or a table of names. In a table each name has a value, a
//! list of values, or a range with its ends `from` and `to`.

use lptn_data::Span;
use lptn_network::{Context, Value};
use lptn_units::{Scope as _, Type, Unit, format_number};

use crate::fields::Fields;
use crate::place::Wanted;
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::value_help::number_and_unit;
use crate::work::Elaboration;

/// Factors from the value of a parameter to the ends of a range in help, and the range of a
/// temperature to both sides in K.
const FACTORS: [f64; 2] = [0.1, 10.0];
const AROUND: f64 = 20.0;

/// A name that a key lists.
#[derive(Clone, Copy)]
pub(crate) struct Listed<'a> {
    pub(crate) name: &'a str,
    pub(crate) span: &'a Span,
    /// Its entry in a table.
    pub(crate) entry: Option<&'a RawEntry>,
}

/// The form in which names are listed, and a description of it.
pub(crate) enum Names<'w> {
    /// A list.
    List(&'w str),
    /// A table; the second words describe an empty one.
    Table(&'w str, &'w str),
    /// Either, with at least one name.
    Either(&'w str),
}

impl<'a> Elaboration<'a> {
    /// The names that a key lists, which is required; errors are reported.
    pub(crate) fn listed(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        names: Names<'_>,
    ) -> Option<Vec<Listed<'a>>> {
        let raw = self.require(fields, key)?;
        let (Names::List(wanted) | Names::Table(wanted, _) | Names::Either(wanted)) = names;
        let wanted = match (&raw.kind, &names) {
            (RawKind::Table(table), Names::Table(..) | Names::Either(_))
                if !table.entries.is_empty() =>
            {
                let listed = |entry: &'a RawEntry| Listed {
                    name: &entry.key,
                    span: &entry.key_span,
                    entry: Some(entry),
                };
                return Some(table.entries.iter().map(listed).collect());
            }
            (RawKind::Array(list), Names::List(_)) if list.is_empty() => return Some(Vec::new()),
            (RawKind::Array(list), Names::List(_) | Names::Either(_)) if !list.is_empty() => {
                let name = |raw| {
                    let name = fields.text(key, raw, &mut self.problems)?;
                    Some(Listed { name, span: &raw.span, entry: None })
                };
                let all: Vec<Option<Listed<'a>>> = list.iter().map(name).collect();
                return all.into_iter().collect();
            }
            (RawKind::Table(_), Names::Table(_, empty)) => empty,
            _ => wanted,
        };
        let problem = fields.wrong_shape(key, raw, wanted);
        let ranges = match &raw.kind {
            RawKind::Array(list) if fields.sample(key).contains("from = ") => self.ranges(list),
            _ => None,
        };
        self.report(match ranges {
            Some(ranges) => problem.help(format!("write it like this: `{key} = {ranges}`")),
            None => problem,
        });
        None
    }

    /// Ranges around the values of parameters that a list names.
    fn ranges(&self, list: &[RawValue]) -> Option<String> {
        let range = |named: &RawValue| {
            let RawKind::String { text: name, .. } = &named.kind else { return None };
            let entry = self.raw.section("param")?.get(name)?;
            let RawKind::String { text, .. } = &entry.value.kind else { return None };
            let (number, unit) = number_and_unit(text)?;
            let [from, to] = match Unit::parse(unit).is_ok_and(|unit| unit.ty.absolute) {
                true => [number - AROUND, number + AROUND],
                false => FACTORS.map(|factor| number * factor),
            };
            let [from, to] = [from, to].map(|end| format!("\"{} {unit}\"", format_number(end)));
            Some(format!("{name} = {{ from = {from}, to = {to} }}"))
        };
        let all: Option<Vec<String>> = list.iter().map(range).collect();
        all.filter(|all| !all.is_empty()).map(|all| format!("{{ {} }}", all.join(", ")))
    }

    /// The same for a key that may be left out, or has at least one name.
    pub(crate) fn listed_if_any(
        &mut self,
        fields: &Fields<'a>,
        (key, wanted): (&str, &str),
    ) -> Option<Option<Vec<Listed<'a>>>> {
        let Some(raw) = fields.get(key) else { return Some(None) };
        let names = self.listed(fields, key, Names::List(wanted))?;
        if names.is_empty() {
            self.report(fields.wrong_shape(key, raw, wanted));
            return None;
        }
        Some(Some(names))
    }

    /// The type of a parameter or signal that is known.
    pub(crate) fn type_here(&self, name: &str) -> Option<Type> {
        self.builder.scope(Context::Time).symbol(name).map(|symbol| symbol.ty)
    }

    /// The ends of the range of a parameter of this type, as far as given; `None` if one is wrong.
    pub(crate) fn ends(&mut self, range: &Fields<'a>, ty: Type) -> Option<[Option<Value>; 2]> {
        let ends = ["from", "to"].map(|key| match range.get(key) {
            None => Some(None),
            Some(raw) => self.exactly_inside(&range.owner, (key, raw), Wanted::like(ty)).map(Some),
        });
        let [from, to] = ends;
        Some([from?, to?])
    }

    /// The same if both are required; the help shows how, unless it is the usual one.
    pub(crate) fn both_ends(
        &mut self,
        range: &Fields<'a>,
        ty: Type,
        help: Option<&str>,
    ) -> Option<[Value; 2]> {
        let ends = self.ends(range, ty);
        for key in ["from", "to"].into_iter().filter(|key| range.get(key).is_none()) {
            if range.complete {
                let message = format!("{} has no `{key}`", range.owner.words());
                let problem = range.missing(key, message);
                self.report(match help {
                    Some(help) => problem.help(help),
                    None => problem,
                });
            }
        }
        let [from, to] = ends?;
        Some([from?, to?])
    }
}
