//! The same elements from elsewhere: a template, CSV files, another file.

use std::fmt::Write as _;

use super::Variant;
use crate::random::model::{Entry, Field, Net, Piece, Side, base, number};
use crate::random::random::Random;
use crate::random::units::{Kind, Number};

/// What can be a part of a template.
const PARTS: [&str; 9] = [
    "node",
    "capacitor",
    "resistor",
    "contact",
    "conduction",
    "convection",
    "radiation",
    "advection",
    "source",
];

/// Everything between the boundaries as a template that is used once or twice.
pub fn templated(net: &Net, random: &mut Random) -> Option<Variant> {
    if net.has("template") || net.has("grid") || net.has("import") {
        return None;
    }
    let mut variant = Variant::of(net);
    let count = random.below(3);
    let copies: Vec<String> = match count {
        0 => vec!["copy".to_owned()],
        count => (1..=count).map(|i| format!("copy[{i}]")).collect(),
    };
    let inside = |entry: &&Entry| PARTS.contains(&&*entry.section) || entry.section == "control";
    for entry in net.entries.iter().filter(inside) {
        let names = copies.iter().map(|copy| format!("{copy}.{}", entry.name)).collect();
        variant.parts.insert(entry.name.clone(), (names, false));
    }
    let ports: Vec<String> = net.of("boundary").map(|entry| entry.name.clone()).collect();
    if copies.len() > 1 {
        // what a boundary gives is twice as much
        ports
            .iter()
            .for_each(|port| drop(variant.parts.insert(format!("{port}.Q"), (Vec::new(), false))));
    }
    let (mut set, mut params) = (Vec::new(), Vec::new());
    for entry in &mut variant.net.entries {
        if !inside(&&*entry) {
            outside(entry, &variant.parts);
            continue;
        }
        if let Some(c) = entry.constant("C").filter(|_| random.chance(0.5)) {
            let name = format!("set_{}", entry.name);
            let unit = Field::Table(vec![("unit".into(), Field::Word("J/K".into()))]);
            params.push((name.clone(), unit));
            set.push((name.clone(), Field::Value(vec![Piece::Number(c)])));
            *entry.get_mut("C")? = Field::Value(vec![Piece::Name(name)]);
        }
        entry.section = format!("template.part.{}", entry.section);
    }
    let list = ports.iter().map(|port| Field::Name(port.clone())).collect();
    let head = Entry::new("template.part", "").with("port", Field::List(list));
    let head = head.with("param", Field::Links(params));
    let links = ports.iter().map(|port| (port.clone(), Field::Name(port.clone()))).collect();
    let mut used = Entry::new("use", "copy").with("template", Field::Word("part".into()));
    used = used.with("connect", Field::Links(links)).with("set", Field::Links(set));
    if count > 0 {
        used = used.with("count", Field::Raw(count.to_string()));
    }
    variant.net.entries.extend([head, used]);
    Some(variant)
}

/// Names of what is inside now, as they are called from outside.
fn outside(entry: &mut Entry, parts: &std::collections::BTreeMap<String, (Vec<String>, bool)>) {
    for (_, field) in &mut entry.fields {
        field.names(&mut |name| {
            if let Some((copies, _)) =
                parts.get(base(name)).filter(|(copies, _)| !copies.is_empty())
            {
                *name = format!("{}{}", copies[0], &name[base(name).len()..]);
            }
        });
    }
}

/// What is constant, from CSV files.
pub fn imported(net: &Net, random: &mut Random) -> Option<Variant> {
    if net.has("template") || net.has("import") {
        return None;
    }
    let mut variant = Variant::of(net);
    let mut rows: [Vec<String>; 4] = [const { Vec::new() }; 4];
    let chosen: Vec<Option<(usize, String)>> =
        net.entries.iter().map(|entry| row(entry).filter(|_| random.chance(0.7))).collect();
    variant.net.entries.clear();
    for (entry, row) in net.entries.iter().zip(chosen) {
        let Some((file, row)) = row else {
            variant.net.entries.push(entry.clone());
            continue;
        };
        rows[file].push(row);
        if file > 1 {
            variant.parts.insert(entry.name.clone(), (Vec::new(), false));
        }
    }
    let mut import = Entry::new("import", "");
    let heads =
        ["name,C [kJ/K],T0 [degF]", "name,T [degC]", "from,to,G [W/K],name", "into,P [mW],name"];
    let keys = ["nodes", "boundaries", "conductors", "sources"];
    for ((key, head), rows) in
        keys.iter().zip(heads).zip(&rows).filter(|(_, rows)| !rows.is_empty())
    {
        let mut text = format!("{head}\n");
        for row in rows {
            let _ = writeln!(text, "{row}");
        }
        variant.net.sides.push((format!("{key}.csv"), Side::Text(text)));
        import = import.with(key, Field::Word(format!("{key}.csv")));
    }
    let any = !import.fields.is_empty();
    variant.net.entries.push(import);
    any.then_some(variant)
}

/// The file that an entry can stand in, and its row there.
fn row(entry: &Entry) -> Option<(usize, String)> {
    let name = &entry.name;
    let only = |keys: &[&str]| entry.fields.iter().all(|(key, _)| keys.contains(&&**key));
    let bare = |found: Number, unit: usize| Number { unit, ..found }.bare();
    match &*entry.section {
        "node" if only(&["C", "T0"]) => {
            let (c, start) = (entry.constant("C")?, entry.constant("T0")?);
            Some((0, format!("{name},{},{}", bare(c, 1), bare(start, 1))))
        }
        "node" if only(&["massless"]) => Some((0, format!("{name},,"))),
        "boundary" => Some((1, format!("{name},{}", bare(entry.constant("T")?, 0)))),
        "resistor" => {
            let g = match (entry.constant("R"), entry.constant("G")) {
                (Some(r), _) => number(1.0 / r.value, Kind::Conductance),
                (_, g) => g?,
            };
            let plain =
                |end: &str| entry.end(end).filter(|end| base(end) == *end).map(str::to_owned);
            Some((2, format!("{},{},{},{name}", plain("from")?, plain("to")?, g.bare())))
        }
        "source" => {
            let into =
                entry.end("into").filter(|into| base(into) == *into && into.starts_with('n'))?;
            Some((3, format!("{into},{},{name}", bare(entry.constant("P")?, 2))))
        }
        _ => None,
    }
}

/// Some entries in a file that is included.
#[allow(clippy::unnecessary_wraps, reason = "a relation")]
pub fn included(net: &Net, random: &mut Random) -> Option<Variant> {
    let mut variant = Variant::of(net);
    for entry in &mut variant.net.entries {
        let stays = ["run", "report", "window", "template.part", "import"];
        entry.included = !stays.contains(&&*entry.section) && random.chance(0.5);
    }
    Some(variant)
}
