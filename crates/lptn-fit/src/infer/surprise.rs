//! Whether readings came as they were expected: what a record says of the network and of its
//! instruments.

use crate::infer::inferred::{InferredColumn, Known};
use crate::infer::model::Model;
use crate::infer::states::UNKNOWN_KELVIN;
use crate::infer::strength::Strength;
use crate::kalman::{Innovation, Smoother};

/// What is told of every column.
pub(crate) fn columns(
    model: &Model,
    strength: &Strength,
    surprises: &[Vec<(usize, Innovation)>],
) -> Vec<InferredColumn> {
    let several = strength.sigmas.len() > 1;
    let one = |(i, sigma): (usize, &f64)| {
        let own = surprises.iter().flatten().filter(|(column, _)| *column == i);
        let all: Vec<f64> = own.map(|(_, s)| s.residual / s.variance.sqrt()).collect();
        let count = all.len().max(1) as f64;
        let mean = all.iter().sum::<f64>() / count;
        let squares = all.iter().map(|x| x * x).sum::<f64>();
        let neighbours = all.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / squares;
        InferredColumn {
            readings: all.len(),
            sigma: *sigma,
            first: all.first().copied().unwrap_or(0.0),
            mean,
            rms: (squares / count).sqrt(),
            neighbours: if neighbours.is_finite() { neighbours } else { 0.0 },
            drift: several.then(|| drift(model, strength, i)),
        }
    };
    strength.sigmas.iter().enumerate().map(one).collect()
}

/// The drift of a column over the record, if it is one more thing that is not known.
fn drift(model: &Model, strength: &Strength, column: usize) -> Known {
    let drifting = model.drifting(column, UNKNOWN_KELVIN);
    let (smoother, _): (Smoother, _) = drifting.smoothed(strength);
    let last = smoother.filter().state();
    let place = last.mean.len() - 1;
    let unit: Vec<f64> = (0..=place).map(|i| if i == place { 1.0 } else { 0.0 }).collect();
    let (value, deviation) = last.of(&unit);
    Known { value, deviation }
}
