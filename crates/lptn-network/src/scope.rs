//! The names that expressions may use, by context.

use std::sync::Arc;

use lptn_units::{Dimension, Expression, Scope, Symbol, TableSymbol, Type};

use crate::id::{End, Item, NodeId};
use crate::parts::Parts;
use crate::slot;

/// The context of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Context {
    /// Parameters, boundaries, signals: nothing but parameters, `t`, signals, controls and tables.
    Time,
    /// A property of a material or fluid: its own `T` too.
    Own,
    /// The capacity of a node: its own `T`, or states.
    Capacity,
    /// A threshold of a control: `NAME.T` of every node and boundary too.
    Control,
    /// A source: its node's own `T` and `NAME.T` of every node and boundary too.
    Source,
    /// A conductor: `T_from`, `T_to`, `T_mean`, `dT` and `NAME.T` too.
    Link,
    /// Results: `NAME.T` and the heat flows `NAME.Q`, `NAME.Q_from`, `NAME.Q_to`, `NAME.P` too.
    Result,
}

/// The names that an expression may use.
#[derive(Clone, Copy, Debug)]
pub struct NetworkScope<'a> {
    parts: &'a Parts,
    context: Context,
}

impl<'a> NetworkScope<'a> {
    pub(crate) fn new(parts: &'a Parts, context: Context) -> Self {
        Self { parts, context }
    }

    /// Temperatures of the element at hand.
    fn local(self, name: &str) -> Option<Symbol> {
        let (slot, ty) = match (self.context, name) {
            (Context::Own | Context::Capacity | Context::Source, "T") => {
                (slot::OWN, Type::ABSOLUTE_TEMPERATURE)
            }
            (Context::Link, "T_from") => (slot::FROM, Type::ABSOLUTE_TEMPERATURE),
            (Context::Link, "T_to") => (slot::TO, Type::ABSOLUTE_TEMPERATURE),
            (Context::Link, "T_mean") => (slot::MEAN, Type::ABSOLUTE_TEMPERATURE),
            (Context::Link, "dT") => (slot::DIFFERENCE, Type::of(Dimension::TEMPERATURE)),
            _ => return None,
        };
        Some(Symbol { slot, ty, in_comparison: None })
    }

    fn names_ends(self) -> bool {
        !matches!(self.context, Context::Time | Context::Own)
    }

    fn temperature(self, name: &str) -> Option<Symbol> {
        if !self.names_ends() {
            return None;
        }
        let end = match self.parts.item(name)? {
            Item::Node(id) => End::Node(id),
            Item::Boundary(id) => End::Boundary(id),
            _ => return None,
        };
        let slot = self.parts.layout.temperature(end);
        Some(Symbol { slot, ty: Type::ABSOLUTE_TEMPERATURE, in_comparison: None })
    }

    /// The node of a state, as a temperature difference from 0 K.
    fn inner(self, name: &str) -> Option<Symbol> {
        let Item::State(id) = *self.parts.value_names.get(name.strip_suffix('\'')?)? else {
            return None;
        };
        let node = self.parts.states[id.index()].node;
        let slot = self.parts.layout.temperature(End::Node(node));
        Some(Symbol { slot, ty: Type::of(Dimension::TEMPERATURE), in_comparison: None })
    }

    /// A heat flow that has a slot: see [`crate::NetworkBuilder::name_heats`].
    fn heat(self, name: &str) -> Option<Symbol> {
        let heat = self.parts.heat(name).filter(|_| self.context == Context::Result)?;
        let slot = self.parts.layout.heat(heat)?;
        Some(Symbol { slot, ty: self.parts.heat_type(heat), in_comparison: None })
    }

    /// A temperature of a grid that has a slot: see [`crate::NetworkBuilder::name_heats`].
    fn grid(self, name: &str) -> Option<Symbol> {
        let value = self.parts.grid_value(name).filter(|_| self.context == Context::Result)?;
        let slot = self.parts.layout.grid_value(value)?;
        Some(Symbol { slot, ty: Type::ABSOLUTE_TEMPERATURE, in_comparison: None })
    }

    fn value(self, name: &str) -> Option<Symbol> {
        let layout = &self.parts.layout;
        match *self.parts.value_names.get(name)? {
            Item::Parameter(id) => {
                let ty = self.parts.parameters[id.index()].ty;
                Some(Symbol { slot: layout.parameter(id), ty, in_comparison: None })
            }
            Item::Signal(id) => {
                let (slot, ty) = (layout.signal(id), layout.signals()[id.index()].ty);
                Some(Symbol { slot, ty, in_comparison: Some(slot + 1) })
            }
            Item::Control(id) => {
                Some(Symbol { slot: layout.control(id), ty: Type::SCALAR, in_comparison: None })
            }
            _ => None,
        }
    }
}

impl Scope for NetworkScope<'_> {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        if name == "t" {
            let ty = Type::of(Dimension::TIME);
            return Some(Symbol { slot: slot::TIME, ty, in_comparison: Some(slot::SEGMENT) });
        }
        let own = match name.rsplit_once('.') {
            Some((base, "T")) => self.temperature(base).or_else(|| self.grid(name)),
            Some(_) => self.heat(name).or_else(|| self.grid(name)),
            None => self.local(name),
        };
        own.or_else(|| self.value(name)).or_else(|| self.inner(name))
    }

    fn meaning(&self, name: &str) -> Option<Arc<Expression>> {
        let meaning = match *self.parts.value_names.get(name)? {
            Item::State(id) => &self.parts.states[id.index()].meaning,
            Item::Value(id) => &self.parts.named_values[id.index()].meaning,
            _ => return None,
        };
        self.names_ends().then(|| Arc::clone(meaning))
    }

    fn names(&self) -> Vec<String> {
        let parameters = self.parts.parameters.iter().map(|p| p.name.clone());
        let signals = self.parts.layout.signals().iter().map(|s| s.name.clone());
        let controls = self.parts.controls.iter().map(|c| c.name.clone());
        let mut names: Vec<String> =
            parameters.chain(signals).chain(controls).chain(["t".to_owned()]).collect();
        let local = ["T", "T_from", "T_to", "T_mean", "dT"];
        names.extend(local.into_iter().filter(|n| self.local(n).is_some()).map(str::to_owned));
        if self.names_ends() {
            let is_node = |i: &usize| self.parts.state_at(NodeId::from_len(*i)).is_none();
            let nodes = (0..self.parts.nodes.len()).filter(is_node);
            let nodes = nodes.map(|i| &self.parts.nodes[i].name);
            let boundaries = self.parts.boundaries.iter().map(|boundary| &boundary.name);
            names.extend(nodes.chain(boundaries).map(|name| format!("{name}.T")));
            names.extend(self.parts.states.iter().map(|state| state.name.clone()));
            names.extend(self.parts.named_values.iter().map(|value| value.name.clone()));
        }
        if self.context == Context::Result {
            names.extend(self.parts.heat_names());
            names.extend(self.parts.grid_value_names());
        }
        names
    }

    fn table(&self, name: &str) -> Option<TableSymbol> {
        match self.parts.value_names.get(name)? {
            Item::Table(id) => Some(self.parts.tables[id.index()].1.clone()),
            _ => None,
        }
    }

    fn table_names(&self) -> Vec<String> {
        self.parts.tables.iter().map(|(name, _)| name.clone()).collect()
    }
}
