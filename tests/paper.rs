//! What `networks/paper_bed.toml` says of itself: the two rises and the time constant that the
//! paper prints for 7000 rpm.

use crate::support;

use lptn::prelude::*;
use lptn_reduce::{ExponentialFit, fit_exponential};
use support::{close, column, shipped, transient};

/// Start of every node in degC.
const START: f64 = 25.5;

/// The run's table with a row every 0.2 s, as the paper's records have.
fn record() -> Table {
    let (netlist, system) = shipped("paper_bed.toml");
    let mut transient = transient(&netlist).tolerance(1e-7);
    transient.output = OutputTimes::Every(0.2);
    let solution = transient.solve(&system).expect("it runs");
    let celsius = lptn_units::Unit::parse("degC").expect("a unit");
    Table::of_solution(&solution, &Selection::all(&netlist.network), &celsius)
}

fn fitted(table: &Table, name: &str) -> ExponentialFit {
    fit_exponential(&column(table, "time"), &column(table, name)).expect("a curve")
}

/// From SciPy 1.17.1: `numpy.linalg.eigh` of the three nodes, then `scipy.optimize.least_squares`
/// of one exponential over 7501 samples; rise over 25.5 degC in K, time constant in s, mean of the
/// bed over 25.5 degC in K.
const STEEL: (f64, f64) = (67.186_155, 809.901_19);
const ALUMINIUM: (f64, f64) = (65.582_849, 813.440_53);
const BED: f64 = 8.405_449;

#[test]
fn the_fits_are_those_of_an_independent_program() {
    let table = record();
    for (name, (rise, tau)) in [("steel.T", STEEL), ("aluminium.T", ALUMINIUM)] {
        let fit = fitted(&table, name);
        close(fit.settled - START, rise, 1e-5);
        close(fit.tau, tau, 1e-4);
    }
    let bed = column(&table, "bed.T");
    close(bed.iter().sum::<f64>() / bed.len() as f64 - START, BED, 1e-5);
}

/// Figure 6: 92.7 - 25.5 K and 13.5 ± 0.1 min; Figure 7: 0.0084 K/rpm x 7000 rpm over the mean of
/// the bed.
#[test]
fn both_rises_of_the_paper_come_out_of_one_record() {
    let table = record();
    let (fit, bed) = (fitted(&table, "steel.T"), column(&table, "bed.T"));
    let mean = bed.iter().sum::<f64>() / bed.len() as f64;
    close(fit.settled - START, 92.7 - 25.5, 0.05);
    close(fit.tau / 60.0, 13.5, 0.05);
    close(fit.settled - mean, 0.0084 * 7000.0, 0.05);
}
