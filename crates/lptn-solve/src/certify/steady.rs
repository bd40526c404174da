//! Proven bounds on the errors of a steady state.
//!
//! If `A` bounds the slopes of the heat flows in a box around a state, as for runs (`bound.rs`),
//! and `-A w >= |q| + m` for the heat `q` that the state leaves and margins `m`, then every face of
//! the box `state +- w` sees heat that drives back into it: the box contains a steady state (C.
//! Miranda, Boll. Un. Mat. Ital. 3 (1940) 5). It is the only one there, because a matrix with
//! `-A w > 0` is an H-matrix, and a map whose Jacobians are all of that kind takes no value twice
//! (D. Gale, H. Nikaido, Math. Ann. 159 (1965) 81).

use lptn_assembly::ThermalSystem;
use lptn_integrate::Pattern;
use lptn_network::Item;
use lptn_units::Taylor;

use super::shifted::Shifted;
use super::{ROUNDING, Uncertified, no_samples};
use crate::snapshot::Snapshot;
use crate::times::just_after;

/// Boxes that are tried, each wider than the last.
const TRIES: usize = 12;

/// Half-width of the first box in K.
const FIRST: f64 = 1e-9;

/// The next box is this much wider than the bounds that it gave.
const WIDER: f64 = 2.0;

/// The bounds take this much more heat than the state leaves.
const GENEROUS: f64 = 1.0 + 1e-3;

impl Snapshot {
    /// Proven bounds in K on the distance of each node from a steady state with these inputs and
    /// positions of controls, in the order of the network. No other steady state is within them.
    ///
    /// # Errors
    /// [`Uncertified::Node`] for a sampled state, [`Uncertified::Law`] if the heat of an element
    /// has no bounds, [`Uncertified::Lost`] if no box was found, as if no path leads to a boundary.
    pub fn proven_errors(&self, system: &ThermalSystem) -> Result<Vec<f64>, Uncertified> {
        let network = system.network();
        no_samples(network)?;
        let no_law = |item: Item| Uncertified::Law {
            name: network.name_of(item).into_owned(),
            time: self.time,
        };
        let lost = Uncertified::Lost { time: self.time };
        let state: Vec<f64> =
            system.unknowns().iter().map(|id| self.temperatures[id.index()]).collect();
        let mut scope = network.evaluation();
        scope.set_positions(&self.positions);
        let here = (self.time, self.time);
        let [over, _] = network.input_bounds(&mut scope, here, just_after(self.time));
        let mut inputs = over.still();
        let points: Vec<Taylor> = state.iter().map(|t| Taylor::constant(*t)).collect();
        let left = system.enclose_flow(&mut inputs, &points).map_err(no_law)?;
        let left =
            left.flow.iter().map(|q| q.range().map_or(f64::NAN, |[a, b]| a.abs().max(b.abs())));
        let left: Vec<f64> = left.collect();
        let pattern = Pattern::from_symbolic(system.pattern().symbolic());
        let without_mass = vec![0.0; state.len()];
        let mut factors = Shifted::new(&pattern, &without_mass).map_err(|_| lost.clone())?;
        let mut widths = vec![FIRST; state.len()];
        for _ in 0..TRIES {
            let tube: Vec<[f64; 2]> =
                state.iter().zip(&widths).map(|(t, w)| [t - w, t + w]).collect();
            let slopes = system.enclose_slopes(&mut inputs, &tube).map_err(no_law)?;
            let matrix = slopes.worst(system);
            let absolute: Vec<f64> = matrix.iter().map(|slope| slope.abs()).collect();
            let mut sizes = vec![0.0; state.len()];
            pattern.multiply(&absolute, &state, &mut sizes);
            let needed: Vec<f64> =
                (0..state.len()).map(|i| left[i] + slopes.jumps[i] + ROUNDING * sizes[i]).collect();
            let mut bounds: Vec<f64> = needed.iter().map(|heat| heat * GENEROUS).collect();
            factors.set(&matrix);
            let solved = factors.factorize(1.0).and_then(|()| factors.solve(&mut bounds));
            solved.ok_or_else(|| lost.clone())?;
            if !drives_back(&pattern, &matrix, (&bounds, &needed)) {
                return Err(lost);
            }
            if bounds.iter().zip(&widths).all(|(bound, width)| bound <= width) {
                let nodes = system.spread_bounds(&bounds).into_iter().zip(&self.temperatures);
                return Ok(nodes.map(|(bound, t)| bound + ROUNDING * t).collect());
            }
            widths = bounds.iter().zip(&widths).map(|(b, w)| (WIDER * b).max(*w)).collect();
        }
        Err(lost)
    }
}

/// `-A w >= m` and `w > 0`, with the rounding of the sums.
fn drives_back(pattern: &Pattern, matrix: &[f64], (bounds, needed): (&[f64], &[f64])) -> bool {
    let mut heat = vec![0.0; bounds.len()];
    let mut rounding = heat.clone();
    pattern.multiply(matrix, bounds, &mut heat);
    let absolute: Vec<f64> = matrix.iter().map(|slope| slope.abs()).collect();
    pattern.multiply(&absolute, bounds, &mut rounding);
    let rows = heat.iter().zip(&rounding).zip(bounds.iter().zip(needed));
    rows.into_iter().all(|((heat, rounding), (bound, needed))| {
        *bound > 0.0 && -heat >= needed + ROUNDING * rounding
    })
}
