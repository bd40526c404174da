//! Notes on a reduction in addition to its numbers.

use lptn_reduce::{Definition, Dynamics, LeastSquaresWindow};
use lptn_report::{duration, significant};

use super::ReduceAnswer;
use crate::words::count;

impl ReduceAnswer {
    /// Notes in addition to the numbers.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.near.is_some() {
            notes.push(
                "inputs, controls and comparisons are fixed at this state; Q_N is the heat of its \
                 sources, and T_ref gives the port its temperature"
                    .to_owned(),
            );
        } else if self.input.netlist.network.has_time_dependent_inputs() {
            notes.push(
                "the inputs change with time; T_ref and Q_N are those at the start of the run"
                    .to_owned(),
            );
        }
        notes.extend(self.switched().filter(|_| self.near.is_none()));
        notes.extend(self.apart());
        let Some(dynamics) = &self.reduction.dynamics else {
            notes
                .push("the port sees no capacity: T = T_ref + R_eq Q_N at every moment".to_owned());
            return notes;
        };
        notes.extend(self.elsewhere());
        notes.push(match dynamics.window {
            Some(window) => fitted(window, dynamics, self.near.is_some()),
            None if self.near.is_some() => "modes oscillate, coincide or fall at first: R_eq, \
                 T_ref, Q_N, sum and first_moment are those of the linear network, and no error of \
                 a step is known"
                .to_owned(),
            None => "streams go on from node to node: R_eq, T_ref, Q_N, sum and first_moment are \
                     exact, while tau_1, the other definitions and the error of a step would need \
                     modes that may oscillate"
                .to_owned(),
        });
        if let Some(tolerance) = dynamics.tolerance {
            notes.push(format!(
                "runs are compared at a tolerance of {} K",
                significant(tolerance, 2)
            ));
        }
        notes.extend(self.at_once(dynamics));
        notes.extend(unresolved(dynamics));
        notes
    }

    /// The notes as lines by themselves, for CSV, which has no place for them.
    pub fn beside_rows(&self) -> Vec<String> {
        let short = self.reduction.dynamics.as_ref().and_then(|dynamics| self.short(dynamics));
        let short = short.map(|short| format!("warning: {short}"));
        short.into_iter().chain(self.notes().iter().map(|note| format!("note: {note}"))).collect()
    }

    /// Note on controls.
    fn switched(&self) -> Option<String> {
        let network = &self.input.netlist.network;
        let stands = |id: lptn_network::ControlId| {
            let on = network.thermostat(id).is_some_and(|thermostat| thermostat.start);
            format!("`{}` {}", network.controls()[id.index()].name, if on { "on" } else { "off" })
        };
        let stand: Vec<String> = network.control_ids().map(stands).collect();
        let says =
            if self.input.netlist.initial().is_some() { "the state" } else { "their `start`" };
        (!stand.is_empty()).then(|| {
            format!(
                "T_ref and Q_N are those with {}, as {says} says; switching over the run is not \
                 compared",
                stand.join(", ")
            )
        })
    }

    /// Note on nodes that heat from the port does not reach.
    fn apart(&self) -> Option<String> {
        let response = &self.reduction.norton.response;
        let reached = response.iter().filter(|rise| **rise > 0.0).count();
        let apart = response.len() - reached;
        (apart > 0).then(|| {
            let reached = count(reached, "node");
            format!(
                "C_eq is that of the {reached} that heat from the port reaches; {apart} apart from \
                it do not matter"
            )
        })
    }

    /// Note on heat that does not enter at the port.
    fn elsewhere(&self) -> Option<String> {
        let network = &self.input.netlist.network;
        let norton = &self.reduction.norton;
        let away = network.sources().iter().zip(&norton.source_weights).find(|(source, weight)| {
            **weight > 0.0 && source.into.iter().any(|(node, _)| *node != norton.port)
        });
        away.map(|(source, _)| {
            format!(
                "`{}` heats other nodes than {}: in one node its heat comes at once",
                source.name(),
                self.port
            )
        })
    }

    /// Note on a run that is shorter than the slowest time constant.
    pub(super) fn short(&self, dynamics: &Dynamics) -> Option<String> {
        dynamics.tolerance?;
        let run = self.input.netlist.run.as_ref()?;
        let (length, slowest) = (run.stop - run.start, dynamics.step.as_ref()?.slowest().tau);
        (length < slowest).then(|| {
            format!(
                "the run of {} is shorter than tau_1, {}: its error does not cover later times",
                duration(length, 4),
                duration(slowest, 4)
            )
        })
    }

    /// Note on a port whose rise jumps.
    fn at_once(&self, dynamics: &Dynamics) -> Option<String> {
        let step = dynamics.step.as_ref()?;
        let nearest = dynamics.pair(Definition::LeastSquares)?;
        (nearest.capacity <= 0.0).then(|| {
            let share = significant(100.0 * step.direct / step.resistance, 3);
            format!(
                "{share} % of the rise at the port is immediate: a heat capacity of zero is \
                 nearest to that"
            )
        })
    }
}

/// Note on the window of the least-squares fit.
fn fitted(window: LeastSquaresWindow, dynamics: &Dynamics, near: bool) -> String {
    let length = duration(window.length(), 4);
    let fits = format!("least_squares fits the response to a step over {length}");
    match window {
        LeastSquaresWindow::Given(_) => fits,
        LeastSquaresWindow::Run(_) => format!("{fits}, as long as the run"),
        LeastSquaresWindow::TimeConstants(_) if near => {
            format!("no run is compared near a state; {fits}, five times tau_1")
        }
        LeastSquaresWindow::TimeConstants(_) if dynamics.tolerance.is_none() => {
            format!("without [run] no run is compared; {fits}, five times tau_1")
        }
        LeastSquaresWindow::TimeConstants(_) => format!("{fits}, five times tau_1"),
    }
}

/// Note on modes that are too fast to be resolved.
fn unresolved(dynamics: &Dynamics) -> Option<String> {
    let step = dynamics.step.as_ref()?;
    (step.residual > 1e-6 * step.resistance).then(|| {
        let share = significant(100.0 * step.residual / step.resistance, 2);
        format!(
            "the fastest modes, {share} % of R_eq, are not resolved: the errors for a step are \
            valid except at its very beginning"
        )
    })
}
