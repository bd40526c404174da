//! Means over windows, by Gauss's rule on pieces between jumps, halved until two rules agree.

use std::cell::OnceCell;

use lptn::prelude::*;

use super::answer::{Laboratory, Trouble, temperature};
use super::case::Case;
use super::expected::{Expected, Quantity};

/// Points and weights of the Gauss-Legendre rule of order 16 on (-1, 1), one half (Abramowitz and
/// Stegun, table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];

/// Halvings of the pieces before it is given up.
const HALVINGS: usize = 8;

/// Two rules have to agree to this share of what the value allows.
const SHARE: f64 = 1e-2;

/// The runs that serve all windows of a case.
pub struct Means {
    windows: Vec<(f64, f64)>,
    /// For each number of halvings a run with rows at all points.
    runs: [OnceCell<Result<Solution, Trouble>>; HALVINGS],
}

fn window(expected: &Expected) -> Option<(f64, f64)> {
    match expected.quantity {
        Quantity::MeanTemperature { t0, t1, .. } | Quantity::MeanBoundaryHeat { t0, t1, .. } => {
            Some((t0, t1))
        }
        _ => None,
    }
}

impl Means {
    pub fn new(case: &Case) -> Self {
        let windows = case.expected.iter().filter_map(window).collect();
        Self { windows, runs: std::array::from_fn(|_| OnceCell::new()) }
    }

    pub fn answer(&self, laboratory: &Laboratory<'_>, expected: &Expected) -> Result<f64, Trouble> {
        let mut before = f64::NAN;
        for halvings in 0..HALVINGS {
            let now = self.mean(laboratory, expected, halvings)?;
            if (now - before).abs() <= SHARE * expected.allowed() {
                return Ok(now);
            }
            before = now;
        }
        Err("the mean does not settle".into())
    }

    fn mean(
        &self,
        laboratory: &Laboratory<'_>,
        expected: &Expected,
        halvings: usize,
    ) -> Result<f64, Trouble> {
        let run = || {
            let points = self.windows.iter().flat_map(|w| points(laboratory.case, *w, halvings));
            laboratory.run_at(points.map(|(t, _)| t).collect())
        };
        let solution = self.runs[halvings].get_or_init(run).as_ref().map_err(Trouble::clone)?;
        let window = window(expected).ok_or("no window")?;
        let values: Vec<f64> = match &expected.quantity {
            Quantity::MeanBoundaryHeat { node, .. } => {
                solution.boundary_heat(laboratory.boundary(node)?).ok_or("no heat")?
            }
            Quantity::MeanTemperature { node, .. } => {
                let end = laboratory.end_named(node)?;
                let rows = 0..solution.times().len();
                let zero = laboratory.case.zero();
                rows.filter_map(|row| Some(temperature(solution, end, row)? - zero)).collect()
            }
            _ => return Err("no mean".into()),
        };
        let mut sum = 0.0;
        for (time, weight) in points(laboratory.case, window, halvings) {
            let row = solution.times().binary_search_by(|t| t.total_cmp(&time));
            sum += weight * values[row.map_err(|_| format!("no row at {time} s"))?];
        }
        Ok(sum / (window.1 - window.0))
    }
}

/// Times and weights of a rule over a window: the pieces between jumps, each cut in `2^halvings`.
fn points(case: &Case, (from, to): (f64, f64), halvings: usize) -> Vec<(f64, f64)> {
    let mut cuts = case.breaks(from, to);
    cuts.extend([from, to]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let count = 1_u32 << halvings;
    let mut points = Vec::new();
    for pair in cuts.windows(2) {
        let half = 0.5 * (pair[1] - pair[0]) / f64::from(count);
        for k in 0..count {
            let middle = pair[0] + half * f64::from(2 * k + 1);
            for (x, weight) in GAUSS {
                points.push((middle - half * x, half * weight));
                points.push((middle + half * x, half * weight));
            }
        }
    }
    points
}
