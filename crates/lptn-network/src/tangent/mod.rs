//! Derivatives of a network's values by its parameters at fixed temperatures: the right-hand sides
//! of sensitivities.
//!
//! A derivative over a run exists everywhere only if no event moves with a parameter; the adjoint of
//! a run takes events in. A derivative at one moment exists at all positions of controls and
//! comparisons, by signals too.
//!
//! Each value is evaluated on dual numbers by the same code that evaluates it on numbers, the
//! parameters being the variables. Only values that depend on one of them are evaluated at all.

mod content;
mod heat;
mod influence;
mod reads;
mod refusal;

use std::collections::BTreeMap;
use std::collections::hash_map::Entry;
use std::ops::Range;

use foldhash::{HashMap, HashMapExt as _};
use lptn_units::Scalar;

use crate::End;
use crate::evaluation::Slope;
use crate::id::{
    BoundaryId, ConductorId, ControlId, Item, NodeId, ParameterId, SignalId, SourceId, SwitchId,
};
use crate::law::{At, ConductorFlow, Received};
use crate::network::Network;
use crate::slot;
use content::Content;
use heat::Seeds;
use influence::Influence;
use reads::{Lanes, Place, Read};

pub use refusal::NoTangents;

/// A variable that a network is differentiated by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// A parameter.
    Parameter(ParameterId),
    /// A signal. It counts as a constant with its present value.
    Signal(SignalId),
}

/// Derivatives of a network's heat flows and heat contents by some of its parameters or signals.
///
/// All results are in SI units per SI unit of the variable, in blocks, one for each variable in
/// the order in which they were asked for. Evaluating allocates nothing.
#[derive(Clone, Debug)]
pub struct Tangents {
    variables: Vec<Variable>,
    passes: Vec<Pass>,
    /// The heats that are kept: a vertex, the position of a variable, the change in W.
    kept: Vec<(usize, usize, f64)>,
    /// By conductor, its places in `slopes`.
    shared: HashMap<ConductorId, Range<usize>>,
    /// Derivatives in W/K of the heats of both ends by the temperatures that conductors read.
    slopes: Vec<Received>,
}

/// Variables that are followed together: those with one place in the dual numbers change nothing in
/// common.
#[derive(Clone, Debug)]
struct Pass {
    slots: Vec<Slope>,
    stack: Vec<Slope>,
    /// Temperatures of all boundaries in K.
    boundaries: Vec<Slope>,
    /// Signals that are variables, with their places.
    signals: Vec<(SignalId, usize)>,
    reads: Reads,
}

/// All that changes with a variable of one pass.
#[derive(Clone, Debug, Default)]
struct Reads {
    conductors: Vec<Path>,
    sources: Vec<(SourceId, Lanes)>,
    boundaries: Vec<BoundaryId>,
    /// Signals that are expressions of the parameters.
    signals: Vec<SignalId>,
    contents: Vec<(Content, Lanes)>,
}

/// A conductor that changes with a variable of one pass.
#[derive(Clone, Debug)]
struct Path {
    id: ConductorId,
    /// The vertices of its ends.
    ends: [usize; 2],
    lanes: Lanes,
    law: Known,
    /// In one of the passes of a conductor.
    seeds: Option<Seeds>,
}

/// The value of a law, if it is constant over a run.
#[derive(Clone, Debug)]
enum Known {
    No,
    /// In W/K.
    Conductance(Slope),
    /// An exchange area or a capacity rate.
    Other(Slope),
}

impl Network {
    /// Prepares derivatives by these parameters. One that is an expression of others counts as a
    /// separate variable if it is among them.
    ///
    /// # Errors
    /// [`NoTangents`] if a derivative by them does not exist everywhere or cannot be computed.
    pub fn tangents(&self, parameters: &[ParameterId]) -> Result<Tangents, NoTangents> {
        let variables: Vec<Variable> =
            parameters.iter().copied().map(Variable::Parameter).collect();
        let influence = Influence::new(self, &variables);
        refusal::check_events(&influence)?;
        self.tangents_over_time(&influence, &variables)
    }

    /// The same between events: those of controls and comparisons may move with the parameters.
    ///
    /// # Errors
    /// [`NoTangents`]
    pub fn tangents_between_events(
        &self,
        parameters: &[ParameterId],
    ) -> Result<Tangents, NoTangents> {
        let variables: Vec<Variable> =
            parameters.iter().copied().map(Variable::Parameter).collect();
        self.tangents_over_time(&Influence::new(self, &variables), &variables)
    }

    fn tangents_over_time(
        &self,
        influence: &Influence<'_>,
        variables: &[Variable],
    ) -> Result<Tangents, NoTangents> {
        refusal::check_jumps(influence)?;
        refusal::check_pipes(self)?;
        refusal::check_samples(self)?;
        self.tangents_of(influence, variables)
    }

    /// True if the distance of a control from its threshold changes with one of these parameters at
    /// fixed temperatures of the nodes.
    pub fn control_follows(&self, id: ControlId, parameters: &[ParameterId]) -> bool {
        let influence = Influence::of(self, parameters);
        self.thermostat(id).is_some_and(|of| {
            let senses = match of.sense {
                End::Boundary(id) => influence.boundary(id),
                End::Node(_) => false,
            };
            senses || influence.value(&of.on) || influence.value(&of.off)
        })
    }

    /// The node that a control senses; `None` if it senses a boundary.
    pub fn node_of_control(&self, id: ControlId) -> Option<NodeId> {
        match self.thermostat(id)?.sense {
            End::Node(id) => Some(id),
            End::Boundary(_) => None,
        }
    }

    /// True if the difference of the sides of a comparison changes with one of these parameters at
    /// fixed temperatures of the nodes.
    pub fn comparison_follows(&self, id: SwitchId, parameters: &[ParameterId]) -> bool {
        Influence::of(self, parameters).program(&self.switches()[id.index()].difference)
    }

    /// True if a limit or report jumps at a time which no event marks and which depends on
    /// temperatures or on these parameters: its integral and extremes change with that time.
    pub fn result_jump_moves(&self, item: Item, parameters: &[ParameterId]) -> bool {
        Influence::of(self, parameters).moves_jump_of(item)
    }

    /// The same at one moment, and by signals too. Controls and comparisons keep the positions of the
    /// evaluation. No variable may occur twice.
    ///
    /// # Errors
    /// [`NoTangents`] for how a node melts, for the specific heat of a fluid and for the ratio of
    /// the radii of a round grid.
    pub fn tangents_at_a_moment(&self, variables: &[Variable]) -> Result<Tangents, NoTangents> {
        self.tangents_of(&Influence::new(self, variables), variables)
    }

    fn tangents_of(
        &self,
        influence: &Influence<'_>,
        variables: &[Variable],
    ) -> Result<Tangents, NoTangents> {
        refusal::check_capacities(self)?;
        refusal::check_fluids(self, influence)?;
        refusal::check_faces(self, influence)?;
        refusal::check_patches(self, influence)?;
        let mut given = self.numbers.given.clone();
        for variable in variables {
            if let Variable::Parameter(id) = variable {
                given[id.index()] = true;
            }
        }
        let mut passes = Vec::new();
        let mut bodies = content::Bodies::new(self, influence);
        for (places, reads) in reads::passes(self, variables, &given) {
            let mut pass = Pass::new(self, &places, &given);
            refusal::check_rings(self, influence, &mut pass)?;
            pass.take(self, reads, &mut bodies)?;
            passes.push(pass);
        }
        let (mut shared, mut slopes) = (HashMap::new(), Vec::new());
        for path in passes.iter_mut().flat_map(|pass| &mut pass.reads.conductors) {
            let Entry::Vacant(place) = shared.entry(path.id) else { continue };
            path.seeds = Seeds::of(self, (path.id, &path.lanes));
            if let Some(seeds) = &mut path.seeds {
                place.insert(seeds.enter(&mut slopes));
            }
        }
        Ok(Tangents { variables: variables.to_vec(), passes, kept: Vec::new(), shared, slopes })
    }
}

impl Tangents {
    /// The parameters and signals that derivatives are taken by, in this order.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// True if the heat content of a node changes with one of the variables.
    pub fn change_contents(&self) -> bool {
        self.passes.iter().any(|pass| !pass.reads.contents.is_empty())
    }

    /// The first node with a capacity over temperature whose heat content changes with one of the
    /// variables.
    pub fn enthalpy_that_changes(&self, network: &Network) -> Option<NodeId> {
        let contents = self.passes.iter().flat_map(|pass| &pass.reads.contents);
        let nodes = contents.map(|(content, _)| content.node());
        nodes.filter(|id| network.enthalpy(*id).is_some()).min()
    }
}

impl Pass {
    /// The slots with the parameters in them, the expressions among these evaluated in their order.
    /// Variables of other passes are constant. `given` are the parameters that follow from no other.
    fn new(network: &Network, places: &[Place], given: &[bool]) -> Self {
        let layout = &network.parts.layout;
        let mut slots = vec![Slope::constant(f64::NAN); layout.len()];
        slots[slot::TIME as usize] = Slope::constant(0.0);
        slots[slot::SEGMENT as usize] = Slope::constant(0.0);
        let mut stack = Vec::new();
        let (mut lanes, mut signals) = (vec![None; network.parameters().len()], Vec::new());
        for &(variable, lane) in places {
            match variable {
                Variable::Parameter(id) => lanes[id.index()] = Some(lane),
                Variable::Signal(id) => signals.push((id, lane)),
            }
        }
        for id in network.parameter_ids() {
            let number = network.parameter_value(id);
            let value = &network.parameters()[id.index()].value;
            let dual = match lanes[id.index()] {
                Some(lane) => Slope::variable(number, lane),
                None if given[id.index()] => Slope::constant(number),
                None => value.on(&slots, &mut stack).unwrap_or(Slope::constant(number)),
            };
            slots[layout.parameter(id) as usize] = dual;
        }
        Self {
            slots,
            stack,
            boundaries: vec![Slope::constant(f64::NAN); network.boundaries().len()],
            signals,
            reads: Reads::default(),
        }
    }

    /// Keeps the heats and contents that change with the variables.
    fn take(
        &mut self,
        network: &Network,
        reads: BTreeMap<Read, Lanes>,
        bodies: &mut content::Bodies<'_>,
    ) -> Result<(), NoTangents> {
        for (read, lanes) in reads {
            match read {
                Read::Conductor(id) => {
                    let law = self.known_law(network, id);
                    let conductor = &network.conductors()[id.index()];
                    let ends = [conductor.from, conductor.to].map(|end| network.vertex(end));
                    self.reads.conductors.push(Path { id, ends, lanes, law, seeds: None });
                }
                Read::Source(id) => self.reads.sources.push((id, lanes)),
                Read::Boundary(id) => self.reads.boundaries.push(id),
                Read::Signal(id) => self.reads.signals.push(id),
                Read::Content(id) => {
                    let content = bodies.content(id, self)?;
                    self.reads.contents.push((content, lanes));
                }
                Read::Grid(_) => {}
            }
        }
        Ok(())
    }

    /// The value of the law of a conductor that reads neither temperatures nor the time. One that
    /// fails is not known: its use reports it.
    fn known_law(&mut self, network: &Network, id: ConductorId) -> Known {
        let law = &network.conductors()[id.index()].law;
        let flow = network.flow(id);
        let varies = flow == ConductorFlow::Variable || network.along(id).is_some();
        if varies || law.fluid().is_some() {
            return Known::No;
        }
        match (At::new((&mut self.slots, &mut self.stack)).value(law), flow) {
            (Ok(value), ConductorFlow::Conductance(_)) if value.is_finite() => {
                Known::Conductance(value)
            }
            (Ok(value), _) => Known::Other(value),
            (Err(_), _) => Known::No,
        }
    }
}
