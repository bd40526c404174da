//! Reasons why a network cannot be fitted.

use lptn_assembly::ChangeError;
use lptn_solve::SensitiveError;
use lptn_units::{Class, EvalError};

use crate::least_squares::LeastSquaresError;
use crate::network::task::FitStage;

lptn_units::errors! {
/// Reasons why a network cannot be fitted. If the search does not converge, that is an answer.
#[derive(Debug)]
pub enum NetworkFitError {
    /// Nothing is varied.
    NoParameter = "fit::no_parameter", "nothing is varied, so nothing can be fitted";
    /// The records have no value.
    NoData = "fit::no_data", "the records have no value of a column that is fitted";
    /// A record, with its first and last time in s, begins before its run, whose start is in s, or
    /// has no row after the start.
    Times { record: String, span: (f64, f64), start: f64 } = "fit::record_times",
        format!(
            "{record}: rows from {} s to {} s do not fit a run that starts at {start} s",
            span.0, span.1
        ),
        help format!(
            "the times of a record are times of the run, which begins at {start} s: set `start` in \
             [run] to the time at which the network was at `T0`, or take the rows before it out of \
             the record"
        );
    /// There are fewer values and priors than parameters.
    TooFew { values: usize, parameters: usize } = "fit::too_few_values",
        format!("{values} values cannot determine {parameters} parameters"),
        help "vary fewer parameters, or give some a prior with `±`";
    /// The own value of a parameter, by its place among the varied ones, is outside its bounds.
    StartOutside { parameter: usize } = "fit::start_outside",
        format!("the start value of varied parameter {parameter} is outside its bounds");
    /// The prior of a parameter, by its place among the varied ones, cannot have this correlation
    /// with those before it.
    Correlations { parameter: usize } = "fit::correlations",
        format!("the prior of varied parameter {parameter} has an impossible correlation");
    /// The run of a record fails with the own values of the parameters.
    Start { record: String, error: Box<SensitiveError> } =
        match &**error {
            SensitiveError::Change(ChangeError::Network(_)) => "fit::network",
            SensitiveError::Interrupted => "fit::interrupted",
            SensitiveError::Run(_) | SensitiveError::Change(ChangeError::Assembly(_)) => {
                error.code()
            }
        },
        format!("{record}: there is no run with the parameters' own values: {error}"),
        source error.as_ref(),
        class match &**error {
            SensitiveError::Run(_) => Class::Numbers,
            _ => Class::Input,
        };
    /// A column measures something, as it is written, that no run gives: a parameter, the time.
    Observed { column: String, result: String } = "fit::observed",
        format!("column `{column}` measures `{result}`, which reads no temperature and no heat flow"),
        help "write the quantity that the instrument measured: a temperature, `\"steel.T\"`, a \
            difference, `\"steel.T - bed.T\"`, or a heat flow, `\"internal.Q\"`";
    /// A column measures something, as it is written, that is not a sum of temperatures of nodes.
    NotLinear { column: String, result: String } = "fit::not_linear",
        format!("column `{column}` measures `{result}`, which is not a temperature of a node, a mean \
            or a difference of some"),
        help "only a fit compares other results; write the temperature of a node, `\"steel.T\"`, \
            or a mean, `\"mean(steel.T, bed.T)\"`: parameters, signals, boundaries, heat flows and \
            `t` cannot be used there";
    /// Columns have different units, and this one has no standard deviation.
    Units { column: String, units: [String; 2] } = "fit::units",
        format!("columns are in {} and in {}, and column `{column}` has no `sigma`: without it the \
            weights of the columns are not known", units[0], units[1]),
        help "write the scatter of one value of each column: `{ of = \"skin.Q\", sigma = \"2 W\" \
            }`";
    /// The result of a column has no value at this time in s, although something was measured.
    NoValue { record: String, column: String, time: f64 } = "fit::no_value",
        format!("{record}: the result that column `{column}` measures has no value at {time} s"),
        help "look for a root or a logarithm of a value of 0 or less, or for a result that does \
            not exist yet; rows without a value in the column are left out";
    /// A column of a record, which a signal is to follow, has fewer than two values.
    Signal { record: String, column: String } = "fit::signal",
        format!("{record}: a signal follows column `{column}`, which has fewer than two values"),
        help "take the record out, or the signal out of `signal`";
    /// A signal is to follow the readings of a slow sensor.
    SignalLag { column: String, sensor: String } = "fit::signal_lag",
        format!("a signal follows column `{column}`, whose sensor `{sensor}` has a lag"),
        help "the temperature before a slow sensor followed cannot be separated from noise: name a \
            sensor without `lag`, or make the place a node, whose column may have a slow sensor";
    /// Nodes are to begin at a mean over this time in s, which is more than half of the length of
    /// the record in s.
    InitialLong { record: String, mean: f64, length: f64 } = "fit::initial_mean",
        format!(
            "{record}: `initial` is a mean over {mean} s, and the record is {length} s long"
        ),
        help "a node begins at the first reading of its column: take the mean over its first rows, \
            `initial = \"2 s\"`, or the first row, `initial = \"record\"`";
    /// A number of the study has no value.
    Plan => EvalError;
    /// The sum of squares cannot be minimised.
    Search => LeastSquaresError as Class::of_numbers;
    /// The fit was interrupted at this stage; `best` contains the values in SI units that describe
    /// the records best among those that were tried.
    Interrupted { stage: FitStage, best: Option<Vec<f64>> } = "fit::interrupted",
        format!("the fit was interrupted in {stage}"), class Class::Interrupted;
}
}
