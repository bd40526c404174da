//! Modes of a network near a state: dense if it is small, the slowest few by Lanczos iteration if
//! it is large and symmetric.

use faer::Mat;
use lptn_assembly::ThermalSystem;
use lptn_integrate::dense::{self, Complex, GeneralEigen};
use lptn_integrate::lanczos::{self, Eigenpair};
use lptn_integrate::{FactorError, linear};

use super::{Mode, Modes, ModesError, normalised, participation};
use crate::exact::Reduced;
use crate::linearised::Linearised;
use crate::snapshot::Snapshot;

/// Modes slower than the fastest by more than this are computed from the inverse, whose rounding is
/// relative to the slowest.
const SPREAD: f64 = 1e6;

/// The largest condition number of an eigenvalue. Beyond it, the false modes of a chain of equal
/// cells (the matrix is defective) cannot be distinguished from others.
const DEFECTIVE: f64 = 1e7;

impl Modes {
    /// The modes of a network, slowest first: the slowest `count` of a large one (more than 2000
    /// nodes), else all. A network that is not linear has them near a state, `at`.
    ///
    /// If streams or slopes make a network lack symmetry, modes may oscillate: a pair of them is
    /// one [`Mode`] with its [`Mode::omega`].
    ///
    /// # Errors
    /// [`ModesError`]; large networks without symmetry are refused.
    pub fn of(
        system: &ThermalSystem,
        at: Option<&Snapshot>,
        count: usize,
    ) -> Result<Self, ModesError> {
        let network = system.network();
        if network.first_nonlinear().is_none() && network.nodes().len() <= Reduced::MOST_NODES {
            return Ok(Self::solve(network)?);
        }
        let mut linear = Linearised::of(system, at)?;
        let modes = near(&linear, count)?;
        let tried = match modes.modes.first() {
            Some(mode) => linear.tried_along(&mode.shape)?,
            None => None,
        };
        Ok(Self { tried, ..modes })
    }
}

fn near(linear: &Linearised<'_>, count: usize) -> Result<Modes, ModesError> {
    let states = linear.capacity().len();
    if states <= Reduced::MOST_NODES {
        return dense_modes(linear);
    }
    match linear.is_symmetric() {
        true => slowest(linear, count),
        false => Err(ModesError::TooLarge { nodes: states }),
    }
}

/// All modes, from the dense matrix `C^-1/2 J C^-1/2`.
struct Dense {
    eigen: GeneralEigen,
    /// Left eigenvectors in the rows: the inverse of the right ones.
    left: Mat<Complex>,
    /// `C^1/2`
    root: Vec<f64>,
    /// Shares by which the massless nodes that are solved for (rows) follow each state (columns).
    follow: Mat<f64>,
}

impl Dense {
    fn of(linear: &Linearised<'_>) -> Result<Self, ModesError> {
        let (jacobian, follow) = linear.dense()?;
        let root: Vec<f64> = linear.capacity().iter().map(|c| c.sqrt()).collect();
        let scaled =
            Mat::from_fn(root.len(), root.len(), |i, j| jacobian[(i, j)] / (root[i] * root[j]));
        let loose = !linear.system().network().ungrounded().is_empty();
        let eigen = eigen_of(&scaled, loose)?;
        let left = dense::complex_inverse(&eigen.vectors).ok_or(ModesError::Defective)?;
        let found = Self { eigen, left, root, follow };
        let condition = |k: usize| length(&found.right(k)) * length(&found.left(k));
        match (0..found.root.len()).all(|k| condition(k) <= DEFECTIVE) {
            true => Ok(found),
            false => Err(ModesError::Defective),
        }
    }

    fn right(&self, k: usize) -> Vec<Complex> {
        (0..self.root.len()).map(|i| self.eigen.vectors[(i, k)]).collect()
    }

    fn left(&self, k: usize) -> Vec<Complex> {
        (0..self.root.len()).map(|i| self.left[(k, i)]).collect()
    }

    /// Temperatures of all nodes in a mode, massless ones recovered.
    fn nodes(&self, linear: &Linearised<'_>, k: usize) -> Vec<Complex> {
        let of_states: Vec<Complex> =
            self.right(k).iter().zip(&self.root).map(|(x, root)| x / root).collect();
        nodes(linear, &of_states, &self.follow)
    }
}

fn dense_modes(linear: &Linearised<'_>) -> Result<Modes, ModesError> {
    let found = Dense::of(linear)?;
    let mut modes = Vec::new();
    for (k, &value) in found.eigen.values.iter().enumerate().filter(|(_, value)| value.im >= 0.0) {
        let (right, left) = (found.right(k), found.left(k));
        let parts: Vec<f64> = right.iter().zip(&left).map(|(x, y)| (x * y).norm()).collect();
        let nodes = found.nodes(linear, k);
        modes.push(mode(linear, (value, nodes), &parts));
    }
    modes.sort_by(|a, b| a.rate.total_cmp(&b.rate));
    Ok(Modes { all: modes.len(), modes, tried: None })
}

/// Parts of the response to a step: `x_k` and `y_k` with `y_j x_k = 1` for `j = k`, else 0, and
/// both of a pair that oscillates.
pub(crate) struct Shapes {
    /// `-lambda_k` in 1/s.
    pub(crate) rates: Vec<Complex>,
    /// Temperatures of all nodes in each mode.
    pub(crate) right: Vec<Vec<Complex>>,
    /// Share of each mode in temperatures of the states.
    pub(crate) left: Vec<Vec<Complex>>,
}

impl Shapes {
    /// Temperatures of all nodes in the slowest mode, the largest of their size; real parts if it
    /// oscillates.
    pub(crate) fn slowest(&self) -> Vec<f64> {
        let modes = self.rates.iter().zip(&self.right);
        let slowest = modes.min_by(|a, b| a.0.re.total_cmp(&b.0.re));
        slowest.map_or_else(Vec::new, |(_, shape)| shape.iter().map(|z| z.re).collect())
    }
}

/// All modes of a network near a state; those of constants from their own matrices, which keep slow
/// ones next to much faster ones.
pub(crate) fn shapes(linear: &Linearised<'_>) -> Result<Shapes, ModesError> {
    let (system, states) = (linear.system(), linear.capacity().len());
    if states > Reduced::MOST_NODES {
        return Err(ModesError::TooLarge { nodes: states });
    }
    if system.network().first_nonlinear().is_none() {
        return Ok(of_constants(&Modes::solve(system.network())?, linear));
    }
    let found = Dense::of(linear)?;
    let left = |k: usize| -> Vec<Complex> {
        found.left(k).iter().zip(&found.root).map(|(y, root)| y * root).collect()
    };
    Ok(Shapes {
        rates: found.eigen.values.iter().map(|value| -value).collect(),
        left: (0..states).map(left).collect(),
        right: (0..states).map(|k| found.nodes(linear, k)).collect(),
    })
}

/// With symmetric conductances, `y` is `C x` over `x' C x`.
fn of_constants(modes: &Modes, linear: &Linearised<'_>) -> Shapes {
    let real = |x: f64| Complex::new(x, 0.0);
    let states = linear.system().states();
    let left = |mode: &Mode| -> Vec<Complex> {
        let weighed =
            || states.iter().zip(linear.capacity()).map(|(id, c)| c * mode.shape[id.index()]);
        let all: f64 = weighed().zip(states).map(|(y, id)| y * mode.shape[id.index()]).sum();
        weighed().map(|y| real(y / all)).collect()
    };
    Shapes {
        rates: modes.modes.iter().map(|mode| real(mode.rate)).collect(),
        right: modes
            .modes
            .iter()
            .map(|mode| mode.shape.iter().map(|&x| real(x)).collect())
            .collect(),
        left: modes.modes.iter().map(left).collect(),
    }
}

/// Eigenvalues and vectors; slow ones from the inverse if there is one. `loose`: some are zero.
fn eigen_of(scaled: &Mat<f64>, loose: bool) -> Result<GeneralEigen, ModesError> {
    let mut direct = dense::general_eigen(scaled.as_ref()).ok_or(ModesError::NotFound)?;
    direct.sort();
    let size = direct.values.len();
    let (Some(slowest), Some(fastest)) = (direct.values.first(), direct.values.last()) else {
        return Ok(direct);
    };
    let (slowest, fastest) = (slowest.norm(), fastest.norm());
    if loose {
        let rounding = 16.0 * size as f64 * f64::EPSILON * fastest;
        let lasting = direct.values.iter_mut().filter(|value| value.norm() <= rounding);
        lasting.for_each(|value| *value = Complex::new(0.0, 0.0));
        return Ok(direct);
    }
    if fastest <= SPREAD * slowest {
        return Ok(direct);
    }
    let identity = Mat::<f64>::identity(size, size);
    let inverse = dense::solve(scaled.as_ref(), identity.as_ref()).ok_or(ModesError::NotFound)?;
    let mut slow = dense::general_eigen(inverse.as_ref()).ok_or(ModesError::NotFound)?;
    slow.values.iter_mut().for_each(|value| *value = value.inv());
    slow.sort();
    let mut first_fast = slow.values.partition_point(|v| v.norm().powi(2) < slowest * fastest);
    if direct.values.get(first_fast).is_some_and(|value| value.im < 0.0) {
        first_fast += 1; // the second of a pair
    }
    for k in 0..first_fast {
        direct.values[k] = slow.values[k];
        direct.vectors.col_mut(k).copy_from(slow.vectors.col(k));
    }
    Ok(direct)
}

/// Temperatures of all nodes from those of the states.
fn nodes(linear: &Linearised<'_>, of_states: &[Complex], follow: &Mat<f64>) -> Vec<Complex> {
    let recovered = |of: &dyn Fn(&Complex) -> f64| {
        let mut unknowns: Vec<f64> = of_states.iter().map(of).collect();
        let following = (0..follow.nrows())
            .map(|i| (0..of_states.len()).map(|j| follow[(i, j)] * unknowns[j]).sum::<f64>());
        let following: Vec<f64> = following.collect();
        unknowns.extend(following);
        linear.recover(&unknowns)
    };
    let (real, imaginary) = (recovered(&|x| x.re), recovered(&|x| x.im));
    real.into_iter().zip(imaginary).map(|(re, im)| Complex::new(re, im)).collect()
}

/// A mode from its eigenvalue, the temperatures of all nodes and the parts of the states.
fn mode(linear: &Linearised<'_>, (value, nodes): (Complex, Vec<Complex>), parts: &[f64]) -> Mode {
    let participation = participation(linear.system().states(), parts, nodes.len());
    let rate = if value.re == 0.0 { 0.0 } else { -value.re };
    if value.im == 0.0 {
        let shape = normalised(nodes.into_iter().map(|z| z.re).collect());
        return Mode { rate, omega: 0.0, shape, phase: Vec::new(), participation };
    }
    let largest = nodes.iter().fold(0.0, |most: f64, z| most.max(z.norm()));
    let first = nodes.iter().copied().find(|z| z.norm() >= (1.0 - super::EQUAL) * largest);
    let unit = first.unwrap_or(Complex::new(1.0, 0.0));
    let turned: Vec<Complex> = nodes.iter().map(|z| z / unit).collect();
    Mode {
        rate,
        omega: value.im,
        shape: turned.iter().map(|z| z.norm()).collect(),
        phase: turned.iter().map(|z| if z.norm() == 0.0 { 0.0 } else { z.arg() }).collect(),
        participation,
    }
}

/// The slowest of a symmetric network, as the largest eigenvalues of
/// `C^1/2 (G + shift C)^-1 C^1/2`.
fn slowest(linear: &Linearised<'_>, count: usize) -> Result<Modes, ModesError> {
    let capacity = linear.capacity().to_vec();
    let root: Vec<f64> = capacity.iter().map(|c| c.sqrt()).collect();
    let lasting = lasting(linear, &root);
    let (pattern, mut values) = linear.conductances();
    let shift =
        if lasting.is_empty() { 0.0 } else { shift(pattern.diagonal(), &values, &capacity) };
    pattern.diagonal().iter().zip(&capacity).for_each(|(&slot, c)| values[slot] += shift * c);
    let mut factors = linear::for_steady(pattern, linear::LinearSolver::Auto)?;
    factors.factorize(&values)?;
    let mut apply = |x: &mut [f64]| -> Result<(), FactorError> {
        x.iter_mut().zip(&root).for_each(|(x, root)| *x *= root);
        factors.solve_in_place(x)?;
        x.iter_mut().zip(&root).for_each(|(x, root)| *x *= root);
        Ok(())
    };
    let wanted = count.saturating_sub(lasting.len());
    let found = lanczos::largest(root.len(), (wanted, &lasting), &mut apply)?;
    let known = lasting.into_iter().map(|vector| (0.0, vector));
    let rate = |pair: Eigenpair| (pair.value.recip() - shift, pair.vector);
    let pairs: Vec<(f64, Vec<f64>)> =
        known.chain(found.into_iter().map(rate)).take(count).collect();
    let none = Mat::zeros(0, root.len());
    let modes = pairs.into_iter().map(|(rate, vector)| {
        let parts: Vec<f64> = vector.iter().map(|y| y * y).collect();
        let of_states: Vec<Complex> =
            vector.iter().zip(&root).map(|(y, root)| Complex::new(y / root, 0.0)).collect();
        let nodes = nodes(linear, &of_states, &none);
        mode(linear, (Complex::new(-rate, 0.0), nodes), &parts)
    });
    Ok(Modes { modes: modes.collect(), all: capacity.len(), tried: None })
}

/// `C^1/2` times the even temperatures of each part that no path joins to a boundary, of length 1:
/// modes that last without end, known in advance.
fn lasting(linear: &Linearised<'_>, root: &[f64]) -> Vec<Vec<f64>> {
    let system = linear.system();
    let islands = system.network().ungrounded();
    let of_island = |nodes: Vec<lptn_network::NodeId>| {
        let mut vector = vec![0.0; root.len()];
        let states = nodes.iter().filter_map(|id| system.states().binary_search(id).ok());
        states.for_each(|state| vector[state] = root[state]);
        let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
        vector.iter_mut().for_each(|x| *x /= length);
        vector
    };
    islands.into_iter().map(of_island).collect()
}

/// Shift in 1/s, far below the slowest rate that is not zero (about a typical rate over the number
/// of nodes squared for a chain), so that it costs no digits.
fn shift(diagonal: &[usize], values: &[f64], capacity: &[f64]) -> f64 {
    let mut rates: Vec<f64> =
        diagonal.iter().zip(capacity).map(|(&slot, c)| values[slot] / c).collect();
    rates.sort_by(f64::total_cmp);
    let size = rates.len() as f64;
    rates[rates.len() / 2] / (size * size)
}

fn length(vector: &[Complex]) -> f64 {
    vector.iter().map(|z| z.norm_sqr()).sum::<f64>().sqrt()
}
