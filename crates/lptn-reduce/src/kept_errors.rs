//! Errors of a network of kept nodes.

use lptn_analysis::RunAnalysis;
use lptn_assembly::ThermalSystem;
use lptn_network::{Network, NodeId};

use crate::allowed::Allowed;
use crate::deviation::{Dense, Deviation, Record};
use crate::error::ReduceError;
use crate::exponentials::Exponentials;
use crate::reduction::TOLERANCE;
use crate::rises::Rises;
use crate::step::StepResponse;

/// Errors at the requested nodes against the whole network.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptErrors {
    /// Over the run, one for each requested node, with its rise in K.
    pub run: Option<Vec<(Deviation, f64)>>,
    /// The largest error of each over every load between 0 and 1 W into each of the requested nodes
    /// at once, in K, and the largest rise that such loads lead to.
    pub loads: Vec<(f64, f64)>,
}

impl KeptErrors {
    /// The largest error over every load, as a share of the rise.
    pub fn share(&self) -> f64 {
        self.loads.iter().map(|(error, rise)| error / rise).fold(0.0, f64::max)
    }
}

/// The whole network at the requested nodes, for the comparison with reduced ones.
#[derive(Debug)]
pub struct KeptReference {
    asked: Vec<NodeId>,
    /// For each pair of nodes, the second not after the first.
    responses: Vec<(Terms, f64)>,
    run: Option<(Dense, Vec<Record>)>,
    start: f64,
    allowed: Allowed,
}

impl KeptReference {
    /// The responses of these nodes to heat in each of them, and their temperatures over the run.
    ///
    /// # Errors
    /// [`ReduceError::NoGround`], [`ReduceError::NotLinear`], [`ReduceError::OneWay`],
    /// [`ReduceError::Run`].
    pub fn new(
        system: &ThermalSystem,
        asked: &[NodeId],
        (run, allowed): (Option<&RunAnalysis>, Allowed),
    ) -> Result<Self, ReduceError> {
        asked.iter().try_for_each(|node| crate::norton::grounded(system.network(), *node))?;
        let responses = responses(system, asked)?;
        let start = run.map_or(0.0, |run| run.start());
        let recorded = |run: &RunAnalysis| -> Result<_, ReduceError> {
            let tolerance = TOLERANCE.min(0.01 * run.tolerance());
            let dense = Dense::new(system, run, tolerance)?;
            let records = Record::all(system, asked, &dense)?;
            Ok((dense, records))
        };
        let run = run.map(recorded).transpose()?;
        Ok(Self { asked: asked.to_vec(), responses, run, start, allowed })
    }

    pub(crate) fn asked(&self) -> &[NodeId] {
        &self.asked
    }

    /// Start of the run in s.
    pub(crate) fn start(&self) -> f64 {
        self.start
    }

    /// The errors of a reduced network whose first nodes are the requested ones.
    ///
    /// # Errors
    /// [`ReduceError::Run`], [`ReduceError::Equivalent`] if it cannot be assembled.
    pub fn errors(&self, network: &Network) -> Result<KeptErrors, ReduceError> {
        let few = ThermalSystem::assemble(network)
            .map_err(|error| ReduceError::Equivalent(error.to_string()))?;
        let here: Vec<NodeId> = few.network().node_ids().take(self.asked.len()).collect();
        let run = self.run.as_ref().map(|run| self.over_run((&few, &here), run)).transpose()?;
        Ok(KeptErrors { run, loads: self.over_loads(&responses(&few, &here)?) })
    }

    /// The errors of a model over every load. `between` returns the weights in K/W and time
    /// constants in s of the rise of one node for heat into another.
    pub(crate) fn errors_of(&self, between: &dyn Fn(NodeId, NodeId) -> Terms) -> KeptErrors {
        let pairs = (0..self.asked.len()).flat_map(|p| (0..=p).map(move |q| (p, q)));
        let terms = pairs.map(|(p, q)| (between(self.asked[p], self.asked[q]), 0.0));
        KeptErrors { run: None, loads: self.over_loads(&terms.collect::<Vec<_>>()) }
    }

    fn over_run(
        &self,
        (few, here): (&ThermalSystem, &[NodeId]),
        (run, whole): &(Dense, Vec<Record>),
    ) -> Result<Vec<(Deviation, f64)>, ReduceError> {
        let reduced = Record::all(few, here, run)?;
        let error =
            |(whole, few): (&Record, &Record)| (whole.deviation(few, self.allowed), whole.rise());
        Ok(whole.iter().zip(&reduced).map(error).collect())
    }

    /// Loads at different nodes are independent: the largest errors add.
    fn over_loads(&self, reduced: &[(Terms, f64)]) -> Vec<(f64, f64)> {
        let mut sums = vec![(0.0, 0.0); self.asked.len()];
        let pairs = (0..self.asked.len()).flat_map(|p| (0..=p).map(move |q| (p, q)));
        for ((p, q), ((whole, rise), (few, _))) in pairs.zip(self.responses.iter().zip(reduced)) {
            let minus = few.iter().map(|&(weight, tau)| (-weight, tau));
            let found = Exponentials::new(whole.iter().copied().chain(minus)).variation();
            let mut add = |at: usize| {
                sums[at].0 += found.rises + found.missed;
                sums[at].1 += rise;
            };
            add(p);
            if p != q {
                add(q);
            }
        }
        sums
    }
}

fn responses(system: &ThermalSystem, nodes: &[NodeId]) -> Result<Vec<(Terms, f64)>, ReduceError> {
    let mut all = Responses { system, rises: Rises::new(system)?, nodes: nodes.to_vec() };
    if !all.rises.is_symmetric() {
        return Err(ReduceError::OneWay);
    }
    let pairs = (0..nodes.len()).flat_map(|p| (0..=p).map(move |q| (p, q)));
    pairs.map(|(p, q)| all.between(p, q)).collect()
}

/// Step responses between nodes of one network.
struct Responses<'a> {
    system: &'a ThermalSystem,
    rises: Rises<'a>,
    nodes: Vec<NodeId>,
}

/// Weights in K/W with time constants in s.
pub(crate) type Terms = Vec<(f64, f64)>;

impl Responses<'_> {
    /// The remaining rise of one for 1 W into the other, and the whole rise. It is a quarter of the
    /// difference of two responses, to heat into both and to heat into one and out of the other,
    /// each of which is a sum of falling exponentials.
    fn between(&mut self, p: usize, q: usize) -> Result<(Terms, f64), ReduceError> {
        if p == q {
            return self.of(p, None, 1.0);
        }
        let (mut terms, rise) = self.of(p, Some((q, 1.0)), 0.25)?;
        let (minus, less) = self.of(p, Some((q, -1.0)), 0.25)?;
        terms.extend(minus.into_iter().map(|(weight, tau)| (-weight, tau)));
        Ok((terms, rise - less))
    }

    fn of(
        &mut self,
        p: usize,
        other: Option<(usize, f64)>,
        factor: f64,
    ) -> Result<(Terms, f64), ReduceError> {
        let mut heat = vec![0.0; self.system.network().nodes().len()];
        heat[self.nodes[p].index()] = 1.0;
        if let Some((q, sign)) = other {
            heat[self.nodes[q].index()] = sign;
        }
        let step = StepResponse::for_heat(self.system, &heat, &mut self.rises)?;
        let terms = step.terms.iter().map(|term| (factor * term.resistance, term.tau)).collect();
        Ok((terms, factor * step.resistance))
    }
}
