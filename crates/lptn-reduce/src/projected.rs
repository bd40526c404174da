//! Several nodes of a network as a few modes, which are not a network.
//!
//! Between several nodes the elements of a projection are not all positive.

use faer::Mat;
use lptn_assembly::ThermalSystem;
use lptn_integrate::dense;
use lptn_integrate::vectors::{add, dot, take_off};
use lptn_network::NodeId;

use crate::error::ReduceError;
use crate::kept_errors::{KeptErrors, KeptReference};
use crate::rises::{Rises, Way};

/// A network projected onto its first responses to heat at some of its nodes:
/// `tau_j dx_j/dt = sum of s_pj P_p - x_j` and `T_n = T_ref + sum of s_nj x_j`, with the heat `P_p`
/// into each requested node.
///
/// The first projection has many responses: the block Krylov space of `G^-1 C` from `G^-1` of these
/// nodes (PRIMA: A. Odabasioglu, M. Celik, L. T. Pileggi, IEEE Trans. CAD 17 (1998) 645), made
/// orthonormal by G. The second takes its modes onto their responses at a few real frequencies: 0
/// and others at equal logarithmic distances, over the range with the smallest error over every
/// load. Both are congruences, so the model is passive: its time constants are real and not
/// negative. Between the requested nodes the steady state is exact, and so are the first moments.
#[derive(Clone, Debug, PartialEq)]
pub struct Projected {
    /// Time constant of each mode in s, the slowest first; 0 for an immediate response.
    pub tau: Vec<f64>,
    /// `s_nj` of each mode at every node of the network, in sqrt(K/W).
    pub shapes: Vec<Vec<f64>>,
    /// The errors at the requested nodes over every load.
    pub errors: KeptErrors,
}

impl Projected {
    /// `count` modes, or as many as these nodes see.
    ///
    /// # Errors
    /// [`ReduceError::OneWay`], [`ReduceError::NotLinear`], [`ReduceError::Factorization`],
    /// [`ReduceError::Modes`].
    pub fn new(
        system: &ThermalSystem,
        reference: &KeptReference,
        count: usize,
    ) -> Result<Self, ReduceError> {
        let network = system.network();
        let capacity: Vec<f64> = network.node_ids().map(|id| network.capacity(id)).collect();
        let most = if capacity.len() > LARGE { FEW } else { MANY };
        let answers = answers(system, (reference.asked(), &capacity), count.max(most))?;
        let many = Many::new(&answers, &capacity, reference.asked())?;
        let (few, errors) = many.best(reference, count)?;
        let shape = |k: usize| -> Vec<f64> {
            let weights: Vec<f64> = (0..answers.len()).map(|i| few.mix[(i, k)]).collect();
            let mut shape = vec![0.0; capacity.len()];
            for (answer, weight) in answers.iter().zip(weights) {
                shape.iter_mut().zip(answer).for_each(|(s, a)| *s += weight * a);
            }
            shape
        };
        let shapes = (0..few.tau.len()).map(shape).collect();
        Ok(Self { tau: few.tau, shapes, errors })
    }
}

/// Number of responses of the first projection: `FEW` for networks of more than `LARGE` nodes.
const MANY: usize = 160;
const FEW: usize = 40;
const LARGE: usize = 50_000;

/// Modes of a projection.
struct Modes {
    tau: Vec<f64>,
    /// Each mode as a column of weights of the first responses.
    mix: Mat<f64>,
    /// Each mode at each requested node.
    ports: Mat<f64>,
}

impl Modes {
    /// The modes of `C` in a basis with the rows `ports` at the requested nodes.
    fn of(c: &Mat<f64>, basis: &Mat<f64>, ports: &Mat<f64>) -> Result<Self, ReduceError> {
        let n = c.nrows();
        let (values, vectors) = dense::symmetric_eigen(c.as_ref()).ok_or(ReduceError::Modes)?;
        let largest = values.last().copied().unwrap_or(0.0);
        let known = |tau: f64| if tau > 1e-15 * largest { tau } else { 0.0 };
        let slow_first = Mat::from_fn(n, n, |i, j| vectors[(i, n - 1 - j)]);
        Ok(Self {
            tau: values.iter().rev().map(|tau| known(*tau)).collect(),
            mix: dense::product(basis.as_ref(), slow_first.as_ref()),
            ports: dense::product(ports.as_ref(), slow_first.as_ref()),
        })
    }
}

/// The modes of the first projection.
struct Many {
    modes: Modes,
}

impl Many {
    fn new(answers: &[Vec<f64>], capacity: &[f64], asked: &[NodeId]) -> Result<Self, ReduceError> {
        let n = answers.len();
        let entry = |i: usize, j: usize| -> f64 {
            answers[i].iter().zip(&answers[j]).zip(capacity).map(|((a, b), c)| a * c * b).sum()
        };
        let c = Mat::from_fn(n, n, |i, j| if j <= i { entry(i, j) } else { 0.0 });
        let ports = Mat::from_fn(asked.len(), n, |p, i| answers[i][asked[p].index()]);
        Ok(Self { modes: Modes::of(&c, &Mat::identity(n, n), &ports)? })
    }

    /// `count` of them, with the smallest error over every load.
    fn best(
        &self,
        reference: &KeptReference,
        count: usize,
    ) -> Result<(Modes, KeptErrors), ReduceError> {
        const PIECES: i32 = 8;
        let tau = &self.modes.tau;
        let seen = || tau.iter().copied().filter(|tau| *tau > 0.0);
        let slow = -seen().fold(0.0, f64::max).log10();
        let fast = -seen().fold(f64::INFINITY, f64::min).log10();
        let mut best: Option<(Modes, KeptErrors)> = None;
        for piece in 1..=PIECES {
            let end = slow + (fast - slow) * f64::from(piece) / f64::from(PIECES);
            let few = self.projected((slow, end), count)?;
            let errors = reference.errors_of(&|p, q| {
                let at = |node| reference.asked().iter().position(|asked| *asked == node);
                let (p, q) = (at(p).unwrap_or(0), at(q).unwrap_or(0));
                let weight = |k: usize| few.ports[(p, k)] * few.ports[(q, k)];
                few.tau.iter().enumerate().map(|(k, tau)| (weight(k), *tau)).collect()
            });
            if best.as_ref().is_none_or(|(_, before)| errors.share() < before.share()) {
                best = Some((few, errors));
            }
        }
        best.ok_or(ReduceError::Modes)
    }

    /// The projection onto the responses at frequency 0 and at others between these decades.
    fn projected(&self, (slow, fast): (f64, f64), count: usize) -> Result<Modes, ReduceError> {
        let (tau, ports) = (&self.modes.tau, &self.modes.ports);
        let blocks = count.div_ceil(ports.nrows().max(1));
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for block in 0..blocks {
            #[expect(clippy::cast_precision_loss, reason = "a number of blocks")]
            let part = block as f64 / (blocks - 1).max(1) as f64;
            let s = if block == 0 { 0.0 } else { 10_f64.powf(slow + (fast - slow) * part) };
            for p in 0..ports.nrows() {
                let answer = |(k, tau): (usize, &f64)| ports[(p, k)] / (1.0 + s * tau);
                let mut vector: Vec<f64> = tau.iter().enumerate().map(answer).collect();
                let before = dot(&vector, &vector);
                take_off(&mut vector, basis.iter().chain(&basis));
                let square = dot(&vector, &vector);
                if square > NEW * NEW * before && basis.len() < count {
                    basis.push(vector.into_iter().map(|x| x / square.sqrt()).collect());
                }
            }
        }
        let n = basis.len();
        let entry = |i: usize, j: usize| -> f64 {
            basis[i].iter().zip(&basis[j]).zip(tau).map(|((a, b), tau)| a * tau * b).sum()
        };
        let mix = Mat::from_fn(tau.len(), n, |i, j| basis[j][i]);
        let c = Mat::from_fn(n, n, entry);
        let all = dense::product(self.modes.mix.as_ref(), mix.as_ref());
        Modes::of(&c, &all, &dense::product(ports.as_ref(), mix.as_ref()))
    }
}

/// A response whose part outside of the others is smaller than this share is not new.
const NEW: f64 = 1e-12;

/// The responses of all nodes, orthonormal by G, in sqrt(K/W).
fn answers(
    system: &ThermalSystem,
    (asked, capacity): (&[NodeId], &[f64]),
    count: usize,
) -> Result<Vec<Vec<f64>>, ReduceError> {
    let mut rises = Rises::new(system)?;
    let mut basis: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    let mut next = 0;
    for step in 0.. {
        if basis.len() >= count {
            break;
        }
        let mut heat = vec![0.0; capacity.len()];
        if let Some(node) = asked.get(step) {
            heat[node.index()] = 1.0;
        } else if let Some((_, answer)) = basis.get(next) {
            heat.iter_mut().zip(answer).zip(capacity).for_each(|((q, t), c)| *q = t * c);
            next += 1;
        } else {
            break;
        }
        let mut answer = rises.of_nodes(&heat, Way::Forth)?;
        let before = dot(&heat, &answer);
        for (known_heat, known) in basis.iter().chain(&basis) {
            let along = dot(known_heat, &answer);
            add(&mut heat, -along, known_heat);
            add(&mut answer, -along, known);
        }
        let square = dot(&heat, &answer);
        if square > NEW * NEW * before && before > 0.0 {
            let scaled = |x: Vec<f64>| x.into_iter().map(|x| x / square.sqrt()).collect();
            basis.push((scaled(heat), scaled(answer)));
        }
    }
    Ok(basis.into_iter().map(|(_, answer)| answer).collect())
}
