//! What a run or a fit is asked for: said in a netlist, kept by the analyses.
//!
//! The settings that a netlist contains and an analysis uses (a run, its windows, the parameters of
//! a fit) are in this crate. Neither side translates the types of the other.

use crate::id::ParameterId;

/// What to simulate, in SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Time at which the run begins, in s.
    pub start: f64,
    /// Time at which it ends, in s; after `start`.
    pub stop: f64,
    /// When to write a row.
    pub output: OutputTimes,
    /// Which columns to write, as patterns such as `*.T`; empty for all.
    pub select: Vec<String>,
    /// Over which parts of it to take means and extremes, in file order.
    pub windows: Vec<WindowSettings>,
    /// Tolerance in K.
    pub tolerance: f64,
    /// The share of the heat turned over by which the energy balance may be off, at most; `None` for
    /// the usual one.
    pub balance_error: Option<f64>,
    /// How it is computed.
    pub integrator: IntegratorChoice,
    /// For each control by id how long it has been as it stands at the start, in s, from 0: `None`
    /// if it never switched. Empty for a run that starts from no state.
    pub held: Vec<Option<f64>>,
}

impl RunSettings {
    /// The tolerance in K of a run that does not say.
    pub const USUAL_TOLERANCE: f64 = 1e-5;

    /// One cycle of `period` in s: from the start of `run`, with its tolerance and integrator and
    /// from where its controls stand; rows as the usual number of intervals makes them.
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

/// Which integrator computes a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum IntegratorChoice {
    /// The one-step method where it serves, else ESDIRK for inputs of many points, else CVODE.
    #[default]
    Auto,
    /// The one-step method for linear networks; refused for others.
    OneStep,
    /// An implicit Runge-Kutta method, which needs no new start where inputs bend; refused where
    /// something melts or sensitivities are followed.
    Esdirk,
    /// CVODE, which integrates every network.
    Cvode,
}

impl IntegratorChoice {
    /// The words for them, the usual one first.
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
    /// When it begins, in s; not before the run.
    pub from: f64,
    /// When it ends, in s; after `from` and not after the run.
    pub to: f64,
}

/// A parameter that a fit varies, around its own value. All numbers are in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Varied {
    /// Which one.
    pub parameter: ParameterId,
    /// The least and the greatest value it may take; infinite where there is none.
    pub bounds: (f64, f64),
    /// One standard deviation of what is known of it beforehand, which is its own value; `None` if
    /// nothing is.
    pub prior: Option<f64>,
}

/// When a run writes a row. Start and stop of the run always have one.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputTimes {
    /// Every so many seconds from the start.
    Every(f64),
    /// At these times in s, strictly increasing and inside the run.
    At(Vec<f64>),
}

impl OutputTimes {
    /// More rows than this are refused: a mistyped unit, not a wish.
    pub const MOST_ROWS: f64 = 1e7;
    /// Number of intervals of a run that does not say.
    pub const USUAL_INTERVALS: f64 = 300.0;
}
