//! Faces of which no one lies inside the other: the parts that overhang have no contact.

use lptn_data::Diagnostic;
use lptn_network::{Field, Item, Network};
use lptn_units::format_six as short;

use crate::source_map::SourceMap;

/// Lengths are rounded to a few digits.
const WHOLE: f64 = 1.0 - 1e-3;

/// A warning for each path between two faces that both overhang, unless it gives their common area.
pub(crate) fn warnings(network: &Network, map: &SourceMap) -> Vec<Diagnostic> {
    let paths = network.face_path_ids().zip(network.face_paths());
    let area = |item: Item| Field::of_law("area").and_then(|area| map.get(item, area));
    let open = paths.filter(|(id, _)| area(Item::FacePath(*id)).is_none());
    let both = open.filter_map(|(id, path)| {
        let [from, to] = network.touching(id).filter(|shares| shares.iter().all(|s| *s < WHOLE))?;
        let names = [path.from, path.to].map(|terminal| network.terminal_name(terminal));
        let item = Item::FacePath(id);
        let message = format!(
            "`{}` joins {} % of `{}` to {} % of `{}`: the rest of both has no contact",
            path.name,
            short(100.0 * from),
            names[0],
            short(100.0 * to),
            names[1]
        );
        let problem = Diagnostic::warning("network::overhang", message);
        Some(problem.at(map.nearest(item, Field::To), "").help(
            "check `size` of both bodies, `offset` and `axes`; give the common `area` if it is meant",
        ))
    });
    both.collect()
}
