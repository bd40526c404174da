//! `[limit]`: bounds of the results.

use lptn_data::Diagnostic;
use lptn_network::{Bound, Field, Input, Item, LimitSeverity, OverTime};
use lptn_units::Type;

use crate::fields::Fields;
use crate::format::{Role, SectionDeclaration, akin, text, words};
use crate::functional::Taken;
use crate::place::{Given, Place, Text, Wanted};
use crate::raw::{RawEntry, RawKind};
use crate::value::whole;
use crate::work::{Elaboration, stand_in};

pub(crate) const LIMIT: SectionDeclaration = SectionDeclaration {
    name: "limit",
    sentence: "A requirement: an upper or a lower bound of a result.",
    role: Role::Element,
    keys: &[
        text("of", "expression of results", "the limited result", "\"steel.T\"").needed(),
        akin("below", "as `of`", "the highest value that is allowed", "\"110 degC\""),
        akin("above", "as `of`", "the lowest value that is allowed", "\"-20 degC\""),
        words(
            "severity",
            &["error", "warning"],
            "the severity of a broken \
            limit",
            "\"warning\"",
        )
        .or("`\"error\"`"),
    ],
    either: &[&["below", "above"]],
    example: "{ of = \"a.T\", below = \"110 degC\" }",
    elsewhere: &[
        ("node", "the limited result is `of`, for example `of = \"a.T\"`"),
        ("max", "the highest value that is allowed is `below`"),
        ("min", "the lowest value that is allowed is `above`"),
    ],
    ..SectionDeclaration::NEW
};

/// The limited result, its type if known, its text, and its functional over time if it has one.
type Limited = (Input, Option<Type>, String, Option<OverTime>);

impl<'a> Elaboration<'a> {
    pub(crate) fn limits(&mut self) {
        for entry in self.elements(LIMIT.name) {
            self.limit(entry);
        }
    }

    fn limit(&mut self, entry: &'a RawEntry) -> Option<()> {
        let fields = self.fields(&LIMIT, entry)?;
        let (of, ty, text, over_time) = self.limited(&fields);
        let (bound, value) = self.bound(&fields, ty);
        let severity = self.severity(&fields);
        let id = self.builder.limit(&entry.key, (of, &text), (bound, value), severity);
        if let Some(over_time) = over_time.filter(|o| !bound.is_of_moments(o.functional)) {
            self.builder.limit_over_time(id, over_time);
        }
        self.note(Item::Limit(id), &entry.key_span, &fields, &[Field::Of, bound.field()]);
        Some(())
    }

    /// The limited result, its type if known, its text, and its functional over time.
    fn limited(&mut self, fields: &Fields<'a>) -> Limited {
        let nothing = || (stand_in(Type::ABSOLUTE_TEMPERATURE), None, String::new(), None);
        let Some(raw) = self.require(fields, "of") else { return nothing() };
        let place = Place { owner: &fields.owner, key: "of", raw };
        let text = self.names.text(place, None);
        let Some(text) = self.kept(text) else { return nothing() };
        if let Text::Expression(expression) = &text
            && let Some(called) = self.called(expression)
        {
            let written = whole(expression);
            let Some(Taken { of: (of, _), ty, over_time }) = self.over_time(place, called) else {
                return nothing();
            };
            return (Input::of_type(of, ty), Some(ty), written, Some(over_time));
        }
        match self.resolve(place, text, Wanted::of_results()) {
            Some(Given::Quantity(_)) => {
                self.report(
                    Diagnostic::error(
                        "netlist::constant_limit",
                        format!("{} is a constant", place.words()),
                    )
                    .at(raw.span.clone(), "never changes")
                    .help("name a result of the run, for example `of = \"steel.T\"`"),
                );
                nothing()
            }
            Some(Given::Expression(program)) => {
                let (ty, text) = (program.ty(), program.text().trim().to_owned());
                let text = match &raw.kind {
                    // a family is shown as it is written
                    RawKind::String { text, .. } if text.contains("[*]") => text.trim().to_owned(),
                    _ => text,
                };
                (program.into(), Some(ty), text, None)
            }
            None => nothing(),
        }
    }

    /// Exactly one of `below` and `above`, of the type of the limited result.
    fn bound(&mut self, fields: &Fields<'a>, ty: Option<Type>) -> (Bound, Input) {
        let bound = match [Bound::Below, Bound::Above]
            .map(|bound| fields.get(bound.field().key()).is_some())
        {
            [true, true] => {
                let message = "has `below` as well as `above`".to_owned();
                let problem = fields.several("netlist::two_bounds", message, ["below", "above"]);
                self.report(problem.help("keep one of them; a band is two limits"));
                Bound::Below
            }
            [false, false] => {
                if fields.complete {
                    self.report(no_bound(fields));
                }
                Bound::Below
            }
            [true, false] => Bound::Below,
            [false, true] => Bound::Above,
        };
        // without the type of the limited result the unit cannot be checked
        let input = ty.and_then(|ty| self.input(fields, bound.field().key(), Wanted::like(ty)));
        (bound, input.unwrap_or_else(|| stand_in(ty.unwrap_or(Type::ABSOLUTE_TEMPERATURE))))
    }

    fn severity(&mut self, fields: &Fields<'a>) -> LimitSeverity {
        let Some(raw) = fields.get("severity") else { return LimitSeverity::Error };
        match &raw.kind {
            RawKind::String { text, .. } if text == "error" => LimitSeverity::Error,
            RawKind::String { text, .. } if text == "warning" => LimitSeverity::Warning,
            RawKind::String { text, .. } => {
                let words = fields.owner.field("severity");
                let message = format!("{words} must be \"error\" or \"warning\", got \"{text}\"");
                let problem = Diagnostic::error("netlist::unknown_severity", message);
                self.report(problem.at(raw.span.clone(), "no such severity").help(
                    "a broken limit of severity \"error\" ends with exit code 1, one of \
                     \"warning\" is printed",
                ));
                LimitSeverity::Error
            }
            _ => {
                self.report(fields.wrong_shape("severity", raw, "\"error\" or \"warning\""));
                LimitSeverity::Error
            }
        }
    }
}

fn no_bound(fields: &Fields<'_>) -> Diagnostic {
    let message = format!("{} has neither `below` nor `above`", fields.owner.words());
    Diagnostic::error("netlist::no_bound", message)
        .at(fields.place.clone(), "has no bound")
        .help(format!("add `{}` or `{}`", fields.sample("below"), fields.sample("above")))
}
