//! The columns of steady states of one network: names and units do not depend on parameters, so
//! they are made once for all of them.

use lptn_network::{InputError, Network};
use lptn_units::Unit;

use crate::quantity::{Quantity, Shown};
use crate::selection::Selection;
use crate::snapshot::Snapshot;
use crate::steady::SteadyState;
use crate::table::{Column, Table};

/// A column: its name and unit, and the conversion of its values.
#[derive(Clone, Debug)]
struct Head {
    quantity: Quantity,
    shown: Shown,
    name: String,
    unit: String,
}

/// The columns of steady states of a network with any parameters.
#[derive(Clone, Debug)]
pub struct SteadyColumns {
    network: Network,
    unit: Unit,
    heads: Vec<Head>,
}

impl SteadyColumns {
    /// The selected columns, temperatures in `unit`.
    pub fn of(network: &Network, selection: &Selection, unit: &Unit) -> Self {
        let head = |&quantity: &Quantity| {
            let shown = Shown::of(quantity, network);
            let unit = shown.unit(unit);
            Head { quantity, shown, name: quantity.name(network), unit }
        };
        let heads = selection.quantities().iter().map(head).collect();
        Self { network: network.clone(), unit: unit.clone(), heads }
    }

    /// True if they are those of this network too, with temperatures in `unit`.
    pub fn suit(&self, network: &Network, unit: &Unit) -> bool {
        network.shares_parts(&self.network) && *unit == self.unit
    }

    /// A table of one row: the columns, then the reports over time. The network has the parameters
    /// of the steady state.
    ///
    /// # Errors
    /// [`InputError`] if a report cannot be evaluated.
    pub fn table(&self, network: &Network, steady: &SteadyState) -> Result<Table, InputError> {
        let columns = self.now(network, steady)?;
        let numbers = steady.reports_over_time(network)?;
        let numbers = numbers.iter().map(|seen| {
            let report = &network.reports()[seen.report.index()];
            let shown = Shown::of_type(report.ty);
            let (unit, value) = (shown.unit(&self.unit), shown.value(seen.value, &self.unit));
            Column { name: report.name.clone(), unit, values: vec![value] }
        });
        Ok(Table::of_columns(columns.into_iter().chain(numbers).collect()))
    }

    /// The columns at one instant.
    fn now(&self, network: &Network, at: &Snapshot) -> Result<Vec<Column>, InputError> {
        let mut scope = at.evaluation(network);
        let mut column = |head: &Head| {
            let value = at.value(network, head.quantity, &mut scope)?;
            let values = vec![head.shown.value(value, &self.unit)];
            Ok(Column { name: head.name.clone(), unit: head.unit.clone(), values })
        };
        self.heads.iter().map(&mut column).collect()
    }
}

impl Table {
    /// The selected columns at one instant as a table of one row, temperatures in `unit`.
    ///
    /// # Errors
    /// [`InputError`] if a report cannot be evaluated.
    pub fn of_snapshot(
        network: &Network,
        at: &Snapshot,
        selection: &Selection,
        unit: &Unit,
    ) -> Result<Self, InputError> {
        let columns = SteadyColumns::of(network, selection, unit).now(network, at)?;
        Ok(Self::of_columns(columns))
    }

    /// The selected columns of a steady state and its reports over time as a table of one row,
    /// temperatures in `unit`.
    ///
    /// # Errors
    /// [`InputError`] if a report cannot be evaluated.
    pub fn of_steady(
        network: &Network,
        steady: &SteadyState,
        selection: &Selection,
        unit: &Unit,
    ) -> Result<Self, InputError> {
        SteadyColumns::of(network, selection, unit).table(network, steady)
    }
}
