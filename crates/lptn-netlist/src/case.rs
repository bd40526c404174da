//! `[case.NAME]`: parameters and time histories of signals that are set together: a hot day, a
//! cold start, a drive cycle.
//!
//! A load case is `--set` by name. Commands apply it before the values of the command line, and the
//! manifest lists both together. Sizing judges all cases, with one margin for each requirement in
//! each. A signal of a case is read as one of `[signal]`, with the type that it has there.

use lptn_data::{Diagnostic, Span};
use lptn_network::{BuildErrors, Course, Network, ParameterId, Signal, SignalId, Value};
use lptn_units::EvalError;

use crate::course_text::course;
use crate::csv_files::CASES;
use crate::fields::{Fields, Owner};
use crate::format::{Role, SectionDeclaration, Takes, shaped};
use crate::listed::Listed;
use crate::place::{Place, Wanted};
use crate::raw::{RawEntry, RawKind};
use crate::reading::all;
use crate::run::RunPlan;
use crate::section::SIGNAL;
use crate::study::{PathFrom, Study, type_of};
use crate::toml_text::{TomlFields, key as toml_key, like};
use crate::work::Elaboration;

pub(crate) const CASE: SectionDeclaration = SectionDeclaration {
    name: CASES,
    sentence: "A load case: parameters and signals that are set together, such as a hot day or a \
               drive cycle.",
    role: Role::Study,
    keys: &[
        shaped(
            "set",
            "table of parameters",
            Takes::Each(&Takes::Like),
            "their values in this case",
            "{ p = \"1 W/K\" }",
        ),
        shaped(
            "signal",
            "table of signals",
            Takes::Each(&Takes::Either(&[Takes::Like, Takes::Table(&SIGNAL)])),
            "their time histories in this case, as in `[signal]`, or a constant value",
            "{ speed = { t = [\"0 s\", \"60 s\"], v = [\"0 rpm\", \"3000 rpm\"] } }",
        ),
    ],
    either: &[&["set", "signal"]],
    example: "{ set = { p = \"1 W/K\" } }",
    elsewhere: &[
        ("param", "the parameters of a case are `set`"),
        ("parameters", "the parameters of a case are `set`"),
        ("signals", "the signals of a case are `signal`"),
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
    /// The parameters with their values, in file order.
    set: Vec<(String, Value)>,
    /// The signals with their time histories, in file order.
    signals: Vec<CaseSignal>,
}

/// The time history of a signal in a case.
#[derive(Clone, Debug)]
struct CaseSignal {
    name: String,
    course: Course,
    span: Span,
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

    /// The time histories of the signals that it sets, for the signals of `network`.
    pub fn courses(&self, network: &Network) -> Vec<(SignalId, Course)> {
        let known = |own: &CaseSignal| Some((network.signal(&own.name)?, own.course.clone()));
        self.signals.iter().filter_map(known).collect()
    }

    /// The names of the signals that it sets.
    pub fn signals(&self) -> impl Iterator<Item = &str> {
        self.signals.iter().map(|own| own.name.as_str())
    }

    /// A network with these values of its parameters, and the signals of this case.
    pub(crate) fn network(
        &self,
        network: &Network,
        values: &[(ParameterId, f64)],
    ) -> Result<Network, BuildErrors> {
        let mut parameters = network.given();
        values.iter().for_each(|(id, value)| parameters.set(*id, *value));
        self.with_signals(&network.with(&parameters)?)
    }

    /// A network with the signals of this case; its parameters keep their values.
    ///
    /// # Errors
    /// The problems of the new numbers.
    pub fn with_signals(&self, network: &Network) -> Result<Network, BuildErrors> {
        match self.signals.as_slice() {
            [] => Ok(network.clone()),
            _ => network.recorded(&self.courses(network), &[]),
        }
    }

    /// Places a problem of the network in this case: at the signal that it is about, or here.
    pub(crate) fn problem(&self, problem: Diagnostic) -> Diagnostic {
        let about = |own: &&CaseSignal| problem.message.contains(&format!("`{}`", own.name));
        let span = self.signals.iter().find(about).map_or(&self.span, |own| &own.span).clone();
        let message = format!("case `{}`: {}", self.name, problem.message);
        Diagnostic::error(problem.code, message).at(span, "").help(problem.help)
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

/// The problems of a run with the signals of each case, which may end before it.
pub(crate) fn runs(cases: &[CaseStudy], (network, plan): (&Network, &RunPlan)) -> Vec<Diagnostic> {
    let of = |case: &CaseStudy| {
        let values = case.values(network).unwrap_or_default();
        let found = case.network(network, &values).map(|network| plan.settings(&network).err());
        let found = found.ok().flatten().unwrap_or_default();
        found.into_iter().map(|problem| case.problem(problem)).collect::<Vec<_>>()
    };
    cases.iter().filter(|case| !case.signals.is_empty()).flat_map(of).collect()
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
        match self.network(network, &values) {
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
        let signal = |own: &CaseSignal| {
            let base = network.signal(&own.name).map(|id| network.signals()[id.index()].clone());
            let signal = base.map(|base| Signal { course: own.course.clone(), ..base });
            Some(format!("{} = {}", toml_key(&own.name), course(&signal?)))
        };
        fields.table("signal", self.signals.iter().filter_map(signal));
        fields
    }
}

impl<'a> Elaboration<'a> {
    fn case(&mut self, entry: &'a RawEntry) -> Option<CaseStudy> {
        let fields = self.fields(&CASE, entry)?;
        let (set, signals) = (fields.entry("set"), fields.entry("signal"));
        if set.is_none() && signals.is_none() {
            self.require(&fields, "set")?;
        }
        let empty = |raw: &RawEntry| matches!(&raw.value.kind, RawKind::Table(table) if table.entries.is_empty());
        if let Some(one) = set.into_iter().chain(signals).find(|one| empty(one)) {
            let wanted =
                if one.key == "set" { "a table with a parameter" } else { "a table with a signal" };
            self.report(fields.wrong_shape(&one.key, &one.value, wanted));
            return None;
        }
        let mut values = Vec::new();
        let owner = fields.owner.inside("set");
        let sound = set.is_none_or(|set| self.parameters_set(&owner, set, &mut values));
        let signals = match signals {
            Some(_) => self.case_signals(&fields),
            None => Some(Vec::new()),
        };
        let (name, span) = (entry.key.clone(), entry.key_span.clone());
        sound.then_some(CaseStudy { name, span, set: values, signals: signals? })
    }

    fn case_signals(&mut self, fields: &Fields<'a>) -> Option<Vec<CaseSignal>> {
        let table = self.table_of(fields, ("signal", "a table of signals"))?;
        all(table.entries.iter().map(|entry| self.case_signal(fields, entry)))
    }

    fn case_signal(&mut self, fields: &Fields<'a>, entry: &'a RawEntry) -> Option<CaseSignal> {
        let (case, name) = (&fields.owner, entry.key.as_str());
        let known = self.builder.signals().find(|(own, _)| *own == name).map(|(_, ty)| ty);
        let Some(ty) = known.filter(|_| !self.names.has_failed(name)) else {
            if known.is_none() && !self.names.has_failed(name) {
                let problem = self.no_signal(case, entry);
                self.report(problem);
            }
            return None;
        };
        let owner = case.inside("signal");
        let owner = owner.inside(name);
        let course = match &entry.value.kind {
            RawKind::Table(_) => {
                let inner = self.inner(&SIGNAL, owner, entry)?;
                let course = self.course(&inner, Some(ty))?.2;
                if !course.is_covered() {
                    let message = format!(
                        "the period of {} is shorter than its points reach",
                        inner.owner.words()
                    );
                    let help = "write a longer `period`, or leave it out";
                    self.refuse("network::period_too_short", message, &entry.value.span, help);
                    return None;
                }
                course
            }
            _ => {
                let place = Place { owner: &owner, key: "", raw: &entry.value };
                Course::Expression(self.given(place, Wanted::constant(ty))?.value())
            }
        };
        Some(CaseSignal { name: name.to_owned(), course, span: entry.key_span.clone() })
    }

    fn no_signal(&self, case: &Owner<'_>, entry: &RawEntry) -> Diagnostic {
        let name = entry.key.as_str();
        let message =
            format!("{} sets `{name}`, but there is no signal of this name", case.words());
        let problem = Diagnostic::error("netlist::unknown_signal", message);
        let problem = problem.at(entry.key_span.clone(), "no such signal");
        if self.names.is_parameter(name) {
            return problem.help(format!("`{name}` is a parameter: write it in `set`"));
        }
        let known: Vec<&str> = self.builder.signals().map(|(name, _)| name).collect();
        let help = || match known.is_empty() {
            true => format!(
                "add it for the run without a case:\n\n[signal]\n{name} = {{ t = [\"0 s\", \"60 s\"], v = [\"..\", \"..\"] }}"
            ),
            false => format!("the signals are {}", lptn_data::list(&known)),
        };
        problem.did_you_mean(name, known.iter().copied(), help)
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
        varied: &[&String],
    ) -> Option<()> {
        let counts = |entry: &&RawEntry| cases.is_none_or(|names| names.contains(&entry.key));
        for entry in self.elements(CASE.name).iter().filter(counts) {
            let RawKind::Table(table) = &entry.value.kind else { continue };
            let Some(RawKind::Table(set)) = table.get("set").map(|set| &set.value.kind) else {
                continue;
            };
            if let Some(one) = set.entries.iter().find(|one| varied.contains(&&one.key)) {
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
