//! The posterior of a step, for studies.

use lptn_netlist::{Posterior, PosteriorOf, PosteriorQuantity};
use lptn_units::statistics::student_95;
use lptn_units::{Correlations, Dimension, Spread};

use super::{Capacity, Power, StepFit};

/// A quantity, and its derivatives by the sources of its error.
struct Derived {
    name: &'static str,
    dimension: Dimension,
    value: f64,
    /// Derivatives by `T_i`, `T_f` and `t_RC`.
    fit: [f64; 3],
    /// Derivatives by other errors of the rise, and by the capacity.
    rise: f64,
    capacity: f64,
}

impl Power {
    /// `P_disp`, `R_eq` and, if it is not exact, `C_eq` with their covariance, random and
    /// systematic, as parameters of these names. The method models the machine as a body of `C_eq`
    /// that loses its heat over `R_eq`. `record` and `column` are the names of the data.
    pub fn posterior(
        &self,
        fit: &StepFit,
        capacity: Capacity,
        (record, column): (&str, &str),
    ) -> Posterior {
        let own = self.reference == "initial";
        let other = if own { 0.0 } else { self.reference_error };
        let deviations = [other.hypot(self.rise.systematic), capacity.deviation];
        let all = self.derived(fit, capacity.value, own);
        let all: Vec<Derived> = all
            .into_iter()
            .filter(|own| own.dimension != Dimension::CAPACITY || capacity.deviation > 0.0)
            .collect();
        let covariance = |a: &Derived, b: &Derived| between(fit, (a, b), deviations);
        let mut correlations = Correlations::none(all.len());
        for (i, a) in all.iter().enumerate() {
            for (j, b) in all[..i].iter().enumerate() {
                let sizes = (covariance(a, a) * covariance(b, b)).sqrt();
                correlations.set(i, j, covariance(a, b) / sizes);
            }
        }
        let quantities = all.iter().map(|own| own.quantity(fit, covariance(own, own).sqrt()));
        let quantities = quantities.collect();
        let (network, fit) = (record.to_owned(), column.to_owned());
        Posterior { network, fit, quantities, correlations }
    }

    fn derived(&self, fit: &StepFit, c: f64, own: bool) -> [Derived; 3] {
        let (tau, heat, resistance) = (fit.tau.value, self.power.value, self.resistance.value);
        // T_i takes part only if it is the reference
        let initial = if own { -c / tau } else { 0.0 };
        let of = |name, dimension, value| Derived {
            name,
            dimension,
            value,
            fit: [0.0; 3],
            rise: 0.0,
            capacity: 0.0,
        };
        [
            Derived {
                fit: [initial, c / tau, -heat / tau],
                rise: c / tau,
                capacity: heat / c,
                ..of("P_disp", Dimension::POWER, heat)
            },
            Derived {
                fit: [0.0, 0.0, 1.0 / c],
                capacity: -resistance / c,
                ..of("R_eq", Dimension::RESISTANCE, resistance)
            },
            Derived { capacity: 1.0, ..of("C_eq", Dimension::CAPACITY, c) },
        ]
    }
}

impl Derived {
    fn quantity(&self, fit: &StepFit, sigma: f64) -> PosteriorQuantity {
        let random = fit.random.estimated(self.value, &self.fit);
        // priors are exact (F. E. Satterthwaite, Biometrics Bulletin 2 (1946) 110)
        let share = (sigma / random.standard_error).powi(4);
        let degrees = Some(random.degrees_of_freedom * share).filter(|d| d.is_finite());
        PosteriorQuantity {
            name: self.name.to_owned(),
            of: PosteriorOf::Parameter,
            value: self.value,
            unit: self.dimension.si_unit(),
            spread: Some(Spread::normal(sigma)),
            half_width: Some(student_95(degrees.unwrap_or(f64::INFINITY)) * sigma),
            degrees_of_freedom: degrees,
            bounds: (0.0, f64::INFINITY),
            prior: None,
        }
    }
}

/// The covariance of two, with the standard deviations of the rise and of the capacity.
fn between(fit: &StepFit, (a, b): (&Derived, &Derived), [rise, capacity]: [f64; 2]) -> f64 {
    let of_fit = |i: usize, j: usize| fit.covariance().between(i, j).unwrap_or(0.0);
    let random: f64 = (0..9).map(|k| a.fit[k / 3] * of_fit(k / 3, k % 3) * b.fit[k % 3]).sum();
    random + a.rise * b.rise * rise * rise + a.capacity * b.capacity * capacity * capacity
}
