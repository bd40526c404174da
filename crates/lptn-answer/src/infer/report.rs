//! The report of an inference: each value with its band and every doubt in words first, then the
//! curves and the readings over their predictions.

use lptn_report::{Piece, Report, Section, Standing, Text};

use super::InferAnswer;
use crate::about::{self, Known};
use crate::words::symbol;

impl InferAnswer {
    /// The sections of a report.
    pub(super) fn report(&self) -> Report {
        let (mut answer, mut results) = (Text::new(), Text::new());
        let whole = self.is_whole();
        for j in (0..self.task.estimated.len()).filter(|_| whole) {
            answer.marked(Standing::Holds, self.value(j));
        }
        if !whole {
            answer.marked(Standing::Fails, self.verdict());
        }
        for doubt in &self.doubts {
            answer.marked(Standing::Open, &doubt.message);
        }
        answer.section().table(self.means());
        if !self.found.jumps.is_empty() {
            answer.section().table(self.jumps());
        }
        results.section().table(self.moments());
        self.instruments(&mut results);
        results.section();
        for (label, note) in self.notes() {
            results.sentence(&format!("{label} "), &note);
        }
        Report {
            answer: vec![Section::of("", Piece::Text(answer))],
            results: Some(results),
            ..about::about(&self.input, Known::default())
        }
    }

    /// The value of a signal at the end with its band, and if it changes.
    fn value(&self, j: usize) -> String {
        let band = &self.found.courses[j].band;
        let (low, high) = band[band.len() - 1].ends;
        let (value, error) = self.shown_with_error(j, self.at_end(j));
        let [low, high] = [low, high].map(|si| super::page::to_error(self.shown(j, si), &error));
        let unit = symbol(&self.units[j].text);
        let name = &self.task.estimated[j].name;
        let mut text = format!("{name} = {value} {unit} at the end (95 %: {low} .. {high})");
        if self.task.estimated[j].intensity.is_none() {
            text += &format!("; {}", self.changes(j));
        }
        text
    }
}
