//! Radiation of constant exchange areas: many of them make up the heat of a hot plate, so they lie
//! flat in memory.
//!
//! The symmetric form is also exact towards a boundary, so that glowing networks need half the CPU
//! time. All other nonlinear elements are in `element.rs`.

use lptn_network::{ConductorFlow, ConductorId, Network, Received};
use lptn_units::{Bounded, Scalar};

use crate::element::{JacobianForm, NOWHERE, slot};
use crate::pattern::JacobianPattern;

/// `q = sigma Gr (Ta^4 - Tb^4)` between two vertices.
#[derive(Clone, Debug)]
pub(crate) struct Radiation {
    pub(crate) conductor: ConductorId,
    pub(crate) ends: [u32; 2],
    /// Exchange area in m^2.
    area: f64,
    /// Slots of its derivatives by row, then column; [`NOWHERE`] if one of the two is given.
    slots: [u32; 4],
}

impl Radiation {
    /// All of a network, in the order of its conductors.
    pub(crate) fn all_of(network: &Network) -> Vec<Self> {
        let vertex = |end| u32::try_from(network.vertex(end)).expect("ids are 32 bits wide");
        let radiation = |(c, id): (&lptn_network::Conductor, ConductorId)| match network.flow(id) {
            ConductorFlow::Radiation(area) => {
                let ends = [vertex(c.from), vertex(c.to)];
                Some(Self { conductor: id, ends, area, slots: [NOWHERE; 4] })
            }
            _ => None,
        };
        let conductors = network.conductors().iter().zip(network.conductor_ids());
        let mut all: Vec<Self> = conductors.filter_map(radiation).collect();
        all.shrink_to_fit();
        all
    }

    /// The unknowns that meet in it, if both ends are unknown.
    pub(crate) fn pair(&self, unknown: &[u32]) -> Option<(u32, u32)> {
        let [from, to] = self.ends.map(|v| unknown[v as usize]);
        (from != u32::MAX && to != u32::MAX).then_some((from, to))
    }

    pub(crate) fn place(&mut self, unknown: &[u32], pattern: &JacobianPattern) {
        let [from, to] = self.ends.map(|v| unknown[v as usize]);
        self.slots = [(from, from), (from, to), (to, from), (to, to)].map(|(row, column)| {
            let given = row == u32::MAX || column == u32::MAX;
            if given { NOWHERE } else { slot(pattern, row, column) }
        });
    }

    /// The heat that both ends receive in W.
    pub(crate) fn received(&self, temperature: &[f64]) -> Received {
        let [from, to] = self.ends.map(|v| temperature[v as usize]);
        let heat = lptn_laws::radiation_conductance(self.area, from, to) * (from - to);
        [-heat, heat]
    }

    /// Bounds on the heat that leaves the first end in W.
    pub(crate) fn leaves(&self, from: Bounded, to: Bounded) -> Bounded {
        lptn_laws::radiation_conductance(Bounded::from_f64(self.area), from, to) * (from - to)
    }

    /// Bounds on the derivative by the temperature of one end in W/K, while that is in a range of
    /// temperatures in K.
    pub(crate) fn slopes_within(&self, range: [f64; 2]) -> [f64; 2] {
        range.map(|t| 4.0 * lptn_laws::STEFAN_BOLTZMANN * self.area * t.powi(3))
    }

    /// Slot of a derivative, by row and then column.
    pub(crate) fn slot(&self, place: usize) -> u32 {
        self.slots[place]
    }

    /// Adds its heat to that of its ends in W.
    pub(crate) fn add_heat(&self, temperature: &[f64], heat: &mut [f64]) {
        let received = self.received(temperature);
        self.ends.iter().zip(received).for_each(|(&v, q)| heat[v as usize] += q);
    }

    /// Adds its derivatives to the values of the Jacobian. Towards an end that is given the exact
    /// one is symmetric; none is negative in the symmetric form, so that the matrix stays definite
    /// for an iterate below 0 K.
    pub(crate) fn add_slopes(&self, temperature: &[f64], form: JacobianForm, values: &mut [f64]) {
        let slope = |v: u32| {
            4.0 * lptn_laws::STEFAN_BOLTZMANN * self.area * temperature[v as usize].powi(3)
        };
        let [mut from, mut to] = self.ends.map(slope);
        if form == JacobianForm::Symmetric {
            if !self.slots.contains(&NOWHERE) {
                from = 0.5 * (from + to);
                to = from;
            }
            (from, to) = (from.max(0.0), to.max(0.0));
        }
        for (&slot, value) in self.slots.iter().zip([-from, to, from, -to]) {
            if slot != NOWHERE {
                values[slot as usize] += value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use lptn_network::{Area, ConductorKind, End, HeatCapacity, NetworkBuilder, Path, Temperature};

    use crate::{JacobianForm, ThermalSystem};

    const SIGMA: f64 = 5.670_374_419e-8;

    /// Jacobian at 1500 K and 900 K of a node of the first temperature that radiates over 2 m^2,
    /// one of the second over 1 m^2 to a boundary at 300 K.
    fn jacobian(form: JacobianForm) -> Vec<f64> {
        let mut b = NetworkBuilder::new();
        let [hot, warm] = ["hot", "warm"].map(|n| b.node(n, HeatCapacity(1.0), Temperature(900.0)));
        let sky = b.boundary("sky", Temperature(300.0));
        let mut radiation = |name: &str, from: End, to: End, area: f64| {
            let path = Path::radiation(Area(area));
            b.conductor(name, ConductorKind::Radiation, (from, to), path);
        };
        radiation("between", hot.into(), warm.into(), 2.0);
        radiation("out", sky.into(), warm.into(), 1.0);
        let system = ThermalSystem::assemble(&b.build().unwrap()).unwrap();
        let mut values = vec![0.0; system.pattern().entries()];
        let mut work = system.workspace();
        system.read_inputs(&mut work, 0.0, 0.0).unwrap();
        system.jacobian_at(&mut work, &[1500.0, 900.0], form, &mut values).unwrap();
        values
    }

    fn expect(found: &[f64], expected: [f64; 4]) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-13 * expected.abs(), "{found} {expected}");
        }
    }

    #[test]
    fn derivatives_of_fourth_powers() {
        let (hot, warm) = (4.0 * SIGMA * 1500.0_f64.powi(3), 4.0 * SIGMA * 900.0_f64.powi(3));
        expect(&jacobian(JacobianForm::Exact), [-2.0 * hot, 2.0 * hot, 2.0 * warm, -3.0 * warm]);
    }

    // The mean with the boundary's own slope made Newton's method fail on plates that glow.
    #[test]
    fn the_symmetric_form_is_exact_towards_a_boundary() {
        let (hot, warm) = (4.0 * SIGMA * 1500.0_f64.powi(3), 4.0 * SIGMA * 900.0_f64.powi(3));
        let mean = hot + warm;
        expect(&jacobian(JacobianForm::Symmetric), [-mean, mean, mean, -mean - warm]);
    }
}
