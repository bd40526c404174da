//! A ranking as a picture: a line for each value, those that do most.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Moment, Panel};
use lptn_solve::Influence;

use super::RankAnswer;
use crate::words::difference;

/// Values that are shown.
const MOST: usize = 12;

impl RankAnswer {
    pub(super) fn figure(&self) -> Figure {
        let panels = self.effects().into_iter().filter(|(_, influences)| !influences.is_empty());
        let panels = panels.map(|(name, influences)| self.panel(&format!("{name}s"), &influences));
        let panels = panels.collect();
        let note =
            "for 10 % more of each value, 1 K more of a temperature; of 0, 1 of its unit or \
                    less, for 1 K at most"
                .to_owned();
        Figure { title: self.input.title(), note, panels }
    }

    fn panel(&self, name: &str, influences: &[&Influence]) -> Panel {
        let shown = &influences[..influences.len().min(MOST)];
        let names = shown.iter().map(|influence| self.name(influence)).collect();
        let axes = (Axis::linear(self.node(), difference(&self.unit)), Axis::names(name, names));
        let mut panel = Panel::new(axes.0, axes.1);
        let points = shown.iter().map(|of| self.effect(of)).zip((0..).map(f64::from)).collect();
        panel.curves.push(Curve::line("change", points).looks(Look::Dots));
        panel.moments.push(Moment { name: "none".into(), at: 0.0 });
        panel
    }
}
