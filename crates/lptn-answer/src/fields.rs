//! The temperatures in the grids of a network as sections of a report: slices through the hottest
//! cell, over time if several instants are known.

use lptn_graph::{GridField, Shades, slice};
use lptn_network::GridId;
use lptn_plot::Scene;
use lptn_report::{Piece, Section};
use lptn_solve::Snapshot;
use lptn_units::Unit;

use crate::input::Input;

/// Most grids that are drawn.
const MOST_GRIDS: usize = 4;

/// Cells of all frames together, at most: a page has to be sent.
const MOST_CELLS: usize = 20_000;

/// Most instants of one field.
pub(crate) const MOST_FRAMES: usize = 12;

/// A section for each grid. The instants are in order, each with its name.
pub(crate) fn sections(input: &Input, unit: &Unit, states: &[(String, Snapshot)]) -> Vec<Section> {
    let grids = input.netlist.network.grid_ids().take(MOST_GRIDS);
    grids.filter_map(|id| section(input, unit, (id, states))).collect()
}

fn section(
    input: &Input,
    unit: &Unit,
    (id, states): (GridId, &[(String, Snapshot)]),
) -> Option<Section> {
    let network = &input.netlist.network;
    let cells = network.grids()[id.index()].cells.iter().product::<usize>().max(1);
    let frames = (MOST_CELLS / cells).clamp(1, MOST_FRAMES);
    let step = states.len().saturating_sub(1).div_ceil(frames.saturating_sub(1).max(1)).max(1);
    let last = states.len().checked_sub(1)?;
    let shown = |i: usize| if frames == 1 { i == last } else { (last - i).is_multiple_of(step) };
    let fields: Vec<(&str, GridField)> = (0..states.len())
        .filter(|i| shown(*i))
        .map(|i| (states[i].0.as_str(), GridField::of(network, id, Some(&states[i].1))))
        .collect();
    let spans = fields.iter().map(|(_, field)| field.span());
    let span = spans.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    let shades = Shades { span: Some(span), tips: fields.len() == 1 };
    let (_, end) = fields.last()?;
    let drawn = |cut| {
        let scene = |(time, field): &(&str, GridField)| -> (String, Scene) {
            ((*time).to_owned(), slice(field, cut, ("", unit), shades))
        };
        Piece::Frames(fields.iter().map(scene).collect())
    };
    let pieces: Vec<Piece> = end.cuts().into_iter().map(drawn).collect();
    let title = format!("Temperatures in {}", end.name);
    (!pieces.is_empty()).then_some(Section { title, pieces, folded: false })
}
