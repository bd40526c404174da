//! One parameter, as small or as large as possible.

use lptn_netlist::Requirement;
use lptn_network::ParameterId;
use lptn_study::{SizeTask, Sizing, Verdict};
use lptn_units::Unit;

use super::{Asked, parameter};
use crate::failure::Failure;
use crate::listener::Listener;

/// Result of sizing a parameter.
#[derive(Debug)]
pub(super) struct Sized {
    pub(super) asked: Asked,
    /// The name of the parameter.
    pub(super) name: String,
    pub(super) parameter: ParameterId,
    /// In SI units.
    pub(super) range: (f64, f64),
    /// In which the parameter is shown.
    pub(super) unit: Unit,
    pub(super) sizing: Sizing,
}

pub(super) fn size(asked: Asked, listener: &dyn Listener) -> Result<Sized, Failure> {
    let Asked { input, study, .. } = &asked;
    let name = study.objective.text.clone();
    let parameter = parameter(input, study, &name)?;
    let unit = input.unit_of(parameter);
    let range =
        study.ranges(&input.netlist.network).ok().and_then(|ranges| Some(ranges.first()?.1));
    let range = range.unwrap_or((f64::NAN, f64::NAN));
    let goal = study.goal;
    let sizing = asked.demand(listener, |demand| {
        lptn_study::size(&SizeTask { demand, parameter, range, goal })
    })?;
    Ok(Sized { asked, name, parameter, range, unit, sizing })
}

impl Sized {
    /// The requirement that stops the parameter; `None` if the end of the range or an edge does.
    pub(super) fn binding(&self) -> Option<&Requirement> {
        let closest = self.asked.kept.requirement(self.sizing.closest);
        (!matches!(self.sizing.verdict, Verdict::BestEnd | Verdict::Edge)).then_some(closest)
    }

    pub(super) fn closest_unit(&self) -> String {
        self.asked.kept.unit(self.sizing.closest)
    }
}
