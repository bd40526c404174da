//! Many candidates of one linear network, without a system for each: steady states by elimination,
//! runs in closed form by all modes of small networks and by enough vectors for others.
//!
//! Plain loops over small dense matrices, in one order: nothing here depends on the processor.
//!
//! Only the numbers that depend on the varied parameters are evaluated again, with the checks of
//! `Numbers::evaluate` (`Network::variants`). The order of elimination and its fill are found once
//! (`star.rs`). Between two bends of the inputs a run is a sum of exponentials, whose extremes and
//! crossings are roots. It has all modes up to 48 nodes, and beyond that a Lanczos space. The
//! decomposition is a plain Householder and QL, not faer's, so that rows do not depend on the
//! processor. Unsuitable candidates take the ordinary way, one by one: a number that the network
//! refuses, or rates too far apart. A row therefore never depends on its neighbours.

mod course;
mod krylov;
mod modes;
mod run;
mod star;

use lptn_network::{End, Followed, HeatOf, InputError, Network, ParameterId, Value, Variants};

use crate::limit;
use crate::times::{Segment, segments};
use course::{Course, Stretch};
pub use course::{CourseSeen, Look};
use krylov::Krylov;
use modes::Modes;
use star::{Link, Plan, Star};

/// Nodes with capacity beyond which not all modes are computed.
const MOST_MODES: usize = 48;

/// Nodes beyond which candidates are assembled one by one.
const MOST_NODES: usize = 2000;

/// The candidates of a linear network, one after the other.
pub struct LinearVariants<'a> {
    variants: Variants<'a>,
    network: &'a Network,
    /// True if inputs change with time.
    timed: bool,
    plan: Plan,
    star: Star,
    /// For networks of more than a few nodes.
    krylov: Option<Krylov>,
    modes: Modes,
    boundaries: Vec<f64>,
    powers: Vec<f64>,
    /// Temperatures of the nodes in K.
    temperatures: Vec<f64>,
    /// Heat flows that expressions of results name.
    heats: Vec<HeatOf>,
    named: Vec<f64>,
    march: March,
}

/// A quantity whose time history is followed: an expression that is linear in one temperature or
/// heat flow.
#[derive(Clone, Copy, Debug)]
pub struct Quantity<'a> {
    /// The expression.
    pub value: &'a Value,
    /// The temperature or heat flow, [`Network::follows`].
    pub with: Followed,
    /// Its requested results.
    pub look: Look,
}

/// State that passes from segment to segment of a run.
#[derive(Clone, Debug, Default)]
struct March {
    /// Rise of each node over the reference in K.
    state: Vec<f64>,
    /// The straight line that each node tends to, in K and K/s.
    level: Vec<f64>,
    slope: Vec<f64>,
    /// Difference of the state from it, and that as a sum of modes.
    rest: Vec<f64>,
    left: Vec<f64>,
    stretch: Stretch,
    /// Inputs at the ends of the segment.
    first: (Vec<f64>, Vec<f64>),
    /// Shares of the modes in a quantity.
    parts: Vec<f64>,
    /// A quantity as a sum over nodes and boundaries.
    nodes: Vec<(usize, f64)>,
    boundaries: Vec<(usize, f64)>,
}

impl<'a> LinearVariants<'a> {
    /// For candidates in which these parameters differ; `None` for an unsuitable network.
    pub fn new(network: &'a Network, changed: &[ParameterId]) -> Option<Self> {
        let variants = network.variants(changed)?;
        let heats: Vec<HeatOf> = network.named_heats().collect();
        let plain = |heat: &HeatOf| {
            matches!(heat, HeatOf::Conductor(_) | HeatOf::Source(_) | HeatOf::Boundary(_))
        };
        let (nodes, boundaries) = (network.nodes().len(), network.boundaries().len());
        if nodes > MOST_NODES || nodes == 0 || boundaries == 0 || !heats.iter().all(plain) {
            return None;
        }
        let massless: Vec<bool> = network.nodes().iter().map(|node| node.massless).collect();
        let plan = Plan::new(&massless, network.conductors())?;
        let small = nodes - plan.massless <= MOST_MODES;
        Some(Self {
            star: Star::new(&plan),
            krylov: (!small).then(|| Krylov::new(&plan)),
            plan,
            timed: network.has_time_dependent_inputs(),
            modes: Modes::default(),
            march: March::default(),
            boundaries: vec![0.0; boundaries],
            powers: vec![0.0; network.sources().len()],
            temperatures: vec![0.0; nodes],
            named: vec![0.0; heats.len()],
            heats,
            variants,
            network,
        })
    }

    /// Gives the parameters these values in SI units: `false` if the network refuses them.
    pub fn set(&mut self, values: &[f64]) -> bool {
        self.variants.set(values)
    }

    /// The scope in which expressions of results find the last solution.
    pub fn scope(&mut self) -> &mut lptn_network::Evaluation {
        self.variants.scope()
    }

    /// The margin of each limit at the last steady state, as those of a
    /// [`SteadyState`](crate::SteadyState).
    ///
    /// # Errors
    /// [`InputError`] if a limit cannot be evaluated.
    pub fn limit_margins(&mut self) -> Result<Vec<f64>, InputError> {
        limit::margins(self.network, self.variants.scope())
    }

    /// Solves the steady state with inputs as they are at `time` in s, for
    /// [`LinearVariants::scope`]. `None` if a number fails or a node leads to no boundary.
    pub fn steady(&mut self, time: f64) -> Option<()> {
        self.inputs(time, time)?;
        let reference = self.boundaries[0];
        self.star.begin(&self.plan, &self.variants.conductance);
        self.star.eliminate(&self.plan, 0..self.plan.order.len())?;
        let mut heat = std::mem::take(&mut self.temperatures);
        self.heat(|b| self.boundaries[b] - reference, |s| self.powers[s], &mut heat);
        self.star.solve(&self.plan, &mut heat);
        self.temperatures = heat;
        self.temperatures.iter_mut().for_each(|t| *t += reference);
        self.temperatures.iter().all(|t| *t >= 0.0 && t.is_finite()).then(|| self.place())
    }

    /// Heat into each node in W from surroundings with these rises and from sources of these powers.
    fn heat(&self, rise: impl Fn(usize) -> f64, power: impl Fn(usize) -> f64, into: &mut [f64]) {
        into.fill(0.0);
        for (link, &g) in self.plan.links.iter().zip(&self.variants.conductance) {
            if let Link::Boundary(place, boundary) = *link {
                into[self.plan.order[place]] += g * rise(boundary);
            }
        }
        for (i, source) in self.network.sources().iter().enumerate() {
            let power = power(i);
            source.into.iter().for_each(|(node, share)| into[node.index()] += share * power);
        }
    }

    /// Reads the inputs at a time in s, comparisons at one inside the segment.
    fn inputs(&mut self, time: f64, inside: f64) -> Option<()> {
        let scope = self.variants.scope();
        scope.set_time(time, inside);
        self.network.boundary_temperatures(scope, &mut self.boundaries).ok()?;
        self.network.source_powers(scope, &mut self.powers).ok()
    }

    /// Puts temperatures and heat flows into the scope of expressions.
    fn place(&mut self) {
        for named in 0..self.heats.len() {
            self.named[named] = match self.heats[named] {
                HeatOf::Conductor(id) => self.flow(id.index()),
                HeatOf::Source(id) => self.powers[id.index()],
                HeatOf::Boundary(id) => self.given(End::Boundary(id)),
                // there are no others: `new` has checked
                _ => f64::NAN,
            };
        }
        let scope = self.variants.scope();
        scope.set_temperatures(&self.temperatures, &self.boundaries);
        scope.set_heats(&self.named);
    }

    /// Heat that a boundary gives in W.
    fn given(&self, at: End) -> f64 {
        let conductors = self.network.conductors().iter().enumerate();
        conductors.fold(0.0, |sum, (i, conductor)| match (conductor.from, conductor.to) {
            (from, _) if from == at => sum + self.flow(i),
            (_, to) if to == at => sum - self.flow(i),
            _ => sum,
        })
    }

    /// Heat from `from` to `to` of a conductor in W.
    fn flow(&self, conductor: usize) -> f64 {
        let of = &self.network.conductors()[conductor];
        let at = |end: End| match end {
            End::Node(id) => self.temperatures[id.index()],
            End::Boundary(id) => self.boundaries[id.index()],
        };
        self.variants.conductance[conductor] * (at(of.from) - at(of.to))
    }
}
