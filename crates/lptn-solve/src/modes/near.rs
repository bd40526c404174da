//! Modes of a network near a state: dense where it is small, the slowest few by Lanczos iteration
//! where it is large and symmetric.

use faer::Mat;
use lptn_assembly::ThermalSystem;
use lptn_integrate::dense::{self, Complex, GeneralEigen};
use lptn_integrate::lanczos::{self, Eigenpair};
use lptn_integrate::{FactorError, linear};

use super::{Mode, Modes, ModesError, normalised, participation};
use crate::exact::Reduced;
use crate::linearised::{Linearised, LinearisedError, Tried};
use crate::snapshot::Snapshot;

/// Modes slower than the fastest by more than this are computed from the inverse, where rounding
/// is relative to the slowest.
const SPREAD: f64 = 1e6;

/// The largest condition number of an eigenvalue: beyond it, the modes of a chain of equal cells,
/// which are none (the matrix is defective), cannot be told from others.
const DEFECTIVE: f64 = 1e7;

/// The largest temperature in K of the disturbance that a linear network is tried with.
const DISTURBANCE: f64 = 10.0;

impl Modes {
    /// The modes of a network, slowest first: the slowest `count` of a large one (more than 2000
    /// nodes), else all. A network that is not linear has them near a state, `at`.
    ///
    /// Where streams or slopes make a network lack symmetry, modes may swing: a pair of them is one
    /// [`Mode`] with its [`Mode::omega`].
    ///
    /// # Errors
    /// [`ModesError`]; large networks without symmetry are refused.
    pub fn of(
        system: &ThermalSystem,
        at: Option<&Snapshot>,
        count: usize,
    ) -> Result<Self, ModesError> {
        let network = system.network();
        let Some(item) = network.first_nonlinear() else {
            if network.nodes().len() <= Reduced::MOST_NODES {
                return Ok(Self::solve(network)?);
            }
            return near(&mut Linearised::of_proportional(system)?, count);
        };
        match at {
            _ if is_proportional(system) => near(&mut Linearised::of_proportional(system)?, count),
            Some(state) => {
                let mut linear = Linearised::near(system, state)?;
                let modes = near(&mut linear, count)?;
                let tried =
                    modes.modes.first().map(|mode| try_out(&mut linear, mode)).transpose()?;
                Ok(Self { tried, ..modes })
            }
            None => Err(ModesError::NotLinear { item, name: network.name_of(item).into_owned() }),
        }
    }
}

/// Whether a network is the same near every state: streams with constant capacity rates are.
fn is_proportional(system: &ThermalSystem) -> bool {
    let network = system.network();
    system.is_proportional() && system.states().iter().all(|&id| network.enthalpy(id).is_none())
}

/// Tries a linear network along a mode.
fn try_out(linear: &mut Linearised<'_>, mode: &Mode) -> Result<Tried, ModesError> {
    let unknowns = linear.system().unknowns().iter();
    let disturbance: Vec<f64> = unknowns.map(|id| DISTURBANCE * mode.shape[id.index()]).collect();
    Ok(linear.tried(&disturbance).map_err(LinearisedError::Input)?)
}

fn near(linear: &mut Linearised<'_>, count: usize) -> Result<Modes, ModesError> {
    let states = linear.capacity().len();
    if states <= Reduced::MOST_NODES {
        return dense_modes(linear);
    }
    match linear.is_symmetric() {
        true => slowest(linear, count),
        false => Err(ModesError::TooLarge { nodes: states }),
    }
}

/// All of them, from the dense matrix `C^-1/2 J C^-1/2`.
fn dense_modes(linear: &mut Linearised<'_>) -> Result<Modes, ModesError> {
    let (jacobian, follow) = linear.dense()?;
    let root: Vec<f64> = linear.capacity().iter().map(|c| c.sqrt()).collect();
    let scaled =
        Mat::from_fn(root.len(), root.len(), |i, j| jacobian[(i, j)] / (root[i] * root[j]));
    let loose = !linear.system().network().ungrounded().is_empty();
    let eigen = eigen_of(&scaled, loose)?;
    let left = dense::complex_inverse(&eigen.vectors).ok_or(ModesError::Defective)?;
    let mut modes = Vec::new();
    for (k, &value) in eigen.values.iter().enumerate().filter(|(_, value)| value.im >= 0.0) {
        let right: Vec<Complex> = (0..root.len()).map(|i| eigen.vectors[(i, k)]).collect();
        let left: Vec<Complex> = (0..root.len()).map(|i| left[(k, i)]).collect();
        if length(&right) * length(&left) > DEFECTIVE {
            return Err(ModesError::Defective);
        }
        let parts: Vec<f64> = right.iter().zip(&left).map(|(x, y)| (x * y).norm()).collect();
        let of_states: Vec<Complex> = right.iter().zip(&root).map(|(x, root)| x / root).collect();
        modes.push(mode(linear, (value, &of_states), &parts, &follow));
    }
    modes.sort_by(|a, b| a.rate.total_cmp(&b.rate));
    Ok(Modes { all: modes.len(), modes, tried: None })
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

/// A mode from its eigenvalue, the temperatures of the states and their parts.
fn mode(
    linear: &mut Linearised<'_>,
    (value, of_states): (Complex, &[Complex]),
    parts: &[f64],
    follow: &Mat<f64>,
) -> Mode {
    let mut recovered = |of: &dyn Fn(&Complex) -> f64| {
        let mut unknowns: Vec<f64> = of_states.iter().map(of).collect();
        let following = (0..follow.nrows())
            .map(|i| (0..of_states.len()).map(|j| follow[(i, j)] * unknowns[j]).sum::<f64>());
        let following: Vec<f64> = following.collect();
        unknowns.extend(following);
        linear.recover(&unknowns)
    };
    let (real, imaginary) = (recovered(&|x| x.re), recovered(&|x| x.im));
    let states = linear.system().states();
    let participation = participation(states, parts, real.len());
    let rate = if value.re == 0.0 { 0.0 } else { -value.re };
    if value.im == 0.0 {
        return Mode {
            rate,
            omega: 0.0,
            shape: normalised(real),
            phase: Vec::new(),
            participation,
        };
    }
    let complex: Vec<Complex> =
        real.into_iter().zip(imaginary).map(|(re, im)| Complex::new(re, im)).collect();
    let largest = complex.iter().fold(0.0, |most: f64, z| most.max(z.norm()));
    let first = complex.iter().copied().find(|z| z.norm() >= (1.0 - super::EQUAL) * largest);
    let unit = first.unwrap_or(Complex::new(1.0, 0.0));
    let turned: Vec<Complex> = complex.iter().map(|z| z / unit).collect();
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
fn slowest(linear: &mut Linearised<'_>, count: usize) -> Result<Modes, ModesError> {
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
        mode(linear, (Complex::new(-rate, 0.0), &of_states), &parts, &none)
    });
    Ok(Modes { modes: modes.collect(), all: capacity.len(), tried: None })
}

/// `C^1/2` times the even temperatures of each part that no path joins to a boundary, of length 1:
/// modes that last for ever, known without looking.
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

/// In 1/s, far below the slowest rate that is not zero (about a typical rate over the number of
/// nodes squared for a chain), so that it costs no digits.
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
