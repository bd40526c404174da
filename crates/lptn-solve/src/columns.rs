//! The recorded values of each row, and columns that are read as a run reaches the row, so that no
//! node has to be recorded for them.
//!
//! A network whose nodes have a length keeps all nodes if heat flows are selected, because Biot
//! numbers are judged in every row. Both ways have the same digits. A column reads its inputs as
//! rows are read again later, not from the straight line of a linear run.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::NodeId;

use crate::quantity::Quantity;
use crate::reading::Reading;
use crate::selection::RecordedNodes;
use crate::settings_error::SettingsError;

/// The most recorded values, of nodes and of columns: 4 GB each.
const MOST_VALUES: usize = 500_000_000;

/// Memory for the recorded values of all rows.
pub(crate) struct Room {
    /// The nodes, ascending.
    pub(crate) recorded: Vec<NodeId>,
    pub(crate) temperatures: Vec<f64>,
    pub(crate) columns: Columns,
}

impl Room {
    /// Allocates this number of rows.
    pub(crate) fn new(
        system: &ThermalSystem,
        record: &RecordedNodes,
        rows: usize,
    ) -> Result<Self, SettingsError> {
        let (mut recorded, quantities) = match record {
            RecordedNodes::All => (system.network().node_ids().collect(), &[][..]),
            RecordedNodes::Nodes(nodes) => (nodes.clone(), &[][..]),
            RecordedNodes::Columns { nodes, columns } => (nodes.clone(), columns.quantities()),
        };
        recorded.sort_unstable();
        recorded.dedup();
        let too_much = SettingsError::TooMuch { rows, values: recorded.len() + quantities.len() };
        let place = |width: usize| {
            let size = rows.checked_mul(width).filter(|size| *size <= MOST_VALUES)?;
            let mut values = Vec::new();
            values.try_reserve_exact(size).ok().map(|()| values)
        };
        let places = place(recorded.len()).zip(place(quantities.len()));
        let (temperatures, values) = places.ok_or(too_much)?;
        let columns = Columns { quantities: quantities.to_vec(), values };
        Ok(Self { recorded, temperatures, columns })
    }
}

/// The values of some quantities, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    quantities: Vec<Quantity>,
    values: Vec<f64>,
}

impl Columns {
    pub(crate) fn is_empty(&self) -> bool {
        self.quantities.is_empty()
    }

    /// True if any reads more than temperatures.
    pub(crate) fn ask_for_heat(&self) -> bool {
        let heat =
            |quantity: &Quantity| matches!(quantity, Quantity::Heat(_) | Quantity::Report(_));
        self.quantities.iter().any(heat)
    }

    /// Writes a row from recovered nodes; NaN for a value that cannot be computed. Inputs are read
    /// as when a row is read after the run, to the same digits.
    pub(crate) fn push(
        &mut self,
        system: &ThermalSystem,
        (reading, work): (&mut Reading<'_>, &mut Workspace),
        at: (f64, f64),
    ) {
        if self.is_empty() {
            return;
        }
        let read = system.read_exactly(work, at.0, at.1);
        let known = read.and_then(|()| reading.stand(work, at)).is_ok();
        let mut value = |&quantity: &Quantity| match known {
            true => reading.value(work, quantity).unwrap_or(f64::NAN),
            false => f64::NAN,
        };
        self.values.extend(self.quantities.iter().map(&mut value));
    }

    /// The values of one of them over the rows in SI units; `None` if it is not one of them.
    pub(crate) fn get(&self, quantity: Quantity) -> Option<impl Iterator<Item = f64> + '_> {
        let column = self.quantities.iter().position(|known| *known == quantity)?;
        Some(self.values.iter().skip(column).step_by(self.quantities.len()).copied())
    }
}
