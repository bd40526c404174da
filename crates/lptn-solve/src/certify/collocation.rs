//! A better way over a step than the samples of the integrator: the polynomials that obey the
//! balances at all samples.
//!
//! The samples are corrected sweep by sweep, each by one implicit step from sample to sample
//! (spectral deferred correction: A. Dutt, L. Greengard, V. Rokhlin, BIT 40 (2000) 241). How far
//! this goes does not affect the proof: the defect of the result is bounded afterwards.

use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::{FactorError, Pattern};

use super::shifted::{Shifted, power_of_two_above};
use super::way::{SAMPLES, places};

/// Most sweeps over a step.
const SWEEPS: usize = 12;

/// Corrections in K below which rounding decides.
const ROUNDING: f64 = 2e-13;

/// A sweep that corrects more than this share of the last one is the last.
const STALLED: f64 = 0.7;

/// Corrects samples of steps.
pub(super) struct Collocation<'a> {
    system: &'a ThermalSystem,
    work: Workspace,
    factors: Shifted,
    jacobian: Vec<f64>,
    /// For each pair of neighbouring samples the weights of an integral between them, for a step
    /// of length 2.
    weights: [[f64; SAMPLES]; SAMPLES - 1],
}

impl<'a> Collocation<'a> {
    pub(super) fn new(
        system: &'a ThermalSystem,
        pattern: &Pattern,
        basis: &[[f64; SAMPLES]; SAMPLES],
    ) -> Result<Self, FactorError> {
        let places = places::<SAMPLES>();
        let integral = |polynomial: &[f64; SAMPLES], place: f64| {
            let terms = polynomial.iter().enumerate().rev();
            terms.fold(0.0, |sum, (k, c)| sum * place + c / (k + 1) as f64) * place
        };
        let weights = std::array::from_fn(|j| {
            basis.map(|of| integral(&of, places[j + 1]) - integral(&of, places[j]))
        });
        Ok(Self {
            system,
            work: system.workspace(),
            factors: Shifted::new(pattern, system.mass())?,
            jacobian: vec![0.0; system.pattern().entries()],
            weights,
        })
    }

    /// Corrects the samples of a step at these times in s, but the first; `None` if the heat has no
    /// value at one of them.
    pub(super) fn correct(
        &mut self,
        (times, inside): (&[f64; SAMPLES], f64),
        samples: &mut [Vec<f64>],
    ) -> Option<()> {
        let length = times[SAMPLES - 1] - times[0];
        let time = 0.25 * power_of_two_above(length);
        self.linearise((times[SAMPLES / 2], inside), &samples[SAMPLES / 2])?;
        let jacobian = std::mem::take(&mut self.jacobian);
        let known = self.factors.factorize(time, &jacobian);
        self.jacobian = jacobian;
        known?;
        let mut before = f64::INFINITY;
        for _ in 0..SWEEPS {
            let corrected = self.sweep((times, inside), 0.5 * length, samples)?;
            if corrected <= ROUNDING || corrected > STALLED * before {
                break;
            }
            before = corrected;
        }
        Some(())
    }

    /// One sweep; gives the largest correction in K.
    fn sweep(
        &mut self,
        (times, inside): (&[f64; SAMPLES], f64),
        half: f64,
        samples: &mut [Vec<f64>],
    ) -> Option<f64> {
        let count = samples[0].len();
        let mut flows = Vec::with_capacity(SAMPLES);
        for (time, sample) in times.iter().zip(&*samples) {
            let mut flow = vec![0.0; count];
            self.system.read_inputs(&mut self.work, *time, inside).ok()?;
            self.system.flow(&mut self.work, sample, &mut flow).ok()?;
            flows.push(flow);
        }
        let mass = self.system.mass();
        let mut most = 0.0_f64;
        for (j, weights) in self.weights.iter().enumerate() {
            let mut right: Vec<f64> = (0..count)
                .map(|i| {
                    let heat: f64 = weights.iter().zip(&flows).map(|(w, flow)| w * flow[i]).sum();
                    // from the old sample on, so that shared digits do not matter
                    half * heat + mass[i] * (samples[j][i] - samples[j + 1][i])
                })
                .collect();
            self.factors.solve(&mut right)?;
            for (sample, by) in samples[j + 1].iter_mut().zip(&right) {
                *sample += by;
                most = most.max(by.abs());
            }
        }
        most.is_finite().then_some(most)
    }

    fn linearise(&mut self, (time, inside): (f64, f64), state: &[f64]) -> Option<()> {
        if self.system.is_linear() {
            self.system.jacobian(&mut self.jacobian);
            return Some(());
        }
        self.system.read_inputs(&mut self.work, time, inside).ok()?;
        let form = JacobianForm::Exact;
        self.system.jacobian_at(&mut self.work, state, form, &mut self.jacobian).ok()
    }
}
