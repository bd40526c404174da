//! Settings of a run or a fit: given in a netlist, used by the analyses.
//!
//! The settings that a netlist contains and an analysis uses (a run, its windows, the parameters of
//! a fit) are in this crate. Neither side translates the types of the other.

use crate::id::ParameterId;

/// The settings of a simulation, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Time at which the run begins, in s.
    pub start: f64,
    /// Time at which it ends, in s; after `start`.
    pub stop: f64,
    /// When to write a row.
    pub output: OutputTimes,
    /// Columns to write, as patterns such as `*.T`; empty for all.
    pub select: Vec<String>,
    /// Parts of the run over which to take means and extremes, in file order.
    pub windows: Vec<WindowSettings>,
    /// Tolerance in K.
    pub tolerance: f64,
    /// Largest error of the energy balance as a share of the total heat exchanged; `None` for the
    /// default.
    pub balance_error: Option<f64>,
    /// Its integrator.
    pub integrator: IntegratorChoice,
    /// For each control by id the time in s that it has been in its state at the start, from 0:
    /// `None` if it never switched. Empty for a run that does not start from a state.
    pub held: Vec<Option<f64>>,
}

impl RunSettings {
    /// The default tolerance of a run in K.
    pub const USUAL_TOLERANCE: f64 = 1e-5;

    /// One cycle of `period` in s: from the start of `run`, with its tolerance, its integrator and
    /// the times of its controls in their states; rows at the default number of intervals.
    pub fn cycle(run: Option<&Self>, period: f64) -> Self {
        let start = run.map_or(0.0, |run| run.start);
        Self {
            start,
            stop: start + period,
            output: OutputTimes::Every(period / OutputTimes::USUAL_INTERVALS),
            select: Vec::new(),
            windows: Vec::new(),
            tolerance: run.map_or(Self::USUAL_TOLERANCE, |run| run.tolerance),
            balance_error: run.and_then(|run| run.balance_error),
            integrator: run.map_or_else(Default::default, |run| run.integrator),
            held: run.map_or_else(Vec::new, |run| run.held.clone()),
        }
    }
}

/// The integrator of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum IntegratorChoice {
    /// The one-step method if it applies, else ESDIRK for inputs of many points, else CVODE.
    #[default]
    Auto,
    /// The one-step method for linear networks; refused for others.
    OneStep,
    /// An implicit Runge-Kutta method, which needs no restart when inputs bend; refused if
    /// something melts or sensitivities are followed.
    Esdirk,
    /// CVODE, which integrates every network.
    Cvode,
}

impl IntegratorChoice {
    /// The words for them, the default first.
    pub const WORDS: [(&str, Self); 4] = [
        ("auto", Self::Auto),
        ("one_step", Self::OneStep),
        ("esdirk", Self::Esdirk),
        ("cvode", Self::Cvode),
    ];

    /// The word for it.
    pub fn word(self) -> &'static str {
        Self::WORDS.into_iter().find(|(_, choice)| *choice == self).map_or("", |(word, _)| word)
    }
}

/// A part of the run over which means and extremes are taken.
#[derive(Clone, Debug, PartialEq)]
pub struct WindowSettings {
    /// Its name.
    pub name: String,
    /// Its start in s; not before the run.
    pub from: f64,
    /// Its end in s; after `from` and not after the run.
    pub to: f64,
}

/// A parameter that a fit varies, around its own value. All numbers are in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Varied {
    /// The parameter.
    pub parameter: ParameterId,
    /// The least and the greatest value it may take; infinite if there is no bound.
    pub bounds: (f64, f64),
    /// One standard deviation of its prior, whose mean is its own value; `None` if there is no
    /// prior.
    pub prior: Option<f64>,
}

/// Times at which a run writes a row. Start and stop of the run always have one.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputTimes {
    /// At multiples of this time in s from the start.
    Every(f64),
    /// At these times in s, strictly increasing and inside the run.
    At(Vec<f64>),
}

impl OutputTimes {
    /// More rows than this are refused: a mistyped unit, not a wish.
    pub const MOST_ROWS: f64 = 1e7;
    /// Default number of intervals of a run.
    pub const USUAL_INTERVALS: f64 = 300.0;
}
