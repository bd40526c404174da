//! Reasons why there is no periodic state.

use lptn_network::{InputError, NodeId, NotPeriodic, list_of_names};
use lptn_units::{Class, format_number, format_six as six_digits};

use crate::error::TransientError;

lptn_units::errors! {
/// Reason why no periodic state was found.
#[derive(Debug)]
pub enum PeriodicError {
    /// An input is not the same one period later.
    NotPeriodic(found: NotPeriodic) = "periodic::not_periodic", not_periodic(found),
        help match found.values {
            [_, None] => "let the signal repeat: after_end = \"repeat\"",
            _ => "give the period with which all inputs repeat: --period \"10 min\"",
        };
    /// An input has no value.
    Input => InputError;
    /// Some nodes lead to no boundary and gain or lose heat in every cycle, this much in J in the
    /// first one.
    NoBalance { nodes: Vec<NodeId>, names: Vec<String>, heat: f64 } = "periodic::no_balance",
        format!(
            "no path leads to a boundary from {}, and every cycle leaves {} J: there is no \
             periodic state",
            list_of_names(names),
            six_digits(*heat)
        ),
        help "add a path to a boundary, or use `lptn run`";
    /// The content of a pipe is not among the variables that a periodic state is found by.
    Pipe { name: String } = "periodic::pipe",
        format!("the periodic steady state of a network with the pipe `{name}` is not available"),
        help "use `lptn run` until two cycles are alike";
    /// A state is sampled: its samples need not repeat with the cycle.
    Sampled { name: String } = "periodic::sampled",
        format!("the periodic steady state of a network with the sampled `{name}` is not available"),
        help "use `lptn run` until two cycles are alike, or a controller without `sample`";
    /// The cycles do not reach the same state: the node or state that the last one changed most,
    /// and its change in this unit.
    NotFound { cycles: usize, name: String, change: f64, unit: String } = "periodic::not_found",
        format!(
            "{cycles} cycles reached no periodic state; the last one changed `{name}` by {} {unit}",
            format_number(format!("{change:.2e}").parse().unwrap_or(*change))
        ),
        help "simulate some cycles one after the other: `lptn run`", class Class::Numbers;
    /// No two cycles in a row switch alike.
    Switches { cycles: usize } = "periodic::switches",
        format!("in {cycles} cycles controls and comparisons did not switch alike twice in a row"),
        help "the controls have their own rhythm: use `lptn run`, and means over many \
            cycles", class Class::No;
    /// A cycle could not be integrated.
    Cycle => TransientError as Class::of_numbers;
    /// The observer asked for an end, after this number of whole cycles; the last difference in K
    /// between the start of a cycle and its end, if there was one.
    Interrupted { cycles: usize, residual: Option<f64> } = "periodic::interrupted",
        format!("interrupted after {cycles} cycles"), class Class::Interrupted;
}
}

impl PeriodicError {
    /// The value that failed, if that is the reason.
    pub fn input(&self) -> Option<&InputError> {
        match self {
            Self::Input(error) => Some(error),
            Self::Cycle(error) => error.input(),
            _ => None,
        }
    }
}

fn not_periodic(found: &NotPeriodic) -> String {
    let unit = found.unit.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
    let shown = |digits: fn(f64) -> String| {
        found.values.map(|x| x.map_or("nothing".into(), |x| format!("{}{unit}", digits(x))))
    };
    let [now, then] = match shown(six_digits) {
        [now, then] if now == then => shown(format_number),
        apart => apart,
    };
    format!(
        "`{}` does not repeat itself: it is {now} at {} s and {then} one period of {} s later",
        found.name,
        six_digits(found.time),
        six_digits(found.period)
    )
}
