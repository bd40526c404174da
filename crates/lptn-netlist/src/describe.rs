//! What the network's builder found, said about the file.

use lptn_data::{Diagnostic, Span};
use lptn_network::{BuildError, BuildErrorKind as Kind, Field, Item, NodeId, Say};

use crate::source_map::SourceMap;
use crate::vocabulary::MINIMAL;

/// The error with its places in the file.
pub(crate) fn describe(error: &BuildError, map: &SourceMap) -> Diagnostic {
    let say = Say::with(&error.name, map);
    let diagnostic = Diagnostic::error(error.code(), error.kind.message(&say));
    let diagnostic = places(diagnostic, error, map);
    let whole = matches!(error.kind, Kind::Empty)
        .then(|| format!("add a section [node]; {MINIMAL}").trim_end().to_owned());
    match imported(error, map).or(whole).or_else(|| error.kind.help(&say)) {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}

fn places(diagnostic: Diagnostic, error: &BuildError, map: &SourceMap) -> Diagnostic {
    let also = |d: Diagnostic, span: Option<Span>, text: &str| match span {
        Some(span) => d.also(span, text),
        None => d,
    };
    match &error.kind {
        Kind::DuplicateName { .. } => match map.duplicate(&error.kind) {
            Some((first, second)) => diagnostic.at(second, "named again").also(first, "first named here"),
            None => diagnostic,
        },
        Kind::NameInside { item, whole } => {
            let grid = if matches!(whole, Item::Grid(_)) { "the grid" } else { "the element" };
            also(at(diagnostic, map.name(*item), "named here"), map.name(*whole), grid)
        }
        Kind::FloatingIsland { nodes, .. } => island(diagnostic, nodes, map),
        Kind::Evaluation { item, field, error } => match map.part(*item, *field, &error.span()) {
            Some(span) => diagnostic.at(span, ""),
            None => at(diagnostic, map.nearest(*item, *field), ""),
        },
        Kind::ThresholdsCrossed { control, fields: [on, off], .. } => {
            let item = Item::Control(*control);
            let diagnostic = at(diagnostic, map.nearest(item, *on), "on");
            also(diagnostic, map.get(item, *off), "off")
        }
        Kind::MasslessWithCapacity { node } => {
            let item = Item::Node(*node);
            let capacity = map.get(item, Field::Capacity);
            let capacity = capacity
                .or_else(|| map.get(item, Field::Material))
                .or_else(|| map.capacitor_of(*node).cloned());
            let diagnostic = at(diagnostic, map.name(item), "declared massless");
            also(diagnostic, capacity, "given a capacity here")
        }
        Kind::SelfLink { conductor } => {
            let item = Item::Conductor(*conductor);
            let diagnostic = at(diagnostic, map.get(item, Field::To), "the same place");
            also(diagnostic, map.get(item, Field::From), "leads from here")
        }
        Kind::FaceArea { item, face, .. } => {
            let diagnostic = at(
                diagnostic,
                Field::of_law("area").and_then(|area| map.get(*item, area)),
                "not the area of the face",
            );
            also(diagnostic, map.get(Item::Grid(face.grid), Field::Size), "which is as large as this says")
        }
        Kind::FaceCells { item, faces, .. } | Kind::FaceSides { item, faces, .. } => {
            let field = if matches!(error.kind, Kind::FaceCells { .. }) { Field::Cells } else { Field::Size };
            let diagnostic = at(diagnostic, map.get(*item, Field::To), "");
            let [a, b] = faces.map(|face| map.get(Item::Grid(face.grid), field));
            also(also(diagnostic, a, "from this grid"), b, "to this grid")
        }
        kind => match error.place() {
            Some((item, field)) => at(diagnostic, map.nearest(item, field), label(kind)),
            None => at(diagnostic, map.top().cloned(), ""),
        },
    }
}

fn at(diagnostic: Diagnostic, span: Option<Span>, text: &str) -> Diagnostic {
    match span {
        Some(span) => diagnostic.at(span, text),
        None => diagnostic,
    }
}

fn label(kind: &Kind) -> &'static str {
    match kind {
        Kind::NoCapacity { .. } => "no `C`, and no [capacitor] belongs to it",
        Kind::NoInitialTemperature { .. } => "no `T0` here, and none in [default]",
        Kind::SourceIntoBoundary { .. } => "a boundary",
        _ => "",
    }
}

/// Every node of the island, as far as a reader can take them in.
fn island(mut diagnostic: Diagnostic, nodes: &[NodeId], map: &SourceMap) -> Diagnostic {
    for (n, span) in nodes.iter().take(8).filter_map(|node| map.name(Item::Node(*node))).enumerate() {
        diagnostic = if n == 0 {
            diagnostic.at(span, "not determined")
        } else {
            diagnostic.also(span, "connected to it")
        };
    }
    diagnostic
}

/// What to do about a row, where it is not what to do about a field.
fn imported(error: &BuildError, map: &SourceMap) -> Option<String> {
    error.place().filter(|(item, _)| map.is_imported(*item))?;
    Some(match &error.kind {
        Kind::NotPositive { field: Field::Capacity, value, .. } if value.abs() < f64::MIN_POSITIVE => {
            "leave the cell empty for a node that stores nothing".to_owned()
        }
        Kind::NoInitialTemperature { .. } => {
            "fill in the column `T0`, or add `T0 = \"25 degC\"` to [default]".to_owned()
        }
        _ => return None,
    })
}
