//! What can be a column of the results.

use lptn_network::{BoundaryId, ControlId, HeatOf, Network, NodeId, ReportId, SignalId};
use lptn_units::{Dimension, Type, Unit};

/// One quantity of a network that can be a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Node(NodeId),
    BoundaryTemperature(BoundaryId),
    Heat(HeatOf),
    Signal(SignalId),
    Control(ControlId),
    Report(ReportId),
}

impl Quantity {
    /// All of a network: temperatures of nodes and boundaries, heat flows of paths, sources, and boundaries, signals,
    /// controls, reports.
    pub(crate) fn all(network: &Network) -> impl Iterator<Item = Self> {
        let nodes = network.node_ids().map(Self::Node);
        let paths = network.conductor_ids().flat_map(|id| network.heats_of(id)).map(Self::Heat);
        nodes
            .chain(network.boundary_ids().map(Self::BoundaryTemperature))
            .chain(paths)
            .chain(network.source_ids().map(|id| Self::Heat(HeatOf::Source(id))))
            .chain(network.boundary_ids().map(|id| Self::Heat(HeatOf::Boundary(id))))
            .chain(network.signal_ids().map(Self::Signal))
            .chain(network.control_ids().map(Self::Control))
            .chain(network.report_ids().map(Self::Report))
    }

    pub(crate) fn name(self, network: &Network) -> String {
        match self {
            Self::Node(id) => format!("{}.T", network.nodes()[id.index()].name),
            Self::BoundaryTemperature(id) => format!("{}.T", network.boundaries()[id.index()].name),
            Self::Heat(heat) => heat.name(network),
            Self::Signal(id) => network.signals()[id.index()].name.clone(),
            Self::Control(id) => network.controls()[id.index()].name.clone(),
            Self::Report(id) => network.reports()[id.index()].name.clone(),
        }
    }

    pub(crate) fn ty(self, network: &Network) -> Type {
        match self {
            Self::Node(_) | Self::BoundaryTemperature(_) => Type::ABSOLUTE_TEMPERATURE,
            Self::Heat(_) => Type::of(Dimension::POWER),
            Self::Signal(id) => network.signals()[id.index()].ty,
            Self::Control(_) => Type::SCALAR,
            Self::Report(id) => network.reports()[id.index()].ty,
        }
    }

    /// Whether it can be had only where the temperature of every node is known.
    pub(crate) fn needs_all(self) -> bool {
        matches!(self, Self::Heat(_) | Self::Report(_))
    }
}

/// The unit in which a value of this type is shown: `temperature` for points on the scale, else SI; `1` for a number.
pub(crate) fn unit_of(ty: Type, temperature: &Unit) -> String {
    if ty.absolute { temperature.text.clone() } else { ty.dimension.si_unit() }
}

/// A value in the unit of [`unit_of`].
pub(crate) fn shown(value: f64, ty: Type, temperature: &Unit) -> f64 {
    if ty.absolute { temperature.from_si(value) } else { value }
}
