//! Comparison of readings with their predictions: a check of the network and its instruments.

use crate::infer::inferred::{InferredColumn, Known};
use crate::infer::model::Model;
use crate::infer::states::UNKNOWN_KELVIN;
use crate::infer::strength::{Noise, Strength};
use crate::kalman::Innovation;

/// Statistics of every column.
pub(crate) fn columns(
    model: &Model,
    strength: &Strength,
    surprises: &[Vec<(usize, Innovation)>],
) -> Vec<InferredColumn> {
    let several = strength.noises.len() > 1;
    let one = |(i, noise): (usize, &Noise)| {
        let at = |(k, moment): (usize, &Vec<(usize, Innovation)>)| {
            let own = moment.iter().filter(|(column, _)| *column == i);
            own.map(|(_, s)| (k, s.residual / s.variance.sqrt())).collect::<Vec<_>>()
        };
        let surprises: Vec<(usize, f64)> = surprises.iter().enumerate().flat_map(at).collect();
        let all: Vec<f64> = surprises.iter().map(|(_, surprise)| *surprise).collect();
        let count = all.len().max(1) as f64;
        let mean = all.iter().sum::<f64>() / count;
        let squares = all.iter().map(|x| x * x).sum::<f64>();
        let neighbours = all.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / squares;
        InferredColumn {
            readings: all.len(),
            surprises,
            sigma: noise.whole(),
            slow: (noise.drift > 0.0).then_some((noise.drift, noise.time)),
            first: all.first().copied().unwrap_or(0.0),
            mean,
            rms: (squares / count).sqrt(),
            neighbours: if neighbours.is_finite() { neighbours } else { 0.0 },
            drift: several.then(|| drift(model, strength, i)),
        }
    };
    strength.noises.iter().enumerate().map(one).collect()
}

/// The drift of a column over the record, as an additional unknown. A steady drift may have been
/// taken for slow noise, so that is left out if the record is likelier then.
fn drift(model: &Model, strength: &Strength, column: usize) -> Known {
    let drifting = model.drifting(column, UNKNOWN_KELVIN);
    let known = |strength: &Strength| {
        let last = drifting.filtered(strength);
        let (value, deviation) = last.state().of(&[(model.states.count(), 1.0)]);
        (last.log_likelihood(), Known { value, deviation })
    };
    let whites = [strength.white(|noise| noise.white), strength.white(Noise::whole)];
    let all = whites.iter().chain([strength]).map(known);
    let best = all.max_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or(Known { value: 0.0, deviation: UNKNOWN_KELVIN }, |(_, known)| known)
}
