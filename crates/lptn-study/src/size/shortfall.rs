//! By how much requirements are broken, in one measure.
//!
//! If no value keeps everything, the answer is the one whose worst requirement is broken least.
//! The measure comes from the requirements alone: one from the values that a search has tried would
//! make the answer depend on the range. Requirements in one unit are compared in it. If their units
//! differ, each is a share of its bound, and 100 K are the bound of a temperature, whose zero means
//! nothing.

use lptn_units::{Dimension, Type};

use crate::size::judge::{Demand, Judged};

/// The change in K, or in other SI units without a bound, that counts as much as a whole bound.
const WHOLE: f64 = 100.0;

/// Margins that differ by less than this, in K, are the same but for rounding.
const ROUNDING: f64 = 1e-11;

/// The measure of the margins of requirements.
#[derive(Clone, Debug)]
pub struct Shortfall {
    /// The unit of each margin, in SI units; those of the first load case, then those of the next.
    units: Vec<f64>,
    /// The unit of a temperature in K.
    kelvin: f64,
}

impl Shortfall {
    /// The measure of these requirements in each load case.
    pub fn of(demand: &Demand<'_>) -> Self {
        let quantities: Vec<Type> = demand.requirements.iter().map(|of| of.ty).collect();
        let alike = quantities.windows(2).all(|two| two[0].dimension == two[1].dimension);
        let kelvin = if alike { 1.0 } else { WHOLE };
        let unit = |i: usize| match alike {
            true => 1.0,
            false if quantities[i].dimension == Dimension::TEMPERATURE => WHOLE,
            false => bound(demand, i).unwrap_or(WHOLE),
        };
        let one: Vec<f64> = (0..quantities.len()).map(unit).collect();
        Self { units: one.repeat(demand.cases.len().max(1)), kelvin }
    }

    /// The margins in this measure.
    pub(crate) fn measured(&self, judged: &Judged) -> impl Iterator<Item = f64> {
        judged.margins.iter().zip(&self.units).map(|(margin, unit)| margin / unit)
    }

    /// The least margin in this measure, negative if a requirement is broken.
    pub fn least(&self, judged: &Judged) -> f64 {
        self.measured(judged).fold(f64::INFINITY, f64::min)
    }

    /// The requirement with the least margin, by its position among the margins.
    pub fn worst(&self, judged: &Judged) -> usize {
        let all = self.measured(judged).enumerate();
        all.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
    }

    /// True if the first comes closer to keeping everything, by more than this in K.
    pub(crate) fn closer(&self, a: &Judged, b: &Judged, than: f64) -> bool {
        self.least(a) > self.least(b) + ROUNDING.max(than) / self.kelvin
    }
}

/// The size of the constant side of a requirement; `None` if there is none, or if it is zero.
fn bound(demand: &Demand<'_>, i: usize) -> Option<f64> {
    let network = demand.network;
    let sides = demand.requirements[i].sides();
    let constant = sides.into_iter().rev().find(|side| network.is_constant(side))?;
    let size = constant.at(&mut network.evaluation()).ok()?.abs();
    (size > 0.0 && size.is_finite()).then_some(size)
}
