//! Verdict on one node, or a few, instead of the network: the first line of the page.

use lptn_reduce::{Deviation, Judge};
use lptn_report::{Standing, Text, duration, significant};
use serde_json::{Value, json};

use super::ReduceAnswer;
use super::near::Near;
use super::page::error_json;

impl ReduceAnswer {
    /// "collapses to one node within 0.78 % (0.444 K)".
    pub fn verdict(&self) -> String {
        let Some(near) = &self.near else { return self.of_the_linear() };
        let (name, linear) = (near.name(), self.of_the_linear());
        match (near.fails(), linear.strip_suffix(", exactly").filter(|_| near.is_coarse())) {
            (Some(why), _) => format!("near {name} it does not collapse: heat flows {why}"),
            (None, Some(collapses)) => {
                format!("near {name} it {collapses} for small disturbances only")
            }
            (None, None) => format!("near {name} it {linear}"),
        }
    }

    /// True if no linear network describes the state, so that nothing is to be used.
    pub(super) fn fails(&self) -> bool {
        self.near.as_ref().is_some_and(|near| near.fails().is_some())
    }

    fn of_the_linear(&self) -> String {
        if let Some(verdict) = self.loads.verdict() {
            return verdict;
        }
        if self.reduction.dynamics.is_none() {
            return "collapses to one resistance, exactly: the port sees no capacity".to_owned();
        }
        let Some((judge, error, within)) = self.judged() else {
            return "is one resistance in steady state; its behaviour over time was not \
                judged"
                .to_owned();
        };
        let (share, of) = size(judge, &error);
        let one = match self.count() {
            1 => "one node".to_owned(),
            nodes => format!("{nodes} nodes"),
        };
        let wrong = match (one.as_str(), judge) {
            ("one node", Judge::Run) => format!("is {share} wrong{of}"),
            ("one node", Judge::Step) => format!("misses {share}{of}"),
            (_, Judge::Run) => format!("are {share} wrong{of}"),
            (_, Judge::Step) => format!("miss {share}{of}"),
        };
        match within {
            _ if is_exact(&error) => format!("collapses to {one}, exactly"),
            Some(false) => format!("does not collapse: {one} {wrong}{}", self.more()),
            _ => format!("collapses to {one} within {share}{of}"),
        }
    }

    /// "; 3 nodes keep 1 %".
    fn more(&self) -> String {
        let Some((nodes, judge, error)) = &self.loads.more else { return String::new() };
        if is_exact(error) {
            return format!("; {} nodes are exact", nodes.count());
        }
        let (share, of) = size(*judge, error);
        format!("; {} nodes keep {share}{of}", nodes.count())
    }

    /// The verdict, and how the one node errs.
    pub(super) fn judgement(&self) -> Text {
        let mut text = Text::new();
        let judged = self.judged();
        let holds = match (self.loads.kept(), &judged) {
            _ if self.fails() => Some(false),
            (Some(kept), _) => Some(kept),
            (None, Some((_, _, within))) => *within,
            (None, None) => self.reduction.dynamics.is_none().then_some(true),
        };
        let standing = match holds {
            Some(true) => Standing::Holds,
            Some(false) => Standing::Fails,
            None => Standing::Open,
        };
        text.section().marked(standing, self.verdict());
        for note in self.near.iter().flat_map(Near::notes) {
            text.sentence("", &note);
        }
        if let Some((judge, error, _)) = judged.filter(|(_, error, _)| !is_exact(error)) {
            text.sentence("", &self.manner(judge, &error));
        }
        if let Some(short) = self.reduction.dynamics.as_ref().and_then(|d| self.short(d)) {
            text.sentence("warning: ", &short);
        }
        text
    }

    /// "`steel` is then too cold by at most 6.44 K, at 23.1 min; within 5% from 2 h on; other nodes
    /// are not judged".
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
        let port = self.port();
        format!("`{port}` is then too {side} by at most {most}; {good}; other nodes are not judged")
    }

    pub(super) fn verdict_json(&self) -> Value {
        let judged = self.judged();
        let more = self.loads.more.as_ref().map(|(nodes, _, error)| {
            json!({ "nodes": nodes.count(), "error": error_json(error, &self.unit) })
        });
        json!({
            "text": self.verdict(),
            "collapses": match &judged {
                _ if self.fails() => Some(false),
                None => self.reduction.dynamics.is_none().then_some(true),
                Some((_, _, within)) => *within,
            },
            "nodes": self.count(),
            "definition": self.definition().map(|definition| definition.key()),
            "judged_by": judged.map(|(judge, _, _)| judge.key()),
            "error": judged.map(|(_, error, _)| error_json(&error, &self.unit)),
            "limit": self.limit.text,
            "enough": more,
        })
    }
}

/// "35 %" and " (6.49 K)", or of a step "35 %" and " of a step's rise".
fn size(judge: Judge, error: &Deviation) -> (String, String) {
    let of = match judge {
        Judge::Run => format!(" ({} K)", significant(error.kelvin, 3)),
        Judge::Step => " of a step's rise".to_owned(),
    };
    (percent(error), of)
}

/// True if the error is below 1e-8 of the rise, or nothing rises.
fn is_exact(error: &Deviation) -> bool {
    error.relative.is_none_or(|relative| relative < 1e-8)
}

fn percent(error: &Deviation) -> String {
    format!("{} %", significant(100.0 * error.relative.unwrap_or(0.0), 2))
}
