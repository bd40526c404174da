//! The forms in which a path may be given, by their keys.

use lptn_data::Diagnostic;
use smallvec::{SmallVec, smallvec};

use crate::fields::Fields;

/// The forms that are begun: those with a given key that no other form takes. A given key in none
/// of them begins the first form that takes it.
pub(crate) fn begun(forms: &[&[&str]], given: impl Fn(&str) -> bool) -> SmallVec<[usize; 2]> {
    let mut touched = (0..forms.len()).filter(|&i| forms[i].iter().any(|key| given(key)));
    match (touched.next(), touched.next()) {
        (None, _) => return SmallVec::new(),
        (Some(only), None) => return smallvec![only],
        (Some(_), Some(_)) => {}
    }
    let own = |key: &str| forms.iter().filter(|form| form.contains(&key)).count() == 1;
    let by_own = |&i: &usize| forms[i].iter().any(|key| own(key) && given(key));
    let mut begun: SmallVec<[usize; 2]> = (0..forms.len()).filter(by_own).collect();
    for (i, form) in forms.iter().enumerate() {
        let known = |key: &str| begun.iter().any(|&other| forms[other].contains(&key));
        if form.iter().any(|key| given(key) && !known(key)) {
            begun.push(i);
        }
    }
    begun.sort_unstable();
    begun
}

/// Exactly one form, and all of it.
pub(crate) fn check_forms(fields: &Fields<'_>, forms: &[&[&str]]) -> Option<Diagnostic> {
    let begun = begun(forms, |key| fields.get(key).is_some());
    let begun: SmallVec<[&[&str]; 2]> = begun.into_iter().map(|form| forms[form]).collect();
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

fn two_forms(fields: &Fields<'_>, begun: &[&[&str]]) -> Diagnostic {
    let both: Vec<String> = begun.iter().map(|form| words(form)).collect();
    let message = format!("has {} as well as {}", both[0], both[1..].join(" and "));
    let all = begun.concat();
    let keys = all.iter().enumerate().filter(|(i, key)| !all[..*i].contains(key));
    let keys = keys.map(|(_, key)| *key);
    let error = fields.several("netlist::two_laws", message, keys);
    error.help("keep one of them; two parallel paths are two elements")
}

#[cfg(test)]
mod tests {
    use super::begun;

    #[test]
    fn a_key_that_two_forms_share_begins_neither_beside_one_of_their_own() {
        let forms: [&[&str]; 3] = [&["R"], &["h", "area"], &["c", "n", "area"]];
        let of = |given: &[&str]| begun(&forms, |key| given.contains(&key));
        assert_eq!(of(&["h", "area"])[..], [1]);
        assert_eq!(of(&["c", "area"])[..], [2]);
        assert_eq!(of(&["area"])[..], [1]);
        assert_eq!(of(&["R", "area"])[..], [0, 1]);
        assert_eq!(of(&["h", "n", "area"])[..], [1, 2]);
        assert!(of(&[]).is_empty());
    }
}
