//! The sources of a diagram.

use std::collections::BTreeMap;

use lptn_network::{End, Item, SourceId};
use lptn_report::plain;

use super::{MOST_APART, Reader};
use crate::model::Supply;
use crate::words;

impl Reader<'_> {
    /// The places that a source heats, with their shares.
    fn shares(&self, id: SourceId) -> Vec<(usize, f64)> {
        let mut shares: Vec<(usize, f64)> = Vec::new();
        for (node, share) in &self.network.sources()[id.index()].into {
            let place = self.at(End::Node(*node));
            match shares.iter_mut().find(|(at, _)| *at == place) {
                Some((_, sum)) => *sum += share,
                None => shares.push((place, *share)),
            }
        }
        shares
    }

    /// Sources for each place that they heat, and those that each source becomes.
    pub(super) fn sources(&self) -> (Vec<Supply>, Vec<Vec<usize>>) {
        let shares: Vec<_> = self.network.heat_sources().map(|id| (id, self.shares(id))).collect();
        let mut count = vec![0; self.alone.len()];
        for (place, _) in shares.iter().flat_map(|(_, shares)| shares) {
            count[*place] += 1;
        }
        let mut known: BTreeMap<usize, usize> = BTreeMap::new();
        let mut all: Vec<(usize, Vec<(SourceId, f64)>)> = Vec::new();
        let mut source_of = Vec::new();
        for (id, shares) in shares {
            let mut own = Vec::new();
            for (place, share) in shares {
                let apart = self.alone[place] || count[place] <= MOST_APART;
                let new = all.len();
                let at = if apart { new } else { *known.entry(place).or_insert(new) };
                if at == new {
                    all.push((place, Vec::new()));
                }
                all[at].1.push((id, share));
                own.push(at);
            }
            source_of.push(own);
        }
        let supply = |(into, members): &(usize, Vec<_>)| self.supply(*into, members);
        (all.iter().map(supply).collect(), source_of)
    }

    fn supply(&self, into: usize, members: &[(SourceId, f64)]) -> Supply {
        let heat = self.view.state.map(|state| {
            members.iter().map(|(id, share)| state.source_heat[id.index()] * share).sum()
        });
        let name = |id: SourceId| plain(&self.network.name_of(Item::Source(id)));
        let name = match members {
            [(id, share)] if *share > 0.999_999 => name(*id),
            [(id, share)] => {
                format!("{}, {} %", name(*id), lptn_report::significant(100.0 * share, 3))
            }
            many => {
                let names: Vec<String> = many.iter().map(|(id, _)| name(*id)).collect();
                words::together(&names, "sources")
            }
        };
        Supply { name, into, value: self.power(members), heat }
    }

    fn power(&self, members: &[(SourceId, f64)]) -> String {
        let mut scope = self.scope();
        let mut sum = 0.0;
        for (id, share) in members {
            let law = &self.network.sources()[id.index()].law;
            let fixed = law.values().iter().all(|value| words::is_fixed(self.network, value));
            let heat = fixed.then(|| self.network.source_heat(*id, &mut scope, &[]).ok());
            let Some(power) = heat.flatten() else {
                let on_heat = !self.network.source_variables(*id).is_empty();
                let on_time = law.values().iter().any(|v| self.network.depends_on_time(v));
                return words::letter("P", (on_time, on_heat));
            };
            sum += power * share;
        }
        let sign = if sum < 0.0 { "-" } else { "" };
        format!("{sign}{}", words::si(sum.abs(), "W"))
    }
}
