//! Numbers over time of a candidate.

use lptn_network::Network;
use lptn_solve::ReportSeen;
use lptn_units::Type;

/// The number of a report.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateReport {
    /// The name of the report in its network.
    pub name: String,
    /// The type of its value.
    pub ty: Type,
    /// Its value in SI units, over the run, else over the settled cycle, else in steady state; NaN
    /// if it has none there.
    pub value: f64,
}

/// The numbers over time of a network by name, in its order.
pub(crate) fn named(network: &Network, found: &[ReportSeen]) -> Vec<CandidateReport> {
    let one = |found: &ReportSeen| {
        let report = &network.reports()[found.report.index()];
        CandidateReport { name: report.name.clone(), ty: report.ty, value: found.value }
    };
    found.iter().map(one).collect()
}
