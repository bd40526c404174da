//! From one form to the other.

use super::cauer::Cauer;
use super::error::LadderError;
use super::foster::Foster;
use super::quotients::Quotients;
use super::rates::rates;
use super::shares::pole;

impl Foster {
    /// The ladder with the same impedance: as many rungs as there are time constants, each element
    /// to about 1e-13. It takes some n^2 divisions.
    ///
    /// # Errors
    /// [`LadderError::Range`] if an element is too large or too small for a number, as with 200
    /// time constants within a factor of two.
    pub fn cauer(&self) -> Result<Cauer, LadderError> {
        let (quotients, total) = Quotients::of_terms(&self.terms);
        let rungs = quotients.ladder(total);
        // zero, infinite, or so small that digits are lost
        if !rungs.iter().all(|rung| rung.0.is_normal() && rung.1.is_normal()) {
            return Err(LadderError::Range { form: "Cauer ladder" });
        }
        Cauer::new(rungs, self.direct)
    }
}

/// Share of the resistance, or of the rate at which the port begins to warm, that a chain may
/// differ from its ladder.
const DIFFERENCE: f64 = 1e-8;

impl Cauer {
    /// The sum of exponentials with the same impedance, each time constant to about 1e-14 and each
    /// resistance to that over the relative distance to the nearest time constant. There are as
    /// many terms as rungs, less those of far and fast rungs whose weight is below 1e-300, too
    /// small for a number.
    ///
    /// The steady rise and the rate at which the port begins to warm are compared with those of
    /// the ladder.
    ///
    /// # Errors
    /// [`LadderError::Close`] if one differs by more than 1e-8: two time constants are so close
    /// that their shares cannot be distinguished. [`LadderError::Range`] if the products of
    /// resistances and capacities are too large or too small for a number.
    pub fn foster(&self) -> Result<Foster, LadderError> {
        let range = LadderError::Range { form: "Foster chain" };
        let quotients = Quotients::of_ladder(&self.rungs);
        if !quotients.q.iter().all(|q| q.is_normal()) {
            return Err(range);
        }
        let total = 1.0 / self.rungs[0].0;
        let term = |rate: f64| {
            let (rate, share) = pole(&quotients, rate);
            (total * share / rate, 1.0 / rate)
        };
        let rates = rates(&quotients).ok_or(range)?;
        let mut terms: Vec<(f64, f64)> = rates.into_iter().map(term).collect();
        terms.retain(|term| term.0.is_normal());
        let foster = Foster::new(self.direct, &terms)?;
        self.compare(&foster)?;
        Ok(foster)
    }

    /// Checks that the chain begins and ends as the ladder does.
    fn compare(&self, foster: &Foster) -> Result<(), LadderError> {
        let begins: f64 = foster.terms.iter().map(|(resistance, tau)| resistance / tau).sum();
        let ends: f64 = foster.terms.iter().map(|term| term.0).sum();
        let steady: f64 = self.rungs.iter().map(|rung| rung.1).sum();
        let error = (begins * self.rungs[0].0 - 1.0).abs().max((ends / steady - 1.0).abs());
        if error <= DIFFERENCE { Ok(()) } else { Err(LadderError::Close { error }) }
    }
}
