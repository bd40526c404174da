//! Heat that grows faster with temperature than the paths carry away: the runaway of a network, its
//! source, and the temperature from which on it grows.
//!
//! At some temperatures let `A` be the heat carried off by the paths, in W for 1 K of each unknown,
//! and `B` the extra heat of the sources for it, both at least 0 if they feed back. Heat that is
//! given off once comes back as `B A^-1` times as much, again and again. It grows without limit if
//! the largest eigenvalue of that, the gain, is above 1.
//!
//! The slopes of the sources are compared with those of the paths. The way from the start is
//! followed back to the temperature at which the gain is 1. At the end of that way the slopes have
//! grown beyond rounding.

use lptn_assembly::{ThermalSystem, Workspace};
use lptn_network::{Evaluation, NodeId, Positions, SourceId};

use crate::error::SteadyError;
use crate::newton::Newton;
use crate::several::start;
use crate::snapshot::Snapshot;
use crate::stop_reason::StopReason;
use crate::times::just_after;

/// Halvings of the way to the last state of the network.
const HALVINGS: usize = 50;

/// Rounds in which the gain is found; one is enough for a single source.
const ROUNDS: usize = 50;

/// A gain that changes by less than this, relative, is known.
const SETTLED: f64 = 1e-12;

/// A node that runs away.
#[derive(Clone, Debug)]
pub(crate) struct Runaway {
    /// The node whose temperature the source follows.
    pub(crate) node: NodeId,
    /// The source whose heat comes back most.
    pub(crate) source: String,
    /// The temperature of the node in K from which on the heat grows faster than it is carried off,
    /// on the way from the start.
    pub(crate) from: f64,
}

/// Share of the heat of sources that comes back as more heat in a steady state: from 1 on the state
/// does not last.
#[derive(Clone, Debug, PartialEq)]
pub struct Feedback {
    /// The part that comes back, the largest eigenvalue of `B A^-1`. Losses whose slopes were larger
    /// by its inverse would run away.
    pub gain: f64,
    /// The source whose heat comes back most.
    pub source: SourceId,
    /// The node whose temperature it follows most.
    pub node: NodeId,
}

impl Feedback {
    /// In a state of a system; `None` if no source gives off more heat when it is warmer.
    pub fn of(system: &ThermalSystem, state: &Snapshot) -> Option<Self> {
        let mut unknowns = vec![0.0; system.unknowns().len()];
        system.unknown_temperatures(&state.temperatures, &mut unknowns);
        let mut search = Search::new(system, state.time, &state.positions)?;
        let Gain { value, source, unknown } = search.gain(&unknowns)?;
        Some(Self { gain: value, source, node: system.unknowns()[unknown] })
    }
}

/// Share of the heat of sources that comes back as more heat.
struct Gain {
    value: f64,
    source: SourceId,
    unknown: usize,
}

/// Extra heat of one source for 1 K of each unknown, in W/K.
struct Answering {
    source: SourceId,
    slopes: Vec<(usize, f64)>,
    shares: Vec<(usize, f64)>,
}

struct Search<'a> {
    newton: Newton<'a>,
    work: Workspace,
    scope: Evaluation,
}

impl Runaway {
    /// Checks a network that went from its start to `last` (all unknowns, in K) for a runaway: heat
    /// comes back more than once there, and the node became hotter.
    pub(crate) fn of(
        system: &ThermalSystem,
        (time, positions): (f64, &Positions),
        last: &[f64],
    ) -> Option<Self> {
        let mut search = Search::new(system, time, positions)?;
        let start = start(system, &search.work);
        let on_the_way = |part: f64| -> Vec<f64> {
            start.iter().zip(last).map(|(a, b)| a + part * (b - a)).collect()
        };
        // with heat grown beyond all measure, the heat of the paths is rounded away
        let mut parts = (0..HALVINGS).map(|k| 0.5_f64.powi(k as i32));
        let (mut left, end) =
            parts.find_map(|part| Some((part, search.gain(&on_the_way(part))?)))?;
        if end.value <= 1.0 || last[end.unknown] <= start[end.unknown] {
            return None;
        }
        let mut kept = 0.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (kept + left);
            match search.gain(&on_the_way(middle)) {
                Some(gain) if gain.value < 1.0 => kept = middle,
                _ => left = middle,
            }
        }
        let from = on_the_way(left);
        let gain = search.gain(&from).unwrap_or(end);
        let node = system.unknowns()[gain.unknown];
        Some(Self {
            node,
            source: system.network().sources()[gain.source.index()].name().into_owned(),
            from: from[gain.unknown],
        })
    }
}

impl Runaway {
    /// The error of a missing steady state; `temperatures` of the nodes in K are a steady state
    /// that the network does not reach.
    pub(crate) fn error(self, system: &ThermalSystem, temperatures: Option<&[f64]>) -> SteadyError {
        SteadyError::Runaway {
            node: self.name(system),
            rests: temperatures.map(|temperatures| temperatures[self.node.index()]),
            source: self.source,
            from: self.from,
        }
    }

    /// The reason why a run ended.
    pub(crate) fn reason(self, system: &ThermalSystem) -> StopReason {
        StopReason::Runaway { node: self.name(system), source: self.source, from: self.from }
    }

    fn name(&self, system: &ThermalSystem) -> String {
        system.network().nodes()[self.node.index()].name.clone()
    }
}

impl<'a> Search<'a> {
    fn new(system: &'a ThermalSystem, time: f64, positions: &Positions) -> Option<Self> {
        let network = system.network();
        let newton = Newton::new(system, (0..system.unknowns().len()).collect()).ok()?;
        let (mut work, mut scope) = (system.workspace(), network.evaluation());
        if network.has_events() {
            work.set_positions(positions);
            scope.set_positions(positions);
        }
        system.read_inputs(&mut work, time, just_after(time)).ok()?;
        scope.set_time(time, just_after(time));
        Some(Self { newton, work, scope })
    }

    /// The gain at these temperatures of all unknowns in K; `None` if nothing comes back, or if the
    /// paths alone have no solution.
    fn gain(&mut self, unknowns: &[f64]) -> Option<Gain> {
        let feedback = self.feedback(unknowns);
        self.newton.linearize(&mut self.work, unknowns).ok()?;
        for of in &feedback {
            for &(row, share) in &of.shares {
                for &(column, slope) in &of.slopes {
                    let slot = self.newton.pattern.slot(row, column)?;
                    self.newton.values[slot] += share * slope;
                }
            }
        }
        self.newton.factors.factorize(&self.newton.values).ok()?;
        let mut heats = vec![1.0; feedback.len()];
        let mut value = 0.0;
        for _ in 0..ROUNDS {
            let mut warmer = vec![0.0; unknowns.len()];
            for (of, heat) in feedback.iter().zip(&heats) {
                of.shares.iter().for_each(|&(row, share)| warmer[row] += share * heat);
            }
            self.newton.factors.solve_in_place(&mut warmer).ok()?;
            let back = |of: &Answering| of.slopes.iter().map(|(i, slope)| slope * warmer[*i]).sum();
            heats = feedback.iter().map(back).collect();
            let before = value;
            value = heats.iter().fold(0.0, |most: f64, heat| most.max(*heat));
            if !(value > 0.0 && value.is_finite()) {
                return None;
            }
            heats.iter_mut().for_each(|heat| *heat /= value);
            if (value - before).abs() <= SETTLED * value {
                break;
            }
        }
        let most = feedback.iter().zip(&heats).max_by(|a, b| a.1.total_cmp(b.1))?.0;
        let (unknown, _) = *most.slopes.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(Gain { value, source: most.source, unknown })
    }

    /// The sources that heat more when something is warmer.
    fn feedback(&mut self, unknowns: &[f64]) -> Vec<Answering> {
        let system = self.newton.system;
        let network = system.network();
        system.recover(&mut self.work, unknowns);
        let nodes = system.node_temperatures(&self.work);
        let temperatures: Vec<f64> =
            nodes.iter().chain(system.boundary_temperatures(&self.work)).copied().collect();
        let place = |node: usize| system.unknowns().iter().position(|id| id.index() == node);
        let mut found = Vec::new();
        let mut slopes = Vec::new();
        // the rate of a state is part of the way back, not a heat
        for source in network.heat_sources() {
            let reads = network.source_variables(source);
            let known = network.source_slopes(source, &mut self.scope, &temperatures, &mut slopes);
            if reads.is_empty() || known.is_err() {
                continue;
            }
            let grows = reads.iter().zip(&slopes).filter(|(_, slope)| **slope > 0.0);
            let slopes: Vec<(usize, f64)> =
                grows.filter_map(|(&v, &slope)| Some((place(v as usize)?, slope))).collect();
            let into = network.sources()[source.index()].into.iter();
            let shares = into.filter_map(|&(node, share)| Some((place(node.index())?, share)));
            if !slopes.is_empty() {
                found.push(Answering { source, slopes, shares: shares.collect() });
            }
        }
        found
    }
}
