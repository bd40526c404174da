//! The ladder of capacities and resistances.

use std::f64::consts::PI;

use num_complex::Complex64 as Complex;

use super::error::{self, LadderError};
use super::quotients::Quotients;

/// A thermal impedance as a ladder, port first: a capacity from the port to the reference, a
/// resistance to the next rung, its capacity, and so on; the last resistance leads to the
/// reference.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Cauer {
    /// Capacity in J/K and the resistance in K/W after it, port first.
    pub rungs: Vec<(f64, f64)>,
    /// A resistance in front of the first capacity in K/W: 0 unless the port is massless.
    pub direct: f64,
}

/// Points of the contour on which a step response is found.
const POINTS: u32 = 28;

impl Cauer {
    /// A ladder of rungs (capacity in J/K, resistance in K/W), port first.
    ///
    /// # Errors
    /// [`LadderError::Empty`], [`LadderError::NotPositive`], [`LadderError::Direct`].
    pub fn new(rungs: Vec<(f64, f64)>, direct: f64) -> Result<Self, LadderError> {
        error::direct(direct)?;
        if rungs.is_empty() {
            return Err(LadderError::Empty { form: "Cauer ladder", parts: "rungs" });
        }
        for (row, &(capacity, resistance)) in rungs.iter().enumerate() {
            error::positive("capacity", row, capacity)?;
            error::positive("resistance", row, resistance)?;
        }
        Ok(Self { rungs, direct })
    }

    /// The steady rise in K for 1 W: `direct` and all resistances, in K/W.
    pub fn resistance(&self) -> f64 {
        self.direct + self.rungs.iter().map(|rung| rung.1).sum::<f64>()
    }

    /// `Z(j omega)` in K/W at an angular frequency in rad/s, from the continued fraction: its
    /// magnitude is the amplitude of the temperature for heat that swings with 1 W, its angle
    /// (negative) by how much it lags.
    pub fn impedance(&self, omega: f64) -> Complex {
        let fraction = self.fraction(&Quotients::of_ladder(&self.rungs), Complex::new(0.0, omega));
        fraction + self.direct
    }

    /// `Z_th` in K/W at a time in s after a step of heat; 0 before it, `direct` at 0.
    ///
    /// Found by integration of `Z(s)/s` along a contour around the poles (J. A. C. Weideman,
    /// Optimizing Talbot's contours for the inversion of the Laplace transform, SIAM J. Numer.
    /// Anal. 44 (2006) 2342), so the time constants need not be known and this checks a conversion
    /// independently. The relative error is 1e-13. For many times, `self.foster()?.step(time)` is
    /// quicker.
    pub fn step(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return if time < 0.0 { 0.0 } else { self.direct };
        }
        let quotients = Quotients::of_ladder(&self.rungs);
        let sum: f64 =
            contour(time).map(|(s, weight)| (weight * self.fraction(&quotients, s) / s).im).sum();
        self.direct + sum
    }

    /// The continued fraction at `s` in 1/s, in K/W. `h_i = C_i Z_i` is a time: if elements differ
    /// by hundreds of decades, squares of the elements themselves would overflow.
    fn fraction(&self, quotients: &Quotients, s: Complex) -> Complex {
        let start = Complex::new(0.0, 0.0);
        let rungs = quotients.q.iter().zip(&quotients.e).rev();
        rungs.fold(start, |h, (q, e)| (s + (h * *e + 1.0).inv() * *q).inv()) / self.rungs[0].0
    }
}

/// Points `s` in 1/s above the real axis with weights whose sum, imaginary parts taken, is the
/// inverse Laplace transform at `time`.
fn contour(time: f64) -> impl Iterator<Item = (Complex, Complex)> {
    let n = f64::from(POINTS);
    let scale = n / time;
    (0..POINTS / 2).map(move |k| {
        let angle = (2.0 * f64::from(k) + 1.0) * PI / n;
        let (sine, cosine) = (0.6407 * angle).sin_cos();
        let z = Complex::new(0.5017 * angle * cosine / sine - 0.6122, 0.2645 * angle);
        let slope = 0.5017 * (cosine / sine - 0.6407 * angle / (sine * sine));
        // 1/(2 pi i) times dz, both halves of the contour: 2/n times the imaginary part
        (z * scale, (z * n).exp() * Complex::new(slope, 0.2645) * (2.0 / n) * scale)
    })
}
