//! Losses of gears as a picture: every part over speed.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Panel};

use super::tables::rpm;
use super::{Block, GearAnswer};
use lptn_study::GearState;

/// Parts that are shown, those that lose most.
const MOST: usize = 8;

impl GearAnswer {
    /// The map of efficiency if there are several torques, and a figure for each load and state of the oil that has several speeds.
    pub(super) fn drawn(&self) -> Vec<Figure> {
        let blocks = self.blocks.iter().filter(|block| block.states.len() > 1);
        self.maps().into_iter().chain(blocks.map(|block| self.figure(block))).collect()
    }

    fn figure(&self, block: &Block) -> Figure {
        let mut panel = Panel::new(Axis::linear("speed", "rpm"), Axis::linear("loss", "W"));
        let points = |of: &dyn Fn(&GearState) -> f64| {
            let mut points: Vec<(f64, f64)> =
                block.states.iter().map(|(speed, state)| (rpm(*speed), of(state))).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points
        };
        panel.curves.push(Curve::line("all", points(&GearState::loss)));
        let first = block.states.first().map_or(&[][..], |(_, state)| &state.losses);
        let peak =
            |at: usize| block.states.iter().map(|(_, s)| s.losses[at].heat).fold(0.0, f64::max);
        let mut order: Vec<usize> = (0..first.len()).collect();
        order.sort_by(|a, b| peak(*b).total_cmp(&peak(*a)));
        for at in order.iter().take(MOST) {
            let part = &first[*at];
            let curve = points(&|state: &GearState| state.losses[*at].heat);
            panel.curves.push(Curve::line(&part.name, curve));
        }
        let left_out = first.len().saturating_sub(MOST);
        let mut note = self.said(block);
        if left_out > 0 {
            note += &format!("; {MOST} of {} parts, those that lose most", first.len());
        }
        Figure { title: self.input.title(), note, panels: vec![panel] }
    }
}
