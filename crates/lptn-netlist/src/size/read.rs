//! Reads `[size.NAME]`.

use lptn_data::Diagnostic;
use lptn_network::{Bound, OverTime, Value};
use lptn_units::{Comparison, Expression, Type};

use crate::fields::{Fields, Owner};
use crate::functional::{Called, Taken};
use crate::listed::{Listed, Names};
use crate::place::{Place, Text, Wanted};
use crate::raw::{RawEntry, RawValue};
use crate::reading::all;
use crate::run::RUN;
use crate::setting::Setting;
use crate::size::{
    Catalogue, Goal, Objective, Over, Requirement, SIZE, SizeRange, SizeStudy, VARY,
};
use crate::value::whole;
use crate::work::Elaboration;

/// A side of a requirement.
struct Side {
    value: Value,
    ty: Type,
    over_time: Option<OverTime>,
}

impl Side {
    /// True if its bound is that of every moment.
    fn is_of_moments(&self, bound: Bound) -> bool {
        self.over_time.as_ref().is_none_or(|o| bound.is_of_moments(o.functional))
    }
}

impl<'a> Elaboration<'a> {
    pub(super) fn size_study(&mut self, entry: &'a RawEntry) -> Option<SizeStudy> {
        let fields = self.fields(&SIZE, entry)?;
        let over = self.over(&fields);
        let steady = over.as_ref().is_none_or(|(over, _)| *over == Over::Steady);
        let objective = self.goal(&fields, steady);
        let varied = self.varied_or_chosen(&fields);
        let requirements = self.requirements(&fields, steady);
        let cases = self.cases_of(&fields);
        let probability = self.optional_setting(&fields, "probability");
        let ((goal, objective), (varied, catalogues)) = (objective?, varied?);
        let (over, period) = over?;
        let cases = cases?;
        let columns = catalogues.iter().flat_map(|one| &one.columns).map(|one| &one.name);
        let changed: Vec<&String> = varied.iter().map(|one| &one.name).chain(columns).collect();
        self.set_by_cases((&fields, cases.as_deref()), &changed)?;
        Some(SizeStudy {
            name: entry.key.clone(),
            objective,
            goal,
            requirements: requirements?,
            over,
            period,
            probability: probability?,
            span: entry.key_span.clone(),
            varied,
            cases,
            catalogues,
        })
    }

    /// The parameters of `vary`, the catalogues, or both.
    fn varied_or_chosen(
        &mut self,
        fields: &Fields<'a>,
    ) -> Option<(Vec<SizeRange>, Vec<Catalogue>)> {
        if fields.key("catalogue").is_none() {
            return Some((self.size_ranges(fields)?, Vec::new()));
        }
        let varied = match fields.key("vary") {
            Some(_) => self.size_ranges(fields),
            None => Some(Vec::new()),
        };
        let (catalogues, varied) = (self.catalogues(fields)?, varied?);
        for column in catalogues.iter().flat_map(|one| &one.columns) {
            if let Some(range) = varied.iter().find(|range| range.name == column.name) {
                let words = fields.owner.words();
                let message = format!("{words}: `{}` is varied and set by a part", column.name);
                let problem = Diagnostic::error("netlist::size_catalogue", message)
                    .at(range.span.clone(), "varied")
                    .also(column.span.clone(), "set by every part");
                self.report(problem.help("leave it out of `vary`, or the column out of the file"));
                return None;
            }
        }
        Some((varied, catalogues))
    }

    /// The results in which requirements are checked, and the period of a cycle if given.
    fn over(&mut self, fields: &Fields<'a>) -> Option<(Over, Option<Setting>)> {
        let over = self.choice(fields, "over", &Over::WORDS)?;
        if over == Over::Run && self.raw.top.get(RUN.name).is_none() {
            let message = format!("{} = \"run\" needs a [run]", fields.owner.field("over"));
            let help = "give its duration:\n\n[run]\nstop = \"25 min\"";
            self.refuse("netlist::size_over", message, &fields.get("over")?.span, help);
            return None;
        }
        let Some(period) = fields.get("period") else { return Some((over, None)) };
        if over != Over::Periodic {
            let message = format!(
                "{} belongs to a periodic steady \
                state",
                fields.owner.field("period")
            );
            let help = "add `over = \"periodic\"`, or leave it out";
            self.refuse("netlist::size_over", message, &period.span, help);
            return None;
        }
        Some((over, self.optional_setting(fields, "period")?))
    }

    /// The direction and the objective; results have one value in steady state only.
    fn goal(&mut self, fields: &Fields<'a>, steady: bool) -> Option<(Goal, Objective)> {
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
        let (text, raw) = self.word(fields, key)?;
        let text = text.trim();
        let parsed = Expression::parse(text).ok();
        let of_results = parsed.as_ref().is_some_and(|e| self.reads_results(e));
        if of_results && !steady {
            let message =
                format!("{} reads results, which change over time", fields.owner.field(key));
            let help = "minimise an expression of parameters, or size in steady state; \
                        requirements over time are `require`";
            self.refuse("netlist::size_goal", message, &raw.span, help);
            return None;
        }
        let alone = parsed.is_none_or(|e| e.names().iter().any(|(name, _)| *name == text));
        if alone && !of_results {
            let known = self.is_parameter_here(&fields.owner.field(key), text, &raw.span);
            if !known || self.names.has_failed(text) {
                return None;
            }
        }
        let place = Place { owner: &fields.owner, key, raw };
        let wanted = if of_results { Wanted::of_results() } else { Wanted::parameter() };
        let given = self.given(place, wanted)?;
        let ty = given.ty();
        let value = given.clone().value();
        if value.slots().is_empty() {
            let message = format!("{} is a constant", place.words());
            let help = "name a parameter, or an expression of those that are varied";
            self.refuse("netlist::size_goal", message, &raw.span, help);
            return None;
        }
        Some((goal, Objective { text: text.to_owned(), value, of_results, ty }))
    }

    /// True if an expression names a result, `NAME.T` or `NAME.Q`, not only parameters of parts,
    /// whose names contain a point, too.
    fn reads_results(&self, expression: &Expression) -> bool {
        let names = expression.names();
        names.iter().any(|(name, _)| name.contains('.') && !self.names.is_parameter(name))
    }

    /// The ranges of the parameters.
    fn size_ranges(&mut self, fields: &Fields<'a>) -> Option<Vec<SizeRange>> {
        let names = self.listed(fields, "vary", Names::Table("a table", "a table of ranges"))?;
        all(names.into_iter().map(|one| self.size_range(fields, one)))
    }

    fn size_range(&mut self, fields: &Fields<'a>, one: Listed<'a>) -> Option<SizeRange> {
        let Listed { name, span, entry } = one;
        let known = self.is_parameter_here(&fields.owner.field("vary"), name, span);
        let range = self.inner(&VARY, fields.owner.inside("vary").inside(name), entry?)?;
        if !known || self.names.has_failed(name) {
            return None;
        }
        let ty = self.type_here(name)?;
        let help = format!("write it like this: `{}`", fields.sample("vary"));
        let [from, to] = self.both_ends(&range, ty, Some(&help))?;
        Some(SizeRange { name: name.to_owned(), from, to, span: span.clone() })
    }

    /// The requirements of a study: comparisons of results.
    fn requirements(&mut self, fields: &Fields<'a>, steady: bool) -> Option<Vec<Requirement>> {
        let raw = self.require(fields, "require")?;
        let list = self.list(fields, ("require", "a list of requirements"))?;
        if list.is_empty() {
            self.report(fields.wrong_shape("require", raw, "a list of requirements"));
            return None;
        }
        all(list.iter().map(|raw| self.requirement(&fields.owner, (raw, steady))))
    }

    fn requirement(
        &mut self,
        owner: &Owner<'_>,
        (raw, steady): (&'a RawValue, bool),
    ) -> Option<Requirement> {
        let place = Place { owner, key: "require", raw };
        let text = self.names.text(place, None);
        let Text::Expression(expression) = self.kept(text)? else {
            return self.no_comparison(place);
        };
        let Some((left, comparison, right)) = expression.split_comparison() else {
            return self.no_comparison(place);
        };
        let [left, right] = self.sides((place, steady), [left, right])?;
        let (low, high) = match comparison {
            Comparison::Less | Comparison::LessEqual => (left, right),
            Comparison::Greater | Comparison::GreaterEqual => (right, left),
            Comparison::Equal | Comparison::NotEqual => return self.no_comparison(place),
        };
        let every_moment = low.is_of_moments(Bound::Below) && high.is_of_moments(Bound::Above);
        let (text, ty) = (whole(&expression), low.ty);
        let (low, high, over_time) = (low.value, high.value, [low.over_time, high.over_time]);
        let over_time = if every_moment { [None, None] } else { over_time };
        Some(Requirement { text, ty, low, high, over_time })
    }

    /// Both sides, of one type. A functional over time may be compared with another one, or with a
    /// constant.
    fn sides(
        &mut self,
        (place, steady): (Place<'_>, bool),
        sides: [Expression; 2],
    ) -> Option<[Side; 2]> {
        let called = [self.called(&sides[0]), self.called(&sides[1])];
        let over_time = called.iter().any(Option::is_some);
        let constant =
            |side: &Expression| side.names().iter().all(|(name, _)| self.names.is_parameter(name));
        if steady && let Some(called) = called.iter().flatten().next() {
            return self.no_time(place, called);
        }
        if over_time && !sides.iter().zip(&called).all(|(s, c)| c.is_some() || constant(s)) {
            let message =
                format!("{} compares a number over time with a value that changes", place.words());
            let help = "compare it with a value or with another functional: `mean(a.T) <= \
                        mean(b.T)`";
            self.refuse("netlist::functional", message, &place.raw.span, help);
            return None;
        }
        let turned = called[0].is_none() && called[1].is_some();
        let mut both: Vec<_> = sides.into_iter().zip(called).collect();
        if turned {
            both.reverse();
        }
        let (mut found, mut ty) = (Vec::new(), None);
        for side in both {
            let side = self.side(place, side, ty);
            ty = ty.or(side.as_ref().map(|side| side.ty));
            found.push(side);
        }
        if turned {
            found.reverse();
        }
        <[Side; 2]>::try_from(all(found.into_iter())?).ok()
    }

    /// One side, of this type if it is known.
    fn side(
        &mut self,
        place: Place<'_>,
        (expression, called): (Expression, Option<Called>),
        ty: Option<Type>,
    ) -> Option<Side> {
        let Some(called) = called else {
            let wanted = Wanted { ty, ..Wanted::of_results() };
            let given = self.resolve(place, Text::Expression(expression), wanted)?;
            return Some(Side { ty: given.ty(), value: given.value(), over_time: None });
        };
        let Taken { of: (value, _), ty: own, over_time } = self.over_time(place, called)?;
        if ty.is_some_and(|ty| ty != own) {
            let message = format!("{} compares numbers of different quantities", place.words());
            let help = "compare numbers of one unit: `time_over(a.T, 90 [degC]) <= 30 [s]`";
            self.refuse("netlist::functional", message, &place.raw.span, help);
            return None;
        }
        Some(Side { value, ty: own, over_time: Some(over_time) })
    }

    fn no_time<T>(&mut self, place: Place<'_>, called: &Called) -> Option<T> {
        let inner = called.arguments.first().map_or("", |first| first.text().trim());
        let message =
            format!("{} needs results over time, but a steady state is one moment", place.words());
        let help = format!(
            "require `{inner}`, which is its value there, or size `over = \"run\"` or `over = \
             \"periodic\"`"
        );
        self.refuse("netlist::functional", message, &place.raw.span, &help);
        None
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
        "has neither `minimise` nor `maximise`"
    };
    Diagnostic::wrong(
        "netlist::size_goal",
        format!("{} {has}", fields.owner.words()),
        fields.place,
        "name one parameter: `minimise = \"p\"` for the least value that keeps the requirements, \
         `maximise` for the largest",
    )
}
