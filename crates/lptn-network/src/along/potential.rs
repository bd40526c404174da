//! The integral of a property over temperature, once for each end of many paths.
//!
//! Between two cells of a body the heat is the difference of this potential times a length
//! (Kirchhoff's transformation). A cell has six neighbours, so a potential of each cell costs a
//! fraction of a mean along each path, and less than an evaluation of the text of the property. It
//! is counted from the block of the coldest end on, so that its rounding is that of the
//! temperatures.

use super::{Along, Block, Blocks, Course, ENDS, HOTTEST, sides};
use crate::enthalpy::Panel;
use crate::value::Value;

/// The blocks between two temperatures, each with the integral below it.
struct Stretch<'a> {
    first: usize,
    blocks: Vec<(&'a Block, f64)>,
}

impl Along {
    /// The mean between two temperatures in K and the values at them, if one panel covers both;
    /// `None` if [`Along::mean`] has to compute it.
    #[inline]
    pub(crate) fn within_a_panel(&self, ends: [f64; 2]) -> Option<(f64, [f64; 2])> {
        let Course::Fixed(blocks) = &self.course else { return None };
        if !(0.0..=HOTTEST).contains(&ends[0]) {
            return None;
        }
        let block = blocks.block(&self.value, sides(ends[0])[0]);
        let panel = block.panels.iter().find(|panel| ends[0] <= panel.to)?;
        let inside = ends.iter().all(|t| panel.from <= *t && *t <= panel.to);
        let values = || ends.map(|t| panel.capacity_at(t));
        inside.then(|| (panel.mean(ends[0], ends[1]), values()))
    }

    /// Writes its integral at temperatures in K, from a temperature on that all have in common.
    /// True if all are known and nothing between them is unknown.
    pub(crate) fn integrals(
        &self,
        temperatures: impl Iterator<Item = f64> + Clone,
        out: &mut Vec<f64>,
    ) -> bool {
        self.at_each(temperatures, out, |below, panel, temperature| {
            below + (panel.heat + panel.taken_up(temperature))
        })
    }

    /// The same for itself.
    pub(crate) fn values(
        &self,
        temperatures: impl Iterator<Item = f64> + Clone,
        out: &mut Vec<f64>,
    ) -> bool {
        self.at_each(temperatures, out, |_, panel, temperature| panel.capacity_at(temperature))
    }

    /// Writes a number for each temperature, from the integral below its block and from its panel.
    #[inline]
    fn at_each(
        &self,
        temperatures: impl Iterator<Item = f64> + Clone,
        out: &mut Vec<f64>,
        of: impl Fn(f64, &Panel, f64) -> f64,
    ) -> bool {
        out.clear();
        let Course::Fixed(blocks) = &self.course else { return false };
        let Some(stretch) = blocks.stretch(&self.value, temperatures.clone()) else { return false };
        for temperature in temperatures {
            let Some((below, panel)) = stretch.place(temperature) else { return false };
            out.push(of(below, panel, temperature));
        }
        true
    }
}

impl Blocks {
    /// The blocks around all of these temperatures, if there is no gap among them.
    fn stretch(&self, value: &Value, all: impl Iterator<Item = f64>) -> Option<Stretch<'_>> {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = all.fold(none, |(low, high), t| (low.min(t), high.max(t)));
        if !(0.0..=HOTTEST).contains(&low) || !(low..=HOTTEST).contains(&high) {
            return None;
        }
        let (first, last) = (sides(low)[0], sides(high)[1].max(sides(low)[0]));
        let mut blocks = Vec::with_capacity(last + 1 - first);
        let mut below = 0.0;
        for index in first..=last {
            let block = self.block(value, index);
            block.is_whole(low, high).ok()?;
            blocks.push((block, below));
            below += block.integral;
        }
        Some(Stretch { first, blocks })
    }
}

impl Stretch<'_> {
    /// The integral below the block of a temperature, and its panel.
    #[inline]
    fn place(&self, temperature: f64) -> Option<(f64, &Panel)> {
        let last = self.blocks.len() - 1;
        let mut place = 0;
        while place < last && ENDS[self.first + place + 1] <= temperature {
            place += 1;
        }
        let (block, below) = self.blocks[place];
        let panel = block.panels.iter().find(|panel| temperature <= panel.to)?;
        (panel.from <= temperature).then_some((below, panel))
    }
}
