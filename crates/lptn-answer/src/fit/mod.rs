//! Parameters, laws and choices of networks from records.

pub mod compare;
pub(crate) mod figure;
pub mod law;
pub mod network;
pub mod step;
pub mod terms;

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use lptn_report::{Format, Look, Page};

    use super::network::{FitNetworkEnd, FitNetworkQuestion};
    use crate::answer::Answer;
    use crate::belief::Belief;
    use crate::exit::Exit;
    use crate::input::Input;
    use crate::listener::{Listener, Nobody};

    /// Interrupts at the first step.
    struct Impatient;

    impl Listener for Impatient {
        fn warn(&self, _: &lptn_netlist::Files, _: &[lptn_netlist::Diagnostic]) {}

        fn note(&self, _: &str) {}

        fn progress(&self, _: lptn_solve::Progress) -> lptn_solve::Proceed {
            lptn_solve::Proceed::Interrupt
        }
    }

    fn cups() -> Arc<Input> {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/cups.toml");
        Arc::new(Input::open(Path::new(file), &Belief::None, (None, &[])).unwrap())
    }

    fn json(answer: &dyn Page) -> String {
        let mut bytes = Vec::new();
        lptn_report::write(answer, Format::Json, Look::PLAIN, &mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn an_answer_goes_to_another_thread() {
        let input = cups();
        let ask = move || FitNetworkQuestion::default().ask(input, &Nobody).unwrap();
        let answer = std::thread::spawn(ask).join().unwrap();
        assert!(answer.is_whole() && answer.exit() == Exit::Done);
        assert_eq!(answer.names, ["t_black", "t_cream"]);
        let codes = answer.doubts().into_iter().map(|doubt| doubt.code);
        assert!(codes.into_iter().all(|code| json(&answer).contains(code)));
        assert!(answer.posterior().is_some());
    }

    #[test]
    fn an_interruption_is_no_answer() {
        let question = FitNetworkQuestion { study: Some("cups".to_owned()), starts: None };
        let failure = question.ask(cups(), &Impatient).unwrap_err();
        assert_eq!(failure.exit, Exit::Interrupted);
        assert_eq!(failure.diagnostics[0].code, "fit::interrupted");
        let fit = question.begin(cups(), &Nobody).unwrap();
        let Ok(FitNetworkEnd::Interrupted(kept)) = fit.compute(&Impatient) else { panic!() };
        assert!(kept.message().starts_with("interrupted in "));
    }
}
