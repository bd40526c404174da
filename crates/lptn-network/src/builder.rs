//! Builds a network and checks that it is one.

use lptn_units::{Dimension, Expression, Program, RESERVED, Scope, Symbol, Type, UnitError};

use crate::check;
use crate::element::{Boundary, Capacitor, Conductor, ConductorKind, Law, Node, Parameter, Source};
use crate::error::{BuildError, BuildErrorKind, BuildErrors};
use crate::id::{
    BoundaryId, CapacitorId, ConductorId, End, Field, Item, LimitId, NodeId, ParameterId, SourceId,
};
use crate::limit::{Bound, Limit, PostScope, Severity};
use crate::network::Network;
use crate::numbers::Numbers;
use crate::parts::Parts;
use crate::value::{Input, Value};

const CAPACITY: Type = Type::of(Dimension::CAPACITY);

/// A law as it is given to the builder: exactly one form, so that R and G together cannot be written.
#[derive(Clone, Debug)]
pub enum Path {
    /// Thermal resistance.
    Resistance(Input),
    /// Thermal conductance.
    Conductance(Input),
    /// Film coefficient and area.
    Film(Input, Input),
}

impl From<crate::typed::Resistance> for Path {
    fn from(value: crate::typed::Resistance) -> Self {
        Self::Resistance(value.into())
    }
}

impl From<crate::typed::Conductance> for Path {
    fn from(value: crate::typed::Conductance) -> Self {
        Self::Conductance(value.into())
    }
}

/// Collects the parts of a network; [`NetworkBuilder::build`] checks them all at once.
#[derive(Clone, Debug, Default)]
pub struct NetworkBuilder {
    pub(crate) parts: Parts,
    errors: Vec<BuildError>,
    /// The numbers of parameters and nodes on which the first expression of results rests.
    shape: Option<(usize, usize)>,
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

    /// Adds a parameter. Its expression may use parameters that were added before it.
    pub fn parameter(&mut self, name: &str, value: impl Into<Input>) -> ParameterId {
        let Input { value, ty, deviation, .. } = value.into();
        let id = ParameterId::from_len(self.parts.parameters.len());
        self.parts.parameters.push(Parameter { name: name.to_owned(), ty, value, deviation });
        self.check_name(name, Item::Parameter(id));
        match self.parts.parameter_names.get(name) {
            Some(&first) => self.duplicate(name, Item::Parameter(first), Item::Parameter(id)),
            None => drop(self.parts.parameter_names.insert(name.to_owned(), id)),
        }
        id
    }

    /// Adds a node with a heat capacity and a temperature at the start.
    pub fn node(&mut self, name: &str, capacity: impl Into<Input>, initial: impl Into<Input>) -> NodeId {
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

    /// Adds a node as a netlist may write it; [`NetworkBuilder::build`] says what is missing.
    pub fn add_node(
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
        let initial = initial.map(|t| self.typed(at(Field::Initial), t, Type::ABSOLUTE_TEMPERATURE));
        self.parts.nodes.push(Node { name: name.to_owned(), capacity, lump, initial, massless });
        self.register(name, Item::Node(id));
        id
    }

    /// Adds a part to the capacity of `node`.
    pub fn capacitor(&mut self, name: &str, node: NodeId, capacity: impl Into<Input>) -> CapacitorId {
        let id = CapacitorId::from_len(self.parts.capacitors.len());
        let at = (name, Item::Capacitor(id), Field::Capacity);
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
        self.conductor(name, ConductorKind::Resistor, (from.into(), to.into()), path.into())
    }

    /// Adds a convecting surface between two ends.
    pub fn convection(
        &mut self,
        name: &str,
        from: impl Into<End>,
        to: impl Into<End>,
        path: impl Into<Path>,
    ) -> ConductorId {
        self.conductor(name, ConductorKind::Convection, (from.into(), to.into()), path.into())
    }

    /// Adds a conductor of any kind.
    pub fn conductor(
        &mut self,
        name: &str,
        kind: ConductorKind,
        (from, to): (End, End),
        path: Path,
    ) -> ConductorId {
        let id = ConductorId::from_len(self.parts.conductors.len());
        let law = self.law(name, Item::Conductor(id), path);
        self.parts.conductors.push(Conductor { name: name.to_owned(), kind, from, to, law });
        self.register(name, Item::Conductor(id));
        if from == to {
            self.error(name, BuildErrorKind::SelfLink { conductor: id });
        }
        id
    }

    /// Adds a source that heats a node with `power`, which may depend on `t`.
    pub fn source(&mut self, name: &str, into: impl Into<End>, power: impl Into<Input>) -> SourceId {
        let id = SourceId::from_len(self.parts.sources.len());
        let at = (name, Item::Source(id), Field::Power);
        let power = self.typed(at, power.into(), Type::of(Dimension::POWER));
        let node = match into.into() {
            End::Node(node) => node,
            End::Boundary(_) => {
                self.error(name, BuildErrorKind::SourceIntoBoundary { source: id });
                NodeId(0)
            }
        };
        self.parts.sources.push(Source { name: name.to_owned(), into: node, power });
        self.register(name, Item::Source(id));
        id
    }

    /// Compiles an expression over the parameters added so far and `t`.
    ///
    /// # Errors
    /// Every problem of the text: syntax, unknown names, dimensions.
    pub fn expression(&self, text: &str, expected: Option<Type>) -> Result<Program, Vec<UnitError>> {
        Expression::parse(text).map_err(|e| vec![e])?.compile(self, expected)
    }

    /// The names that expressions of results may use. Add what they may name first: a parameter or node that is
    /// added later would move the places of those before it, and [`NetworkBuilder::build`] refuses it.
    pub fn post_scope(&mut self) -> PostScope<'_> {
        self.shape.get_or_insert(self.parts.shape());
        PostScope::new(&self.parts)
    }

    /// Compiles an expression over the parameters, `t` and the temperatures `NAME.T` of the nodes and boundaries
    /// added so far; see [`NetworkBuilder::post_scope`].
    ///
    /// # Errors
    /// Every problem of the text: syntax, unknown names, dimensions.
    pub fn post_expression(&mut self, text: &str, expected: Option<Type>) -> Result<Program, Vec<UnitError>> {
        Expression::parse(text).map_err(|e| vec![e])?.compile(&self.post_scope(), expected)
    }

    /// Adds a limit: `of`, written as `text`, has to stay below or above a value of the same type, which is
    /// constant.
    pub fn limit(
        &mut self,
        name: &str,
        (of, text): (Input, &str),
        (bound, value): (Bound, Input),
        severity: Severity,
    ) -> LimitId {
        let id = LimitId::from_len(self.parts.limits.len());
        let ty = of.ty;
        let value = self.typed((name, Item::Limit(id), bound.field()), value, ty);
        let (name, text) = (name.to_owned(), text.to_owned());
        self.parts.limits.push(Limit { name: name.clone(), of: of.value, ty, bound, value, severity, text });
        self.register(&name, Item::Limit(id));
        id
    }

    /// Checks everything and gives the network.
    ///
    /// # Errors
    /// All problems at once.
    pub fn build(mut self) -> Result<Network, BuildErrors> {
        check::structure(&self.parts, &mut self.errors);
        if self.shape.is_some_and(|shape| shape != self.parts.shape()) {
            self.error("", BuildErrorKind::PartAfterLimit);
        }
        match Numbers::evaluate(&self.parts, &[]) {
            Ok(numbers) if self.errors.is_empty() => {
                Ok(Network { parts: std::sync::Arc::new(self.parts), numbers })
            }
            Ok(_) => Err(BuildErrors(self.errors)),
            Err(more) => {
                self.errors.extend(more);
                Err(BuildErrors(self.errors))
            }
        }
    }

    fn law(&mut self, name: &str, item: Item, path: Path) -> Law {
        let at = |field| (name, item, field);
        let of = |d| Type::of(d);
        match path {
            Path::Resistance(r) => {
                Law::Resistance(self.typed(at(Field::Resistance), r, of(Dimension::RESISTANCE)))
            }
            Path::Conductance(g) => {
                Law::Conductance(self.typed(at(Field::Conductance), g, of(Dimension::CONDUCTANCE)))
            }
            Path::Film(h, area) => Law::Film {
                coefficient: self.typed(at(Field::FilmCoefficient), h, of(Dimension::FILM_COEFFICIENT)),
                area: self.typed(at(Field::Area), area, of(Dimension::AREA)),
            },
        }
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

    fn register(&mut self, name: &str, item: Item) {
        self.check_name(name, item);
        match self.parts.names.get(name) {
            Some(&first) => self.duplicate(name, first, item),
            None => drop(self.parts.names.insert(name.to_owned(), item)),
        }
    }

    pub(crate) fn check_name(&mut self, name: &str, item: Item) {
        let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        if !name.starts_with(|c: char| word(c) && !c.is_ascii_digit()) || !name.chars().all(word) {
            self.error(name, BuildErrorKind::BadName { item });
        } else if RESERVED.contains(&name) {
            self.error(name, BuildErrorKind::ReservedName { item });
        }
    }

    fn duplicate(&mut self, name: &str, first: Item, second: Item) {
        self.error(name, BuildErrorKind::DuplicateName { first, second });
    }

    fn error(&mut self, name: &str, kind: BuildErrorKind) {
        self.errors.push(BuildError { kind, name: name.to_owned() });
    }
}

impl Scope for NetworkBuilder {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        self.parts.symbol(name)
    }

    fn names(&self) -> Vec<String> {
        self.parts.value_names()
    }
}
