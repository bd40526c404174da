//! `catalogue` of `[size.NAME]`: real parts, one a row, with the parameters that each sets.

use std::sync::Arc;

use lptn_data::{
    Asked, CsvFile, CsvOptions, CsvText, Diagnostic, Files, PlacedNumbers, Rejected, Span,
};
use lptn_network::Context;
use lptn_units::{Scope as _, Type, Unit, suggest};

use crate::csv_form::FILE;
use crate::fields::Fields;
use crate::names::ValueKind;
use crate::netlist::Netlist;
use crate::raw::RawValue;
use crate::work::Elaboration;

/// The column of the names of the parts, which is required.
const PART: &str = "part";

/// Name of the text of `--parts` in diagnostics.
const PARTS: &str = "--parts";

/// Columns for readers.
const FOR_PEOPLE: [&str; 4] = ["maker", "source", "note", "url"];

/// Parts to choose from.
#[derive(Clone, Debug)]
pub struct Catalogue {
    /// The file, as the netlist names it.
    pub csv: String,
    /// The place of its name.
    pub span: Span,
    /// Statements about its form.
    pub(super) options: CsvOptions,
    /// The note about a file that is not in lptn's own form.
    pub note: Option<Diagnostic>,
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
    /// The unit in which the file gives it.
    pub unit: Unit,
    /// The value of each part in SI units.
    pub values: Vec<f64>,
    /// The place of the header of the column.
    pub span: Span,
}

/// The type of the parameter that a column is named after; the problem if there is none, unless it
/// was reported before.
type TypeOf<'a> = dyn FnMut(&str, &Span) -> Result<Type, Option<Diagnostic>> + 'a;

impl Catalogue {
    /// Reads the file that a place names.
    fn read(
        (csv, options): (&str, &CsvOptions),
        (text, span): (&CsvText, &Span),
        ty: &mut TypeOf<'_>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let file = CsvFile::open(text, span, options).map_err(|problem| vec![problem])?;
        let (file, options) = (Arc::new(file), options.clone());
        let asked = Asked { words: String::new(), span: Some(span.clone()) };
        let mut problems = Vec::new();
        let parts = file.words(PART, &asked);
        let parts = parts.unwrap_or_else(|found| {
            problems.extend(found);
            Vec::new()
        });
        let of_numbers =
            file.names().filter(|(name, _)| *name != PART && !FOR_PEOPLE.contains(name));
        let (mut columns, mut complete) = (Vec::new(), true);
        for (name, place) in of_numbers {
            let read = ty(name, place).map_err(|problem| problem.into_iter().collect());
            match read.and_then(|ty| file.column(name, Some(ty), &asked)) {
                Ok(PlacedNumbers { unit: Some(unit), numbers: values, .. }) => {
                    let (name, span) = (name.to_owned(), place.clone());
                    columns.push(CatalogueColumn { name, unit, values, span });
                }
                Ok(_) => complete = false,
                Err(found) => {
                    problems.extend(found);
                    complete = false;
                }
            }
        }
        if complete && columns.is_empty() {
            let message = format!("no column of {csv} is a parameter, so its parts are all alike");
            let help = "name the columns after the parameters that a part sets: `R_sink [K/W]`";
            problems.push(Diagnostic::wrong(
                "netlist::size_catalogue",
                message,
                file.header(),
                help,
            ));
        }
        if !problems.is_empty() || !complete {
            return Err(problems);
        }
        let (csv, span, note) = (csv.to_owned(), span.clone(), file.note(None));
        Ok(Self { csv, span, options, note, parts, columns })
    }

    /// The assignments for `--set` that choose a part, by its position.
    pub fn assignments(&self, part: usize) -> Vec<String> {
        let text = |column: &CatalogueColumn| {
            let (value, ty) = (column.values[part], column.unit.ty);
            let unit = ty.dimension.si_unit();
            match (ty.absolute, unit.as_str()) {
                (true, _) => format!("{}=absolute({value} [K])", column.name),
                (false, "1" | "") => format!("{}={value}", column.name),
                (false, unit) => format!("{}={value} {unit}", column.name),
            }
        };
        self.columns.iter().map(text).collect()
    }
}

impl Netlist {
    /// Parts for this netlist: a table as `catalogue` of `[size.NAME]` names one, whose columns are
    /// parameters; `options` says how it is written.
    ///
    /// # Errors
    /// [`Rejected`] with every error of the table.
    pub fn parts(
        &self,
        (name, bytes): (&str, &[u8]),
        options: &CsvOptions,
    ) -> Result<(Catalogue, Files), Rejected> {
        let mut files = self.files.clone();
        let option = files.add(PARTS, name);
        let asked = Span::new(option, 0..name.len());
        let network = &self.network;
        let mut ty = |name: &str, place: &Span| {
            let known = || network.parameters().iter().map(|parameter| parameter.name.as_str());
            match network.parameter(name) {
                Ok(id) => Ok(network.parameters()[id.index()].ty),
                Err(_) => Err(Some(no_parameter((name, place), known()))),
            }
        };
        let read = CsvText::of(&mut files, name.to_owned(), bytes).map_err(|problem| vec![problem]);
        let form = (name, options);
        let read = read.and_then(|text| Catalogue::read(form, (&text, &asked), &mut ty));
        match read {
            Ok(catalogue) => Ok((catalogue, files)),
            Err(problems) => Err(Rejected::arranged(files, problems, 0)),
        }
    }
}

/// Error for a column that is not named after one of these parameters.
fn no_parameter<'n>(
    (name, place): (&str, &Span),
    known: impl Iterator<Item = &'n str>,
) -> Diagnostic {
    let message = format!("column `{name}` is not named after a parameter");
    let help = match suggest(name, known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!(
            "give it a value in [param], `{name} = ..`; columns for readers are `part`, `maker`, \
             `source`, `note` and `url`"
        ),
    };
    let problem = Diagnostic::error("netlist::unknown_parameter", message);
    problem.at(place.clone(), "unknown parameter").help(help)
}

impl<'a> Elaboration<'a> {
    /// The catalogues of a study; `None` if one is wrong, which is then reported.
    pub(super) fn catalogues(&mut self, fields: &Fields<'a>) -> Option<Vec<Catalogue>> {
        let Some(raw) = fields.get("catalogue") else { return Some(Vec::new()) };
        if raw.items().is_empty() {
            self.report(fields.wrong_shape("catalogue", raw, "a CSV file or a list of them"));
            return None;
        }
        let all: Vec<_> = raw.items().iter().map(|item| self.catalogue(fields, item)).collect();
        let all: Vec<Catalogue> = all.into_iter().collect::<Option<_>>()?;
        self.set_once(fields, &all)?;
        Some(all)
    }

    fn catalogue(&mut self, fields: &Fields<'a>, item: &'a RawValue) -> Option<Catalogue> {
        let named = self.formed_file(fields, ("catalogue", &FILE), item)?;
        let files: &'a crate::csv_files::CsvFiles = self.csv;
        let text = self.kept(files.text(named.raw)?.map_err(Diagnostic::clone))?;
        let mut ty = |name: &str, place: &Span| self.set_by_part(fields, name, place);
        let (form, place) = ((named.csv, &named.options), (text, &named.raw.span));
        match Catalogue::read(form, place, &mut ty) {
            Ok(catalogue) => {
                self.problems.extend(catalogue.note.clone());
                Some(catalogue)
            }
            Err(problems) => {
                self.problems.extend(problems.into_iter().map(|one| named.explained(one)));
                None
            }
        }
    }

    /// The type of the parameter that a column is named after.
    fn set_by_part(
        &mut self,
        fields: &Fields<'_>,
        name: &str,
        place: &Span,
    ) -> Result<Type, Option<Diagnostic>> {
        if self.names.is_parameter(name) {
            self.names.use_by_study(name);
            let known = self.builder.scope(Context::Time).symbol(name).map(|symbol| symbol.ty);
            return known.filter(|_| !self.names.has_failed(name)).ok_or(None);
        }
        let section = ValueKind::Parameter.section();
        let known = self.elements(section);
        let problem = no_parameter((name, place), known.iter().map(|entry| entry.key.as_str()));
        let named = fields.get("catalogue").map(|raw| raw.span.clone());
        Err(Some(problem.also(named, "read here")))
    }

    /// Refuses two catalogues that set one parameter.
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
