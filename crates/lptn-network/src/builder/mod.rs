//! Builds a network and checks that it is one.

pub(crate) mod control;
pub(crate) mod face_path;
mod face_stream;
pub(crate) mod grid;
mod grid_path;
mod joint;
pub(crate) mod lookup;
pub(crate) mod numbered;
mod patch;
mod pipe;
mod register;
pub(crate) mod result;
pub(crate) mod signal;
pub(crate) mod state;
pub(crate) mod substance;

use std::sync::Arc;

use lptn_laws::{Carries, Formula, Kind};
use lptn_units::{Dimension, Expression, Problems, Program, TableSymbol, Type, UnitError};

use crate::build_error::{BuildError, BuildErrors};
use crate::error::BuildErrorKind;
use crate::id::{
    BoundaryId, CapacitorId, ConductorId, End, Field, Item, LimitId, NodeId, ParameterId, SourceId,
    TableId,
};
use crate::law::Law;
use crate::network::Network;
use crate::numbers::Numbers;
use crate::parts::Parts;
use crate::parts::element::{Boundary, Capacitor, Node, Parameter};
use crate::parts::functional::OverTime;
use crate::parts::result::{Bound, Limit, LimitSeverity};
use crate::parts::whole;
use crate::scope::{Context, NetworkScope};
use crate::value::{Input, Value};
use crate::{check, clash};

const CAPACITY: Type = Type::of(Dimension::CAPACITY);

/// The law of a path or source with its values, as a builder takes it.
pub type Path = Law<Input>;

impl From<crate::typed::Resistance> for Path {
    fn from(value: crate::typed::Resistance) -> Self {
        Self::resistance(value)
    }
}

impl From<crate::typed::Conductance> for Path {
    fn from(value: crate::typed::Conductance) -> Self {
        Self::conductance(value)
    }
}

/// Collects the parts of a network; [`NetworkBuilder::build`] checks them all at once.
#[derive(Clone, Debug, Default)]
pub struct NetworkBuilder {
    pub(crate) parts: Parts,
    errors: Vec<BuildError>,
}

impl NetworkBuilder {
    /// A builder without any part.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the title.
    pub fn title(&mut self, title: &str) {
        self.parts.title = Some(title.to_owned());
    }

    /// Adds a parameter. Its expression may use parameters that were added before it; one that
    /// reads nothing is a number.
    pub fn parameter(&mut self, name: &str, value: impl Into<Input>) -> ParameterId {
        let Input { value, ty, deviation, .. } = value.into();
        let value = value.folded();
        let id = ParameterId::from_len(self.parts.parameters.len());
        self.parts.parameters.push(Parameter { name: name.to_owned(), ty, value, deviation });
        Arc::make_mut(&mut self.parts.layout).add_parameter(id);
        self.parts.parameter_names.entry(name.to_owned()).or_insert(id);
        self.register_value(name, Item::Parameter(id));
        id
    }

    /// Adds a node with a heat capacity and a temperature at the start.
    pub fn node(
        &mut self,
        name: &str,
        capacity: impl Into<Input>,
        initial: impl Into<Input>,
    ) -> NodeId {
        self.add_node(name, Some(capacity.into()), Some(initial.into()), false)
    }

    /// Adds a node whose capacity is the sum of its capacitors.
    pub fn node_of_parts(&mut self, name: &str, initial: impl Into<Input>) -> NodeId {
        self.add_node(name, None, Some(initial.into()), false)
    }

    /// Adds a junction without capacity.
    pub fn massless(&mut self, name: &str) -> NodeId {
        self.add_node(name, None, None, true)
    }

    /// Adds a node as a netlist may write it; [`NetworkBuilder::build`] reports missing values.
    pub fn add_node(
        &mut self,
        name: &str,
        capacity: Option<Input>,
        initial: Option<Input>,
        massless: bool,
    ) -> NodeId {
        let id = self.push_node(name, capacity, initial, massless);
        self.register(name, Item::Node(id));
        id
    }

    /// The same without making its name known.
    fn push_node(
        &mut self,
        name: &str,
        capacity: Option<Input>,
        initial: Option<Input>,
        massless: bool,
    ) -> NodeId {
        let id = NodeId::from_len(self.parts.nodes.len());
        let at = |field| (name, Item::Node(id), field);
        let lump = capacity.as_ref().and_then(|c| c.lump.clone());
        let capacity = capacity.map(|c| self.typed(at(Field::Capacity), c, CAPACITY));
        let initial =
            initial.map(|t| self.typed(at(Field::Initial), t, Type::ABSOLUTE_TEMPERATURE));
        let node = Node::new(name, capacity, initial, massless);
        let node = match lump {
            Some(lump) => node.of_lump(lump, self.parts.nodes.last()),
            None => node,
        };
        make_room(&mut self.parts.nodes, 1);
        self.parts.nodes.push(node);
        Arc::make_mut(&mut self.parts.layout).add_node(id);
        id
    }

    /// Sets the capacity of a node: one that reads states is compiled after them.
    pub fn set_capacity(&mut self, node: NodeId, capacity: impl Into<Input>) {
        let name = self.parts.nodes[node.index()].name.clone();
        let at = (name.as_str(), Item::Node(node), Field::Capacity);
        let capacity = self.typed(at, capacity.into(), CAPACITY);
        self.parts.nodes[node.index()].capacity = Some(capacity);
    }

    /// Adds a part to the capacity of `node`.
    pub fn capacitor(
        &mut self,
        name: &str,
        node: NodeId,
        capacity: impl Into<Input>,
    ) -> CapacitorId {
        let id = CapacitorId::from_len(self.parts.capacitors.len());
        let at = (name, Item::Capacitor(id), Field::Capacity);
        self.check_end(name, Item::Capacitor(id), node.into());
        let input = capacity.into();
        let lump = input.lump.clone();
        let capacity = self.typed(at, input, CAPACITY);
        self.parts.capacitors.push(Capacitor { name: name.to_owned(), node, capacity, lump });
        self.register(name, Item::Capacitor(id));
        id
    }

    /// Adds a boundary with a given temperature, which may depend on `t`.
    pub fn boundary(&mut self, name: &str, temperature: impl Into<Input>) -> BoundaryId {
        let id = BoundaryId::from_len(self.parts.boundaries.len());
        let at = (name, Item::Boundary(id), Field::Temperature);
        let temperature = self.typed(at, temperature.into(), Type::ABSOLUTE_TEMPERATURE);
        self.parts.boundaries.push(Boundary { name: name.to_owned(), temperature });
        Arc::make_mut(&mut self.parts.layout).add_boundary(id);
        self.register(name, Item::Boundary(id));
        id
    }

    /// Adds a resistor between two ends.
    pub fn resistor(
        &mut self,
        name: &str,
        from: impl Into<End>,
        to: impl Into<End>,
        path: impl Into<Path>,
    ) -> ConductorId {
        self.conductor(name, Kind::Resistor, (from.into(), to.into()), path.into())
    }

    /// Adds a convecting surface between two ends.
    pub fn convection(
        &mut self,
        name: &str,
        from: impl Into<End>,
        to: impl Into<End>,
        path: impl Into<Path>,
    ) -> ConductorId {
        self.conductor(name, Kind::Convection, (from.into(), to.into()), path.into())
    }

    /// Adds a conductor of any kind.
    pub fn conductor(
        &mut self,
        name: &str,
        kind: Kind,
        (from, to): (End, End),
        path: Path,
    ) -> ConductorId {
        let id = self.push_conductor(name.into(), kind, (from, to), path);
        self.register(name, Item::Conductor(id));
        id
    }

    /// Adds a source that heats a node with `power`, which may depend on `t`.
    pub fn source(
        &mut self,
        name: &str,
        into: impl Into<End>,
        power: impl Into<Input>,
    ) -> SourceId {
        self.heat(name, Kind::Source, &[(into.into(), 1.0)], Path::heat(power))
    }

    /// Adds a source whose heat is shared between nodes; the shares have to sum to 1.
    pub fn shared_source(
        &mut self,
        name: &str,
        into: &[(NodeId, f64)],
        power: impl Into<Input>,
    ) -> SourceId {
        let into: Vec<(End, f64)> =
            into.iter().map(|&(node, share)| (node.into(), share)).collect();
        self.heat(name, Kind::Source, &into, Path::heat(power))
    }

    /// Adds a source of any kind, whose heat a law gives; the shares of its nodes have to sum to 1.
    pub fn heat(&mut self, name: &str, kind: Kind, into: &[(End, f64)], law: Path) -> SourceId {
        let id = self.push_source(name.into(), kind, into, law);
        self.register(name, Item::Source(id));
        id
    }

    /// Adds a table that expressions added afterwards may call by its name.
    pub fn table(&mut self, name: &str, table: TableSymbol) -> TableId {
        let id = TableId::from_len(self.parts.tables.len());
        self.parts.tables.push((name.to_owned(), table));
        self.register_value(name, Item::Table(id));
        id
    }

    /// The names that an expression may use in this place.
    pub fn scope(&self, context: Context) -> NetworkScope<'_> {
        NetworkScope::new(&self.parts, context)
    }

    /// Compiles an expression for this place over everything added up to now.
    ///
    /// # Errors
    /// Every problem of the text: syntax, unknown names, dimensions.
    pub fn expression_in(
        &self,
        context: Context,
        text: &str,
        expected: Option<Type>,
    ) -> Result<Program, Problems<UnitError>> {
        Expression::parse(text)?.compile(&self.scope(context), expected)
    }

    /// Compiles an expression over the parameters, signals and tables added up to now and `t`.
    ///
    /// # Errors
    /// Every problem of the text: syntax, unknown names, dimensions.
    pub fn expression(
        &self,
        text: &str,
        expected: Option<Type>,
    ) -> Result<Program, Problems<UnitError>> {
        self.expression_in(Context::Time, text, expected)
    }

    /// The names that expressions of results may use.
    pub fn post_scope(&self) -> NetworkScope<'_> {
        self.scope(Context::Result)
    }

    /// Adds a limit: `of`, written as `text`, has to stay below or above a value of the same type,
    /// which is constant. For a number over time, `of` is the quantity with the type of the number,
    /// see [`NetworkBuilder::limit_over_time`].
    pub fn limit(
        &mut self,
        name: &str,
        (of, text): (Input, &str),
        (bound, value): (Bound, Input),
        severity: LimitSeverity,
    ) -> LimitId {
        let id = LimitId::from_len(self.parts.limits.len());
        let ty = of.ty;
        let value = self.typed((name, Item::Limit(id), bound.field()), value, ty);
        let (name, text) = (name.to_owned(), text.to_owned());
        self.parts.limits.push(Limit {
            name: name.clone(),
            of: of.value,
            ty,
            bound,
            value,
            compares: false,
            over_time: [None, None],
            severity,
            text,
        });
        self.register(&name, Item::Limit(id));
        id
    }

    /// Applies a limit that was added to a functional of its quantity.
    pub fn limit_over_time(&mut self, id: LimitId, over_time: OverTime) {
        self.parts.limits[id.index()].over_time[0] = Some(over_time);
    }

    /// Checks everything and gives the network.
    ///
    /// # Errors
    /// All problems at once.
    pub fn build(mut self) -> Result<Network, BuildErrors> {
        if self.errors.iter().any(|e| matches!(e.kind, BuildErrorKind::ForeignId { .. })) {
            return Err(Problems(self.errors)); // nothing else can be looked up
        }
        check::structure(&self.parts, &mut self.errors);
        clash::names(&self.parts, &mut self.errors);
        whole::collapse(&self.parts, &mut self.errors);
        self.parts.nodes.shrink_to_fit();
        self.parts.conductors.shrink_to_fit();
        self.parts.settle();
        self.parts.settle_grid_values();
        match Numbers::evaluate(&self.parts, &[]) {
            Ok(numbers) if self.errors.is_empty() => {
                Ok(Network { parts: Arc::new(self.parts), numbers: Arc::new(numbers) })
            }
            Ok(_) => Err(Problems(self.errors)),
            Err(more) => {
                self.errors.extend(more);
                Err(Problems(self.errors))
            }
        }
    }

    pub(crate) fn law(&mut self, name: &str, item: Item, path: Path) -> Law {
        let declared = path.formula().declaration();
        let is_source = matches!(item, Item::Source(_));
        if path.values().len() != declared.fields.len()
            || path.fluid().is_some() != declared.carries.is_of_fluid()
            || is_source != (declared.carries == Carries::Heat)
        {
            self.error(name, BuildErrorKind::LawValues { item, formula: path.formula() });
            return Law::new(Formula::Resistance, [Value::Constant(1.0)]);
        }
        if path.fluid().is_some_and(|fluid| fluid.index() >= self.parts.fluids.len()) {
            self.error(name, BuildErrorKind::ForeignId { item });
            return Law::new(Formula::Resistance, [Value::Constant(1.0)]);
        }
        let mut types = declared.fields.iter().map(|field| field.ty);
        path.map(|field, input| {
            let wanted = types.next().unwrap_or(Type::SCALAR);
            self.typed((name, item, field), input, wanted)
        })
    }

    pub(crate) fn typed(
        &mut self,
        (name, item, field): (&str, Item, Field),
        input: Input,
        wanted: Type,
    ) -> Value {
        if input.ty != wanted {
            self.error(name, BuildErrorKind::WrongType { item, field, wanted, found: input.ty });
        }
        input.value
    }
}

/// Room for more elements, an eighth of those there at least: to double the list of a million nodes
/// for one more would take 70 MB.
pub(crate) fn make_room<T>(list: &mut Vec<T>, more: usize) {
    if list.capacity() - list.len() < more {
        list.reserve_exact(more.max(list.len() / 8).max(8));
    }
}
