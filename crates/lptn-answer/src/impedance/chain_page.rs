//! Output of an R-tau table and a ladder.

use std::io;

use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_report::{Json, TextTable, significant};
use lptn_solve::Table;
use lptn_study::SiValue;
use serde_json::{Value, json};

use super::ImpedanceAnswer;
use super::chain::Chain;

/// A rung with the sums of all up to it: a point of the structure function.
struct Rung {
    capacity: f64,
    resistance: f64,
    capacities: f64,
    resistances: f64,
}

impl Chain {
    /// The settled rise in K per unit.
    fn settled(&self) -> f64 {
        self.direct + self.terms.iter().map(|term| term.0).sum::<f64>()
    }

    fn rungs(&self) -> Option<Vec<Rung>> {
        let ladder = self.ladder.as_ref()?;
        let (mut capacities, mut resistances) = (0.0, ladder.direct);
        let rung = |&(capacity, resistance): &(f64, f64)| {
            capacities += capacity;
            resistances += resistance;
            Rung { capacity, resistance, capacities, resistances }
        };
        Some(ladder.rungs.iter().map(rung).collect())
    }
}

impl ImpedanceAnswer {
    pub(super) fn chain_line(&self, chain: &Chain) -> String {
        let (count, unit) = (chain.terms.len(), self.unit());
        let settled = significant(chain.settled(), 5);
        let what = match (chain.ladder.is_some(), count) {
            (true, 1) => "one rung".to_owned(),
            (true, count) => format!("a ladder of {count} rungs"),
            (false, 1) => "one exponential".to_owned(),
            (false, count) => format!("a sum of {count} exponentials"),
        };
        let (to, name) = (&self.to, &self.name);
        let which = if to == name { String::new() } else { format!(" of `{name}`") };
        let head = format!("`{to}` rises by {settled} {unit}{which}: {what}");
        match chain.error {
            None => format!("{head}, exact"),
            Some(error) => {
                let share = significant(100.0 * error / chain.settled(), 2);
                format!("{head} of {}, within {share} % over every load", chain.all)
            }
        }
    }

    pub(super) fn chain_shown(&self, chain: &Chain) -> TextTable {
        if let Some(rungs) = chain.rungs() {
            return TextTable::of(&rungs)
                .right("C [J/K]", |rung| significant(rung.capacity, 5))
                .right("R [K/W]", |rung| significant(rung.resistance, 5))
                .right("sum of C [J/K]", |rung| significant(rung.capacities, 5))
                .right("sum of R [K/W]", |rung| significant(rung.resistances, 5))
                .into();
        }
        let settled = chain.settled();
        TextTable::of(&chain.terms)
            .right(format!("R [{}]", self.unit()), |term| significant(term.0, 5))
            .right("tau [s]", |term| significant(term.1, 5))
            .right("share", |term| format!("{} %", significant(100.0 * term.0 / settled, 3)))
            .into()
    }

    pub(super) fn chain_table(&self, chain: &Chain) -> Table {
        if let Some(rungs) = chain.rungs() {
            let mut table = Table::of(&rungs);
            table.column("C", "J/K", |rung: &Rung| rung.capacity);
            table.column("R", "K/W", |rung| rung.resistance);
            table.column("sum of C", "J/K", |rung| rung.capacities);
            table.column("sum of R", "K/W", |rung| rung.resistances);
            return table.done();
        }
        let mut table = Table::of(&chain.terms);
        table.column("R", self.unit(), |term: &(f64, f64)| term.0);
        table.column("tau", "s", |term| term.1);
        table.done()
    }

    /// Note on the part of the rise that comes at once, if there is one.
    pub(super) fn chain_note(&self, chain: &Chain) -> Option<String> {
        let direct = significant(chain.direct, 5);
        (chain.direct > 0.0)
            .then(|| format!("{direct} {} of it come at once, before all terms", self.unit()))
    }

    pub(super) fn chain_json(&self, chain: &Chain, json: &mut Json<'_>) -> io::Result<()> {
        let of = |value: f64, unit: &str| SiValue::new(value, unit);
        json.member("settled", &of(chain.settled(), self.unit()))?;
        json.member("direct", &of(chain.direct, self.unit()))?;
        json.member("terms_of_all", &chain.all)?;
        json.member("error", &chain.error.map(|error| of(error, self.unit())))?;
        let term =
            |term: &(f64, f64)| json!({ "R": of(term.0, self.unit()), "tau": of(term.1, "s") });
        json.member("foster", &chain.terms.iter().map(term).collect::<Vec<Value>>())?;
        let rung = |rung: &(f64, f64)| json!({ "C": of(rung.0, "J/K"), "R": of(rung.1, "K/W") });
        let rungs =
            |ladder: &lptn_network::Cauer| ladder.rungs.iter().map(rung).collect::<Vec<Value>>();
        json.member("cauer", &chain.ladder.as_ref().map(rungs))
    }

    /// The spectrum of time constants, or the structure function.
    pub(super) fn chain_panel(&self, chain: &Chain) -> Panel {
        let Some(rungs) = chain.rungs() else {
            let axis = Axis::linear("share of the rise", self.unit());
            let mut panel = Panel::new(Axis::log("time constant", "s"), axis);
            let points = chain.terms.iter().map(|term| (term.1, term.0)).collect();
            panel.curves.push(Curve::line("R", points).looks(Look::Stems));
            return panel;
        };
        let axis = Axis::log("heat capacity up to there", "J/K");
        let mut panel = Panel::new(Axis::linear("resistance from the port", "K/W"), axis);
        // the capacity of a rung comes before its resistance
        let steps = |rung: &Rung| {
            let before = rung.resistances - rung.resistance;
            [(before, rung.capacities), (rung.resistances, rung.capacities)]
        };
        let points = rungs.iter().flat_map(steps).collect();
        panel.curves.push(Curve::line("structure function", points));
        panel
    }
}
