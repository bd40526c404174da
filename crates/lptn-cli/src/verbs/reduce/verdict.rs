//! Whether one node may stand for the network: the first line of the report.

use lptn_reduce::{Deviation, Judge};
use lptn_report::{Standing, Text, duration, significant};
use serde_json::{Value, json};

use super::View;
use super::page::error_json;

impl View<'_> {
    /// "collapses to one node within 0.78 % (0.444 K)".
    pub(super) fn verdict(&self) -> String {
        let Some((dynamics, pair)) = self.reduction.dynamics.as_ref().zip(self.pair()) else {
            return "collapses to one resistance, exactly: the port sees no capacity".to_owned();
        };
        let Some((judge, error)) = dynamics.judged(pair) else {
            return "is one resistance in steady state; over time nothing was judged".to_owned();
        };
        let share = percent(&error);
        let of = match judge {
            Judge::Run => format!(" ({} K)", significant(error.kelvin, 3)),
            Judge::Step => " of a step's rise".to_owned(),
        };
        match dynamics.collapses(pair) {
            Some(false) if judge == Judge::Run => {
                format!("does not collapse: one node is {share} wrong{of}")
            }
            Some(false) => format!("does not collapse: one node misses {share}{of}"),
            _ => format!("collapses to one node within {share}{of}"),
        }
    }

    /// The verdict, and how the one node errs.
    pub(super) fn judgement(&self) -> Text {
        let mut text = Text::new();
        let judged = self.reduction.dynamics.as_ref().zip(self.pair());
        let holds = judged.map(|(dynamics, pair)| dynamics.collapses(pair));
        let standing = match holds {
            None | Some(Some(true)) => Standing::Holds,
            Some(Some(false)) => Standing::Fails,
            Some(None) => Standing::Open,
        };
        text.section().marked(standing, self.verdict());
        let error = judged.and_then(|(dynamics, pair)| dynamics.judged(pair));
        if let Some((judge, error)) = error.filter(|(_, error)| error.kelvin > 0.0) {
            text.sentence("", &self.manner(judge, &error));
        }
        if let Some(short) = judged.and_then(|(dynamics, _)| self.short(dynamics)) {
            text.sentence("warning: ", &short);
        }
        text
    }

    /// "it reads too cold by at most 6.44 K, at 23.1 min; within 5% from 2 h on".
    fn manner(&self, judge: Judge, error: &Deviation) -> String {
        let side = if error.signed < 0.0 { "cold" } else { "warm" };
        let time = duration(error.time, 3);
        let most = match judge {
            Judge::Run => format!("{} K, at {time}", significant(error.kelvin, 3)),
            Judge::Step => format!("{} of the rise, {time} after a step", percent(error)),
        };
        let limit = &self.limit.text;
        let good = match error.good_from {
            Some(from) if from <= 0.0 => format!("within {limit} all the time"),
            Some(from) => format!("within {limit} from {} on", duration(from, 3)),
            None => format!("not within {limit} at the end of the run"),
        };
        format!("it reads too {side} by at most {most}; {good}")
    }

    pub(super) fn verdict_json(&self) -> Value {
        let judged = self.reduction.dynamics.as_ref().zip(self.pair());
        let error = judged.and_then(|(dynamics, pair)| dynamics.judged(pair));
        json!({
            "text": self.verdict(),
            "collapses": match judged {
                None => Some(true),
                Some((dynamics, pair)) => dynamics.collapses(pair),
            },
            "definition": judged.map(|(_, pair)| pair.definition.key()),
            "judged_by": error.map(|(judge, _)| judge.key()),
            "error": error.map(|(_, error)| error_json(&error, &self.unit)),
            "limit": self.limit.text,
        })
    }
}

fn percent(error: &Deviation) -> String {
    format!("{} %", significant(100.0 * error.relative.unwrap_or(0.0), 2))
}
