//! `[uncertainty]` as it is read.

use lptn_data::Diagnostic;
use lptn_units::{Type, parse_quantity};

use super::{PosteriorKey, UNCERTAINTY, UncertaintyPlan, WrittenCorrelation};
use crate::fields::{Fields, Owner, wrong_shape};
use crate::format::{SectionDeclaration, names, text};
use crate::listed::Listed;
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};
use crate::work::Elaboration;

/// `posterior = { … }`.
pub(super) const POSTERIOR: SectionDeclaration = SectionDeclaration {
    name: "posterior",
    keys: &[
        text("file", "file", "the posterior of a fit", "\"results/posterior.json\"").needed(),
        names("only", "list of names", "the parameters that are taken", "[\"alpha\"]"),
    ],
    example: "{ file = \"results/posterior.json\", only = [\"alpha\"] }",
    ..SectionDeclaration::NEW
};

/// The value in `[uncertainty]` that names the file of a posterior, with its text.
pub(super) fn named(section: Option<&RawTable>) -> Option<(&str, &RawValue)> {
    let posterior = &section?.get("posterior")?.value;
    let value = match &posterior.kind {
        RawKind::Table(table) => &table.get("file")?.value,
        _ => posterior,
    };
    match &value.kind {
        RawKind::String { text, .. } => Some((text, value)),
        _ => None,
    }
}

impl<'a> Elaboration<'a> {
    pub(crate) fn uncertainty(&mut self) -> UncertaintyPlan {
        let mut plan = UncertaintyPlan::default();
        let Some(entry) = self.raw.top.get(UNCERTAINTY.name) else { return plan };
        let owner = Owner::section(UNCERTAINTY.name);
        let Some(fields) = self.inner(&UNCERTAINTY, owner, entry) else { return plan };
        plan.posterior = self.posterior_key(&fields);
        if let Some(table) = self.table_of(&fields, ("correlation", "a table of parameters")) {
            for entry in &table.entries {
                self.correlations_of(&fields, entry, &mut plan.correlations);
            }
        }
        plan
    }

    fn posterior_key(&mut self, fields: &Fields<'a>) -> Option<PosteriorKey> {
        let entry = fields.entry("posterior")?;
        let only = match &entry.value.kind {
            RawKind::Table(_) => {
                let inside = self.inner(&POSTERIOR, fields.owner.inside("posterior"), entry)?;
                self.required_word(&inside, "file")?;
                self.only(&inside)?
            }
            _ => {
                if !matches!(entry.value.kind, RawKind::String { .. }) {
                    let wanted = "the name of a file, or a table with it as `file`";
                    self.report(fields.wrong_shape("posterior", &entry.value, wanted));
                    return None;
                }
                None
            }
        };
        let (path, raw) = named(self.raw.section(UNCERTAINTY.name))?;
        Some(PosteriorKey { path: path.to_owned(), span: raw.span.clone(), only })
    }

    /// The parameters that are taken; `Some(None)` for all, `None` if the list is wrong.
    #[expect(clippy::option_option, reason = "left out is not wrong")]
    fn only(&mut self, fields: &Fields<'a>) -> Option<Option<Vec<(String, lptn_data::Span)>>> {
        let Some(listed) = self.listed_if_any(fields, ("only", "a list of names"))? else {
            return Some(None);
        };
        let mut names = Vec::new();
        for Listed { name, span, .. } in listed {
            if !self.is_parameter_here(&fields.owner.field("only"), name, span) {
                return None;
            }
            names.push((name.to_owned(), span.clone()));
        }
        Some(Some(names))
    }

    /// `R_skin = { alpha = -0.87 }`.
    fn correlations_of(
        &mut self,
        fields: &Fields<'a>,
        entry: &'a RawEntry,
        all: &mut Vec<WrittenCorrelation>,
    ) {
        let words = fields.owner.field("correlation");
        if !self.is_parameter_here(&words, &entry.key, &entry.key_span) {
            return;
        }
        let RawKind::Table(table) = &entry.value.kind else {
            let wanted = "a table of other parameters";
            self.report(fields.wrong_shape("correlation", &entry.value, wanted));
            return;
        };
        for other in &table.entries {
            if self.is_parameter_here(&words, &other.key, &other.key_span)
                && let Some(found) = self.correlation((&entry.key, other), all)
            {
                all.push(found);
            }
        }
    }

    fn correlation(
        &mut self,
        (of, other): (&str, &'a RawEntry),
        all: &[WrittenCorrelation],
    ) -> Option<WrittenCorrelation> {
        let (with, span) = (other.key.as_str(), other.key_span.clone());
        let text = match &other.value.kind {
            RawKind::Integer(text) | RawKind::Float(text) | RawKind::String { text, .. } => text,
            _ => "",
        };
        let Ok(number) = parse_quantity(text, Some(Type::SCALAR)) else {
            let words = format!("the correlation of `{of}` and `{with}`");
            let sample = format!("{of} = {{ {with} = 0.5 }}");
            self.report(wrong_shape(&words, &other.value, "a number", &sample));
            return None;
        };
        let value = number.value;
        let pair = |written: &&WrittenCorrelation| {
            written.between.iter().all(|name| name == of || name == with)
        };
        let wrong = |message: String, place, help: &str| {
            Diagnostic::wrong("netlist::correlation", message, place, help)
        };
        if of == with {
            let message = format!("`correlation` names `{of}` twice");
            self.report(wrong(message, &span, "name two parameters: `a = { b = 0.5 }`"));
            return None;
        }
        if let Some(first) = all.iter().find(pair) {
            let message = format!("the correlation of `{of}` and `{with}` is written twice");
            let problem = wrong(message, &span, "keep one of the two");
            self.report(problem.also(first.span.clone(), "first written here"));
            return None;
        }
        if !(-1.0 < value && value < 1.0) {
            let message = format!(
                "the correlation of `{of}` and `{with}` has to be more than -1 and less than 1, got \
                 {}",
                text.trim()
            );
            let help = "if two values always go together, make one an expression of the other";
            self.report(wrong(message, &other.value.span, help));
            return None;
        }
        Some(WrittenCorrelation { between: [of.to_owned(), with.to_owned()], value, span })
    }
}
