//! A piece of the curve of a heat content.

/// Coefficients of a panel: a polynomial of degree 8.
pub(super) const TERMS: usize = 9;

/// One over the orders that integration brings.
const RECIPROCALS: [f64; TERMS] =
    [1.0, 1.0 / 2.0, 1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0, 1.0 / 8.0, 1.0 / 9.0];

/// A piece of the curve. One of no width is latent heat that is taken up at one temperature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Panel {
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Heat content at `from`.
    pub(crate) heat: f64,
    /// Heat taken up between `from` and `to`.
    pub(crate) rise: f64,
    /// Capacity over `x`, which runs from -1 at `from` to 1 at `to`, by powers.
    capacity: [f64; TERMS],
    /// Number of coefficients that count.
    terms: usize,
}

impl Panel {
    /// A polynomial of `terms` coefficients between two temperatures in K.
    pub(super) fn new((from, to): (f64, f64), capacity: [f64; TERMS], terms: usize) -> Self {
        let mut panel = Self { from, to, heat: 0.0, rise: 0.0, capacity, terms };
        panel.rise = panel.taken_up(to);
        panel
    }

    /// Heat that is taken up at one temperature.
    pub(super) fn isothermal(temperature: f64, heat: f64) -> Self {
        let capacity = [f64::INFINITY; TERMS];
        Self { from: temperature, to: temperature, heat: 0.0, rise: heat, capacity, terms: 1 }
    }

    /// Raises the capacity by the same all over.
    pub(super) fn raise(&mut self, capacity: f64) {
        self.capacity[0] += capacity;
        self.rise = self.taken_up(self.to);
    }

    fn half(&self) -> f64 {
        0.5 * (self.to - self.from)
    }

    /// Counted from `from`, so that no digits are lost however narrow the panel is.
    fn x(&self, temperature: f64) -> f64 {
        if self.to > self.from { (temperature - self.from) / self.half() - 1.0 } else { -1.0 }
    }

    fn polynomial(&self, x: f64) -> f64 {
        self.capacity[..self.terms].iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    pub(crate) fn capacity_at(&self, temperature: f64) -> f64 {
        match self.to > self.from {
            true if self.terms == 1 => self.capacity[0],
            true => self.polynomial(self.x(temperature)),
            false => f64::INFINITY,
        }
    }

    /// The slope of the capacity in J/K^2.
    pub(crate) fn slope_at(&self, temperature: f64) -> f64 {
        if self.to <= self.from {
            return 0.0;
        }
        let x = self.x(temperature);
        let terms = self.capacity[..self.terms].iter().enumerate().skip(1).rev();
        terms.fold(0.0, |sum, (k, c)| sum * x + k as f64 * c) / self.half()
    }

    /// The mean capacity between two temperatures inside: `x1^k + x1^(k-1) x2 + … + x2^k` over
    /// `k + 1` is the mean of `x^k`, which loses no digits however near they are.
    pub(crate) fn mean(&self, from: f64, to: f64) -> f64 {
        let (first, second) = (self.x(from), self.x(to));
        let (mut power, mut powers, mut sum) = (1.0, 1.0, 0.0);
        for (c, over) in self.capacity.iter().zip(RECIPROCALS).take(self.terms) {
            sum += c * over * powers;
            power *= second;
            powers = powers * first + power;
        }
        sum
    }

    fn primitive(&self, x: f64) -> f64 {
        // slices are read backwards at once, an array by value from its first number on
        let terms = self.capacity[..self.terms].iter().zip(&RECIPROCALS[..self.terms]);
        x * terms.rev().fold(0.0, |sum, (c, over)| sum * x + c * over)
    }

    /// Heat taken up from `from` to `temperature`.
    pub(crate) fn taken_up(&self, temperature: f64) -> f64 {
        if self.to <= self.from {
            return 0.0;
        }
        self.half() * (self.primitive(self.x(temperature)) - self.primitive(-1.0))
    }

    /// The temperature at which this heat is taken up. The capacity is positive, so the heat grows
    /// strictly.
    pub(super) fn invert(&self, heat: f64) -> f64 {
        if self.terms == 1 {
            // an infinite capacity leaves `from`
            return (self.from + (heat / self.capacity[0]).max(0.0)).min(self.to);
        }
        if self.to <= self.from || heat <= 0.0 {
            return self.from;
        }
        if heat >= self.rise {
            return self.to;
        }
        let due = heat / self.half();
        let along = if self.terms == 2 { self.straight(due) } else { 1.0 + self.newton(due).0 };
        (self.from + self.half() * along).min(self.to)
    }

    /// `1 + x` at which the integral of a straight line is `due`: the root of a parabola, in the
    /// form that does not cancel.
    fn straight(&self, due: f64) -> f64 {
        let slope = self.capacity[1];
        let first = self.capacity[0] - slope;
        2.0 * due / (first + (first * first + 2.0 * slope * due).max(0.0).sqrt())
    }

    /// `x` at which the integral is `due`: Newton's method kept between the ends, until only
    /// rounding is missing. Also returns the number of steps.
    fn newton(&self, due: f64) -> (f64, u32) {
        let first = self.primitive(-1.0);
        let rounding = f64::EPSILON * (first.abs() + due);
        let enough = f64::EPSILON * self.to / self.half();
        let (mut low, mut high) = (-1.0, 1.0);
        let mut x = 2.0 * due * self.half() / self.rise - 1.0;
        for step in 0..60 {
            let missing = due - (self.primitive(x) - first);
            if missing.abs() <= rounding {
                return (x, step);
            }
            if missing > 0.0 {
                low = x
            } else {
                high = x
            }
            let next = x + missing / self.polynomial(x);
            let next = if next >= low && next <= high { next } else { 0.5 * (low + high) };
            let change = (next - x).abs();
            x = next;
            if change <= enough {
                return (x, step + 1);
            }
        }
        (x, 60)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It went on for 60 steps, as it halved the panel again wherever Newton's step was lost to
    /// rounding.
    #[test]
    fn an_inversion_ends_where_nothing_but_rounding_is_missing() {
        for (from, to) in [(250.0, 314.0), (273.05, 273.25), (300.0, 300.0 + 1e-9)] {
            let curved = [420.0, 310.0, 90.0, -20.0, 7.0, -3.0, 1.0, 0.3, 0.1];
            let panel = Panel::new((from, to), curved, TERMS);
            for i in 1..5000 {
                let due = panel.rise / panel.half() * f64::from(i) / 5000.0;
                let (x, steps) = panel.newton(due);
                assert!(steps <= 8, "{from} {to} {i}: {steps} steps");
                // no more than the last digit of the temperature
                let digit = 1000.0 * f64::EPSILON * (4.0 + to / panel.half());
                assert!(
                    (panel.primitive(x) - panel.primitive(-1.0) - due).abs() <= digit,
                    "{from} {to} {i}"
                );
            }
        }
    }

    /// Melting over an interval: a constant capacity needs no steps at all.
    #[test]
    fn a_straight_capacity_is_inverted_at_once() {
        for slope in [0.0, 1e-9, 300.0, -399.0] {
            let mut line = [0.0; TERMS];
            (line[0], line[1]) = (400.0, slope);
            let panel = Panel::new((273.05, 273.25), line, if slope == 0.0 { 1 } else { 2 });
            for share in [1e-9, 0.1, 0.5, 0.999] {
                let found = panel.invert(share * panel.rise);
                let back = panel.taken_up(found);
                assert!((back - share * panel.rise).abs() <= 1e-10 * panel.rise, "{slope} {share}");
            }
        }
    }
}
