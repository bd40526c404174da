//! Parameters of a case fitted to its record.

use std::path::Path;

use lptn::prelude::*;
use lptn_analysis::RunAnalysis;
use lptn_fit::network::{
    Measurand, MeasuredColumn, MeasuredRun, NetworkFit, NetworkFitTask, Varied, fit_network,
};
use lptn_network::End;
use lptn_solve::available_threads;
use lptn_units::{Correlations, Type};

use super::answer::Trouble;
use super::case::{Calibration, Case};
use super::network::Model;

/// Fits what the case asks for, from its initial values and without bounds.
pub fn fit(case: &Case) -> Result<NetworkFit, Trouble> {
    let Some(calibration) = &case.calibration else {
        return Err("there is nothing to calibrate".into());
    };
    let model = Model::calibrating(case)?;
    let network = model.system.network();
    let varied = |name: &str| -> Result<Varied, Trouble> {
        let parameter = network.parameter(&parameter(name))?;
        Ok(Varied { parameter, bounds: (f64::NEG_INFINITY, f64::INFINITY), prior: None })
    };
    let parameters =
        calibration.parameters.iter().map(|p| varied(&p.name)).collect::<Result<Vec<_>, _>>()?;
    let correlations = Correlations::none(parameters.len());
    let run = measured(case, calibration, &model)?;
    let threads = available_threads();
    let fit = fit_network(&NetworkFitTask {
        network: network.clone(),
        parameters,
        correlations,
        sensors: Vec::new(),
        runs: vec![run],
        more_starts: 0,
        threads,
    })?;
    match fit.not_converged {
        None => Ok(fit),
        Some(stop) => Err(format!("the fit did not converge: {}", stop.text()).into()),
    }
}

/// The name of a parameter of the case in its network.
pub fn parameter(name: &str) -> String {
    super::network::name("param", name)
}

/// The value of a fitted parameter.
pub fn value(case: &Case, fit: &NetworkFit, name: &str) -> Result<f64, Trouble> {
    let parameters = case.calibration.iter().flat_map(|calibration| &calibration.parameters);
    let found = parameters.zip(&fit.parameters).find(|(parameter, _)| parameter.name == name);
    found
        .map(|(_, fitted)| fitted.value)
        .ok_or_else(|| format!("there is no parameter `{name}`").into())
}

fn measured(case: &Case, calibration: &Calibration, model: &Model) -> Result<MeasuredRun, Trouble> {
    let table = rows(Path::new(&calibration.data))?;
    let column = |name: &str| -> Result<Vec<f64>, Trouble> {
        let place = table.0.iter().position(|header| header == name);
        let place = place.ok_or_else(|| format!("{} has no column `{name}`", calibration.data))?;
        Ok(table.1.iter().map(|row| row[place]).collect())
    };
    let observe = |observation: &super::case::Observation| -> Result<MeasuredColumn, Trouble> {
        let Some(End::Node(node)) = model.ends.get(&observation.node) else {
            return Err(format!("`{}` is not a node", observation.node).into());
        };
        let values = column(&observation.column)?.iter().map(|t| t + case.zero()).collect();
        Ok(MeasuredColumn {
            name: observation.column.clone(),
            of: Measurand::Temperatures(vec![(*node, 1.0)]),
            ty: Type::ABSOLUTE_TEMPERATURE,
            sensor: None,
            sigma: None,
            values,
        })
    };
    Ok(MeasuredRun {
        name: calibration.data.clone(),
        parameters: model.system.network().overrides(),
        signals: Vec::new(),
        initial: Vec::new(),
        settings: RunAnalysis::until(Time(1.0)),
        times: column(&calibration.time_column)?,
        columns: calibration.observations.iter().map(observe).collect::<Result<_, _>>()?,
    })
}

/// Headers and rows of a CSV file of numbers.
fn rows(path: &Path) -> Result<(Vec<String>, Vec<Vec<f64>>), Trouble> {
    let text = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut lines = text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let head = lines.next().ok_or("an empty record")?;
    let head: Vec<String> = head.split(',').map(|name| name.trim().to_owned()).collect();
    let mut rows = Vec::new();
    for line in lines {
        let row: Result<Vec<f64>, _> =
            line.split(',').map(|cell| cell.trim().parse::<f64>()).collect();
        let row = row.map_err(|e| format!("{}: `{line}`: {e}", path.display()))?;
        if row.len() != head.len() {
            return Err(format!("{}: `{line}` is not as long as the header", path.display()).into());
        }
        rows.push(row);
    }
    Ok((head, rows))
}
