//! What comes of a network, by name.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Netlist, parse_with};
use lptn_solve::{Column, EventKind, Selection, Solution, SteadyState, Table, Transient, Window};
use lptn_units::Unit;

use super::write::{MAIN, Texts};

/// The numbers of a run, temperatures in degC.
#[derive(Clone, Debug, Default)]
pub struct Results {
    pub times: Vec<f64>,
    pub columns: BTreeMap<String, Vec<f64>>,
    /// Times of what switched.
    pub events: Vec<f64>,
    /// The least margin of each limit.
    pub margins: BTreeMap<String, f64>,
    /// Mean, least and largest value of each window and column.
    pub windows: BTreeMap<(String, String), [f64; 3]>,
    /// The steady state at the start, where there is one.
    pub steady: BTreeMap<String, f64>,
    pub steps: u64,
}

pub fn read(texts: &Texts) -> Result<Netlist, String> {
    let mut loader = |path: &Path| {
        let text = texts.get(&path.display().to_string()).ok_or(io::ErrorKind::NotFound)?;
        Ok(text.clone().into_bytes())
    };
    parse_with(MAIN, &texts[MAIN], &mut loader).map_err(|rejected| rejected.to_string())
}

/// Runs a network.
pub fn results(texts: &Texts) -> Result<Results, String> {
    results_of(&read(texts)?)
}

pub fn results_of(netlist: &Netlist) -> Result<Results, String> {
    let network = &netlist.network;
    let system = ThermalSystem::assemble(network).map_err(|error| error.to_string())?;
    let run = netlist.run.as_ref().expect("every network has a run");
    let window = |window: &lptn_netlist::WindowSettings| Window {
        name: window.name.clone(),
        from: window.from,
        to: window.to,
        of: Selection::of(network, |item| matches!(item, lptn_network::Item::Node(_))),
    };
    let windows = run.windows.iter().map(window).collect();
    let transient = Transient { windows, ..lptn_solve::Transient::of(network, run) };
    let solution =
        transient.solve(&system).map_err(|error| format!("{}: {error}", error.code()))?;
    if !solution.ledger().closes() {
        return Err("the books do not close".into());
    }
    let mut found = of_solution(&solution);
    if let Ok(steady) = SteadyState::solve(&system, run.start) {
        let temperatures =
            network.nodes().iter().map(|node| node.name.clone()).zip(steady.state.temperatures);
        found.steady = temperatures.collect();
    }
    Ok(found)
}

/// Signals stand in the unit of their points; here they are compared in SI, temperatures in degC.
pub fn in_si(unit: &str, mut values: Vec<f64>) -> Vec<f64> {
    if let Ok(unit) = Unit::parse(unit)
        && !unit.ty.absolute
        && (unit.scale - 1.0).abs() > 0.0
    {
        values.iter_mut().for_each(|value| *value = unit.to_si(*value));
    }
    values
}

fn of_solution(solution: &Solution) -> Results {
    let network = solution.network();
    let degrees = Unit::parse("degC").expect("a unit");
    let table = Table::of_solution(solution, &Selection::all(network), &degrees);
    let in_si = |column: &Column| (column.name.clone(), in_si(&column.unit, column.values.clone()));
    let mut columns: BTreeMap<String, Vec<f64>> = table.columns()[1..].iter().map(in_si).collect();
    for (node, id) in network.nodes().iter().zip(network.node_ids()) {
        // cells of grids and imported nodes have no column of their own accord
        let values = solution.temperature(id).expect("every node is recorded");
        let values = || values.iter().map(|kelvin| kelvin - 273.15).collect();
        columns.entry(format!("{}.T", node.name)).or_insert_with(values);
    }
    let switched =
        solution.events().iter().filter(|event| !matches!(event.kind, EventKind::Limit(_)));
    let limits = network.limits();
    let mut windows = BTreeMap::new();
    for window in solution.windows() {
        for column in &window.columns {
            let key = (window.name.clone(), column.name.clone());
            windows.insert(key, [column.mean, column.min.0, column.max.0]);
        }
    }
    Results {
        times: solution.times().to_vec(),
        columns,
        events: switched.map(|event| event.time).collect(),
        margins: solution
            .limits()
            .iter()
            .map(|seen| (limits[seen.limit.index()].name.clone(), seen.margin))
            .collect(),
        windows,
        steady: BTreeMap::new(),
        steps: solution.statistics().steps,
    }
}
