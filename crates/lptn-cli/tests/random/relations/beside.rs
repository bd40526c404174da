//! What stands beside a network and must not change it.

use super::Variant;
use crate::random::model::{Entry, Field, Net, Piece, constant, expression, piece};
use crate::random::random::Random;
use crate::random::units::Kind;

/// Nodes that lead elsewhere: some at rest, one that cools.
#[allow(clippy::unnecessary_wraps, reason = "a relation")]
pub fn idle_nodes(net: &Net, random: &mut Random) -> Option<Variant> {
    let mut variant = Variant::of(net);
    let room = Entry::new("boundary", "idle_room").with("T", constant(20.0, Kind::Temperature));
    let mut more = vec![room];
    for i in 0..5 {
        let node = format!("idle_{i}");
        let start = if i == 0 { 60.0 } else { 20.0 };
        let entry =
            Entry::new("node", &node).with("C", constant(random.decades(1.0, 1e3), Kind::Capacity));
        more.push(entry.with("T0", constant(start, Kind::Temperature)));
        let path =
            Entry::new("resistor", &format!("idle_path_{i}")).with("from", Field::Name(node));
        let path = path.with("to", Field::Name("idle_room".into()));
        more.push(path.with("R", constant(random.decades(0.1, 10.0), Kind::Resistance)));
    }
    for entry in more {
        let at = random.below(variant.net.entries.len() + 1);
        variant.net.entries.insert(at, entry);
    }
    Some(variant)
}

/// Reports, windows and limits of heat flows and temperatures.
pub fn more_outputs(net: &Net, random: &mut Random) -> Option<Variant> {
    let mut variant = Variant::of(net);
    let stop = net.run_value("stop");
    let path = net
        .entries
        .iter()
        .find(|entry| entry.end("from").is_some() && entry.kind() != "advection")?;
    let node = net.of("node").next()?;
    let flow = || Piece::Name(format!("{}.Q", path.name));
    let hot = || Piece::Name(format!("{}.T", node.name));
    let wave = expression(
        "sin(2 * pi * {} / {}) * {}",
        [Piece::Time, piece(0.37 * stop, Kind::Time), flow()],
    );
    let level = constant(random.between(20.0, 60.0), Kind::Temperature);
    let entries = [
        Entry::new("report", "extra_flow").with("", Field::Value(wave)),
        Entry::new("report", "extra_rise")
            .with("", Field::Value(expression("kelvin({}) / 300 [K]", [hot()]))),
        Entry::new("window", "extra_window")
            .with("from", constant(0.11 * stop, Kind::Instant))
            .with("to", constant(0.77 * stop, Kind::Instant)),
        Entry::new("limit", "extra_limit")
            .with("of", Field::Value(vec![hot()]))
            .with("below", level)
            .with("severity", Field::Word("warning".into())),
        Entry::new("limit", "extra_heat")
            .with("of", Field::Value(vec![flow()]))
            .with("above", constant(1.0, Kind::Heat))
            .with("severity", Field::Word("warning".into())),
    ];
    variant.net.entries.extend(entries);
    Some(variant)
}
