//! Proven margins of an answer.

use lptn_netlist::Goal;
use lptn_network::ParameterId;
use lptn_report::Shortest;

use super::page::rounded;
use super::proof::Proof;
use super::single::Sized;
use super::{Asked, Found, SizeAnswer};
use crate::failure::Failure;
use crate::listener::Listener;
use crate::words::spaced;

/// Digits of a value that are tried if the margins of the answer are not proven, the most first.
const DIGITS: [usize; 5] = [10, 9, 8, 7, 6];

/// Values of parameters in SI units.
type Values = Vec<(ParameterId, f64)>;

impl SizeAnswer {
    /// Bounds the margins of the answer with proof.
    pub(super) fn prove(&mut self, listener: &dyn Listener) -> Result<(), Failure> {
        let Some((values, shown)) = self.answer() else { return Ok(()) };
        let certify = |value: &[_]| {
            self.asked().demand(listener, |demand| lptn_study::certify(demand, value))
        };
        let judged = certify(&values)?;
        let mut instead = None;
        if let Found::Single(found) = &self.0 {
            let bounded = judged.proven.iter().all(Option::is_some);
            let open = found.sizing.feasible() && bounded && !judged.is_proven();
            for digits in DIGITS.into_iter().filter(|_| open) {
                let number = outside(found, digits);
                let value = found.unit.to_si(number);
                if is_inside(found, value) && certify(&[(found.parameter, value)])?.is_proven() {
                    let (text, unit) = (Shortest::new().text(number).to_owned(), &found.unit.text);
                    instead = Some((number, format!("{} = {text}{}", found.name, spaced(unit))));
                    break;
                }
            }
        }
        self.asked_mut().kept.proof = Some(Proof { judged, shown, instead });
        Ok(())
    }

    /// The values of the answer and its margins, in SI units; `None` if there is none.
    fn answer(&self) -> Option<(Values, Vec<f64>)> {
        Some(match &self.0 {
            Found::Single(found) => {
                let trial = &found.sizing.trial;
                (vec![(found.parameter, trial.value)], trial.judged.margins.clone())
            }
            Found::Several(found) => (found.values(), found.margins().to_vec()),
            Found::Choice(found) => (found.best_values()?, found.best_margins()?.to_vec()),
        })
    }

    fn asked_mut(&mut self) -> &mut Asked {
        match &mut self.0 {
            Found::Single(found) => &mut found.asked,
            Found::Several(found) => &mut found.asked,
            Found::Choice(found) => &mut found.asked,
        }
    }
}

/// A value with this number of digits, moved to the side on which everything is kept.
fn outside(found: &Sized, digits: usize) -> f64 {
    let value = found.unit.from_si(found.sizing.trial.value);
    let up = found.asked.study.goal == Goal::Minimise;
    let away = 2.0 * value.abs() * 0.1_f64.powi(i32::try_from(digits).unwrap_or(1));
    rounded(if up { value + away } else { value - away }, digits, up)
}

fn is_inside(found: &Sized, value: f64) -> bool {
    (found.range.0..=found.range.1).contains(&value)
}
