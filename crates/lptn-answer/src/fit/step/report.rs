//! The report of a step response: each time constant and final temperature with its interval and
//! every doubt in words first, then the record with its residuals.

use lptn_fit::step::Estimated;
use lptn_report::{Piece, Report, Section, Standing, Text, plain};

use super::estimate::to_error;
use super::page::{bias, error, fits, intervals, least, rises};
use super::{FitStepAnswer, StepColumn};
use crate::about;

impl FitStepAnswer {
    /// The sections of a report.
    pub(super) fn report(&self) -> Report {
        let (mut answer, mut results) = (Text::new(), Text::new());
        for column in &self.columns {
            let holds = !column.fit.extrapolates();
            let standing = if holds { Standing::Holds } else { Standing::Open };
            answer.marked(standing, self.value(column));
        }
        for doubt in &self.doubts {
            answer.marked(Standing::Open, &doubt.message);
        }
        for problem in &self.problems {
            answer.marked(Standing::Fails, &problem.message);
        }
        fits(self, answer.section());
        intervals(self, answer.section());
        results.line(super::page::LAW);
        rises(self, results.section());
        bias(self, results.section());
        Report {
            answer: vec![Section::of("", Piece::Text(answer))],
            results: Some(results),
            ..about::of_command(&[], &self.command)
        }
    }

    /// The numbers of a column with their intervals of 95 % in a sentence.
    fn value(&self, column: &StepColumn) -> String {
        let unit = &self.request.unit;
        let within = |number: &Estimated, shown: &dyn Fn(f64) -> f64, scale: f64| {
            let error = number.standard_error / scale;
            let (low, high) = number.interval();
            let [value, low, high] = [number.value, low, high].map(|si| to_error(shown(si), error));
            (value, format!("95 %: {low} .. {high}"))
        };
        let settled = within(&column.fit.settled, &|kelvin| unit.from_si(kelvin), unit.scale);
        let tau = within(&column.fit.tau, &|seconds| seconds, 1.0);
        let mut text = format!(
            "{}: T_f = {} {} ({}), t_RC = {} s ({})",
            plain(&column.column.name),
            settled.0,
            unit.text,
            settled.1,
            tau.0,
            tau.1
        );
        if self.request.capacity.is_some() {
            let power = &column.power.power;
            let value = to_error(power.value, least(power));
            let [random, systematic] = [power.random, power.systematic].map(error);
            text += &format!(
                ", P_disp = {value} W (standard errors: {random} W random, {systematic} W systematic)"
            );
        }
        text
    }
}
