//! A reduction as a picture: the step response of the network and of its pairs.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_reduce::{Dynamics, Pair};

use super::ReduceAnswer;

/// Times at which the curves are drawn, evenly by their logarithms.
const POINTS: i32 = 240;

/// From a share of the slowest time constant on, up to a multiple of it.
const FROM: f64 = 1e-3;
const TO: f64 = 8.0;

/// Height of the panel of errors.
const ERRORS: f64 = 0.6;

impl ReduceAnswer {
    /// The rise for 1 W at the port over time, and by how much each pair misses it.
    pub(super) fn figure(&self, dynamics: &Dynamics) -> Option<Figure> {
        let (step, port) = (dynamics.step.as_ref()?, &self.port);
        let slowest = step.slowest().tau;
        let ratio = (TO / FROM).powf(f64::from(POINTS).recip());
        let times = (0..=POINTS).map(|i| FROM * slowest * ratio.powi(i));
        let times: Vec<f64> = times.filter(|time| time.is_finite()).collect();
        let of = |value: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
            times.iter().map(|&time| (time, value(time))).collect()
        };
        let axis = || Axis::log("time", "s");
        let mut rises = Panel::new(axis(), Axis::linear("rise for 1 W", "K/W"));
        let mut errors = Panel::new(axis(), Axis::linear("pair \u{2212} network", "K/W"));
        errors.share = ERRORS;
        rises.curves.push(Curve::line("network", of(&|time| step.value(time))));
        for (place, pair) in (1..).zip(&dynamics.pairs) {
            let name = pair.definition.key().replace('_', " ");
            let rise = |time| of_pair(pair, step.resistance, time);
            rises.curves.push(Curve::line(&name, of(&rise)).looks(Look::Dashed));
            let miss = of(&|time| rise(time) - step.value(time));
            errors.curves.push(Curve::line(&name, miss).as_place(place));
        }
        let recommended = dynamics.recommended.definition.key().replace('_', " ");
        Some(Figure {
            title: format!("{}, seen from {port}", self.input.title()),
            note: format!("{}; nearest: {recommended}", self.verdict()),
            panels: vec![rises, errors],
        })
    }
}

/// The rise of a pair for 1 W: `R (1 - exp(-t / (R C)))`.
fn of_pair(pair: &Pair, resistance: f64, time: f64) -> f64 {
    resistance * -(-time / (resistance * pair.capacity)).exp_m1()
}
