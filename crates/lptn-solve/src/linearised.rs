//! The response of a network to small disturbances of one state: `C dx/dt = J x`.
//!
//! The linear network has the Jacobian of the assembly and the capacities at a snapshot, and it is
//! compared with the full one. Its users (such as modes) need not know how the state was found.
//! Dense modes of networks with constant elements keep separate matrices (`exact`), which are the
//! independent check of this one.

use std::fmt;

use faer::Mat;
use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::{Pattern, dense};
use lptn_network::{InputError, Item, NodeId};

use crate::pipe;
use crate::snapshot::Snapshot;
use crate::times::just_after;

lptn_units::errors! {
/// Reason why a network cannot be linearised near a state.
#[derive(Clone, Debug)]
pub enum LinearisedError {
    /// An element or input has no value there.
    Input => InputError;
    /// It is not linear, and no state is named; the first such item.
    NotLinear { item: Item, name: String } = "linearised::not_linear",
        format!("`{name}` makes the network more than constant capacities and conductances"),
        help "name the state to linearise at: --at steady, or a time such as --at \"20 min\"";
    /// A node takes up latent heat at exactly its temperature there; its name.
    Melts { name: String } = "linearised::melts",
        format!("`{name}` melts there: its temperature does not respond to heat"),
        help "choose an operating point at which it is solid or molten";
    /// The fluid in a pipe is not among its states.
    Pipe { name: String } = "linearised::pipe",
        format!("the fluid in the pipe `{name}` entered earlier: no small linear network has that"),
        help "join the two ends of the pipe by an [advection], which has no delay";
    /// The capacity of a node follows a state; its name.
    Mass { name: String } = "linearised::mass",
        format!("the capacity of `{name}` follows a state: no small linear network has that"),
        help "write the capacity at the operating point as a number";
    /// A state is sampled; its name.
    Sampled { name: String } = "linearised::sampled",
        format!("`{name}` is sampled: no small linear network has that"),
        help "use a state with a `rate`, a controller without `sample`";
    /// The balances of the massless nodes cannot be solved for them.
    Singular = "linearised::singular",
        "the massless nodes do not respond to a small disturbance there",
        help "give them a capacity", class lptn_units::Class::Numbers;
}
}

/// A network near one of its states, its inputs and positions fixed as they are there.
pub struct Linearised<'a> {
    system: &'a ThermalSystem,
    work: Workspace,
    /// Temperature of each unknown in K.
    at: Vec<f64>,
    /// Capacity of each state there in J/K.
    capacity: Vec<f64>,
    pattern: Pattern,
    /// `J` in W/K in the slots of the pattern, over all unknowns.
    values: Vec<f64>,
}

impl fmt::Debug for Linearised<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Linearised").field("states", &self.capacity.len()).finish_non_exhaustive()
    }
}

/// Comparison of a linear network with its full one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tried {
    /// The largest temperature of the disturbance in K, to either side.
    pub disturbance: f64,
    /// The largest difference of the heat into any node in W.
    pub heat: f64,
    /// The same over the largest heat that the disturbance brings into any node.
    pub share: f64,
    /// The same share for a disturbance of a hundredth of the size.
    pub small: f64,
    /// True if heat flows have slopes there: the share falls with the size.
    pub has_slopes: bool,
}

/// Temperatures in K of disturbances that a linear network is tried with.
pub(crate) const SIZES: [f64; 3] = [10.0, 1.0, 0.1];

/// The share of a disturbance that is missed has to fall at least this many times from the second
/// size to the third, which is a tenth of it: near a state where heat flows have slopes it falls
/// ten times.
const FALLS: f64 = 5.0;

/// A missed share of the heat below this is rounding.
const ROUNDING: f64 = 1e-6;

/// True if the missed share of the third size is small enough next to that of the second.
pub(crate) fn falls(second: f64, third: f64) -> bool {
    FALLS * third <= second
}

impl<'a> Linearised<'a> {
    /// A network that is linear, streams of constant capacity rates among its paths, or else near a
    /// state.
    ///
    /// # Errors
    /// [`LinearisedError`], also for a network that is not linear if no state is named.
    pub fn of(system: &'a ThermalSystem, at: Option<&Snapshot>) -> Result<Self, LinearisedError> {
        if let Some(name) = pipe::first(system) {
            return Err(LinearisedError::Pipe { name });
        }
        if let Some(of) = system.network().state_capacities().first() {
            let name = system.network().name_of(lptn_network::Item::Node(of.node)).into_owned();
            return Err(LinearisedError::Mass { name });
        }
        if let Some(name) = system.network().first_sampled() {
            return Err(LinearisedError::Sampled { name });
        }
        if is_proportional(system) {
            return Self::of_proportional(system);
        }
        let network = system.network();
        match (at, network.first_nonlinear()) {
            (Some(state), _) => Self::near(system, state),
            (None, None) => Self::of_proportional(system),
            (None, Some(item)) => {
                Err(LinearisedError::NotLinear { item, name: network.name_of(item).into_owned() })
            }
        }
    }

    /// Near a snapshot of the system.
    ///
    /// # Errors
    /// [`LinearisedError`]
    pub fn near(system: &'a ThermalSystem, state: &Snapshot) -> Result<Self, LinearisedError> {
        let mut at = vec![0.0; system.unknowns().len()];
        system.unknown_temperatures(&state.temperatures, &mut at);
        let mut work = system.workspace();
        if system.network().has_events() {
            work.set_positions(&state.positions);
        }
        Self::new(system, work, state.time, at)
    }

    /// Linearises a system that is proportional ([`ThermalSystem::is_proportional`]) and so the
    /// same near every state and at every time.
    ///
    /// # Errors
    /// [`LinearisedError`]
    pub fn of_proportional(system: &'a ThermalSystem) -> Result<Self, LinearisedError> {
        let at = vec![lptn_network::ZERO_CELSIUS; system.unknowns().len()];
        Self::new(system, system.workspace(), 0.0, at)
    }

    fn new(
        system: &'a ThermalSystem,
        mut work: Workspace,
        time: f64,
        at: Vec<f64>,
    ) -> Result<Self, LinearisedError> {
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let mut values = vec![0.0; pattern.len()];
        system.read_inputs(&mut work, time, just_after(time))?;
        system.jacobian_at(&mut work, &at, JacobianForm::Exact, &mut values)?;
        let capacity = capacities(system, &at)?;
        Ok(Self { system, work, at, capacity, pattern, values })
    }

    /// The linearised system.
    pub fn system(&self) -> &'a ThermalSystem {
        self.system
    }

    /// Capacity of each state there in J/K, in the order of [`ThermalSystem::states`].
    pub fn capacity(&self) -> &[f64] {
        &self.capacity
    }

    /// True if warming one node brings heat to another exactly as the other way round.
    pub fn is_symmetric(&self) -> bool {
        let rows = self.pattern.row_indices();
        (0..self.pattern.size()).all(|column| {
            self.pattern.column(column).all(|slot| {
                let other = self.pattern.slot(column, rows[slot]);
                other.is_some_and(|other| {
                    self.values[slot].to_bits() == self.values[other].to_bits()
                })
            })
        })
    }

    /// The pattern of the unknowns, and `-J` in W/K in its slots.
    pub(crate) fn conductances(&self) -> (&Pattern, Vec<f64>) {
        (&self.pattern, self.values.iter().map(|v| -v).collect())
    }

    /// `J` of the states in W/K, dense, the massless nodes that are solved for eliminated; and the
    /// shares by which those (rows) follow each state (columns).
    ///
    /// # Errors
    /// [`LinearisedError::Singular`]
    pub(crate) fn dense(&self) -> Result<(Mat<f64>, Mat<f64>), LinearisedError> {
        let (all, states) = (self.pattern.size(), self.capacity.len());
        let mut whole = Mat::<f64>::zeros(all, all);
        for column in 0..all {
            for slot in self.pattern.column(column) {
                whole[(self.pattern.row_indices()[slot], column)] = self.values[slot];
            }
        }
        let algebraic = all - states;
        let block = |i, j, rows, columns| whole.submatrix(i, j, rows, columns);
        let own = block(0, 0, states, states).to_owned();
        if algebraic == 0 {
            return Ok((own, Mat::zeros(0, states)));
        }
        let (of_own, of_states) =
            (block(states, states, algebraic, algebraic), block(states, 0, algebraic, states));
        let follow = dense::solve(of_own, of_states).ok_or(LinearisedError::Singular)?;
        let follow = Mat::from_fn(algebraic, states, |i, j| -follow[(i, j)]);
        let through = dense::product(block(0, states, states, algebraic), follow.as_ref());
        Ok((Mat::from_fn(states, states, |i, j| own[(i, j)] + through[(i, j)]), follow))
    }

    /// The workspace with the inputs there, and the temperatures of the unknowns in K.
    pub(crate) fn workspace(&self) -> (Workspace, &[f64]) {
        (self.work.clone(), &self.at)
    }

    /// Temperatures of all nodes that follow from those of the unknowns, both as differences to the
    /// state in K.
    pub(crate) fn recover(&self, unknowns: &[f64]) -> Vec<f64> {
        let network = self.system.network();
        let mut work = self.system.workspace();
        let rest = (vec![0.0; network.nodes().len()], vec![0.0; network.boundaries().len()]);
        self.system.apply(&mut work, &rest.0, &rest.1);
        self.system.recover(&mut work, unknowns);
        self.system.node_temperatures(&work).to_vec()
    }

    /// Compares the heat of a disturbance of the unknowns in K, and of its opposite, with that of
    /// the full network: the largest difference in W, and its share.
    fn missed(&mut self, disturbance: &[f64]) -> Result<(f64, f64), InputError> {
        let size = disturbance.len();
        let (mut here, mut there) = (vec![0.0; size], vec![0.0; size]);
        self.system.flow(&mut self.work, &self.at, &mut here)?;
        let mut linear = vec![0.0; size];
        self.pattern.multiply(&self.values, disturbance, &mut linear);
        let mut off: f64 = 0.0;
        for sign in [1.0, -1.0] {
            let moved: Vec<f64> =
                self.at.iter().zip(disturbance).map(|(t, x)| (t + sign * x).max(1.0)).collect();
            self.system.flow(&mut self.work, &moved, &mut there)?;
            let differences = there.iter().zip(&here).zip(&linear);
            off = differences.map(|((b, a), q)| (b - a - sign * q).abs()).fold(off, f64::max);
        }
        let most = |values: &[f64]| values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let brought = most(&linear);
        let share = if brought > 0.0 { off / brought } else { 0.0 };
        Ok((off, share))
    }

    /// Compares the heat of a disturbance of all nodes with this shape, and of its opposite, with
    /// that of the full network. The largest temperature is 10 K, then 1 K and 0.1 K. `None` for a
    /// network that is linear itself.
    ///
    /// # Errors
    /// [`LinearisedError::Input`] if the full network has no value there.
    pub fn tried_along(&mut self, shape: &[f64]) -> Result<Option<Tried>, LinearisedError> {
        if is_proportional(self.system) {
            return Ok(None);
        }
        let largest = shape.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let along = |size: f64| -> Vec<f64> {
            let unknowns = self.system.unknowns().iter();
            unknowns.map(|id| size * shape[id.index()] / largest).collect()
        };
        let [large, medium, little] = SIZES.map(along);
        let (heat, share) = self.missed(&large)?;
        let (second, small) = (self.missed(&medium)?.1, self.missed(&little)?.1);
        let has_slopes = small <= ROUNDING || falls(second, small);
        let disturbance = large.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        Ok(Some(Tried { disturbance, heat, share, small, has_slopes }))
    }
}

/// True if a network is the same near every state; streams with constant capacity rates are.
pub(crate) fn is_proportional(system: &ThermalSystem) -> bool {
    let network = system.network();
    system.is_proportional() && network.first_varying_capacity().is_none()
}

/// Capacity of each state in J/K at temperatures of the unknowns in K.
fn capacities(system: &ThermalSystem, at: &[f64]) -> Result<Vec<f64>, LinearisedError> {
    let network = system.network();
    let of = |((&id, &constant), &t): ((&NodeId, &f64), &f64)| {
        let Some(curve) = network.enthalpy(id) else { return Ok(constant) };
        let there = curve.heat(t).and_then(|heat| curve.temperature(heat));
        match there.map(|content| content.capacity) {
            Some(capacity) if capacity.is_finite() => Ok(capacity),
            _ => {
                let name = network.nodes()[id.index()].name.clone();
                Err(LinearisedError::Melts { name })
            }
        }
    };
    system.states().iter().zip(system.capacity()).zip(at).map(of).collect()
}
