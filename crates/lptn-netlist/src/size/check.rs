//! Errors in the numbers of a size.

use lptn_data::Diagnostic;
use lptn_network::{Network, Value};

use crate::size::{SizeRange, SizeStudy};

impl SizeStudy {
    /// The error of a range.
    pub(super) fn check_range(&self, network: &Network, range: &SizeRange) -> Option<Diagnostic> {
        let mut scope = network.evaluation();
        let (from, to) = (range.from.at(&mut scope), range.to.at(&mut scope));
        let words = format!("`{}` in `vary` of size `{}`", range.name, self.name);
        let problem = match (from, to) {
            (Ok(from), Ok(to)) if from < to => return None,
            (Ok(_), Ok(_)) => {
                let message = format!("{words}: `from` has to be less than `to`");
                let help = "write the least value as `from` and the largest as `to`; `minimise` or \
                            `maximise` says which of them is the better end";
                Diagnostic::error("netlist::size_range", message).help(help)
            }
            (Err(error), _) | (_, Err(error)) => {
                Diagnostic::error(error.code(), format!("{words}: {error}"))
            }
        };
        Some(problem.at(range.span.clone(), ""))
    }

    /// Checks that an optimised parameter is varied, or follows from one that is.
    pub(super) fn check_objective(&self, network: &Network) -> Option<Diagnostic> {
        let objective = &self.objective.text;
        let id = network.parameter(objective).ok()?;
        let columns = self.catalogues.iter().flat_map(|one| &one.columns);
        let mut set = columns.map(|one| &one.name).chain(self.varied.iter().map(|one| &one.name));
        let follows = !matches!(network.parameters()[id.index()].value, Value::Constant(_));
        if follows || set.any(|name| name == objective) {
            return None;
        }
        let varied = self.varied.first().map(|one| &one.span);
        let place = varied.or(self.catalogues.first().map(|one| &one.span))?;
        let message = format!("size `{}` optimises `{objective}`, which nothing varies", self.name);
        let help = match self.catalogues.is_empty() {
            true => format!(
                "write it like this: `vary = {{ {objective} = {{ from = \"..\", to = \"..\" }} }}`"
            ),
            false => {
                format!("give a catalogue a column `{objective}`, or optimise one that it has")
            }
        };
        Some(Diagnostic::wrong("netlist::size_vary", message, place, help))
    }

    pub(super) fn check_probability(&self, network: &Network) -> Option<Diagnostic> {
        let setting = self.probability.as_ref()?;
        let wrong = |message: String, help: &str| {
            Diagnostic::wrong("netlist::size_probability", message, &setting.span, help)
        };
        match self.probability(network) {
            Ok(Some(p)) if !(p > 0.5 && p < 1.0) => Some(wrong(
                format!("{} has to be more than 0.5 and less than 1, got {p}", setting.words),
                &setting.help,
            )),
            Ok(_) => None,
            Err(error) => {
                let message = format!("{}: {error}", setting.words);
                Some(Diagnostic::error(error.code(), message).at(setting.span.clone(), ""))
            }
        }
    }

    pub(super) fn check_period(&self, network: &Network) -> Option<Diagnostic> {
        let setting = self.period.as_ref()?;
        let problem = match self.period(network) {
            Ok(Some(period)) if !(period.is_finite() && period > 0.0) => {
                let message = format!("{} must be more than zero, got {period} s", setting.words);
                Diagnostic::error("netlist::run_not_positive", message).help(&setting.help)
            }
            Ok(_) => return None,
            Err(error) => Diagnostic::error(error.code(), format!("{}: {error}", setting.words)),
        };
        Some(problem.at(setting.span.clone(), ""))
    }
}
