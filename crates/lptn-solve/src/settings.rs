//! The settings of a run, and how it reports on itself.

use lptn_assembly::ThermalSystem;
use lptn_integrate::{Allowance, LinearSolver, Options};
use lptn_network::{
    End, IntegratorChoice, Network, NodeId, OutputTimes, ParameterId, RunSettings, Time,
};

use crate::curved::Curved;
use crate::drawn::Drawn;
use crate::events::ControlState;
use crate::growth;
use crate::selection::{RecordedNodes, Selection};
use crate::settings_error::SettingsError;
use crate::times;
use crate::watch::Watch;
use crate::window::Window;

/// The settings of a run.
#[derive(Clone, Debug)]
pub struct Transient {
    /// Start in s; `t` in expressions begins here.
    pub start: f64,
    /// Stop in s.
    pub stop: f64,
    /// Times at which a row is written.
    pub output: OutputTimes,
    /// Tolerance in K. For networks whose nodes all lead to a boundary the error stays below ten
    /// times this, from 1e-3 to 1e-5 K (measured in the tests).
    pub tolerance: f64,
    /// Largest allowed residual of the energy balance as a share of the total heat; `None` for that
    /// of [`crate::Ledger::bound`].
    pub balance_error: Option<f64>,
    /// Nodes and columns that are recorded.
    pub record: RecordedNodes,
    /// Nodes that are evaluated between the rows too.
    pub watch: Vec<Watch>,
    /// True if only the hottest of these counts: the peak of another may be missed if the hottest
    /// is higher.
    pub hottest_only: bool,
    /// Windows of time over which means and extremes are taken; inside the run.
    pub windows: Vec<Window>,
    /// The columns of a picture, which are read on both sides of each known jump, bend and switch
    /// too: see [`crate::Table::with_jumps`].
    pub drawn: Option<Drawn>,
    /// The node or boundary whose heat balance is computed.
    pub balance: Option<End>,
    /// States of the controls at the start, in the order of their ids; default: those of the
    /// network. A control that has to stay as it is does so from its last switch, which may be
    /// before the start.
    pub controls: Vec<ControlState>,
    /// The parameters by which temperatures are differentiated, each once: see
    /// [`crate::Solution::sensitivity`].
    pub sensitivities: Vec<ParameterId>,
    /// True if the states at every time are kept, for [`crate::Solution::margin_gradient`].
    pub trajectory: bool,
    /// True if proven bounds on the errors are computed: see [`crate::Solution::certificate`].
    pub certify: bool,
    /// The columns other than temperatures of nodes whose rows get bounds too.
    pub certified: Option<Selection>,
    /// The starts of the exact solutions that the proven bounds take in; `None` for that of the run.
    pub around: Option<Around>,
    /// The integrator; default: chosen by the network.
    pub integrator: IntegratorChoice,
    /// The linear solver; default: chosen by size.
    pub linear_solver: LinearSolver,
}

/// Starts of exact solutions near that of a run.
#[derive(Clone, Debug)]
pub struct Around {
    /// A state, in K.
    pub centre: Vec<f64>,
    /// Bounds in K on the distance of each start from it.
    pub bounds: Vec<f64>,
    /// The proven bounds of the run add less than those of a run with this share of its tolerance.
    pub share: f64,
}

/// Progress of a run.
#[derive(Clone, Copy, Debug)]
pub struct Progress {
    /// Start of the run in s.
    pub start: f64,
    /// Time reached in s.
    pub time: f64,
    /// Stop of the run in s.
    pub stop: f64,
}

/// Decision to continue or end a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proceed {
    /// It continues.
    Continue,
    /// It ends here; the results up to then are kept.
    Interrupt,
}

impl Transient {
    /// A run from 0 to `stop` with 300 intervals between its rows and a tolerance of 1e-5 K.
    pub fn until(stop: Time) -> Self {
        Self {
            start: 0.0,
            stop: stop.0,
            output: OutputTimes::Every(stop.0 / OutputTimes::USUAL_INTERVALS),
            tolerance: 1e-5,
            balance_error: None,
            record: RecordedNodes::All,
            watch: Vec::new(),
            hottest_only: false,
            windows: Vec::new(),
            drawn: None,
            balance: None,
            controls: Vec::new(),
            sensitivities: Vec::new(),
            trajectory: false,
            certify: false,
            certified: None,
            around: None,
            integrator: IntegratorChoice::Auto,
            linear_solver: LinearSolver::Auto,
        }
    }

    /// The run that `settings` describe: its times, rows and tolerance, and the states of the
    /// controls at its start. The caller sets the recorded, watched and averaged quantities.
    pub fn of(network: &Network, settings: &RunSettings) -> Self {
        let since =
            |held: &Option<f64>| held.map_or(f64::NEG_INFINITY, |held| settings.start - held);
        // none for a run that starts from no state: it begins as the network says
        let stands = network.initial_positions().controls.into_iter().zip(&settings.held);
        Self {
            start: settings.start,
            output: settings.output.clone(),
            tolerance: settings.tolerance,
            balance_error: settings.balance_error,
            integrator: settings.integrator,
            controls: stands.map(|(on, held)| ControlState { on, since: since(held) }).collect(),
            ..Self::until(Time(settings.stop))
        }
    }

    /// Writes a row every `interval`.
    #[must_use]
    pub fn every(mut self, interval: Time) -> Self {
        self.output = OutputTimes::Every(interval.0);
        self
    }

    /// Writes a row at each of these times in s.
    #[must_use]
    pub fn at(mut self, times: &[f64]) -> Self {
        self.output = OutputTimes::At(times.to_vec());
        self
    }

    /// Sets the tolerance in K.
    #[must_use]
    pub fn tolerance(mut self, kelvin: f64) -> Self {
        self.tolerance = kelvin;
        self
    }

    /// Records only these nodes.
    #[must_use]
    pub fn record(mut self, nodes: &[NodeId]) -> Self {
        self.record = RecordedNodes::Nodes(nodes.to_vec());
        self
    }

    /// Follows the derivatives of all temperatures by these parameters.
    #[must_use]
    pub fn sensitivities(mut self, parameters: &[ParameterId]) -> Self {
        self.sensitivities = parameters.to_vec();
        self
    }

    /// Takes means and extremes over a window.
    #[must_use]
    pub fn window(mut self, window: Window) -> Self {
        self.windows.push(window);
        self
    }

    /// Requests the heat balance of a node or boundary.
    #[must_use]
    pub fn balance(mut self, of: impl Into<End>) -> Self {
        self.balance = Some(of.into());
        self
    }

    /// The times in s at which a row is written, from the start to the stop.
    ///
    /// # Errors
    /// [`SettingsError`] if the settings contradict themselves.
    pub fn rows(&self) -> Result<Vec<f64>, SettingsError> {
        self.check()?;
        let rows = times::rows(&self.output, self.start, self.stop)?;
        match rows.windows(2).find(|pair| pair[0] >= pair[1]) {
            Some(pair) => Err(SettingsError::SameTime { time: pair[1] }),
            None => Ok(rows),
        }
    }

    pub(crate) fn check(&self) -> Result<(), SettingsError> {
        let (start, stop) = (self.start, self.stop);
        if !(start.is_finite() && stop.is_finite() && start < stop) {
            return Err(SettingsError::Interval { start, stop });
        }
        if !(self.tolerance.is_finite() && self.tolerance > 0.0) {
            return Err(SettingsError::Tolerance(self.tolerance));
        }
        for Window { name, from, to, .. } in &self.windows {
            if !(start <= *from && from < to && *to <= stop) {
                return Err(SettingsError::Window { name: name.clone(), from: *from, to: *to });
            }
        }
        Ok(())
    }

    /// The options of the integrator, with the needs of curved inputs. `switches`: something
    /// switches or jumps; `grows`: growth of errors.
    pub(crate) fn options(
        &self,
        system: &ThermalSystem,
        (switches, grows): (bool, f64),
        curved: Option<&Curved>,
    ) -> Options {
        let network = system.network();
        let switching = if switches { SWITCHING } else { 1.0 };
        let switching = (switching * growth::share(grows)).max(self.finest()).min(1.0);
        Options {
            sensitivity_scales: self.sensitivities.iter().map(|&id| scale(network, id)).collect(),
            tolerance: self.tolerance * curved.map_or(1.0, |c| c.share).min(switching),
            linear_solver: self.linear_solver,
            integrals: Allowance {
                share: self.tolerance / USUAL_CHANGE,
                amount: self.tolerance * system.capacity().iter().sum::<f64>(),
            },
            ..Options::default()
        }
    }
}

impl Transient {
    /// The smallest share of the tolerance that the integrator gets if something switches or errors
    /// grow.
    pub(crate) fn finest(&self) -> f64 {
        FINEST / self.tolerance
    }
}

/// The share of the tolerance that the integrator gets if something switches. An error of a
/// temperature moves the next switch by itself over the slope there, and that change moves all
/// later ones; no later step compensates it. With a sensor far from its heater each switch was
/// measured to add nine tolerances: a hundred must add less than ten.
const SWITCHING: f64 = 0.01;

/// In K: nothing is tightened below this value, because rounding decides there.
pub(crate) const FINEST: f64 = 1e-8;

/// The change of a temperature in K whose effect must be as accurate as the temperatures are. Heats
/// are computed to the tolerance as a share of it, or to the tolerance times all capacities
/// together. The error of the states says little about the heat if capacities are so small that
/// they follow at once.
const USUAL_CHANGE: f64 = 10.0;

/// The change of a parameter, in its SI unit, whose effect must be as accurate as the temperatures
/// are: all of it, or the `±` of one that is zero.
fn scale(network: &Network, id: ParameterId) -> f64 {
    let parameter = &network.parameters()[id.index()];
    let value = network.parameter_value(id);
    let size = if parameter.ty.absolute { USUAL_CHANGE } else { value.abs() };
    let usual = [size, parameter.deviation.map_or(0.0, |spread| spread.sigma(value))];
    usual.into_iter().find(|scale| scale.is_finite() && *scale > 0.0).unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scripted::bodies;

    /// A hundredth if something switches, and a quarter of the inverse growth of errors; no finer
    /// than the integrator can be.
    #[test]
    fn the_integrator_gets_a_share_of_the_tolerance() {
        let system = ThermalSystem::assemble(&bodies(&[(30.0, "1 [W]"), (12.0, "1 [W]")], None));
        let system = system.unwrap_or_else(|_| panic!("no system"));
        let share = |tolerance: f64, switches: bool, grows: f64| {
            let settings = Transient::until(Time(1.0)).tolerance(tolerance);
            let options = settings.options(&system, (switches, grows), None);
            assert!((options.integrals.amount / (42.0 * tolerance) - 1.0).abs() < 1e-12);
            assert!((options.integrals.share * USUAL_CHANGE / tolerance - 1.0).abs() < 1e-12);
            options.tolerance / tolerance
        };
        let near =
            |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
        near(share(1e-3, false, 1.0), 1.0);
        near(share(1e-3, true, 1.0), 0.01);
        near(share(1e-3, false, 5.0), 0.05);
        near(share(1e-3, true, 5.0), 5e-4);
        near(share(1e-3, true, 1e9), FINEST / 1e-3);
        near(share(0.5 * FINEST, true, 5.0), 1.0);
        near(Transient::until(Time(1.0)).tolerance(1e-3).finest(), FINEST * 1e3);
    }
}
