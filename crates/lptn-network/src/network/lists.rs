//! The parts of a network, list by list.

use lptn_units::TableSymbol;

use crate::id::{
    BoundaryId, CapacitorId, ConductorId, ControlId, FacePathId, FluidId, GridId, LimitId,
    MaterialId, NodeId, ParameterId, ReportId, SignalId, SourceId, StateId, SwitchId, TableId,
    ValueId,
};
use crate::network::Network;
use crate::parts::control::Control;
use crate::parts::element::{Boundary, Capacitor, Conductor, Node, Parameter, Source};
use crate::parts::grid::{FacePath, Grid};
use crate::parts::named_value::NamedValue;
use crate::parts::result::{Limit, Report};
use crate::parts::signal::Signal;
use crate::parts::state::State;
use crate::parts::substance::{Fluid, Material};
use crate::parts::switch::Switch;

/// For each kind its list and its ids, in the order of addition.
macro_rules! lists {
    ($($doc:literal $list:ident: $Of:ty, $ids:ident: $Id:ident;)*) => {
        impl Network {$(
            #[doc = concat!("The ", $doc, ".")]
            pub fn $list(&self) -> &[$Of] {
                &self.parts.$list
            }

            #[doc = concat!("Ids of the ", $doc, ".")]
            pub fn $ids(&self) -> impl ExactSizeIterator<Item = $Id> + use<> {
                (0..self.parts.$list.len()).map($Id::from_len)
            }
        )*}
    };
}

lists! {
    "parameters; a parameter uses only those before it"
        parameters: Parameter, parameter_ids: ParameterId;
    "nodes" nodes: Node, node_ids: NodeId;
    "boundaries" boundaries: Boundary, boundary_ids: BoundaryId;
    "capacitors" capacitors: Capacitor, capacitor_ids: CapacitorId;
    "conductors" conductors: Conductor, conductor_ids: ConductorId;
    "sources" sources: Source, source_ids: SourceId;
    "limits" limits: Limit, limit_ids: LimitId;
    "reports" reports: Report, report_ids: ReportId;
    "controls" controls: Control, control_ids: ControlId;
    "comparisons of temperatures whose truth is fixed between events"
        switches: Switch, switch_ids: SwitchId;
    "materials" materials: Material, material_ids: MaterialId;
    "fluids" fluids: Fluid, fluid_ids: FluidId;
    "grids" grids: Grid, grid_ids: GridId;
    "paths that end at faces of grids" face_paths: FacePath, face_path_ids: FacePathId;
    "states of one's own" states: State, state_ids: StateId;
    "named values" named_values: NamedValue, value_ids: ValueId;
}

impl Network {
    /// The signals; one that is an expression uses only those before it.
    pub fn signals(&self) -> &[Signal] {
        self.parts.layout.signals()
    }

    /// Ids of the signals.
    pub fn signal_ids(&self) -> impl ExactSizeIterator<Item = SignalId> + use<> {
        (0..self.signals().len()).map(SignalId::from_len)
    }

    /// The tables with their names.
    pub fn tables(&self) -> impl Iterator<Item = (&str, &TableSymbol)> {
        self.parts.tables.iter().map(|(name, table)| (name.as_str(), table))
    }

    /// Ids of the tables.
    pub fn table_ids(&self) -> impl ExactSizeIterator<Item = TableId> + use<> {
        (0..self.parts.tables.len()).map(TableId::from_len)
    }
}
