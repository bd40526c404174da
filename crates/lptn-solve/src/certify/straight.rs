//! A linear network between two breakpoints of its inputs, as numbers.

use lptn_assembly::ThermalSystem;
use lptn_integrate::{OdeSystem, Pattern, Retry};

use crate::times::Segment;

/// `C T' = q + t q' + J (T - T0)` with the heat `q` at the start of a segment and its constant
/// change: the inputs are straight lines in time.
pub(super) struct Straight {
    pub(super) pattern: Pattern,
    mass: Vec<f64>,
    /// `J` in W/K.
    pub(super) slopes: Vec<f64>,
    pub(super) segment: Segment,
    /// `T0` in K.
    pub(super) at: Vec<f64>,
    /// In W.
    pub(super) heat: Vec<f64>,
    /// In W/s.
    pub(super) rate: Vec<f64>,
    rise: Vec<f64>,
}

impl Straight {
    pub(super) fn new(system: &ThermalSystem, at: &[f64]) -> Self {
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let mut slopes = vec![0.0; pattern.len()];
        system.jacobian(&mut slopes);
        let zeros = vec![0.0; at.len()];
        Self {
            pattern,
            mass: system.mass().to_vec(),
            slopes,
            segment: Segment { from: 0.0, to: 0.0 },
            at: at.to_vec(),
            heat: zeros.clone(),
            rate: zeros.clone(),
            rise: zeros,
        }
    }

    /// Enters a segment in a state in K; `None` if its heat has no value.
    pub(super) fn enter(
        &mut self,
        system: &ThermalSystem,
        segment: Segment,
        state: &[f64],
    ) -> Option<()> {
        let mut work = system.workspace();
        for (time, flow) in [(segment.from, &mut self.heat), (segment.to, &mut self.rate)] {
            system.read_inputs(&mut work, time, segment.inside()).ok()?;
            system.flow(&mut work, state, flow).ok()?;
        }
        let over = segment.to - segment.from;
        self.rate
            .iter_mut()
            .zip(&self.heat)
            .for_each(|(last, first)| *last = (*last - first) / over);
        self.at.copy_from_slice(state);
        self.segment = segment;
        Some(())
    }
}

impl OdeSystem for Straight {
    fn size(&self) -> usize {
        self.mass.len()
    }

    fn mass(&self) -> &[f64] {
        &self.mass
    }

    fn flow(&mut self, time: f64, state: &[f64], flow: &mut [f64]) -> Result<(), Retry> {
        let pairs = self.rise.iter_mut().zip(state).zip(&self.at);
        pairs.for_each(|((rise, t), at)| *rise = t - at);
        self.pattern.multiply(&self.slopes, &self.rise, flow);
        let after = time - self.segment.from;
        let inputs = self.heat.iter().zip(&self.rate);
        flow.iter_mut().zip(inputs).for_each(|(flow, (heat, rate))| *flow += heat + rate * after);
        Ok(())
    }

    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn symmetric(&self) -> bool {
        true
    }

    fn jacobian(&mut self, _: f64, _: &[f64], values: &mut [f64]) -> Result<(), Retry> {
        values.copy_from_slice(&self.slopes);
        Ok(())
    }

    fn jacobian_is_constant(&self) -> bool {
        true
    }
}
