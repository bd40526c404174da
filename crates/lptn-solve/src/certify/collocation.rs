//! A better way over a step than the samples of the integrator: the polynomials that obey the
//! balances at all samples.
//!
//! The samples are corrected sweep by sweep, each by one implicit step from sample to sample
//! (spectral deferred correction: A. Dutt, L. Greengard, V. Rokhlin, BIT 40 (2000) 241). How far
//! this goes does not affect the proof: the defect of the result is bounded afterwards.

use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::{FactorError, Pattern};
use lptn_network::Positions;

use super::shifted::{Shifted, power_of_two_above};
use super::way::{SAMPLES, places};

/// Most sweeps over a step.
const SWEEPS: usize = 12;

/// Corrections in K below which rounding decides.
const ROUNDING: f64 = 2e-13;

/// A sweep that corrects less than this share of the first one is the last: the correction is the
/// error of the integrator, of which little may remain.
const LITTLE: f64 = 3e-3;

/// A sweep that corrects more than this share of the last one is the last.
const STALLED: f64 = 0.7;

/// Corrects samples of steps.
pub(super) struct Collocation<'a> {
    system: &'a ThermalSystem,
    /// With the inputs at each sample.
    works: [Workspace; SAMPLES],
    factors: Shifted,
    jacobian: Vec<f64>,
    /// True if the Jacobian is the same everywhere.
    constant: bool,
    flows: [Vec<f64>; SAMPLES],
    right: Vec<f64>,
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
        let count = system.mass().len();
        let mut jacobian = vec![0.0; pattern.len()];
        system.jacobian(&mut jacobian);
        Ok(Self {
            system,
            works: std::array::from_fn(|_| system.workspace()),
            factors: Shifted::new(pattern, system.mass())?,
            jacobian,
            constant: system.is_linear(),
            flows: std::array::from_fn(|_| vec![0.0; count]),
            right: vec![0.0; count],
            weights,
        })
    }

    /// Takes the positions of everything that switches.
    pub(super) fn set_positions(&mut self, positions: &Positions) {
        self.works.iter_mut().for_each(|work| work.set_positions(positions));
    }

    /// Corrects the samples of a step at these times in s, but the first, until a sweep corrects
    /// less than `enough` in K; `None` if the heat has no value at one of them. Afterwards
    /// [`Collocation::flows`] are those of the samples.
    pub(super) fn correct(
        &mut self,
        (times, inside): (&[f64; SAMPLES], f64),
        samples: &mut [Vec<f64>; SAMPLES],
        enough: f64,
    ) -> Option<()> {
        let length = times[SAMPLES - 1] - times[0];
        self.read((times, inside), samples)?;
        let time = if self.constant { 0.25 * power_of_two_above(length) } else { 0.2 * length };
        if !self.constant {
            let (work, state) = (&mut self.works[SAMPLES / 2], &samples[SAMPLES / 2]);
            let form = JacobianForm::Exact;
            self.system.jacobian_at(work, state, form, &mut self.jacobian).ok()?;
        }
        self.factors.set(&self.jacobian);
        self.factors.factorize(time)?;
        let (mut before, mut enough) = (f64::INFINITY, enough);
        for sweep in 0..SWEEPS {
            let corrected = self.sweep(0.5 * length, samples)?;
            (1..SAMPLES).try_for_each(|sample| self.evaluate(sample, samples))?;
            if sweep == 0 {
                enough = enough.min(LITTLE * corrected).max(ROUNDING);
            }
            if corrected <= enough || corrected > STALLED * before {
                break;
            }
            before = corrected;
        }
        Some(())
    }

    /// Takes the flows of samples at these times in s.
    pub(super) fn read(
        &mut self,
        (times, inside): (&[f64; SAMPLES], f64),
        samples: &[Vec<f64>; SAMPLES],
    ) -> Option<()> {
        for (work, time) in self.works.iter_mut().zip(times) {
            self.system.read_inputs(work, *time, inside).ok()?;
        }
        (0..SAMPLES).try_for_each(|sample| self.evaluate(sample, samples))
    }

    /// Heat into each unknown in W at each sample.
    pub(super) fn flows(&self) -> &[Vec<f64>; SAMPLES] {
        &self.flows
    }

    fn evaluate(&mut self, sample: usize, samples: &[Vec<f64>; SAMPLES]) -> Option<()> {
        let (work, flow) = (&mut self.works[sample], &mut self.flows[sample]);
        self.system.flow(work, &samples[sample], flow).ok()
    }

    /// One sweep; gives the largest correction in K.
    fn sweep(&mut self, half: f64, samples: &mut [Vec<f64>; SAMPLES]) -> Option<f64> {
        let mass = self.system.mass();
        let mut most = 0.0_f64;
        for (j, weights) in self.weights.iter().enumerate() {
            for (i, right) in self.right.iter_mut().enumerate() {
                let heat: f64 = weights.iter().zip(&self.flows).map(|(w, flow)| w * flow[i]).sum();
                // from the old sample on, so that shared digits do not matter
                *right = half * heat + mass[i] * (samples[j][i] - samples[j + 1][i]);
            }
            self.factors.solve(&mut self.right)?;
            for (sample, by) in samples[j + 1].iter_mut().zip(&self.right) {
                *sample += by;
                most = most.max(by.abs());
            }
        }
        most.is_finite().then_some(most)
    }
}
