//! Typed ids: dense indices that belong to one network.

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub(crate) u32);

        impl $name {
            /// Position in the network's list of this kind, from 0.
            pub fn index(self) -> usize {
                self.0 as usize
            }

            pub(crate) fn from_len(len: usize) -> Self {
                Self(u32::try_from(len).expect("a network holds fewer than 2^32 items of a kind"))
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
    JointId;
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
    Joint(JointId),
}

impl From<End> for Item {
    fn from(end: End) -> Self {
        match end {
            End::Node(id) => Self::Node(id),
            End::Boundary(id) => Self::Boundary(id),
        }
    }
}

/// A field of an item, by the word that a netlist uses for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Field {
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
    /// Thermal resistance.
    Resistance,
    /// Thermal conductance.
    Conductance,
    /// Film coefficient.
    FilmCoefficient,
    /// Area.
    Area,
    /// Heat of a source.
    Power,
    /// First end of a conductor.
    From,
    /// Second end of a conductor.
    To,
    /// Node that a source heats.
    Into,
    /// What a limit limits.
    Of,
    /// What a limited quantity has to stay below.
    Below,
    /// What a limited quantity has to stay above.
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
    /// Emissivity of a radiating exchange.
    Emissivity,
    /// View factor of a radiating exchange.
    ViewFactor,
    /// Exchange area of a radiating exchange.
    Exchange,
    /// Thickness of a slab.
    Thickness,
    /// Inner radius of a tube or hollow sphere.
    InnerRadius,
    /// Outer radius of a tube or hollow sphere.
    OuterRadius,
    /// Length of a tube or bar.
    Length,
    /// Diameter of a bar.
    Diameter,
    /// Capacity rate of a stream.
    StreamCapacity,
    /// Flow of a stream.
    Flow,
    /// Temperature at which a volume flow is measured.
    FlowTemperature,
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
    /// What a control feels.
    Sense,
    /// What a cooling control switches on above.
    OnAbove,
    /// What a cooling control switches off below.
    OffBelow,
    /// What a heating control switches on below.
    OnBelow,
    /// What a heating control switches off above.
    OffAbove,
    /// How long a control stays as it is after a switch.
    MinDwell,
    /// Lengths of a grid.
    Size,
    /// How many cells a grid has along each axis.
    Cells,
    /// Characteristic length of a node.
    CharacteristicLength,
}

impl Field {
    /// The key of this field in a netlist.
    pub fn key(self) -> &'static str {
        match self {
            Self::Name => "name",
            Self::Value => "value",
            Self::Capacity => "C",
            Self::Initial => "T0",
            Self::Temperature => "T",
            Self::Resistance => "R",
            Self::Conductance => "G",
            Self::FilmCoefficient => "h",
            Self::Area => "area",
            Self::Power => "P",
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
            Self::Emissivity => "emissivity",
            Self::ViewFactor => "view_factor",
            Self::Exchange => "Gr",
            Self::Thickness => "thickness",
            Self::InnerRadius => "r_in",
            Self::OuterRadius => "r_out",
            Self::Length => "length",
            Self::Diameter => "diameter",
            Self::StreamCapacity => "mcp",
            Self::Flow => "flow",
            Self::FlowTemperature => "flow_T",
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
            Self::Cells => "cells",
            Self::CharacteristicLength => "L_char",
        }
    }
}
