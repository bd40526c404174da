//! The tables of a page of `docs/elements`, from the declarations of a kind and its laws.

use lptn_laws::{Confidence, FieldDeclaration, Group, Kind, LawDeclaration, Range, Substance};
use lptn_units::Type;

fn unit(ty: Type) -> String {
    match ty {
        ty if ty.absolute => "degC, K".to_owned(),
        ty if ty.is_scalar() => String::new(),
        ty => ty.dimension.si_unit(),
    }
}

fn unit_of(field: &FieldDeclaration) -> String {
    match field.ty {
        ty if ty.absolute || ty.is_scalar() => unit(ty),
        _ => field.unit().0,
    }
}

/// A value in the unit of the page, without the rounding of its conversion.
fn in_unit(field: &FieldDeclaration, si: f64) -> f64 {
    match field.unit().1 {
        1.0 => si,
        scale => (si / scale * 1e12).round() / 1e12,
    }
}

fn range(range: Range) -> String {
    match range {
        Range::Finite => "of either sign".into(),
        Range::Positive => "above 0".into(),
        Range::NotNegative => "at least 0".into(),
        Range::Fraction => "above 0, at most 1".into(),
        Range::Temperature => "absolute".into(),
        Range::Degrees(from, to) => format!("between {from} and {to} degrees"),
        Range::Count => "whole, at least 1".into(),
    }
}

/// Where a law holds, with the numbers that say it.
fn holds(law: &LawDeclaration) -> String {
    let group = |group: &Group| {
        let number = |value: f64| match value {
            value if value != 0.0 && !(1e-2..1e4).contains(&value) => format!("{value:e}"),
            value => value.to_string(),
        };
        let name = format!("{} ({})", group.name, group.meaning);
        match (group.from, group.to) {
            (0.0, to) => format!("{name} at most {}", number(to)),
            (from, f64::INFINITY) => format!("{name} at least {}", number(from)),
            (from, to) => format!("{name} from {} to {}", number(from), number(to)),
        }
    };
    let groups: Vec<String> = law.groups.iter().map(group).collect();
    if groups.is_empty() {
        law.validity.into()
    } else {
        format!("{} {}.", law.validity, groups.join("; "))
    }
}

fn source(law: &LawDeclaration) -> String {
    let unsure = law.confidence == Confidence::Medium;
    format!("{}{}", law.source, if unsure { " (**unverified constants**)" } else { "" })
}

/// What a page says of a law.
fn row(kind: Kind, declared: &LawDeclaration) -> String {
    // a fluid gives all its properties
    let key = |field: &FieldDeclaration| match field.property {
        Some(Substance::Fluid) => Substance::Fluid.key(),
        _ => field.key,
    };
    let mut keys: Vec<&str> = declared.fields.iter().map(key).collect();
    let pair = declared.fields.windows(2).any(|two| two[0].key == two[1].key);
    keys.dedup();
    let chosen = kind.declaration().selector.filter(|_| declared.named);
    let chosen = chosen.map(|key| format!("`{key} = \"{}\"`", declared.name));
    let keys = keys.iter().map(|key| format!("`{key}`"));
    let keys: Vec<String> = chosen.into_iter().chain(keys).collect();
    let of = if declared.carries.is_of_fluid() { "`fluid`, " } else { "" };
    let pair = if pair { " (a list of two)" } else { "" };
    // a bar of an amount would end the cell
    let cell = |text: &str| text.replace('|', "\\|");
    format!(
        "| {of}{}{pair} | {} | {} | {} |",
        keys.join(", "),
        cell(declared.equation),
        cell(&holds(declared)),
        cell(&source(declared))
    )
}

/// The row of the keys for faces of grids.
fn at_faces(kind: Kind) -> Option<String> {
    match kind {
        Kind::Contact | Kind::Resistor | Kind::Conduction | Kind::Convection => {
            let of = "of two faces of blocks: their [place on each other]\
                (../grids.md#bodies-that-meet-in-part)";
            Some(format!("| `offset`, `axes` | {of} | m | | one middle |"))
        }
        Kind::Advection => {
            let of =
                "a [face along which it flows](../grids.md#a-stream-along-a-face), and the axis";
            Some(format!("| `along`, `direction` | {of} | | | |"))
        }
        _ => None,
    }
}

/// The rows of the keys. Laws may have different meanings for one key: they share a row if unit, range
/// and default are the same.
fn key_rows(kind: Kind) -> Vec<String> {
    let mut known: Vec<&str> = Vec::new();
    let mut rows: Vec<(String, String, String)> = Vec::new();
    for field in kind.laws().flat_map(|law| law.declaration().fields) {
        if known.contains(&field.meaning) {
            continue;
        }
        known.push(field.meaning);
        let or = field.property.map_or(String::new(), |of| format!(" or `{}`", of.key()));
        let key = format!("`{}`{or}", field.key);
        let default =
            field.default.map_or(String::new(), |value| format!(" {}", in_unit(field, value)));
        let rest = format!("{} | {} |{default} |", unit_of(field), range(field.range));
        match rows.iter_mut().find(|(of, _, same)| *of == key && *same == rest) {
            Some((_, meanings, _)) => *meanings += &format!("; {}", field.meaning),
            None => rows.push((key, field.meaning.to_owned(), rest)),
        }
    }
    rows.iter().map(|(key, meanings, rest)| format!("| {key} | {meanings} | {rest}")).collect()
}

/// What a page says of keys and laws.
pub(crate) fn tables(kind: Kind) -> String {
    let mut lines = vec![
        "| Key | Meaning | Unit | Range | Default |".to_owned(),
        "|---|---|---|---|---|".to_owned(),
    ];
    let ends = if kind.is_stream() { "" } else { ", or faces of a grid" };
    lines.push(match kind.is_source() {
        true => "| `into` | a node, a grid, a face, or `{ a = 0.6, b = 0.4 }` | | | |".to_owned(),
        false => format!("| `from`, `to` | two nodes or boundaries{ends} | | | |"),
    });
    lines.extend(at_faces(kind));
    if kind.laws().any(|law| law.declaration().carries.is_of_fluid()) {
        let of = "a [fluid](material.md) of the file or of the library: `air`, `water`, \
            `gear_oil_vg220`, …";
        lines.push(format!("| `fluid` | {of} | | | |"));
    }
    if let Some(selector) = kind.declaration().selector {
        let mut words: Vec<String> = Vec::new();
        for word in kind.laws_named(true).map(|law| format!("`{}`", law.declaration().name)) {
            if !words.contains(&word) {
                words.push(word);
            }
        }
        lines.push(format!("| `{selector}` | the law: {} | | | |", words.join(", ")));
    }
    lines.extend(key_rows(kind));
    lines.push(String::new());
    lines.push("| Given by | Law | Holds | Source |".to_owned());
    lines.push("|---|---|---|---|".to_owned());
    lines.extend(kind.laws().map(|law| row(kind, law.declaration())));
    let mut told: Vec<String> = Vec::new();
    for result in kind.laws().flat_map(|law| law.result_declarations()) {
        let unit = unit(result.ty);
        let row = format!("| `NAME.{}` | {} | {unit} |", result.key, result.meaning);
        told.extend((!told.contains(&row)).then_some(row));
    }
    if !told.is_empty() {
        lines.extend(["", "| Result | Meaning | Unit |", "|---|---|---|"].map(str::to_owned));
    }
    lines.extend(told);
    lines.join("\n") + "\n"
}
