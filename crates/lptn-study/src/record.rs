//! Ledger and counters in the form in which they are written.

use lptn_network::Network;
use lptn_solve::{Ledger, Solution};
use serde::Serialize;
use serde_json::{Map, Value};

/// A number with its unit, in SI.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SiValue {
    /// The number in `unit`.
    pub value: f64,
    /// Its unit; `1` for a plain number.
    pub unit: String,
}

impl SiValue {
    /// `value` in `unit`.
    pub fn new(value: f64, unit: &str) -> Self {
        Self { value, unit: unit.to_owned() }
    }

    /// The object `{ "value": …, "unit": … }`; a value that is not a number is `null`.
    pub fn json(&self) -> Value {
        serde_json::json!({ "value": self.value, "unit": self.unit })
    }
}

/// The energy ledger of a run, every heat by the name of its giver or taker.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LedgerRecord {
    /// Heat of each source.
    pub sources: Map<String, Value>,
    /// Heat that each boundary gave to the network.
    pub boundaries: Map<String, Value>,
    /// Heat that each stream brought to its two ends together.
    pub streams: Map<String, Value>,
    /// Heat, over the temperature of the start, that came with the mass of each node whose capacity
    /// follows states.
    #[serde(skip_serializing_if = "Map::is_empty")]
    pub masses: Map<String, Value>,
    /// Heat that each node stored.
    pub stored: Map<String, Value>,
    /// Total heat exchanged.
    pub turned_over: SiValue,
    /// Sources plus boundaries plus streams plus masses less stored.
    pub residual: SiValue,
    /// The residual over the total heat exchanged; `null` if there was none.
    pub relative_residual: Option<SiValue>,
    /// The largest relative residual allowed.
    pub bound: SiValue,
    /// True if it is within that bound.
    pub closes: bool,
}

impl LedgerRecord {
    /// The ledger of a run of `network`.
    pub fn new(network: &Network, ledger: &Ledger) -> Self {
        let heats = ledger.heats(network);
        let of = |part: &str| -> Map<String, Value> {
            let own = heats.iter().filter(|(of, ..)| *of == part);
            own.map(|(_, name, heat)| (name.to_string(), SiValue::new(*heat, "J").json())).collect()
        };
        Self {
            sources: of(Ledger::SOURCES),
            boundaries: of(Ledger::BOUNDARIES),
            streams: of(Ledger::STREAMS),
            masses: of(Ledger::MASSES),
            stored: of(Ledger::STORED),
            turned_over: SiValue::new(ledger.turned_over, "J"),
            residual: SiValue::new(ledger.residual(), "J"),
            relative_residual: ledger.relative_residual().map(|r| SiValue::new(r, "1")),
            bound: SiValue::new(ledger.bound, "1"),
            closes: ledger.closes(),
        }
    }
}

/// The integrator's counters by name, whole numbers with the unit `1`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct StatisticsRecord(Map<String, Value>);

impl StatisticsRecord {
    /// The counters of a run, with the number of its events.
    pub fn new(solution: &Solution) -> Self {
        let statistics = solution.statistics();
        let counters = [
            ("steps", statistics.steps),
            ("flow_evaluations", statistics.flow_evaluations),
            ("jacobian_evaluations", statistics.jacobian_evaluations),
            ("linear_setups", statistics.linear_setups),
            ("factorizations", statistics.factorizations),
            ("linear_solves", statistics.linear_solves),
            ("linear_iterations", statistics.linear_iterations),
            ("fill", statistics.fill),
            ("newton_iterations", statistics.newton_iterations),
            ("error_test_failures", statistics.error_test_failures),
            ("newton_failures", statistics.newton_failures),
            ("restarts", statistics.restarts),
            ("events", solution.events().len() as u64),
        ];
        let member = |(name, count): (&str, u64)| {
            (name.to_owned(), serde_json::json!({ "value": count, "unit": "1" }))
        };
        let mut members: Map<String, Value> = counters.into_iter().map(member).collect();
        if let Some(time) = statistics.switched_to_lu {
            members.insert("switched_to_lu".into(), SiValue::new(time, "s").json());
        }
        Self(members)
    }
}
