//! A reduction as a table for files.

use lptn_solve::{Column, Label, Table};

use crate::definition::{Definition, Pair};
use crate::deviation::Deviation;
use crate::reduction::Reduction;

impl Reduction {
    /// One row a pair: `definition` and `recommended` (`yes` or `no`); `R_eq`, `C_eq`, `tau` (their product, the time
    /// constant of the one-node network), and of both errors `max`, `relative` (to the rise, -) and `time`. What does
    /// not exist is NaN; a port that sees no capacity has one row without a definition.
    pub fn table(&self) -> Table {
        let pairs: Vec<Option<&Pair>> = match &self.dynamics {
            Some(dynamics) => dynamics.pairs.iter().map(Some).collect(),
            None => vec![None],
        };
        let recommended = self.dynamics.as_ref().map(|dynamics| dynamics.recommended.definition);
        let label = |name: &str, text: &dyn Fn(Definition) -> &'static str, nothing: &str| Label {
            name: name.to_owned(),
            cells: pairs.iter().map(|p| p.map_or(nothing, |p| text(p.definition)).to_owned()).collect(),
        };
        let labels = vec![
            label("definition", &Definition::key, ""),
            label("recommended", &|d| if recommended == Some(d) { "yes" } else { "no" }, "no"),
        ];
        let column = |name: &str, unit: &str, value: &dyn Fn(&Pair) -> Option<f64>| Column {
            name: name.to_owned(),
            unit: unit.to_owned(),
            values: pairs.iter().map(|pair| pair.and_then(value).unwrap_or(f64::NAN)).collect(),
        };
        let r = self.norton.resistance;
        let mut columns = vec![
            Column { name: "R_eq".into(), unit: "K/W".into(), values: vec![r; pairs.len()] },
            column("C_eq", "J/K", &|pair| Some(pair.capacity)),
            column("tau", "s", &|pair| Some(r * pair.capacity)),
        ];
        let step: &dyn Fn(&Pair) -> Option<Deviation> = &|pair| Some(pair.step);
        for (name, of) in [("step", step), ("run", &|pair: &Pair| pair.run)] {
            columns.push(column(&format!("{name}.max"), "K", &|pair| Some(of(pair)?.kelvin)));
            columns.push(column(&format!("{name}.relative"), "-", &|pair| of(pair)?.relative));
            columns.push(column(&format!("{name}.time"), "s", &|pair| Some(of(pair)?.time)));
        }
        Table::labelled(labels, columns)
    }
}
