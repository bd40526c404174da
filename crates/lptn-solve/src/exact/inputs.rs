//! The inputs of a network between two times, as Legendre series.

use lptn_network::{Evaluation, InputError, Network};
use lptn_units::Degree;

use super::legendre::{Rule, TERMS, value};

/// Points at which a series is compared with its input: the ends, and points that no rule has.
const CHECKS: [f64; 5] = [-1.0, -0.8372, -0.1193, 0.5741, 1.0];

/// The boundaries, as rises over one temperature, and the sources of a network.
pub(crate) struct Inputs<'a> {
    network: &'a Network,
    scope: Evaluation,
    /// Temperature in K that boundaries are counted from.
    reference: f64,
    forms: Vec<Degree>,
    rule: Rule,
    /// Comparisons of `t` are read here.
    pub(crate) inside: f64,
}

/// The inputs on one panel.
pub(crate) struct Panel {
    /// For every input the coefficients of its Legendre series.
    pub(crate) series: Vec<Vec<f64>>,
    /// Largest distance of a series from its input; 0 for a constant and for a straight line.
    pub(crate) errors: Vec<f64>,
}

impl Panel {
    /// Terms of the longest series.
    pub(crate) fn terms(&self) -> usize {
        self.series.iter().map(Vec::len).max().unwrap_or(0)
    }
}

impl<'a> Inputs<'a> {
    pub(crate) fn new(network: &'a Network, reference: f64) -> Self {
        let boundaries = network.boundaries().iter().map(|b| network.course(&b.temperature));
        let forms =
            boundaries.chain(network.source_ids().map(|id| network.course_of_source(id))).collect();
        let rule = Rule::new();
        Self { network, scope: network.evaluation(), reference, forms, rule, inside: 0.0 }
    }

    /// True if some input is neither constant nor a straight line between its breakpoints.
    pub(crate) fn need_quadrature(&self) -> bool {
        self.forms.contains(&Degree::Nonlinear)
    }

    /// Terms of the longest series that an input may need.
    pub(crate) fn terms(&self) -> usize {
        let of = |form: &Degree| match form {
            Degree::Constant => 1,
            Degree::Affine => 2,
            Degree::Nonlinear => TERMS,
        };
        self.forms.iter().map(of).max().unwrap_or(0)
    }

    /// Number of boundaries; they come first.
    pub(crate) fn boundaries(&self) -> usize {
        self.network.boundaries().len()
    }

    /// All inputs at `time` [s].
    pub(crate) fn at(&mut self, time: f64) -> Result<Vec<f64>, InputError> {
        let boundaries = self.boundaries();
        let mut values = vec![0.0; self.forms.len()];
        self.scope.set_time(time, self.inside);
        self.network.boundary_temperatures(&mut self.scope, &mut values[..boundaries])?;
        self.network.source_powers(&mut self.scope, &mut values[boundaries..])?;
        values[..boundaries].iter_mut().for_each(|t| *t -= self.reference);
        Ok(values)
    }

    /// The inputs between two times.
    pub(crate) fn panel(&mut self, (from, to): (f64, f64)) -> Result<Panel, InputError> {
        let (first, last) = (self.at(from)?, self.at(to)?);
        let mut panel = Panel { series: Vec::new(), errors: vec![0.0; first.len()] };
        for (i, form) in self.forms.iter().enumerate() {
            let (mean, slope) = (0.5 * (first[i] + last[i]), 0.5 * (last[i] - first[i]));
            panel.series.push(match form {
                Degree::Constant => vec![first[i]],
                Degree::Affine | Degree::Nonlinear => vec![mean, slope],
            });
        }
        if self.need_quadrature() {
            self.fit((from, to), &mut panel)?;
        }
        Ok(panel)
    }

    /// Replaces the straight lines of curved inputs by longer series.
    fn fit(&mut self, span: (f64, f64), panel: &mut Panel) -> Result<(), InputError> {
        let points = self.rule.points;
        let samples = self.sample(span, &points)?;
        let checks = self.sample(span, &CHECKS)?;
        for i in (0..self.forms.len()).filter(|&i| self.forms[i] == Degree::Nonlinear) {
            let mut values = [0.0; TERMS];
            values.iter_mut().zip(&samples).for_each(|(value, all)| *value = all[i]);
            let series = self.rule.series(&values);
            let tail = series[TERMS - 2].abs() + series[TERMS - 1].abs();
            let missed =
                CHECKS.iter().zip(&checks).map(|(&x, all)| (value(&series, x) - all[i]).abs());
            panel.errors[i] = missed.fold(tail, f64::max);
            panel.series[i] = series.to_vec();
        }
        Ok(())
    }

    fn sample(
        &mut self,
        (from, to): (f64, f64),
        places: &[f64],
    ) -> Result<Vec<Vec<f64>>, InputError> {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        places.iter().map(|x| self.at((middle + half * x).clamp(from, to))).collect()
    }
}
