//! A network near one of its states as one node: the equivalent of its linearisation.
//!
//! The slopes give the resistance, and the heat of the sources at the state is `Q_N`. `T_ref` is
//! the remainder: it makes temperature and heat of the port right at the state. It is not a
//! weighted mean of boundaries. The result is not written as a netlist, which would lose its range.

use lptn_assembly::ThermalSystem;
use lptn_network::NodeId;
use lptn_solve::{Drive, FrequencyResponse, Linearised, Snapshot, StepAnswer, settled_rises};

use crate::capacity::least_squares;
use crate::definition::{Definition, Pair, recommended};
use crate::deviation;
use crate::error::ReduceError;
use crate::norton::{Inputs, NortonEquivalent, grounded, warms};
use crate::reduction::{Dynamics, Reduction, ReductionOptions, window};
use crate::step::{ResponseTerm, StepResponse};

/// Modes with a smaller share of the resistance are ignored.
const VISIBLE: f64 = 1e-9;

/// A rate whose relative imaginary part is larger than this oscillates.
const REAL: f64 = 1e-9;

impl Reduction {
    /// Reduces a system near one of its states, with its linearisation `linear`: small disturbances
    /// at `port` see this resistance and these capacities. `Q_N` weighs the heat of the sources
    /// there, and `T_ref` gives the equivalent the port's temperature and heat there. In a state
    /// that is not settled it includes the heat that nodes store. No run is compared; pairs are
    /// judged by a step. If modes oscillate or coincide, only the sum and the first moment are
    /// given, as with streams.
    ///
    /// # Errors
    /// [`ReduceError`]
    pub fn near(
        system: &ThermalSystem,
        port: NodeId,
        (linear, state): (&Linearised<'_>, &Snapshot),
        options: &ReductionOptions,
    ) -> Result<Self, ReduceError> {
        if let Some(window) = options.window.filter(|w| !(w.is_finite() && *w > 0.0)) {
            return Err(ReduceError::Window(window));
        }
        let network = system.network();
        grounded(network, port)?;
        let step = StepAnswer::new(linear, Drive::Node(port))?;
        warms(network, port, &step.settled)?;
        let norton = norton(system, port, (linear, &step))?;
        let stored = settled_rises(linear, &[state.stored(network)])?;
        let temperature = state.temperatures[port.index()];
        let heat = norton.heat(&state.source_heat);
        // if nothing is stored this is the temperature itself
        let rests = temperature + stored[0][port.index()];
        let inputs = Inputs { reference: rests - norton.resistance * heat, heat };
        let capacities = capacities(linear, &norton)?;
        let dynamics = (capacities[0].1 > 0.0)
            .then(|| dynamics(response(&step, port), capacities, norton.resistance, options));
        Ok(Self { norton, inputs, initial: temperature, dynamics })
    }
}

fn norton(
    system: &ThermalSystem,
    port: NodeId,
    (linear, step): (&Linearised<'_>, &StepAnswer),
) -> Result<NortonEquivalent, ReduceError> {
    let network = system.network();
    let count = network.nodes().len();
    let unit = |node: usize| {
        let mut heat = vec![0.0; count];
        heat[node] = 1.0;
        heat
    };
    let heats: Vec<Vec<f64>> = (0..count).map(unit).collect();
    let influence: Vec<f64> =
        settled_rises(linear, &heats)?.iter().map(|rises| rises[port.index()]).collect();
    let resistance = step.settled[port.index()];
    let weight = |source: &lptn_network::Source| -> f64 {
        source.into.iter().map(|(node, share)| share * influence[node.index()]).sum::<f64>()
            / resistance
    };
    let boundary = |id| {
        let rises = FrequencyResponse::new(linear, Drive::Boundary(id))?.at(0.0)?;
        Ok(rises[port.index()].re)
    };
    Ok(NortonEquivalent {
        port,
        resistance,
        response: step.settled.clone(),
        boundary_weights: network
            .boundary_ids()
            .map(boundary)
            .collect::<Result<_, ReduceError>>()?,
        source_weights: network.sources().iter().map(weight).collect(),
        influence,
    })
}

/// The sum of the capacities there that heat from the port reaches, and the first moment over the
/// resistance squared, in J/K.
fn capacities(
    linear: &Linearised<'_>,
    norton: &NortonEquivalent,
) -> Result<Vec<(Definition, f64)>, ReduceError> {
    let network = linear.system().network();
    let stores = || linear.system().states().iter().zip(linear.capacity());
    let warms = |id: NodeId| norton.response[id.index()] != 0.0 && network.is_thermal(id);
    let sum = stores().filter(|(id, _)| warms(**id)).map(|(_, c)| c).sum();
    let states = || stores().map(|(id, c)| (id.index(), c));
    let moment: f64 = states().map(|(i, c)| norton.influence[i] * c * norton.response[i]).sum();
    let squared = norton.resistance * norton.resistance;
    Ok(vec![(Definition::Sum, sum), (Definition::FirstMoment, moment / squared)])
}

/// The step at the port as rising exponentials; `None` if some oscillate, fall or coincide.
fn response(step: &StepAnswer, port: NodeId) -> Option<StepResponse> {
    let node = port.index();
    let (resistance, direct) = (step.settled[node], step.direct(node));
    let seen = step.terms(node).filter(|(_, share)| share.norm() > VISIBLE * resistance);
    let term = |(rate, share): (lptn_solve::Complex, lptn_solve::Complex)| {
        let rises = rate.re > 0.0 && rate.im.abs() <= REAL * rate.re && share.re > 0.0;
        let (tau, resistance) = (rate.re.recip(), share.re);
        rises.then_some(ResponseTerm { tau, resistance, error: 0.0 })
    };
    let mut terms: Vec<ResponseTerm> =
        if step.has_terms() { seen.map(term).collect::<Option<_>>()? } else { return None };
    terms.sort_by(|a, b| b.tau.total_cmp(&a.tau));
    let sum: f64 = terms.iter().map(|term| term.resistance).sum();
    let residual = (resistance - direct - sum).abs();
    (!terms.is_empty()).then_some(StepResponse { resistance, direct, terms, residual })
}

fn dynamics(
    step: Option<StepResponse>,
    mut capacities: Vec<(Definition, f64)>,
    resistance: f64,
    options: &ReductionOptions,
) -> Dynamics {
    let window = step.as_ref().map(|step| window(step, options));
    if let Some((step, window)) = step.as_ref().zip(window) {
        capacities.push((Definition::DominantPole, step.slowest().tau / resistance));
        capacities.push((Definition::LeastSquares, least_squares(step, window.length())));
    }
    let (allowed, share) = (options.allowed, options.allowed.share());
    let pair = |(definition, capacity): (Definition, f64)| Pair {
        definition,
        capacity,
        step: step.as_ref().map(|step| deviation::of_step(step, capacity, share)),
        run: None,
    };
    let pairs: Vec<Pair> = capacities.into_iter().map(pair).collect();
    let recommended = recommended(&pairs, options.judge, (0.0, 1e-9 * resistance));
    Dynamics { step, window, pairs, recommended, tolerance: None, rise: None, allowed }
}
