//! Noise that the columns of one record have in common, in words and as JSON.

use lptn_fit::network::SharedNoise;
use lptn_report::{differing, fixed};
use lptn_study::SiValue;
use serde_json::{Value, json};

use super::FitNetworkAnswer;

/// Note on the records whose columns have correlated noise that chance does not explain.
pub(super) fn text(answer: &FitNetworkAnswer) -> Option<String> {
    let runs = &answer.task.runs;
    let records: Vec<String> = runs.iter().map(|run| run.name.clone()).collect();
    let records = differing(&records);
    let one = |shared: &SharedNoise| {
        let correlation = fixed(shared.correlation, 2);
        if runs.len() > 1 {
            format!("{correlation} ({})", records[shared.run])
        } else {
            correlation
        }
    };
    let all: Vec<String> = answer.fit.shared_noise.iter().map(one).collect();
    (!all.is_empty()).then(|| {
        format!(
            "columns of one record share errors, correlation up to {}; the standard errors include \
             it",
            all.join(", ")
        )
    })
}

/// The correlation of each such record.
pub(super) fn json(answer: &FitNetworkAnswer) -> Value {
    let one = |shared: &SharedNoise| {
        json!({
            "record": answer.task.runs[shared.run].name,
            "correlation": SiValue::new(shared.correlation, "1"),
        })
    };
    answer.fit.shared_noise.iter().map(one).collect()
}
