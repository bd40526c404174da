//! Heat contents of nodes and fluids: capacities that depend on temperature.

use std::collections::BTreeMap;
use std::sync::Arc;

use lptn_units::{LookupTable, Program, Taylor};

use crate::enthalpy::{Capacity, Enthalpy, Latent, NoCurve};
use crate::error::BuildErrorKind;
use crate::evaluation::Evaluation;
use crate::id::{Field, FluidId, Item, NodeId};
use crate::knots::knots;
use crate::parts::Parts;
use crate::slot;
use crate::value::{Lump, Size, Value};

/// Temperature at which the heat content of a fluid is zero, in K: 25 degC.
const FLUID_ZERO: f64 = 298.15;

/// A value at its own temperature in K.
fn at(value: &Value, temperature: f64, scope: &mut Evaluation) -> Option<f64> {
    scope.set(slot::OWN, temperature);
    value.at(scope).ok()
}

/// Temperatures at which the tables in a value bend, if called with the temperature itself.
fn edges(value: &Value, scope: &mut Evaluation) -> Vec<f64> {
    let (slots, stack) = scope.plain();
    knots(value, slots, stack)
}

/// The shared heat contents of many nodes.
pub(crate) struct Curves {
    /// The curves that were made, by their form.
    made: BTreeMap<String, Enthalpy>,
    /// The capacitors by their node, then in their order.
    capacitors: Vec<(NodeId, usize)>,
}

impl Curves {
    /// None yet.
    pub(crate) fn new(parts: &Parts) -> Self {
        let capacitors = parts.capacitors.iter().enumerate();
        let mut capacitors: Vec<(NodeId, usize)> =
            capacitors.map(|(i, part)| (part.node, i)).collect();
        capacitors.sort_unstable();
        Self { made: BTreeMap::new(), capacitors }
    }

    /// The capacitors of a node.
    fn of(&self, id: NodeId) -> impl Iterator<Item = usize> {
        let first = self.capacitors.partition_point(|(node, _)| *node < id);
        self.capacitors[first..].iter().take_while(move |(node, _)| *node == id).map(|(_, i)| *i)
    }
}

/// A value as a product of others.
fn factors(value: &Value) -> Vec<&Value> {
    match value {
        Value::Product(all) => all.iter().collect(),
        one => vec![one],
    }
}

/// A sum of products of values, over the temperature that is their own.
struct Sum<'a, 'b> {
    parts: &'b [Vec<&'a Value>],
    scope: &'b mut Evaluation,
}

impl Capacity for Sum<'_, '_> {
    fn at(&mut self, temperature: f64) -> Option<f64> {
        let mut product = |factors: &Vec<&Value>| {
            factors.iter().try_fold(1.0, |product, factor| {
                Some(product * at(factor, temperature, self.scope)?)
            })
        };
        self.parts.iter().try_fold(0.0, |sum, part| Some(sum + product(part)?))
    }

    fn over(&mut self, from: f64, to: f64) -> Taylor {
        let (slots, _) = self.scope.plain();
        let product = |factors: &Vec<&Value>| {
            factors.iter().fold(Taylor::constant(1.0), |product, factor| {
                product * factor.enclose([from, to], slots)
            })
        };
        self.parts.iter().fold(Taylor::constant(0.0), |sum, part| sum + product(part))
    }
}

/// Key that is equal for equal curves. Tables of different materials are called by the same text,
/// so each counts as itself.
fn form(parts: &[Vec<&Value>], latent: &[Latent]) -> String {
    let program = |program: &Arc<Program>| {
        let tables: Vec<*const LookupTable> =
            program.table_calls().iter().map(|call| Arc::as_ptr(&call.table)).collect();
        format!("{:?} {tables:?}", program.text())
    };
    let of = |value: &&Value| match value {
        Value::Constant(number) => format!("{:x}", number.to_bits()),
        other => {
            let programs: Vec<String> = other.programs().into_iter().map(program).collect();
            format!("{programs:?} {:?}", other.slots())
        }
    };
    let parts: Vec<Vec<String>> = parts.iter().map(|part| part.iter().map(of).collect()).collect();
    format!("{parts:?} {latent:?}")
}

impl Parts {
    /// The capacities that make up a node: its own and those of its capacitors, with their lumps.
    fn capacities_of(&self, id: NodeId, known: &Curves) -> Vec<(&Value, Option<&Lump>)> {
        let node = &self.nodes[id.index()];
        let own = node.capacity.iter().map(|value| (value, node.lump.as_ref()));
        let parts = known.of(id).map(|i| &self.capacitors[i]);
        own.chain(parts.map(|part| (&part.capacity, part.lump.as_ref()))).collect()
    }

    /// For each node whether its capacity depends on its temperature or it can melt.
    pub(crate) fn varying_capacities(&self) -> Vec<bool> {
        let varies = |value: &Value, lump: Option<&Lump>| {
            let melts = lump.is_some_and(|l| self.materials[l.material.index()].melting.is_some());
            melts || self.reads(value).own
        };
        let mut varying: Vec<bool> = self
            .nodes
            .iter()
            .map(|n| n.capacity.as_ref().is_some_and(|c| varies(c, n.lump.as_ref())))
            .collect();
        for part in &self.capacitors {
            varying[part.node.index()] |= varies(&part.capacity, part.lump.as_ref());
        }
        // a node with a molten part has to be able to melt
        varying.iter_mut().zip(&self.nodes).for_each(|(varies, node)| *varies |= node.molten > 0.0);
        varying
    }

    /// The heat content of a node around its start in K, a share of it molten there. See
    /// [`Parts::enthalpy_of`].
    pub(crate) fn content_of(
        &self,
        id: NodeId,
        start: f64,
        scope: &mut Evaluation,
        known: &mut Curves,
    ) -> Result<Arc<Enthalpy>, BuildErrorKind> {
        let curve = self.enthalpy_of(id, start, scope, known)?;
        let share = self.nodes[id.index()].molten;
        if share <= 0.0 {
            return Ok(curve);
        }
        let amid = curve.partly_molten(start, share).map(Arc::new);
        amid.ok_or(BuildErrorKind::NotMelting { node: id, temperature: start })
    }

    /// The heat content of a node around its start in K. Curves of one form are made once and kept
    /// in `known`.
    fn enthalpy_of(
        &self,
        id: NodeId,
        start: f64,
        scope: &mut Evaluation,
        known: &mut Curves,
    ) -> Result<Arc<Enthalpy>, BuildErrorKind> {
        let parts = self.capacities_of(id, known);
        let mut factors: Vec<Vec<&Value>> = parts.iter().map(|(value, _)| factors(value)).collect();
        // a single part is a size times a property: the curve is that of the property
        let mut scale = 1.0;
        if let [only] = &mut factors[..] {
            let sizes = only.extract_if(.., |factor| !self.reads(factor).own);
            scale = sizes.map(|size| size.at(scope).unwrap_or(f64::NAN)).product();
        }
        let mut latent: Vec<Latent> =
            parts.iter().filter_map(|(_, lump)| self.latent((*lump)?, scope)).collect();
        latent.iter_mut().for_each(|l| l.heat /= scale);
        let form = form(&factors, &latent);
        let shared = known.made.get(&form).and_then(|curve| curve.rescaled(scale, start));
        if let Some(curve) = shared {
            return Ok(Arc::new(curve));
        }
        let bends: Vec<f64> = parts.iter().flat_map(|(value, _)| edges(value, scope)).collect();
        let curve = Enthalpy::new(&mut Sum { parts: &factors, scope }, start, &bends, &latent);
        let curve = curve.map_err(|reason| match reason {
            NoCurve::Unknown => BuildErrorKind::CapacityUnknown { node: id, temperature: start },
            NoCurve::TooQuick => {
                BuildErrorKind::TooQuick { item: Item::Node(id), field: Field::Capacity }
            }
        })?;
        let scaled = curve.rescaled(scale, start);
        known.made.insert(form, curve);
        scaled.map(Arc::new).ok_or(BuildErrorKind::CapacityUnknown { node: id, temperature: start })
    }

    fn latent(&self, lump: &Lump, scope: &mut Evaluation) -> Option<Latent> {
        let material = &self.materials[lump.material.index()];
        let melting = material.melting.as_ref()?;
        let mass = match &lump.size {
            Size::Mass(mass) => mass.at(scope).ok()?,
            Size::Volume(volume) => {
                volume.at(scope).ok()? * material.density.as_ref()?.at(scope).ok()?
            }
        };
        let between = (melting.solidus.at(scope).ok()?, melting.liquidus.at(scope).ok()?);
        Some(Latent::new(between, mass * melting.heat.at(scope).ok()?))
    }

    /// The heat content of a kg of a fluid whose specific heat depends on its temperature; `None`
    /// for one whose specific heat is constant.
    pub(crate) fn fluid_enthalpy(
        &self,
        id: FluidId,
        scope: &mut Evaluation,
    ) -> Result<Option<Arc<Enthalpy>>, BuildErrorKind> {
        let cp = &self.fluids[id.index()].cp;
        if !self.reads(cp).own {
            return Ok(None);
        }
        let bends = edges(cp, scope);
        // the range in which it is known: from 25 degC, or from the middle of its table
        let middle = bends.iter().sum::<f64>() / bends.len().max(1) as f64;
        let mut curve =
            |start| Enthalpy::new(&mut Sum { parts: &[vec![cp]], scope }, start, &bends, &[]);
        let curve =
            curve(FLUID_ZERO).or_else(|_| curve(middle)).map_err(|reason| match reason {
                NoCurve::Unknown => {
                    BuildErrorKind::FluidUnknown { fluid: id, field: Field::SpecificHeat }
                }
                NoCurve::TooQuick => {
                    BuildErrorKind::TooQuick { item: Item::Fluid(id), field: Field::SpecificHeat }
                }
            })?;
        Ok(Some(Arc::new(curve)))
    }
}
