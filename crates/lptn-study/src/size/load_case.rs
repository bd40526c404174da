//! Load cases: the network in each of them.

use lptn_network::{BuildErrors, Course, Network, ParameterId, SignalId};

/// Parameters and signals that are set together: a hot day, a cold start, a drive cycle.
#[derive(Clone, Debug, Default)]
pub struct LoadCase {
    /// Its name.
    pub name: String,
    /// The parameters with their values in SI units.
    pub set: Vec<(ParameterId, f64)>,
    /// The signals with their time histories.
    pub signals: Vec<(SignalId, Course)>,
}

impl LoadCase {
    /// A network with the signals of the case, and the parameters of the case and of a design.
    pub(super) fn network(
        &self,
        base: &Network,
        design: &[(ParameterId, f64)],
    ) -> Result<Network, BuildErrors> {
        let mut parameters = base.given();
        self.set.iter().chain(design).for_each(|(id, value)| parameters.set(*id, *value));
        let network = base.with(&parameters)?;
        match self.signals.as_slice() {
            [] => Ok(network),
            signals => network.recorded(signals, &[]),
        }
    }
}
