//! The JSON schema of a netlist, from the declarations of its sections: editors complete, explain
//! and check by it.
//!
//! It is never stricter than the reader. `lptn check` does the rest: names, units, values, and keys
//! that exclude each other.

mod kind;
mod value;

use serde_json::{Map, Value, json};

use crate::format::{NetlistFormat, Role, SectionDeclaration, Takes};
use crate::gearbox::PARTS;
use crate::run::RUN;
use crate::section::{PATHS, SIGNAL, format};
use crate::template::TEMPLATE;
use crate::uncertainty::UNCERTAINTY;
use value::{named, object, of_key, of_takes, one_of, reference, table};

/// The schema of a netlist by draft 2020-12, the same on every call.
pub fn schema() -> Value {
    let format = format();
    let mut properties = top();
    let mut parts = Map::new();
    for section in &format.sections {
        properties.insert(section.name.to_owned(), of_section(format, section));
        if !is_alone(section) && section.role != Role::Template && !section.keys.is_empty() {
            parts.insert(section.name.to_owned(), element(section));
        }
    }
    for path in PATHS.iter().filter(|path| PARTS.contains(&path.section.name)) {
        parts.insert(format!("gearbox.{}", path.section.name), kind::part(path));
    }
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "lptn netlist, format 1",
        "description": "A lumped-parameter thermal network: its elements, its run and its studies.",
        "type": "object",
        "properties": properties,
        "required": ["format"],
        "additionalProperties": false,
        "$defs": parts,
    })
}

/// The keys above the first heading.
fn top() -> Map<String, Value> {
    let text = |meaning: &str| json!({ "description": meaning, "type": "string" });
    let files = json!({
        "description": "Files whose contents come before this one, relative to it.",
        "type": "array",
        "items": { "type": "string" },
        "examples": [["materials.toml"]],
    });
    let format = json!({ "description": "The format of netlists, which is 1.", "const": 1 });
    let title = text("The name of the network in results.");
    let all = [
        ("format", format),
        ("title", title),
        ("description", text("A description for readers.")),
        ("include", files),
    ];
    all.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

/// True if a section has keys, and no elements with names.
fn is_alone(section: &SectionDeclaration) -> bool {
    matches!(section.role, Role::Default | Role::Import)
        || [RUN.name, UNCERTAINTY.name].contains(&section.name)
}

fn of_section(format: &NetlistFormat, section: &'static SectionDeclaration) -> Value {
    let mut whole = match section.role {
        _ if is_alone(section) => table(section),
        Role::Template => named(template(format)),
        _ if section.keys.is_empty() => named(of_takes(&Takes::Like)),
        _ if section.name == SIGNAL.name => {
            named(one_of(vec![of_takes(&Takes::Like), reference(section.name)]))
        }
        // any text names a study
        Role::Study => object([("additionalProperties", reference(section.name))]),
        _ => named(reference(section.name)),
    };
    if let Value::Object(members) = &mut whole {
        members.insert("description".to_owned(), section.sentence.into());
    }
    whole
}

/// One element of a section.
fn element(section: &'static SectionDeclaration) -> Value {
    match PATHS.iter().find(|path| path.section.name == section.name) {
        Some(path) => kind::element(path),
        None => table(section),
    }
}

/// A template, which contains the same sections as the top level.
fn template(format: &NetlistFormat) -> Value {
    let keys = TEMPLATE.keys.iter().map(|key| (key.name.to_owned(), of_key(key)));
    let inside = format.sections.iter().filter(|section| {
        !format.is_outside_templates(section.name) && TEMPLATE.key(section.name).is_none()
    });
    let sections = inside.map(|section| {
        (section.name.to_owned(), json!({ "$ref": format!("#/properties/{}", section.name) }))
    });
    let properties: Map<String, Value> = keys.chain(sections).collect();
    object([("properties", properties.into()), ("additionalProperties", false.into())])
}
