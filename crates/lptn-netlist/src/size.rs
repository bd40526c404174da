//! `[size.NAME]`: a parameter to size, and what has to be kept.

use lptn_data::{Diagnostic, Span};
use lptn_network::{Context, Evaluation, Network, Value};
use lptn_units::{Comparison, EvalError, Expression, Scope as _, Type};

use crate::fields::{Fields, Owner};
use crate::format::{Role, SectionDeclaration, key};
use crate::place::{Given, Place, Text, Wanted};
use crate::raw::{RawEntry, RawValue};
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
        key("over", "`\"steady\"`", "the results in which it has to be kept", "\"steady\"")
            .or("`\"steady\"`"),
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
    /// The least and the largest value the parameter may take, in SI units, for the parameters of
    /// `network`.
    ///
    /// # Errors
    /// What the evaluation of an end reports.
    pub fn range(&self, network: &Network) -> Result<(f64, f64), EvalError> {
        let mut scope = network.evaluation();
        Ok((self.from.at(&mut scope)?, self.to.at(&mut scope)?))
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
        let error = match self.range(network) {
            Ok((from, to)) if from < to => return Vec::new(),
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
        vec![error.at(self.range_span.clone(), "")]
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
        fields
    }
}

impl<'a> Elaboration<'a> {
    /// An end of the range of a parameter of this type: `None` if it is not there, `Some(None)` if
    /// it is wrong.
    pub(crate) fn range_end(
        &mut self,
        range: &Fields<'a>,
        key: &str,
        ty: Type,
    ) -> Option<Option<Value>> {
        let given = self.given_inside(&range.owner, (key, range.get(key)?), Wanted::like(ty));
        Some(given.map(Given::value))
    }

    fn size_study(&mut self, entry: &'a RawEntry) -> Option<SizeStudy> {
        let fields = self.fields(&SIZE, entry)?;
        self.over(&fields);
        let sought = self.goal(&fields);
        let range = sought.and_then(|(_, parameter)| self.vary(&fields, parameter));
        let requirements = self.requirements(&fields);
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
        let Some((text, raw)) = self.word(fields, "over").filter(|(text, _)| *text != "steady")
        else {
            return;
        };
        let words = fields.owner.field("over");
        let (code, message) = match text {
            "run" | "periodic" => {
                ("netlist::not_supported_yet", format!("{words} = \"{text}\" is not supported yet"))
            }
            _ => ("netlist::size_over", format!("{words} has to be \"steady\", got \"{text}\"")),
        };
        self.refuse(code, message, &raw.span, "write `over = \"steady\"` or leave it out");
    }

    /// Which parameter is sought, and in which direction.
    fn goal(&mut self, fields: &Fields<'a>) -> Option<(Goal, &'a str)> {
        let (goal, key) = match (fields.get("minimise"), fields.get("maximise")) {
            (Some(_), None) => (Goal::Minimise, "minimise"),
            (None, Some(_)) => (Goal::Maximise, "maximise"),
            (both, _) => {
                if fields.complete {
                    self.report(one_goal(fields, both.is_some()));
                }
                return None;
            }
        };
        let (name, raw) = self.word(fields, key)?;
        let known = self.is_parameter_here(&fields.owner.field(key), name, &raw.span);
        (known && !self.names.has_failed(name)).then_some((goal, name))
    }

    /// The range of the parameter.
    fn vary(&mut self, fields: &Fields<'a>, parameter: &str) -> Option<(Value, Value)> {
        let raw = self.require(fields, "vary")?;
        let table = self.table_of(fields, ("vary", "a table"))?;
        let [entry] = table.entries.as_slice() else {
            self.report(one_parameter(fields, raw, parameter));
            return None;
        };
        if entry.key != parameter {
            self.report(one_parameter(fields, raw, parameter));
            return None;
        }
        let range = self.inner(&VARY, fields.owner.inside("vary").inside(parameter), entry)?;
        let ty = self.builder.scope(Context::Time).symbol(parameter)?.ty;
        let [from, to] = ["from", "to"].map(|key| {
            let end = self.range_end(&range, key, ty);
            if end.is_none() && range.complete {
                let message = format!("{} has no `{key}`", range.owner.words());
                let help = format!("write it like this: `{}`", fields.sample("vary"));
                self.report(range.missing(key, message).help(help));
            }
            end
        });
        Some((from??, to??))
    }

    /// The requirements of a study: comparisons of results.
    pub(crate) fn requirements(&mut self, fields: &Fields<'a>) -> Option<Vec<Requirement>> {
        let raw = self.require(fields, "require")?;
        let list = self.list(fields, ("require", "a list of requirements"))?;
        if list.is_empty() {
            self.report(fields.wrong_shape("require", raw, "a list of requirements"));
            return None;
        }
        let all: Vec<_> = list.iter().map(|raw| self.requirement(&fields.owner, raw)).collect();
        all.into_iter().collect()
    }

    fn requirement(&mut self, owner: &Owner, raw: &'a RawValue) -> Option<Requirement> {
        let place = Place { owner, key: "require", raw };
        let text = self.names.text(place, None);
        let Text::Expression(expression) = self.kept(text)? else {
            return self.no_comparison(place);
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
    fn sides(
        &mut self,
        place: Place<'_>,
        left: Expression,
        right: Expression,
    ) -> Option<(Given, Given)> {
        let left = self.resolve(place, Text::Expression(left), Wanted::of_results());
        let ty = left.as_ref().map(Given::ty);
        let wanted = Wanted { ty, ..Wanted::of_results() };
        let right = self.resolve(place, Text::Expression(right), wanted);
        Some((left?, right?))
    }

    fn no_comparison(&mut self, place: Place<'_>) -> Option<Requirement> {
        let message = format!("{} has to compare two values with `<=` or `>=`", place.words());
        let help = format!("write it like this: `{}`", place.owner.sample("require"));
        self.refuse("netlist::size_require", message, &place.raw.span, help);
        None
    }
}

fn one_goal(fields: &Fields<'_>, both: bool) -> Diagnostic {
    let has = if both {
        "has both `minimise` and `maximise`"
    } else {
        "says neither `minimise` nor `maximise`"
    };
    Diagnostic::wrong(
        "netlist::size_goal",
        format!("{} {has}", fields.owner.words()),
        fields.place,
        "name one parameter: `minimise = \"p\"` for the least value that does, `maximise` for the \
         largest",
    )
}

fn one_parameter(fields: &Fields<'_>, raw: &RawValue, parameter: &str) -> Diagnostic {
    let message = format!(
        "{} has to give the range of `{parameter}` and of nothing else",
        fields.owner.field("vary")
    );
    Diagnostic::wrong(
        "netlist::size_vary",
        message,
        &raw.span,
        format!(
            "write it like this: `vary = {{ {parameter} = {{ from = \"..\", to = \"..\" }} }}`"
        ),
    )
}
