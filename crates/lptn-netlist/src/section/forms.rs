//! The forms in which a path may be given, by their keys.

use lptn_data::Diagnostic;

use crate::fields::Fields;

/// Exactly one form, and all of it.
pub(crate) fn check_forms(fields: &Fields<'_>, forms: &[&[&str]]) -> Option<Diagnostic> {
    let begun: Vec<&&[&str]> =
        forms.iter().filter(|form| form.iter().any(|key| fields.get(key).is_some())).collect();
    match begun.as_slice() {
        [] if fields.complete => Some(no_form(fields, forms)),
        [] => None,
        [form] => form.iter().find(|key| !fields.has(key)).and_then(|key| half(fields, form, key)),
        _ => Some(two_forms(fields, &begun)),
    }
}

fn words(form: &[&str]) -> String {
    form.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(" and ")
}

fn written(fields: &Fields<'_>, form: &[&str]) -> String {
    form.iter().map(|key| fields.sample(key)).collect::<Vec<_>>().join(", ")
}

fn no_form(fields: &Fields<'_>, forms: &[&[&str]]) -> Diagnostic {
    let either: Vec<String> = forms.iter().map(|form| words(form)).collect();
    let message = format!("{} has neither {}", fields.owner.words(), either.join(" nor "));
    let samples: Vec<String> =
        forms.iter().map(|form| format!("`{}`", written(fields, form))).collect();
    Diagnostic::error("netlist::no_law", message)
        .at(fields.place.clone(), "does not say how much heat it carries")
        .help(format!("add {}", samples.join(" or ")))
}

fn half(fields: &Fields<'_>, form: &[&str], missing: &str) -> Option<Diagnostic> {
    if !fields.complete {
        return None;
    }
    let given = form.iter().find(|key| **key != missing)?;
    let message = format!("{} has `{given}` but no `{missing}`", fields.owner.words());
    Some(fields.missing(missing, message))
}

fn two_forms(fields: &Fields<'_>, begun: &[&&[&str]]) -> Diagnostic {
    let both: Vec<String> = begun.iter().map(|form| words(form)).collect();
    let message = format!("has {} as well as {}", both[0], both[1..].join(" and "));
    let keys = begun.iter().flat_map(|form| form.iter().copied());
    let error = fields.several("netlist::two_laws", message, keys);
    error.help("keep one of them; two paths side by side are two elements")
}
