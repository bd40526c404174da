//! Runs at scrambled Sobol points.
//!
//! Correlated parameters have no Sobol index. Changing one alone leaves the distribution, and the
//! order in which they are made independent would decide the result. Their shares are those of a
//! plane, in both methods, and the output says so. Sampled numbers have the error that eight
//! independent scramblings show.

mod indices;
mod regression;
mod rows;

use lptn_solve::{Proceed, in_parallel};

use crate::uncertainty::error::UncertaintyError;
use crate::uncertainty::input::{Inputs, uncertain};
use crate::uncertainty::points::{self, LEAST, MOST_DIMENSIONS, MOST_POINTS};
use crate::uncertainty::result::{Uncertainty, UncertaintyMethod};
use crate::uncertainty::sample::{NoSample, Sample, count};
use crate::uncertainty::task::UncertaintyTask;

/// Independent scramblings that the samples are made of: their spread is the error of sampling.
pub const GROUPS: usize = 8;

/// Bytes that the temperatures of all samples at all rows may take.
const MOST_BYTES: usize = 1 << 31;

/// Settings of the sampling.
#[derive(Clone, Copy)]
pub struct Sobol<'a> {
    /// Base points, 64 to 65536, rounded up to a power of two. With d uncertain parameters there
    /// are d + 2 runs for each: two with every parameter sampled, for the bands, and d that share
    /// all parameters but one with the first of the two; these d are not made if parameters are
    /// correlated.
    pub samples: usize,
    /// The seed of the scrambling: the same seed gives the same result to the last digit.
    pub seed: u32,
    /// Threads; the result does not depend on their number.
    pub threads: usize,
    /// Called after every step of every run; may interrupt the study.
    pub control: &'a (dyn Fn() -> Proceed + Sync),
    /// Called when a base point is finished.
    pub finished: &'a (dyn Fn() + Sync),
}

impl UncertaintyTask<'_> {
    /// Bands, probabilities and variance shares from runs at Owen-scrambled Sobol points (crate
    /// `sobol_burley`: directions of S. Joe and F. Y. Kuo, scrambling of B. Burley, JCGT 9 (2020)
    /// 4), in eight independent scramblings whose spread gives the standard errors.
    ///
    /// Parameters that the network refuses, such as a resistance below zero, are left out and
    /// counted: the distribution is cut off there. The normal numbers of correlated parameters are
    /// made by the lower triangle of their correlations; shares of the variance are then those of
    /// [`Contribution`](crate::uncertainty::Contribution).
    ///
    /// # Errors
    /// [`UncertaintyError`]; runs that fail are an error only if too few are left.
    pub fn sobol(&self, how: &Sobol<'_>) -> Result<Uncertainty, UncertaintyError> {
        let inputs = uncertain(self.network, &self.parameters)?;
        let samples = self.checked(how.samples, &inputs)?;
        let nominal =
            self.sample(&self.parameters, true, how.control).map_err(|error| nothing(&error))?;
        let design =
            Design { task: self, inputs: &inputs, per_group: samples / GROUPS, seed: how.seed };
        let numbers: Vec<usize> = (0..samples).collect();
        let blocks = in_parallel(&numbers, how.threads, |&number| {
            let block = design.block(number, how.control);
            (how.finished)();
            block
        });
        let blocks = Blocks::of(blocks, samples)?;
        let (runs, lost) = (blocks.runs + 1, blocks.lost.clone());
        Ok(Uncertainty {
            method: UncertaintyMethod::Sobol { samples, seed: how.seed, runs, lost },
            times: self.times()?,
            bands: rows::bands(self, &nominal, &blocks, how.threads),
            answers: indices::answers(self, &nominal, &blocks, &design),
            inputs,
        })
    }

    /// The number of samples that is taken, if these can be.
    fn checked(&self, samples: usize, inputs: &Inputs) -> Result<usize, UncertaintyError> {
        if !(LEAST..=MOST_POINTS).contains(&samples) {
            return Err(UncertaintyError::Samples(samples));
        }
        if 2 * inputs.len() > MOST_DIMENSIONS {
            return Err(UncertaintyError::TooManyParameters(inputs.len()));
        }
        let samples = samples.next_power_of_two();
        let rows = self.times()?.len();
        let bytes = 2 * samples * rows * self.nodes.len() * size_of::<f64>();
        if bytes > MOST_BYTES { Err(UncertaintyError::TooLarge(bytes)) } else { Ok(samples) }
    }
}

/// Why there is not even the run with every parameter at its value.
fn nothing(error: &NoSample) -> UncertaintyError {
    match error {
        NoSample::Interrupted => UncertaintyError::Interrupted,
        error => UncertaintyError::TooFew(count(std::iter::once(error))),
    }
}

/// The points of the samples.
struct Design<'a> {
    task: &'a UncertaintyTask<'a>,
    inputs: &'a Inputs,
    per_group: usize,
    seed: u32,
}

/// The runs of one base point.
struct Block {
    /// Both with every parameter sampled, independently of each other.
    base: [Result<Sample, NoSample>; 2],
    /// For each parameter the answers with this one of the second and all others of the first; none
    /// if parameters are correlated.
    mixed: Vec<Result<Vec<f64>, NoSample>>,
}

impl Design<'_> {
    /// The normal numbers of the parameters of a run whose parameter `i` is that of base run
    /// `which(i)`.
    fn scores(&self, number: usize, which: &dyn Fn(usize) -> usize) -> Vec<f64> {
        let one = |i: usize| self.normal(number, which(i), i);
        self.inputs.correlated((0..self.inputs.len()).map(one).collect())
    }

    /// The parameters of a base run in standard deviations.
    fn standard(&self, number: usize, which: usize) -> Vec<f64> {
        let scores = self.scores(number, &|_| which);
        self.inputs.iter().zip(scores).map(|(input, score)| input.standard(score)).collect()
    }

    /// An independent normal number for a parameter: of the first base run from the first half of
    /// the dimensions, of the second one from the second half.
    fn normal(&self, number: usize, which: usize, input: usize) -> f64 {
        #[expect(clippy::cast_possible_truncation, reason = "there are eight groups")]
        let group = (number / self.per_group) as u32;
        let seed = self.seed.wrapping_mul(GROUPS as u32).wrapping_add(group);
        points::normal(number % self.per_group, which * self.inputs.len() + input, seed)
    }

    /// A run whose parameter `i` is that of base run `which(i)`.
    fn run(
        &self,
        number: usize,
        which: &dyn Fn(usize) -> usize,
        rows: bool,
        control: &(dyn Fn() -> Proceed + Sync),
    ) -> Result<Sample, NoSample> {
        let mut parameters = self.task.parameters.clone();
        for (input, score) in self.inputs.iter().zip(self.scores(number, which)) {
            parameters.set(input.parameter, input.at(score));
        }
        self.task.sample(&parameters, rows, control)
    }

    fn block(&self, number: usize, control: &(dyn Fn() -> Proceed + Sync)) -> Block {
        let base = [0, 1].map(|which| self.run(number, &|_| which, true, control));
        let both = base.iter().all(Result::is_ok);
        let mixed = |input: usize| {
            if !both {
                return Err(NoSample::Skipped);
            }
            self.run(number, &|i| usize::from(i == input), false, control)
                .map(|sample| sample.answers)
        };
        // shares of correlated parameters are not found by changing one of them alone
        let changed = if self.inputs.are_correlated() { 0 } else { self.inputs.len() };
        Block { mixed: (0..changed).map(mixed).collect(), base }
    }
}

/// All runs.
struct Blocks {
    blocks: Vec<Block>,
    per_group: usize,
    runs: usize,
    lost: Vec<crate::uncertainty::lost::Lost>,
}

impl Blocks {
    fn of(blocks: Vec<Block>, samples: usize) -> Result<Self, UncertaintyError> {
        let (mut runs, mut failures) = (0, Vec::new());
        for block in &blocks {
            let mixed = block.mixed.iter().map(|mixed| mixed.as_ref().err());
            for error in block.base.iter().map(|base| base.as_ref().err()).chain(mixed) {
                runs += usize::from(!matches!(error, Some(NoSample::Skipped)));
                failures.extend(error);
            }
        }
        if failures.iter().any(|error| matches!(error, NoSample::Interrupted)) {
            return Err(UncertaintyError::Interrupted);
        }
        let lost = count(failures.into_iter());
        let found = Self { per_group: samples / GROUPS, runs, lost, blocks };
        let enough =
            |group: usize| found.base().filter(|(of, _)| *of == group).count() >= LEAST / GROUPS;
        if (0..GROUPS).all(enough) { Ok(found) } else { Err(UncertaintyError::TooFew(found.lost)) }
    }

    /// The runs that bands are taken from, each with its group.
    fn base(&self) -> impl Iterator<Item = (usize, &Sample)> {
        let run = |(number, which): (usize, usize)| {
            Some((number / self.per_group, self.blocks[number].base[which].as_ref().ok()?))
        };
        self.numbered().filter_map(run)
    }

    /// The same as base point, and which of its two runs it is.
    fn numbered(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let both = (0..self.blocks.len()).flat_map(|number| [(number, 0), (number, 1)]);
        both.filter(|&(number, which)| self.blocks[number].base[which].is_ok())
    }
}
