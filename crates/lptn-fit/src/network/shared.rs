//! Noise that the columns of one record share: of thermocouples on one cold junction, of an
//! amplifier, or because the temperature of the room moves and is in no model.
//!
//! It does not average out over the columns. Each of them is taken as independent values of unit
//! variance ([`Whitened`]), which make up its own noise; these are compared at the same times. The
//! covariance of two columns is then that correlation times the product of their roots. The whole
//! is a covariance as well, and that of a column with itself is unchanged.
//!
//! The correlations come from whitened residuals, for which chance is 1/n whatever the noise.
//! Common noise may be slow next to white noise of each column, so means of four are tried too.
//! Principal columns would mix noises of different kinds.

use lptn_integrate::vectors::{dot, norm};

use crate::noise::Whitened;

/// Noise that columns of a record share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedNoise {
    /// Index of the record.
    pub run: usize,
    /// The largest correlation of the noise of two of its columns at the same times, by size.
    pub correlation: f64,
}

/// Largest number of times that are compared. Longer records use means over some of them.
const MOST: usize = 200;

/// Minimum number of times for a comparison.
const LEAST: usize = 6;

/// Common noise may be slow next to the columns' own noise. Fewer values by this factor then show
/// it, if enough are left.
const COARSE: usize = 4;
const LEAST_COARSE: usize = 12;

/// From this number of times on, an estimated correlation is taken as it is. For fewer, the part is
/// left out that chance causes in independent columns (J. Schaefer, K. Strimmer, Statistical
/// Applications in Genetics and Molecular Biology 4 (2005) 32).
const ENOUGH: f64 = 30.0;

/// A correlation is reported beyond this number of standard deviations of chance, and above this
/// size.
const CLEARLY: f64 = 4.0;
const WORTH: f64 = 0.2;

/// The columns of one record and the correlations of their noise.
pub(crate) struct Shared {
    pub(crate) run: usize,
    /// Indices of the columns among those of the errors.
    pub(crate) columns: Vec<usize>,
    compared: Compared,
    /// The part of the correlations that counts.
    part: f64,
    /// For each column and parameter, the part of `J^T r` from the independent value of each time.
    loads: Vec<Vec<Vec<f64>>>,
}

/// Columns at the same times.
struct Compared {
    /// For each column the index of each of its values among the times.
    places: Vec<Vec<usize>>,
    times: usize,
    /// Row by row.
    correlations: Vec<f64>,
}

impl Shared {
    /// `None` without two columns with enough values.
    pub(crate) fn of(run: usize, columns: Vec<(usize, &Whitened)>) -> Option<Self> {
        let (columns, whitened): (Vec<usize>, Vec<&Whitened>) = columns.into_iter().unzip();
        let longest = whitened.iter().map(|column| column.times.len()).max()?.min(MOST);
        if columns.len() < 2 || longest < LEAST {
            return None;
        }
        let mut compared = Compared::at(&whitened, longest);
        if longest / COARSE >= LEAST_COARSE {
            let coarse = Compared::at(&whitened, longest / COARSE);
            if coarse.beyond_chance() > compared.beyond_chance() {
                compared = coarse;
            }
        }
        let of_column = |(column, places): (&&Whitened, &Vec<usize>)| {
            column.loads.iter().map(|load| summed(load, places, compared.times)).collect()
        };
        let loads = whitened.iter().zip(&compared.places).map(of_column).collect();
        let part = compared.part();
        (part > 0.0).then_some(Self { run, columns, compared, part, loads })
    }

    /// Contribution to `J^T Omega J`.
    pub(crate) fn middle(&self) -> Vec<f64> {
        let n = self.loads.first().map_or(0, Vec::len);
        let mut middle = vec![0.0; n * n];
        for (c, own) in self.loads.iter().enumerate() {
            let others: Vec<Vec<f64>> = (0..n).map(|b| self.others(c, b)).collect();
            for (at, sum) in middle.iter_mut().enumerate() {
                *sum += dot(&own[at / n], &others[at % n]);
            }
        }
        middle
    }

    /// Common part of the other columns with one, at each time for a parameter.
    fn others(&self, column: usize, parameter: usize) -> Vec<f64> {
        let mut sum = vec![0.0; self.compared.times];
        for (d, loads) in self.loads.iter().enumerate().filter(|(d, _)| *d != column) {
            let part = self.counted(column, d);
            sum.iter_mut().zip(&loads[parameter]).for_each(|(sum, load)| *sum += part * load);
        }
        sum
    }

    /// Contribution to the variance of a parameter that `J^T r` moves by these weights, and half of
    /// its uncertainty, as a variance.
    pub(crate) fn variance(&self, weights: &[f64]) -> (f64, f64) {
        let of_column = |loads: &Vec<Vec<f64>>| {
            let mut sum = vec![0.0; self.compared.times];
            for (load, weight) in loads.iter().zip(weights) {
                sum.iter_mut().zip(load).for_each(|(sum, x)| *sum += weight * x);
            }
            sum
        };
        let felt: Vec<Vec<f64>> = self.loads.iter().map(of_column).collect();
        let times = self.compared.times as f64;
        let (mut adds, mut uncertain) = (0.0, 0.0);
        for (c, d) in self.pairs() {
            let (common, alike) = (dot(&felt[c], &felt[d]), self.alike(c, d));
            adds += self.counted(c, d) * common;
            uncertain += (self.part * common * (1.0 - alike * alike)).powi(2) / times;
        }
        (adds, uncertain)
    }

    /// The correlation of two columns by their index in this record.
    pub(crate) fn alike(&self, c: usize, d: usize) -> f64 {
        self.compared.correlations[c * self.columns.len() + d]
    }

    /// The part of it that counts.
    fn counted(&self, c: usize, d: usize) -> f64 {
        self.part * self.alike(c, d)
    }

    fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        pairs(self.columns.len())
    }

    /// The shared noise, if chance alone does not explain it.
    pub(crate) fn told(&self) -> Option<SharedNoise> {
        let all = self.pairs().map(|(c, d)| self.alike(c, d));
        let correlation = all.max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        let beyond = correlation.abs() * (self.compared.times as f64).sqrt() > CLEARLY;
        (beyond && correlation.abs() > WORTH).then_some(SharedNoise { run: self.run, correlation })
    }
}

impl Compared {
    /// All columns at this number of times: means of neighbours if there are more.
    fn at(columns: &[&Whitened], times: usize) -> Self {
        let mut all: Vec<f64> = columns.iter().flat_map(|column| &column.times).copied().collect();
        all.sort_by(f64::total_cmp);
        all.dedup();
        let place =
            |time: &f64| all.partition_point(|other| other < time) * times / all.len().max(times);
        let places: Vec<Vec<usize>> =
            columns.iter().map(|column| column.times.iter().map(place).collect()).collect();
        let one = |(column, places): (&&Whitened, &Vec<usize>)| {
            let values = summed(&column.residuals, places, times);
            let norm = norm(&values);
            let unit = if norm > 0.0 && norm.is_finite() { norm.recip() } else { 0.0 };
            values.iter().map(|value| value * unit).collect()
        };
        let values: Vec<Vec<f64>> = columns.iter().zip(&places).map(one).collect();
        let count = columns.len();
        let product = |at: usize| dot(&values[at / count], &values[at % count]);
        let correlations = (0..count * count).map(product).collect();
        Self { places, times, correlations }
    }

    /// The sum of the squares of the correlations of pairs, and its value by chance.
    fn squares(&self) -> (f64, f64) {
        let count = self.places.len();
        let square = |(c, d): (usize, usize)| self.correlations[c * count + d].powi(2);
        let chance = (count * (count - 1)) as f64 / self.times as f64;
        (pairs(count).map(square).sum(), chance)
    }

    fn beyond_chance(&self) -> f64 {
        let (squares, chance) = self.squares();
        squares - chance
    }

    /// The part of the correlations that counts, in 0..1.
    fn part(&self) -> f64 {
        let (squares, chance) = self.squares();
        if squares <= 0.0 {
            return 0.0;
        }
        1.0 - (chance / squares).min(1.0) * (ENOUGH / self.times as f64).min(1.0)
    }
}

/// All pairs of two, in both orders.
fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |c| (0..count).filter(move |&d| d != c).map(move |d| (c, d)))
}

/// Combines the independent values of unit variance at each time into one.
fn summed(values: &[f64], places: &[usize], times: usize) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0_f64); times];
    for (value, &place) in values.iter().zip(places) {
        sums[place].0 += value;
        sums[place].1 += 1.0;
    }
    sums.iter().map(|(sum, count)| sum / count.sqrt().max(1.0)).collect()
}
