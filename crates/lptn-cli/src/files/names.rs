//! The names of everything that is written into a folder of results.

pub(crate) const RESULT: &str = "result.csv";
pub(crate) const STATE: &str = "state.json";
pub(crate) const EVENTS: &str = "events.csv";
pub(crate) const WINDOWS: &str = "windows.csv";
pub(crate) const REPORTS: &str = "reports.csv";
pub(crate) const UNCERTAINTY: &str = "uncertainty.csv";
pub(crate) const RANKING: &str = "ranking.csv";
pub(crate) const RISE: &str = "figure_7_rise.csv";
pub(crate) const TIME_CONSTANT: &str = "figure_8_time_constant.csv";
pub(crate) const POWER: &str = "figure_9_power.csv";
pub(crate) const SLOPES: &str = "slopes.csv";
pub(crate) const LAWS: &str = "laws.csv";
pub(crate) const RESIDUALS: &str = "residuals.csv";
pub(crate) const FIT: &str = "fit.json";
pub(crate) const INFERRED: &str = "inferred.csv";
pub(crate) const INFER: &str = "infer.json";
pub(crate) const CANDIDATES: &str = "candidates.csv";
pub(crate) const UNSEEN: &str = "unseen.csv";
pub(crate) const CHOICE: &str = "choice.json";
pub(crate) const POSTERIOR: &str = "posterior.json";
pub(crate) const SWEEP: &str = "sweep.csv";
pub(crate) const MANIFEST: &str = "manifest.json";

/// The unfinished rows of a sweep, and the sweep that they belong to.
pub(crate) const UNFINISHED: &str = "sweep.csv.part";
pub(crate) const BEGUN: &str = "sweep.json";

/// The record of results that are whole and about to take their places.
pub(super) const COMMIT: &str = ".commit.json";

/// The file whose lock shows that a process writes here.
pub(super) const LOCK: &str = ".lptn.lock";

const RESULTS: [&str; 23] = [
    RESULT,
    STATE,
    EVENTS,
    WINDOWS,
    REPORTS,
    UNCERTAINTY,
    RANKING,
    RISE,
    TIME_CONSTANT,
    POWER,
    SLOPES,
    LAWS,
    RESIDUALS,
    FIT,
    INFERRED,
    INFER,
    CANDIDATES,
    UNSEEN,
    CHOICE,
    POSTERIOR,
    SWEEP,
    BEGUN,
    MANIFEST,
];

/// True if a file of this name may be one of results.
pub(super) fn is_result(name: &str) -> bool {
    RESULTS.contains(&name)
}

/// Name of a file until it is whole.
pub(super) fn temporary(name: &str, process: u32) -> String {
    format!(".{name}.{process}.tmp")
}

/// True if this program gives an unfinished file this name.
/// The file may be a result, the record of results, a netlist or a picture.
pub(super) fn is_temporary(name: &str) -> bool {
    let parts = name
        .strip_prefix('.')
        .and_then(|rest| rest.strip_suffix(".tmp"))
        .and_then(|rest| rest.rsplit_once('.'));
    let Some((name, process)) = parts else { return false };
    let ends = [".toml", ".svg", ".png"].iter().any(|end| name.ends_with(end));
    let ours = is_result(name) || name == COMMIT || ends;
    ours && process.parse::<u32>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::{COMMIT, RESULT, is_temporary, temporary};

    #[test]
    fn only_our_own_temporaries_are_known_as_such() {
        for name in [RESULT, COMMIT, "motor.toml", "heat.svg"] {
            assert!(is_temporary(&temporary(name, 4_194_304)), "{name}");
        }
        for name in [
            "result.csv",
            ".result.csv.tmp",
            ".result.csv.x1.tmp",
            ".thesis.csv.12.tmp",
            ".12.tmp",
            "..tmp",
        ] {
            assert!(!is_temporary(name), "{name}");
        }
    }
}
