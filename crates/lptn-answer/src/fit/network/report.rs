//! The report of a fit: verdict and values first, and the network with the fitted values.

use lptn_fit::network::FittedParameter;
use lptn_report::{Page as _, Piece, Report, Section, Shortest, Standing, Text};

use super::FitNetworkAnswer;
use super::page::notes;
use super::words::verdict;
use crate::about::{self, Known};
use crate::input::Input;
use crate::words::spaced;

impl FitNetworkAnswer {
    /// The sections of a report.
    pub(super) fn report(&self) -> Report {
        let standing = if self.no().is_none() { Standing::Holds } else { Standing::Fails };
        let (mut answer, mut results) = (Text::new(), Text::new());
        answer.marked(standing, verdict(self));
        self.values(&mut answer);
        self.details(&mut results);
        results.section();
        for (label, note) in notes(self) {
            results.sentence(&format!("{label} "), &note);
        }
        let fitted = self.fitted();
        let heading = fitted.as_ref().map(|_| "Network with the fitted values");
        let known = Known { network: heading, ..Known::default() };
        Report {
            answer: vec![Section::of("", Piece::Text(answer))],
            results: Some(results),
            ..about::about(fitted.as_ref().unwrap_or(&self.input), known)
        }
    }

    /// The netlist with the fitted values; `None` if one cannot be set, such as that of a
    /// parameter that follows from others.
    fn fitted(&self) -> Option<Input> {
        let mut number = Shortest::new();
        let one = |(i, parameter): (usize, &FittedParameter)| {
            self.unknowns[i].parameter()?;
            let value = number.text(self.shown(i, parameter.value)).to_owned();
            Some(format!("{}={value}{}", self.name(i), spaced(&self.units[i].text)))
        };
        let values: Vec<String> = self.fit.parameters.iter().enumerate().filter_map(one).collect();
        let mut input = (*self.input).clone();
        input.netlist.set(&values).ok().map(|()| input)
    }
}
