//! The netlist of a page: its files, and all that the command line changed.

use lptn_answer::run::RunQuestion;
use lptn_netlist::Netlist;
use lptn_report::TimeUnit;
use serde_json::{Value, json};

/// Changes that a command line makes to a netlist.
#[derive(Clone, Copy, Debug, Default)]
pub struct Changes<'a> {
    /// The load case.
    pub case: Option<&'a str>,
    /// Values of parameters, such as `R=0.3K/W`.
    pub set: &'a [String],
    /// The stop of the run.
    pub stop: Option<&'a str>,
    /// The interval between rows.
    pub every: Option<&'a str>,
}

/// The contents of a page: the files of a netlist, changes to it, and the question.
pub fn contents(netlist: &Netlist, changes: &Changes<'_>, question: &RunQuestion) -> Value {
    let file = |(name, bytes): (&str, &[u8])| match std::str::from_utf8(bytes) {
        Ok(text) => json!({ "name": name, "text": text }),
        Err(_) => json!({ "name": name, "bytes": bytes }),
    };
    json!({
        "files": netlist.input_bytes().map(file).collect::<Vec<_>>(),
        "case": changes.case,
        "set": changes.set,
        "stop": changes.stop,
        "every": changes.every,
        "tolerance": question.tolerance,
        "select": question.select,
        "temperature_unit": question.temperature_unit,
        "time_unit": question.time_unit.map(TimeUnit::symbol),
        "balance": question.balance,
        "detail": question.detail as u8,
    })
}
