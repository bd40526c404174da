//! The numbers of a sweep for one set of parameters.

use std::sync::Arc;

use lptn_data::{Diagnostic, Span};
use lptn_network::{Evaluation, Network, ParameterId, Value};
use lptn_units::{EvalError, Type};

use crate::study::type_of;
use crate::sweep::axis::AxisValues;
use crate::sweep::{SweepAxis, SweepMethod, SweepStudy};

/// More candidates than this are refused: a mistyped number, not a wish. A thousand million rows
/// are about 100 GB.
pub const MOST_CASES: u64 = 1_000_000_000;

/// The largest number of points and of dimensions of the Sobol sequence.
const MOST_SOBOL: u64 = 1 << 16;
const MOST_AXES: usize = 256;

/// The numbers of an axis in SI units.
#[derive(Clone, Debug)]
pub enum AxisNumbers {
    /// From one to another.
    Range {
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// Number of values of a grid or a list, both ends included.
        points: u64,
        /// True if their ratios are equal.
        log: bool,
    },
    /// These.
    Listed(Arc<[f64]>),
}

impl AxisNumbers {
    /// Number of values; 0 if samples are taken.
    pub fn count(&self) -> u64 {
        match self {
            Self::Range { points, .. } => *points,
            Self::Listed(values) => values.len() as u64,
        }
    }

    /// The value at this place, counted from 0. Both ends of a range are exact.
    pub fn value(&self, place: u64) -> f64 {
        match self {
            Self::Listed(values) => {
                let place = usize::try_from(place).ok();
                place.and_then(|place| values.get(place)).copied().unwrap_or(f64::NAN)
            }
            Self::Range { from, points, .. } if place == 0 || *points < 2 => *from,
            Self::Range { to, points, .. } if place + 1 == *points => *to,
            Self::Range { points, .. } => self.at(place as f64 / (points - 1) as f64),
        }
    }

    /// The value at this share of the range, 0 to 1.
    pub fn at(&self, share: f64) -> f64 {
        match self {
            Self::Range { from, to, log: false, .. } => from + (to - from) * share,
            Self::Range { from, to, .. } => from * (to / from).powf(share),
            Self::Listed(_) => f64::NAN,
        }
    }
}

/// A sweep as numbers.
#[derive(Clone, Debug)]
pub struct SweepPlan {
    /// The parameters with their values, in the order of the axes.
    pub axes: Vec<(ParameterId, AxisNumbers)>,
    /// The choice of the candidates.
    pub method: SweepMethod,
    /// The seed of the samples.
    pub seed: u32,
    /// Number of candidates.
    pub cases: u64,
    /// The length of the cycle in s, if given.
    pub period: Option<f64>,
}

impl SweepStudy {
    /// Its numbers, for the parameters of `network`.
    ///
    /// # Errors
    /// Its errors: an empty or infinite range, lists of different lengths, more than
    /// [`MOST_CASES`].
    pub fn plan(&self, network: &Network) -> Result<SweepPlan, Vec<Diagnostic>> {
        let mut check = Check { study: self, scope: network.evaluation(), problems: Vec::new() };
        let axes: Vec<AxisNumbers> =
            self.axes.iter().map(|axis| check.axis(axis, type_of(network, &axis.name))).collect();
        if self.method == SweepMethod::Sobol && axes.len() > MOST_AXES {
            let message = format!(
                "sweep `{}` has {} axes, and the sequence {MOST_AXES}",
                self.name,
                axes.len()
            );
            check.wrong(
                "netlist::sweep_cases",
                message,
                &self.span,
                "write `method = \"latin_hypercube\"`",
            );
        }
        let period = self.period.as_ref().map(|period| check.period(period));
        let cases = if check.problems.is_empty() { check.cases(&axes) } else { 0 };
        if !check.problems.is_empty() {
            return Err(check.problems);
        }
        let ids = self.axes.iter().filter_map(|axis| network.parameter(&axis.name).ok());
        Ok(SweepPlan {
            axes: ids.zip(axes).collect(),
            method: self.method,
            seed: self.seed,
            cases,
            period,
        })
    }
}

/// Evaluates numbers and collects their errors.
struct Check<'a> {
    study: &'a SweepStudy,
    scope: Evaluation,
    problems: Vec<Diagnostic>,
}

impl Check<'_> {
    fn wrong(&mut self, code: &'static str, message: String, at: &Span, help: &str) {
        self.problems.push(Diagnostic::wrong(code, message, at, help));
    }

    fn number(&mut self, value: &Value, words: &str, at: &Span) -> f64 {
        let failed = match value.at(&mut self.scope) {
            Ok(number) if number.is_finite() => return number,
            Ok(number) => Diagnostic::error("netlist::sweep_range", format!("{words} is {number}")),
            Err(error) => Diagnostic::error(EvalError::code(&error), format!("{words}: {error}")),
        };
        self.problems.push(failed.at(at.clone(), ""));
        f64::NAN
    }

    fn axis(&mut self, axis: &SweepAxis, ty: Type) -> AxisNumbers {
        let words = format!("`{}` in `axes` of sweep `{}`", axis.name, self.study.name);
        match &axis.values {
            AxisValues::List(values, span) => {
                let numbers = values.iter().map(|value| self.number(value, &words, span));
                AxisNumbers::Listed(numbers.collect())
            }
            AxisValues::Column(column) => AxisNumbers::Listed(column.numbers.as_slice().into()),
            AxisValues::Range { ends: [from, to], points, log, span } => {
                let [from, to] = [from, to].map(|end| self.number(end, &words, span));
                self.range(&words, (from, to), (*log, ty), span);
                AxisNumbers::Range { from, to, points: *points, log: *log }
            }
        }
    }

    fn range(&mut self, words: &str, (from, to): (f64, f64), (log, ty): (bool, Type), at: &Span) {
        const CODE: &str = "netlist::sweep_range";
        if from >= to {
            let message = format!("{words}: `from` has to be less than `to`");
            self.wrong(
                CODE,
                message,
                at,
                "write the least value as `from` and the largest as `to`",
            );
        } else if log && ty.absolute {
            let message = format!("{words}: the ratio of two temperatures has no meaning");
            self.wrong(CODE, message, at, "leave `scale` out");
        } else if log && from <= 0.0 {
            let message = format!("{words}: a range by ratios has to begin above zero");
            self.wrong(CODE, message, at, "begin above zero, or leave `scale` out");
        }
    }

    fn period(&mut self, value: &Value) -> f64 {
        let (words, at) = (format!("`period` of sweep `{}`", self.study.name), &self.study.span);
        let period = self.number(value, &words, at);
        if period <= 0.0 {
            let message = format!("{words} has to be more than zero");
            self.wrong(
                "netlist::sweep_range",
                message,
                at,
                "write for example `period = \"10 min\"`",
            );
        }
        period
    }

    /// Number of candidates that the axes make.
    fn cases(&mut self, axes: &[AxisNumbers]) -> u64 {
        let study = self.study;
        let product = |product: f64, axis: &AxisNumbers| product * axis.count() as f64;
        let cases = match study.method {
            SweepMethod::Grid => axes.iter().fold(1.0, product),
            SweepMethod::List | SweepMethod::Csv => self.common(axes) as f64,
            SweepMethod::LatinHypercube | SweepMethod::Sobol => study.samples as f64,
        };
        let most = if study.method == SweepMethod::Sobol { MOST_SOBOL } else { MOST_CASES };
        if cases > most as f64 {
            let message = format!(
                "sweep `{}` has {} candidates, more than the {most} that {}",
                study.name,
                lptn_units::format_short(cases),
                if most == MOST_SOBOL { "the sequence is known for" } else { "are swept at once" }
            );
            let help = match study.method {
                SweepMethod::Sobol => "take fewer, or write `method = \"latin_hypercube\"`",
                _ => "take fewer points, or sample: `method = \"latin_hypercube\"`",
            };
            self.wrong("netlist::sweep_cases", message, &study.span, help);
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is not more than MOST_CASES"
        )]
        let cases = cases.min(MOST_CASES as f64) as u64;
        cases
    }

    /// The length that all lists have.
    fn common(&mut self, axes: &[AxisNumbers]) -> u64 {
        let count = axes.first().map_or(0, AxisNumbers::count);
        let study = self.study;
        for (axis, numbers) in study.axes.iter().zip(axes).skip(1) {
            if numbers.count() != count {
                let (first, name) = (&study.axes[0], &axis.name);
                let message = format!(
                    "sweep `{}` goes through its lists together: `{name}` has {} values, `{}` has \
                     {count}",
                    study.name,
                    numbers.count(),
                    first.name
                );
                let problem = Diagnostic::error("netlist::sweep_lengths", message)
                    .at(axis.span.clone(), format!("{} values", numbers.count()))
                    .also(first.span.clone(), format!("{count} values"));
                let help = "give both as many values; `method = \"grid\"` takes every combination";
                self.problems.push(problem.help(help));
            }
        }
        count
    }
}
