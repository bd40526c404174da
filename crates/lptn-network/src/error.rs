//! What can be wrong with a network.

use std::fmt;

use lptn_units::{EvalError, Type};

use crate::id::{ConductorId, Field, Item, NodeId, SourceId};
use crate::names::list_of_names;

/// All problems found while a network was built; never empty.
#[derive(Clone, Debug)]
pub struct BuildErrors(pub Vec<BuildError>);

impl fmt::Display for BuildErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, error) in self.0.iter().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            write!(f, "{error}")?;
        }
        Ok(())
    }
}

impl std::error::Error for BuildErrors {}

/// One problem: its kind, and the names that a message needs.
#[derive(Clone, Debug)]
pub struct BuildError {
    /// What is wrong.
    pub kind: BuildErrorKind,
    /// The name of the item it is about.
    pub name: String,
}

/// The kinds of problems of a network.
#[derive(Clone, Debug)]
pub enum BuildErrorKind {
    /// Two items of one name space have the same name.
    DuplicateName {
        /// The item that had the name first.
        first: Item,
        /// The item that took it again.
        second: Item,
    },
    /// A name that is not `[A-Za-z_][A-Za-z0-9_]*`.
    BadName {
        /// The item.
        item: Item,
    },
    /// A name that expressions use for themselves.
    ReservedName {
        /// The item.
        item: Item,
    },
    /// A value of the wrong type.
    WrongType {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
        /// The type that the field has.
        wanted: Type,
        /// The type that was given.
        found: Type,
    },
    /// A value that has to be finite and more than zero, but is not.
    NotPositive {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
        /// The value in SI units.
        value: f64,
    },
    /// A value that has to be finite, but is not.
    NotFinite {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
        /// The value in SI units.
        value: f64,
    },
    /// An absolute temperature below 0 K.
    BelowAbsoluteZero {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
        /// The value in K.
        value: f64,
    },
    /// A field that has to be constant depends on `t`.
    DependsOnTime {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
    },
    /// A field that has to be known before any result depends on the temperature of a node or boundary.
    DependsOnResult {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
    },
    /// A comparison whose sides are not linear in `t`: the time at which it changes is not known beforehand.
    ComparisonNotLinear {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
    },
    /// An expression that could not be evaluated.
    Evaluation {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
        /// The reason.
        error: EvalError,
    },
    /// A conductor whose two ends are the same node.
    SelfLink {
        /// The conductor.
        conductor: ConductorId,
    },
    /// A source that heats a boundary, where it has no effect.
    SourceIntoBoundary {
        /// The source.
        source: SourceId,
    },
    /// A node without capacity that is not declared massless.
    NoCapacity {
        /// The node.
        node: NodeId,
    },
    /// A node declared massless that has a capacity.
    MasslessWithCapacity {
        /// The node.
        node: NodeId,
    },
    /// A node with capacity but without a temperature at the start.
    NoInitialTemperature {
        /// The node.
        node: NodeId,
    },
    /// Nodes that together reach neither a capacity nor a boundary: their temperatures are not determined.
    FloatingIsland {
        /// The nodes, in order.
        nodes: Vec<NodeId>,
        /// Their names.
        names: Vec<String>,
    },
    /// An element names a node, boundary or end that is not of this builder.
    ForeignId {
        /// The element.
        item: Item,
    },
    /// Parameters of another network.
    ForeignParameters,
    /// A parameter or node that was added after an expression of results had been compiled.
    PartAfterLimit,
    /// A network without any node.
    Empty,
}

impl BuildError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        use BuildErrorKind as K;
        match &self.kind {
            K::DuplicateName { .. } => "network::duplicate_name",
            K::BadName { .. } => "network::bad_name",
            K::ReservedName { .. } => "network::reserved_name",
            K::WrongType { .. } => "network::wrong_type",
            K::NotPositive { .. } => "network::not_positive",
            K::NotFinite { .. } => "network::not_finite",
            K::BelowAbsoluteZero { .. } => "network::below_absolute_zero",
            K::DependsOnTime { .. } => "network::depends_on_time",
            K::DependsOnResult { .. } => "network::depends_on_result",
            K::ComparisonNotLinear { .. } => "network::comparison_not_linear",
            K::Evaluation { error, .. } => error.code(),
            K::SelfLink { .. } => "network::self_link",
            K::SourceIntoBoundary { .. } => "network::source_into_boundary",
            K::NoCapacity { .. } => "network::no_capacity",
            K::MasslessWithCapacity { .. } => "network::massless_with_capacity",
            K::NoInitialTemperature { .. } => "network::no_initial_temperature",
            K::FloatingIsland { .. } => "network::floating_island",
            K::ForeignId { .. } => "network::foreign_id",
            K::ForeignParameters => "network::foreign_parameters",
            K::PartAfterLimit => "network::part_after_limit",
            K::Empty => "network::empty",
        }
    }

    /// Where the problem is, if it is at one item: the item and its field.
    pub fn place(&self) -> Option<(Item, Field)> {
        use BuildErrorKind as K;
        Some(match self.kind {
            K::DuplicateName { second: item, .. } | K::BadName { item } | K::ReservedName { item } => {
                (item, Field::Name)
            }
            K::WrongType { item, field, .. }
            | K::NotPositive { item, field, .. }
            | K::NotFinite { item, field, .. }
            | K::BelowAbsoluteZero { item, field, .. }
            | K::DependsOnTime { item, field }
            | K::DependsOnResult { item, field }
            | K::ComparisonNotLinear { item, field }
            | K::Evaluation { item, field, .. } => (item, field),
            K::SelfLink { conductor } => (Item::Conductor(conductor), Field::To),
            K::SourceIntoBoundary { source } => (Item::Source(source), Field::Into),
            K::NoCapacity { node } | K::MasslessWithCapacity { node } | K::NoInitialTemperature { node } => {
                (Item::Node(node), Field::Name)
            }
            K::FloatingIsland { ref nodes, .. } => (Item::Node(*nodes.first()?), Field::Name),
            K::ForeignId { item } => (item, Field::Name),
            K::ForeignParameters | K::PartAfterLimit | K::Empty => return None,
        })
    }

    /// What to do about it, in words that can be pasted where possible.
    pub fn help(&self) -> Option<String> {
        use BuildErrorKind as K;
        let name = &self.name;
        Some(match &self.kind {
            K::NoCapacity { .. } => format!(
                "give it a capacity, `{name} = {{ C = \"500 J/K\" }}`, or declare it a junction, \
                 `{name} = {{ massless = true }}`"
            ),
            K::MasslessWithCapacity { .. } => "remove `massless = true`, or the capacity".into(),
            K::NoInitialTemperature { .. } => {
                "add `T0 = \"25 degC\"` to the node, or to [default] for every node".into()
            }
            K::FloatingIsland { .. } => {
                "connect one of them to a boundary, or give one of them a capacity".into()
            }
            K::SelfLink { .. } => "a path leads from one node to another: name two different ends".into(),
            K::SourceIntoBoundary { .. } => {
                "a boundary keeps its temperature whatever flows in: name a node".into()
            }
            K::DependsOnTime { .. } => "only a source's `P` and a boundary's `T` may depend on `t`".into(),
            K::DependsOnResult { .. } => {
                "only what a limit limits may depend on temperatures: write the difference there".into()
            }
            K::ComparisonNotLinear { .. } => {
                "compare `t` itself, for example `if(t < 300 [s], 0 [W], 100 [W])`".into()
            }
            K::PartAfterLimit => "add limits last".into(),
            K::BadName { .. } => "use letters, digits and `_`, not a digit first".into(),
            K::ReservedName { .. } => format!("choose another name, for example `{name}_1`"),
            _ => return None,
        })
    }
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use BuildErrorKind as K;
        let name = &self.name;
        match &self.kind {
            K::DuplicateName { .. } => write!(f, "the name `{name}` is taken twice"),
            K::BadName { .. } => write!(f, "`{name}` is not a name"),
            K::ReservedName { .. } => write!(f, "`{name}` has a meaning of its own in expressions"),
            K::WrongType { field, wanted, found, .. } => {
                write!(f, "`{}` of `{name}` must be {wanted}, got {found}", field.key())
            }
            K::NotPositive { field, value, .. } => {
                write!(f, "`{}` of `{name}` must be finite and more than zero, got {value}", field.key())
            }
            K::NotFinite { field, value, .. } => {
                write!(f, "`{}` of `{name}` must be finite, got {value}", field.key())
            }
            K::BelowAbsoluteZero { field, value, .. } => {
                write!(f, "`{}` of `{name}` is below absolute zero: {value} K", field.key())
            }
            K::DependsOnTime { field, .. } => {
                write!(f, "`{}` of `{name}` has to be constant, but depends on `t`", field.key())
            }
            K::DependsOnResult { field, .. } => {
                write!(f, "`{}` of `{name}` depends on the temperature of a node or boundary", field.key())
            }
            K::ComparisonNotLinear { field, .. } => {
                write!(f, "`{}` of `{name}` compares something that is not linear in `t`", field.key())
            }
            K::Evaluation { field, error, .. } => write!(f, "`{}` of `{name}`: {error}", field.key()),
            K::SelfLink { .. } => write!(f, "`{name}` leads from a node to itself"),
            K::SourceIntoBoundary { .. } => write!(f, "`{name}` heats a boundary"),
            K::NoCapacity { .. } => write!(f, "node `{name}` has no capacity"),
            K::MasslessWithCapacity { .. } => write!(f, "node `{name}` is massless but has a capacity"),
            K::NoInitialTemperature { .. } => write!(f, "node `{name}` has no temperature at the start"),
            K::FloatingIsland { names, .. } => write!(
                f,
                "the temperature of {} is not determined: no boundary and no capacity is connected",
                list_of_names(names)
            ),
            K::ForeignId { .. } => write!(f, "`{name}` is joined to something of another network"),
            K::ForeignParameters => f.write_str("the parameters are those of another network"),
            K::PartAfterLimit => f.write_str("a parameter or node was added after a limit"),
            K::Empty => f.write_str("the network has no node"),
        }
    }
}
