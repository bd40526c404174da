//! The numbers that expressions read, on plain numbers and on dual ones.

use std::sync::Arc;

use lptn_units::{Dual, EvalError, Program, Scalar, Traced};

use crate::id::SignalId;
use crate::input_error::InputProblem;
use crate::parts::layout::{Followed, Layout};
use crate::parts::signal::Spot;
use crate::slot;
use crate::value::Value;

/// Derivatives taken in one pass. Two ends of a conductor and two further temperatures fit in.
pub(crate) const PASS: usize = 4;

/// A number with its derivatives by up to [`PASS`] temperatures.
pub(crate) type Slope = Dual<PASS>;

/// The numbers that expressions read: time, parameters, signals and temperatures. One per thread;
/// reused, so that evaluating allocates nothing.
#[derive(Clone, Debug)]
pub struct Evaluation {
    layout: Arc<Layout>,
    slots: Vec<f64>,
    stack: Vec<f64>,
    /// The same on dual numbers; empty until derivatives are needed.
    duals: Vec<Slope>,
    dual_stack: Vec<Slope>,
    /// The same on numbers that remember their pieces; empty until these are needed.
    traced: Vec<Traced>,
    traced_stack: Vec<Traced>,
    /// The first signal that has no value at the present time.
    failure: Option<(SignalId, InputProblem)>,
    /// The segment for which the points of signals were read.
    read_for: Option<u64>,
    /// The place of each signal in that segment.
    spots: Vec<Spot>,
}

impl Evaluation {
    /// An evaluation at time 0 with these parameters, in SI units and in the order of their ids.
    pub(crate) fn new(layout: &Arc<Layout>, parameters: &[f64]) -> Self {
        let mut slots = vec![f64::NAN; layout.len()];
        slots[slot::TIME as usize] = 0.0;
        slots[slot::SEGMENT as usize] = 0.0;
        let mut scope = Self {
            layout: Arc::clone(layout),
            slots,
            stack: Vec::new(),
            duals: Vec::new(),
            dual_stack: Vec::new(),
            traced: Vec::new(),
            traced_stack: Vec::new(),
            failure: None,
            read_for: None,
            spots: vec![Spot::default(); layout.signals().len()],
        };
        parameters.iter().enumerate().for_each(|(i, &value)| scope.set_parameter(i, value));
        scope.set_time(0.0, 0.0);
        scope
    }

    pub(crate) fn set_parameter(&mut self, index: usize, value: f64) {
        self.read_for = None;
        let slot = self.layout.parameter(crate::ParameterId::from_len(index));
        self.set(slot, value);
    }

    /// Sets the temperature of every node and boundary in K, in the order of their ids, for
    /// expressions of results.
    pub fn set_temperatures(&mut self, nodes: &[f64], boundaries: &[f64]) {
        for (slot, &value) in self.layout.temperatures().zip(nodes.iter().chain(boundaries)) {
            self.slots[slot as usize] = value;
        }
        for (slot, value) in self.layout.grid_temperatures(nodes) {
            self.slots[slot as usize] = value;
        }
    }

    /// Sets one temperature in K or heat flow in W, for an expression that follows it.
    pub fn follow(&mut self, followed: Followed, value: f64) {
        let slot = match followed {
            Followed::Temperature(end) => Some(self.layout.temperature(end)),
            Followed::Heat(heat) => self.layout.heat(heat),
        };
        slot.into_iter().for_each(|slot| self.slots[slot as usize] = value);
    }

    /// Sets the heat flows that expressions of results name, in W, in the order of
    /// [`crate::Network::named_heats`].
    pub fn set_heats(&mut self, heats: &[f64]) {
        for ((_, slot), &value) in self.layout.heats().iter().zip(heats) {
            self.slots[*slot as usize] = value;
        }
    }

    /// The value of a signal in SI units at the present time; NaN if it has none.
    pub fn signal(&self, id: SignalId) -> f64 {
        self.slots[self.layout.signal(id) as usize]
    }

    /// Moves to `time` in s; comparisons of `t` and of signals keep the truth they have at
    /// `segment` in s.
    pub fn set_time(&mut self, time: f64, segment: f64) {
        self.set(slot::TIME, time);
        self.set(slot::SEGMENT, segment);
        self.failure = None;
        let known = self.read_for == Some(segment.to_bits());
        let layout = Arc::clone(&self.layout);
        for (i, signal) in layout.signals().iter().enumerate() {
            let id = SignalId::from_len(i);
            let now = layout.signal(id);
            let ends = [(segment, now + 1), (time, now)];
            // an expression reads the time in both
            let unknown = usize::from(known && !signal.is_expression());
            if !known {
                self.spots[i] = signal.spot(segment);
            }
            for &(at, slot) in &ends[unknown..] {
                let read = (&self.slots[..], &mut self.stack);
                let value = signal.at((at, segment), &mut self.spots[i], read.0, read.1);
                let value = value.unwrap_or_else(|problem| {
                    self.failure.get_or_insert((id, problem));
                    f64::NAN
                });
                self.set(slot, value);
            }
        }
        self.read_for = self.failure.is_none().then_some(segment.to_bits());
    }

    pub(crate) fn layout(&self) -> &Arc<Layout> {
        &self.layout
    }

    pub(crate) fn slot(&self, slot: u32) -> f64 {
        self.slots[slot as usize]
    }

    /// Why a signal has no value at the present time.
    pub(crate) fn failure(&self) -> Option<(SignalId, InputProblem)> {
        self.failure.clone()
    }

    pub(crate) fn set(&mut self, slot: u32, value: f64) {
        self.slots[slot as usize] = value;
        if let Some(dual) = self.duals.get_mut(slot as usize) {
            *dual = Slope::constant(value);
        }
        if let Some(traced) = self.traced.get_mut(slot as usize) {
            *traced = Traced::from_f64(value);
        }
    }

    pub(crate) fn plain(&mut self) -> (&mut [f64], &mut Vec<f64>) {
        (&mut self.slots, &mut self.stack)
    }

    pub(crate) fn dual(&mut self) -> (&mut [Slope], &mut Vec<Slope>) {
        if self.duals.is_empty() {
            self.duals = self.slots.iter().map(|&value| Slope::constant(value)).collect();
        }
        (&mut self.duals, &mut self.dual_stack)
    }

    pub(crate) fn traced(&mut self) -> (&mut [Traced], &mut Vec<Traced>) {
        if self.traced.is_empty() {
            self.traced = self.slots.iter().map(|&value| Traced::from_f64(value)).collect();
        }
        (&mut self.traced, &mut self.traced_stack)
    }

    /// A program's value at `time` in s.
    pub(crate) fn evaluate(
        &mut self,
        program: &Program,
        time: f64,
        segment: f64,
    ) -> Result<f64, EvalError> {
        self.set_time(time, segment);
        program.eval(&self.slots, &mut self.stack)
    }
}

impl Value {
    /// The value at the state of `scope`, in SI units.
    ///
    /// # Errors
    /// The error of the expression's evaluation, such as a negative base under a non-integer
    /// exponent.
    pub fn at(&self, scope: &mut Evaluation) -> Result<f64, EvalError> {
        let (slots, stack) = scope.plain();
        self.on(slots, stack)
    }
}
