//! Modes of `C dT/dt = -G T`: eigenvalues and vectors of `C^-1/2 G C^-1/2`, island by island.
//!
//! Rates are Rayleigh quotients summed over paths, which keeps slow ones exact next to fast ones.
//! Slow modes are diagonalised again among themselves, from sums over paths. A dense solver mixes
//! modes whose rates differ by less than the rounding of the fastest.

use faer::Mat;
use lptn_integrate::dense;

use super::ExactError;
use super::reduced::Reduced;

/// States that are joined to each other and to no others, with their modes, slowest first.
#[derive(Clone, Debug)]
pub(crate) struct Island {
    /// The states, ascending.
    pub(crate) members: Vec<usize>,
    /// Rate of each mode in 1/s; exactly 0 for the mean of an island without a way to a boundary.
    pub(crate) rates: Vec<f64>,
    /// Temperature of each member (row) in each mode (column), such that the sum of `C x^2` is 1 J
    /// K.
    pub(crate) shapes: Mat<f64>,
}

/// The islands of a network without streams, in the order of their first states.
pub(crate) fn islands(reduced: &Reduced, boundaries: usize) -> Result<Vec<Island>, ExactError> {
    let ties = reduced.ties(boundaries);
    groups(reduced).into_iter().map(|members| Island::of(reduced, &ties, members)).collect()
}

impl Island {
    /// The modes of states that no stream joins; `ties`: [`Reduced::ties`].
    pub(crate) fn of(
        reduced: &Reduced,
        ties: &[f64],
        members: Vec<usize>,
    ) -> Result<Self, ExactError> {
        Part::new(reduced, ties, members).solve()
    }
}

/// States that are joined to each other and to no others, ascending, in the order of their first.
pub(crate) fn groups(reduced: &Reduced) -> Vec<Vec<usize>> {
    let numbers = numbering(reduced);
    let count = numbers.iter().max().map_or(0, |last| last + 1);
    let mut groups = vec![Vec::new(); count];
    numbers.into_iter().enumerate().for_each(|(i, number)| groups[number].push(i));
    groups
}

/// For each state the number of its island, from 0 in the order of appearance.
fn numbering(reduced: &Reduced) -> Vec<usize> {
    let n = reduced.states.len();
    let mut neighbours = vec![Vec::new(); n];
    for &(a, b, _) in reduced.links.iter().chain(&reduced.streams) {
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    let mut numbers = vec![usize::MAX; n];
    let mut count = 0;
    for first in 0..n {
        let mut open = vec![first];
        let known = numbers[first] != usize::MAX;
        while let Some(i) = open.pop().filter(|_| !known) {
            if numbers[i] == usize::MAX {
                numbers[i] = count;
                open.extend(&neighbours[i]);
            }
        }
        count += usize::from(!known);
    }
    numbers
}

/// Modes slower than this share of the fastest are separated again: the eigenvectors of a dense
/// solver are right to rounding of the fastest rate over the distance of two rates.
const SLOW: f64 = 1e-2;

/// Paths whose differences are multiplied at once.
const CHUNK: usize = 512;

/// One island by itself.
struct Part {
    members: Vec<usize>,
    root: Vec<f64>,
    links: Vec<(usize, usize, f64)>,
    ties: Vec<f64>,
}

impl Part {
    fn new(reduced: &Reduced, ties: &[f64], members: Vec<usize>) -> Self {
        let root = members.iter().map(|&i| reduced.capacity[i].sqrt()).collect();
        let place = |i: usize| members.binary_search(&i).ok();
        let inside = |&(a, b, g): &(usize, usize, f64)| Some((place(a)?, place(b)?, g));
        let links = reduced.links.iter().filter_map(inside).collect();
        let ties = members.iter().map(|&i| ties[i]).collect();
        Self { members, root, links, ties }
    }

    fn solve(self) -> Result<Island, ExactError> {
        let n = self.members.len();
        let (_, mut vectors) =
            dense::symmetric_eigen(self.scaled().as_ref()).ok_or(ExactError::Modes)?;
        self.sharpen(&mut vectors)?;
        if self.is_loose() {
            self.take_out_the_mean(&mut vectors);
        }
        let shapes = self.shapes(&vectors, n);
        let mut rates: Vec<f64> = (0..n).map(|k| self.rate(&shapes, k)).collect();
        if self.is_loose() {
            rates[0] = 0.0;
        }
        Ok(Island { members: self.members, rates, shapes })
    }

    fn is_loose(&self) -> bool {
        self.ties.iter().all(|&g| g == 0.0)
    }

    /// `C^-1/2 G C^-1/2`
    fn scaled(&self) -> Mat<f64> {
        let n = self.members.len();
        let mut a = Mat::zeros(n, n);
        for (i, g) in self.ties.iter().enumerate() {
            a[(i, i)] += g / (self.root[i] * self.root[i]);
        }
        for &(i, j, g) in &self.links {
            a[(i, i)] += g / (self.root[i] * self.root[i]);
            a[(j, j)] += g / (self.root[j] * self.root[j]);
            a[(i, j)] -= g / (self.root[i] * self.root[j]);
            a[(j, i)] -= g / (self.root[i] * self.root[j]);
        }
        a
    }

    /// Separates slow modes that the dense solver has mixed. Rounding mixes little of the fast
    /// modes into the slow ones, as much as a rounding error. It mixes slow ones with each other if
    /// their rates differ by less than rounding of the fastest. So `x' G x` of the slow ones,
    /// summed over paths and free of fast terms, is diagonalised by itself; and again the slow ones
    /// among these, until one is left.
    fn sharpen(&self, vectors: &mut Mat<f64>) -> Result<(), ExactError> {
        let mut count = vectors.ncols();
        loop {
            let shapes = self.shapes(vectors, count);
            let rates: Vec<f64> = (0..count).map(|k| self.rate(&shapes, k)).collect();
            let top = rates.iter().copied().fold(0.0, f64::max);
            count = rates.iter().take_while(|rate| **rate < SLOW * top).count();
            if count < 2 {
                return Ok(());
            }
            let among = self.among(&shapes, count);
            let (_, turn) = dense::symmetric_eigen(among.as_ref()).ok_or(ExactError::Modes)?;
            let turned = dense::product(vectors.subcols(0, count), turn.as_ref());
            vectors.subcols_mut(0, count).copy_from(&turned);
        }
    }

    fn shapes(&self, vectors: &Mat<f64>, count: usize) -> Mat<f64> {
        Mat::from_fn(self.root.len(), count, |i, k| vectors[(i, k)] / self.root[i])
    }

    /// `x_k' G x_l` of the first `count` modes as sums over paths.
    fn among(&self, shapes: &Mat<f64>, count: usize) -> Mat<f64> {
        let mut sum = Mat::zeros(count, count);
        for links in self.links.chunks(CHUNK) {
            let difference = Mat::from_fn(links.len(), count, |row, k| {
                let (i, j, g) = links[row];
                g.sqrt() * (shapes[(i, k)] - shapes[(j, k)])
            });
            sum += dense::product(difference.transpose(), difference.as_ref());
        }
        let tied =
            Mat::from_fn(self.ties.len(), count, |i, k| self.ties[i].sqrt() * shapes[(i, k)]);
        sum += dense::product(tied.transpose(), tied.as_ref());
        sum
    }

    /// The slowest mode of an island without an exit for heat is known: all at one temperature. The
    /// others are made orthogonal to it, so that they carry no heat to the last digit.
    fn take_out_the_mean(&self, vectors: &mut Mat<f64>) {
        let size = self.root.iter().map(|r| r * r).sum::<f64>().sqrt();
        for (i, root) in self.root.iter().enumerate() {
            vectors[(i, 0)] = root / size;
        }
        for k in 1..self.root.len() {
            let along: f64 = (0..self.root.len()).map(|i| vectors[(i, 0)] * vectors[(i, k)]).sum();
            for i in 0..self.root.len() {
                let mean = vectors[(i, 0)];
                vectors[(i, k)] -= along * mean;
            }
        }
    }

    /// Rayleigh's quotient as a sum of the heat of every path: positive terms, so that slow modes
    /// keep their digits next to fast ones, unlike the eigenvalues of a dense solver.
    fn rate(&self, shapes: &Mat<f64>, k: usize) -> f64 {
        let x = |i: usize| shapes[(i, k)];
        let links: f64 =
            self.links.iter().map(|&(i, j, g)| g * (x(i) - x(j)) * (x(i) - x(j))).sum();
        let ties: f64 = self.ties.iter().enumerate().map(|(i, g)| g * x(i) * x(i)).sum();
        let norm: f64 = self.root.iter().enumerate().map(|(i, r)| (r * x(i)) * (r * x(i))).sum();
        (links + ties) / norm
    }
}
