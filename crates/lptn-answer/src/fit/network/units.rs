//! The units in which columns of records are shown.

use lptn_fit::network::{ColumnMisfit, MeasuredColumn, NetworkFitTask};
use lptn_units::{Type, Unit};

use super::FitNetworkAnswer;
use crate::words::difference;

/// Unit in which values of one type are shown: that of the netlist for temperatures, else SI.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    pub(super) unit: Unit,
    /// The unit of differences of two values.
    pub(super) of_differences: String,
}

impl Shown {
    pub(super) fn of(ty: Type, temperature: &Unit) -> Self {
        if ty.absolute {
            let of_differences = difference(temperature).to_owned();
            return Self { unit: temperature.clone(), of_differences };
        }
        let text = ty.dimension.si_unit();
        let unit = Unit { text: text.clone(), scale: 1.0, offset: 0.0, ty };
        Self { unit, of_differences: text }
    }
}

impl FitNetworkAnswer {
    /// The column that a misfit belongs to.
    pub(super) fn column(&self, misfit: &ColumnMisfit) -> &MeasuredColumn {
        &self.task.runs[misfit.run].columns[misfit.column]
    }

    /// The SI unit of a misfit.
    pub(super) fn unit_of(&self, misfit: &ColumnMisfit) -> String {
        self.column(misfit).ty.dimension.si_unit()
    }
}

/// The SI unit that the misfits of all columns have in common.
/// It is 1 if they are divided by standard deviations.
pub(in crate::fit) fn common(task: &NetworkFitTask) -> String {
    task.unit().unwrap_or(Type::SCALAR).dimension.si_unit()
}
