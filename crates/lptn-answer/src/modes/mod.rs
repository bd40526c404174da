//! The time constants of a network, and the nodes that take part in each.

mod figure;
mod page;

use std::sync::Arc;

use lptn_netlist::{Diagnostic, Files};
use lptn_network::Network;
use lptn_solve::{Modes, ModesError};

use crate::answer::Answer;
use crate::failure::Failure;
use crate::input::Input;
use crate::listener::Listener;
use crate::operating_point::{OperatingPoint, place};

/// Default number of modes: all up to the first number, else the second, the slowest.
const ALL_UP_TO: usize = 20;
const OF_MORE: usize = 10;

/// The question for the time constants of a network.
#[derive(Clone, Debug, Default)]
pub struct ModesQuestion {
    /// Number of modes, the slowest first; `None` for all of up to 20, or 10.
    pub count: Option<usize>,
    /// The state at which a nonlinear network has these modes, `steady` or a time of its run.
    /// `None` for a network that is linear.
    pub at: Option<String>,
}

/// Modes and how they are shown.
#[derive(Debug)]
pub struct ModesAnswer {
    input: Arc<Input>,
    /// The slowest first.
    pub modes: Modes,
    /// Number of modes in all.
    pub all: usize,
    /// The state whose small disturbances have these modes.
    point: Option<OperatingPoint>,
}

impl ModesQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A state that cannot be computed, and a network that is not linear or has no modes.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<ModesAnswer, Failure> {
        let system = input.assemble()?;
        let point = self.at.as_deref().map(|text| OperatingPoint::find(text, &input, listener));
        let point = point.transpose()?;
        let state = point.as_ref().map(|point| &point.state);
        let modes = Modes::of(&system, state, self.count.unwrap_or(OF_MORE));
        let modes = modes.map_err(|error| failed(&input, &error));
        let mut modes = match &point {
            Some(point) => point.passed(modes, (&input, listener))?,
            None => modes?,
        };
        let all = modes.all();
        modes.truncate(self.count.unwrap_or(if all <= ALL_UP_TO { all } else { OF_MORE }));
        Ok(ModesAnswer { input, modes, all, point })
    }
}

/// A failure at the place that makes the network nonlinear.
fn failed(input: &Input, error: &ModesError) -> Failure {
    let place = match error {
        ModesError::Linearised(error) => place(input, error),
        _ => None,
    };
    input.failure(error, place)
}

impl Answer for ModesAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), self.doubts_of_state()].concat()
    }
}

impl ModesAnswer {
    fn network(&self) -> &Network {
        &self.input.netlist.network
    }

    /// The node that takes most part in the slowest mode.
    pub fn slowest(&self) -> Option<&str> {
        let parts = &self.modes.modes().first()?.participation;
        let most = parts.iter().zip(self.network().nodes());
        most.max_by(|a, b| a.0.total_cmp(b.0)).map(|(_, node)| node.name.as_str())
    }

    /// Doubts in the state whose modes they are.
    fn doubts_of_state(&self) -> &[Diagnostic] {
        self.point.as_ref().map_or(&[], |point| &point.doubts)
    }
}
