//! Names that are taken by a part of another item: `plate.z1` is a face of the grid `plate`,
//! `steel.T` the temperature of a node.

use crate::build_error::BuildError;
use crate::error::BuildErrorKind;
use crate::id::{
    BoundaryId, CapacitorId, ConductorId, FacePathId, GridId, Item, LimitId, NodeId, SourceId,
};
use crate::parts::Parts;
use crate::parts::grid::{Face, GridFace};
use crate::parts::grid_value::GridValue;

/// Reports the names that mean two things.
pub(crate) fn names(parts: &Parts, errors: &mut Vec<BuildError>) {
    if !parts.grids.is_empty() {
        for item in elements(parts).filter(|item| parts.whole(*item).is_none()) {
            let name = parts.name_of(item);
            let whole = grid_around(parts, &name).filter(|_| !is_end_of_rod(parts, item));
            errors.extend(whole.map(|whole| inside(&name, item, whole)));
        }
    }
    let mut values: Vec<(&String, Item)> =
        parts.value_names.iter().map(|(name, item)| (name, *item)).collect();
    values.retain(|(name, _)| name.contains('.'));
    values.sort_unstable();
    for (name, item) in values {
        errors.extend(result_of(parts, name).map(|whole| inside(name, item, whole)));
    }
}

fn inside(name: &str, item: Item, whole: Item) -> BuildError {
    BuildError { kind: BuildErrorKind::NameInside { item, whole }, name: name.to_owned() }
}

fn elements(parts: &Parts) -> impl Iterator<Item = Item> {
    let nodes = (0..parts.nodes.len()).map(|i| Item::Node(NodeId::from_len(i)));
    let boundaries = (0..parts.boundaries.len()).map(|i| Item::Boundary(BoundaryId::from_len(i)));
    let capacitors = (0..parts.capacitors.len()).map(|i| Item::Capacitor(CapacitorId::from_len(i)));
    let conductors = (0..parts.conductors.len()).map(|i| Item::Conductor(ConductorId::from_len(i)));
    let sources = (0..parts.sources.len()).map(|i| Item::Source(SourceId::from_len(i)));
    let limits = (0..parts.limits.len()).map(|i| Item::Limit(LimitId::from_len(i)));
    let grids = (0..parts.grids.len()).map(|i| Item::Grid(GridId::from_len(i)));
    let joints = (0..parts.face_paths.len()).map(|i| Item::FacePath(FacePathId::from_len(i)));
    nodes
        .chain(boundaries)
        .chain(capacitors)
        .chain(conductors)
        .chain(sources)
        .chain(limits)
        .chain(grids)
        .chain(joints)
}

/// The grid whose name this one begins with, as those of its cells and faces do.
fn grid_around(parts: &Parts, name: &str) -> Option<Item> {
    let ends = name.match_indices(['.', '[']).map(|(at, _)| at);
    let mut items = ends.filter_map(|end| parts.item(name.get(..end)?));
    items.find(|item| matches!(item, Item::Grid(_)))
}

/// True if it is the one surface of a face: a node with the name of the face.
fn is_end_of_rod(parts: &Parts, item: Item) -> bool {
    let Item::Node(id) = item else { return false };
    let mut faces = parts.grids.iter().flat_map(|grid| Face::ALL.map(|face| (grid, face)));
    faces.any(|(grid, face)| grid.surfaces(face).any(|surface| surface == id))
}

/// The element one of whose results has this name in an expression.
fn result_of(parts: &Parts, name: &str) -> Option<Item> {
    let (base, ending) = name.rsplit_once('.')?;
    if let Some(value) = parts.grid_value(name) {
        return Some(Item::Grid(match value {
            GridValue::Mean(id) | GridValue::Min(id) | GridValue::Max(id) => id,
            GridValue::Face(GridFace { grid, .. }) => grid,
            GridValue::Patch(patch) => patch.at.grid,
        }));
    }
    let item = parts.item(base)?;
    let is_end = matches!(item, Item::Node(_) | Item::Boundary(_));
    ((is_end && ending == "T") || parts.heat(name).is_some()).then_some(item)
}
