//! The proof of an answer in words and members.

use lptn_netlist::Diagnostic;
use lptn_network::list_of;
use lptn_report::rounded_up;
use lptn_study::SiValue;
use serde_json::{Value, json};

use super::kept::Kept;
use super::proof::Proof;
use crate::proven;
use crate::words::spaced;

impl Kept {
    /// A proven bound on the error of a margin: "2.1e-9 K".
    pub(super) fn proven_error(&self, i: usize) -> String {
        let bound = self.proof.as_ref().and_then(|proof| proof.bound(i));
        let text = |bound| format!("{}{}", rounded_up(bound), spaced(&self.unit(i)));
        bound.map_or_else(|| "-".to_owned(), text)
    }

    /// " (proven)" if the verdict of a requirement is.
    pub(super) fn is_proven(&self, i: usize) -> &'static str {
        let proven = self.proof.as_ref().and_then(|proof| proof.is_proven(i));
        if proven == Some(true) { " (proven)" } else { "" }
    }

    /// True if the answer, or the value instead of it, keeps everything with proof.
    pub(super) fn can_be_proven(&self) -> bool {
        let proof = self.proof.as_ref();
        proof.is_some_and(|proof| proof.judged.is_proven() || proof.instead.is_some())
    }

    /// The number of the sized parameter that keeps everything with proof, if the answer does not.
    pub(super) fn instead(&self) -> Option<f64> {
        self.proof.as_ref()?.instead.as_ref().map(|(number, _)| *number)
    }

    /// The requirements whose verdict has this result, by their texts.
    fn these(&self, proof: &Proof, wanted: Option<bool>) -> Option<String> {
        let these = self.all().into_iter().filter(|i| proof.is_proven(*i) == wanted);
        let names: Vec<String> = these.map(|i| self.text(i)).collect();
        (!names.is_empty()).then(|| list_of(&names, "requirements"))
    }

    /// Doubts in the proof of the answer.
    pub(super) fn doubts(&self) -> Vec<Diagnostic> {
        let Some(proof) = &self.proof else { return Vec::new() };
        if let Some(reason) = &proof.judged.unproven {
            return vec![proven::doubt(reason)];
        }
        let open = self.these(proof, Some(false)).map(|names| {
            let text = format!("not proven: {names}: the margin is smaller than its proven error");
            let help = match &proof.instead {
                Some((_, value)) => format!("{value} keeps every requirement with proof"),
                None => "require a little more than is needed: then the need is proven".into(),
            };
            Diagnostic::warning("size::undecided", text).help(help)
        });
        let none = self.these(proof, None).map(|names| {
            let text = format!("the margins of {names} have no proven error");
            Diagnostic::warning("size::no_bound", text)
                .help("a probability, and numbers of gears, are estimates: leave out --certify")
        });
        open.into_iter().chain(none).collect()
    }

    /// Meaning of the bounds, and the doubts.
    pub(super) fn notes(&self) -> Vec<String> {
        let Some(proof) = &self.proof else { return Vec::new() };
        let proven = self.these(proof, Some(true)).map(|names| {
            format!("proven: {names}: the exact solution has the same verdict at this answer")
        });
        let doubt = |doubt: Diagnostic| match doubt.help {
            Some(help) => format!("{}; {help}", doubt.message),
            None => doubt.message,
        };
        proven.into_iter().chain(self.doubts().into_iter().map(doubt)).collect()
    }

    /// The proof as members: the margin of each requirement of the answer with its bound.
    pub(super) fn proof_members(&self) -> Option<Value> {
        let proof = self.proof.as_ref()?;
        let one = |i: usize| {
            let mut member = json!({
                "requirement": self.requirement(i).text,
                "margin": SiValue::new(proof.shown[i], &self.unit(i)),
                "margin_bound": proof.bound(i).map(|bound| SiValue::new(bound, &self.unit(i))),
                "is_proven": proof.is_proven(i),
            });
            if let Some(case) = self.case(i) {
                member["case"] = case.into();
            }
            member
        };
        let margins: Vec<Value> = self.all().into_iter().map(one).collect();
        Some(json!({ "margins": margins, "instead": proof.instead.as_ref().map(|(_, text)| text) }))
    }
}
