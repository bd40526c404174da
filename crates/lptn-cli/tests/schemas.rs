//! The JSON schema of every answer, `docs/schemas/NAME.json`.
//!
//! A schema is found from the answers themselves: the commands of [`ANSWERS`] are run, and the
//! shape that all their objects have is the schema. A member is required if every object has it. An
//! object whose keys are names of a netlist, see [`MAPS`], has one shape for all its members.
//! Other members may be added: a schema refuses none.
//! `LPTN_BLESS=1 cargo test -p lptn-cli --test all schemas::` writes the schemas; without it they
//! are compared, so an answer cannot change its shape unnoticed.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Map, Value, json};

/// The answer, the page that describes it, and commands that give it.
const ANSWERS: [(&str, &str, &[&str]); 20] = [
    (
        "run",
        "outputs.md",
        &[
            "run networks/gearbox.toml --balance steel",
            "run networks/candidates/fan.toml --uncertainty linear --set 'P_loss=223 ± 20 W'",
            "run networks/candidates/fan.toml --uncertainty sobol --samples 64 --set 'P_loss=223 ± 20 W'",
            "run networks/candidates/bare.toml",
            "run networks/drive_cycle.toml --stop 10min",
            "run networks/natural_convection.toml",
            "run networks/melting.toml",
            "run networks/lap/lap.toml",
            "run networks/gearbox_parts.toml",
            "run networks/gearbox.toml --certify",
        ],
    ),
    (
        "steady",
        "outputs.md",
        &[
            "steady networks/gearbox.toml --balance steel",
            "steady networks/candidates/bare.toml",
            "steady networks/natural_convection.toml",
            "steady networks/gearbox_parts.toml",
            "steady networks/gearbox.toml --certify",
            "steady networks/drive_cycle.toml",
        ],
    ),
    (
        "cycle",
        "periodic.md",
        &[
            "steady networks/duty_cycle.toml --periodic --balance body",
            "steady networks/room_heavy.toml --periodic",
            "steady networks/lap/lap.toml --periodic",
            "steady networks/welding_gun.toml --periodic --certify",
        ],
    ),
    ("check", "outputs.md", &["check networks/gearbox.toml", "check networks/gearbox_parts.toml"]),
    (
        "compare",
        "compare.md",
        &[
            "compare networks/candidates",
            "compare networks/candidates networks/gearbox.toml --uncertainty",
            "compare networks/duty_cycle.toml networks/room_heavy.toml --periodic",
        ],
    ),
    (
        "size",
        "size.md",
        &[
            "size networks/candidates/fan.toml",
            "size networks/fuel_cell_fan.toml",
            "size networks/lap/lap.toml",
            "size networks/candidates/fan.toml --certify",
        ],
    ),
    ("sweep", "sweep.md", &["sweep crates/lptn-cli/tests/three_curves.toml --threads 1"]),
    (
        "rank",
        "rank.md",
        &[
            "rank networks/gearbox.toml",
            "rank networks/gearbox_fan.toml --over run",
            "rank networks/natural_convection.toml",
        ],
    ),
    (
        "reduce",
        "reduce.md",
        &[
            "reduce networks/gearbox.toml --port steel",
            "reduce networks/gearbox.toml --port steel --bias --error 0.1K --power 300W",
            "reduce networks/gearbox.toml --port steel --max-error 0.3K",
            "reduce networks/gearbox_parts.toml --port steel --at steady",
        ],
    ),
    (
        "reduce-keep",
        "reduce.md",
        &[
            "reduce networks/gearbox.toml --keep steel,aluminium",
            "reduce networks/rc_ladder.toml --keep n1,n8",
        ],
    ),
    (
        "impedance",
        "impedance.md",
        &[
            "impedance networks/gearbox.toml --port steel --duty 0.5,0.1",
            "impedance networks/rc_ladder.toml --port n8 --to n1 --time 1s,10s",
        ],
    ),
    (
        "impedance-omega",
        "impedance.md",
        &["impedance networks/rc_ladder.toml --port n8 --to n1 --omega '0 rad/s, 1 mHz'"],
    ),
    (
        "modes",
        "verify.md",
        &["modes networks/gearbox.toml", "modes networks/gearbox_parts.toml --at steady"],
    ),
    ("verify", "verify.md", &["verify networks/gearbox.toml"]),
    (
        "fit-step",
        "fit-step.md",
        &[
            "fit step docs/records/synthetic_ring.csv --column ring",
            "fit step networks/records/synthetic_gearbox/7000rpm_a.csv --column ring_gear \
             --column housing",
        ],
    ),
    (
        "fit-law",
        "fit-law.md",
        &[
            "fit law networks/records/synthetic_gearbox --capacity '2659 J/K ± 5 %'",
            "fit law networks/records/synthetic_gearbox --column ring_gear --reference initial \
             --capacity '2659 J/K ± 5 %'",
        ],
    ),
    (
        "fit-network",
        "fit-network.md",
        &["fit network docs/cups.toml", "fit network docs/gearbox_sensors.toml"],
    ),
    ("fit-compare", "fit-compare.md", &["fit compare docs/skins.toml docs/cold_cups.toml"]),
    ("infer", "infer.md", &["infer docs/bench.toml", "infer docs/power.toml"]),
    ("plan", "plan.md", &["plan docs/gearbox_plan.toml"]),
];

/// Objects whose keys are names of a netlist or codes, by the end of their path.
const MAPS: [&str; 29] = [
    ".proven",
    ".proven_heat",
    ".values",
    ".limits",
    ".sources",
    ".boundaries",
    ".streams",
    ".stored",
    ".nodes",
    ".windows",
    ".not_checked",
    ".parameters",
    ".extremes",
    ".failed",
    ".columns",
    ".results",
    ".boundary_weights",
    ".source_weights",
    ".shape",
    ".participation",
    ".projected.any_load",
    ".correlation",
    ".correlation.*",
    ".sensors",
    ".standard_errors",
    ".known",
    ".wanted",
    ".most_by",
    ".whiteness",
];

/// The same by their whole path.
const ROOT_MAPS: [&str; 2] = [".systematic", ".signals"];

/// The values that are seen at one place.
#[derive(Default)]
struct Shape {
    types: Vec<&'static str>,
    objects: usize,
    /// In the order of the answer, each with how many objects have it.
    members: Vec<(String, usize, Shape)>,
    items: Option<Box<Shape>>,
    /// The members of a map.
    each: Option<Box<Shape>>,
}

impl Shape {
    /// Sees a value at a path such as `.nodes[].any_load`.
    fn see(&mut self, path: &str, value: &Value) {
        let kind = match value {
            Value::Null => "null",
            Value::Bool(_) => "boolean",
            Value::Number(_) => "number",
            Value::String(_) => "string",
            Value::Array(_) => "array",
            Value::Object(_) => "object",
        };
        if !self.types.contains(&kind) {
            self.types.push(kind);
        }
        match value {
            Value::Array(items) => {
                let shape = self.items.get_or_insert_default();
                let path = format!("{path}[]");
                items.iter().for_each(|item| shape.see(&path, item));
            }
            Value::Object(members) if is_map(path) => {
                let (shape, path) = (self.each.get_or_insert_default(), format!("{path}.*"));
                members.values().for_each(|member| shape.see(&path, member));
            }
            Value::Object(members) => self.see_members(path, members),
            _ => {}
        }
    }

    fn see_members(&mut self, path: &str, members: &Map<String, Value>) {
        self.objects += 1;
        for (name, value) in members {
            let known = self.members.iter().position(|(own, ..)| own == name);
            let at = known.unwrap_or_else(|| {
                self.members.push((name.clone(), 0, Self::default()));
                self.members.len() - 1
            });
            self.members[at].1 += 1;
            self.members[at].2.see(&format!("{path}.{name}"), value);
        }
    }

    fn schema(&self) -> Value {
        let mut types = self.types.clone();
        // a number that is not known is null
        if types.contains(&"number") && !types.contains(&"null") {
            types.push("null");
        }
        types.sort_unstable();
        if types == ["null"] {
            return json!({}); // never there in these answers, so its shape is not known
        }
        let mut schema = Map::new();
        match types.as_slice() {
            [only] => drop(schema.insert("type".into(), json!(only))),
            _ => drop(schema.insert("type".into(), json!(types))),
        }
        if self.objects > 0 {
            if let Some(quantity) = self.quantity(&types) {
                return quantity;
            }
            let own = self.members.iter().map(|(name, _, shape)| (name.clone(), shape.schema()));
            schema.insert("properties".into(), own.collect::<Map<_, _>>().into());
            let always = self.members.iter().filter(|(_, seen, _)| *seen == self.objects);
            let always: Vec<&str> = always.map(|(name, ..)| name.as_str()).collect();
            schema.insert("required".into(), json!(always));
        }
        if let Some(each) = self.each.as_ref().filter(|each| !each.types.is_empty()) {
            schema.insert("additionalProperties".into(), each.schema());
        }
        if let Some(items) = self.items.as_ref().filter(|items| !items.types.is_empty()) {
            schema.insert("items".into(), items.schema());
        }
        schema.into()
    }

    /// A value with its unit.
    fn quantity(&self, types: &[&str]) -> Option<Value> {
        let names: Vec<&str> = self.members.iter().map(|(name, ..)| name.as_str()).collect();
        let reference = json!({ "$ref": "#/$defs/quantity" });
        match (names.as_slice(), types) {
            (["value", "unit"], ["object"]) => Some(reference),
            (["value", "unit"], ["null", "object"]) => {
                Some(json!({ "anyOf": [reference, { "type": "null" }] }))
            }
            _ => None,
        }
    }
}

fn is_map(path: &str) -> bool {
    MAPS.iter().any(|end| path.ends_with(end)) || ROOT_MAPS.contains(&path)
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// What a command answers.
fn answer(command: &str) -> Value {
    let program = env!("CARGO_BIN_EXE_lptn");
    let files = if command.starts_with("check") { "" } else { "--no-files" };
    let line = format!("'{program}' {command} {files} --format json -q");
    let output = Command::new("sh").args(["-c", &line]).current_dir(root()).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let why = || format!("{command}: {}", String::from_utf8_lossy(&output.stderr));
    assert!(matches!(output.status.code(), Some(0 | 1)), "{}", why());
    serde_json::from_str(&text).unwrap_or_else(|_| panic!("{}", why()))
}

/// The schema of what these commands answer.
fn schema(name: &str, commands: &[&str]) -> String {
    let mut shape = Shape::default();
    commands.iter().for_each(|command| shape.see("", &answer(command)));
    let mut schema = shape.schema();
    let members = schema.as_object_mut().unwrap();
    // doubts have one shape everywhere, whether there are some here or not
    let properties = members["properties"].as_object_mut().unwrap();
    for list in ["warnings", "errors", "doubts"] {
        if let Some(own) = properties.get_mut(list).filter(|own| own["type"] == "array") {
            *own = json!({ "type": "array", "items": { "$ref": "#/$defs/diagnostic" } });
        }
    }
    let mut whole = Map::new();
    whole.insert("$schema".into(), json!("https://json-schema.org/draft/2020-12/schema"));
    whole.insert("title".into(), json!(format!("answer of lptn: {name}")));
    whole.append(members);
    whole.insert("$defs".into(), definitions());
    format!("{:#}\n", Value::Object(whole))
}

/// A quantity, and a doubt or error: see docs/outputs.md.
fn definitions() -> Value {
    let text = || json!({ "type": "string" });
    let count = || json!({ "type": "integer", "minimum": 1 });
    let place = json!({
        "type": "object",
        "properties": {
            "file": text(), "line": count(), "column": count(), "end_line": count(),
            "end_column": count(), "text": text(), "label": text(), "primary": { "type": "boolean" },
        },
    });
    json!({
        "quantity": {
            "type": "object",
            "properties": { "value": { "type": ["number", "null"] }, "unit": text() },
            "required": ["value", "unit"],
        },
        "diagnostic": {
            "type": "object",
            "properties": {
                "severity": { "enum": ["error", "warning"] },
                "code": text(),
                "message": text(),
                "places": { "type": "array", "items": place },
                "help": { "type": ["string", "null"] },
                "fix": { "type": ["object", "null"] },
                "notes": { "type": "array", "items": text() },
            },
            "required": ["severity", "code", "message", "places", "help", "fix", "notes"],
        },
    })
}

#[test]
fn every_answer_has_its_schema_on_its_page() {
    let bless = std::env::var_os("LPTN_BLESS").is_some();
    let docs = root().join("docs");
    let mut wrong = BTreeMap::new();
    for (name, page, commands) in ANSWERS {
        let found = schema(name, commands);
        let file = docs.join("schemas").join(format!("{name}.json"));
        if bless {
            std::fs::create_dir_all(file.parent().unwrap()).unwrap();
            std::fs::write(&file, &found).unwrap();
        }
        if std::fs::read_to_string(&file).unwrap_or_default() != found {
            wrong.insert(name, "its answer has another shape: LPTN_BLESS=1 writes the schema");
        }
        let text = std::fs::read_to_string(docs.join(page)).unwrap();
        if !text.contains(&format!("(schemas/{name}.json)")) {
            wrong.insert(name, "its page has no link to the schema");
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
