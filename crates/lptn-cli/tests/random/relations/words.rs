//! Other names, another order, other units, another beginning of time.

use super::Variant;
use crate::random::model::{Entry, Field, Net, Piece, Side, base, expression, piece, wrapped};
use crate::random::random::Random;
use crate::random::units::{Kind, Number};

/// Every element, signal, table, parameter and so on has another name.
#[allow(clippy::unnecessary_wraps, reason = "a relation")]
pub fn renamed(net: &Net, random: &mut Random) -> Option<Variant> {
    let mut variant = Variant::of(net);
    for entry in variant.net.entries.iter_mut().filter(|entry| !entry.name.is_empty()) {
        let stem = random.pick(&["z", "Alpha_", "_q", "node", "W_m_K", "kelvin_"]);
        let name = format!("{stem}{}", variant.names.len());
        let before = std::mem::replace(&mut entry.name, name.clone());
        variant.names.insert(before, name);
    }
    let names = Variant { names: variant.names.clone(), ..Variant::default() };
    variant.net.names(&mut |name| *name = names.renamed(name));
    Some(variant)
}

/// Sections, entries and keys in another order and another form.
#[allow(clippy::unnecessary_wraps, reason = "a relation")]
pub fn reordered(net: &Net, random: &mut Random) -> Option<Variant> {
    let mut variant = Variant::of(net);
    random.shuffle(&mut variant.net.entries);
    for entry in &mut variant.net.entries {
        random.shuffle(&mut entry.fields);
        let table = entry.fields.iter().all(|(key, _)| !key.is_empty());
        entry.long = table && random.chance(0.5);
        for (_, field) in &mut entry.fields {
            if let Field::Shares(shares) = field {
                shares.reverse();
            }
        }
    }
    Some(variant)
}

/// Fields that may hold `"300 K"`.
const KELVIN: [(&str, &str); 9] = [
    ("node", "T0"),
    ("boundary", "T"),
    ("material", "solidus"),
    ("material", "liquidus"),
    ("advection", "flow_T"),
    ("control", "on_above"),
    ("control", "off_below"),
    ("control", "on_below"),
    ("control", "off_above"),
];

/// Every number in another unit, resistances as conductances and the other way round.
#[allow(clippy::unnecessary_wraps, reason = "a relation")]
pub fn changed_units(net: &Net, random: &mut Random) -> Option<Variant> {
    let mut variant = Variant::of(net);
    for entry in &mut variant.net.entries {
        if entry.kind() == "resistor" {
            inverse(entry);
        }
        let kind = entry.kind().to_owned();
        for (key, field) in &mut entry.fields {
            let kelvin =
                KELVIN.contains(&(&kind, key)) && matches!(field, Field::Value(v) if v.len() == 1);
            field.numbers(&mut |number| number.unit = other_unit(number, kelvin, random));
        }
    }
    for (_, side) in &mut variant.net.sides {
        let Side::Numbers(columns) = side else { continue };
        for (_, numbers) in columns {
            let unit = other_unit(&numbers[0], false, random);
            numbers.iter_mut().for_each(|number| number.unit = unit);
        }
    }
    Some(variant)
}

fn other_unit(number: &Number, kelvin: bool, random: &mut Random) -> usize {
    let all = number.kind.units().len();
    random.below(if number.kind == Kind::Temperature && !kelvin { all - 1 } else { all })
}

/// `R` as `G`, and the other way round. One that can be zero stays.
fn inverse(entry: &mut Entry) {
    for (key, field) in &mut entry.fields {
        let (other, kind) = match &**key {
            "R" => ("G", Kind::Conductance),
            "G" => ("R", Kind::Resistance),
            _ => continue,
        };
        let Field::Value(pieces) = field else { continue };
        let zero =
            pieces.iter().any(|piece| matches!(piece, Piece::Text(text) if text.contains("(1/4)")));
        if zero {
            continue;
        }
        *pieces = match &pieces[..] {
            [Piece::Number(number)] => vec![piece(1.0 / number.value, kind)],
            pieces => wrapped("1 / {value}", pieces, []),
        };
        *key = other.to_owned();
    }
}

/// All times later by the same.
#[allow(clippy::unnecessary_wraps, reason = "a relation")]
pub fn later_start(net: &Net, random: &mut Random) -> Option<Variant> {
    let shift = if random.chance(0.5) { 3600.0 } else { random.decades(10.0, 1e5) };
    let mut variant = Variant { shift, ..Variant::of(net) };
    let later = |number: &mut Number| {
        if number.kind == Kind::Instant {
            number.value += shift;
        }
    };
    variant.net.fields(&mut |field| {
        field.numbers(&mut { later });
        field.values(&mut |pieces| {
            *pieces = pieces.iter().cloned().flat_map(|one| earlier(one, shift)).collect()
        });
    });
    for (_, side) in &mut variant.net.sides {
        if let Side::Numbers(columns) = side {
            columns.iter_mut().flat_map(|(_, numbers)| numbers).for_each(later);
        }
    }
    Some(variant)
}

/// `t - shift` for `t`.
fn earlier(one: Piece, shift: f64) -> Vec<Piece> {
    match one {
        Piece::Time => expression("({} - {})", [Piece::Time, piece(shift, Kind::Time)]),
        other => vec![other],
    }
}

/// Whether a value does not depend on temperatures.
pub fn over_time_only(net: &Net, pieces: &[Piece]) -> bool {
    pieces.iter().all(|piece| match piece {
        Piece::Text(text) => !text.contains('T'),
        Piece::Name(name) => {
            !name.ends_with(".T")
                && net.entry(base(name)).is_none_or(|entry| entry.kind() != "node")
        }
        _ => true,
    })
}
