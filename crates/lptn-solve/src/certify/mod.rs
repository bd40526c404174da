//! A proven bound on the error of every temperature of a run.
//!
//! The integrator's solution is sampled in every step and replaced by polynomials (`way.rs`). Put
//! into the network they leave a defect, the heat that is missing at each node; its largest value
//! over the step follows from the form of the laws (`defect.rs`). Thermal networks are cooperative:
//! a warmer neighbour warms. So the defect bounds the error node by node (`bound.rs`), also where
//! laws depend on temperature; a slope of the wrong sign counts with its absolute value, which
//! only widens the bound. The bound of a massless node is the mean of those around it.
//!
//! Nothing is taken from the integrator but numbers, and each bound is checked after it is found.
//! Covered are networks without switches, pipes, heat contents over temperature, capacities that
//! follow states, and balances of massless nodes; [`Uncertified`] names the others. Rounding is
//! not directed: margins of some rounding errors of each sum are added.

mod bound;
mod collocation;
mod defect;
mod of_solution;
mod polynomial;
pub(crate) mod results;
mod shifted;
mod steady;
mod way;

use lptn_assembly::ThermalSystem;
use lptn_integrate::{IntegrateError, Pattern};
use lptn_network::{Evaluation, Item, Network, NodeId};
use lptn_units::Taylor;

use bound::{Bound, Line};
use collocation::Collocation;
pub(crate) use of_solution::farthest;
use results::{ResultBounds, Results, Rows};
use way::{INTEGRATED, SAMPLES, Way};

use crate::readings::pieces;

/// Rounding errors of a sum of heats, as a share of the sum of their absolute values.
pub(crate) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Times that a tube around the way is widened before the step counts as lost.
const WIDENED: usize = 24;

/// Most halvings of a step.
const HALVINGS: usize = 10;

/// The share of the tolerance that a piece may add to a bound.
const SHARE: f64 = 1e-3;

/// The first tube is this much wider than the bounds at the start of a step.
const WIDER: f64 = 2.0;

/// Least half-width of a tube in K.
const LEAST_WIDTH: f64 = 1e-12;

lptn_units::errors! {
/// Reason why a run has no proven bounds.
#[derive(Clone, Debug, PartialEq)]
pub enum Uncertified {
    /// Something switches; its name.
    Switches { name: String } = "certify::switches",
        format!("`{name}` switches: a bound on the time of a switch is not available"),
        help "run it without --certify: `lptn verify` compares it with a finer run",
        class lptn_units::Class::No;
    /// A kind of node that is not covered: its name.
    Node { name: String, because: String } = "certify::node",
        format!("`{name}` {because}: its error has no proven bound"),
        help "run it without --certify: `lptn verify` compares it with a finer run",
        class lptn_units::Class::No;
    /// The law of an element has no bounds; its name and the time in s.
    Law { name: String, time: f64 } = "certify::law",
        format!(
            "the heat of `{name}` has no bounds at {} s: its law decides by a value there",
            lptn_units::format_six(*time)
        ),
        help "run it without --certify: `lptn verify` compares it with a finer run",
        class lptn_units::Class::No;
    /// The bound grows without limit from this time in s on.
    Lost { time: f64 } = "certify::lost",
        format!("no bound on the errors was found from {} s on", lptn_units::format_six(*time)),
        help "choose a smaller tolerance, `--tolerance`, or run without --certify",
        class lptn_units::Class::Numbers;
}
}

impl Uncertified {
    /// The reason for a network in which nothing stores heat.
    pub(crate) fn without_state(system: &ThermalSystem) -> Self {
        let first = system.network().nodes().first();
        let name = first.map_or_else(String::new, |node| node.name.clone());
        Self::Node { name, because: "stores no heat".to_owned() }
    }
}

/// Proven bounds on the errors of the temperatures of a run.
#[derive(Clone, Debug, Default)]
pub struct Certificate {
    /// Row by row, one bound in K for each recorded node.
    pub(crate) rows: Vec<f64>,
    /// For each recorded node a bound in K over the whole run, rows or not.
    pub(crate) most: Vec<f64>,
    /// Bounds on the results that follow from temperatures.
    pub(crate) results: ResultBounds,
}

/// Follows a run and bounds its errors.
pub(crate) struct Certifier<'a> {
    system: &'a ThermalSystem,
    pattern: Pattern,
    scope: Evaluation,
    basis: [[f64; SAMPLES]; SAMPLES],
    /// The same for samples of the integrator's solution.
    integrated: [[f64; INTEGRATED]; INTEGRATED],
    collocation: Collocation<'a>,
    /// The most in K that a piece may add to a bound without being halved.
    allowed: f64,
    bound: Bound,
    recorded: Vec<NodeId>,
    times: Vec<f64>,
    certificate: Certificate,
    /// The slopes of a system without elements, which are the same everywhere.
    constant: Option<Vec<f64>>,
    /// The way at the end of the last step.
    arrived: Vec<f64>,
    results: Results<'a>,
}

/// The way over a piece, and the distance in K of the integrator's solution from it.
struct Piece {
    way: Way,
    apart: Vec<f64>,
}

/// Writes the state at a time of the present step.
pub(crate) type StateAt<'a> = dyn FnMut(f64, &mut [f64]) -> Result<(), IntegrateError> + 'a;

impl<'a> Certifier<'a> {
    /// A certifier from a start on whose temperatures, in K, are exact.
    pub(crate) fn new(
        system: &'a ThermalSystem,
        Rows { recorded, columns, times, readings }: Rows<'_>,
        (start, tolerance): (&[f64], f64),
    ) -> Result<Self, Uncertified> {
        is_covered(system)?;
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let lost = |_| Uncertified::Lost { time: times[0] };
        let basis = way::basis();
        let collocation = Collocation::new(system, &pattern, &basis).map_err(lost)?;
        let bound = Bound::new(pattern.clone(), system.mass()).map_err(lost)?;
        let constant = system.is_linear().then(|| {
            let mut slopes = vec![0.0; system.pattern().entries()];
            system.jacobian(&mut slopes);
            slopes
        });
        Ok(Self {
            system,
            pattern,
            scope: system.network().evaluation(),
            basis,
            integrated: way::basis(),
            collocation,
            allowed: SHARE * tolerance,
            bound,
            recorded: recorded.to_vec(),
            times: times.to_vec(),
            certificate: Certificate { most: vec![0.0; recorded.len()], ..Certificate::default() },
            constant,
            arrived: start.to_vec(),
            results: Results::new(system, (recorded, columns), readings.clone()),
        })
    }

    /// Takes the part of a step from `from` to `to` in s, with comparisons of time as they are at
    /// `inside`.
    pub(crate) fn step(
        &mut self,
        ((from, to), inside): ((f64, f64), f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(), Uncertified> {
        let parts = pieces(self.results.breaks(), (from, to));
        parts.into_iter().try_for_each(|(part, _)| self.piece((part, inside), 0, state_at))
    }

    /// A part of a step, which is halved until its own share of the bounds is small.
    fn piece(
        &mut self,
        ((from, to), inside): ((f64, f64), f64),
        halvings: usize,
        state_at: &mut StateAt<'_>,
    ) -> Result<(), Uncertified> {
        let found = self.over(((from, to), inside), state_at);
        let middle = 0.5 * (from + to);
        let halves = halvings < HALVINGS && from < middle && middle < to;
        if halves && !found.as_ref().is_ok_and(|(_, line)| line.adds() <= self.allowed) {
            self.piece(((from, middle), inside), halvings + 1, state_at)?;
            return self.piece(((middle, to), inside), halvings + 1, state_at);
        }
        let (piece, line) = found?;
        let lost = |_| Uncertified::Lost { time: from };
        self.write_rows(((from, to), &line), &piece, state_at).map_err(lost)?;
        self.results.take(&mut self.scope, (from, to), (&piece.way, &line));
        self.bound.go(&line);
        self.arrived = (0..piece.way.len()).map(|i| piece.way.at(i, 1.0)).collect();
        Ok(())
    }

    /// The way over a piece, and the bounds around it.
    fn over(
        &mut self,
        ((from, to), inside): ((f64, f64), f64),
        state_at: &mut StateAt<'_>,
    ) -> Result<(Piece, Line), Uncertified> {
        let half = 0.5 * (to - from);
        let time_of = |place: f64| (from + half * (1.0 + place)).clamp(from, to);
        let times = way::places::<SAMPLES>().map(time_of);
        let mut state_of = |time: f64| {
            let mut state = vec![0.0; self.arrived.len()];
            state_at(time, &mut state).map_err(|_| Uncertified::Lost { time: from })?;
            Ok(state)
        };
        let mut samples =
            times[1..].iter().map(|time| state_of(*time)).collect::<Result<Vec<_>, _>>()?;
        samples.insert(0, self.arrived.clone());
        let given = way::places::<INTEGRATED>().map(|place| state_of(time_of(place)));
        let corrected = self.collocation.correct((&times, inside), &mut samples);
        corrected.ok_or(Uncertified::Lost { time: from })?;
        let way = Way::through(&samples, &self.basis);
        let given = given.into_iter().collect::<Result<Vec<_>, _>>()?;
        let values = |i: usize| std::array::from_fn(|place| given[place][i]);
        let apart = (0..way.len()).map(|i| way.apart(i, values(i), &self.integrated)).collect();
        let gaps: Vec<f64> =
            self.arrived.iter().enumerate().map(|(i, t)| (way.at(i, -1.0) - t).abs()).collect();
        let before = self.bound.now().to_vec();
        self.bound.widen(gaps.into_iter());
        let line = self.line(((from, to), inside), &way);
        if line.is_err() {
            self.bound.set(before);
        }
        Ok((Piece { way, apart }, line?))
    }

    /// The bounds over a step: those that hold in a tube which they do not leave.
    fn line(
        &mut self,
        ((from, to), inside): ((f64, f64), f64),
        way: &Way,
    ) -> Result<Line, Uncertified> {
        let lost = || Uncertified::Lost { time: from };
        let (mut defect, whole) = self.defect(((from, to), inside), way)?;
        if let Some(slopes) = self.constant.take() {
            self.round(&slopes, &whole, &mut defect);
            let line = self.bound.over(to - from, &slopes, &defect);
            self.constant = Some(slopes);
            return line.ok_or_else(lost);
        }
        let mut still = {
            let [over, _] = self.system.network().input_bounds(&mut self.scope, (from, to), inside);
            over.still()
        };
        let mut widths: Vec<f64> =
            self.bound.now().iter().map(|w| (WIDER * w).max(LEAST_WIDTH)).collect();
        for _ in 0..WIDENED {
            let ranges = whole.iter().zip(&widths);
            let tube: Vec<[f64; 2]> = ranges.map(|([low, high], w)| [low - w, high + w]).collect();
            let slopes = self.system.enclose_slopes(&mut still, &tube);
            let slopes = slopes.map_err(|item| self.no_law(item, from))?;
            let mut all = defect.clone();
            all.iter_mut().zip(&slopes.jumps).for_each(|(all, jump)| *all += jump);
            let matrix = slopes.worst(self.system);
            self.round(&matrix, &whole, &mut all);
            let line = self.bound.over(to - from, &matrix, &all).ok_or_else(lost)?;
            let reached: Vec<f64> = (0..widths.len()).map(|i| line.most(i)).collect();
            if !reached.iter().all(|most| most.is_finite()) {
                return Err(lost());
            }
            if reached.iter().zip(&widths).all(|(most, width)| most <= width) {
                return Ok(line);
            }
            let wider = reached.iter().zip(&widths);
            widths = wider.map(|(most, width)| (WIDER * most).max(*width)).collect();
        }
        Err(lost())
    }

    /// The largest defect of each unknown in W over a step, and its range of temperatures in K.
    fn defect(
        &mut self,
        ((from, to), inside): ((f64, f64), f64),
        way: &Way,
    ) -> Result<(Vec<f64>, Vec<[f64; 2]>), Uncertified> {
        let system = self.system;
        let network = system.network();
        let whole: Vec<Taylor> = (0..way.len()).map(|i| way.whole(i)).collect();
        let middle: Vec<Taylor> = (0..way.len()).map(|i| way.middle(i)).collect();
        let [mut over, mut at] = network.input_bounds(&mut self.scope, (from, to), inside);
        let no_law = |item| self.no_law(item, from);
        let over = system.enclose_flow(&mut over, &whole).map_err(no_law)?;
        let at = system.enclose_flow(&mut at, &middle).map_err(no_law)?;
        let per_second = 2.0 / (to - from);
        let mass = system.mass();
        let defect = |i: usize| {
            let stores = Taylor::constant(mass[i] * per_second);
            let taken = |flow: Taylor, way: Taylor| flow - stores * way.derivative();
            let bound =
                defect::largest(&taken(at.flow[i], middle[i]), &taken(over.flow[i], whole[i]));
            let [low, high] = whole[i].term(1);
            bound + over.spread[i] + ROUNDING * mass[i] * per_second * low.abs().max(high.abs())
        };
        let all: Vec<f64> = (0..way.len()).map(defect).collect();
        if all.iter().any(|defect| !defect.is_finite()) {
            return Err(Uncertified::Lost { time: from });
        }
        let ranges = whole.iter().map(|bounds| bounds.range().unwrap_or([f64::NAN; 2])).collect();
        Ok((all, ranges))
    }

    /// Adds the rounding of the heats.
    fn round(&self, matrix: &[f64], ranges: &[[f64; 2]], defect: &mut [f64]) {
        let absolute: Vec<f64> = matrix.iter().map(|slope| slope.abs()).collect();
        let sizes: Vec<f64> = ranges.iter().map(|[low, high]| low.abs().max(high.abs())).collect();
        let mut heats = vec![0.0; defect.len()];
        self.pattern.multiply(&absolute, &sizes, &mut heats);
        defect.iter_mut().zip(heats).for_each(|(defect, heat)| *defect += ROUNDING * heat);
    }

    /// Writes the bounds of the rows up to the end of a step, and of the run so far.
    fn write_rows(
        &mut self,
        ((from, to), line): ((f64, f64), &Line),
        Piece { way, apart }: &Piece,
        state_at: &mut StateAt<'_>,
    ) -> Result<(), IntegrateError> {
        let most: Vec<f64> = (0..way.len()).map(|i| line.most(i) + apart[i]).collect();
        let most = self.of_nodes(&most);
        for (known, id) in self.certificate.most.iter_mut().zip(&self.recorded) {
            *known = known.max(most[id.index()]);
        }
        let mut state = vec![0.0; way.len()];
        while let Some(time) = self.next_row().filter(|time| *time <= to) {
            state_at(time.max(from), &mut state)?;
            let place = (2.0 * (time - from) / (to - from) - 1.0).clamp(-1.0, 1.0);
            let off = |i: usize| (state[i] - way.at(i, place)).abs();
            let bounds: Vec<f64> =
                (0..way.len()).map(|i| line.at(i, (time - from).max(0.0)) + off(i)).collect();
            self.results.row(&mut self.scope, time, &state, &bounds);
            let nodes = self.of_nodes(&bounds);
            let row = self.recorded.iter().map(|id| nodes[id.index()]);
            self.certificate.rows.extend(row);
        }
        Ok(())
    }

    fn next_row(&self) -> Option<f64> {
        let width = self.recorded.len().max(1);
        self.times.get(self.certificate.rows.len() / width).copied()
    }

    /// Bounds of all nodes in K from those of the unknowns.
    fn of_nodes(&self, unknowns: &[f64]) -> Vec<f64> {
        self.system.spread_bounds(unknowns)
    }

    fn no_law(&self, item: Item, time: f64) -> Uncertified {
        Uncertified::Law { name: self.system.network().name_of(item).into_owned(), time }
    }

    pub(crate) fn into_certificate(self) -> Certificate {
        Certificate { results: self.results.into_found(), ..self.certificate }
    }
}

/// Refuses states that change at their samples.
fn no_samples(network: &Network) -> Result<(), Uncertified> {
    network
        .first_sampled()
        .map_or(Ok(()), |name| Err(Uncertified::Node { name, because: "is sampled".to_owned() }))
}

/// Refuses the parts of a network that have no bounds.
fn is_covered(system: &ThermalSystem) -> Result<(), Uncertified> {
    let network = system.network();
    let name = |id: NodeId| network.nodes()[id.index()].name.clone();
    if let Some(id) = network.control_ids().next() {
        let name = network.name_of(Item::Control(id)).into_owned();
        return Err(Uncertified::Switches { name });
    }
    if let Some(id) = network.switch_ids().next() {
        let (item, _) = network.place_of_switch(id);
        return Err(Uncertified::Switches { name: network.name_of(item).into_owned() });
    }
    let node = |id: NodeId, because: &str| {
        Err(Uncertified::Node { name: name(id), because: because.to_owned() })
    };
    no_samples(network)?;
    if let Some(pipe) = network.pipes().first() {
        return node(pipe.node, "is a pipe, whose fluid entered earlier");
    }
    if let Some(id) = network.first_varying_capacity() {
        return node(id, "has a capacity that changes");
    }
    if let Some(id) = network.state_capacities().first().map(|of| of.node) {
        return node(id, "has a capacity that follows a state");
    }
    match system.algebraic().first() {
        Some(id) => node(*id, "has no capacity and a path whose heat is not linear"),
        None => Ok(()),
    }
}

#[cfg(test)]
mod mutants;
