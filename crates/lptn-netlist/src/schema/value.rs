//! The schema of the values of keys.

use lptn_data::Files;
use lptn_units::parse_quantity;
use serde_json::{Map, Value, json};

use crate::format::{KeyDeclaration, SectionDeclaration, Takes};
use crate::netlist::parse_raw;
use crate::section::TABLE;

/// The names of elements and values, also of those inside others: `planet[2].gear`.
const NAMES: &str =
    r"^[A-Za-z_][A-Za-z0-9_]*(\[[0-9,]+\])?(\.[A-Za-z_][A-Za-z0-9_]*(\[[0-9,]+\])?)*$";

/// A table of names, each with such a value.
pub(super) fn named(value: Value) -> Value {
    object([("patternProperties", json!({ NAMES: value })), ("additionalProperties", false.into())])
}

/// A table with some members.
pub(super) fn object<const N: usize>(members: [(&str, Value); N]) -> Value {
    let all = [("type", Value::from("object"))].into_iter().chain(members);
    Value::Object(all.map(|(name, value)| (name.to_owned(), value)).collect())
}

/// A reference to the schema of an element of a section.
pub(super) fn reference(section: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{section}") })
}

/// One of several values.
pub(super) fn one_of(all: Vec<Value>) -> Value {
    json!({ "anyOf": all })
}

/// A table with the keys of a section, and no others.
pub(super) fn table(section: &SectionDeclaration) -> Value {
    let needed = section.keys.iter().filter(|key| key.needed).map(|key| key.name);
    let needed: Vec<&str> = needed.collect();
    let keys: Map<String, Value> =
        section.keys.iter().map(|key| (key.name.to_owned(), of_key(key))).collect();
    let mut whole = object([
        ("properties", keys.into()),
        ("required", needed.into()),
        ("additionalProperties", false.into()),
    ]);
    let any =
        |keys: &&[&str]| one_of(keys.iter().map(|key| json!({ "required": [key] })).collect());
    if !section.either.is_empty() {
        whole["allOf"] = section.either.iter().map(any).collect();
    }
    whole
}

/// The values that a key takes, with its help, its default and an example.
pub(super) fn of_key(key: &KeyDeclaration) -> Value {
    let mut text = format!("{}.\n\nTakes: {}.", key.meaning, key.takes());
    if !key.default.is_empty() {
        text += &format!("\n\nUnless given: {}.", key.default);
    }
    let mut all = Map::new();
    all.insert("description".to_owned(), text.into());
    if let Value::Object(takes) = of_takes(&key.takes) {
        all.extend(takes);
    }
    all.extend(default(key).map(|value| ("default".to_owned(), value)));
    all.extend(example(key).map(|value| ("examples".to_owned(), json!([value]))));
    Value::Object(all)
}

/// The schema of a type of values.
pub(super) fn of_takes(takes: &Takes) -> Value {
    match *takes {
        Takes::Quantity(_) | Takes::Text => json!({ "type": "string" }),
        Takes::Property(_) => one_of(vec![of_takes(&Takes::Text), reference(TABLE.name)]),
        Takes::Number | Takes::Like => json!({ "type": ["string", "number"] }),
        Takes::Whole => json!({ "type": "integer" }),
        Takes::Flag => json!({ "type": "boolean" }),
        Takes::Words(words) => json!({ "enum": words }),
        Takes::List(of, 0, usize::MAX) => json!({ "type": "array", "items": of_takes(of) }),
        Takes::List(of, least, most) => json!({
            "type": "array",
            "items": of_takes(of),
            "minItems": least,
            "maxItems": most,
        }),
        Takes::Table(section) => table(section),
        Takes::Members(names, of) => {
            let members = names.iter().map(|name| ((*name).to_owned(), of_takes(of)));
            let members: Map<String, Value> = members.collect();
            object([("properties", members.into()), ("additionalProperties", false.into())])
        }
        Takes::Each(of) => object([("additionalProperties", of_takes(of))]),
        Takes::Part(section) => named(reference(&format!("gearbox.{section}"))),
        Takes::Either(all) => one_of(all.iter().map(of_takes).collect()),
    }
}

/// The example of a key; for a list whose laws have one value each, a list of the least length.
fn example(key: &KeyDeclaration) -> Option<Value> {
    let value = read(key.example)?;
    Some(match key.takes {
        Takes::List(_, least, _) if !value.is_array() => vec![value; least].into(),
        _ => value,
    })
}

/// The default of a key, if it is a value, not a sentence.
fn default(key: &KeyDeclaration) -> Option<Value> {
    let text = key.default.trim_matches('`');
    let whole = matches!(key.takes, Takes::Number | Takes::Whole);
    match read(text) {
        Some(Value::Number(_)) if !whole => None,
        Some(value) => Some(value),
        None => parse_quantity(text, None).ok().map(|_| text.into()),
    }
}

/// The right side of a key as JSON.
fn read(text: &str) -> Option<Value> {
    let mut files = Files::default();
    let file = files.add("", format!("x = {text}\n"));
    let (raw, problems) = parse_raw(&files, file);
    let value = raw.top.get("x").filter(|_| problems.is_empty())?;
    Some(value.value.json())
}
