//! `[case.NAME]`: parameters that are set together, a hot day or a cold start.
//!
//! A load case is `--set` by name. Commands apply it before the values of the command line, and the
//! manifest lists both together. Sizing judges all cases, with one margin for each requirement in
//! each.

use lptn_data::{Diagnostic, Span};
use lptn_network::{Network, ParameterId, Value};
use lptn_units::EvalError;

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, Takes, shaped};
use crate::listed::Listed;
use crate::raw::{RawEntry, RawKind};
use crate::study::{PathFrom, Study, type_of};
use crate::toml_text::{TomlFields, key as toml_key, like};
use crate::work::Elaboration;

pub(crate) const CASE: SectionDeclaration = SectionDeclaration {
    name: "case",
    sentence: "A load case: parameters that are set together, a hot day or a cold start.",
    role: Role::Study,
    keys: &[shaped(
        "set",
        "table of parameters",
        Takes::Each(&Takes::Like),
        "their values in this case",
        "{ p = \"1 W/K\" }",
    )
    .needed()],
    example: "{ set = { p = \"1 W/K\" } }",
    elsewhere: &[
        ("param", "the parameters of a case are `set`"),
        ("parameters", "the parameters of a case are `set`"),
    ],
    ..SectionDeclaration::NEW
};

/// One `[case.NAME]`.
#[derive(Clone, Debug)]
pub struct CaseStudy {
    /// Its name.
    pub name: String,
    /// Its place.
    pub span: Span,
    /// The parameters with their values, in file order; at least one.
    set: Vec<(String, Value)>,
}

impl CaseStudy {
    /// The parameters with their values in SI units, for the parameters of `network`.
    ///
    /// # Errors
    /// The error of the evaluation of a value.
    pub fn values(&self, network: &Network) -> Result<Vec<(ParameterId, f64)>, EvalError> {
        let mut scope = network.evaluation();
        let known = self
            .set
            .iter()
            .filter_map(|(name, value)| Some((network.parameter(name).ok()?, value)));
        known.map(|(id, value)| Ok((id, value.at(&mut scope)?))).collect()
    }

    /// Its parameters and values, as they are written for `--set`.
    ///
    /// # Errors
    /// As [`CaseStudy::values`].
    pub fn assignments(&self, network: &Network) -> Result<Vec<String>, EvalError> {
        let text = |(id, value): (ParameterId, f64)| {
            let parameter = &network.parameters()[id.index()];
            let value = like(&Value::Constant(value), parameter.ty);
            format!("{}={}", parameter.name, value.trim_matches('"'))
        };
        Ok(self.values(network)?.into_iter().map(text).collect())
    }
}

impl Study for CaseStudy {
    const SECTION: &'static SectionDeclaration = &CASE;

    fn one<'a>(work: &mut Elaboration<'a>, entry: &'a RawEntry) -> Option<Self> {
        work.case(entry)
    }

    fn name(&self) -> &str {
        &self.name
    }

    /// Checks that there is a network in this case.
    fn check(&self, network: &Network) -> Vec<Diagnostic> {
        let problem = |code, message: String| {
            vec![
                Diagnostic::error(code, format!("case `{}`: {message}", self.name))
                    .at(self.span.clone(), ""),
            ]
        };
        let values = match self.values(network) {
            Ok(values) => values,
            Err(error) => return problem(error.code(), error.to_string()),
        };
        let mut parameters = network.given();
        values.iter().for_each(|(id, value)| parameters.set(*id, *value));
        match network.with(&parameters) {
            Ok(_) => Vec::new(),
            Err(errors) => {
                errors.0.iter().take(1).flat_map(|e| problem(e.code(), e.to_string())).collect()
            }
        }
    }

    fn fields(&self, network: &Network, _: &PathFrom<'_>) -> TomlFields {
        let one = |(name, value): &(String, Value)| {
            format!("{} = {}", toml_key(name), like(value, type_of(network, name)))
        };
        let mut fields = TomlFields::default();
        fields.table("set", self.set.iter().map(one));
        fields
    }
}

impl<'a> Elaboration<'a> {
    fn case(&mut self, entry: &'a RawEntry) -> Option<CaseStudy> {
        let fields = self.fields(&CASE, entry)?;
        let raw = self.require(&fields, "set")?;
        let set = fields.entry("set")?;
        if matches!(&raw.kind, RawKind::Table(table) if table.entries.is_empty()) {
            self.report(fields.wrong_shape("set", raw, "a table with a parameter"));
            return None;
        }
        let mut values = Vec::new();
        let sound = self.parameters_set(&fields.owner.inside("set"), set, &mut values);
        sound.then(|| CaseStudy {
            name: entry.key.clone(),
            span: entry.key_span.clone(),
            set: values,
        })
    }

    /// The cases in which a size has to meet its requirements; default: all.
    pub(crate) fn cases_of(&mut self, fields: &Fields<'a>) -> Option<Option<Vec<String>>> {
        let Some(listed) = self.listed_if_any(fields, ("cases", "a list of names"))? else {
            return Some(None);
        };
        let known: Vec<&str> =
            self.elements(CASE.name).iter().map(|entry| entry.key.as_str()).collect();
        let mut names = Vec::new();
        for Listed { name, span, .. } in listed {
            if !known.contains(&name) {
                let message = format!(
                    "{} names `{name}`, but there is no [case.{name}]",
                    fields.owner.field("cases")
                );
                let problem = Diagnostic::error("netlist::unknown_case", message);
                let problem = problem.at(span.clone(), "no such case");
                let help = || match known.is_empty() {
                    true => format!("add for example:\n\n[case.{name}]\nset = {{ p = \"..\" }}"),
                    false => format!("the cases are {}", lptn_data::list(&known)),
                };
                let problem = problem.did_you_mean(name, known.iter().copied(), help);
                self.report(problem);
                return None;
            }
            names.push(name.to_owned());
        }
        Some(Some(names))
    }

    /// A case cannot set a parameter that a study varies.
    pub(crate) fn set_by_cases(
        &mut self,
        (fields, cases): (&Fields<'a>, Option<&[String]>),
        sought: &[&String],
    ) -> Option<()> {
        let counts = |entry: &&RawEntry| cases.is_none_or(|names| names.contains(&entry.key));
        for entry in self.elements(CASE.name).iter().filter(counts) {
            let RawKind::Table(table) = &entry.value.kind else { continue };
            let Some(RawKind::Table(set)) = table.get("set").map(|set| &set.value.kind) else {
                continue;
            };
            if let Some(one) = set.entries.iter().find(|one| sought.contains(&&one.key)) {
                let message = format!(
                    "{} varies `{}`, which case `{}` sets",
                    fields.owner.words(),
                    one.key,
                    entry.key
                );
                let problem = Diagnostic::error("netlist::case_sets_sought", message)
                    .at(one.key_span.clone(), "set here")
                    .also(fields.place.clone(), "varied here");
                let help = "leave it out of the case, or name the other cases in `cases`";
                self.report(problem.help(help));
                return None;
            }
        }
        Some(())
    }
}
