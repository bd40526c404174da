//! The pictures of `lptn fit law FOLDER`: the content of the paper's Figures 7, 8 and 9.

use lptn_fit::law::{LawOf, RunFit};
use lptn_plot::Figure;
use lptn_report::{MOST_CURVES, plain};

use super::FitRunsAnswer;
use crate::fit::law::figure::{OverSpeed, mean, power_laws, rise_laws, time_laws};
use crate::fit::law::page::ends;

const BARS: &str = "bars: one standard error, by the noise of each record";

/// The value of a run, and its standard error.
type Pick = fn(&RunFit) -> (f64, f64);

impl FitRunsAnswer {
    pub(super) fn pictures(&self) -> Vec<Figure> {
        vec![self.rise_figure(), self.time_figure(), self.power_figure()]
    }

    fn over(&self, of: LawOf) -> OverSpeed<'_> {
        let speeds: Vec<f64> = self.study.runs.iter().map(|run| run.1).collect();
        OverSpeed::new(&self.answer.data.unit, of, ends(&speeds))
    }

    /// Puts some columns of all runs.
    fn measured(&self, over: &mut OverSpeed<'_>, most: usize, pick: Pick) {
        let speeds: Vec<f64> = self.study.runs.iter().map(|run| run.1).collect();
        for (place, column) in self.columns().iter().take(most).enumerate() {
            let (values, errors): (Vec<f64>, Vec<f64>) = column.fits.iter().map(pick).unzip();
            over.measured((&column.column, place), &speeds, (&values, Some(&errors)));
        }
    }

    fn drawn(&self, over: OverSpeed<'_>, mut notes: Vec<String>) -> Figure {
        notes.push(BARS.into());
        let left_out = self.columns().len().saturating_sub(MOST_CURVES);
        if left_out > 0 {
            notes.push(format!("{left_out} more columns are not drawn; --column chooses"));
        }
        over.figure(&plain(&self.answer.data.name), &notes)
    }

    /// Figure 7.
    fn rise_figure(&self) -> Figure {
        let mut over = self.over(LawOf::Rise);
        self.measured(&mut over, MOST_CURVES, |f| (f.power.rise.value, f.power.rise.random));
        let mut notes = vec![self.zero()];
        notes.extend(self.study.consistency.as_ref().map(|c| rise_laws(&mut over, 0, c)));
        self.drawn(over, notes)
    }

    /// Figure 8.
    fn time_figure(&self) -> Figure {
        let mut over = self.over(LawOf::TimeConstant);
        self.measured(&mut over, MOST_CURVES, |f| (f.fit.tau.value, f.fit.tau.standard_error));
        for (place, column) in self.columns().iter().take(MOST_CURVES).enumerate() {
            mean(&mut over, (&column.column, place), self.study.time_constant(column));
        }
        let mut notes = vec!["means with the standard deviation of one run".to_owned()];
        notes.extend(self.study.consistency.as_ref().map(|c| time_laws(&mut over, 0, c)));
        self.drawn(over, notes)
    }

    /// Figure 9.
    fn power_figure(&self) -> Figure {
        let mut over = self.over(LawOf::Power);
        self.measured(&mut over, 1, |f| (f.power.power.value, f.power.power.random));
        let notes = power_laws(&mut over, &self.answer);
        self.drawn(over, notes)
    }
}
