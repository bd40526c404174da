//! `[use.NAME]`: template, count, connections and parameters.

use lptn_data::{Diagnostic, list, nearest};

use super::USE;
use super::definition::{Parameter, Template};
use crate::fields::{Fields, Owner, wrong_shape};
use crate::raw::{RawEntry, RawKind, RawTable, RawValue};

/// In a name of the last entry of a list: the instance before.
pub(super) const BEFORE: &str = "[*-1]";

/// Most instances of a netlist, nested ones included.
pub(super) const MOST_INSTANCES: usize = 1_000_000;

/// The contents of a use, checked against its template.
#[derive(Debug)]
pub(super) struct Plan<'r> {
    pub(super) template: &'r Template<'r>,
    /// The position of the template.
    pub(super) position: usize,
    pub(super) count: Option<usize>,
    /// For each port its connection: one value, or one for each instance.
    pub(super) connect: Vec<(&'r str, Vec<RawValue>)>,
    /// The parameters that are set, in the same way.
    pub(super) set: Vec<(&'r Parameter<'r>, Vec<RawValue>)>,
}

/// The value of one of several instances; a single value applies to all.
pub(super) fn of_instance(values: &[RawValue], number: usize) -> Option<&RawValue> {
    if values.len() == 1 { values.first() } else { values.get(number) }
}

/// Reads the line of a use; `None` after an error, which is reported, or if its template is broken.
pub(super) fn plan<'r>(
    templates: &'r [Template<'r>],
    entry: &RawEntry,
    problems: &mut Vec<Diagnostic>,
) -> Option<Plan<'r>> {
    let before = problems.len();
    let owner = Owner::element(USE.name, &entry.key);
    let fields = Fields::of(&USE, owner, entry, problems)?;
    let raw = fields.require("template", problems)?;
    let name = fields.text("template", raw, problems)?;
    let Some(position) = templates.iter().position(|template| template.name() == name) else {
        problems.push(unknown_template(templates, &fields, (name, raw)));
        return None;
    };
    let template = templates.get(position).filter(|template| !template.broken)?;
    let count = fields.get("count").map(|raw| count(&fields, raw, problems));
    let connect = connections(template, &fields, count.flatten(), problems);
    let set = settings(template, &fields, count.flatten(), problems);
    let open = template.parameters.iter().filter(|parameter| {
        !parameter.default && !set.iter().any(|(given, _)| given.entry.key == parameter.entry.key)
    });
    if fields.complete && !set_is_wrong(&fields) {
        problems.extend(open.map(|parameter| not_set(&fields, parameter)));
    }
    let count = match count {
        Some(count) => Some(count?),
        None => None,
    };
    (problems.len() == before).then_some(Plan { template, position, count, connect, set })
}

fn set_is_wrong(fields: &Fields<'_>) -> bool {
    fields.get("set").is_some_and(|raw| !matches!(raw.kind, RawKind::Table(_)))
}

/// The members of `connect` or `set`.
fn members<'a>(
    fields: &Fields<'a>,
    key: &str,
    problems: &mut Vec<Diagnostic>,
) -> Option<&'a RawTable> {
    let raw = fields.get(key)?;
    let RawKind::Table(table) = &raw.kind else {
        problems.push(fields.wrong_shape(key, raw, "a table"));
        return None;
    };
    Some(table)
}

fn count(fields: &Fields<'_>, raw: &RawValue, problems: &mut Vec<Diagnostic>) -> Option<usize> {
    let words = fields.owner.field("count");
    let wrong =
        |message: String, help: &str| Diagnostic::wrong("netlist::count", message, &raw.span, help);
    let number = match &raw.kind {
        RawKind::Integer(number) => number.replace('_', ""),
        RawKind::Float(number) => number.clone(),
        RawKind::String { .. } => {
            let message = format!("{words} has to be a whole number, got a string");
            let help = "write the number itself, `count = 3`: parameters do not change the \
                elements of a network";
            problems.push(wrong(message, help));
            return None;
        }
        kind => {
            let message = format!("{words} has to be a whole number, got {}", kind.with_article());
            problems.push(wrong(message, "write it like this: `count = 3`"));
            return None;
        }
    };
    problems.push(match number.parse::<i64>() {
        Ok(count) if count > 0 && count.unsigned_abs() <= MOST_INSTANCES as u64 => {
            return usize::try_from(count).ok();
        }
        Ok(0) => wrong(
            format!("{words} is 0"),
            "make it 1 or more, or leave the use out; without `count` there is one instance, \
             without an index",
        ),
        Ok(count) if count < 0 => wrong(format!("{words} is {count}"), "make it 1 or more"),
        Err(_) if matches!(raw.kind, RawKind::Float(_)) => wrong(
            format!("{words} has to be a whole number, got {number}"),
            "write it like this: `count = 3`",
        ),
        _ => wrong(
            format!("{words} is {number}, more than {MOST_INSTANCES}"),
            "are there zeros too many?",
        ),
    });
    None
}

/// One value, or one for each instance.
fn values(
    words: &str,
    raw: &RawValue,
    count: Option<usize>,
    problems: &mut Vec<Diagnostic>,
) -> Vec<RawValue> {
    let RawKind::Array(list) = &raw.kind else { return vec![raw.clone()] };
    let wanted = count.unwrap_or(1);
    if let (Some(all), true) = (chained(list, wanted), count.is_some()) {
        return all;
    }
    if list.len() == wanted && count.is_some() {
        return list.clone();
    }
    let has = if list.len() == 1 { "1 value".to_owned() } else { format!("{} values", list.len()) };
    let message = match count {
        None => format!("{words} is a list, but there is one instance without an index"),
        Some(1) => format!("{words} has {has}, but there is 1 instance"),
        Some(count) => format!("{words} has {has}, but there are {count} instances"),
    };
    let problem = Diagnostic::error("netlist::list_length", message).at(raw.span.clone(), "");
    problems
        .push(problem.help("give one value for each instance in order, or a single one for all"));
    vec![raw.clone()]
}

/// A list that ends with a rule, `cell[*-1].out`: the instance before, for each that follows.
fn chained(list: &[RawValue], wanted: usize) -> Option<Vec<RawValue>> {
    let (rule, first) = list.split_last().filter(|(_, first)| !first.is_empty())?;
    let RawKind::String { text, .. } = &rule.kind else { return None };
    if !text.contains(BEFORE) || first.len() > wanted {
        return None;
    }
    let follows = (first.len()..wanted).map(|before| {
        let text = text.replace(BEFORE, &format!("[{before}]"));
        RawValue { span: rule.span.clone(), kind: RawKind::String { text, start: None } }
    });
    Some(first.iter().cloned().chain(follows).collect())
}

fn connections<'r>(
    template: &'r Template<'r>,
    fields: &Fields<'_>,
    count: Option<usize>,
    problems: &mut Vec<Diagnostic>,
) -> Vec<(&'r str, Vec<RawValue>)> {
    let table = members(fields, "connect", problems);
    let readable = table.is_some() || fields.get("connect").is_none();
    let entries = table.map_or(&[][..], |table| &table.entries);
    let known: Vec<&str> = template.ports.iter().map(|(port, _)| *port).collect();
    let owner = fields.owner.inside("connect");
    let mut found = Vec::new();
    for entry in entries {
        let Some(port) = known.iter().find(|port| **port == entry.key) else {
            let give = format!("port = [\"{}\"]", entry.key);
            problems.push(unknown(
                (template, entry),
                ("port", &known),
                (&owner, "connects"),
                &give,
            ));
            continue;
        };
        let given = values(&owner.field(&entry.key), &entry.value, count, problems);
        for value in given.iter().filter(|value| !matches!(value.kind, RawKind::String { .. })) {
            let example = format!("connect = {{ {port} = \"name of a node or boundary\" }}");
            problems.push(wrong_shape(&owner.field(&entry.key), value, "a string", &example));
        }
        found.push((*port, given));
    }
    // a port that is misspelt is not missing as well
    let misspelt = entries.len() > found.len();
    let missing: Vec<&str> =
        known.into_iter().filter(|port| !found.iter().any(|(given, _)| given == port)).collect();
    if !missing.is_empty() && fields.complete && readable && !misspelt {
        problems.push(missing_port(template, fields, &missing));
    }
    found
}

fn settings<'r>(
    template: &'r Template<'r>,
    fields: &Fields<'_>,
    count: Option<usize>,
    problems: &mut Vec<Diagnostic>,
) -> Vec<(&'r Parameter<'r>, Vec<RawValue>)> {
    let table = members(fields, "set", problems);
    let owner = fields.owner.inside("set");
    let mut found = Vec::new();
    for entry in table.map_or(&[][..], |table| &table.entries) {
        match template.parameter(&entry.key) {
            Some(parameter) => {
                found.push((
                    parameter,
                    values(&owner.field(&entry.key), &entry.value, count, problems),
                ));
            }
            None => {
                let known: Vec<&str> =
                    template.parameters.iter().map(|p| p.entry.key.as_str()).collect();
                let give = format!("param = {{ {} = \"..\" }}", entry.key);
                problems.push(unknown(
                    (template, entry),
                    ("parameter", &known),
                    (&owner, "gives"),
                    &give,
                ));
            }
        }
    }
    found
}

fn unknown_template(
    templates: &[Template<'_>],
    fields: &Fields<'_>,
    (name, raw): (&str, &RawValue),
) -> Diagnostic {
    let message =
        format!("no template named `{name}`, which {} refers to", fields.owner.field("template"));
    let problem = Diagnostic::error("netlist::unknown_template", message).at(raw.span.clone(), "");
    let names: Vec<&str> = templates.iter().map(Template::name).collect();
    problem.help(match names.as_slice() {
        [] => format!("write it, for example {}", example(name)),
        names => nearest(name, names.iter().copied(), "the templates are"),
    })
}

fn example(name: &str) -> String {
    format!(
        "`[template.{name}]` with `port = [\"in\", \"out\"]`, then its elements below \
         `[template.{name}.node]`"
    )
}

/// Error for a port or parameter that a template does not have; `give` shows how to add it.
fn unknown(
    (template, entry): (&Template<'_>, &RawEntry),
    (what, known): (&str, &[&str]),
    (owner, does): (&Owner<'_>, &str),
    give: &str,
) -> Diagnostic {
    let (name, words) = (&entry.key, owner.words());
    let message =
        format!("template `{}` has no {what} `{name}`, which {words} {does}", template.name());
    let help = match known {
        [] => format!("give the template the {what}: `{give}`"),
        known => nearest(name, known.iter().copied(), &format!("its {what}s are")),
    };
    Diagnostic::error(
        if what == "port" { "netlist::unknown_port" } else { "netlist::unknown_parameter" },
        message,
    )
    .at(entry.key_span.clone(), format!("no such {what}"))
    .also(template.entry.key_span.clone(), "the template")
    .help(help)
}

fn missing_port(template: &Template<'_>, fields: &Fields<'_>, missing: &[&str]) -> Diagnostic {
    let ports = if missing.len() == 1 { "port" } else { "ports" };
    let message = format!("{} does not connect {ports} {}", fields.owner.words(), list(missing));
    let lines: Vec<String> = missing.iter().map(|port| format!("{port} = \"..\"")).collect();
    let mut problem = Diagnostic::error("netlist::missing_port", message)
        .at(fields.place.clone(), "not connected");
    if let Some((_, value)) = template.ports.iter().find(|(port, _)| missing.contains(port)) {
        problem = problem.also(value.span.clone(), "a port of the template");
    }
    problem.help(format!("name its node or boundary: `connect = {{ {} }}`", lines.join(", ")))
}

fn not_set(fields: &Fields<'_>, parameter: &Parameter<'_>) -> Diagnostic {
    let name = &parameter.entry.key;
    let message =
        format!("{} does not set `{name}`, which has no default value", fields.owner.words());
    let unit = parameter.ty.map_or_else(String::new, |ty| match ty.usual_unit() {
        unit if unit == "1" => String::new(),
        unit => format!(" {unit}"),
    });
    Diagnostic::error("netlist::parameter_not_set", message)
        .at(fields.place.clone(), format!("`{name}` is missing"))
        .also(parameter.entry.key_span.clone(), "to be set wherever the template is used")
        .help(format!("add `set = {{ {name} = \"1{unit}\" }}` with its value"))
}
