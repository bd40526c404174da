//! Derivatives near the reference, at one moment.

use lptn_assembly::{ChangeError, ThermalSystem};
use lptn_solve::{Rates, StateRates};

use crate::infer::error::InferError;
use crate::infer::reference::{Changed, Reference};
use crate::infer::states::States;
use crate::infer::task::InferTask;

/// Change of a temperature that shows its effects, in K. Networks with constant conductances are
/// linear, so any change will do. For others the cubic part remains, about 1e-8.
const PROPORTIONAL: f64 = 1.0;
const CURVED: f64 = 0.1;

/// Relative change of a time history or parameter, or change in SI units if it is 0.
const PART: f64 = 1e-4;

/// Derivatives at one moment.
#[derive(Clone, Debug)]
pub(crate) struct Linear {
    /// Derivatives of the rates of the states that change, row by row.
    pub(crate) rates: Vec<f64>,
    /// Effect of each state on the temperature of each node in K.
    pub(crate) nodes: Vec<Vec<(usize, f64)>>,
}

/// The network as it is, and with every time history and parameter changed to both sides.
pub(crate) struct Systems {
    pub(crate) own: ThermalSystem,
    changed: Vec<([ThermalSystem; 2], f64)>,
}

impl Systems {
    /// Changes time histories first, then parameters.
    pub(crate) fn new(
        task: &InferTask,
        (reference, times): (&Reference, &[f64]),
    ) -> Result<Self, InferError> {
        let of = |changed: Changed| {
            let network = reference.network(task, times, changed)?;
            let system = ThermalSystem::assemble(&network).map_err(ChangeError::from)?;
            Ok::<_, InferError>(system)
        };
        let both = |make: &dyn Fn(f64) -> Changed, size: f64| {
            let by = PART * if size > 0.0 { size } else { 1.0 };
            Ok(([of(make(-by))?, of(make(by))?], 2.0 * by))
        };
        let mut changed: Vec<Result<_, InferError>> = Vec::new();
        for (j, course) in reference.courses.iter().enumerate() {
            // a logarithm may come near to 0
            let least = course.iter().copied().fold(f64::INFINITY, |a, b| a.min(b.abs()));
            let most = course.iter().copied().fold(0.0, |a: f64, b| a.max(b.abs()));
            let size = if task.estimated[j].positive { least } else { most };
            changed.push(both(&|by| Changed::Course(j, by), size));
        }
        for (k, (own, value)) in task.uncertain.iter().zip(&reference.parameters).enumerate() {
            let size = value.abs().max(own.unit(*value));
            changed.push(both(&|by| Changed::Parameter(k, by), size));
        }
        let changed = changed.into_iter().collect::<Result<_, InferError>>()?;
        Ok(Self { own: of(Changed::Nothing)?, changed })
    }
}

/// Linearises at one moment after the other.
pub(crate) struct Linearise<'a> {
    task: &'a InferTask,
    states: &'a States,
    own: StateRates<'a>,
    changed: Vec<([StateRates<'a>; 2], f64)>,
    /// True if rates are the same functions of temperatures at all times.
    proportional: bool,
    /// Effects of bodies on each other and on nodes, if they are constant.
    known: Option<Vec<Rates>>,
}

impl<'a> Linearise<'a> {
    pub(crate) fn new(
        task: &'a InferTask,
        states: &'a States,
        systems: &'a Systems,
    ) -> Result<Self, InferError> {
        let changed = systems.changed.iter().map(|([below, above], by)| {
            Ok(([StateRates::new(below)?, StateRates::new(above)?], *by))
        });
        Ok(Self {
            task,
            states,
            own: StateRates::new(&systems.own)?,
            changed: changed.collect::<Result<_, InferError>>()?,
            proportional: systems.own.is_proportional(),
            known: None,
        })
    }

    /// The states at temperatures of all nodes in K.
    pub(crate) fn carried(&self, nodes: &[f64]) -> Result<Vec<f64>, InferError> {
        Ok(self.own.carried(nodes)?)
    }

    /// Derivatives at `time` in s, with these states; `slopes` is one unit of each time history's
    /// coordinate and of each parameter's in SI units.
    pub(crate) fn at(
        &mut self,
        (time, bodies): (f64, &[f64]),
        slopes: &[f64],
    ) -> Result<Linear, InferError> {
        let states = self.states;
        let mut columns: Vec<(usize, Rates)> =
            self.bodies(time, bodies)?.into_iter().enumerate().collect();
        for (i, (both, by)) in self.changed.iter_mut().enumerate() {
            let place = match i < states.estimated {
                true => states.course(i),
                false => states.parameter(i - states.estimated),
            };
            let [below, above] = both;
            let found = (below.at(time, bodies)?, above.at(time, bodies)?);
            columns.push((place, difference(&found, *by / slopes[i])));
        }
        Ok(self.put(&columns))
    }

    /// Effects of each body.
    fn bodies(&mut self, time: f64, bodies: &[f64]) -> Result<Vec<Rates>, InferError> {
        if let Some(known) = &self.known {
            return Ok(known.clone());
        }
        let by = if self.proportional { PROPORTIONAL } else { CURVED };
        let mut moved = bodies.to_vec();
        let mut all = Vec::with_capacity(bodies.len());
        for (i, own) in bodies.iter().enumerate() {
            moved[i] = own - by;
            let below = self.own.at(time, &moved)?;
            moved[i] = own + by;
            let above = self.own.at(time, &moved)?;
            moved[i] = *own;
            all.push(difference(&(below, above), 2.0 * by));
        }
        if self.proportional {
            self.known = Some(all.clone());
        }
        Ok(all)
    }

    fn put(&self, columns: &[(usize, Rates)]) -> Linear {
        let (states, size) = (self.states, self.states.moving());
        let mut rates = vec![0.0; size * size];
        let nodes = self.task.network.nodes().len();
        let mut follow: Vec<Vec<(usize, f64)>> = vec![Vec::new(); nodes];
        for (place, Rates { states: of_states, nodes: of_nodes }) in columns {
            for (i, rate) in of_states.iter().enumerate() {
                rates[i * size + place] = *rate;
            }
            for (node, change) in follow.iter_mut().zip(of_nodes) {
                if change.abs() > 0.0 {
                    node.push((*place, *change));
                }
            }
        }
        for (column, lag) in &states.slow {
            let Some(shown) = states.shown(*column) else { continue };
            for (place, weight) in measured(self.task, *column, &follow) {
                rates[shown * size + place] += weight / lag;
            }
            rates[shown * size + shown] -= 1.0 / lag;
        }
        for j in 0..states.estimated {
            rates[states.course(j) * size + states.slope(j)] = 1.0;
            rates[states.area(j) * size + states.course(j)] = 1.0;
        }
        Linear { rates, nodes: follow }
    }
}

/// Change of rates and temperatures per unit.
fn difference((below, above): &(Rates, Rates), by: f64) -> Rates {
    let slope = |below: &[f64], above: &[f64]| {
        above.iter().zip(below).map(|(above, below)| (above - below) / by).collect()
    };
    Rates { states: slope(&below.states, &above.states), nodes: slope(&below.nodes, &above.nodes) }
}

/// Effects of the states on the temperature at the instrument of a column.
pub(crate) fn measured(
    task: &InferTask,
    column: usize,
    nodes: &[Vec<(usize, f64)>],
) -> Vec<(usize, f64)> {
    let of = task.run.columns[column].nodes().iter();
    of.flat_map(|(id, factor)| {
        nodes[id.index()].iter().map(move |(place, weight)| (*place, factor * weight))
    })
    .collect()
}

impl Linear {
    /// Effects of the states on a reading, if its instrument shows `shown` in K, and the reading.
    pub(crate) fn reading(
        &self,
        task: &InferTask,
        (states, reads): (&States, &[f64]),
        (column, shown): (usize, f64),
    ) -> (Vec<f64>, f64) {
        let mut of = vec![0.0; states.count()];
        states.drift(column).into_iter().for_each(|place| of[place] = 1.0);
        let Some(sensor) = task.run.columns[column].sensor else {
            measured(task, column, &self.nodes).iter().for_each(|(i, weight)| of[*i] += weight);
            return (of, shown);
        };
        let instrument = &task.sensors[sensor];
        let (mut offset, mut gain) = (instrument.offset.value, instrument.gain.value);
        let own = states.reads.iter().enumerate().filter(|(_, read)| read.sensor == sensor);
        let zero = task.run.columns[column].zero();
        let over_zero = shown - zero;
        for (r, read) in own {
            if read.gain {
                gain = reads[r];
                of[states.read(r)] = over_zero;
            } else {
                offset = reads[r];
                of[states.read(r)] = 1.0;
            }
        }
        match states.shown(column) {
            Some(place) => of[place] = gain,
            None => measured(task, column, &self.nodes)
                .iter()
                .for_each(|(i, weight)| of[*i] += gain * weight),
        }
        (of, zero + gain * over_zero + offset)
    }
}
