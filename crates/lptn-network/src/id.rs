//! Typed ids: dense indices that belong to one network.

use std::sync::LazyLock;

use lptn_laws::Formula;

use crate::parts::face::Face;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub(crate) u32);

        impl $name {
            /// Position in the network's list of this kind, from 0.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }

            #[inline]
            pub(crate) fn from_len(len: usize) -> Self {
                Self(u32::try_from(len).expect("a network contains fewer than 2^32 items of a kind"))
            }
        }
    )*};
}

ids! {
    /// A parameter of `[param]`.
    ParameterId;
    /// A node whose temperature is unknown.
    NodeId;
    /// A boundary whose temperature is given.
    BoundaryId;
    /// A part of a node's capacity.
    CapacitorId;
    /// A path that carries heat between two ends.
    ConductorId;
    /// A source of heat.
    SourceId;
    /// A limit of the results.
    LimitId;
    /// A material.
    MaterialId;
    /// A fluid.
    FluidId;
    /// A signal of `[signal]`.
    SignalId;
    /// A table of `[table]`.
    TableId;
    /// A report of the results.
    ReportId;
    /// A control.
    ControlId;
    /// A comparison of temperatures.
    SwitchId;
    /// A grid: a block cut into cells.
    GridId;
    /// A path that ends at a face of a grid.
    FacePathId;
    /// A stream along a face of a grid.
    FaceStreamId;
    /// A state of one's own.
    StateId;
    /// A named value.
    ValueId;
}

/// One end of a conductor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum End {
    /// A node: its temperature is solved for.
    Node(NodeId),
    /// A boundary: its temperature is given.
    Boundary(BoundaryId),
}

impl From<NodeId> for End {
    fn from(id: NodeId) -> Self {
        Self::Node(id)
    }
}

impl From<BoundaryId> for End {
    fn from(id: BoundaryId) -> Self {
        Self::Boundary(id)
    }
}

/// A face of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GridFace {
    /// The grid whose face it is.
    pub grid: GridId,
    /// The face.
    pub face: Face,
}

/// A patch of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GridPatch {
    /// The face on which it lies.
    pub at: GridFace,
    pub(crate) index: u32,
}

/// Anything of a network that has a name; errors and source maps are keyed by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Item {
    /// A parameter.
    Parameter(ParameterId),
    /// A node.
    Node(NodeId),
    /// A boundary.
    Boundary(BoundaryId),
    /// A capacitor.
    Capacitor(CapacitorId),
    /// A conductor.
    Conductor(ConductorId),
    /// A source.
    Source(SourceId),
    /// A limit.
    Limit(LimitId),
    /// A material.
    Material(MaterialId),
    /// A fluid.
    Fluid(FluidId),
    /// A signal.
    Signal(SignalId),
    /// A table.
    Table(TableId),
    /// A report.
    Report(ReportId),
    /// A control.
    Control(ControlId),
    /// A grid.
    Grid(GridId),
    /// A path that ends at a face of a grid.
    FacePath(FacePathId),
    /// A rectangle or circle of a face of a grid.
    Patch(GridPatch),
    /// A state of one's own.
    State(StateId),
    /// A named value.
    Value(ValueId),
}

impl From<End> for Item {
    fn from(end: End) -> Self {
        match end {
            End::Node(id) => Self::Node(id),
            End::Boundary(id) => Self::Boundary(id),
        }
    }
}

impl Item {
    /// The kind of item in one word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Parameter(_) => "parameter",
            Self::Node(_) => "node",
            Self::Boundary(_) => "boundary",
            Self::Capacitor(_) => "capacitor",
            Self::Conductor(_) | Self::FacePath(_) => "path",
            Self::Source(_) => "source",
            Self::Limit(_) => "limit",
            Self::Material(_) => "material",
            Self::Fluid(_) => "fluid",
            Self::Signal(_) => "signal",
            Self::Table(_) => "table",
            Self::Report(_) => "report",
            Self::Control(_) => "control",
            Self::Grid(_) => "grid",
            Self::Patch(_) => "patch",
            Self::State(_) => "state",
            Self::Value(_) => "value",
        }
    }
}

/// A field of an item, by the word that a netlist uses for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Field {
    /// A field of the law of a conductor.
    Law(LawField),
    /// The item's own name.
    Name,
    /// A parameter's value.
    Value,
    /// Heat capacity.
    Capacity,
    /// Temperature at the start.
    Initial,
    /// Temperature of a boundary.
    Temperature,
    /// First end of a conductor.
    From,
    /// Second end of a conductor.
    To,
    /// Node that a source heats.
    Into,
    /// `of`: the quantity that a limit bounds.
    Of,
    /// Upper bound of a limited quantity.
    Below,
    /// Lower bound of a limited quantity.
    Above,
    /// The material of a node or capacitor.
    Material,
    /// Mass of a node or capacitor.
    Mass,
    /// Volume of a node or capacitor.
    Volume,
    /// Density of a material.
    Density,
    /// Specific heat capacity of a material.
    SpecificHeat,
    /// Thermal conductivity of a material.
    Conductivity,
    /// Thermal conductivity of a material along its axis: across layers, along wires.
    AxialConductivity,
    /// Share of the conductor in a winding.
    Fill,
    /// Share of the enamel in a winding.
    EnamelFill,
    /// Fluid of a stream.
    Fluid,
    /// Temperature at which a material begins to melt.
    Solidus,
    /// Temperature at which a material is molten.
    Liquidus,
    /// Latent heat of melting of a material.
    LatentHeat,
    /// Period of a signal.
    Period,
    /// Temperature that a control senses.
    Sense,
    /// Threshold above which a cooling control switches on.
    OnAbove,
    /// Threshold below which a cooling control switches off.
    OffBelow,
    /// Threshold below which a heating control switches on.
    OnBelow,
    /// Threshold above which a heating control switches off.
    OffAbove,
    /// Minimum time that a control keeps its state after a switch.
    MinDwell,
    /// Lengths of a grid.
    Size,
    /// Angle of a sector of a round grid.
    Sector,
    /// Number of cells of a grid along each axis.
    Cells,
    /// Characteristic length of a node.
    CharacteristicLength,
    /// Value of a state at the start.
    Start,
    /// Rate of change of a state.
    Rate,
    /// Expression whose zero determines a state.
    Balance,
    /// Value of a sampled state from the next sample on.
    Next,
    /// Time between samples of a state.
    Every,
    /// Least value of a state.
    Least,
    /// Greatest value of a state.
    Most,
    /// Usual size of a state.
    UsualSize,
    /// Content of a pipe.
    PipeContent,
    /// Place of a face on another one.
    Offset,
    /// Middle of a patch of a face.
    Centre,
    /// Radius of a circle.
    Radius,
}

/// A field of a law; those of one key are one field, whatever the law.
#[derive(Clone, Copy, Debug)]
pub struct LawField {
    law: Formula,
    position: u8,
}

impl LawField {
    /// The field of this key of any law.
    pub fn any(key: &str) -> Option<Self> {
        // needed for each value of each path, so sorted once
        static FIELDS: LazyLock<Vec<(&str, LawField)>> = LazyLock::new(LawField::by_key);
        let found = FIELDS.binary_search_by_key(&key, |(key, _)| key).ok()?;
        Some(FIELDS[found].1)
    }

    /// The first field of each key, in the order of the keys.
    fn by_key() -> Vec<(&'static str, Self)> {
        let of = |law: &Formula| {
            let (law, fields) = (*law, law.declaration().fields);
            (0..).zip(fields).map(move |(position, field)| (field.key, Self { law, position }))
        };
        let mut fields: Vec<_> = Formula::ALL.iter().flat_map(of).collect();
        fields.sort_by_key(|(key, _)| *key);
        fields.dedup_by_key(|(key, _)| *key);
        fields
    }
}

impl std::ops::Deref for LawField {
    type Target = lptn_laws::FieldDeclaration;

    fn deref(&self) -> &Self::Target {
        &self.law.declaration().fields[usize::from(self.position)]
    }
}

impl PartialEq for LawField {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl Eq for LawField {}

impl PartialOrd for LawField {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for LawField {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.key.cmp(other.key)
    }
}

impl std::hash::Hash for LawField {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.key.hash(state);
    }
}

impl Field {
    /// The given heat of a source.
    pub const POWER: Self = Self::Law(LawField { law: Formula::Given, position: 0 });

    /// The field of a law at this position.
    pub(crate) fn law(law: Formula, position: usize) -> Self {
        Self::Law(LawField { law, position: position as u8 })
    }

    /// The field of this key of any law.
    pub fn of_law(key: &str) -> Option<Self> {
        LawField::any(key).map(Self::Law)
    }

    /// The key of this field in a netlist.
    pub fn key(self) -> &'static str {
        match self {
            Self::Law(field) => field.key,
            Self::Name => "name",
            Self::Value => "value",
            Self::Capacity => "C",
            Self::Initial => "T0",
            Self::Temperature => "T",
            Self::From => "from",
            Self::To => "to",
            Self::Into => "into",
            Self::Of => "of",
            Self::Below => "below",
            Self::Above => "above",
            Self::Material => "material",
            Self::Mass => "mass",
            Self::Volume => "volume",
            Self::Density => "density",
            Self::SpecificHeat => "cp",
            Self::Conductivity => "k",
            Self::AxialConductivity => "k_through",
            Self::Fill => "fill",
            Self::EnamelFill => "enamel_fill",
            Self::Fluid => "fluid",
            Self::Solidus => "solidus",
            Self::Liquidus => "liquidus",
            Self::LatentHeat => "latent_heat",
            Self::Period => "period",
            Self::Sense => "sense",
            Self::OnAbove => "on_above",
            Self::OffBelow => "off_below",
            Self::OnBelow => "on_below",
            Self::OffAbove => "off_above",
            Self::MinDwell => "min_dwell",
            Self::Size => "size",
            Self::Sector => "angle",
            Self::Cells => "cells",
            Self::CharacteristicLength => "L_char",
            Self::Start => "start",
            Self::Rate => "rate",
            Self::Balance => "balance",
            Self::Next => "next",
            Self::Every => "every",
            Self::Least => "min",
            Self::Most => "max",
            Self::UsualSize => "size",
            Self::PipeContent => "content",
            Self::Offset => "offset",
            Self::Centre => "centre",
            Self::Radius => "radius",
        }
    }
}
