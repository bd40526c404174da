//! Estimates of every moment from all readings.

use std::rc::Rc;

use lptn_integrate::vectors::{add, dot};

use super::{
    Fade, Filter, Gaussian, Innovation, Reading, Step, Transition, Weights, multiplied, weighed,
};

/// Takes readings in and stores the data for the way back.
#[derive(Clone, Debug)]
pub struct Smoother {
    filter: Filter,
    moments: Vec<Moment>,
}

/// A moment: the state before its readings, the step to it, and its readings.
#[derive(Clone, Debug)]
struct Moment {
    before: Gaussian,
    /// The step to it from the moment before, if there is one.
    way: Option<Way>,
    readings: Vec<Taken>,
}

/// Change of the filter by a change of the first state.
#[derive(Clone, Debug)]
pub(super) struct Moved {
    /// The means of each moment before its readings.
    pub(super) means: Vec<Vec<f64>>,
    /// The residuals of the readings of each moment.
    pub(super) residuals: Vec<Vec<f64>>,
}

#[derive(Clone, Debug)]
struct Way {
    transition: Rc<Transition>,
    fades: Rc<Vec<Fade>>,
}

#[derive(Clone, Debug)]
struct Taken {
    of: Rc<Weights>,
    gain: Vec<f64>,
    innovation: Innovation,
}

impl Smoother {
    /// Begins at the first moment, with the state before its readings.
    pub fn new(state: Gaussian) -> Self {
        let first = Moment { before: state.clone(), way: None, readings: Vec::new() };
        Self { filter: Filter::new(state), moments: vec![first] }
    }

    /// The filter after the last reading.
    pub fn filter(&self) -> &Filter {
        &self.filter
    }

    /// Goes on to the next moment.
    pub fn predict(&mut self, step: &Step) {
        self.filter.predict(step);
        let (transition, fades) = (Rc::clone(&step.transition), Rc::clone(&step.fades));
        self.moments.push(Moment {
            before: self.filter.state().clone(),
            way: Some(Way { transition, fades }),
            readings: Vec::new(),
        });
    }

    /// Takes a reading of the moment in.
    pub fn update(&mut self, reading: &Reading) -> Innovation {
        let innovation = self.filter.update(reading);
        let gain = self.filter.gain().to_vec();
        if let Some(moment) = self.moments.last_mut() {
            moment.readings.push(Taken { of: Rc::clone(&reading.of), gain, innovation });
        }
        innovation
    }

    /// The state at each moment, first to last, from all readings.
    pub fn smoothed(&self) -> Vec<Gaussian> {
        let mut smoothed: Vec<Gaussian> = Vec::with_capacity(self.moments.len());
        self.backwards(|_, told| smoothed.push(told.whole()));
        smoothed.reverse();
        smoothed
    }

    /// Visits the moments, last to first, with the estimate of each from all readings.
    pub fn backwards(&self, mut visit: impl FnMut(usize, &Told<'_>)) {
        self.way_back(&[], |k, told, _| visit(k, told));
    }

    /// The same with the pull of the later readings if their residuals are those of each move.
    pub(super) fn way_back(
        &self,
        moves: &[Moved],
        mut visit: impl FnMut(usize, &Told<'_>, &[Vec<f64>]),
    ) {
        let n = self.filter.state().mean.len();
        let mut later = Later { pull: vec![0.0; n], hold: vec![0.0; n * n] };
        let mut pulls = vec![vec![0.0; n]; moves.len()];
        let (mut last, mut back) = (None::<Rc<Transition>>, None::<Transition>);
        let (mut row, mut half) = (vec![0.0; n], vec![0.0; n * n]);
        for (k, moment) in self.moments.iter().enumerate().rev() {
            for (i, taken) in moment.readings.iter().enumerate().rev() {
                later.reading(taken);
                let both = pulls.iter_mut().zip(moves);
                both.for_each(|(pull, moved)| taken.pull(pull, moved.residuals[k][i]));
            }
            visit(k, &Told { before: &moment.before, later: &later }, &pulls);
            let Some(Way { transition, fades }) = &moment.way else { continue };
            if last.as_ref().is_none_or(|last| !Rc::ptr_eq(last, transition)) {
                (last, back) = (Some(Rc::clone(transition)), Some(transition.transposed()));
            }
            if let Some(back) = &back {
                later.step(back, fades, (&mut row, &mut half));
                pulls.iter_mut().for_each(|pull| back.advance(fades, pull, &mut row));
            }
        }
    }

    /// Change of the filter if the first state is moved by `first`.
    pub(super) fn moved(&self, first: &[f64]) -> Moved {
        let mut mean = first.to_vec();
        let mut all = Moved { means: Vec::new(), residuals: Vec::new() };
        for moment in &self.moments {
            if let Some(Way { transition, fades }) = &moment.way {
                mean = transition.advanced(fades, &mean);
            }
            all.means.push(mean.clone());
            let take = |taken: &Taken| {
                let residual = -weighed(&taken.of, &mean);
                add(&mut mean, residual, &taken.gain);
                residual
            };
            all.residuals.push(moment.readings.iter().map(take).collect());
        }
        all
    }

    /// Residual of each reading, in their order.
    pub(super) fn residuals(&self) -> impl Iterator<Item = f64> {
        self.innovations().map(|innovation| innovation.residual)
    }

    /// Standard deviation of each residual.
    pub(super) fn deviations(&self) -> Vec<f64> {
        self.innovations().map(|innovation| innovation.variance.sqrt()).collect()
    }

    fn innovations(&self) -> impl Iterator<Item = Innovation> {
        self.moments.iter().flat_map(|moment| &moment.readings).map(|taken| taken.innovation)
    }
}

impl Taken {
    /// `(1 - k h)' pull + h' residual / S`
    fn pull(&self, pull: &mut [f64], residual: f64) {
        let pulled = residual / self.innovation.variance - dot(&self.gain, pull);
        self.of.iter().for_each(|&(i, h)| pull[i] += h * pulled);
    }
}

/// Estimate of a moment from all readings.
#[derive(Clone, Copy, Debug)]
pub struct Told<'a> {
    pub(super) before: &'a Gaussian,
    /// Information from the readings of this moment and later.
    pub later: &'a Later,
}

impl Told<'_> {
    /// The mean of a sum of states and its standard deviation.
    pub fn of(&self, weights: &Weights) -> (f64, f64) {
        let spread = self.before.spread(weights);
        let known = dot(&spread, &multiplied(&self.later.hold, &spread));
        let mean = weighed(weights, &self.before.mean) + dot(&spread, &self.later.pull);
        (mean, (weighed(weights, &spread) - known).max(0.0).sqrt())
    }

    fn whole(&self) -> Gaussian {
        let Gaussian { mean, covariance } = self.before;
        let n = mean.len();
        let moved = multiplied(covariance, &self.later.pull);
        let mean = mean.iter().zip(&moved).map(|(x, d)| x + d).collect();
        let mut half = vec![0.0; n * n];
        for (half, row) in half.chunks_exact_mut(n).zip(self.later.hold.chunks_exact(n)) {
            row.iter().enumerate().for_each(|(k, h)| add(half, *h, &covariance[k * n..][..n]));
        }
        let mut all = covariance.clone();
        for (i, all) in all.chunks_exact_mut(n).enumerate() {
            (0..n).for_each(|k| add(all, -covariance[i * n + k], &half[k * n..][..n]));
        }
        Gaussian { mean, covariance: all }
    }
}

/// Information on a moment from later readings. They move the mean before them by `P pull` and its
/// covariance P by `-P hold P`.
#[derive(Clone, Debug)]
pub struct Later {
    pull: Vec<f64>,
    hold: Vec<f64>,
}

impl Later {
    /// Information on a shock to the states on the way to the moment. One unit of it moves the
    /// first states by `shock`. If nothing is known of its size, its estimate is `pull / hold`,
    /// with the variance `1 / hold` (P. de Jong, J. Penzer, J. Am. Stat. Assoc. 93 (1998) 796).
    pub fn of_shock(&self, shock: &[f64]) -> (f64, f64) {
        let n = self.pull.len();
        let pull = dot(shock, &self.pull);
        let hold = shock.iter().zip(self.hold.chunks_exact(n)).map(|(s, row)| s * dot(shock, row));
        (pull, hold.sum())
    }

    /// `(1 - k h)' hold (1 - k h) + h' h / S`, and the pull likewise.
    fn reading(&mut self, taken: &Taken) {
        let n = self.pull.len();
        let (of, gain) = (&taken.of, &taken.gain);
        let Innovation { residual, variance } = taken.innovation;
        taken.pull(&mut self.pull, residual);
        let held = multiplied(&self.hold, gain);
        let most = dot(gain, &held) + 1.0 / variance;
        for &(i, h) in of.iter() {
            for (j, held) in held.iter().enumerate() {
                self.hold[i * n + j] -= h * held;
                self.hold[j * n + i] -= h * held;
            }
            of.iter().for_each(|&(j, other)| self.hold[i * n + j] += h * other * most);
        }
    }

    fn step(&mut self, back: &Transition, fades: &[Fade], (row, half): (&mut [f64], &mut [f64])) {
        back.advance(fades, &mut self.pull, row);
        back.carry(fades, &mut self.hold, half);
    }
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::Smoother;
    use crate::kalman::{Augmented, Gaussian, Reading, Step, Transition};

    const PRIOR: [f64; 9] = [4.0, 0.5, 0.0, 0.5, 2.0, 0.1, 0.0, 0.1, 9.0];

    /// Moments of six steps with two readings each, one missing, and a moment without any.
    fn followed(prior: &[f64]) -> Smoother {
        let mut smoother =
            Smoother::new(Gaussian { mean: vec![1.0, 2.0, 3.0], covariance: prior.to_vec() });
        let matrix = [0.9, 0.05, 0.3, 0.02, 0.95, 0.01, 0.0, 0.0, 1.0];
        let step = Step {
            transition: Rc::new(Transition::of(&matrix)),
            input: Rc::new(vec![0.1, -0.2, 0.0]),
            noise: Rc::new(vec![0.02, 0.001, 0.01, 0.001, 0.01, 0.0, 0.01, 0.0, 0.05]),
            fades: Rc::new(Vec::new()),
        };
        let read = [
            (Some(1.3), Some(2.5)),
            (Some(2.1), Some(1.8)),
            (Some(2.9), None),
            (Some(3.8), Some(2.6)),
            (None, None),
            (Some(4.4), Some(2.9)),
        ];
        for (k, (first, second)) in read.into_iter().enumerate() {
            if k > 0 {
                smoother.predict(&step);
            }
            let first = first.map(|value| (vec![(0, 1.0)], value, 0.04));
            let second = second.map(|value| (vec![(0, 0.2), (1, 1.0)], value, 0.25));
            for (of, value, variance) in first.into_iter().chain(second) {
                smoother.update(&Reading { of: of.into(), value, variance });
            }
        }
        smoother
    }

    /// mpmath 1.3: all states of all moments as one Gaussian of 18 numbers, conditioned on all
    /// readings at once, at 40 digits; the density of the readings from the same matrix.
    #[test]
    fn what_is_known_is_the_joint_gaussian_given_all_readings() {
        let expected = [
            (
                0,
                [1.302_333_957_749_358_6, 2.285_513_022_058_211_5, 2.519_968_823_379_742_4],
                [0.028_380_290_145_040_517, 0.084_170_832_042_128_31, 0.154_993_028_910_049_83],
                -0.026_634_089_101_868_89,
            ),
            (
                2,
                [2.921_275_864_968_168, 1.824_529_275_682_067_7, 2.499_655_398_257_269_5],
                [0.015_415_717_495_175_057, 0.067_914_166_785_376_98, 0.093_319_893_246_172],
                0.005_301_310_036_727_808,
            ),
            (
                4,
                [4.111_255_383_772_551, 1.484_650_270_306_837_5, 2.382_211_336_443_241],
                [0.028_178_266_135_707_19, 0.062_250_497_728_226_2, 0.105_717_395_012_076_54],
                0.019_089_483_273_499_237,
            ),
            (
                5,
                [4.534_727_878_371_957, 1.339_751_538_609_305_3, 2.353_755_789_935_982_3],
                [0.032_065_696_589_675_28, 0.061_315_012_714_688_186, 0.139_139_425_212_814_96],
                0.034_216_582_835_518_17,
            ),
        ];
        let smoother = followed(&PRIOR);
        let smoothed = smoother.smoothed();
        for (moment, mean, variance, between) in expected {
            let found = &smoothed[moment];
            for i in 0..3 {
                assert!((found.mean[i] - mean[i]).abs() < 1e-12, "{moment} {i}");
                assert!((found.covariance[4 * i] - variance[i]).abs() < 1e-13, "{moment} {i}");
            }
            assert!((found.covariance[2] - between).abs() < 1e-13);
        }
        assert!((smoother.filter().log_likelihood() + 8.439_296_360_033_93).abs() < 1e-12);
    }

    /// The prior as unknowns, and half of it as unknowns: the same estimates as by the covariance.
    #[test]
    fn unknowns_outside_the_covariance_are_known_as_well() {
        let second = (2.0_f64 - 0.0625).sqrt();
        let third = 0.1 / second;
        let last = (9.0 - third * third).sqrt();
        let roots = [vec![2.0, 0.25, 0.0], vec![0.0, second, third], vec![0.0, 0.0, last]];
        let smoothed = followed(&PRIOR).smoothed();
        for left in [0.0, 0.5] {
            let prior: Vec<f64> = PRIOR.iter().map(|p| left * p).collect();
            let part = f64::sqrt(1.0 - left);
            let roots =
                roots.each_ref().map(|root| root.iter().map(|x| part * x).collect::<Vec<_>>());
            let mut seen = 0;
            Augmented::new(followed(&prior), roots.iter().map(Vec::as_slice)).backwards(
                |k, estimate| {
                    for i in 0..3 {
                        let (mean, deviation) = estimate.of(&[(i, 1.0)]);
                        assert!((mean - smoothed[k].mean[i]).abs() < 1e-12, "{k} {i}");
                        let variance = smoothed[k].covariance[4 * i];
                        assert!((deviation * deviation - variance).abs() < 1e-13, "{k} {i}");
                    }
                    seen += 1;
                },
            );
            assert_eq!(seen, 6);
        }
    }

    /// A constant with a prior deviation of 1e9, read 100 times with noise of 1: the mean of the
    /// readings, known to 0.1, at every moment.
    #[test]
    fn analytic_a_wide_prior_costs_no_digits() {
        let mut smoother =
            Smoother::new(Gaussian { mean: vec![0.0, 0.0], covariance: vec![0.0; 4] });
        // the constant feeds the second state, which is read
        let step = Step {
            transition: Rc::new(Transition::of(&[1.0, 0.0, 1.0, 0.0])),
            input: Rc::new(vec![0.0; 2]),
            noise: Rc::new(vec![0.0; 4]),
            fades: Rc::new(Vec::new()),
        };
        for k in 1..=100 {
            smoother.predict(&step);
            let value = 50.0 + f64::from(k % 2);
            smoother.update(&Reading { of: vec![(1, 1.0)].into(), value, variance: 1.0 });
        }
        Augmented::new(smoother, [[1e9, 0.0].as_slice()]).backwards(|k, estimate| {
            let (mean, deviation) = estimate.of(&[(0, 1.0)]);
            assert!((mean - 50.5).abs() < 1e-12, "{k}: {mean}");
            assert!((deviation - 0.1).abs() < 1e-13, "{k}: {deviation}");
        });
    }

    /// After the last reading there is nothing more to know.
    #[test]
    fn the_filter_is_the_smoother_at_the_end() {
        let smoother = followed(&PRIOR);
        let smoothed = smoother.smoothed();
        let (last, filtered) = (&smoothed[5], smoother.filter().state());
        for i in 0..3 {
            assert!((last.mean[i] - filtered.mean[i]).abs() < 1e-13);
            let (own, weights) = (filtered.covariance[4 * i], [(1, 1.0)]);
            assert!((last.covariance[4 * i] - own).abs() < 1e-14);
            assert_eq!(filtered.of(&weights).0.to_bits(), filtered.mean[1].to_bits());
        }
    }
}
