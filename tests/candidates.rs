//! The shipped candidates: they parse without a warning, and run as another program says.

use crate::support;

use lptn::prelude::*;
use lptn_netlist::Netlist;
use lptn_study::{Candidate, SortKey, order};

fn read(name: &str) -> Netlist {
    let path = support::networks().join("candidates").join(name);
    lptn::read(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// Peaks of steel in degC after 90 min and the times at which steel passes 100 degC and aluminium
/// 80 degC, from `scipy.linalg.expm` of the two-node matrix and `scipy.optimize.brentq`.
const EXPECTED: [(&str, f64, Option<f64>, Option<f64>); 3] = [
    ("bare.toml", 102.798_243_341_668_3, Some(2_502.858_215_563_338), Some(909.529_869_133_898_4)),
    ("finned.toml", 78.158_799_914_242_3, None, None),
    ("fan.toml", 71.887_442_102_208_3, None, None),
];

#[test]
fn candidates_run_as_the_matrix_exponential_says() {
    for (name, peak, lubricant, touch) in EXPECTED {
        let netlist = read(name);
        assert!(netlist.warnings.is_empty(), "{name}: {:?}", netlist.warnings);
        assert!(netlist.network.title().is_some(), "{name} has no title");
        let system = ThermalSystem::assemble(&netlist.network).expect("it can be assembled");
        let solution = support::transient(&netlist).solve(&system).expect("it runs");
        assert!(solution.ledger().closes(), "{name}");
        let steel = netlist.network.node("steel").expect("steel");
        let last =
            solution.temperature(steel).and_then(|t| t.last().copied()).expect("a temperature");
        // ten times the tolerance of 1e-5 K
        assert!((last - 273.15 - peak).abs() < 1e-4, "{name}: {last}");
        for (seen, expected) in solution.limits().iter().zip([lubricant, touch]) {
            match (seen.broken_at, expected) {
                // 1e-4 K at a slope of at least 4 mK/s
                (Some(found), Some(expected)) => {
                    assert!((found - expected).abs() < 0.025, "{name}: {found}")
                }
                (found, expected) => assert_eq!(found, expected, "{name}"),
            }
        }
    }
}

#[test]
fn there_are_no_other_candidates() {
    let folder = std::fs::read_dir(support::networks().join("candidates")).expect("the folder");
    assert_eq!(folder.count(), EXPECTED.len());
}

/// The same numbers by a comparison in code.
#[test]
fn a_program_can_compare_them() {
    let candidates = EXPECTED.map(|(name, peak, lubricant, touch)| {
        let netlist = read(name);
        let system = ThermalSystem::assemble(&netlist.network).expect("it can be assembled");
        let candidate = Candidate::evaluate(&system, netlist.run.as_ref()).expect("it runs");
        assert_eq!(candidate.hottest.as_deref(), Some("steel"));
        assert!(
            (candidate.peak.unwrap().temperature - 273.15 - peak).abs() < 1e-4,
            "{name}: {:?}",
            candidate.peak
        );
        let broken: Vec<bool> = candidate.limits.iter().map(|limit| limit.broken()).collect();
        assert_eq!(broken, [lubricant.is_some(), touch.is_some()], "{name}");
        candidate
    });
    // the coolest first
    assert_eq!(order(&candidates.each_ref().map(Some), SortKey::Peak), [2, 1, 0]);
}
