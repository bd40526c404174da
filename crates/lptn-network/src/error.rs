//! What can be wrong with a network.

use std::fmt;

use lptn_units::{EvalError, Type};

use crate::grid::GridFace;
use crate::id::{ConductorId, ControlId, Field, FluidId, GridId, Item, NodeId, SignalId, SourceId};

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
    /// A name that stands for something inside another item, or for one of its results.
    NameInside {
        /// The item with this name.
        item: Item,
        /// The grid or element whose part or result has it.
        whole: Item,
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
    /// A value that may be zero, but not less.
    Negative {
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
    /// A comparison of a temperature where its change cannot be followed: in a property, or for equality.
    ComparesTemperature {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
    },
    /// The threshold at which a control switches on lies beyond that at which it switches off, or both are one.
    ThresholdsCrossed {
        /// The control.
        control: ControlId,
        /// The fields of the thresholds for on and off.
        fields: [Field; 2],
        /// On, in K.
        on: f64,
        /// Off, in K.
        off: f64,
    },
    /// A control of which nothing says when it switches.
    NoThermostat {
        /// The control.
        control: ControlId,
    },
    /// An emissivity or view factor that is not above 0 and at most 1.
    NotAFraction {
        /// The item.
        item: Item,
        /// Its field.
        field: Field,
        /// The value.
        value: f64,
    },
    /// An outer radius that is not larger than the inner one.
    Radii {
        /// The conductor.
        item: Item,
        /// Inner radius in m.
        inner: f64,
        /// Outer radius in m.
        outer: f64,
    },
    /// A liquidus below the solidus.
    Melting {
        /// The material.
        item: Item,
        /// Solidus in K.
        solidus: f64,
        /// Liquidus in K.
        liquidus: f64,
    },
    /// A node of which a part is said to be molten at its start, but that does not melt at just that temperature.
    NotMelting {
        /// The node.
        node: NodeId,
        /// Its start in K.
        temperature: f64,
    },
    /// Shares of a source that are negative or do not sum to 1.
    Shares {
        /// The source.
        source: SourceId,
        /// Their sum.
        sum: f64,
    },
    /// A source of several nodes whose heat depends on `T`, which could be any of theirs.
    WhichTemperature {
        /// The source.
        source: SourceId,
    },
    /// A capacity that is not known and positive at the start of its node.
    CapacityUnknown {
        /// The node.
        node: NodeId,
        /// Its start in K.
        temperature: f64,
    },
    /// A capacity that changes so quickly with temperature that its integral cannot be followed.
    TooQuick {
        /// The node or fluid.
        item: Item,
        /// The value.
        field: Field,
    },
    /// A property of a fluid that is not known and positive where it is needed.
    FluidUnknown {
        /// The fluid.
        fluid: FluidId,
        /// The property.
        field: Field,
    },
    /// A period that ends before the last point of its signal.
    PeriodTooShort {
        /// The signal.
        signal: SignalId,
        /// The period in s.
        period: f64,
        /// From the first to the last point in s.
        span: f64,
    },
    /// Points of a signal that are not as many times as values, one at least, finite, the times rising.
    SignalPoints {
        /// The signal.
        signal: SignalId,
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
    /// A network without any node, and without a path between boundaries.
    Empty,
    /// Counts of cells that are not one to three, each at least 1.
    GridCells {
        /// The grid.
        grid: GridId,
        /// The counts.
        counts: Vec<usize>,
    },
    /// More than [`MOST_CELLS`](crate::MOST_CELLS) cells.
    GridTooLarge {
        /// The grid.
        grid: GridId,
        /// The counts.
        counts: Vec<usize>,
    },
    /// A grid of a material that lacks a property.
    NoProperty {
        /// The grid.
        item: Item,
        /// The property.
        field: Field,
    },
    /// A stream that ends at a face of a grid, which it cannot mix with.
    StreamIntoFace {
        /// The path.
        item: Item,
    },
    /// Two faces that are joined but not divided in the same way.
    FaceCells {
        /// The path.
        item: Item,
        /// The faces.
        faces: [GridFace; 2],
        /// Their names.
        names: [String; 2],
        /// How many cells each has along its two axes.
        cells: [[usize; 2]; 2],
    },
    /// Two faces that are joined but not of the same size.
    FaceSides {
        /// The path.
        item: Item,
        /// The faces.
        faces: [GridFace; 2],
        /// Their names.
        names: [String; 2],
        /// The lengths of each along its two axes in m.
        sides: [[f64; 2]; 2],
    },
    /// A path whose area is not that of the face it ends at.
    FaceArea {
        /// The path.
        item: Item,
        /// Its area in m^2.
        given: f64,
        /// The face.
        face: GridFace,
        /// Its name.
        name: String,
        /// The area of the face in m^2.
        area: f64,
    },
}

impl BuildError {
    /// The stable code, as diagnostics print it.
    pub fn code(&self) -> &'static str {
        use BuildErrorKind as K;
        match &self.kind {
            K::DuplicateName { .. } | K::NameInside { .. } => "network::duplicate_name",
            K::BadName { .. } => "network::bad_name",
            K::ReservedName { .. } => "network::reserved_name",
            K::WrongType { .. } => "network::wrong_type",
            K::NotPositive { .. } => "network::not_positive",
            K::Negative { .. } => "network::negative",
            K::NotFinite { .. } => "network::not_finite",
            K::BelowAbsoluteZero { .. } => "network::below_absolute_zero",
            K::DependsOnTime { .. } => "network::depends_on_time",
            K::DependsOnResult { .. } => "network::depends_on_result",
            K::ComparisonNotLinear { .. } => "network::comparison_not_linear",
            K::ComparesTemperature { .. } => "network::compares_temperature",
            K::ThresholdsCrossed { .. } => "network::thresholds_crossed",
            K::NoThermostat { .. } => "network::no_thermostat",
            K::NotAFraction { .. } => "network::not_a_fraction",
            K::Radii { .. } => "network::radii",
            K::Melting { .. } => "network::melting",
            K::NotMelting { .. } => "network::not_melting",
            K::Shares { .. } => "network::shares",
            K::WhichTemperature { .. } => "network::which_temperature",
            K::CapacityUnknown { .. } => "network::capacity_unknown",
            K::TooQuick { .. } => "network::capacity_too_quick",
            K::FluidUnknown { .. } => "network::fluid_unknown",
            K::PeriodTooShort { .. } => "network::period_too_short",
            K::SignalPoints { .. } => "network::signal_points",
            K::Evaluation { error, .. } => error.code(),
            K::SelfLink { .. } => "network::self_link",
            K::SourceIntoBoundary { .. } => "network::source_into_boundary",
            K::NoCapacity { .. } => "network::no_capacity",
            K::MasslessWithCapacity { .. } => "network::massless_with_capacity",
            K::NoInitialTemperature { .. } => "network::no_initial_temperature",
            K::FloatingIsland { .. } => "network::floating_island",
            K::ForeignId { .. } => "network::foreign_id",
            K::ForeignParameters => "network::foreign_parameters",
            K::Empty => "network::empty",
            K::GridCells { .. } => "network::grid_cells",
            K::GridTooLarge { .. } => "network::grid_too_large",
            K::NoProperty { .. } => "network::no_property",
            K::StreamIntoFace { .. } => "network::stream_into_face",
            K::FaceCells { .. } => "network::face_cells",
            K::FaceSides { .. } => "network::face_sides",
            K::FaceArea { .. } => "network::face_area",
        }
    }
}
