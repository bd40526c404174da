//! Errors of the network's builder, described for the file.

use lptn_data::{Diagnostic, Span};
use lptn_network::{BuildError, BuildErrorKind as Kind, Field, GridFace, Item, Say};

use crate::format::MINIMAL;
use crate::source_map::SourceMap;

/// The error with its places in the file.
pub(crate) fn describe(error: &BuildError, map: &SourceMap) -> Diagnostic {
    let say = Say::with(&error.name, map);
    let diagnostic = Diagnostic::error(error.code(), error.kind.message(&say));
    let diagnostic = places(diagnostic, error, map);
    let whole = matches!(error.kind, Kind::Empty)
        .then(|| format!("add a section [node]; {MINIMAL}").trim_end().to_owned());
    diagnostic.help(imported(error, map).or(whole).or_else(|| error.kind.help(&say)))
}

fn places(diagnostic: Diagnostic, error: &BuildError, map: &SourceMap) -> Diagnostic {
    match &error.kind {
        Kind::DuplicateName { .. } => match map.duplicate(&error.kind) {
            Some((first, second)) => {
                diagnostic.at(second, "named again").also(first, "first named here")
            }
            None => diagnostic,
        },
        Kind::NameInside { item, whole } => {
            let grid = if matches!(whole, Item::Grid(_)) { "the grid" } else { "the element" };
            diagnostic.at(map.name(*item), "named here").also(map.name(*whole), grid)
        }
        // at most eight nodes of the island, for readability
        Kind::FloatingIsland { nodes, .. } => {
            let spans = nodes.iter().take(8).filter_map(|node| map.name(Item::Node(*node)));
            let texts = ["not determined"].into_iter().chain(std::iter::repeat("connected to it"));
            diagnostic.places(spans.zip(texts.map(str::to_owned)))
        }
        Kind::Evaluation { item, field, error } => {
            let part = map.part(*item, *field, &error.span());
            diagnostic.at(part.or_else(|| map.nearest(*item, *field)), "")
        }
        Kind::ThresholdsCrossed { control, fields: [on, off], .. } => {
            let item = Item::Control(*control);
            diagnostic.at(map.nearest(item, *on), "on").also(map.get(item, *off), "off")
        }
        Kind::MasslessWithCapacity { node } => {
            let item = Item::Node(*node);
            let capacity = map.get(item, Field::Capacity);
            let capacity = capacity
                .or_else(|| map.get(item, Field::Material))
                .or_else(|| map.capacitor_of(*node).cloned());
            diagnostic
                .at(map.name(item), "declared massless")
                .also(capacity, "given a capacity here")
        }
        Kind::SelfLink { conductor } => {
            let item = Item::Conductor(*conductor);
            let diagnostic = diagnostic.at(map.get(item, Field::To), "the same place");
            diagnostic.also(map.get(item, Field::From), "leads from here")
        }
        Kind::FaceArea { item, face, .. } => {
            let area = Field::of_law("area").and_then(|area| map.get(*item, area));
            let size = grid_size(map, *face, false);
            diagnostic
                .at(area, "not the area of the face")
                .also(size, "which is as large as this says")
        }
        Kind::FaceCells { item, faces, .. }
        | Kind::FaceSides { item, faces, .. }
        | Kind::FaceShapes { item, faces, .. }
        | Kind::FacesApart { item, faces, .. }
        | Kind::FacesMoved { item, faces, .. }
        | Kind::FacesMoving { item, faces, .. } => {
            joined_faces(diagnostic, &error.kind, (*item, *faces), map)
        }
        kind => match error.place() {
            Some((item, field)) => diagnostic.at(map.nearest(item, field), label(kind)),
            None => diagnostic.at(map.top().cloned(), ""),
        },
    }
}

/// The places of two faces that cannot be joined.
fn joined_faces(
    diagnostic: Diagnostic,
    kind: &Kind,
    (item, faces): (Item, [GridFace; 2]),
    map: &SourceMap,
) -> Diagnostic {
    let cells = matches!(kind, Kind::FaceCells { .. });
    let [a, b] = faces.map(|face| grid_size(map, face, cells));
    let apart = matches!(kind, Kind::FacesApart { .. });
    let offset = map.get(item, Field::Offset).filter(|_| apart);
    let here = diagnostic.at(offset.or_else(|| map.get(item, Field::To)), "");
    here.also(a, "from this grid").also(b, "to this grid")
}

fn label(kind: &Kind) -> &'static str {
    match kind {
        Kind::NoCapacity { .. } => "no `C`, and no [capacitor] belongs to it",
        Kind::NoInitialTemperature { .. } => "no `T0` here, and none in [default]",
        Kind::SourceIntoBoundary { .. } => "a boundary",
        _ => "",
    }
}

/// The help for a row of an import, if that for a field does not suit it.
fn imported(error: &BuildError, map: &SourceMap) -> Option<String> {
    error.place().filter(|(item, _)| map.is_imported(*item))?;
    Some(match &error.kind {
        Kind::NotPositive { field: Field::Capacity, value, .. }
            if value.abs() < f64::MIN_POSITIVE =>
        {
            "leave the cell empty for a node that stores no heat".to_owned()
        }
        Kind::NoInitialTemperature { .. } => {
            "fill in the column `T0`, or add `T0 = \"25 degC\"` to [default]".to_owned()
        }
        _ => return None,
    })
}

/// The place of the number of cells of a grid, or of its size.
fn grid_size(map: &SourceMap, face: GridFace, cells: bool) -> Option<Span> {
    let of = |field| map.get(Item::Grid(face.grid), field);
    match cells {
        true => of(Field::Cells),
        false => of(Field::Size).or_else(|| of(Field::of_law("r_out")?)),
    }
}
