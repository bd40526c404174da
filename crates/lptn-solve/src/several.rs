//! Other steady states than the one that was found.
//!
//! The search starts from shifted temperatures, and only if the form of the network does not
//! exclude other states. A search that finds none does not prove that there is none.

use lptn_assembly::{ThermalSystem, Workspace};

use crate::newton::Newton;

/// Knowledge of steady states other than the one that was found.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Others {
    /// There is none, or none was met: the network reaches this state from its start.
    #[default]
    None,
    /// There is at least this one, temperatures of the nodes in K; from its start the network does
    /// not reach it.
    At(Vec<f64>),
    /// There is at least this one, temperatures of the nodes in K, but it is unstable: from beyond
    /// it the network goes elsewhere.
    Unstable(Vec<f64>),
    /// There may be others, and the network could not be followed from its start to this one.
    NotKnown,
}

/// Two steady states that differ by less, in K, are one.
const SAME: f64 = 1e-5;

/// Offsets in K of all nodes at which a search begins.
const APART: [f64; 4] = [200.0, 50.0, -50.0, -200.0];

/// No search begins below this temperature in K.
const COLDEST_START: f64 = 1.0;

/// Starting point of the search for a steady state, in K: nodes at their start; massless ones at
/// their given start, or at the mean of all known temperatures.
pub(crate) fn start(system: &ThermalSystem, work: &Workspace) -> Vec<f64> {
    let mut temperatures = system.initial();
    let boundaries = system.boundary_temperatures(work);
    let known = boundaries.iter().chain(&temperatures).copied();
    let (sum, count) = known.fold((0.0, 0.0), |(sum, count), t| (sum + t, count + 1.0));
    let begins = |id: &lptn_network::NodeId| system.network().begins(*id).unwrap_or(sum / count);
    temperatures.extend(system.unknowns()[temperatures.len()..].iter().map(begins));
    // at 0 K radiation shows no direction
    for (id, t) in system.unknowns().iter().zip(&mut temperatures) {
        if system.network().is_thermal(*id) {
            *t = t.max(COLDEST_START);
        }
    }
    temperatures
}

/// True if two states are the same but for rounding.
pub(crate) fn same(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) <= SAME
}

impl Others {
    /// Searches for another steady state than `found` (all unknowns, in K) with the inputs of
    /// `work`, from hotter and colder temperatures of all nodes. A stable one has precedence over
    /// an unstable one.
    pub(crate) fn search(system: &ThermalSystem, work: &mut Workspace, found: &[f64]) -> Self {
        let Ok(mut newton) = Newton::new(system, (0..found.len()).collect()) else {
            return Self::None;
        };
        let mut unstable = Self::None;
        for apart in APART {
            let mut other: Vec<f64> =
                found.iter().map(|t| (t + apart).max(COLDEST_START)).collect();
            newton.bring_inside(work, &mut other);
            let solved = newton.damped(work, &mut other).is_ok();
            if !solved || same(&other, found) || other.iter().any(|t| *t < 0.0) {
                continue;
            }
            let Ok(moved) = newton.unstable(work, &other) else { continue };
            system.recover(work, &other);
            let temperatures = system.node_temperatures(work).to_vec();
            match moved {
                None => return Self::At(temperatures),
                Some(_) => unstable = Self::Unstable(temperatures),
            }
        }
        unstable
    }

    /// Temperatures of the nodes in K of another steady state that is stable.
    pub(crate) fn stable(&self) -> Option<&[f64]> {
        match self {
            Self::At(temperatures) => Some(temperatures),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::float_cmp, reason = "numbers that are given")]

    use super::*;
    use crate::scripted::{bodies, workspace};

    /// Two bodies and air at 300 K, and a massless node among them.
    #[test]
    fn a_search_begins_at_the_start_and_in_the_middle_of_all_that_is_known() {
        let own = "-1 [W/K] * (T - absolute(300 [K]))";
        let network = bodies(&[(1.0, "1 [W]"), (0.0, own), (1.0, "1 [W]")], None);
        let system = ThermalSystem::assemble(&network).unwrap_or_else(|_| panic!("no system"));
        assert_eq!(start(&system, &workspace(&system)), [300.0; 3]);
    }

    #[test]
    fn states_are_one_to_a_hundred_thousandth_of_a_kelvin() {
        assert!(same(&[300.0, 310.0], &[300.0 + 9e-6, 310.0 - 9e-6]));
        assert!(!same(&[300.0, 310.0], &[300.0, 310.0 + 1.1e-5]));
        assert!(!same(&[300.0, 310.0], &[300.0 - 1.1e-5, 310.0]));
    }
}
