//! Values that are evaluated over time, with the signals that they read.

use super::Parts;
use super::signal::Course;
use crate::id::{Item, SignalId};
use crate::value::Value;

/// Values that are evaluated over time, and the signals that they read.
pub(crate) struct Watched<'a> {
    pub(crate) values: Vec<&'a Value>,
    pub(crate) signals: Vec<bool>,
}

impl Parts {
    /// Values that drive the heat flows or decide when something switches, and their signals.
    pub(crate) fn driving(&self) -> Watched<'_> {
        let roots = self.inputs().filter(|(item, _, _)| !matches!(item, Item::Signal(_)));
        self.watched(roots.map(|(_, _, value)| value).collect(), &[])
    }

    /// Values of the results of these items, limits and reports, and signals that they read.
    pub(crate) fn results(&self, items: &[Item]) -> Watched<'_> {
        let (mut values, mut signals) = (Vec::new(), Vec::new());
        for item in items {
            match *item {
                Item::Limit(id) => values.extend(self.limits[id.index()].sides()),
                Item::Report(id) => values.push(&self.reports[id.index()].value),
                Item::Signal(id) => signals.push(id),
                _ => {}
            }
        }
        self.watched(values, &signals)
    }

    /// With the signals that are read, by other signals too.
    pub(crate) fn watched<'a>(
        &'a self,
        mut values: Vec<&'a Value>,
        signals: &[SignalId],
    ) -> Watched<'a> {
        let mut used = vec![false; self.layout.signals().len()];
        values.iter().for_each(|value| self.mark_signals(value, &mut used));
        signals.iter().for_each(|id| used[id.index()] = true);
        // a signal reads only those before it
        for (i, signal) in self.layout.signals().iter().enumerate().rev() {
            if let (true, Course::Expression(value)) = (used[i], &signal.course) {
                self.mark_signals(value, &mut used);
                values.push(value);
            }
        }
        Watched { values, signals: used }
    }
}
