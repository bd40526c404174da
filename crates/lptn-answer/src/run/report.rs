//! Additions to the report of a run: how far it can be trusted, and its heat flows.

use lptn_analysis::RunAnalysis;
use lptn_network::{NodeId, ParameterId};
use lptn_report::{Claim, Page as _, Report, duration, significant, with_results};
use lptn_solve::{Gradient, Proceed, Snapshot};
use lptn_study::Environment;

use super::answer::RunAnswer;
use crate::about::{self, Known, Sensitivities};
use crate::bound::{not_bounded, weak_ledger};
use crate::fields::MOST_FRAMES;
use crate::{limits, proven};

/// With more numbers than this, nodes times parameters, sensitivities take longer than the run.
const MOST_TANGENTS: usize = 2000;

impl RunAnswer {
    /// The sections of a report and its claims.
    /// Sensitivities hold for a run from the start of the network, not for a settled cycle.
    pub(crate) fn report(&self, from_start: bool) -> Report {
        let known = Known {
            claims: self.claims(),
            states: self.states(),
            unit: Some(&self.task.unit),
            frames: self.frames(),
            network: None,
            sensitivities: if from_start { self.sensitivities() } else { None },
        };
        let mut report = about::about(&self.task.input, known);
        let manifest = self.manifest(Vec::new(), Environment::default());
        report.sections.extend(serde_json::to_value(&manifest).ok().and_then(about::manifest));
        report
    }

    /// The parts of the report that a live page makes again: claims, curves, results.
    pub fn live(&self) -> Report {
        let mut claims = self.claims();
        claims.push(about::linearity(&self.task.input));
        let report = Report { claims, ..Report::default() };
        with_results(&self.text(), self.figures(), report)
    }

    /// The network at the requested times, else at the end, and in steady state.
    fn states(&self) -> Vec<(String, Snapshot)> {
        let times = self.solution.times();
        let at = |time: &f64| self.solution.row_at(*time);
        let mut rows: Vec<usize> = self.task.at.iter().filter_map(at).collect();
        if rows.is_empty() {
            rows.extend(times.len().checked_sub(1));
        }
        let one = |row: usize| {
            let title = format!("At {}", duration(times[row], 4));
            Some((title, self.solution.snapshot(row)?))
        };
        let settled = self.steady.as_ref().ok();
        let settled = settled.map(|steady| ("Steady state".to_owned(), steady.state.clone()));
        rows.into_iter().filter_map(one).chain(settled).collect()
    }

    /// Instants of the run for the fields of grids, evenly spaced, the end among them.
    fn frames(&self) -> Vec<(String, Snapshot)> {
        let times = self.solution.times();
        if self.solution.network().grids().is_empty() || times.is_empty() {
            return Vec::new();
        }
        let last = times.len() - 1;
        let step = last.div_ceil(MOST_FRAMES - 1).max(1);
        let rows = (0..times.len()).filter(|row| (last - row).is_multiple_of(step));
        let one = |row: usize| Some((duration(times[row], 4), self.solution.snapshot(row)?));
        rows.filter_map(one).collect()
    }

    fn claims(&self) -> Vec<Claim> {
        let ledger = self.solution.ledger();
        let books = match ledger.relative_residual() {
            Some(residual) => format!(
                "the energy balance closes to {} of the heat exchanged, {} allowed",
                significant(residual.abs(), 2),
                significant(ledger.bound, 2)
            ),
            None => "no heat was exchanged".into(),
        };
        let unbounded =
            || not_bounded(self.solution.network(), self.solution.trust.unbounded.as_ref());
        let bound = match (proven::claim(&self.solution), unbounded()) {
            (Some(proven), _) => Claim::checked(true, proven),
            (None, None) => Claim::open(format!(
                "not verified: errors should be below {} K, ten times the tolerance; `lptn verify` \
                 compares with the exact solution",
                significant(10.0 * self.solution.tolerance(), 2)
            )),
            (None, Some(why)) => Claim::open(why),
        };
        let mut claims = vec![Claim::checked(ledger.closes(), books), bound];
        claims.extend(weak_ledger(&self.solution).map(Claim::open));
        if self.ended_early().is_none() {
            claims.extend(about::laws(self.solution.network(), self.solution.out_of_range()));
        }
        claims.push(about::lumps(&self.lumping));
        claims.extend(self.ended_early().map(|why| Claim::checked(false, why)));
        claims.extend(limits::claims(&self.judgement(&self.limits())));
        claims
    }

    /// Sensitivity of the hottest node to each parameter, at its end.
    /// If something switches, it is that of the peak: at its end the time of the switch matters.
    fn sensitivities(&self) -> Option<Sensitivities> {
        let (network, settings) = (self.solution.network(), &self.task.settings);
        let ids: Vec<ParameterId> = network.parameter_ids().collect();
        let small = ids.len() * network.nodes().len() <= MOST_TANGENTS;
        if ids.is_empty() || !small || self.ended_early().is_some() {
            return None;
        }
        let node = self.hottest()?;
        let run = RunAnalysis::of(network, settings).watching([node]);
        let run = run.with_slopes((network, &ids), &|_| Proceed::Continue).ok()?;
        let one = |&id: &ParameterId| {
            let slope = match run.gradient {
                Gradient::Exact => *run.sensitivity(id, node)?.last()?,
                Gradient::Differences(_) => run.peak(id, node)?,
            };
            let absolute = network.parameters()[id.index()].ty.absolute;
            let step = if absolute { 1.0 } else { 0.01 * network.parameter_value(id) };
            // no share of 0 is a change
            let any = step.abs() > 0.0 || slope.abs() <= 0.0;
            Some(slope * step).filter(|kelvin| any && kelvin.is_finite())
        };
        let name = &network.nodes()[node.index()].name;
        let of = match run.gradient {
            Gradient::Exact => format!("{name} at {}", duration(settings.stop, 4)),
            Gradient::Differences(_) => format!("the peak of {name}"),
        };
        Some(Sensitivities { of, values: ids.iter().map(one).collect() })
    }

    /// The hottest of the recorded nodes at the end.
    fn hottest(&self) -> Option<NodeId> {
        let last = |node| self.solution.at_end(node).ok();
        let nodes = self.solution.recorded().iter().copied();
        let known = nodes.filter_map(|node| Some((node, last(node)?)));
        known.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(node, _)| node)
    }
}
