//! One path as several.

use super::Variant;
use super::words::over_time_only;
use crate::random::model::{Entry, Field, Net, Piece, piece, wrapped};
use crate::random::random::Random;
use crate::random::units::Kind;

/// Paths whose resistance does not depend on temperatures, each as two through a junction.
pub fn in_series(net: &Net, random: &mut Random) -> Option<Variant> {
    let mut variant = Variant::of(net);
    let mut entries = Vec::new();
    for entry in &net.entries {
        let part = random.between(0.1, 0.9);
        let (Some(key), true) = (resistive(net, entry), random.chance(0.7)) else {
            entries.push(entry.clone());
            continue;
        };
        let name = &entry.name;
        let [one, two, joint] = ["a", "b", "joint"].map(|end| format!("{name}_{end}"));
        let half = |name: &str, part: f64| {
            let mut half = entry.clone();
            half.name = name.to_owned();
            let part = if key == "G" { 1.0 / part } else { part };
            scale(half.get_mut(key).expect("its key"), part);
            half
        };
        let (mut first, mut second) = (half(&one, part), half(&two, 1.0 - part));
        *first.get_mut("to")? = Field::Name(joint.clone());
        *second.get_mut("from")? = Field::Name(joint.clone());
        let section = entry.section.replace(entry.kind(), "node");
        let node = Entry { included: entry.included, ..Entry::new(&section, &joint) };
        entries.extend([first, second, node.with("massless", Field::Raw("true".into()))]);
        variant.parts.insert(name.clone(), (vec![one, two], false));
    }
    variant.net.entries = entries;
    (!variant.parts.is_empty()).then_some(variant)
}

/// What is proportional to the resistance of a path, or `G`.
fn resistive(net: &Net, entry: &Entry) -> Option<&'static str> {
    let key = match entry.kind() {
        "resistor" => ["R", "G"].into_iter().find(|key| entry.get(key).is_some())?,
        "conduction" => match entry.get("shape")? {
            Field::Word(shape) if shape == "slab" => "thickness",
            Field::Word(shape) if shape == "rod" => "length",
            _ => return None,
        },
        _ => return None,
    };
    let still = ["R", "G", "k"].iter().filter_map(|key| entry.get(key)).all(|field| match field {
        Field::Value(pieces) => over_time_only(net, pieces),
        _ => true,
    });
    still.then_some(key)
}

/// Paths and sources as two side by side.
pub fn in_parallel(net: &Net, random: &mut Random) -> Option<Variant> {
    let mut variant = Variant::of(net);
    let mut entries = Vec::new();
    for entry in &net.entries {
        let part = random.between(0.1, 0.9);
        let (Some(key), true) = (extensive(entry), random.chance(0.7)) else {
            entries.push(entry.clone());
            continue;
        };
        let half = |end: &str, part: f64| {
            let mut half = entry.clone();
            half.name = format!("{}_{end}", entry.name);
            let part = if key == "R" { 1.0 / part } else { part };
            scale(half.get_mut(key).expect("its key"), part);
            half
        };
        let halves = [half("a", part), half("b", 1.0 - part)];
        let names = halves.iter().map(|half| half.name.clone()).collect();
        variant.parts.insert(entry.name.clone(), (names, true));
        entries.extend(halves);
    }
    variant.net.entries = entries;
    (!variant.parts.is_empty()).then_some(variant)
}

/// What is proportional to the heat of a path or source, or `R`.
fn extensive(entry: &Entry) -> Option<&'static str> {
    let keys: &[&'static str] = match entry.kind() {
        "resistor" => &["R", "G"],
        "contact" | "convection" => &["R", "area", "h"],
        "conduction" => &["k"],
        "radiation" => &["Gr", "area"],
        "advection" => &["mcp", "flow"],
        "source" => &["P"],
        _ => return None,
    };
    keys.iter().find(|key| entry.get(key).is_some()).copied()
}

/// A value times a number.
pub fn scale(field: &mut Field, by: f64) {
    let Field::Value(pieces) = field else { return };
    *pieces = match &pieces[..] {
        [Piece::Number(number)] => {
            let mut number = *number;
            number.value *= by;
            vec![Piece::Number(number)]
        }
        pieces => wrapped("{value} * {}", pieces, [piece(by, Kind::Plain)]),
    };
}
