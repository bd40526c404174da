//! Quantities that can be columns of the results.

use lptn_network::{
    BoundaryId, ConductorId, ControlId, GridValue, HeatOf, Item, LimitId, Network, NodeId,
    ReportId, SignalId, SourceId, StateId,
};
use lptn_units::{Type, Unit};

/// One quantity of a network that can be a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Node(NodeId),
    /// A temperature of a grid as a whole.
    Grid(GridValue),
    BoundaryTemperature(BoundaryId),
    Heat(HeatOf),
    State(StateId),
    Signal(SignalId),
    Control(ControlId),
    Report(ReportId),
    /// A side of a limit, 0 or 1; never a column.
    Side(LimitId, usize),
}

impl Quantity {
    /// All of a network except the inside of grids: temperatures of nodes, grids and boundaries,
    /// heat flows of paths, sources and boundaries, signals, controls, reports.
    pub(crate) fn all(network: &Network) -> impl Iterator<Item = Self> {
        let nodes = network.outer_nodes().map(Self::Node);
        let is_column = |id: &ReportId| network.reports()[id.index()].over_time.is_none();
        let paths = network.outer_conductors().flat_map(|id| of_path(network, id));
        let joints = network.shared_face_paths().map(HeatOf::FacePath);
        nodes
            .chain(network.grid_values().map(Self::Grid))
            .chain(network.boundary_ids().map(Self::BoundaryTemperature))
            .chain(paths.chain(joints).map(Self::Heat))
            .chain(network.heat_sources().flat_map(|id| of_source(network, id)).map(Self::Heat))
            .chain(network.boundary_ids().map(|id| Self::Heat(HeatOf::Boundary(id))))
            .chain(network.state_ids().map(Self::State))
            .chain(network.signal_ids().map(Self::Signal))
            .chain(network.control_ids().map(Self::Control))
            .chain(network.report_ids().filter(is_column).map(Self::Report))
    }

    /// The inside of grids: temperatures of cells and surfaces, heat flows of their paths, free
    /// faces. There may be hundreds of thousands.
    pub(crate) fn inner(network: &Network) -> impl Iterator<Item = Self> {
        let nodes = network.node_ids().filter(|id| network.whole(Item::Node(*id)).is_some());
        let paths =
            network.conductor_ids().filter(|id| network.whole(Item::Conductor(*id)).is_some());
        let paths = paths.flat_map(|id| of_path(network, id)).map(Self::Heat);
        nodes.map(Self::Node).chain(network.idle_grid_values().map(Self::Grid)).chain(paths)
    }

    /// A key that sorts quantities as [`Quantity::all`] does, followed by those of
    /// [`Quantity::inner`].
    pub(crate) fn order(self, network: &Network) -> (bool, u8, usize, u8) {
        let inner = network.whole(self.item()).is_some();
        let (kind, index, end) = match self {
            Self::Node(id) => (0, id.index(), 0),
            Self::Grid(value) => (1, value.grid().index(), 0),
            Self::BoundaryTemperature(id) => (2, id.index(), 0),
            Self::Heat(HeatOf::Conductor(id) | HeatOf::ReceivedFrom(id)) => (3, id.index(), 0),
            Self::Heat(HeatOf::ReceivedTo(id)) => (3, id.index(), 1),
            Self::Heat(told @ HeatOf::Told(item, _)) => {
                let (kind, index) = match item {
                    Item::Source(id) => (5, id.index()),
                    Item::Conductor(id) => (3, id.index()),
                    _ => (3, usize::MAX),
                };
                let place = network.told_of(item).position(|of| of == told).unwrap_or(0);
                (kind, index, u8::try_from(2 + place).unwrap_or(u8::MAX))
            }
            Self::Heat(HeatOf::FacePath(id)) => (4, id.index(), 0),
            Self::Heat(HeatOf::Source(id)) => (5, id.index(), 0),
            Self::Heat(HeatOf::Boundary(id)) => (6, id.index(), 0),
            Self::State(id) => (7, id.index(), 0),
            Self::Signal(id) => (8, id.index(), 0),
            Self::Control(id) => (9, id.index(), 0),
            Self::Report(id) => (10, id.index(), 0),
            Self::Side(id, side) => (11, id.index(), u8::from(side > 0)),
        };
        (inner, kind, index, end)
    }

    /// The quantity of this name, without a search through all; not for signals and reports.
    pub(crate) fn named(network: &Network, name: &str) -> Option<Self> {
        let item = network.item(name.rsplit_once('.')?.0).ok()?;
        let all = match item {
            Item::Node(id) => vec![Self::Node(id)],
            Item::Boundary(id) => {
                vec![Self::BoundaryTemperature(id), Self::Heat(HeatOf::Boundary(id))]
            }
            Item::Conductor(id) => of_path(network, id).map(Self::Heat).collect(),
            Item::Source(id) => of_source(network, id).map(Self::Heat).collect(),
            _ => Vec::new(),
        };
        all.into_iter().find(|quantity| quantity.name(network) == name)
    }

    pub(crate) fn name(self, network: &Network) -> String {
        match self {
            Self::Node(id) => format!("{}.T", network.nodes()[id.index()].name),
            Self::Grid(value) => value.name(network),
            Self::BoundaryTemperature(id) => format!("{}.T", network.boundaries()[id.index()].name),
            Self::Heat(heat) => heat.name(network),
            Self::State(id) => network.states()[id.index()].name.clone(),
            Self::Signal(id) => network.signals()[id.index()].name.clone(),
            Self::Control(id) => network.controls()[id.index()].name.clone(),
            Self::Report(id) => network.reports()[id.index()].name.clone(),
            Self::Side(id, _) => network.limits()[id.index()].name.clone(),
        }
    }

    /// The item of the quantity.
    pub(crate) fn item(self) -> Item {
        match self {
            Self::Node(id) => Item::Node(id),
            Self::BoundaryTemperature(id) => Item::Boundary(id),
            Self::Heat(heat) => heat.item(),
            Self::State(id) => Item::State(id),
            Self::Signal(id) => Item::Signal(id),
            Self::Report(id) => Item::Report(id),
            Self::Side(id, _) => Item::Limit(id),
            Self::Control(id) => Item::Control(id),
            Self::Grid(value) => Item::Grid(value.grid()),
        }
    }

    pub(crate) fn ty(self, network: &Network) -> Type {
        match self {
            Self::Node(_) | Self::Grid(_) | Self::BoundaryTemperature(_) => {
                Type::ABSOLUTE_TEMPERATURE
            }
            Self::Heat(heat) => heat.ty(network),
            Self::State(id) => network.states()[id.index()].ty,
            Self::Signal(id) => network.signals()[id.index()].ty,
            Self::Control(_) => Type::SCALAR,
            Self::Report(id) => network.reports()[id.index()].type_of_moments(),
            Self::Side(id, side) => network.limit_side_type((id, side)),
        }
    }

    /// True if it is not a recorded temperature, and is read as the run reaches a row.
    pub(crate) fn needs_all(self) -> bool {
        !matches!(
            self,
            Self::Node(_) | Self::BoundaryTemperature(_) | Self::Signal(_) | Self::Control(_)
        )
    }
}

/// The heat flows of a path, then the further results of its law.
fn of_path(network: &Network, id: ConductorId) -> impl Iterator<Item = HeatOf> {
    network.heats_of(id).into_iter().chain(network.told_of(Item::Conductor(id)))
}

/// The heat of a source, then the further results of its law.
fn of_source(network: &Network, id: SourceId) -> impl Iterator<Item = HeatOf> {
    [HeatOf::Source(id)].into_iter().chain(network.told_of(Item::Source(id)))
}

/// The unit in which a quantity is shown: that of a signal that is given in one, else by its type.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shown {
    ty: Type,
    own: Option<Unit>,
}

impl Shown {
    pub(crate) fn of(quantity: Quantity, network: &Network) -> Self {
        let own = match quantity {
            Quantity::State(id) => network.states()[id.index()].unit.clone(),
            Quantity::Signal(id) => network.signals()[id.index()].unit.clone(),
            _ => None,
        };
        Self { ty: quantity.ty(network), own }
    }

    pub(crate) fn of_type(ty: Type) -> Self {
        Self { ty, own: None }
    }

    /// The unit: `temperature` for points on the scale, else its own, else that of a difference of
    /// temperatures, else SI; `1` for a number.
    pub(crate) fn unit(&self, temperature: &Unit) -> String {
        match &self.own {
            Some(own) if !self.ty.absolute => own.text.clone(),
            _ => temperature.shown(self.ty).text,
        }
    }

    /// True for points on the scale of temperatures.
    pub(crate) fn is_absolute(&self) -> bool {
        self.ty.absolute
    }

    /// A value in that unit.
    pub(crate) fn value(&self, si: f64, temperature: &Unit) -> f64 {
        match &self.own {
            Some(own) if !self.ty.absolute => own.from_si(si),
            _ => temperature.show(si, self.ty),
        }
    }
}
