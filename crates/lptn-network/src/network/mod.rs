//! A thermal network whose invariants are guaranteed.

pub(crate) mod alike;
pub(crate) mod axes;
pub(crate) mod body;
mod capacity;
pub(crate) mod conductivity;
pub(crate) mod control;
mod enclosed_gates;
mod enclosed_results;
pub(crate) mod enclosure;
pub(crate) mod fields;
pub(crate) mod flow;
pub(crate) mod grid;
mod group;
pub(crate) mod lists;
pub(crate) mod mass;
pub(crate) mod pipe;
pub(crate) mod result;
pub(crate) mod state;
pub(crate) mod switch;

use std::borrow::Cow;
use std::sync::Arc;

use crate::build_error::{BuildError, BuildErrors};
use crate::check::Islands;
use crate::error::BuildErrorKind;
use crate::evaluation::Evaluation;
use crate::id::{ConductorId, Field, Item, NodeId, ParameterId, SignalId, SourceId};
use crate::input_error::{InputError, InputProblem};
use crate::law::{ConductorFlow, Law};
use crate::names::UnknownName;
use crate::numbers::Numbers;
use crate::parameters::Parameters;
use crate::parts::Parts;
use crate::parts::result::Limit;
use crate::parts::signal::Course;
use crate::value::Value;
use lptn_laws::{Confidence, Range};
use lptn_units::Problems;

/// A thermal network: nodes, boundaries, the paths between them and the heat put in.
///
/// Guaranteed by construction: ids are dense and of this network; names are unique; the two ends of
/// a path differ; capacities, resistances and conductances are finite and positive; each node
/// either has a capacity and a start temperature, or is massless; each set of connected nodes
/// reaches a capacity or a boundary. Order is the order of addition. All numbers are in SI units,
/// temperatures in K.
#[derive(Clone, Debug)]
pub struct Network {
    pub(crate) parts: Arc<Parts>,
    pub(crate) numbers: Arc<Numbers>,
}

impl Network {
    /// The title, if there is one.
    pub fn title(&self) -> Option<&str> {
        self.parts.title.as_deref()
    }

    /// The item of this name among nodes, boundaries and elements.
    ///
    /// # Errors
    /// [`UnknownName`] with the most similar name.
    pub fn item(&self, name: &str) -> Result<Item, UnknownName> {
        self.parts.item(name).ok_or_else(|| {
            let names = self.parts.element_names();
            let mut names: Vec<&str> = names.iter().map(|name| &**name).collect();
            names.sort_unstable();
            UnknownName::new(name, &names)
        })
    }

    /// The node of this name.
    ///
    /// # Errors
    /// [`UnknownName`] if no node has it.
    pub fn node(&self, name: &str) -> Result<NodeId, UnknownName> {
        match self.parts.item(name) {
            Some(Item::Node(id)) => Ok(id),
            _ => {
                let names: Vec<&str> = self.nodes().iter().map(|n| n.name.as_str()).collect();
                Err(UnknownName::new(name, &names))
            }
        }
    }

    /// The parameter of this name.
    ///
    /// # Errors
    /// [`UnknownName`] if there is none.
    pub fn parameter(&self, name: &str) -> Result<ParameterId, UnknownName> {
        self.parts.parameter_names.get(name).copied().ok_or_else(|| {
            let names: Vec<&str> = self.parameters().iter().map(|p| p.name.as_str()).collect();
            UnknownName::new(name, &names)
        })
    }

    /// The value of a parameter in SI units.
    pub fn parameter_value(&self, id: ParameterId) -> f64 {
        self.numbers.parameters[id.index()]
    }

    /// Heat capacity of a node with all its parts at its start, in J/K; 0 for a massless node. See
    /// [`Network::enthalpy`] for one that depends on temperature, [`Network::state_capacities`] for
    /// one that follows states.
    pub fn capacity(&self, id: NodeId) -> f64 {
        self.numbers.capacity[id.index()]
    }

    /// Temperature of a node at the start in K; NaN for a massless node, which has none.
    pub fn initial(&self, id: NodeId) -> f64 {
        self.numbers.initial[id.index()]
    }

    /// First trial temperature in K for the balance of a massless node: its temperature in the
    /// state that a run starts from, or its own `T0`. `None` if neither is known. That of a state
    /// with a balance may be negative.
    pub fn begins(&self, id: NodeId) -> Option<f64> {
        let node = &self.nodes()[id.index()];
        let given = || node.initial.as_ref()?.at(&mut self.evaluation()).ok();
        let range = self.parts.range_at_start(id.index());
        let possible = |t: &f64| t.is_finite() && (*t > 0.0 || range == Range::Finite);
        node.stood.or_else(given).filter(possible)
    }

    /// Conductance of a conductor in W/K; `None` if it is not constant.
    pub fn conductance(&self, id: ConductorId) -> Option<f64> {
        match self.flow(id) {
            ConductorFlow::Conductance(conductance) => Some(conductance),
            ConductorFlow::Radiation(_) | ConductorFlow::Stream(_) | ConductorFlow::Variable => {
                None
            }
        }
    }

    /// The slot that expressions read a parameter from.
    pub fn parameter_slot(&self, id: ParameterId) -> u32 {
        self.parts.layout.parameter(id)
    }

    /// The slot that expressions read a signal from; comparisons read the next one.
    pub fn signal_slot(&self, id: SignalId) -> u32 {
        self.parts.layout.signal(id)
    }

    /// The slot that expressions read a control from: 0 or 1.
    pub fn control_slot(&self, id: crate::ControlId) -> u32 {
        self.parts.layout.control(id)
    }

    /// The parameters to change for [`Network::with`]; nothing is changed yet.
    pub fn overrides(&self) -> Parameters {
        Parameters::new(Arc::clone(&self.parts))
    }

    /// The parameters that were set for this network by [`Network::with`], to change others too.
    pub fn given(&self) -> Parameters {
        let mut parameters = self.overrides();
        for id in self.parameter_ids().filter(|id| self.numbers.given[id.index()]) {
            parameters.set(id, self.parameter_value(id));
        }
        parameters
    }

    /// The same network with other parameters: nothing is parsed, and the structure is shared.
    ///
    /// # Errors
    /// The problems of the new numbers, such as a resistance that is no longer positive.
    pub fn with(&self, parameters: &Parameters) -> Result<Self, BuildErrors> {
        if !parameters.belong_to(&self.parts) {
            let name = self.title().unwrap_or_default().to_owned();
            return Err(Problems::from(BuildError {
                kind: BuildErrorKind::ForeignParameters,
                name,
            }));
        }
        let numbers = Numbers::evaluate(&self.parts, parameters.values()).map_err(Problems)?;
        Ok(Self { parts: Arc::clone(&self.parts), numbers: Arc::new(numbers) })
    }

    /// True if both networks have the same parts, and differ in the values of parameters only: one
    /// was made of the other by [`Network::with`], or both of a third.
    pub fn shares_parts(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.parts, &other.parts)
    }

    /// The same network with further limits after its own: the requirements of a study, judged like
    /// limits at every moment of a run. Their names are for messages only and cannot be looked up.
    #[must_use]
    pub fn requiring(&self, limits: impl IntoIterator<Item = Limit>) -> Self {
        let mut parts = (*self.parts).clone();
        parts.limits.extend(limits);
        Self { parts: Arc::new(parts), numbers: Arc::clone(&self.numbers) }
    }

    /// The same network with signals fixed at values in SI units, whatever their time history is.
    /// Its parameters keep their present values.
    ///
    /// # Errors
    /// The problems of the new numbers.
    pub fn held(&self, signals: &[(SignalId, f64)]) -> Result<Self, BuildErrors> {
        let mut parts = (*self.parts).clone();
        let layout = Arc::make_mut(&mut parts.layout);
        let held = |value: f64| Course::Expression(Value::Constant(value));
        signals.iter().for_each(|(id, value)| layout.set_course(*id, held(*value)));
        self.of_parts(parts)
    }

    /// The same network with other time histories of signals and other temperatures in K at the
    /// start, as they were measured. Its parameters keep their present values. Nodes without a
    /// capacity have no start.
    ///
    /// # Errors
    /// The problems of the new numbers.
    pub fn recorded(
        &self,
        signals: &[(SignalId, Course)],
        initial: &[(NodeId, f64)],
    ) -> Result<Self, BuildErrors> {
        let mut parts = (*self.parts).clone();
        let layout = Arc::make_mut(&mut parts.layout);
        signals.iter().for_each(|(id, course)| layout.set_course(*id, course.clone()));
        for (id, kelvin) in initial {
            parts.nodes[id.index()].initial = Some(Value::Constant(*kelvin));
        }
        self.of_parts(parts)
    }

    /// The same values for this network: they are of one that differs by time histories of signals
    /// or temperatures at the start, see [`Network::recorded`].
    #[must_use]
    pub fn adopted(&self, parameters: &Parameters) -> Parameters {
        parameters.onto(&self.parts)
    }

    /// A network of these parts with the parameters that are given here.
    fn of_parts(&self, parts: Parts) -> Result<Self, BuildErrors> {
        let given = self
            .parameter_ids()
            .map(|id| self.numbers.given[id.index()].then(|| self.parameter_value(id)));
        let given: Vec<Option<f64>> = given.collect();
        let numbers = Numbers::evaluate(&parts, &given).map_err(Problems)?;
        Ok(Self { parts: Arc::new(parts), numbers: Arc::new(numbers) })
    }

    /// The signal of this name.
    pub fn signal(&self, name: &str) -> Option<SignalId> {
        self.signals().iter().position(|signal| signal.name == name).map(SignalId::from_len)
    }

    /// An evaluation of this network's inputs at time 0.
    pub fn evaluation(&self) -> Evaluation {
        let mut scope = Evaluation::new(&self.parts.layout, &self.numbers.parameters);
        if self.has_events() {
            scope.set_positions(&self.initial_positions());
        }
        scope
    }

    /// Writes the temperature of every boundary in K.
    ///
    /// # Errors
    /// [`InputError`] if an expression fails or gives no number.
    pub fn boundary_temperatures(
        &self,
        scope: &mut Evaluation,
        out: &mut [f64],
    ) -> Result<(), InputError> {
        for (id, value) in self.boundary_ids().zip(out) {
            let problem = match self.boundaries()[id.index()].temperature.at(scope) {
                Ok(x) if !x.is_finite() => InputProblem::NotFinite(x),
                Ok(x) if x < 0.0 => InputProblem::BelowAbsoluteZero(x),
                Ok(x) => {
                    *value = x;
                    continue;
                }
                Err(error) => error.into(),
            };
            return Err(self.failed(Item::Boundary(id), (Field::Temperature, problem), scope));
        }
        Ok(())
    }

    /// Writes the heat of every source in W that does not depend on a temperature; the others are
    /// left alone.
    ///
    /// # Errors
    /// [`InputError`] if an expression fails or gives no number.
    pub fn source_powers(&self, scope: &mut Evaluation, out: &mut [f64]) -> Result<(), InputError> {
        for (id, value) in self.source_ids().zip(out) {
            if self.source_variables(id).is_empty() {
                *value = self.source_heat(id, scope, &[])?;
            }
        }
        Ok(())
    }

    /// The sources whose heat changes with time by itself and depends on no temperature.
    pub fn timed_sources(&self) -> Vec<SourceId> {
        let mut timed = vec![false; self.sources().len()];
        for (item, _, value) in self.inputs() {
            if let Item::Source(id) = item {
                timed[id.index()] |= self.depends_on_time(value);
            }
        }
        let free = |id: &SourceId| self.source_variables(*id).is_empty();
        self.source_ids().filter(|id| timed[id.index()]).filter(free).collect()
    }

    /// The name of an item.
    pub fn name_of(&self, item: Item) -> Cow<'_, str> {
        self.parts.name_of(item)
    }

    /// True if any source, boundary or conductor changes with time by itself.
    pub fn has_time_dependent_inputs(&self) -> bool {
        self.inputs().any(|(_, _, value)| self.depends_on_time(value))
    }

    /// True if anything that is evaluated over a run depends on the time by itself: inputs,
    /// switches, limits, reports.
    pub fn reads_time(&self) -> bool {
        let limits = self.limits().iter().flat_map(|limit| limit.sides());
        let mut results = limits.chain(self.reports().iter().map(|report| &report.value));
        let timed = !self.signals().is_empty() || results.any(|value| self.depends_on_time(value));
        timed || self.has_events() || self.has_time_dependent_inputs()
    }

    /// The paths and sources whose law has constants that were not read in its source. This is the
    /// one place that decides it, for every result.
    pub fn unverified(&self) -> Vec<Item> {
        let unsure = |law: &Law| law.formula().declaration().confidence == Confidence::Medium;
        let conductors = self.conductor_ids().zip(self.conductors());
        let sources = self.source_ids().zip(self.sources());
        let conductors =
            conductors.filter(|(_, path)| unsure(&path.law)).map(|(id, _)| Item::Conductor(id));
        let sources =
            sources.filter(|(_, source)| unsure(&source.law)).map(|(id, _)| Item::Source(id));
        conductors.chain(sources).collect()
    }

    /// True if a value changes with time by itself.
    pub fn depends_on_time(&self, value: &Value) -> bool {
        self.parts.reads(value).time
    }

    /// True if a value depends on neither time, temperatures nor the positions of controls.
    pub fn is_constant(&self, value: &Value) -> bool {
        self.parts.reads(value).is_constant()
    }

    /// The first item that makes the network more than constant capacities, constant conductances
    /// and heat that depends on time only.
    pub fn first_nonlinear(&self) -> Option<Item> {
        let conductor = self.conductor_ids().find(|id| self.conductance(*id).is_none());
        let source = self.source_ids().find(|id| !self.source_variables(*id).is_empty());
        let node = self.first_varying_capacity();
        let state = self.state_ids().next();
        let items = [
            state.map(Item::State),
            conductor.map(Item::Conductor),
            source.map(Item::Source),
            node.map(Item::Node),
        ];
        items.into_iter().flatten().next()
    }

    /// Every value that may depend on time.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = (Item, Field, &Value)> {
        self.parts.inputs()
    }

    /// Sets of connected nodes without a path to a boundary, in order, states left out; empty if the network forgets
    /// its start. Such a set by itself has no steady state.
    pub fn ungrounded(&self) -> Vec<Vec<NodeId>> {
        let parts = &*self.parts;
        let islands = Islands::of(parts);
        let mut grounded = vec![false; parts.nodes.len()];
        for node in islands.grounded(parts) {
            grounded[islands.root(node)] = true;
        }
        let is_state = |node: usize| parts.state_at(NodeId::from_len(node)).is_some();
        let groups = islands.groups().into_iter();
        let groups = groups.filter(|m| !grounded[islands.root(m[0])] && !is_state(m[0]));
        groups.map(|members| members.into_iter().map(NodeId::from_len).collect()).collect()
    }
}
