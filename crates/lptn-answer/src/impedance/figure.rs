//! An answer as a picture: the curve as data sheets print it, or amplitude and phase.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Panel};

use super::{Found, ImpedanceAnswer};

impl ImpedanceAnswer {
    pub(super) fn figure(&self) -> Figure {
        let unit = self.unit();
        let ends = match self.name == self.to {
            true => self.to.clone(),
            false => format!("{} to {}", self.name, self.to),
        };
        let title = format!("{}: {ends}", self.input.title());
        match &self.found {
            Found::Step { rows, .. } => {
                let mut panel = Panel::new(Axis::log("time", "s"), Axis::log("rise", unit));
                let curve = |name: &str, of: &dyn Fn(usize) -> f64| {
                    let points = rows.iter().enumerate().map(|(i, row)| (row.time, of(i)));
                    Curve::line(name, points.filter(|(_, rise)| *rise > 0.0).collect())
                };
                panel.curves.push(curve("step", &|i| rows[i].rise));
                for (k, share) in self.shares.iter().enumerate() {
                    panel.curves.push(curve(&format!("D = {share}"), &|i| rows[i].pulses[k]));
                }
                let note = if self.shares.is_empty() {
                    String::new()
                } else {
                    "D: duty cycle of pulses in periodic steady state; rise at the end of a pulse"
                        .to_owned()
                };
                Figure { title, note, panels: vec![panel] }
            }
            Found::Chain(chain) => {
                Figure { title, note: String::new(), panels: vec![self.chain_panel(chain)] }
            }
            Found::Swing(rows) => {
                let swings = || rows.iter().filter(|row| row.omega > 0.0);
                let axis = || Axis::log("angular frequency", "rad/s");
                let mut gain = Panel::new(axis(), Axis::log("amplitude", unit));
                let points = swings().map(|row| (row.omega, row.answer.norm()));
                gain.curves.push(Curve::line(&self.to, points.collect()));
                let mut phase = Panel::new(axis(), Axis::linear("phase", "deg"));
                let points = swings().map(|row| (row.omega, row.answer.arg().to_degrees()));
                phase.curves.push(Curve::line(&self.to, points.collect()));
                Figure { title, note: String::new(), panels: vec![gain, phase] }
            }
        }
    }
}
