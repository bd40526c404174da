//! The exponentials of a step response as a page.

use std::io;

use lptn_fit::step::{PositiveEstimate, TermsTried};
use lptn_plot::Figure;
use lptn_report::{Json, Page, Report, Rows, Text, TextTable, plain, significant};
use lptn_solve::Table;
use lptn_study::SiValue;
use serde_json::{Value, json};

use super::FitTermsAnswer;
use crate::about;
use crate::messages;

impl FitTermsAnswer {
    fn unit_of_values(&self) -> &'static str {
        if super::is_impedance(&self.column) { "K/W" } else { "K" }
    }

    fn choice(&self, text: &mut Text) {
        let unit = self.unit_of_values();
        text.table(
            TextTable::of(&self.sum.tried)
                .right("terms", |tried: &TermsTried| tried.terms.to_string())
                .right(format!("rms [{unit}]"), |tried| significant(tried.rms, 4))
                .right(format!("largest [{unit}]"), |tried| significant(tried.largest, 3))
                .right("AICc", |tried| format!("{:.1}", tried.criterion))
                .left("", |tried| self.remark(tried)),
        );
    }

    fn remark(&self, tried: &TermsTried) -> &'static str {
        match (tried.terms == self.sum.terms.len(), tried.determined) {
            (true, _) => "taken",
            (false, false) => "not determined",
            (false, true) => "",
        }
    }
}

fn interval(estimate: &PositiveEstimate) -> String {
    let (low, high) = estimate.interval;
    format!("{} .. {}", significant(low, 3), significant(high, 3))
}

impl Page for FitTermsAnswer {
    fn text(&self) -> Text {
        let (factor, unit) = self.factor();
        let name = plain(&self.column.name);
        let mut text = Text::titled(format!(
            "{}: `{name}`, {} samples after the step at {} s",
            plain(&self.name),
            self.sum.samples,
            significant(self.step, 6)
        ));
        let start = if self.sum.start.is_some() { "T_i + " } else { "" };
        let sign = if self.sum.sign < 0.0 { "-" } else { "" };
        let power = if self.power.is_some() { "P " } else { "" };
        text.line(format!(
            "{name}(t) = {start}{sign}{power}sum of {factor}_i (1 - exp(-t / tau_i)), t from the step"
        ));
        self.choice(text.section());
        let rows = self.rows_of_terms();
        text.section().table(
            TextTable::of(&rows)
                .right(format!("{factor} [{unit}]"), |row| significant(row.0.value, 5))
                .right("std. error", |row| significant(row.0.standard_error, 2))
                .right("95 %", |row| interval(&row.0))
                .right("tau [s]", |row| significant(row.1.value, 5))
                .right("std. error", |row| significant(row.1.standard_error, 2))
                .right("95 %", |row| interval(&row.1)),
        );
        let divisor = self.power.unwrap_or(1.0);
        let (all, half) = (self.sum.settled.value / divisor, self.sum.settled.half_width / divisor);
        let section = text.section();
        section.line(format!(
            "sum of {factor}_i: {} {unit}, 95 % ± {}",
            significant(all, 5),
            significant(half, 2)
        ));
        match self.foster() {
            Some(lines) => {
                text.section().lines(lines.lines().map(str::to_owned));
            }
            None => {
                section
                    .sentence("", "--power \"1 W\", the heat of the step, gives R_i and [foster]");
            }
        }
        text
    }

    /// One row for each term.
    fn rows(&self) -> Rows<'_> {
        let (factor, unit) = self.factor();
        let rows = self.rows_of_terms();
        let mut table = Table::of(&rows);
        table.column(factor, unit, |row: &(PositiveEstimate, PositiveEstimate)| row.0.value);
        table.column("tau", "s", |row| row.1.value);
        table.done().into()
    }

    fn figures(&self) -> Vec<Figure> {
        vec![self.figure()]
    }

    fn more(&self) -> Report {
        about::of_command(&[], &self.command)
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        let (factor, unit) = self.factor();
        let divisor = self.power.unwrap_or(1.0);
        let number = |estimate: &PositiveEstimate, unit: &str| {
            json!({
                "value": estimate.value,
                "unit": unit,
                "standard_error": estimate.standard_error,
                "naive_standard_error": estimate.naive,
                "interval_95": [estimate.interval.0, estimate.interval.1],
            })
        };
        let rows = self.rows_of_terms();
        let term = |row: &(PositiveEstimate, PositiveEstimate)| json!({ factor: number(&row.0, unit), "tau": number(&row.1, "s") });
        let tried = |tried: &TermsTried| {
            json!({
                "terms": tried.terms,
                "rms": tried.rms,
                "largest": tried.largest,
                "AICc": tried.criterion,
                "determined": tried.determined,
            })
        };
        let warnings = messages::list(&self.files, &self.record.warnings);
        json.member("format", &1)?;
        json.member("record", &self.name)?;
        json.member("warnings", &warnings)?;
        json.member("column", &self.column.name)?;
        json.member("step", &SiValue::new(self.step, "s"))?;
        json.member("samples", &self.sum.samples)?;
        json.member("unit", self.unit_of_values())?;
        json.member("tried", &self.sum.tried.iter().map(tried).collect::<Vec<Value>>())?;
        json.member("terms", &rows.iter().map(term).collect::<Vec<Value>>())?;
        json.member("sum", &SiValue::new(self.sum.settled.value / divisor, unit))?;
        json.member("foster", &self.foster())
    }
}
