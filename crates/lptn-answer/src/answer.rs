//! Interface of every answer.

use lptn_netlist::{Diagnostic, Files};
use lptn_report::{Format, Look, Page, write};

use crate::exit::Exit;

/// An answer: a page in every format, the doubts in it, and how it ends.
pub trait Answer: Page {
    /// The files that places of doubts are in.
    fn files(&self) -> &Files;

    /// All doubts in it, those of the netlist first.
    fn doubts(&self) -> Vec<Diagnostic>;

    /// The answer as one JSON object, as `--format json` prints it.
    fn to_json(&self) -> String
    where
        Self: Sized,
    {
        self.written(Format::Json)
    }

    /// The answer as a text for a terminal of 80 columns.
    fn to_table(&self) -> String
    where
        Self: Sized,
    {
        self.written(Format::Table)
    }

    /// The answer in a format, without colours.
    fn written(&self, format: Format) -> String
    where
        Self: Sized,
    {
        let mut bytes = Vec::new();
        // a vector takes everything
        drop(write(self, format, Look::PLAIN, &mut bytes));
        String::from_utf8(bytes).unwrap_or_default()
    }

    /// A sentence for each reason why the answer is no, such as a broken limit.
    fn reasons(&self) -> Vec<String> {
        self.no().into_iter().collect()
    }

    /// The exit class: [`Exit::No`] if the answer is no.
    fn exit(&self) -> Exit {
        if self.no().is_some() { Exit::No } else { Exit::Done }
    }
}

#[cfg(test)]
mod tests {
    use crate::check::CheckAnswer;
    use crate::compare::CompareAnswer;
    use crate::cycle::CycleAnswer;
    use crate::fit::compare::FitCompareAnswer;
    use crate::fit::law::{FitLawAnswer, FitRunsAnswer, StatedLawsAnswer};
    use crate::fit::network::FitNetworkAnswer;
    use crate::fit::step::FitStepAnswer;
    use crate::gear::GearAnswer;
    use crate::graph::GraphAnswer;
    use crate::impedance::ImpedanceAnswer;
    use crate::infer::{Following, InferAnswer};
    use crate::modes::ModesAnswer;
    use crate::plan::PlanAnswer;
    use crate::rank::RankAnswer;
    use crate::reduce::{KeptAnswer, ReduceAnswer};
    use crate::run::RunAnswer;
    use crate::size::{CoolingAnswer, SizeAnswer};
    use crate::steady::SteadyAnswer;
    use crate::sweep::SweepAnswer;
    use crate::verify::VerifyAnswer;

    #[test]
    fn answers_go_from_thread_to_thread() {
        fn sent<T: Send + 'static>() {}
        sent::<(CheckAnswer, CompareAnswer, CycleAnswer)>();
        sent::<(FitCompareAnswer, FitLawAnswer, FitRunsAnswer, StatedLawsAnswer)>();
        sent::<(FitNetworkAnswer, FitStepAnswer)>();
        sent::<GearAnswer>();
        sent::<GraphAnswer>();
        sent::<ImpedanceAnswer>();
        sent::<(Following, InferAnswer)>();
        sent::<(ModesAnswer, PlanAnswer)>();
        sent::<RankAnswer>();
        sent::<(KeptAnswer, ReduceAnswer)>();
        sent::<(CoolingAnswer, SizeAnswer)>();
        sent::<(RunAnswer, SteadyAnswer, SweepAnswer, VerifyAnswer)>();
    }
}
