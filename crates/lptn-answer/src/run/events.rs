//! Events of a run: `events.csv`, JSON, and the use of controls.

use lptn_network::{ControlId, Network};
use lptn_report::{Clock, Shortest, Text, TextTable, fixed};
use lptn_solve::{Event, EventKind, Solution};
use lptn_study::SiValue;
use serde_json::{Value, json};

use crate::families::{self, Row};
use crate::words::MOST_NODES;

/// Most events that are shown.
const SHOWN: usize = 6;

/// The rows of `events.csv`.
pub(super) fn rows(solution: &Solution) -> Vec<Vec<String>> {
    let mut rows =
        vec![["time [s]", "kind", "name", "before", "after"].map(str::to_owned).to_vec()];
    let mut number = Shortest::new();
    rows.extend(solution.events().iter().map(|event| {
        let Event { time, kind, before, after } = *event;
        let (time, name) = (number.text(time).to_owned(), kind.name(solution.network()));
        vec![time, kind.word().to_owned(), name, before.to_string(), after.to_string()]
    }));
    rows
}

/// A list of `{ time, kind, name, before, after }`.
pub(super) fn json(solution: &Solution) -> Value {
    let state = |state: u8| json!({ "value": state, "unit": "1" });
    let one = |event: &Event| {
        json!({
            "time": SiValue::new(event.time, "s"),
            "kind": event.kind.word(),
            "name": event.kind.name(solution.network()),
            "before": state(event.before),
            "after": state(event.after),
        })
    };
    solution.events().iter().map(one).collect()
}

/// Use of a control between the start and the end that was reached.
struct Use {
    name: String,
    starts: usize,
    stops: usize,
    /// Mean time in s from one start to the next; `None` unless there are two.
    period: Option<f64>,
    /// Part of the time that it was on; `None` if no time passed.
    duty: Option<f64>,
    /// True if it is on at the end.
    on: bool,
}

impl Use {
    fn of(solution: &Solution, id: ControlId, (start, end): (f64, f64)) -> Self {
        let own = || solution.events().iter().filter(|event| event.kind == EventKind::Control(id));
        let on = solution.controls().get(id.index()).is_some_and(|state| state.on);
        // it began the other way round than it first switched
        let mut now = own().next().map_or(on, |event| event.before == 1);
        let (mut since, mut time_on) = (start, 0.0);
        for event in own() {
            time_on += if now { event.time - since } else { 0.0 };
            (now, since) = (event.after == 1, event.time);
        }
        time_on += if now { end - since } else { 0.0 };
        let starts: Vec<f64> =
            own().filter(|event| event.after == 1).map(|event| event.time).collect();
        #[expect(clippy::cast_precision_loss, reason = "a run has at most 10^6 events")]
        let period = match starts.as_slice() {
            [first, .., last] => Some((last - first) / (starts.len() - 1) as f64),
            _ => None,
        };
        let duty = (end > start).then(|| time_on / (end - start));
        let stops = own().count() - starts.len();
        let name = solution.network().controls()[id.index()].name.clone();
        Self { name, starts: starts.len(), stops, period, duty, on }
    }
}

/// A section with a line for each control and the first events, from `start` on.
/// Nothing if nothing can switch.
pub(super) fn section(
    text: &mut Text,
    (solution, fold): (&Solution, bool),
    (start, end): (f64, f64),
    clock: Clock,
) {
    let network = solution.network();
    if !network.has_events() {
        return;
    }
    text.section();
    let uses = network.control_ids().map(|id| Use::of(solution, id, (start, end))).collect();
    let starts = |of: &Use| of.starts as f64;
    let mut uses: Vec<Row<Use>> = families::folded(uses, fold, |of| (of.name.clone(), 0), starts);
    let all = uses.len();
    uses.truncate(MOST_NODES);
    if !uses.is_empty() {
        text.table(controls(&uses, clock));
    }
    if uses.len() < all {
        text.line(format!("{} of {all} are shown", uses.len()));
    }
    text.labelled("events: ", first(solution, clock));
}

fn controls(uses: &[Row<Use>], clock: Clock) -> TextTable {
    let percent =
        |share: Option<f64>| share.map_or("-".into(), |s| format!("{} %", fixed(100.0 * s, 1)));
    let period = |of: &Use| of.period.map_or("-".into(), |period| clock.text(period, 4));
    let starts = |of: &Use| of.starts as f64;
    let table = TextTable::of(uses).left("control", |row| row.name.as_str());
    families::members(table, uses, "busiest")
        .right("starts", |row| row.range(starts, |starts| fixed(starts, 0)))
        .right("stops", |row| row.item.stops.to_string())
        .right("mean period", |row| period(&row.item))
        .right("on for", |row| percent(row.item.duty))
        .right("at the end", |row| if row.item.on { "on" } else { "off" })
        .into()
}

/// The first events in words.
fn first(solution: &Solution, clock: Clock) -> Vec<String> {
    let events = solution.events();
    if events.is_empty() {
        return vec!["none".to_owned()];
    }
    let mut pieces: Vec<String> =
        events.iter().take(SHOWN).map(|event| words(solution.network(), event, clock)).collect();
    if events.len() > SHOWN {
        pieces.push(format!("and {} more", events.len() - SHOWN));
    }
    let last = pieces.len() - 1;
    pieces[..last].iter_mut().for_each(|piece| piece.push(','));
    pieces
}

/// "fan on at 12.05 min".
fn words(network: &Network, event: &Event, clock: Clock) -> String {
    let state = match (event.kind, event.after) {
        (EventKind::Control(_), 1) => "on",
        (EventKind::Control(_), _) => "off",
        (EventKind::Comparison(_), 1) => "true",
        (EventKind::Comparison(_), _) => "false",
        (EventKind::Limit(_), _) => "broken",
    };
    format!("{} {state} at {}", event.kind.name(network), clock.text(event.time, 4))
}
