//! Invalid settings of a run.

use lptn_network::NoTangents;
use lptn_units::format_six as six_digits;

lptn_units::errors! {
/// Settings that contradict themselves.
#[derive(Clone, Debug, PartialEq)]
pub enum SettingsError {
    /// The stop is not after the start, or one of them is not finite; in s.
    Interval { start: f64, stop: f64 } = "run::settings",
        format!("a run must stop after it starts, got {start} s to {stop} s");
    /// The tolerance is not positive and finite.
    Tolerance(value: f64) = "run::settings",
        format!("the tolerance must be a positive number of K, got {value}");
    /// An output time in s is outside the run or not after the one before it.
    OutputTime(time: f64) = "run::settings",
        format!("the output time {time} s is outside the run or not after the one before it");
    /// Two rows are at the same time in s, because a double cannot distinguish their times.
    SameTime { time: f64 } = "run::settings",
        format!(
            "two rows have the same time, {time} s: numbers of this size are {} s apart",
            six_digits(time.abs().next_up() - time.abs())
        ),
        help FROM_ZERO;
    /// Something depends on the time, and so far from 0 doubles do not resolve times of the run
    /// well enough: start, stop and the distance of two doubles at the larger of them, in s.
    FarFromZero { start: f64, stop: f64, resolution: f64 } = "run::settings",
        format!(
            "the run from {start} s lasts {} s, but numbers of this size are {} s apart, too \
             coarse for values that depend on the time",
            six_digits(stop - start),
            six_digits(*resolution)
        ),
        help FROM_ZERO;
    /// A window, its ends in s, is not inside the run, or its end not after its beginning.
    Window { name: String, from: f64, to: f64 } = "run::settings",
        format!("window `{name}` from {from} s to {to} s is not a part of the run");
    /// More values would be recorded than fit in memory.
    TooMuch { rows: usize, values: usize } = "run::settings",
        format!(
            "{rows} rows of {values} values do not fit in memory: write fewer rows, or select \
             fewer columns"
        );
    /// The distance between outputs in s is not positive, or so small that there would be too many.
    OutputEvery(every: f64) = "run::settings",
        format!("outputs every {every} s are none, or more than 10 million");
    /// The state to begin with is one of another network, or not finite.
    State = "run::settings", "the state to begin with is not one of this network";
    /// The one-step method is requested, which cannot compute this run; `curved`: because an input
    /// is not a straight line in time.
    OneStep { curved: bool } = "run::settings", {
            let why = match *curved {
                true => "an input of this one curves over time",
                false => "this one is not, or its conductances are too far apart for the tolerance, or \
                          it has sensitivities to follow",
            };
            format!("the one-step method is for linear networks: {why}")
        },
        help "leave `integrator` out, or write `integrator = \"cvode\"`";
    /// ESDIRK is requested, which cannot compute this run.
    Esdirk = "run::settings",
        "ESDIRK does not compute runs whose capacities change with temperature, or with \
         sensitivities to follow",
        help "leave `integrator` out, or write `integrator = \"cvode\"`";
    /// The library was built without the integrator that this run needs.
    NoIntegrator = "run::settings",
        "this run needs CVODE, which this build does not have",
        help "use the program `lptn`, or build the library with its feature `cvodes`";
    /// Sensitivities are requested that do not exist or cannot be computed.
    Sensitivity(refusal: NoTangents) = "run::settings",
        format!("no exact sensitivities: {refusal}"),
        source refusal;
}
}

const FROM_ZERO: &str = "count the time from the beginning of the run, `start = \"0 s\"`; if an \
    expression needs the other time, write `(t + 1.7e9 [s])` instead of `t`";
