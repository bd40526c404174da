//! Heat through bodies whose conductivity depends on nothing but temperature.

use std::sync::Arc;

use crate::along::Along;
use crate::id::ConductorId;
use crate::network::Network;

/// A conductivity over temperature. Copies share their memory.
#[derive(Clone, Debug)]
pub struct Conductivity {
    along: Arc<Along>,
}

impl Network {
    /// The conductivity of a body, if nothing else of its path changes and it depends on nothing
    /// but temperature, with the conductance of the path in W/K for 1 W/(m K); `None` for any other
    /// conductor.
    pub fn conductivity(&self, id: ConductorId) -> Option<(Conductivity, f64)> {
        let shape = self.shape(id)?;
        let along = self.numbers.along.get(id.index())?.clone()?;
        Some((Conductivity { along }, shape))
    }

    /// The heat through such a body in W between the temperatures of its ends in K, and its
    /// derivatives by both, the second with the other sign, in W/K. `None` for any other conductor,
    /// and if one panel does not cover both temperatures.
    #[inline]
    pub(crate) fn conducted(&self, id: ConductorId, ends: [f64; 2]) -> Option<[f64; 3]> {
        let shape = self.shape(id)?;
        let (mean, [from, to]) = self.along(id)?.within_a_panel(ends)?;
        let heat = shape * mean * (ends[0] - ends[1]);
        heat.is_finite().then_some([heat, shape * from, shape * to])
    }

    #[inline]
    pub(crate) fn shape(&self, id: ConductorId) -> Option<f64> {
        self.numbers.shapes.get(id.index()).copied().filter(|shape| shape.is_finite())
    }
}

impl Conductivity {
    /// A number that copies share and no other one has at the same time.
    pub fn key(&self) -> usize {
        Arc::as_ptr(&self.along).addr()
    }

    /// Writes its integral over temperature in W/m at some of these temperatures in K, in their
    /// order, counted from a point that all of them share. `false` if the property is unknown at
    /// one of them or between two; `out` is meaningless then.
    pub fn integrals(&self, temperatures: &[f64], of: &[u32], out: &mut Vec<f64>) -> bool {
        self.along.integrals(of.iter().map(|&i| temperatures[i as usize]), out)
    }

    /// The same for the conductivity itself in W/(m K).
    pub fn values(&self, temperatures: &[f64], of: &[u32], out: &mut Vec<f64>) -> bool {
        self.along.values(of.iter().map(|&i| temperatures[i as usize]), out)
    }
}
