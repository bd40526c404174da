//! Map of efficiency: lines of equal efficiency over speed and torque of the input.

use lptn_plot::Figure;
use lptn_plot::contour::{Lattice, levels};
use lptn_plot::figure::{Axis, Curve, Panel};
use lptn_report::significant;

use super::tables::rpm;
use super::{Block, GearAnswer};

/// Efficiencies in % of which lines are drawn.
const LEVELS: [f64; 19] = [
    10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0, 90.0, 92.0, 94.0, 95.0, 96.0, 97.0, 98.0,
    98.5, 99.0, 99.5,
];

/// Most lines, those of the best efficiencies.
const MOST_LINES: usize = 8;

/// With fewer lines than this, they are at round values of the range instead.
const FEW_LINES: usize = 4;

/// Fewest speeds and torques of a map.
const FEWEST: usize = 3;

impl GearAnswer {
    /// A map for each state of the oil, if there are enough speeds and torques.
    pub(super) fn maps(&self) -> Vec<Figure> {
        let mut states: Vec<Option<f64>> = Vec::new();
        for block in &self.blocks {
            let same = |known: &Option<f64>| {
                known.map(f64::to_bits) == block.temperature.map(f64::to_bits)
            };
            if !states.iter().any(same) {
                states.push(block.temperature);
            }
        }
        states.into_iter().filter_map(|temperature| self.map(temperature)).collect()
    }

    fn map(&self, temperature: Option<f64>) -> Option<Figure> {
        let same =
            |block: &&Block| block.temperature.map(f64::to_bits) == temperature.map(f64::to_bits);
        let torque = |block: &Block| block.states.first()?.1.torque(&self.task());
        let blocks = self.blocks.iter().filter(same);
        let mut rows: Vec<(f64, &Block)> =
            blocks.filter_map(|block| Some((torque(block)?, block))).collect();
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        rows.dedup_by(|a, b| a.0.total_cmp(&b.0).is_eq());
        let field = self.field(&rows)?;
        let mut panel = Panel::new(Axis::linear("speed", "rpm"), Axis::linear("torque", "N m"));
        for level in drawn(&field) {
            let name = format!("{} %", significant(level, 3));
            panel.curves.push(Curve::line(name, field.line(level)));
        }
        let state = match temperature {
            Some(kelvin) => {
                format!(
                    "all nodes at {} {}",
                    significant(self.unit.from_si(kelvin), 6),
                    self.unit.text
                )
            }
            None => "in steady state".to_owned(),
        };
        let (low, high) = ends(&field.values);
        let note =
            format!("efficiency {} to {} %, {state}", significant(low, 3), significant(high, 3));
        (!panel.curves.is_empty()).then(|| Figure {
            title: self.input.title(),
            note,
            panels: vec![panel],
        })
    }

    /// Efficiencies in % over speeds in rpm and torques.
    fn field(&self, rows: &[(f64, &Block)]) -> Option<Lattice> {
        let (_, first) = rows.first()?;
        let mut order: Vec<usize> = (0..first.states.len()).collect();
        order.sort_by(|a, b| first.states[*a].0.total_cmp(&first.states[*b].0));
        order.dedup_by(|a, b| first.states[*a].0.total_cmp(&first.states[*b].0).is_eq());
        if order.len() < FEWEST || rows.len() < FEWEST {
            return None;
        }
        let percent = |block: &Block, at: usize| {
            let efficiency = block.states[at].1.efficiency(&self.task());
            efficiency.map_or(f64::NAN, |efficiency| 100.0 * efficiency)
        };
        let values = rows.iter().flat_map(|(_, block)| order.iter().map(|at| percent(block, *at)));
        Some(Lattice {
            values: values.collect(),
            x: order.iter().map(|at| rpm(first.states[*at].0)).collect(),
            y: rows.iter().map(|(torque, _)| *torque).collect(),
        })
    }
}

/// The levels inside the range of a field.
fn drawn(field: &Lattice) -> Vec<f64> {
    let (low, high) = ends(&field.values);
    let inside: Vec<f64> = LEVELS.into_iter().filter(|l| low < *l && *l < high).collect();
    if inside.len() < FEW_LINES {
        return levels((low, high), MOST_LINES);
    }
    inside[inside.len().saturating_sub(MOST_LINES)..].to_vec()
}

fn ends(values: &[f64]) -> (f64, f64) {
    let known = values.iter().filter(|value| value.is_finite());
    known.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)))
}
