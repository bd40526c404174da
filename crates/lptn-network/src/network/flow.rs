//! Heat flows of elements with their derivatives: the only place where a law meets temperatures.

use crate::parts::dependence::Vertices;
use lptn_laws::Carries;
use lptn_units::{EvalError, Scalar};

use crate::along::Along;
use crate::enthalpy::Enthalpy;
use crate::evaluation::{Evaluation, PASS, Slope};
use crate::id::{ConductorId, Field, Item, NodeId, SourceId};
use crate::input_error::{InputError, InputProblem};
use crate::law::{At, ConductorFlow, Law, Received};
use crate::network::Network;
use crate::parts::dependence::Dependence;
use crate::parts::element::Conductor;
use crate::parts::substance::Fluid;
use crate::slot;
use crate::value::Value;

/// A problem of one field.
pub(crate) type Failed = (Field, InputProblem);

impl Network {
    /// The heat flow of a conductor, as far as it is known before a run.
    pub fn flow(&self, id: ConductorId) -> ConductorFlow {
        let number = || self.conductors()[id.index()].law.number();
        let flow = self.numbers.flows.get(id.index()).copied();
        // every conductor after those has a number
        flow.unwrap_or_else(|| number().map_or(ConductorFlow::Variable, ConductorFlow::Conductance))
    }

    /// The vertices (nodes, then boundaries) on whose temperatures a conductor depends: its ends
    /// first.
    pub fn conductor_variables(&self, id: ConductorId) -> Vertices {
        self.parts.dependence(id).into_owned().vertices
    }

    /// The vertices on whose temperatures a source depends; none if it depends on time at most.
    pub fn source_variables(&self, id: SourceId) -> &[u32] {
        &self.parts.source_dependence[id.index()].vertices
    }

    /// Position of an end among all vertices: nodes, then boundaries.
    pub fn vertex(&self, end: crate::End) -> usize {
        self.parts.vertex(end) as usize
    }

    /// For each node whether it is massless and can be eliminated: nothing but constant
    /// conductances and heat that depends on time reaches it.
    pub fn linear_massless(&self) -> Vec<bool> {
        self.parts.linear_massless()
    }

    /// The heat content of a node over its temperature in J, zero at its start; `None` if its
    /// capacity is constant.
    pub fn enthalpy(&self, id: NodeId) -> Option<&Enthalpy> {
        self.numbers.enthalpy.get(id.index())?.as_deref()
    }

    /// The property of which a conductor takes the mean between the temperatures of its ends.
    pub(crate) fn along(&self, id: ConductorId) -> Option<&Along> {
        self.numbers.along.get(id.index())?.as_deref()
    }

    /// The heat that the two ends of a [`ConductorFlow::Variable`] conductor receive in W, at the
    /// time of `scope` and these temperatures of all vertices in K.
    ///
    /// # Errors
    /// [`InputError`] if a value fails, or a conductance is negative or not finite.
    pub fn exchange(
        &self,
        id: ConductorId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<Received, InputError> {
        let (conductor, along) = (&self.conductors()[id.index()], self.along(id));
        let dependence = self.parts.dependence(id);
        let at = |k: usize| temperatures[dependence.vertices[k] as usize];
        if let Some([heat, ..]) = self.conducted(id, [at(0), at(1)]) {
            return Ok([-heat, heat]);
        }
        let result = {
            let (slots, stack) = scope.plain();
            place(slots, &dependence, &at);
            self.received(conductor, At::path((slots, stack), along), at(0), at(1))
        };
        result.map_err(|failed| self.failed(Item::Conductor(id), failed, scope))
    }

    /// Heats as [`Network::exchange`]; also writes their derivatives in W/K by each of
    /// [`Network::conductor_variables`].
    ///
    /// # Errors
    /// As [`Network::exchange`].
    pub fn exchange_slopes(
        &self,
        id: ConductorId,
        scope: &mut Evaluation,
        temperatures: &[f64],
        slopes: &mut Vec<Received>,
    ) -> Result<Received, InputError> {
        let dependence = self.parts.dependence(id);
        // a conductor that is not variable depends on none
        if let [from, to, ..] = dependence.vertices[..] {
            let ends = [from, to].map(|vertex| temperatures[vertex as usize]);
            if let Some([heat, from, to]) = self.conducted(id, ends) {
                slopes.clear();
                slopes.extend([[-from, from], [to, -to]]);
                return Ok([-heat, heat]);
            }
        }
        self.slopes_by((id, &dependence), scope, temperatures, slopes)
    }

    /// The same for a conductor of any kind with a given dependence.
    pub(crate) fn slopes_by(
        &self,
        (id, dependence): (ConductorId, &Dependence),
        scope: &mut Evaluation,
        temperatures: &[f64],
        slopes: &mut Vec<Received>,
    ) -> Result<Received, InputError> {
        let (conductor, along) = (&self.conductors()[id.index()], self.along(id));
        let count = dependence.vertices.len();
        slopes.clear();
        let mut values = [0.0; 2];
        for first in (0..count).step_by(PASS) {
            let at = |k: usize| seeded(temperatures[dependence.vertices[k] as usize], k, first);
            let result = {
                let (slots, stack) = scope.dual();
                place(slots, dependence, &at);
                self.received(conductor, At::path((slots, stack), along), at(0), at(1))
            };
            let [from, to] =
                result.map_err(|failed| self.failed(Item::Conductor(id), failed, scope))?;
            values = [from.value, to.value];
            for k in 0..PASS.min(count - first) {
                slopes.push([from.derivatives[k], to.derivatives[k]]);
            }
        }
        Ok(values)
    }

    /// The heat of a source in W, at the time of `scope` and these temperatures of all vertices in
    /// K.
    ///
    /// # Errors
    /// [`InputError`] if its value fails or is not finite.
    pub fn source_heat(
        &self,
        id: SourceId,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) -> Result<f64, InputError> {
        let source = &self.sources()[id.index()];
        let dependence = &self.parts.source_dependence[id.index()];
        let at = |k: usize| temperatures[dependence.vertices[k] as usize];
        let result = {
            let (slots, stack) = scope.plain();
            name(slots, dependence, &at);
            At::new((slots, stack)).heat(&source.law)
        };
        result.map_err(|failed| self.failed(Item::Source(id), failed, scope))
    }

    /// Heat as [`Network::source_heat`]; also writes its derivatives in W/K by each of
    /// [`Network::source_variables`].
    ///
    /// # Errors
    /// As [`Network::source_heat`].
    pub fn source_slopes(
        &self,
        id: SourceId,
        scope: &mut Evaluation,
        temperatures: &[f64],
        slopes: &mut Vec<f64>,
    ) -> Result<f64, InputError> {
        let source = &self.sources()[id.index()];
        let dependence = &self.parts.source_dependence[id.index()];
        let count = dependence.vertices.len();
        slopes.clear();
        let mut value = 0.0;
        for first in (0..count).step_by(PASS) {
            let at = |k: usize| seeded(temperatures[dependence.vertices[k] as usize], k, first);
            let result = {
                let (slots, stack) = scope.dual();
                name(slots, dependence, &at);
                At::new((slots, stack)).heat(&source.law)
            };
            let heat = result.map_err(|failed| self.failed(Item::Source(id), failed, scope))?;
            value = heat.value;
            slopes.extend_from_slice(&heat.derivatives[..PASS.min(count - first)]);
        }
        Ok(value)
    }

    pub(crate) fn finite<S: Scalar>(
        &self,
        result: Result<S, EvalError>,
        (item, field): (Item, Field),
        scope: &Evaluation,
    ) -> Result<S, InputError> {
        match result {
            Ok(x) if x.is_finite() => Ok(x),
            Ok(x) => Err(self.failed(item, (field, InputProblem::NotFinite(x.value())), scope)),
            Err(error) => Err(self.failed(item, (field, error.into()), scope)),
        }
    }

    /// Puts the temperatures that values name into their slots.
    pub(crate) fn place_named(
        &self,
        of: &Dependence,
        scope: &mut Evaluation,
        temperatures: &[f64],
    ) {
        let at = |k: usize| temperatures[of.vertices[k] as usize];
        name(scope.plain().0, of, &at);
    }

    /// Names the failed item: a signal without a value goes before the item that uses it.
    pub(crate) fn failed(
        &self,
        item: Item,
        (field, problem): Failed,
        scope: &Evaluation,
    ) -> InputError {
        let (item, field, problem) = match scope.failure() {
            Some((id, problem)) if self.parts.uses_signal(item, id) => {
                (Item::Signal(id), Field::Value, problem)
            }
            _ => (item, field, problem),
        };
        let (item, field) = self.parts.as_written(item, field);
        InputError { item, field, name: self.name_of(item).into_owned(), problem }
    }

    /// Heat received by the ends for these slots.
    pub(crate) fn received<S: Scalar>(
        &self,
        conductor: &Conductor,
        mut at: At<'_, S>,
        from: S,
        to: S,
    ) -> Result<Received<S>, Failed> {
        let value = at.value(&conductor.law)?;
        self.received_of((&conductor.law, value), at, from, to)
    }

    /// The same if the value of the law is known.
    pub(crate) fn received_of<S: Scalar>(
        &self,
        (law, value): (&Law, S),
        mut at: At<'_, S>,
        from: S,
        to: S,
    ) -> Result<Received<S>, Failed> {
        if law.is_stream() {
            return self.carried((law, value), &mut at, from, to);
        }
        let conductance = at.conductance_of(law, value);
        let field = Field::law(law.formula(), 0);
        if conductance.sample() < 0.0 {
            return Err((field, InputProblem::NegativeConductance(conductance.sample())));
        }
        let heat = conductance * (from - to);
        if !heat.is_finite() {
            return Err((field, InputProblem::NotFinite(conductance.sample())));
        }
        Ok([-heat, heat])
    }

    fn carried<S: Scalar>(
        &self,
        (law, flow): (&Law, S),
        at: &mut At<'_, S>,
        from: S,
        to: S,
    ) -> Result<Received<S>, Failed> {
        let not_finite = |field, value: f64| (field, InputProblem::NotFinite(value));
        if !flow.is_finite() {
            return Err(not_finite(Field::law(law.formula(), 0), flow.value()));
        }
        let Some(id) = law.fluid() else {
            return Ok([
                lptn_laws::advection_from(flow, from, to),
                lptn_laws::advection_to(flow, from, to),
            ]);
        };
        let fluid = &self.fluids()[id.index()];
        let flow = match law.carries() {
            Carries::VolumeFlow(measured) => flow * density(law, measured, fluid, at)?,
            _ => flow,
        };
        let curve = self.numbers.fluids[id.index()].as_deref();
        let content = |t: S| match curve {
            None => Ok(t),
            Some(curve) => match (curve.heat(t.value()), curve.capacity(t.value())) {
                (Some(heat), Some(capacity)) => Ok(t.chain(heat, capacity)),
                _ => Err((
                    Field::Fluid,
                    InputProblem::OutsideFluid { temperature: t.value(), range: curve.range() },
                )),
            },
        };
        let (from, to) = (content(from)?, content(to)?);
        let flow = match curve {
            None => flow * property(Field::SpecificHeat, &fluid.cp, at)?,
            Some(_) => flow,
        };
        Ok([lptn_laws::stream_from(flow, from, to), lptn_laws::stream_to(flow, from, to)])
    }
}

/// The density of a fluid in kg/m^3 at the temperature that the field of this key gives.
fn density<S: Scalar>(
    law: &Law,
    measured: &str,
    fluid: &Fluid,
    at: &mut At<'_, S>,
) -> Result<S, Failed> {
    if let Some(position) = law.formula().position(measured) {
        at.slots[slot::OWN as usize] = at.get(law, position)?;
    }
    let density = fluid.density.as_ref().ok_or((Field::Fluid, InputProblem::NoDensity))?;
    property(Field::Density, density, at)
}

/// A property of a fluid, which is not negative.
fn property<S: Scalar>(field: Field, value: &Value, at: &mut At<'_, S>) -> Result<S, Failed> {
    let found = value.on(at.slots, at.stack).map_err(|error| (field, error.into()))?;
    match found.sample() < 0.0 {
        true => Err((field, InputProblem::Negative(found.sample()))),
        false => Ok(found),
    }
}

/// A temperature with a derivative of 1 by itself, if it is among those of this pass.
pub(crate) fn seeded(temperature: f64, position: usize, first: usize) -> Slope {
    match position.checked_sub(first) {
        Some(k) if k < PASS => Slope::variable(temperature, k),
        _ => Slope::constant(temperature),
    }
}

pub(crate) fn name<S: Scalar>(slots: &mut [S], dependence: &Dependence, at: &impl Fn(usize) -> S) {
    for &(slot, position) in &dependence.named {
        slots[slot as usize] = at(position);
    }
}

/// Puts the temperatures that a conductor's values may read into their slots.
pub(crate) fn place<S: Scalar>(slots: &mut [S], dependence: &Dependence, at: &impl Fn(usize) -> S) {
    name(slots, dependence, at);
    let (from, to) = (at(0), at(1));
    let mean = (from + to) * S::from_f64(0.5);
    slots[slot::FROM as usize] = from;
    slots[slot::TO as usize] = to;
    slots[slot::MEAN as usize] = mean;
    slots[slot::OWN as usize] = mean;
    slots[slot::DIFFERENCE as usize] = from - to;
}
