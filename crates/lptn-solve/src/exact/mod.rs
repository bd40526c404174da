//! The exact solution of a linear network by its modes: an oracle for every other way to solve it.
//!
//! With `x_k` the modes of `C^-1/2 G C^-1/2` scaled so that `x_k' C x_k = 1`, the amplitudes
//! `y_k = x_k' C (T - T_ref)` obey `dy_k/dt = -r_k y_k + f_k(t)` each by itself, and between two
//! rows `y_k(b) = exp(-r_k (b - a)) y_k(a) + int exp(-r_k (b - s)) f_k(s) ds`. Constant and
//! straight inputs are integrated in closed form, others through series of Legendre polynomials
//! against the exact kernel. No step depends on the one before but through rounding, and no
//! tolerance is passed on. Nothing is shared with `lptn-assembly` and `lptn-integrate`.
//!
//! States that streams of constant capacity rates join have modes that may coincide (a chain of
//! equal cells has only one): these go on by the exponential of their matrix (`chain.rs`).

mod carried;
mod chain;
mod inputs;
mod legendre;
mod march;
mod modal;
mod periodic;
mod reduced;
mod spectrum;
mod taylor;

use lptn_network::{InputError, Network, NodeId};
use lptn_units::{Class, EvalError, Problem};

use crate::events::EventKind;
use crate::solution::Solution;
use crate::times::{Segment, segments};
pub(crate) use chain::{Chain, Wanted};
use inputs::Inputs;
use march::March;
pub(crate) use periodic::ExactCycle;
pub(crate) use reduced::Reduced;
pub(crate) use spectrum::{Island, islands};

/// Temperatures of every node at given times, from the modes of the network.
#[derive(Clone, Debug)]
pub struct ExactSolution {
    times: Vec<f64>,
    /// Row by row the temperature of every node in K.
    temperatures: Vec<f64>,
    nodes: usize,
    states: usize,
    carried: usize,
    quadrature: Option<f64>,
    rounding: f64,
}

/// The largest difference of two solutions of one network.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Largest absolute difference in K.
    pub largest: f64,
    /// The node where it is.
    pub node: NodeId,
    /// Its time in s.
    pub time: f64,
    /// The largest difference of each node in K.
    pub by_node: Vec<f64>,
}

pub(crate) const MERGE: &str = "merge the nodes that the largest conductances join";

const CONSTANTS: &str = "only a network of constants has modes; `lptn run` follows it over time";

lptn_units::errors! {
/// Reason why a network has no exact solution, or no modes.
#[derive(Clone, Debug)]
pub enum ExactError {
    /// More nodes than dense matrices can handle.
    TooLarge { nodes: usize } = "modes::too_large",
        format!("{nodes} nodes are more than the {} that are solved by modes", Reduced::MOST_NODES),
        help "lump nodes until there are at most 2000, or let `lptn run` show how long each node \
            takes";
    /// There are no times, they do not increase, or they begin before the start.
    Times = "exact::times", "the times must increase and begin at the start or after it";
    /// A source or boundary has no value.
    Input => InputError;
    /// A constant has no value.
    Value(error: EvalError) = "solve::input", error, source error, help Problem::help(error);
    /// It is not linear with constant coefficients; the name of the first such item.
    NotLinear { name: String } = "exact::not_linear",
        format!("`{name}` makes the network more than constant capacities and conductances"),
        help CONSTANTS;
    /// It switches at times not known in advance; the name of the first control or comparison.
    Switches { name: String } = "exact::switches",
        format!("`{name}` switches at times that depend on the temperatures"), help CONSTANTS;
    /// The conductances of the massless nodes span more than doubles can represent.
    Singular = "exact::singular",
        "the conductances of the massless nodes span more than floating-point numbers can",
        help MERGE, class Class::Numbers;
    /// Rates of nodes that streams join span more than doubles can represent.
    Rates = "exact::singular",
        "the rates of the nodes that streams join span more than floating-point numbers can",
        help MERGE, class Class::Numbers;
    /// The eigenvalues were not found.
    Modes = "exact::modes", "the eigenvalues of the network were not found", help MERGE,
        class Class::Numbers;
    /// An input changes too fast for any series; the time in s at which the attempt was given up.
    Quadrature { time: f64 } = "exact::quadrature",
        format!("an input changes too fast at {time} s to be integrated"), help MERGE,
        class Class::Numbers;
}
}

impl ExactSolution {
    /// Temperatures of `network` at `times` in s, which increase strictly, from a start at `start`
    /// in s. At a jump of an input the temperatures are those after it, except at the last time.
    ///
    /// # Errors
    /// [`ExactError`]; more than 2000 nodes are refused, and networks that switch by themselves.
    pub fn solve(network: &Network, start: f64, times: &[f64]) -> Result<Self, ExactError> {
        let ascending = times.windows(2).all(|pair| pair[0] < pair[1]);
        let (Some(&first), Some(&stop), true) = (times.first(), times.last(), ascending) else {
            return Err(ExactError::Times);
        };
        if !(start <= first && start < stop && start.is_finite() && stop.is_finite()) {
            return Err(ExactError::Times);
        }
        if let Some(kind) = EventKind::switching(network).next() {
            return Err(ExactError::Switches { name: kind.name(network) });
        }
        if let Some(pipe) = network.pipes().first() {
            let name = network.nodes()[pipe.node.index()].name.clone();
            return Err(ExactError::NotLinear { name });
        }
        if let Some(name) = network.first_sampled() {
            return Err(ExactError::NotLinear { name });
        }
        let breakpoints = network.breakpoints(start, stop)?;
        let reduced = Reduced::with_streams(network)?;
        let mut rows = Rows::new(network, &reduced, (start, times))?;
        let inputs = Inputs::new(network, rows.reference);
        let lengths = (usual(start, times), stop - start);
        let mut march = March::new(inputs, &reduced, &rows.rises, lengths)?;
        rows.start(&march);
        for segment in segments(start, stop, &breakpoints) {
            rows.segment(&mut march, segment)?;
        }
        let (carried, apart) = march.carried();
        Ok(Self {
            times: times.to_vec(),
            nodes: network.nodes().len(),
            states: reduced.states.len(),
            carried,
            quadrature: march.series_error(),
            rounding: rows.rounding() + apart,
            temperatures: rows.temperatures,
        })
    }

    /// The times in s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Temperatures of all nodes at one of the times, in K.
    pub fn row(&self, row: usize) -> &[f64] {
        &self.temperatures[row * self.nodes..(row + 1) * self.nodes]
    }

    /// Temperature of a node over the times in K.
    pub fn temperature(&self, node: NodeId) -> Vec<f64> {
        (0..self.times.len()).map(|row| self.row(row)[node.index()]).collect()
    }

    /// Number of nodes with capacity, which is the number of modes if no stream flows.
    pub fn states(&self) -> usize {
        self.states
    }

    /// Number of them that streams join: they are solved by the exponential of a matrix, the others
    /// by modes.
    pub fn carried(&self) -> usize {
        self.carried
    }

    /// Error of integrating inputs that are neither constant nor straight, in K; `None` if there
    /// are none, so that everything is in closed form.
    pub fn quadrature_error(&self) -> Option<f64> {
        self.quadrature
    }

    /// An estimate of its own error in K: quadrature and rounding. The latter is the miss of the
    /// modes at the start, a few units in the last place of a temperature, and a residual. For it,
    /// the rates of change of the modes are put into the heat balance of every node at some 32 of
    /// the rows after the start. The rest counts as heat that lasts for the whole run. With
    /// streams, it adds the distance of two ways of the matrix exponential, by steps of a row and
    /// of a third of it.
    pub fn own_error(&self) -> f64 {
        self.quadrature.unwrap_or(0.0) + self.rounding
    }

    /// The largest difference of a run from this; `None` unless it recorded every node at these
    /// times.
    pub fn difference(&self, solution: &Solution) -> Option<Difference> {
        let same = solution.recorded().len() == self.nodes && solution.times() == self.times;
        same.then(|| Difference::largest(solution, |row| self.row(row))).flatten()
    }
}

impl Difference {
    /// The largest difference between the rows of a run that recorded every node and those of a
    /// reference; `None` for a run without rows.
    pub(crate) fn largest<'a>(
        solution: &Solution,
        reference: impl Fn(usize) -> &'a [f64],
    ) -> Option<Self> {
        let nodes: Vec<NodeId> = solution.recorded().to_vec();
        let mut found = Self::unseen(*nodes.first()?, *solution.times().first()?, nodes.len());
        for (row, &time) in solution.times().iter().enumerate() {
            let pairs = solution.row(row).iter().zip(reference(row)).zip(&nodes);
            for (place, ((a, b), &node)) in pairs.enumerate() {
                found.see((place, node), time, (a - b).abs());
            }
        }
        Some(found)
    }

    /// No difference seen yet, of this number of nodes.
    pub(crate) fn unseen(node: NodeId, time: f64, nodes: usize) -> Self {
        Self { largest: -1.0, node, time, by_node: vec![0.0; nodes] }
    }

    /// Takes in the difference in K of a node, at `place` among those compared; in total order, so
    /// that a NaN is larger than any number.
    pub(crate) fn see(&mut self, (place, node): (usize, NodeId), time: f64, difference: f64) {
        let most = &mut self.by_node[place];
        if difference.total_cmp(most).is_gt() {
            *most = difference;
        }
        if difference.total_cmp(&self.largest).is_gt() {
            (self.largest, self.node, self.time) = (difference, node, time);
        }
    }
}

/// The most frequent distance of two rows in s: that in the middle, by size.
fn usual(start: f64, times: &[f64]) -> f64 {
    let before = std::iter::once(&start).chain(times);
    let mut distances: Vec<f64> =
        times.iter().zip(before).map(|(t, before)| t - before).filter(|d| *d > 0.0).collect();
    distances.sort_by(f64::total_cmp);
    distances.get(distances.len() / 2).copied().unwrap_or(1.0)
}

/// Approximate number of rows at which the modes are tested.
const DEFECTS: usize = 31;

/// The rows, written in order.
struct Rows<'a> {
    reduced: &'a Reduced,
    /// Start of the run in s.
    begin: f64,
    times: &'a [f64],
    next: usize,
    /// Temperature in K that all rises are counted from.
    reference: f64,
    rises: Vec<f64>,
    temperatures: Vec<f64>,
    nodes: usize,
    /// Largest rise up to now.
    span: f64,
    /// Miss of the modes at the start, and their largest defect up to now, in K.
    missed: f64,
    defect: f64,
}

impl<'a> Rows<'a> {
    fn new(
        network: &Network,
        reduced: &'a Reduced,
        (begin, times): (f64, &'a [f64]),
    ) -> Result<Self, ExactError> {
        let initial = reduced.initial(network)?;
        // rises over a temperature of the network itself are small numbers with small rounding
        // errors
        let reference = initial.first().copied().unwrap_or(lptn_network::ZERO_CELSIUS);
        let rises: Vec<f64> = initial.iter().map(|t| t - reference).collect();
        let nodes = network.nodes().len();
        let temperatures = Vec::with_capacity(times.len() * nodes);
        Ok(Self {
            reduced,
            begin,
            times,
            next: 0,
            reference,
            rises,
            temperatures,
            nodes,
            span: 0.0,
            missed: 0.0,
            defect: 0.0,
        })
    }

    /// Goes through a segment; a row at its end is left to the next one, unless it is the last of
    /// all.
    fn segment(&mut self, march: &mut March<'_>, segment: Segment) -> Result<(), ExactError> {
        march.enter(segment.inside());
        let mut now = segment.from;
        while let Some(&time) = self.times.get(self.next) {
            let last = self.next + 1 == self.times.len();
            if time > segment.to || (time >= segment.to && !last) {
                break;
            }
            if time > now {
                march.advance(now, time)?;
                now = time;
            }
            self.push(march, time)?;
        }
        if now < segment.to {
            march.advance(now, segment.to)?;
        }
        Ok(())
    }

    fn push(&mut self, march: &mut March<'_>, time: f64) -> Result<(), ExactError> {
        if self.is_tested(time) {
            self.defect = self.defect.max(march.defect(time)?);
        }
        let mut known = march.rises();
        let states = known.len();
        known.extend(march.inputs(time)?);
        let mut row = vec![f64::NAN; self.nodes];
        for (id, rise) in self.reduced.states.iter().zip(&known[..states]) {
            row[id.index()] = *rise;
        }
        for (m, id) in self.reduced.massless.iter().enumerate() {
            let parts =
                known.iter().enumerate().map(|(j, value)| self.reduced.recovery[(m, j)] * value);
            row[id.index()] = parts.sum();
        }
        self.span = row.iter().fold(self.span, |span, rise| span.max(rise.abs()));
        self.temperatures.extend(row.iter().map(|rise| self.reference + rise));
        self.next += 1;
        Ok(())
    }

    /// True if the modes are tested at the next row, which is at `time`. The start is not tested:
    /// rates of change that vanish at once would count, by their rounding, as heat that lasts. The
    /// rest of them shows at the second row.
    fn is_tested(&self, time: f64) -> bool {
        let regular = self.next.is_multiple_of(self.times.len() / DEFECTS + 1);
        time > self.begin && (regular || self.next == 1 || self.next + 1 == self.times.len())
    }

    /// Compares the start of the modes with the actual one.
    fn start(&mut self, march: &March<'_>) {
        let found = march.rises();
        let missed = found.iter().zip(&self.rises).map(|(a, b)| (a - b).abs());
        self.missed = missed.fold(0.0, f64::max);
    }

    /// See [`ExactSolution::own_error`].
    fn rounding(&self) -> f64 {
        4.0 * f64::EPSILON * (self.reference + self.span) + self.missed + self.defect
    }
}
