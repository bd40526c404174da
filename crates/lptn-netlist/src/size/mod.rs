//! `[size.NAME]`: a parameter to size, and what has to be kept.

mod read;

use lptn_data::{Diagnostic, Span};
use lptn_network::{Bound, Evaluation, Limit, LimitSeverity, Network, Value};
use lptn_units::{EvalError, Type};

use crate::format::{Role, SectionDeclaration, key};
use crate::setting::Setting;
use crate::study::{PathFrom, Study};
use crate::toml_text::{TomlFields, key as toml_key, like, strings};
use crate::work::Elaboration;

const SIZE: SectionDeclaration = SectionDeclaration {
    name: "size",
    sentence: "A parameter to size: the least or largest value that keeps every requirement.",
    role: Role::Study,
    keys: &[
        key("minimise", "parameter", "whose least value is sought", "\"name of a parameter\""),
        key("maximise", "parameter", "whose largest value is sought", "\"name of a parameter\""),
        key(
            "vary",
            "table",
            "its range, `from` and `to`",
            "{ p = { from = \"1 W/K\", to = \"10 W/K\" } }",
        ),
        key(
            "require",
            "list of comparisons of results",
            "what has to be kept",
            "[\"steel.T <= 80 [degC]\"]",
        ),
        key(
            "over",
            "`\"steady\"`, `\"run\"`, `\"periodic\"`",
            "when it has to be kept: in steady state, at every moment of [run], in the settled \
             cycle",
            "\"run\"",
        )
        .or("`\"steady\"`"),
        key("period", "s", "how long a cycle is", "\"10 min\"").or("that of the repeated signals"),
    ],
    later: &["catalogue"],
    example: "{ minimise = \"p\", vary = { p = { from = \"..\", to = \"..\" } }, require = [\"a.T \
        <= 80 [degC]\"] }",
    elsewhere: &[
        ("minimize", "did you mean `minimise`?"),
        ("maximize", "did you mean `maximise`?"),
        ("from", "write `vary = { p = { from = \"..\", to = \"..\" } }`"),
        ("to", "write `vary = { p = { from = \"..\", to = \"..\" } }`"),
    ],
};

/// `p = { from = .., to = .. }` in `vary` of a size or fit.
pub(crate) const VARY: SectionDeclaration = SectionDeclaration {
    name: "vary",
    keys: &[
        key("from", "as the parameter", "the least value", "\"1 W/K\""),
        key("to", "as the parameter", "the largest value", "\"10 W/K\""),
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

/// Which of several values that keep every requirement is the best.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// The least one.
    Minimise,
    /// The largest one.
    Maximise,
}

/// In which results requirements have to be kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Over {
    /// In steady state.
    #[default]
    Steady,
    /// At every moment of the `[run]`.
    Run,
    /// At every moment of the cycle to which the network settles.
    Periodic,
}

impl Over {
    /// The words for them, the usual one first.
    pub const WORDS: [(&str, Self); 3] =
        [("steady", Self::Steady), ("run", Self::Run), ("periodic", Self::Periodic)];

    /// The word for it.
    pub fn word(self) -> &'static str {
        Self::WORDS.into_iter().find(|(_, over)| *over == self).map_or("", |(word, _)| word)
    }
}

/// Something that has to be kept: one expression is not to exceed another.
#[derive(Clone, Debug)]
pub struct Requirement {
    /// As it was written, for example `steel.T <= 80 [degC]`.
    pub text: String,
    /// The type of both sides.
    pub ty: Type,
    low: Value,
    high: Value,
}

impl Requirement {
    /// How far it is from being broken where `scope` stands: positive while it is kept, in SI
    /// units, a difference in K for temperatures. `scope` needs the temperatures, see
    /// [`Evaluation::set_temperatures`].
    ///
    /// # Errors
    /// What the evaluation of a side reports.
    pub fn margin(&self, scope: &mut Evaluation) -> Result<f64, EvalError> {
        Ok(self.high.at(scope)? - self.low.at(scope)?)
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
    /// The name of the parameter whose value is sought.
    pub parameter: String,
    /// Which value is the best.
    pub goal: Goal,
    /// What has to be kept; at least one.
    pub requirements: Vec<Requirement>,
    /// In which results.
    pub over: Over,
    /// The period of the cycle, where it is given.
    pub(crate) period: Option<Setting>,
    /// Where it stands.
    pub span: Span,
    from: Value,
    to: Value,
    range_span: Span,
}

impl SizeStudy {
    /// The least and the largest value the parameter may take, in SI units, for the parameters of
    /// `network`.
    ///
    /// # Errors
    /// What the evaluation of an end reports.
    pub fn range(&self, network: &Network) -> Result<(f64, f64), EvalError> {
        let mut scope = network.evaluation();
        Ok((self.from.at(&mut scope)?, self.to.at(&mut scope)?))
    }

    /// The period of the settled cycle in s for the parameters of `network`; `None` where it is that
    /// of the repeated signals.
    ///
    /// # Errors
    /// What its evaluation reports.
    pub fn period(&self, network: &Network) -> Result<Option<f64>, EvalError> {
        let mut scope = network.evaluation();
        self.period.as_ref().map(|period| period.value.at(&mut scope)).transpose()
    }

    fn check_period(&self, network: &Network) -> Option<Diagnostic> {
        let setting = self.period.as_ref()?;
        let problem = match self.period(network) {
            Ok(Some(period)) if !(period.is_finite() && period > 0.0) => {
                let message = format!("{} must be more than zero, got {period} s", setting.words);
                Diagnostic::error("netlist::run_not_positive", message).help(&setting.help)
            }
            Ok(_) => return None,
            Err(error) => Diagnostic::error(error.code(), format!("{}: {error}", setting.words)),
        };
        Some(problem.at(setting.span.clone(), ""))
    }
}

impl Study for SizeStudy {
    const SECTION: &'static SectionDeclaration = &SIZE;

    fn read(work: &mut Elaboration<'_>) -> Vec<Self> {
        work.elements(SIZE.name).iter().filter_map(|entry| work.size_study(entry)).collect()
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn check(&self, network: &Network) -> Vec<Diagnostic> {
        let period = self.check_period(network);
        let error = match self.range(network) {
            Ok((from, to)) if from < to => return period.into_iter().collect(),
            Ok(_) => {
                let message =
                    format!("`vary` of size `{}`: `from` has to be less than `to`", self.name);
                let help = "write the least value as `from` and the largest as `to`; `minimise` or \
                            `maximise` says which of them is the better end";
                Diagnostic::error("netlist::size_range", message).help(help)
            }
            Err(error) => {
                Diagnostic::error(error.code(), format!("`vary` of size `{}`: {error}", self.name))
            }
        };
        period.into_iter().chain([error.at(self.range_span.clone(), "")]).collect()
    }

    fn fields(&self, network: &Network, _: &PathFrom<'_>) -> TomlFields {
        let mut fields = TomlFields::default();
        fields.word(
            if self.goal == Goal::Minimise { "minimise" } else { "maximise" },
            &self.parameter,
        );
        if let Ok(id) = network.parameter(&self.parameter) {
            let ty = network.parameters()[id.index()].ty;
            let [from, to] = [&self.from, &self.to].map(|end| like(end, ty));
            let name = toml_key(&self.parameter);
            fields.put("vary", format!("{{ {name} = {{ from = {from}, to = {to} }} }}"));
        }
        fields.put("require", strings(self.requirements.iter().map(|r| r.text.as_str())));
        if self.over != Over::Steady {
            fields.word("over", self.over.word());
        }
        if let Some(period) = &self.period {
            fields.put("period", period.written());
        }
        fields
    }
}
