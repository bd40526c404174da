//! Nodes, boundaries and the elements between them.

use std::borrow::Cow;
use std::ops::Deref;
use std::sync::Arc;

use lptn_laws::{Formula, Kind};
use lptn_units::{Spread, Type};

use crate::id::{End, NodeId};
use crate::law::Law;
use crate::parts::label::Label;
use crate::value::{Lump, Value};

/// A named value that expressions may use.
#[derive(Clone, Debug)]
pub struct Parameter {
    /// Its name, unique among parameters, signals, tables, controls and reports.
    pub name: String,
    /// Its type; [`Network::with`](crate::Network::with) keeps it.
    pub ty: Type,
    /// A constant, or an expression over parameters that were added before it.
    pub value: Value,
    /// Its deviation, if it has a `±`.
    pub deviation: Option<Spread>,
}

/// A lump with one temperature that is solved for.
#[derive(Clone, Debug)]
pub struct Node {
    /// Its name, unique among nodes, boundaries and elements.
    pub name: String,
    /// Its own heat capacity in J/K, which may depend on its temperature; capacitors add to it.
    pub capacity: Option<Value>,
    /// Its temperature at the start in K.
    pub initial: Option<Value>,
    /// True if it is a junction that stores nothing.
    pub massless: bool,
    /// Fields that few nodes of a large network have, or that many of them share.
    body: Option<Arc<Body>>,
}

/// The rarer fields of a node; [`Node`] dereferences to them.
#[derive(Clone, Debug)]
pub struct Body {
    /// The lump that its own capacity was computed from.
    pub lump: Option<Lump>,
    /// Share molten at the start, from 0 to 1, if it melts at just that temperature.
    pub molten: f64,
    /// Its characteristic length in m, volume over surface, if it is to be checked as a lump.
    pub length: Option<Value>,
    /// For a massless node its temperature in K in the state that a run starts from: if its balance
    /// has several solutions, it keeps that one.
    pub stood: Option<f64>,
}

/// The rarer fields of a node that has none of them.
static PLAIN: Body = Body { lump: None, molten: 0.0, length: None, stood: None };

impl Deref for Node {
    type Target = Body;

    fn deref(&self) -> &Body {
        self.body.as_deref().unwrap_or(&PLAIN)
    }
}

impl Node {
    pub(crate) fn new(
        name: &str,
        capacity: Option<Value>,
        initial: Option<Value>,
        massless: bool,
    ) -> Self {
        Self { name: name.to_owned(), capacity, initial, massless, body: None }
    }

    /// With the lump that its capacity was computed from; cells of one grid share it.
    pub(crate) fn of_lump(mut self, lump: Lump, like: Option<&Self>) -> Self {
        let shared = like.and_then(|other| other.body.as_ref());
        let is_same = |body: &&Arc<Body>| {
            body.is_only_lump() && body.lump.as_ref().is_some_and(|l| l.is_same(&lump))
        };
        self.body = shared.filter(is_same).cloned();
        if self.body.is_none() {
            self.body_mut().lump = Some(lump);
        }
        self
    }

    pub(crate) fn body_mut(&mut self) -> &mut Body {
        Arc::make_mut(self.body.get_or_insert_with(|| Arc::new(PLAIN.clone())))
    }

    /// True if its own capacity and its start are the same values as those of another node.
    pub(crate) fn is_same(&self, other: &Self) -> bool {
        let same = |a: &Option<Value>, b: &Option<Value>| match (a, b) {
            (Some(a), Some(b)) => a.is_same(b),
            (a, b) => a.is_none() && b.is_none(),
        };
        same(&self.capacity, &other.capacity)
            && same(&self.initial, &other.initial)
            && self.molten.to_bits() == other.molten.to_bits()
    }
}

impl Body {
    fn is_only_lump(&self) -> bool {
        self.molten.to_bits() == 0 && self.length.is_none() && self.stood.is_none()
    }
}

/// A part of a node's capacity: the paper's equation (9), a sum over the parts of one lump.
#[derive(Clone, Debug)]
pub struct Capacitor {
    /// Its name, unique among nodes, boundaries and elements.
    pub name: String,
    /// The node it belongs to.
    pub node: NodeId,
    /// Its heat capacity in J/K; may depend on the node's temperature.
    pub capacity: Value,
    /// The lump that its capacity was computed from.
    pub lump: Option<Lump>,
}

/// A place with a given temperature.
#[derive(Clone, Debug)]
pub struct Boundary {
    /// Its name, unique among nodes, boundaries and elements.
    pub name: String,
    /// Its temperature in K; may depend on time.
    pub temperature: Value,
}

/// A path that carries heat between two ends. Parallel conductors add.
#[derive(Clone, Debug)]
pub struct Conductor {
    pub(crate) label: Label,
    /// The kind of section that contains it.
    pub kind: Kind,
    /// The end that positive heat leaves.
    pub from: End,
    /// The end that positive heat enters.
    pub to: End,
    /// The formula by which it carries heat, with one value for each field.
    pub law: Law,
}

/// A source of heat.
#[derive(Clone, Debug)]
pub struct Source {
    pub(crate) label: Label,
    /// The nodes it heats, with the share of each; the shares sum to 1.
    pub into: Vec<(NodeId, f64)>,
    /// The kind of section that contains it.
    pub kind: Kind,
    /// The formula of its heat in W, positive into the nodes, with one value for each field; they
    /// may depend on time and on temperatures.
    pub law: Law,
}

impl Conductor {
    /// Its name; one without a name is called by its number, `import.conductor[17]`.
    pub fn name(&self) -> Cow<'_, str> {
        self.label.of_conductor()
    }
}

impl Source {
    /// Its heat in W if that is given, and not computed by a law.
    pub fn power(&self) -> Option<&Value> {
        self.law.values().first().filter(|_| self.law.formula() == Formula::Given)
    }

    /// Its name; one without a name is called by its number, `import.source[17]`.
    pub fn name(&self) -> Cow<'_, str> {
        self.label.of_source()
    }
}
