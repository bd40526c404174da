//! The proof of an answer.

use lptn_study::Judged;

/// The proof of an answer.
#[derive(Debug)]
pub(super) struct Proof {
    /// The results of the answer, with proven bounds.
    pub(super) judged: Judged,
    /// The margins that are shown, in SI units: a run breaks a limit only by more than its error.
    pub(super) shown: Vec<f64>,
    /// The value with the most digits of the sized parameter that keeps everything with proof, if
    /// the answer itself does not, as a number and "G = 3.410001 W/K".
    pub(super) instead: Option<(f64, String)>,
}

impl Proof {
    /// A bound on the error of a margin in SI units.
    pub(super) fn bound(&self, i: usize) -> Option<f64> {
        let proven = self.judged.proven.get(i).copied().flatten()?;
        Some(proven.bound(self.shown[i]))
    }

    /// True if the verdict of a requirement is proven; `None` without bounds.
    pub(super) fn is_proven(&self, i: usize) -> Option<bool> {
        let kept = self.judged.proven.get(i).copied().flatten()?.kept();
        Some(kept == Some(self.shown[i] >= 0.0))
    }
}
