//! Response of one temperature of a steady state to everything else. One more solution, of the
//! transposed linear network, gives the rise for 1 W into any node. With it follows the effect of
//! every value of every element (adjoint sensitivities; S. W. Director and R. A. Rohrer, The
//! generalized adjoint network and network sensitivities, IEEE Trans. Circuit Theory CT-16 (1969)
//! 318).
//!
//! Derivatives by parameters are those of the sensitivities. Derivatives by values of laws take one
//! seed at a time (`network/fields.rs`), so that an element needs no parameter to be ranked. Cells
//! and parts of a path to a face sum to their whole. The adjoint of a run is in `backward`.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_integrate::{FactorError, Pattern, linear};
use lptn_laws::Range;
use lptn_network::{
    End, Evaluation, Field, InputError, Item, Law, NoTangents, NodeId, ParameterId, Source,
    ValueChange,
};

use lptn_units::Type;

use crate::linearised::{Linearised, LinearisedError};
use crate::snapshot::Snapshot;
use crate::standing::is_counter;

lptn_units::errors! {
/// Reason why a temperature has no adjoint.
#[derive(Clone, Debug)]
pub enum AdjointError {
    /// The network cannot be taken for a linear one at this state.
    Linearised => LinearisedError;
    /// The transposed network cannot be solved.
    Factorization(error: FactorError) = "solve::singular", error, source error,
        class lptn_units::Class::Numbers;
}
}

lptn_units::errors! {
/// Reason why there are no derivatives by parameters.
#[derive(Clone, Debug)]
pub enum ParameterSlopes {
    /// The network has none.
    None => NoTangents;
    /// A value has no finite one here.
    Input => InputError;
}
}

/// Effect of one value on a temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Influence {
    /// The element, or a boundary or parameter.
    pub of: Item,
    /// The field of that value.
    pub field: Field,
    /// The value in SI units.
    pub value: f64,
    /// Change of the temperature: in K for a value hundredfold of 1 % larger (`v dT/dv`), in K/K if
    /// the value is a temperature itself, or in K per SI unit if it is 0 ([`Influence::is_zero`]).
    pub change: f64,
    /// Its dimension.
    pub ty: Type,
    /// True if it is a temperature, so that `change` is in K/K.
    pub absolute: bool,
}

impl Influence {
    /// True if no share of the value is a change, so that `change` is in K per SI unit.
    pub fn is_zero(&self) -> bool {
        !self.absolute && self.value.abs() <= 0.0
    }
}

/// The response of one temperature of a steady state.
#[derive(Clone, Debug)]
pub struct Adjoint<'a> {
    system: &'a ThermalSystem,
    state: &'a Snapshot,
    /// Temperatures of all vertices in K: nodes, then boundaries.
    temperatures: Vec<f64>,
    /// Rise of the temperature in K for 1 W into each node.
    rise: Vec<f64>,
}

impl<'a> Adjoint<'a> {
    /// The adjoint of the temperature of `node` in a steady state, inputs and switches fixed.
    ///
    /// # Errors
    /// [`AdjointError`] if a node melts, or if the state is at the edge of another.
    pub fn of(
        system: &'a ThermalSystem,
        state: &'a Snapshot,
        node: NodeId,
    ) -> Result<Self, AdjointError> {
        let mut weights = vec![0.0; system.network().nodes().len()];
        weights[node.index()] = 1.0;
        Self::of_sum(system, state, &weights)
    }

    /// The same of a sum of temperatures, with the weight of each node in K/K.
    ///
    /// # Errors
    /// As [`Adjoint::of`].
    pub fn of_sum(
        system: &'a ThermalSystem,
        state: &'a Snapshot,
        weights: &[f64],
    ) -> Result<Self, AdjointError> {
        let linear = Linearised::near(system, state)?;
        let (pattern, mut values) = linear.conductances();
        let counters = (0..system.unknowns().len()).filter(|i| is_counter(system, *i));
        counters.for_each(|counter| values[pattern.diagonal()[counter]] = 1.0);
        let mut rise = {
            let mut work = system.workspace();
            let mut flow = vec![0.0; system.unknowns().len()];
            put(system, &mut work, weights);
            system.linear_flow(&work, &vec![0.0; flow.len()], &mut flow);
            flow
        };
        let failed = AdjointError::Factorization;
        if linear.is_symmetric() {
            let mut factors =
                linear::for_steady(pattern, linear::LinearSolver::Auto).map_err(failed)?;
            factors.factorize(&values).and_then(|()| factors.solve_in_place(&mut rise))
        } else {
            let (pattern, values) = transposed(pattern, &values);
            let mut factors = linear::for_exact(&pattern).map_err(failed)?;
            factors.factorize(&values).and_then(|()| factors.solve_in_place(&mut rise))
        }
        .map_err(failed)?;
        let mut work = system.workspace();
        put(system, &mut work, weights);
        system.recover(&mut work, &rise);
        let rise = system.node_temperatures(&work).to_vec();
        let temperatures = [&*state.temperatures, &*state.boundary_temperatures].concat();
        Ok(Self { system, state, temperatures, rise })
    }

    /// Rise of the temperature for 1 W into each node, in K/W.
    pub fn rise(&self) -> &[f64] {
        &self.rise
    }

    /// Effects of every value of every conductor and source, and of the temperature of every
    /// boundary, in the order of the network. The inputs of an expression are left as they are. The
    /// conductors of a body or of a path to a face are one, with the sum of their areas. Counts,
    /// such as that of fins, are left out.
    ///
    /// # Errors
    /// [`InputError`] for a value that has no finite derivative here.
    pub fn influences(&self) -> Result<Vec<Influence>, InputError> {
        let network = self.system.network();
        let mut scope = self.state.evaluation(network);
        let temperatures = &self.temperatures;
        let (mut found, mut parts) = (Vec::new(), Vec::new());
        for (id, conductor) in network.conductor_ids().zip(network.conductors()) {
            let changes = network.exchange_by_values(id, &mut scope, temperatures)?;
            let warms = [conductor.from, conductor.to].map(|end| self.warms(end));
            let changes = changes.iter().map(|ValueChange { value, heat: [from, to] }| {
                (*value, from * warms[0] + to * warms[1])
            });
            let whole = network.whole(Item::Conductor(id)).unwrap_or(Item::Conductor(id));
            let of_law = influences(whole, &conductor.law, changes);
            match whole {
                Item::Conductor(_) => found.extend(of_law),
                _ => parts.extend(of_law.filter(is_of_whole)),
            }
        }
        found.extend(wholes(parts));
        for (id, source) in network.source_ids().zip(network.sources()) {
            let changes = network.source_by_values(id, &mut scope, temperatures)?;
            let rise = self.warms_by(source);
            let changes = changes.iter().map(|change| (change.value, change.heat * rise));
            found.extend(influences(Item::Source(id), &source.law, changes));
        }
        found.extend(self.boundaries(&mut scope)?);
        Ok(found)
    }

    /// Change of the temperature with each parameter, through everything that reads it, in K per SI
    /// unit.
    ///
    /// # Errors
    /// [`ParameterSlopes`]
    pub fn by_parameters(&self, parameters: &[ParameterId]) -> Result<Vec<f64>, ParameterSlopes> {
        let (network, vertices) = (self.system.network(), self.temperatures.len());
        let mut tangents = network.tangents(parameters)?;
        let scope = self.state.evaluation(network);
        let mut heat = vec![0.0; vertices * parameters.len()];
        tangents.heat(network, &scope, &self.temperatures, &mut heat)?;
        let slope =
            |heat: &[f64]| heat.iter().zip(&self.rise).map(|(heat, rise)| heat * rise).sum();
        Ok(heat.chunks(vertices.max(1)).map(slope).collect())
    }

    fn warms(&self, end: End) -> f64 {
        match end {
            End::Node(id) => self.rise[id.index()],
            End::Boundary(_) => 0.0,
        }
    }

    fn warms_by(&self, source: &Source) -> f64 {
        source.into.iter().map(|(node, share)| share * self.rise[node.index()]).sum()
    }

    fn boundaries(&self, scope: &mut Evaluation) -> Result<Vec<Influence>, InputError> {
        let (network, temperatures) = (self.system.network(), &self.temperatures);
        let mut change = vec![0.0; temperatures.len()];
        for (id, conductor) in network.conductor_ids().zip(network.conductors()) {
            let warms = [conductor.from, conductor.to].map(|end| self.warms(end));
            for (vertex, [from, to]) in network.exchange_by_temperatures(id, scope, temperatures)? {
                change[vertex] += from * warms[0] + to * warms[1];
            }
        }
        let mut slopes = Vec::new();
        for (id, source) in network.source_ids().zip(network.sources()) {
            network.source_slopes(id, scope, temperatures, &mut slopes)?;
            for (&vertex, slope) in network.source_variables(id).iter().zip(&slopes) {
                change[vertex as usize] += slope * self.warms_by(source);
            }
        }
        let nodes = network.nodes().len();
        Ok(network
            .boundary_ids()
            .zip(change[nodes..].iter().zip(&temperatures[nodes..]))
            .map(|(id, (&change, &value))| Influence {
                of: Item::Boundary(id),
                field: Field::Temperature,
                value,
                change,
                ty: Type::ABSOLUTE_TEMPERATURE,
                absolute: true,
            })
            .collect())
    }
}

/// These heats in W into the nodes, everything else at 0.
fn put(system: &ThermalSystem, work: &mut Workspace, heat: &[f64]) {
    system.apply(work, heat, &vec![0.0; system.network().boundaries().len()]);
}

/// The transposed matrix, with its own pattern.
fn transposed(pattern: &Pattern, values: &[f64]) -> (Pattern, Vec<f64>) {
    let rows = pattern.row_indices();
    let entries = || {
        (0..pattern.size())
            .flat_map(|column| pattern.column(column).map(move |slot| (column, slot)))
    };
    let other = Pattern::new(pattern.size(), entries().map(|(column, slot)| (column, rows[slot])));
    let mut turned = vec![0.0; other.len()];
    for (column, slot) in entries() {
        if let Some(place) = other.slot(column, rows[slot]) {
            turned[place] = values[slot];
        }
    }
    (other, turned)
}

/// The values of a law that can be larger by a share of themselves.
fn influences<'a>(
    of: Item,
    law: &'a Law,
    changes: impl Iterator<Item = (f64, f64)> + 'a,
) -> impl Iterator<Item = Influence> + 'a {
    let fields = law.formula().declaration().fields.iter();
    let all = law.parts().zip(fields).zip(changes);
    let can_grow = all.filter(|((_, field), _)| field.range != Range::Count);
    can_grow.map(move |(((own, _), field), (value, change))| Influence {
        of,
        field: own,
        value,
        change,
        ty: field.ty,
        absolute: field.ty.absolute,
    })
}

/// True if a value of one conductor of a body belongs to the body; the sizes of its cells do not.
fn is_of_whole(part: &Influence) -> bool {
    match part.of {
        Item::Grid(_) => part.field.key() == "k",
        _ => true,
    }
}

/// The same values of the conductors of one body as one: their changes add up, and their areas.
/// A share of a value that is 0 in some of them changes only the others.
fn wholes(parts: Vec<Influence>) -> Vec<Influence> {
    let mut found: Vec<Influence> = Vec::new();
    for part in parts {
        let same = |other: &&mut Influence| (other.of, other.field) == (part.of, part.field);
        match found.iter_mut().rev().find(same) {
            Some(whole) if whole.is_zero() && !part.is_zero() => *whole = part,
            Some(whole) if part.is_zero() && !whole.is_zero() => {}
            Some(whole) => {
                whole.change += part.change;
                if part.field.key() == "area" {
                    whole.value += part.value;
                }
            }
            None => found.push(part),
        }
    }
    found
}
