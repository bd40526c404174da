//! The sum of exponentials.

use num_complex::Complex64 as Complex;

use super::error::{self, LadderError};

/// A thermal impedance as the sum of exponentials that a data sheet prints as its R-tau table:
/// `Z_th(t) = direct + sum of R_k (1 - exp(-t / tau_k))`.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Foster {
    /// Immediate rise in K for 1 W, in K/W: 0 unless the port is massless.
    pub direct: f64,
    /// Resistance in K/W and time constant in s of each term, fastest first, no time constant
    /// twice.
    pub terms: Vec<(f64, f64)>,
}

impl Foster {
    /// A chain of terms (resistance in K/W, time constant in s) in any order. Terms with the same
    /// time constant are one with the sum of their resistances, which is exact; those with
    /// different ones stay apart, however close they are.
    ///
    /// # Errors
    /// [`LadderError::Empty`], [`LadderError::NotPositive`] with the row as it was given,
    /// [`LadderError::Direct`].
    pub fn new(direct: f64, terms: &[(f64, f64)]) -> Result<Self, LadderError> {
        error::direct(direct)?;
        if terms.is_empty() {
            return Err(LadderError::Empty { form: "Foster chain", parts: "terms" });
        }
        for (row, &(resistance, tau)) in terms.iter().enumerate() {
            error::positive("resistance", row, resistance)?;
            error::positive("time constant", row, tau)?;
        }
        Ok(Self { direct, terms: merged(terms) })
    }

    /// The steady rise in K for 1 W: `direct` and all resistances, in K/W.
    pub fn resistance(&self) -> f64 {
        self.direct + self.terms.iter().map(|term| term.0).sum::<f64>()
    }

    /// `Z_th` in K/W at a time in s after a step of heat; 0 before it, `direct` at 0.
    pub fn step(&self, time: f64) -> f64 {
        if time < 0.0 {
            return 0.0;
        }
        // exp_m1: no digits are lost long before the time constant
        self.direct - self.terms.iter().map(|(r, tau)| r * (-time / tau).exp_m1()).sum::<f64>()
    }

    /// `Z(j omega)` in K/W at an angular frequency in rad/s: its magnitude is the amplitude of the
    /// temperature for heat that swings with 1 W, its angle (negative) by how much it lags.
    pub fn impedance(&self, omega: f64) -> Complex {
        let term = |&(r, tau): &(f64, f64)| {
            let lag = omega * tau;
            // r/(1 + j lag), such that lag^2 cannot overflow
            let cosine = 1.0 / lag.hypot(1.0);
            Complex::new(r * cosine * cosine, -r * (lag * cosine) * cosine)
        };
        self.terms.iter().map(term).fold(Complex::new(self.direct, 0.0), |sum, z| sum + z)
    }
}

/// Terms by their time constants, those with the same one as one.
fn merged(terms: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut sorted = terms.to_vec();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut merged: Vec<(f64, f64)> = Vec::with_capacity(sorted.len());
    for (resistance, tau) in sorted {
        match merged.last_mut() {
            Some(last) if last.1 >= tau => last.0 += resistance,
            _ => merged.push((resistance, tau)),
        }
    }
    merged
}
