//! Modes as a picture: participation of each node in each mode.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};

use super::ModesAnswer;

/// Nodes that are shown, those that take most part in any mode.
const MOST: usize = 8;

impl ModesAnswer {
    /// Stems at the time constants of the modes, as high as the part of each node.
    pub(super) fn figure(&self) -> Figure {
        let (modes, nodes) = (self.modes.modes(), self.network().nodes());
        let most =
            |node: usize| modes.iter().map(|mode| mode.participation[node]).fold(0.0, f64::max);
        let mut shown: Vec<usize> = (0..nodes.len()).filter(|node| most(*node) > 0.0).collect();
        shown.sort_by(|&a, &b| most(b).total_cmp(&most(a)));
        let left_out = shown.len().saturating_sub(MOST);
        shown.truncate(MOST);
        let axes = (Axis::log("time constant", "s"), Axis::linear("participation", "%"));
        let mut panel = Panel::new(axes.0, axes.1);
        panel.curves = shown
            .into_iter()
            .map(|node| {
                // the fastest mode is on the left
                let points = modes.iter().rev();
                let points = points.map(|mode| (mode.tau(), 100.0 * mode.participation[node]));
                Curve::line(&nodes[node].name, points.collect()).looks(Look::Stems)
            })
            .collect();
        let note = match left_out {
            0 => String::new(),
            _ => format!("{MOST} of {} nodes, those that take most part", left_out + MOST),
        };
        Figure { title: self.input.title(), note, panels: vec![panel] }
    }
}
