//! A reduction as a table for files.

use lptn_solve::Table;

use crate::definition::Pair;
use crate::deviation::Deviation;
use crate::nodes::Nodes;
use crate::reduction::Reduction;

impl Reduction {
    /// One row per pair: `definition`, `recommended` (`yes` or `no`) and `within` the limit (`yes`,
    /// `no` or empty); `R_eq`, `C_eq`, `tau` (their product, the time constant of the one-node
    /// network), and of both errors `max`, `relative` (to the rise, -), `time`, `signed` (one node
    /// less network) and `good_from`. `any_load.max` is the largest error over all powers between 0
    /// and 1 W. Missing values are NaN; a port without capacity has one row without a definition.
    pub fn table(&self) -> Table {
        let pairs: Vec<Option<&Pair>> = match &self.dynamics {
            Some(dynamics) => dynamics.pairs.iter().map(Some).collect(),
            None => vec![None],
        };
        let recommended = self.dynamics.as_ref().map(|dynamics| dynamics.recommended.definition);
        let mut table = Table::of(&pairs);
        table.label("definition", |pair| pair.map_or("", |pair| pair.definition.key()).to_owned());
        let is_recommended =
            |pair: &Option<&Pair>| pair.is_some_and(|pair| recommended == Some(pair.definition));
        table.label("recommended", |pair| {
            if is_recommended(pair) { "yes" } else { "no" }.to_owned()
        });
        let within = |pair: &Pair| self.dynamics.as_ref()?.collapses(pair);
        table.label("within", |pair| {
            match pair.and_then(within) {
                Some(true) => "yes",
                Some(false) => "no",
                None => "",
            }
            .to_owned()
        });
        let r = self.norton.resistance;
        table.column("R_eq", "K/W", |_| r);
        let mut column = |name: &str, unit: &str, value: &dyn Fn(&Pair) -> Option<f64>| {
            table.column(name, unit, |pair| pair.and_then(value).unwrap_or(f64::NAN));
        };
        column("C_eq", "J/K", &|pair| Some(pair.capacity));
        column("tau", "s", &|pair| Some(r * pair.capacity));
        let step: &dyn Fn(&Pair) -> Option<Deviation> = &|pair| pair.step;
        for (name, of) in [("step", step), ("run", &|pair: &Pair| pair.run)] {
            column(&format!("{name}.max"), "K", &|pair| Some(of(pair)?.kelvin));
            column(&format!("{name}.relative"), "-", &|pair| of(pair)?.relative);
            column(&format!("{name}.time"), "s", &|pair| Some(of(pair)?.time));
            column(&format!("{name}.signed"), "K", &|pair| Some(of(pair)?.signed));
            column(&format!("{name}.good_from"), "s", &|pair| of(pair)?.good_from);
        }
        let step = self.dynamics.as_ref().and_then(|dynamics| dynamics.step.as_ref());
        table.column("any_load.max", "K", |pair| {
            let nodes = pair.zip(step).and_then(|(pair, step)| Nodes::of_pair(step, pair));
            nodes.map_or(f64::NAN, |nodes| nodes.worst.most())
        });
        table.done()
    }
}
