//! Several nodes of a network as a few modes, which are no network of their own.

use faer::Mat;
use lptn_assembly::ThermalSystem;
use lptn_integrate::dense;
use lptn_network::NodeId;

use crate::error::ReduceError;
use crate::kept_errors::{KeptErrors, KeptReference};
use crate::rises::{Rises, Way};

/// A network projected onto its first answers to heat at some of its nodes: `tau_j dx_j/dt = sum of
/// s_pj P_p - x_j` and `T_n = T_ref + sum of s_nj x_j`, with the heat `P_p` into each node asked
/// for.
///
/// The answers are those of the block Krylov space of `G^-1 C` from `G^-1` of these nodes (PRIMA: A.
/// Odabasioglu, M. Celik, L. T. Pileggi, IEEE Trans. CAD 17 (1998) 645), made orthonormal by G. The
/// projection is a congruence, so the model is passive: its time constants are real and not
/// negative. Between the nodes asked for the steady state is exact, and twice as many moments as
/// there are blocks. The space begins with what is slow, so that modes which only matter at first
/// come late, and the fastest are lost in rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct Projected {
    /// Time constant of each mode in s, the slowest first; 0 for what comes at once.
    pub tau: Vec<f64>,
    /// `s_nj` of each mode at every node of the network, in sqrt(K/W).
    pub shapes: Vec<Vec<f64>>,
    /// The errors at the nodes asked for over every load.
    pub errors: KeptErrors,
}

impl Projected {
    /// So many modes, or as many as these nodes see.
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
        let answers = answers(system, (reference.asked(), &capacity), count)?;
        let n = answers.len();
        let entry = |i: usize, j: usize| -> f64 {
            answers[i].iter().zip(&answers[j]).zip(&capacity).map(|((a, b), c)| a * c * b).sum()
        };
        let (values, vectors) =
            dense::symmetric_eigen(Mat::from_fn(n, n, entry).as_ref()).ok_or(ReduceError::Modes)?;
        let largest = values.last().copied().unwrap_or(0.0);
        let shape = |k: usize| -> Vec<f64> {
            let at = |node: usize| (0..n).map(|i| answers[i][node] * vectors[(i, k)]).sum();
            (0..capacity.len()).map(at).collect()
        };
        let tau: Vec<f64> = (0..n)
            .rev()
            .map(|k| if values[k] > 1e-15 * largest { values[k] } else { 0.0 })
            .collect();
        let shapes: Vec<Vec<f64>> = (0..n).rev().map(shape).collect();
        let between = |p: NodeId, q: NodeId| {
            let weights = shapes.iter().map(|shape| shape[p.index()] * shape[q.index()]);
            weights.zip(tau.iter().copied()).collect()
        };
        let errors = reference.errors_of(&between);
        Ok(Self { tau, shapes, errors })
    }
}

/// The answers of all nodes, orthonormal by G, in sqrt(K/W): each with the heat that it answers.
fn answers(
    system: &ThermalSystem,
    (asked, capacity): (&[NodeId], &[f64]),
    count: usize,
) -> Result<Vec<Vec<f64>>, ReduceError> {
    /// Parts of an answer below this are those of the others.
    const NEW: f64 = 1e-12;
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
            heat.iter_mut().zip(known_heat).for_each(|(q, k)| *q -= along * k);
            answer.iter_mut().zip(known).for_each(|(t, k)| *t -= along * k);
        }
        let square = dot(&heat, &answer);
        if square > NEW * NEW * before && before > 0.0 {
            let scaled = |x: Vec<f64>| x.into_iter().map(|x| x / square.sqrt()).collect();
            basis.push((scaled(heat), scaled(answer)));
        }
    }
    Ok(basis.into_iter().map(|(_, answer)| answer).collect())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
