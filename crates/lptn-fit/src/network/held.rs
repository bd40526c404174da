//! Assumed values of instruments, and the dependence of a run on them.

use lptn_units::{Dimension, Type};

use crate::network::recorded::Held;
use crate::network::task::{Instrument, MeasuredRun, NetworkFitTask};
use crate::network::unknown::{Unknown, UnknownOf};

impl Held {
    const IDEAL: Self = Self { offset: 0.0, gain: 1.0, lag: 0.0 };

    /// Prior values of an instrument.
    pub(crate) fn of(instrument: Option<&Instrument>) -> Self {
        let own = |instrument: &Instrument| Self {
            offset: instrument.offset.value,
            gain: instrument.gain.value,
            lag: instrument.lag.value,
        };
        instrument.map_or(Self::IDEAL, own)
    }
}

impl NetworkFitTask {
    /// Assumed values of an instrument in a record, with these values of the unknowns.
    pub(crate) fn held(
        &self,
        (sensor, run): (Option<usize>, usize),
        (unknowns, values): (&[Unknown], &[f64]),
    ) -> Held {
        let mut held = Held::of(sensor.and_then(|sensor| self.sensors.get(sensor)));
        for (unknown, &value) in unknowns.iter().zip(values) {
            match unknown.of {
                _ if unknown.sensor() != sensor || sensor.is_none() => {}
                UnknownOf::Offset { run: of, .. } if of.is_none_or(|of| of == run) => {
                    held.offset = value;
                }
                UnknownOf::Gain { .. } => held.gain = value,
                UnknownOf::Lag { .. } => held.lag = value,
                UnknownOf::Offset { .. } | UnknownOf::Parameter(_) => {}
            }
        }
        held
    }
}

impl NetworkFitTask {
    /// True if some unknown changes runs by their starts or inputs, so that its derivatives are
    /// differences.
    pub(crate) fn has_inputs_estimated(&self, unknowns: &[Unknown]) -> bool {
        let changes = |run: usize, unknown: &Unknown| self.runs[run].change(run, unknown).is_some();
        (0..self.runs.len()).any(|run| unknowns.iter().any(|unknown| changes(run, unknown)))
    }
}

impl MeasuredRun {
    /// The instruments on which the run itself depends.
    pub(crate) fn behind(&self) -> impl Iterator<Item = usize> + '_ {
        let signals = self.signals.iter().filter_map(|signal| signal.sensor);
        signals.chain(self.initial.iter().filter_map(|start| start.sensor))
    }

    /// Change of an unknown that shows its effect on the run; `None` if the run does not depend on
    /// it, and for parameters. For networks with constant conductances any will do; for others half
    /// a kelvin leaves about five digits.
    pub(crate) fn change(&self, place: usize, unknown: &Unknown) -> Option<f64> {
        const KELVIN: f64 = 0.5;
        const PART: f64 = 1e-3;
        let sensor = unknown.sensor()?;
        let own = match unknown.of {
            UnknownOf::Offset { run, .. } => run.is_none_or(|run| run == place),
            UnknownOf::Gain { .. } => true,
            UnknownOf::Parameter(_) | UnknownOf::Lag { .. } => false,
        };
        if !own || !self.behind().any(|behind| behind == sensor) {
            return None;
        }
        if matches!(unknown.of, UnknownOf::Gain { .. }) {
            return Some(PART);
        }
        if unknown.ty == Type::of(Dimension::TEMPERATURE) {
            return Some(KELVIN);
        }
        let values = self.signals.iter().filter(|s| s.sensor == Some(sensor));
        let size = values.flat_map(|s| &s.values).map(|v| v.abs()).fold(0.0, f64::max);
        Some(if size > 0.0 { PART * size } else { 1.0 })
    }
}

/// The first instrument that a signal follows and whose values are not all known.
pub(crate) fn unknown_input<'s>(
    run: &MeasuredRun,
    sensors: &'s [Instrument],
) -> Option<&'s Instrument> {
    let mut all = run.signals.iter().filter_map(|signal| sensors.get(signal.sensor?));
    all.find(|sensor| sensor.offset.is_estimated() || sensor.gain.is_estimated())
}
