//! The bounds of rows, which are written in order.

use std::ops::Range;

use lptn_assembly::ThermalSystem;
use lptn_network::NodeId;

use super::Certificate;

/// The rows of a run, and the bounds of those that are written.
pub(crate) struct Rows<'a> {
    system: &'a ThermalSystem,
    recorded: Vec<NodeId>,
    times: Vec<f64>,
    /// The unknown of each recorded node, if all are unknowns.
    unknowns: Option<Vec<usize>>,
    certificate: Certificate,
}

impl<'a> Rows<'a> {
    pub(crate) fn new(system: &'a ThermalSystem, recorded: &[NodeId], times: &[f64]) -> Self {
        let mut place = vec![None; system.network().nodes().len()];
        system.unknowns().iter().enumerate().for_each(|(i, id)| place[id.index()] = Some(i));
        let unknowns = recorded.iter().map(|id| place[id.index()]).collect();
        let certificate = Certificate { most: vec![0.0; recorded.len()], ..Certificate::default() };
        let (recorded, times) = (recorded.to_vec(), times.to_vec());
        Self { system, recorded, times, unknowns, certificate }
    }

    /// Number of rows that are written.
    pub(super) fn written(&self) -> usize {
        self.certificate.rows.len() / self.recorded.len().max(1)
    }

    /// The rows that are not written up to a time in s.
    pub(super) fn up_to(&self, time: f64) -> Range<usize> {
        let first = self.written();
        first..first + self.times[first..].iter().take_while(|row| **row <= time).count()
    }

    /// Number of all rows.
    pub(super) fn count(&self) -> usize {
        self.times.len()
    }

    /// The time of the last row in s, the end of the run; `None` without rows.
    pub(super) fn end(&self) -> Option<f64> {
        self.times.last().copied()
    }

    pub(super) fn time(&self, row: usize) -> f64 {
        self.times[row]
    }

    /// Writes a row from the distances of the unknowns from a way in K, with their signs: those of
    /// massless nodes are means of them.
    pub(super) fn push(&mut self, apart: impl Fn(usize) -> f64) {
        let mut of_nodes = std::mem::take(&mut self.certificate.rows);
        self.for_each(apart, |_, apart| of_nodes.push(apart.abs()));
        self.certificate.rows = of_nodes;
    }

    /// Adds to the bounds of a row.
    pub(super) fn add(&mut self, row: usize, bound: impl Fn(usize) -> f64) {
        let mut of_nodes = std::mem::take(&mut self.certificate.rows);
        let from = row * self.recorded.len();
        self.for_each(bound, |node, bound| of_nodes[from + node] += bound);
        self.certificate.rows = of_nodes;
    }

    /// Notes bounds over a part of the run: of the unknowns, and an amount for each that
    /// [`Rows::for_each_unknown`] asks for.
    pub(super) fn note(&mut self, bound: impl Fn(usize) -> f64, far: &[f64]) {
        let mut most = std::mem::take(&mut self.certificate.most);
        if self.unknowns.is_some() {
            self.for_each(bound, |node, bound| most[node] = most[node].max(bound + far[node]));
        } else {
            let bound = |unknown: usize| bound(unknown) + far[unknown];
            self.for_each(bound, |node, bound| most[node] = most[node].max(bound));
        }
        self.certificate.most = most;
    }

    /// The bounds of the recorded nodes from those of the unknowns: a massless one has a mean of
    /// those around it.
    fn for_each(&self, bound: impl Fn(usize) -> f64, mut each: impl FnMut(usize, f64)) {
        if let Some(unknowns) = &self.unknowns {
            unknowns.iter().enumerate().for_each(|(node, i)| each(node, bound(*i)));
            return;
        }
        let all: Vec<f64> = (0..self.system.unknowns().len()).map(bound).collect();
        let nodes = self.system.spread_bounds(&all);
        let nodes = self.recorded.iter().map(|id| nodes[id.index()]);
        nodes.enumerate().for_each(|(node, bound)| each(node, bound));
    }

    /// Calls with each recorded node that is an unknown and with its place among them, or with
    /// every unknown if some are not.
    pub(super) fn for_each_unknown(&self, mut each: impl FnMut(usize, usize)) {
        match &self.unknowns {
            Some(unknowns) => unknowns.iter().enumerate().for_each(|(node, i)| each(node, *i)),
            None => (0..self.system.unknowns().len()).for_each(|i| each(i, i)),
        }
    }

    /// Number of distances that [`Rows::for_each_unknown`] asks for.
    pub(super) fn asked(&self) -> usize {
        self.unknowns.as_ref().map_or(self.system.unknowns().len(), Vec::len)
    }

    pub(super) fn into_certificate(self) -> Certificate {
        self.certificate
    }
}
