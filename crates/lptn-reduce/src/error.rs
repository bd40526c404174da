//! Errors of reductions and of fits to a record.

use lptn_analysis::RunError;
use lptn_integrate::FactorError;
use lptn_network::{InputError, UnknownName, list_of_names};
use lptn_solve::ResponseError;
use lptn_units::Class;

lptn_units::errors! {
/// The reason why a network has no equivalent at a port.
#[derive(Debug)]
pub enum ReduceError {
    /// No node has the name of the port.
    UnknownPort(unknown: UnknownName) = "reduce::unknown_port",
        format!("no node is named `{}`", unknown.name),
        help unknown.suggestion.as_ref().map(|name| format!("did you mean `{name}`?"));
    /// The port is a boundary: its temperature is given at any heat flow.
    BoundaryPort { name: String } = "reduce::boundary_port",
        format!("`{name}` is a boundary and cannot be a port"),
        help "choose a node: a boundary keeps its temperature at any heat flow";
    /// No path leads from the port and the nodes joined to it to a boundary: heat put in there
    /// never leaves.
    NoGround { names: Vec<String> } = "reduce::no_ground",
        format!("no path leads to a boundary from {}", list_of_names(names)),
        help "add a path to a boundary: without one, a constant heat never leads to a rise that \
            stays";
    /// The network is not linear with constant coefficients; `name` is the first item that is more
    /// than a constant.
    NotLinear { name: String } = "reduce::not_linear",
        format!(
            "`{name}` is more than a constant: only linear networks have one equivalent resistance"
        ),
        help format!(
            "near one of its states it has one: --port with --at steady, or with --at 10min; or \
             replace `{name}` by a constant conductance, capacity or heat"
        );
    /// Streams go on from node to node: heat acts downstream only.
    OneWay = "reduce::one_way",
        "streams go on from node to node: their network has one equivalent node at most",
        help "leave --nodes, --error and --keep out, or write the streams as conductances";
    /// Heat into the port leaves its steady temperature as it is, as under a controller with an
    /// integral.
    Held { name: String } = "reduce::held",
        format!("`{name}` has no equivalent resistance: a controller keeps its temperature"),
        help "choose another port, or give the controller a constant output";
    /// Sources or boundaries switch by themselves, which one node without the sensed places cannot
    /// follow.
    Switches { name: String } = "reduce::switches",
        format!("`{name}` switches during a run, which an equivalent of one node cannot follow"),
        help format!("replace `{name}` by 0 or 1, and reduce that network");
    /// The heat of a source changes with time by a law, and no share of it can be written.
    NotGiven { name: String } = "reduce::not_given",
        format!("the heat of `{name}` changes with time by a law, and a share of it cannot be \
            written"),
        help format!("replace it by a [source] with the heat of `{name}`");
    /// A source or boundary has no value.
    Input => InputError;
    /// The conductances span too wide a range for floating-point numbers.
    Factorization(error: FactorError) = "reduce::singular",
        format!("the conductances cannot be factorised: {error}"), source error,
        help "replace the largest conductances by merging the nodes they join",
        class Class::Numbers;
    /// The modes at the port could not be computed.
    Modes = "reduce::modes", "the time constants at the port cannot be computed",
        class Class::Numbers;
    /// The network cannot be linearised near a state, or has no response there.
    Response => ResponseError;
    /// A run of the network or of its equivalent failed.
    Run => RunError;
    /// The equivalent network could not be built, for the reason in the text.
    Equivalent(why: String) = "reduce::equivalent",
        format!("the equivalent network cannot be built: {why}"), class Class::Numbers;
    /// The window in s of the least-squares definition is not a positive time, or too short to see
    /// the port warm.
    Window(window: f64) = "reduce::window",
        format!("the window must be a time in which the port warms, got {window} s"),
        help "write for example --window \"25 min\"";
}
}

impl From<FactorError> for ReduceError {
    fn from(error: FactorError) -> Self {
        Self::Factorization(error)
    }
}

lptn_units::errors! {
/// The reason why a record has no exponential.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FitError {
    /// Fewer than four points, or lists of different length: three numbers are fitted.
    TooFew { points: usize } = "fit::too_few_points",
        format!("an exponential has three numbers to fit, and the record has {points} points"),
        help "four samples or more give a curve with an error";
    /// The times do not ascend, or a value is not finite.
    NotARecord = "fit::not_a_record",
        "the times of the record do not ascend, or a value is not a number";
    /// The temperature does not change.
    Flat = "fit::flat", "the temperature of the record does not change",
        help "name the columns that change: --column NAME";
    /// The best exponential is a straight line or a jump: the record does not determine a time
    /// constant. The search ended at this one, in s.
    NoCurvature { tau: f64 } = "fit::no_curvature",
        format!("the record shows no time constant: the search ended at {tau:.1e} s"),
        class Class::Numbers;
}
}
