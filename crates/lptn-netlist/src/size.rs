//! `[size.NAME]`: a parameter to size, and what has to be kept.

use lptn_data::{Diagnostic, Span};
use lptn_network::{Context, Evaluation, Network, Value};
use lptn_units::{Comparison, EvalError, Expression, Scope as _, Type, suggest};

use crate::fields::{Fields, Owner, sample, wrong_shape};
use crate::place::{Given, Place, Text, Wanted};
use crate::raw::{RawEntry, RawKind, RawValue};
use crate::vocabulary::{SIZE, VARY};
use crate::work::Elaboration;

/// Which of several values that keep every requirement is the best.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// The least one.
    Minimise,
    /// The largest one.
    Maximise,
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
    /// How far it is from being broken where `scope` stands: positive while it is kept, in SI units, a difference
    /// in K for temperatures. `scope` needs the temperatures, see [`Evaluation::set_temperatures`].
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
    /// Where it stands.
    pub span: Span,
    from: Value,
    to: Value,
    range_span: Span,
}

impl SizeStudy {
    /// The least and the largest value the parameter may take, in SI units, for the parameters of `network`.
    ///
    /// # Errors
    /// What the evaluation of an end reports.
    pub fn range(&self, network: &Network) -> Result<(f64, f64), EvalError> {
        let mut scope = network.evaluation();
        Ok((self.from.at(&mut scope)?, self.to.at(&mut scope)?))
    }

    /// The least and the largest value as they are written.
    pub(crate) fn ends(&self) -> [&Value; 2] {
        [&self.from, &self.to]
    }

    /// What is wrong with the range, if anything.
    pub(crate) fn check(&self, network: &Network) -> Option<Diagnostic> {
        let error = match self.range(network) {
            Ok((from, to)) if from < to => return None,
            Ok(_) => {
                let message = format!("`vary` of size `{}`: `from` has to be less than `to`", self.name);
                let help = "write the least value as `from` and the largest as `to`; \
                            `minimise` or `maximise` says which of them is the better end";
                Diagnostic::error("netlist::size_range", message).help(help)
            }
            Err(error) => Diagnostic::error(error.code(), format!("`vary` of size `{}`: {error}", self.name)),
        };
        Some(error.at(self.range_span.clone(), ""))
    }
}

impl<'a> Elaboration<'a> {
    pub(crate) fn sizes(&mut self) -> Vec<SizeStudy> {
        self.elements(SIZE.name).iter().filter_map(|entry| self.size_study(entry)).collect()
    }

    fn size_study(&mut self, entry: &'a RawEntry) -> Option<SizeStudy> {
        let owner = Owner::element(SIZE.name, &entry.key);
        let fields = Fields::of(&SIZE, owner, entry, &mut self.problems)?;
        self.over(&fields);
        let sought = self.goal(&fields);
        let range = sought.and_then(|(_, parameter)| self.vary(&fields, parameter));
        let requirements = self.require(&fields);
        let ((goal, parameter), (from, to)) = (sought?, range?);
        Some(SizeStudy {
            name: entry.key.clone(),
            parameter: parameter.to_owned(),
            goal,
            requirements: requirements?,
            span: entry.key_span.clone(),
            from,
            to,
            range_span: fields.get("vary")?.span.clone(),
        })
    }

    fn over(&mut self, fields: &Fields<'a>) {
        let Some(raw) = fields.get("over") else { return };
        let Some(text) = fields.text("over", raw, &mut self.problems) else { return };
        let words = fields.owner.field("over");
        let problem = match text {
            "steady" => return,
            "run" | "periodic" => Diagnostic::error(
                "netlist::not_supported_yet",
                format!("{words} = \"{text}\" is not supported yet"),
            ),
            _ => {
                let message = format!("{words} has to be \"steady\", got \"{text}\"");
                Diagnostic::error("netlist::size_over", message)
            }
        };
        let help = "write `over = \"steady\"` or leave it out";
        self.report(problem.at(raw.span.clone(), "").help(help));
    }

    /// Which parameter is sought, and in which direction.
    fn goal(&mut self, fields: &Fields<'a>) -> Option<(Goal, &'a str)> {
        let (goal, key, raw) = match (fields.get("minimise"), fields.get("maximise")) {
            (Some(raw), None) => (Goal::Minimise, "minimise", raw),
            (None, Some(raw)) => (Goal::Maximise, "maximise", raw),
            (both, _) => {
                if fields.complete {
                    self.report(one_goal(fields, both.is_some()));
                }
                return None;
            }
        };
        let name = fields.text(key, raw, &mut self.problems)?;
        if self.names.is_parameter(name) {
            return (!self.names.has_failed(name)).then_some((goal, name));
        }
        let words = fields.owner.field(key);
        let message = format!("{words} has to name a parameter, got `{name}`");
        let problem = Diagnostic::error("netlist::unknown_parameter", message).at(raw.span.clone(), "");
        let parameters = self.raw.section(crate::vocabulary::PARAM);
        let names = parameters.into_iter().flat_map(|table| &table.entries).map(|entry| entry.key.as_str());
        let help = match suggest(name, names) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "give the value a name in [param] and use it in the element".to_owned(),
        };
        self.report(problem.help(help));
        None
    }

    /// The range of the parameter.
    fn vary(&mut self, fields: &Fields<'a>, parameter: &str) -> Option<(Value, Value)> {
        let raw = fields.require("vary", &mut self.problems)?;
        let RawKind::Table(table) = &raw.kind else {
            self.report(wrong_shape(&fields.owner.field("vary"), raw, "a table", &sample("vary")));
            return None;
        };
        let [entry] = table.entries.as_slice() else {
            self.report(one_parameter(fields, raw, parameter));
            return None;
        };
        if entry.key != parameter {
            self.report(one_parameter(fields, raw, parameter));
            return None;
        }
        let owner = fields.owner.inside("vary").inside(parameter);
        let range = Fields::of(&VARY, owner, entry, &mut self.problems)?;
        let ty = self.builder.scope(Context::Time).symbol(parameter)?.ty;
        let (from, to) = (self.range_end(&range, "from", ty), self.range_end(&range, "to", ty));
        Some((from?, to?))
    }

    fn range_end(&mut self, range: &Fields<'a>, key: &str, ty: Type) -> Option<Value> {
        let Some(raw) = range.get(key) else {
            if range.complete {
                let message = format!("{} has no `{key}`", range.owner.words());
                let problem = Diagnostic::error("netlist::missing_field", message);
                let help = format!("write it like this: `{}`", sample("vary"));
                self.report(problem.at(range.place.clone(), format!("`{key}` is missing")).help(help));
            }
            return None;
        };
        // an owner without a key: the key `from` of a path takes something else
        let owner = range.owner.inside(key);
        Some(self.given(Place { owner: &owner, key: "", raw }, Wanted::like(ty))?.value())
    }

    fn require(&mut self, fields: &Fields<'a>) -> Option<Vec<Requirement>> {
        let raw = fields.require("require", &mut self.problems)?;
        let list = match &raw.kind {
            RawKind::Array(list) if !list.is_empty() => list,
            _ => {
                let words = fields.owner.field("require");
                self.report(wrong_shape(&words, raw, "a list of requirements", &sample("require")));
                return None;
            }
        };
        let all: Vec<_> = list.iter().map(|raw| self.requirement(&fields.owner, raw)).collect();
        all.into_iter().collect()
    }

    fn requirement(&mut self, owner: &Owner, raw: &'a RawValue) -> Option<Requirement> {
        let place = Place { owner, key: "require", raw };
        let expression = match self.names.text(place, None) {
            Ok(Text::Expression(expression)) => expression,
            Ok(Text::Quantity(_)) => return self.no_comparison(place),
            Err(problem) => {
                self.report(problem);
                return None;
            }
        };
        let Some((left, comparison, right)) = expression.split_comparison() else {
            return self.no_comparison(place);
        };
        let (left, right) = self.sides(place, left, right)?;
        let ty = left.ty();
        let (left, right) = (left.value(), right.value());
        let (low, high) = match comparison {
            Comparison::Less | Comparison::LessEqual => (left, right),
            Comparison::Greater | Comparison::GreaterEqual => (right, left),
            Comparison::Equal | Comparison::NotEqual => return self.no_comparison(place),
        };
        Some(Requirement { text: expression.text().trim().to_owned(), ty, low, high })
    }

    /// Both sides, of one type.
    fn sides(&mut self, place: Place<'_>, left: Expression, right: Expression) -> Option<(Given, Given)> {
        let left = self.resolve(place, Text::Expression(left), Wanted::of_results());
        let ty = left.as_ref().map(Given::ty);
        let wanted = Wanted { ty, ..Wanted::of_results() };
        let right = self.resolve(place, Text::Expression(right), wanted);
        Some((left?, right?))
    }

    fn no_comparison(&mut self, place: Place<'_>) -> Option<Requirement> {
        let message = format!("{} has to compare two values with `<=` or `>=`", place.words());
        let problem = Diagnostic::error("netlist::size_require", message).at(place.raw.span.clone(), "");
        self.report(problem.help(format!("write it like this: `{}`", sample("require"))));
        None
    }
}

fn one_goal(fields: &Fields<'_>, both: bool) -> Diagnostic {
    let has =
        if both { "has both `minimise` and `maximise`" } else { "says neither `minimise` nor `maximise`" };
    Diagnostic::error("netlist::size_goal", format!("{} {has}", fields.owner.words()))
        .at(fields.place.clone(), "")
        .help("name one parameter: `minimise = \"p\"` for the least value that does, `maximise` for the largest")
}

fn one_parameter(fields: &Fields<'_>, raw: &RawValue, parameter: &str) -> Diagnostic {
    let message =
        format!("{} has to give the range of `{parameter}` and of nothing else", fields.owner.field("vary"));
    Diagnostic::error("netlist::size_vary", message)
        .at(raw.span.clone(), "")
        .help(format!("write it like this: `vary = {{ {parameter} = {{ from = \"..\", to = \"..\" }} }}`"))
}
