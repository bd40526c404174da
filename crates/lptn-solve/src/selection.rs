//! The columns of a table, and the nodes that a run records for them.

use lptn_network::{Item, LimitId, Network, NodeId, ReportId};

use crate::quantity::Quantity;

/// The nodes that a solution records.
#[derive(Clone, Debug, PartialEq)]
pub enum RecordedNodes {
    /// Every node: heat flows can be computed from the solution.
    All,
    /// These nodes only, to save memory.
    Nodes(Vec<NodeId>),
    /// These nodes, and the values of these columns, which are read as the run reaches each row.
    Columns {
        /// The nodes.
        nodes: Vec<NodeId>,
        /// The columns.
        columns: Selection,
    },
}

impl RecordedNodes {
    /// Records these nodes too.
    #[must_use]
    pub fn and(mut self, more: impl IntoIterator<Item = NodeId>) -> Self {
        if let Self::Nodes(nodes) | Self::Columns { nodes, .. } = &mut self {
            nodes.extend(more);
        }
        self
    }
}

/// The columns of a table, chosen by patterns over their names: `*` stands for any characters, `?`
/// for one.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    quantities: Vec<Quantity>,
}

impl Selection {
    /// Every column.
    pub fn all(network: &Network) -> Self {
        Self { quantities: Quantity::all(network).collect() }
    }

    /// The columns of the items for which `of` is true.
    pub fn of(network: &Network, of: impl Fn(Item) -> bool) -> Self {
        Self { quantities: Quantity::all(network).filter(|quantity| of(quantity.item())).collect() }
    }

    /// The columns of these reports.
    pub fn of_reports(reports: &[ReportId]) -> Self {
        Self { quantities: reports.iter().map(|id| Quantity::Report(*id)).collect() }
    }

    /// Both sides of these limits.
    pub(crate) fn of_limits(limits: impl Iterator<Item = LimitId>) -> Self {
        let sides = limits.flat_map(|id| [Quantity::Side(id, 0), Quantity::Side(id, 1)]);
        Self { quantities: sides.collect() }
    }

    /// With the quantities of these reports: a window follows them for their numbers over time.
    #[must_use]
    pub fn and_reports(mut self, reports: impl IntoIterator<Item = ReportId>) -> Self {
        self.quantities.extend(reports.into_iter().map(Quantity::Report));
        self
    }

    /// The columns that match any of `patterns`, in the order of the network.
    ///
    /// # Errors
    /// The patterns that match no column.
    pub fn matching(network: &Network, patterns: &[String]) -> Result<Self, Vec<String>> {
        if let Some(mut quantities) = named(network, patterns) {
            quantities.sort_unstable_by_key(|quantity| quantity.order(network));
            quantities.dedup();
            return Ok(Self { quantities });
        }
        // with a large network not all names are in memory at once
        let mut found = vec![false; patterns.len()];
        let mut chosen = |quantity: &Quantity, asked: &dyn Fn(&str) -> bool| {
            let name = quantity.name(network);
            let mut any = false;
            for (pattern, found) in
                patterns.iter().zip(&mut found).filter(|(pattern, _)| asked(pattern))
            {
                let fits = name_matches(pattern, &name);
                (*found, any) = (*found || fits, any || fits);
            }
            any
        };
        let mut quantities: Vec<Quantity> =
            Quantity::all(network).filter(|quantity| chosen(quantity, &|_| true)).collect();
        let reaching = |p: &str| p.contains('[') || !p.contains(['*', '?']);
        if patterns.iter().any(|pattern| reaching(pattern)) {
            quantities
                .extend(Quantity::inner(network).filter(|quantity| chosen(quantity, &reaching)));
        }
        let unmatched = patterns.iter().zip(found).filter(|(_, found)| !found);
        let unmatched: Vec<String> = unmatched.map(|(pattern, _)| pattern.clone()).collect();
        if unmatched.is_empty() { Ok(Self { quantities }) } else { Err(unmatched) }
    }

    /// The names of all columns that a network has.
    pub fn names(network: &Network) -> Vec<String> {
        Quantity::all(network).map(|q| q.name(network)).collect()
    }

    /// The nodes and columns that a run has to record for this selection.
    pub fn record(&self) -> RecordedNodes {
        let (nodes, mut columns) = (self.nodes().collect(), self.clone());
        if !self.has_heat() {
            return RecordedNodes::Nodes(nodes);
        }
        columns.quantities.retain(|quantity| !matches!(quantity, Quantity::Node(_)));
        RecordedNodes::Columns { nodes, columns }
    }

    /// True if there is a column that follows from the temperatures of several nodes.
    pub fn has_heat(&self) -> bool {
        self.quantities.iter().any(|quantity| quantity.needs_all())
    }

    /// The nodes whose temperature is selected, in the order of the network.
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        self.quantities
            .iter()
            .filter_map(|q| if let Quantity::Node(id) = q { Some(*id) } else { None })
    }

    pub(crate) fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// True if no column is selected.
    pub fn is_empty(&self) -> bool {
        self.quantities.is_empty()
    }
}

/// The quantities of patterns that are plain names; `None` if one of them is not.
fn named(network: &Network, patterns: &[String]) -> Option<Vec<Quantity>> {
    if patterns.iter().any(|pattern| pattern.contains(['*', '?'])) {
        return None;
    }
    patterns.iter().map(|pattern| Quantity::named(network, pattern)).collect()
}

/// True if `name` has the form of `pattern`. The match is greedy with one place to go back to, so
/// linear but for the product of the two lengths.
pub fn name_matches(pattern: &str, name: &str) -> bool {
    let (pattern, name) = (pattern.as_bytes(), name.as_bytes());
    let (mut p, mut n, mut star) = (0, 0, None);
    while n < name.len() {
        match pattern.get(p) {
            Some(b'*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(&c) if c == b'?' || c == name[n] => {
                p += 1;
                n += 1;
            }
            _ => {
                let Some((at, taken)) = star else { return false };
                star = Some((at, taken + 1));
                (p, n) = (at + 1, taken + 1);
            }
        }
    }
    pattern[p..].iter().all(|&c| c == b'*')
}

#[cfg(test)]
mod tests {
    use super::name_matches;

    #[test]
    fn patterns_match_whole_names() {
        assert!(name_matches("*.T", "steel.T"));
        assert!(name_matches("s*l.?", "steel.T"));
        assert!(name_matches("*", ""));
        assert!(name_matches("*a*b*", "xxaxxbxx"));
        assert!(name_matches("planet[1].*", "planet[1].gear.T"));
        assert!(!name_matches("*.T", "internal.Q"));
        assert!(!name_matches("steel", "steel.T"));
        assert!(!name_matches("?", ""));
    }
}
