//! `catalogue` of `[size.NAME]`: real parts, one a row, with the parameters that each sets.

use lptn_data::{Asked, CsvFile, Diagnostic, Span};
use lptn_network::Context;
use lptn_units::{Scope as _, Unit, suggest};

use crate::fields::Fields;
use crate::names::ValueKind;
use crate::raw::{RawKind, RawNetlist, RawValue};
use crate::size::SIZE;
use crate::work::Elaboration;

/// The column of the names of the parts, which has to be there.
const PART: &str = "part";

/// Columns that are for people.
const FOR_PEOPLE: [&str; 4] = ["maker", "source", "note", "url"];

/// Parts to choose from.
#[derive(Clone, Debug)]
pub struct Catalogue {
    /// The file, as the netlist names it.
    pub csv: String,
    /// Where it is named.
    pub span: Span,
    /// The names of the parts, in file order; at least one, none twice.
    pub parts: Vec<String>,
    /// The parameters that a part sets.
    pub columns: Vec<CatalogueColumn>,
}

/// A parameter that parts set.
#[derive(Clone, Debug)]
pub struct CatalogueColumn {
    /// The name of the parameter.
    pub name: String,
    /// In which the file gives it.
    pub unit: Unit,
    /// The value of each part in SI units.
    pub values: Vec<f64>,
    /// Where the header of the column stands.
    pub span: Span,
}

/// The files of the catalogues of all studies.
pub(super) fn files(raw: &RawNetlist) -> Vec<(&str, &RawValue)> {
    let mut found = Vec::new();
    for size in raw.elements(SIZE.name) {
        let RawKind::Table(table) = &size.value.kind else { continue };
        found.extend(table.get("catalogue").into_iter().flat_map(|entry| named(&entry.value)));
    }
    found
}

/// The files that a value of `catalogue` names.
fn named(value: &RawValue) -> impl Iterator<Item = (&str, &RawValue)> {
    let items = match &value.kind {
        RawKind::Array(list) => list.as_slice(),
        _ => std::slice::from_ref(value),
    };
    items.iter().filter_map(|item| match &item.kind {
        RawKind::String { text, .. } => Some((text.as_str(), item)),
        _ => None,
    })
}

impl<'a> Elaboration<'a> {
    /// The catalogues of a study; `None` if something is wrong with one, which is then reported.
    pub(super) fn catalogues(&mut self, fields: &Fields<'a>) -> Option<Vec<Catalogue>> {
        let Some(raw) = fields.get("catalogue") else { return Some(Vec::new()) };
        let count = match &raw.kind {
            RawKind::Array(list) => list.len(),
            _ => 1,
        };
        let files: Vec<_> = named(raw).collect();
        if files.is_empty() || files.len() < count {
            self.report(fields.wrong_shape("catalogue", raw, "a CSV file or a list of them"));
            return None;
        }
        let all: Vec<_> = files.iter().map(|file| self.catalogue(fields, *file)).collect();
        let all: Vec<Catalogue> = all.into_iter().collect::<Option<_>>()?;
        self.set_once(fields, &all)?;
        Some(all)
    }

    fn catalogue(
        &mut self,
        fields: &Fields<'a>,
        (csv, raw): (&str, &'a RawValue),
    ) -> Option<Catalogue> {
        let files: &'a crate::csv_files::CsvFiles = self.csv;
        let text = self.kept(files.text(raw)?.map_err(Diagnostic::clone))?;
        let opened = CsvFile::open(text, &raw.span);
        let file = std::sync::Arc::new(self.kept(opened)?);
        let asked = Asked { words: String::new(), span: Some(raw.span.clone()) };
        let parts = match file.words(PART, &asked) {
            Ok(parts) => Some(parts),
            Err(problems) => {
                self.problems.extend(problems);
                None
            }
        };
        let names: Vec<(String, Span)> =
            file.names().map(|(name, place)| (name.to_owned(), place.clone())).collect();
        let of_numbers =
            names.iter().filter(|(name, _)| name != PART && !FOR_PEOPLE.contains(&name.as_str()));
        let columns: Vec<_> = of_numbers
            .map(|(name, place)| {
                let ty = self.set_by_part(fields, name, place)?;
                let read = file.column(name, Some(ty), &asked);
                let numbers = read.map_err(|problems| self.problems.extend(problems)).ok()?;
                let unit = numbers.unit?;
                Some(CatalogueColumn {
                    name: name.clone(),
                    unit,
                    values: numbers.numbers,
                    span: place.clone(),
                })
            })
            .collect();
        let columns: Vec<CatalogueColumn> = columns.into_iter().collect::<Option<_>>()?;
        if columns.is_empty() {
            let message = format!("no column of {csv} is a parameter, so its parts are all alike");
            let help = "name the columns after the parameters that a part sets: `R_sink [K/W]`";
            self.refuse("netlist::size_catalogue", message, file.header(), help);
            return None;
        }
        Some(Catalogue { csv: csv.to_owned(), span: raw.span.clone(), parts: parts?, columns })
    }

    /// The type of the parameter that a column is named after.
    fn set_by_part(
        &mut self,
        fields: &Fields<'_>,
        name: &str,
        place: &Span,
    ) -> Option<lptn_units::Type> {
        if self.names.is_parameter(name) {
            self.names.use_by_study(name);
            let known = self.builder.scope(Context::Time).symbol(name).map(|symbol| symbol.ty);
            return known.filter(|_| !self.names.has_failed(name));
        }
        let message = format!("column `{name}` is named after no parameter");
        let section = ValueKind::Parameter.section();
        let near = suggest(name, self.elements(section).iter().map(|entry| entry.key.as_str()));
        let help = match near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!(
                "give it a value in [param], `{name} = ..`; columns for people are `part`, \
                 `maker`, `source`, `note` and `url`"
            ),
        };
        let problem = Diagnostic::error("netlist::unknown_parameter", message);
        let named = fields.get("catalogue").map(|raw| raw.span.clone());
        self.report(
            problem.at(place.clone(), "unknown parameter").also(named, "read here").help(help),
        );
        None
    }

    /// Two catalogues cannot set one parameter.
    fn set_once(&mut self, fields: &Fields<'a>, all: &[Catalogue]) -> Option<()> {
        let mut known: Vec<&CatalogueColumn> = Vec::new();
        for column in all.iter().flat_map(|catalogue| &catalogue.columns) {
            if let Some(first) = known.iter().find(|other| other.name == column.name) {
                let words = fields.owner.field("catalogue");
                let message = format!("{words}: two files set `{}`", column.name);
                let problem = Diagnostic::error("netlist::size_catalogue", message)
                    .at(column.span.clone(), "set again")
                    .also(first.span.clone(), "set here first");
                let help =
                    "give each its own parameter, and use their sum or product in the element";
                self.report(problem.help(help));
                return None;
            }
            known.push(column);
        }
        Some(())
    }
}
