//! Studies to paste into a file that has none, with names and numbers of the file.
//!
//! A study has to be one that makes sense there. The parameter is one that costs something and
//! changes the temperature, the requirement is a limit of the file, and the answer is the value that costs least:
//! a smaller conductance, a larger resistance, or the largest power that keeps the limit.

mod subject;

use lptn_network::is_name;
use lptn_report::{duration, significant};

use crate::input::Input;
use subject::{Subject, Way};

/// A duration of measurements in s without a `[run]`.
const USUAL_DURATION: f64 = 1800.0;

/// Samples of a planned measurement.
const SAMPLES: f64 = 300.0;

/// A `[size.NAME]`.
pub(crate) fn size(input: &Input) -> String {
    let subject = Subject::of(input);
    let Subject { before, name, ends: [from, to], requirement, .. } = &subject;
    let goal = if subject.way == Way::Least { "minimise" } else { "maximise" };
    format!(
        "{before}[size.best]\n{goal} = \"{name}\"\nvary = {{ {name} = {{ from = \"{from}\", to = \
         \"{to}\" }} }}\nrequire = [\"{requirement}\"]{}",
        over_run(&subject)
    )
}

/// A `[sweep.NAME]`.
pub(crate) fn sweep(input: &Input) -> String {
    let subject = Subject::of(input);
    let Subject { before, name, ends: [from, to], node, .. } = &subject;
    let report = if subject.over_run { format!("max({node}.T)") } else { format!("{node}.T") };
    format!(
        "{before}[sweep.designs]\nmethod = \"grid\"\naxes = {{ {name} = {{ from = \"{from}\", to = \
         \"{to}\", points = 10 }} }}\nreport = {{ T = \"{report}\" }}{}",
        over_run(&subject)
    )
}

/// A `[fit.NAME]`; the record is still to be measured.
pub(crate) fn fit(input: &Input) -> String {
    let Subject { before, name, ends: [from, to], node, .. } = Subject::of(input);
    format!(
        "{before}[fit.heating]\n{}\nsigma = \"0.2 K\"\nvary = {{ {name} = {{ from = \"{from}\", to = \
         \"{to}\" }} }}",
        record(&node)
    )
}

/// A `[plan.NAME]`.
pub(crate) fn plan(input: &Input) -> String {
    let Subject { before, name, node, known_to, .. } = Subject::of(input);
    let run = input.netlist.run.as_ref();
    let length = run.map_or(USUAL_DURATION, |run| run.stop - run.start);
    let (place, every) = (column(&node), significant(length / SAMPLES, 2));
    format!(
        "{before}[plan.next]\nknow = {{ {name} = \"{known_to}\" }}\nplace = {{ {place} = {{ of = \
         \"{node}.T\", noise = \"0.1 K\" }} }}\nevery = \"{every} s\"\nduration = \"{}\"",
        duration(length, 4)
    )
}

/// An `[infer.NAME]`, with a signal if the file has none; the record is still to be measured.
pub(crate) fn infer(input: &Input) -> String {
    let network = &input.netlist.network;
    let (before, name) = match network.signals().first() {
        Some(signal) => (String::new(), signal.name.clone()),
        None => {
            let mut names = (1..).map(|k| format!("P_{k}"));
            let free = names.find(|name| network.parameter(name).is_err()).unwrap_or_default();
            let note = format!("    # and use it in a source: P = \"{free}\"");
            (format!("[signal]\n{free} = \"50 W\"{note}\n\n"), free)
        }
    };
    let record = record(&Subject::of(input).node);
    format!("{before}[infer.power]\n{record}\nsigma = \"0.1 K\"\nfind = [\"{name}\"]")
}

/// A `[gearbox.NAME]`.
pub(crate) fn gearbox(input: &Input) -> String {
    let node = Subject::of(input).node;
    format!(
        "[gearbox.stage]\nteeth = {{ sun = 18, planet = 42, ring = 102 }}\nplanets = 3\nspeed = \
         \"7000 rpm\"\ninto = \"{node}\""
    )
}

/// The lines of a record of one temperature.
fn record(node: &str) -> String {
    let column = column(node);
    format!(
        "data = \"record.csv\"    # your record: its header is `t [s],{column} [degC]`\ncolumn = {{ \
         {column} = \"{node}.T\" }}"
    )
}

/// The name of a column or place for the temperature of a node.
fn column(node: &str) -> &str {
    if is_name(node) { node } else { "sensor" }
}

fn over_run(subject: &Subject) -> &'static str {
    if subject.over_run { "\nover = \"run\"" } else { "" }
}
