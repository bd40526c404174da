//! `[size.NAME]`: a parameter to size, and its requirements.

mod catalogue;
mod check;
mod read;

use lptn_data::{Diagnostic, Span};
use lptn_network::{
    Bound, Evaluation, Limit, LimitSeverity, Network, OverTime, ParameterId, Value,
};
use lptn_units::{EvalError, Type};

use crate::csv_form::{FORMED_FILES, written};
use crate::format::{
    Role, SectionDeclaration, Takes, akin, key, names, number, shaped, text, words, words_of,
};
use crate::raw::RawEntry;
use crate::setting::Setting;
use crate::study::{PathFrom, Study, type_of};
use crate::toml_text::{TomlFields, key as toml_key, like};
use crate::work::Elaboration;
pub use catalogue::{Catalogue, CatalogueColumn};

const SIZE: SectionDeclaration = SectionDeclaration {
    name: "size",
    sentence: "Parameters to size, or parts to choose: the best ones that keep every requirement.",
    role: Role::Study,
    keys: &[
        text(
            "minimise",
            "parameter, or expression of parameters and results",
            "the objective, if the least value is best",
            "\"name of a parameter\"",
        ),
        text(
            "maximise",
            "parameter, or expression of parameters and results",
            "the objective, if the largest value is best",
            "\"name of a parameter\"",
        ),
        shaped(
            "vary",
            "table",
            Takes::Each(&Takes::Table(&VARY)),
            "of each parameter its range, `from` and `to`",
            "{ p = { from = \"1 W/K\", to = \"10 W/K\" } }",
        ),
        names(
            "require",
            "list of comparisons of results",
            "the requirements",
            "[\"steel.T <= 80 [degC]\"]",
        )
        .needed(),
        words(
            "over",
            &words_of(&Over::WORDS),
            "when they are checked: in steady state, at every moment of [run], in the periodic \
             steady state",
            "\"run\"",
        )
        .or("`\"steady\"`"),
        key(
            "period",
            "s",
            "the length of a \
            cycle",
            "\"10 min\"",
        )
        .or("that of the repeated signals"),
        shaped(
            "catalogue",
            "file, or a list of files",
            FORMED_FILES,
            "parts to choose from, one a row, instead of `vary` or in addition to it",
            "\"parts.csv\"",
        ),
        number(
            "probability",
            "the probability with which each requirement is kept, by the `±` of parameters",
            "\"95 %\"",
        ),
        names("cases", "list of names", "the load cases that count", "[\"hot\"]")
            .or("all of [case]"),
    ],
    either: &[&["minimise", "maximise"], &["vary", "catalogue"]],
    example: "{ minimise = \"p\", vary = { p = { from = \"..\", to = \"..\" } }, require = [\"a.T \
        <= 80 [degC]\"] }",
    elsewhere: &[
        ("minimize", "did you mean `minimise`?"),
        ("maximize", "did you mean `maximise`?"),
        ("from", "write `vary = { p = { from = \"..\", to = \"..\" } }`"),
        ("to", "write `vary = { p = { from = \"..\", to = \"..\" } }`"),
    ],
    ..SectionDeclaration::NEW
};

/// `p = { from = …, to = … }` in `vary` of a size or fit.
pub(crate) const VARY: SectionDeclaration = SectionDeclaration {
    name: "vary",
    keys: &[
        akin("from", "as the parameter", "the least value", "\"1 W/K\""),
        akin("to", "as the parameter", "the largest value", "\"10 W/K\""),
    ],
    example: "{ from = \"1 W/K\", to = \"10 W/K\" }",
    elsewhere: &[
        ("min", "the least value is `from`"),
        ("lower", "the least value is `from`"),
        ("max", "the largest value is `to`"),
        ("upper", "the largest value is `to`"),
    ],
    ..SectionDeclaration::NEW
};

/// The better of several values that meet every requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// The least one.
    Minimise,
    /// The largest one.
    Maximise,
}

/// The objective of a size.
#[derive(Clone, Debug)]
pub struct Objective {
    /// Its text: `G_fan`, `P_fan + 2 [W/kg] * m`.
    pub text: String,
    /// The value; it reads parameters, and results if `of_results` is true.
    pub value: Value,
    /// True if it reads temperatures or heat flows, those of the steady state.
    pub of_results: bool,
    /// Its type.
    pub ty: Type,
}

/// A parameter with the least and the largest value that it may take, in SI units.
pub type RangeOf = (ParameterId, (f64, f64));

/// The range of a parameter.
#[derive(Clone, Debug)]
pub struct SizeRange {
    /// The name of the parameter.
    pub name: String,
    from: Value,
    to: Value,
    /// The place of its name.
    pub span: Span,
}

/// The results in which requirements have to be met.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Over {
    /// In steady state.
    #[default]
    Steady,
    /// At every moment of the `[run]`.
    Run,
    /// At every moment of the periodic steady state.
    Periodic,
}

impl Over {
    /// The words for them, the default first.
    pub const WORDS: [(&str, Self); 3] =
        [("steady", Self::Steady), ("run", Self::Run), ("periodic", Self::Periodic)];

    /// The word for it.
    pub fn word(self) -> &'static str {
        Self::WORDS.into_iter().find(|(_, over)| *over == self).map_or("", |(word, _)| word)
    }
}

/// A requirement: one expression may not exceed another.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// Its text, for example `steel.T <= 80 [degC]`.
    pub text: String,
    /// The type of both sides.
    pub ty: Type,
    low: Value,
    high: Value,
    /// The functionals over time of both sides, if they are compared instead of values at every
    /// moment.
    over_time: [Option<OverTime>; 2],
}

impl Requirement {
    /// Its margin at the state of `scope`: positive while it is met, in SI units, a difference in K
    /// for temperatures. `scope` needs the temperatures, see [`Evaluation::set_temperatures`].
    ///
    /// # Errors
    /// The error of the evaluation of a side.
    pub fn margin(&self, scope: &mut Evaluation) -> Result<f64, EvalError> {
        Ok(self.high.at(scope)? - self.low.at(scope)?)
    }

    /// True if it compares numbers over time instead of values at every moment.
    pub fn is_over_time(&self) -> bool {
        self.over_time.iter().any(Option::is_some)
    }

    /// Both sides.
    pub fn sides(&self) -> [&Value; 2] {
        [&self.low, &self.high]
    }

    /// The same as a limit, for [`Network::requiring`].
    pub fn limit(&self) -> Limit {
        Limit {
            name: self.text.clone(),
            of: self.low.clone(),
            ty: self.ty,
            bound: Bound::Below,
            value: self.high.clone(),
            compares: true,
            over_time: self.over_time.clone(),
            severity: LimitSeverity::Error,
            text: self.text.clone(),
        }
    }
}

/// One `[size.NAME]`.
#[derive(Clone, Debug)]
pub struct SizeStudy {
    /// Its name.
    pub name: String,
    /// The quantity that is minimised or maximised.
    pub objective: Objective,
    /// Minimum or maximum.
    pub goal: Goal,
    /// Its requirements; at least one.
    pub requirements: Vec<Requirement>,
    /// The results in which they are checked.
    pub over: Over,
    /// The period of the cycle, if given.
    pub(crate) period: Option<Setting>,
    /// The required probability of meeting the requirements, if given.
    pub(crate) probability: Option<Setting>,
    /// Its place.
    pub span: Span,
    /// The parameters to be sized; with catalogues, for each choice of parts.
    pub varied: Vec<SizeRange>,
    /// The load cases that each have to meet all requirements; `None` for all cases.
    pub cases: Option<Vec<String>>,
    /// The catalogues; one part is chosen from each.
    pub catalogues: Vec<Catalogue>,
}

impl SizeStudy {
    /// The parameter that is minimised or maximised, if nothing else is varied or chosen.
    pub fn single(&self) -> Option<&SizeRange> {
        match self.varied.as_slice() {
            [one] if self.catalogues.is_empty() && one.name == self.objective.text => Some(one),
            _ => None,
        }
    }

    /// The least and the largest value each parameter may take, in SI units, for the parameters of
    /// `network`.
    ///
    /// # Errors
    /// The error of the evaluation of an end.
    pub fn ranges(&self, network: &Network) -> Result<Vec<RangeOf>, EvalError> {
        let mut scope = network.evaluation();
        let known =
            self.varied.iter().filter_map(|one| Some((one, network.parameter(&one.name).ok()?)));
        known
            .map(|(one, id)| Ok((id, (one.from.at(&mut scope)?, one.to.at(&mut scope)?))))
            .collect()
    }

    /// The period of the cycle in s for the parameters of `network`; `None` if it is that of the
    /// repeated signals.
    ///
    /// # Errors
    /// The error of its evaluation.
    pub fn period(&self, network: &Network) -> Result<Option<f64>, EvalError> {
        let mut scope = network.evaluation();
        self.period.as_ref().map(|period| period.value.at(&mut scope)).transpose()
    }

    /// The required probability of meeting each requirement; `None` if `±` does not count.
    ///
    /// # Errors
    /// The error of its evaluation.
    pub fn probability(&self, network: &Network) -> Result<Option<f64>, EvalError> {
        let mut scope = network.evaluation();
        self.probability.as_ref().map(|setting| setting.value.at(&mut scope)).transpose()
    }
}

impl Study for SizeStudy {
    const SECTION: &'static SectionDeclaration = &SIZE;
    const FILES: &'static str = "catalogue";

    fn one<'a>(work: &mut Elaboration<'a>, entry: &'a RawEntry) -> Option<Self> {
        work.size_study(entry)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn check(&self, network: &Network) -> Vec<Diagnostic> {
        let ranges = self.varied.iter().filter_map(|range| self.check_range(network, range));
        let settings = [self.check_period(network), self.check_probability(network)];
        ranges.chain(settings.into_iter().flatten()).chain(self.check_objective(network)).collect()
    }

    fn fields(&self, network: &Network, path: &PathFrom<'_>) -> TomlFields {
        let mut fields = TomlFields::default();
        let goal = if self.goal == Goal::Minimise { "minimise" } else { "maximise" };
        fields.word(goal, &self.objective.text);
        let range = |range: &SizeRange| {
            let ty = type_of(network, &range.name);
            let [from, to] = [&range.from, &range.to].map(|end| like(end, ty));
            format!("{} = {{ from = {from}, to = {to} }}", toml_key(&range.name))
        };
        fields.table("vary", self.varied.iter().map(range));
        let written = |one: &Catalogue| written(&path(one.span.file, &one.csv), &one.options);
        let catalogues: Vec<String> = self.catalogues.iter().map(written).collect();
        let any = !catalogues.is_empty();
        fields.maybe("catalogue", any.then(|| format!("[{}]", catalogues.join(", "))));
        fields.strings("require", self.requirements.iter().map(|r| r.text.as_str()));
        if self.over != Over::Steady {
            fields.word("over", self.over.word());
        }
        fields.strings("cases", self.cases.iter().flatten().map(String::as_str));
        fields.maybe("probability", self.probability.as_ref().map(Setting::written));
        fields.maybe("period", self.period.as_ref().map(Setting::written));
        fields
    }
}
