//! Gradients of results by parameters, for optimisers.

use std::sync::Arc;

use lptn::{
    Failure, Gradients, Input, LimitId, Listener as _, Problem, Proceed, Progress, SweepAsked,
    SweepQuestion, Unit, tolerance,
};
use pyo3::prelude::*;

use crate::asking::{failed, raised_by};
use crate::netlist::Netlist;
use crate::trouble::Trouble;
use crate::watching::Hearing;

/// Values, and for each its derivatives.
type Found = (Vec<f64>, Vec<Vec<f64>>);

/// For each quantity its values over time, and for each parameter its derivatives over time.
type Series = Vec<(Vec<f64>, Vec<Vec<f64>>)>;

/// The results of a study as functions of its parameters.
#[pyclass(frozen, module = "lptn._lptn")]
pub(crate) struct Gradient {
    asked: SweepAsked,
    reports: usize,
    limits: Vec<LimitId>,
    parameters: Vec<Unit>,
    results: Vec<Unit>,
}

fn limit(asked: &SweepAsked, name: &str) -> PyResult<(LimitId, Unit)> {
    let network = asked.task().network();
    let mut all = network.limit_ids().zip(network.limits());
    let Some((id, limit)) = all.find(|(_, limit)| limit.name == name) else {
        let names: Vec<&str> = network.limits().iter().map(|limit| limit.name.as_str()).collect();
        let message = format!("there is no limit `{name}`; the limits are: {}", names.join(", "));
        return Err(Trouble::of_value(message).into());
    };
    let ty = limit.margin_type();
    Ok((id, Unit { text: ty.dimension.si_unit(), scale: 1.0, offset: 0.0, ty }))
}

/// Computes while Python hears the progress and may interrupt.
fn heard<T: Send, E: Problem>(
    py: Python<'_>,
    work: impl FnOnce(&dyn Fn(Progress) -> Proceed) -> Result<T, E> + Send,
) -> PyResult<T> {
    let hearing = Hearing::default();
    let asked = || {
        let found = work(&|progress| hearing.progress(progress));
        found.map_err(|error| Failure::of(&error).into())
    };
    hearing.watch(py, asked).map_err(|trouble| raised_by(py, trouble, &hearing))
}

#[pymethods]
impl Gradient {
    /// The first reports of the study of this name, and the margins of these limits; over a run with
    /// this stop and tolerance, if they are given.
    #[new]
    fn new(
        netlist: &Netlist,
        study: (String, usize),
        margins: Vec<String>,
        over: (Option<String>, Option<String>),
    ) -> PyResult<Self> {
        let (study, reports) = study;
        let (stop, within) = over;
        let mut input = Input::clone(netlist.loaded.usual());
        input.set_times(stop.as_deref(), None).map_err(failed)?;
        let within = within.as_deref().map(tolerance).transpose().map_err(failed)?;
        if let (Some(run), Some(within)) = (&mut input.netlist.run, within) {
            run.tolerance = within;
        }
        let question = SweepQuestion { name: Some(study), ..SweepQuestion::default() };
        let asked = question.of(Arc::new(input)).map_err(failed)?;
        let limits: PyResult<Vec<_>> = margins.iter().map(|name| limit(&asked, name)).collect();
        let (limits, units): (Vec<LimitId>, Vec<Unit>) = limits?.into_iter().unzip();
        let axes = asked.task().cases().parameters().len();
        let parameters = asked.columns[..axes].iter().map(|column| column.unit.clone()).collect();
        let results = &asked.columns[axes..axes + reports];
        let results = results.iter().map(|column| column.unit.clone()).chain(units).collect();
        Ok(Self { asked, reports, limits, parameters, results })
    }

    /// The own values of the parameters, in their units.
    fn own(&self) -> Vec<f64> {
        let network = self.asked.task().network();
        let values = self.asked.task().cases().parameters();
        values.zip(&self.parameters).map(|(id, u)| u.from_si(network.parameter_value(id))).collect()
    }

    /// The units of the parameters, and of the results.
    fn units(&self) -> (Vec<String>, Vec<String>) {
        let texts = |units: &[Unit]| units.iter().map(|unit| unit.text.clone()).collect();
        (texts(&self.parameters), texts(&self.results))
    }

    /// The values and their derivatives for these values of the parameters, all in their units.
    fn at(&self, py: Python<'_>, values: Vec<f64>) -> PyResult<Found> {
        let values = self.si(&values)?;
        let asked = (self.reports, &self.limits[..]);
        let found = heard(py, |observer| self.asked.task().gradients(&values, asked, observer))?;
        Ok(self.shown(&found))
    }

    /// The quantities of the reports and their derivatives at these times in s, ascending.
    fn series(&self, py: Python<'_>, values: Vec<f64>, times: Vec<f64>) -> PyResult<Series> {
        let values = self.si(&values)?;
        let (task, asked) = (self.asked.task(), (self.reports, &times[..]));
        let found = heard(py, |observer| task.gradient_series(&values, asked, observer))?;
        let shown = found.into_iter().zip(&self.results).map(|(one, of)| {
            let slopes = one.slopes.into_iter().zip(&self.parameters).map(|(slopes, by)| {
                slopes.into_iter().map(|slope| slope * by.scale / of.scale).collect()
            });
            (one.values.into_iter().map(|value| of.from_si(value)).collect(), slopes.collect())
        });
        Ok(shown.collect())
    }
}

impl Gradient {
    /// Values of the parameters in SI units.
    fn si(&self, values: &[f64]) -> PyResult<Vec<f64>> {
        if values.len() != self.parameters.len() {
            let (needed, given) = (self.parameters.len(), values.len());
            let message = format!("the gradient has {needed} parameters, and got {given} values");
            return Err(Trouble::of_value(message).into());
        }
        let units = values.iter().zip(&self.parameters);
        Ok(units.map(|(value, unit)| (value + unit.offset) * unit.scale).collect())
    }

    fn shown(&self, found: &Gradients) -> Found {
        let units = || found.values.iter().zip(&self.results);
        let values = units().map(|(value, unit)| unit.from_si(*value)).collect();
        let row = |(slopes, of): (&Vec<f64>, &Unit)| {
            let by = slopes.iter().zip(&self.parameters);
            by.map(|(slope, by)| slope * by.scale / of.scale).collect()
        };
        (values, found.slopes.iter().zip(&self.results).map(row).collect())
    }
}
