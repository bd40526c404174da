//! The periodic state of a linear network, mode by mode in closed form.

use lptn_network::Network;

use super::inputs::Inputs;
use super::march::March;
use super::reduced::Reduced;
use super::{ExactError, segments};

/// The state that a cycle of a linear network leads back to.
#[derive(Clone, Debug)]
pub(crate) struct ExactCycle {
    /// Temperature of every node in K; NaN for massless ones.
    pub(crate) temperatures: Vec<f64>,
    /// The part of a disturbance that one cycle leaves over: that of the slowest mode.
    pub(crate) multiplier: f64,
    /// Error of rounding and of the series instead of inputs, in K.
    pub(crate) error: f64,
}

impl ExactCycle {
    /// The cycle from `start` on, both in s. A mean that nothing carries away stays at the
    /// network's own start.
    pub(crate) fn solve(network: &Network, start: f64, period: f64) -> Result<Self, ExactError> {
        let stop = start + period;
        let breakpoints = network.breakpoints(start, stop)?;
        let reduced = Reduced::new(network)?;
        let initial = reduced.initial(network)?;
        let reference = initial.first().copied().unwrap_or(lptn_network::ZERO_CELSIUS);
        let rises: Vec<f64> = initial.iter().map(|t| t - reference).collect();
        let inputs = Inputs::new(network, reference);
        let mut march = March::new(inputs, &reduced, &rises, (period, period))?;
        march.forget();
        for segment in segments(start, stop, &breakpoints) {
            march.enter(segment.inside());
            march.advance(segment.from, segment.to)?;
        }
        march.repeat(period);
        let slowest = march.slowest();
        let mut temperatures = vec![f64::NAN; network.nodes().len()];
        for (id, rise) in reduced.states.iter().zip(march.rises()) {
            temperatures[id.index()] = reference + rise;
        }
        let largest = temperatures.iter().copied().filter(|t| t.is_finite()).fold(0.0, f64::max);
        let each = 4.0 * f64::EPSILON * largest + march.series_error().unwrap_or(0.0);
        let error = each / -(-slowest * period).exp_m1();
        Ok(Self { temperatures, multiplier: (-slowest * period).exp(), error })
    }
}
