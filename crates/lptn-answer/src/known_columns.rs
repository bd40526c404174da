//! Names and units of columns, which questions with other parameters of one network share.

use std::sync::{Arc, Mutex, PoisonError};

use lptn_netlist::{Netlist, SourceMap};
use lptn_solve::{Selection, SteadyColumns};
use lptn_units::Unit;

/// All columns of the steady states of a netlist, from the last question for them. Those of
/// another network, or with another unit, are made again.
#[derive(Clone, Debug, Default)]
pub struct KnownColumns(Arc<Mutex<Option<Columns>>>);

#[derive(Clone, Debug)]
struct Columns {
    /// It says which parts are shown.
    map: Arc<SourceMap>,
    columns: Arc<SteadyColumns>,
}

impl KnownColumns {
    /// All columns of a netlist, temperatures in `unit`; `all` selects them.
    pub fn of(
        &self,
        netlist: &Netlist,
        unit: &Unit,
        all: impl FnOnce() -> Selection,
    ) -> Arc<SteadyColumns> {
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (network, map) = (&netlist.network, &netlist.source_map);
        let suits =
            |known: &&Columns| Arc::ptr_eq(&known.map, map) && known.columns.suit(network, unit);
        if let Some(known) = last.as_ref().filter(suits) {
            return Arc::clone(&known.columns);
        }
        let columns = Arc::new(SteadyColumns::of(network, &all(), unit));
        *last = Some(Columns { map: Arc::clone(map), columns: Arc::clone(&columns) });
        columns
    }
}
