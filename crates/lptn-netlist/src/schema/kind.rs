//! The schema of a path or source: the keys that the laws of its kind need.

use lptn_laws::{FieldDeclaration, Formula, Substance};
use serde_json::{Value, json};

use crate::format::words;
use crate::gearbox::{AGAINST, MEMBERS, ON};
use crate::schema::value::{of_key, one_of, table};
use crate::section::{LUBRICANT_OF, PathSection};

/// The key that the face of a grid may give.
const AREA: &str = "area";
/// The key that follows from the member that a part of a gearbox is on.
const SPEED: &str = "speed";

/// An element of a section.
pub(super) fn element(path: &PathSection) -> Value {
    let mut whole = table(&path.section);
    let mut all: Vec<Value> = forms(path).into_iter().collect();
    all.extend(words_of(path).map(|law| of_word(path, law, false)));
    if !all.is_empty() {
        whole["allOf"] = all.into();
    }
    whole
}

/// A bearing, seal or gear in oil of a gearbox: `on` determines its speed, and the block the rest.
pub(super) fn part(path: &PathSection) -> Value {
    let mut whole = table(&path.section);
    let selector = path.kind.declaration().selector;
    whole["required"] = [ON].into_iter().chain(selector).collect();
    if let Some(keys) = whole["properties"].as_object_mut() {
        keys.shift_remove(SPEED);
        let member = |name, meaning| of_key(&words(name, &MEMBERS, meaning, "\"sun\""));
        keys.insert(ON.to_owned(), member(ON, "the member that it is on"));
        keys.insert(AGAINST.to_owned(), member(AGAINST, "the member that it turns in"));
    }
    whole["allOf"] = words_of(path).map(|law| of_word(path, law, true)).collect();
    whole
}

/// The keys with which each form of a path begins: one of them is required.
fn forms(path: &PathSection) -> Option<Value> {
    let needed = |keys: Vec<&str>| json!({ "required": keys });
    // the face at which a path ends may give the area
    let own = |keys: &[&'static str]| keys.iter().copied().filter(|key| *key != AREA).collect();
    let mut all: Vec<Value> = path.forms().map(|keys| needed(own(keys))).collect();
    all.extend(path.kind.declaration().selector.map(|key| needed(vec![key])));
    match all.len() {
        0 => None,
        1 => all.pop(),
        _ => Some(one_of(all)),
    }
}

/// The laws that a word chooses, each word once.
fn words_of(path: &PathSection) -> impl Iterator<Item = Formula> {
    let laws: Vec<Formula> = path.kind.laws().collect();
    let word = |law: Formula| law.declaration().name;
    let first =
        move |law: &Formula| laws.iter().find(|other| word(**other) == word(*law)) == Some(law);
    let chosen = path.kind.declaration().selector.is_some();
    path.kind.laws().filter(move |law| chosen && first(law))
}

/// The keys that all laws of a word need; the given keys choose one of these laws.
fn of_word(path: &PathSection, law: Formula, is_part: bool) -> Value {
    let word = law.declaration().name;
    let key = path.kind.declaration().selector.unwrap_or_default();
    let same: Vec<Formula> =
        path.kind.laws().filter(|other| other.declaration().name == word).collect();
    let fields = law.declaration().fields.iter().filter(|field| {
        field.default.is_none() && same.iter().all(|law| law.field(field.key).is_some())
    });
    let mut needed: Vec<Value> = Vec::new();
    for field in fields.filter(|field| field.key != AREA && !(is_part && field.key == SPEED)) {
        needed.extend(need(field, is_part).filter(|need| !needed.contains(need)));
    }
    json!({
        "if": { "properties": { key: { "const": word } }, "required": [key] },
        "then": { "allOf": needed },
    })
}

/// Requires a field, or a substance that gives it.
fn need(field: &FieldDeclaration, is_part: bool) -> Option<Value> {
    let key = |key: &str| json!({ "required": [key] });
    match field.property {
        None => Some(key(field.key)),
        Some(Substance::Material) => {
            Some(one_of(vec![key(field.key), key(Substance::Material.key())]))
        }
        Some(Substance::Lubricant) if !is_part => {
            Some(one_of(vec![key(field.key), key(LUBRICANT_OF.name)]))
        }
        Some(Substance::Fluid | Substance::Lubricant) => None,
    }
}
