//! The range of time constants of a network.

use lptn_network::{Network, NodeId};
use lptn_report::{duration, significant};
use lptn_solve::Stiffness;
use lptn_study::SiValue;
use serde_json::{Value, json};

/// The time constants of the nodes that follow their surroundings fastest and slowest.
pub(super) struct Stiff {
    fastest: (String, f64),
    slowest: (String, f64),
    ratio: f64,
}

impl Stiff {
    pub(super) fn of(network: &Network) -> Option<Self> {
        let stiffness = Stiffness::of(network)?;
        let named = |(node, tau): (NodeId, f64)| (network.nodes()[node.index()].name.clone(), tau);
        let ratio = stiffness.ratio();
        Some(Self { fastest: named(stiffness.fastest), slowest: named(stiffness.slowest), ratio })
    }

    pub(super) fn words(&self) -> String {
        let one = |(name, tau): &(String, f64)| format!("{} ({name})", duration(*tau, 3));
        let (fast, slow) = (one(&self.fastest), one(&self.slowest));
        match self.fastest.0 == self.slowest.0 {
            true => format!("C / sum of G is {fast}"),
            false => format!("{}, C / sum of G is {fast} to {slow}", significant(self.ratio, 3)),
        }
    }

    pub(super) fn json(&self) -> Value {
        let one =
            |(name, tau): &(String, f64)| json!({ "node": name, "tau": SiValue::new(*tau, "s") });
        let ratio = SiValue::new(self.ratio, "1");
        json!({ "fastest": one(&self.fastest), "slowest": one(&self.slowest), "ratio": ratio })
    }
}
