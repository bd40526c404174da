//! A checker of the JSON Schema that netlists have: the keywords that it uses, and no others. The
//! package jsonschema of Python found the same of every file here.

use lptn_network::is_path;
use serde_json::Value;

/// The first place at which a value is refused, as a path of keys; `None` if it is accepted.
pub(crate) fn refused(root: &Value, schema: &Value, value: &Value) -> Option<String> {
    let inside = |schema: &Value, value: &Value| refused(root, schema, value);
    schema.as_object()?.iter().find_map(|(keyword, said)| {
        let wrong = |is: bool| is.then(|| format!("{keyword} {said}"));
        let all = || said.as_array().into_iter().flatten();
        match keyword.as_str() {
            "type" => wrong(!types(said).any(|name| is_of(value, name))),
            "enum" => wrong(all().all(|word| word != value)),
            "const" => wrong(said != value),
            "$ref" => inside(target(root, said), value),
            "anyOf" => wrong(all().all(|one| inside(one, value).is_some())),
            "allOf" => all().find_map(|one| inside(one, value)),
            "if" => inside(said, value).is_none().then(|| inside(&schema["then"], value))?,
            "required" => {
                let table = value.as_object()?;
                let missing = all().find(|key| !table.contains_key(key.as_str().unwrap()));
                missing.map(|key| format!("no {key}"))
            }
            "properties" => {
                let table = value.as_object()?;
                table.iter().find_map(|(key, value)| at(key, inside(said.get(key)?, value)))
            }
            "patternProperties" => {
                let element = said.as_object()?.values().next()?;
                let named = value.as_object()?.iter().filter(|(key, _)| is_path(key));
                named.into_iter().find_map(|(key, value)| at(key, inside(element, value)))
            }
            "additionalProperties" => {
                let known = |key: &str| {
                    schema.get("properties").is_some_and(|own| own.get(key).is_some())
                        || schema.get("patternProperties").is_some() && is_path(key)
                };
                let others = value.as_object()?.iter().filter(|(key, _)| !known(key));
                others.into_iter().find_map(|(key, value)| match said {
                    Value::Bool(false) => Some(format!("unknown {key}")),
                    said => at(key, inside(said, value)),
                })
            }
            "items" => value.as_array()?.iter().find_map(|item| inside(said, item)),
            "minItems" => wrong((value.as_array()?.len() as u64) < said.as_u64()?),
            "maxItems" => wrong(value.as_array()?.len() as u64 > said.as_u64()?),
            _ => None,
        }
    })
}

fn at(key: &str, problem: Option<String>) -> Option<String> {
    problem.map(|problem| format!("{key}: {problem}"))
}

/// What a reference leads to.
fn target<'s>(root: &'s Value, reference: &Value) -> &'s Value {
    let path = reference.as_str().unwrap().strip_prefix('#').unwrap();
    root.pointer(path).unwrap_or_else(|| panic!("{path} leads nowhere"))
}

fn types(said: &Value) -> impl Iterator<Item = &str> {
    let several = said.as_array().into_iter().flatten();
    several.chain(said.is_string().then_some(said)).map(|name| name.as_str().unwrap())
}

fn is_of(value: &Value, name: &str) -> bool {
    match name {
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.as_f64().is_some_and(|number| number.fract() == 0.0),
        "boolean" => value.is_boolean(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("there is no type {other}"),
    }
}

/// Goes through a schema: every keyword is known and has a value of its kind, every reference leads
/// somewhere, and every example and default is accepted where it stands.
pub(crate) fn is_sound(root: &Value, schema: &Value) {
    for (keyword, said) in schema.as_object().unwrap_or_else(|| panic!("no schema: {schema}")) {
        let sound = match keyword.as_str() {
            "properties" | "patternProperties" | "$defs" => {
                said.as_object().unwrap().values().for_each(|inner| is_sound(root, inner));
                true
            }
            "anyOf" | "allOf" => {
                let all = said.as_array().unwrap();
                all.iter().for_each(|inner| is_sound(root, inner));
                !all.is_empty() || keyword == "allOf"
            }
            "additionalProperties" if said.is_boolean() => true,
            "items" | "if" | "then" | "additionalProperties" => {
                is_sound(root, said);
                true
            }
            "$ref" => target(root, said).is_object(),
            "type" => types(said).count() > 0,
            "enum" | "required" => said.as_array().unwrap().iter().all(Value::is_string),
            "examples" => {
                let wrong = |value: &Value| refused(root, schema, value);
                said.as_array().unwrap().iter().all(|value| wrong(value).is_none())
            }
            "default" => refused(root, schema, said).is_none(),
            "minItems" | "maxItems" => said.is_u64(),
            "description" | "title" | "$schema" => said.is_string(),
            "const" => true,
            other => panic!("{other} is no keyword that is checked"),
        };
        assert!(sound, "{keyword}: {said} in {schema}");
    }
}
