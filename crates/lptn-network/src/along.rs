//! The mean of a property along a path: a body conducts as if it had the mean of its conductivity
//! over the temperatures between its ends, whatever its shape.
//!
//! The property k is represented on panels by polynomials that agree with it to 1e-12 of its value
//! (see [`enthalpy`](crate::enthalpy)), so that its integral is theirs in closed form. If k is less
//! than a millionth of its value nearby, the panels agree to 1e-18 of that. Panels are made when a
//! path first needs them, from the text of the property alone.
//!
//! Source: G. Kirchhoff's transformation: H. S. Carslaw, J. C. Jaeger, Conduction of Heat in
//! Solids, 2nd edition (Oxford 1959), section 1.6.
//!
//! The mean of k(T) along a path is the difference of its integral over the temperatures of the
//! ends. Panels are made in blocks of 64 K on first use. Candidates share the panels that read no
//! parameter. The law declares the field to which this applies (`along`).

mod potential;

use std::sync::OnceLock;

use lptn_units::{EvalError, Scalar, Taylor};

use crate::enthalpy::{Capacity, Known, Panel};
use crate::gauss::GAUSS;
use crate::knots::knots;
use crate::slot;
use crate::value::Value;

/// Nothing is known above this temperature in K.
const HOTTEST: f64 = 16_384.0;

/// Width of a block of panels in K; below it blocks halve, down to the first.
const BLOCK: f64 = 64.0;

/// The exponent bits of [`BLOCK`] as a floating-point number.
const BLOCK_POWER: usize = (BLOCK.to_bits() >> 52) as usize;

/// Number of blocks below [`BLOCK`]: from 0 to 1/16 K, then to 1/8 K, and so on.
const HALVED: usize = 11;

/// Blocks up to [`HOTTEST`].
const BLOCKS: usize = HALVED - 1 + (HOTTEST / BLOCK) as usize;

/// A property of which paths take the mean between the temperatures of their ends.
#[derive(Debug)]
pub(crate) struct Along {
    value: Value,
    course: Course,
}

#[derive(Debug)]
enum Course {
    /// The numbers that it reads are known.
    Fixed(Blocks),
    /// It reads values that change during a run; they are taken as they are at the moment.
    Moving,
}

/// Panels block by block, made on first use.
#[derive(Debug)]
struct Blocks {
    slots: Vec<f64>,
    made: Vec<OnceLock<Box<Block>>>,
}

/// The mean between two temperatures, and how it changes with each in 1/K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mean {
    pub(crate) value: f64,
    pub(crate) slopes: [f64; 2],
}

/// The panels between two temperatures.
#[derive(Debug)]
struct Block {
    /// Ascending; their heat is the integral from the first one on.
    panels: Vec<Panel>,
    /// A temperature in each gap between them.
    gaps: Vec<f64>,
    integral: f64,
}

/// A panel and the block that contains it.
#[derive(Clone, Copy)]
struct Place<'a> {
    block: &'a Block,
    panel: &'a Panel,
    number: usize,
}

impl Along {
    /// The property of a value that reads nothing but its own temperature and these slots, a prefix
    /// of the slots of an evaluation.
    pub(crate) fn fixed(value: &Value, slots: &[f64]) -> Self {
        let last = value.slots().into_iter().chain([slot::OWN]).max().unwrap_or(slot::OWN);
        let slots = slots[..=last as usize].to_vec();
        let made = (0..BLOCKS).map(|_| OnceLock::new()).collect();
        Self { value: value.clone(), course: Course::Fixed(Blocks { slots, made }) }
    }

    /// The property of a value that changes during a run by more than its own temperature.
    pub(crate) fn moving(value: &Value) -> Self {
        Self { value: value.clone(), course: Course::Moving }
    }

    /// True if nothing but its own temperature changes it during a run.
    pub(crate) fn is_fixed(&self) -> bool {
        matches!(self.course, Course::Fixed(_))
    }

    /// Its mean between two temperatures in K for these values of the slots.
    ///
    /// # Errors
    /// A temperature in K between the two at which it is not known, is negative, or changes too
    /// quickly to be followed.
    #[inline]
    pub(crate) fn mean<S: Scalar>(&self, ends: [f64; 2], slots: &[S]) -> Result<Mean, f64> {
        match &self.course {
            Course::Fixed(blocks) => blocks.mean(&self.value, ends),
            Course::Moving => self.of_slots(ends, slots),
        }
    }

    /// The same for a value that reads slots which may have changed.
    #[cold]
    fn of_slots<S: Scalar>(&self, ends: [f64; 2], slots: &[S]) -> Result<Mean, f64> {
        let [low, high] = ascending(ends)?;
        let slots = slots.iter().map(|slot| slot.value()).collect();
        // for a single temperature a stretch around it is covered
        let wide = if low < high { [low, high] } else { [low - 0.5_f64.min(low), high + 0.5] };
        let block = Block::new(&self.value, wide, slots);
        between(ends, (block.place(low, low < high)?, block.place(high, false)?))
    }

    /// Change of the mean with the other slots at fixed temperatures: the derivatives of the slots,
    /// with 0 as the value.
    ///
    /// # Errors
    /// The error of the evaluation of the value.
    pub(crate) fn change<S: Scalar>(
        &self,
        ends: [f64; 2],
        slots: &mut [S],
        stack: &mut Vec<S>,
    ) -> Result<S, EvalError> {
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let mut at = |temperature: f64| {
            slots[slot::OWN as usize] = S::from_f64(temperature);
            let value = self.value.on(slots, stack)?;
            Ok(value - S::from_f64(value.value()))
        };
        if low >= high {
            return at(low);
        }
        let mut sum = S::from_f64(0.0);
        for piece in self.stops([low, high]).windows(2) {
            let (middle, half) = (piece[0].midpoint(piece[1]), 0.5 * (piece[1] - piece[0]));
            for (x, weight) in GAUSS {
                sum = sum + at(middle + half * x)? * S::from_f64(half * weight / (high - low));
            }
        }
        Ok(sum)
    }

    /// Two temperatures with the ends of the panels between them.
    fn stops(&self, [low, high]: [f64; 2]) -> Vec<f64> {
        let mut stops = vec![low];
        if let Course::Fixed(blocks) = &self.course {
            for index in sides(low)[0]..=sides(high)[1] {
                let ends = blocks.block(&self.value, index).panels.iter().map(|panel| panel.to);
                stops.extend(ends.filter(|t| *t > low && *t < high));
            }
        }
        stops.push(high);
        stops
    }
}

impl Blocks {
    fn mean(&self, value: &Value, ends: [f64; 2]) -> Result<Mean, f64> {
        let [low, high] = ascending(ends)?;
        let ([i, _], [_, j]) = (sides(low), sides(high));
        if low >= high {
            let below = self.block(value, j).place(high, false);
            let there = below.or_else(|_| self.block(value, i).place(low, true))?;
            return between(ends, (there, there));
        }
        let first = self.block(value, i).place(low, true)?;
        let last = self.block(value, j).place(high, false)?;
        if i == j {
            return between(ends, (first, last));
        }
        let mut integral = first.rest(low)?;
        for k in i + 1..j {
            integral += self.block(value, k).whole()?;
        }
        integral += last.until(high)?;
        Ok(mean(ends, integral, [first.panel.capacity_at(low), last.panel.capacity_at(high)]))
    }

    fn block(&self, value: &Value, index: usize) -> &Block {
        let new = || Box::new(Block::new(value, range(index), self.slots.clone()));
        self.made[index].get_or_init(new)
    }
}

/// Two temperatures in their order, if they are inside the range.
fn ascending([from, to]: [f64; 2]) -> Result<[f64; 2], f64> {
    let outside = [from, to].into_iter().find(|t| !(0.0..=HOTTEST).contains(t));
    outside.map_or(Ok(if from <= to { [from, to] } else { [to, from] }), Err)
}

/// The blocks above and below a temperature: one, except where two meet.
fn sides(temperature: f64) -> [usize; 2] {
    // the power of two that it is in is its exponent
    let power = (temperature.abs().to_bits() >> 52) as usize;
    let above = match temperature >= BLOCK {
        true => HALVED - 1 + (temperature / BLOCK) as usize,
        false => (power + HALVED).saturating_sub(BLOCK_POWER),
    };
    let meets = above > 0 && ENDS[above] >= temperature;
    [above.min(BLOCKS - 1), above - usize::from(meets)]
}

/// Ends of the blocks in K.
static ENDS: [f64; BLOCKS + 1] = ends();

const fn ends() -> [f64; BLOCKS + 1] {
    let mut ends = [0.0; BLOCKS + 1];
    let mut i = BLOCKS;
    while i > 0 {
        ends[i] = if i < HALVED { 0.5 * ends[i + 1] } else { BLOCK * (i + 1 - HALVED) as f64 };
        i -= 1;
    }
    ends
}

/// The temperatures of a block.
fn range(index: usize) -> [f64; 2] {
    [ENDS[index], ENDS[index + 1]]
}

/// The mean from the integral, and the values at the lower and the upper end.
fn mean([from, to]: [f64; 2], integral: f64, [low, high]: [f64; 2]) -> Mean {
    let (difference, width) = (from - to, (from - to).abs());
    let value = integral / width;
    let (own, other) = if from < to { (low, high) } else { (high, low) };
    Mean { value, slopes: [(own - value) / difference, (value - other) / difference] }
}

/// The mean inside a block.
fn between(ends: [f64; 2], (first, last): (Place<'_>, Place<'_>)) -> Result<Mean, f64> {
    let [low, high] = if ends[0] <= ends[1] { ends } else { [ends[1], ends[0]] };
    if low >= high {
        let slope = 0.5 * first.panel.slope_at(low);
        return Ok(Mean { value: first.panel.capacity_at(low), slopes: [slope; 2] });
    }
    let values = [first.panel.capacity_at(low), last.panel.capacity_at(high)];
    if first.number == last.number {
        let integral = first.panel.mean(low, high) * (high - low);
        return Ok(mean(ends, integral, values));
    }
    first.block.is_whole(first.panel.to, last.panel.from)?;
    let ends_of = [
        first.panel.mean(low, first.panel.to) * (first.panel.to - low),
        last.panel.mean(last.panel.from, high) * (high - last.panel.from),
    ];
    let within = last.panel.heat - (first.panel.heat + first.panel.rise);
    Ok(mean(ends, ends_of[0] + within + ends_of[1], values))
}

impl Block {
    /// The panels of a value between two temperatures, for these values of the slots.
    fn new(value: &Value, over: [f64; 2], slots: Vec<f64>) -> Self {
        let mut text = Text { value, slots, stack: Vec::new() };
        let stops = knots(value, &mut text.slots, &mut text.stack);
        let Known { mut panels, gaps } = Known::between(&mut text, over, &stops);
        let mut integral = 0.0;
        for panel in &mut panels {
            panel.heat = integral;
            integral += panel.rise;
        }
        Self { panels, gaps, integral }
    }

    /// The panel that begins at a temperature, `above` or below it.
    fn place(&self, temperature: f64, above: bool) -> Result<Place<'_>, f64> {
        let number = match above {
            true => self.panels.partition_point(|panel| panel.to <= temperature),
            false => self.panels.partition_point(|panel| panel.to < temperature),
        };
        let panel = self.panels.get(number).filter(|panel| panel.from <= temperature);
        panel.map(|panel| Place { block: self, panel, number }).ok_or(temperature)
    }

    /// Ok if there is no gap between two temperatures.
    fn is_whole(&self, from: f64, to: f64) -> Result<(), f64> {
        let gap = self.gaps.iter().find(|gap| (from..=to).contains(*gap));
        gap.map_or(Ok(()), |gap| Err(*gap))
    }

    fn whole(&self) -> Result<f64, f64> {
        self.gaps.first().map_or(Ok(self.integral), |gap| Err(*gap))
    }
}

impl Place<'_> {
    /// The integral from a temperature to the end of the block.
    fn rest(&self, from: f64) -> Result<f64, f64> {
        self.block.is_whole(self.panel.to, f64::INFINITY)?;
        let own = self.panel.mean(from, self.panel.to) * (self.panel.to - from);
        Ok(own + (self.block.integral - (self.panel.heat + self.panel.rise)))
    }

    /// The integral from the beginning of the block to a temperature.
    fn until(&self, to: f64) -> Result<f64, f64> {
        self.block.is_whole(0.0, self.panel.from)?;
        let own = self.panel.mean(self.panel.from, to) * (to - self.panel.from);
        Ok(self.panel.heat + own)
    }
}

/// A value over its own temperature, with the other slots fixed.
struct Text<'a> {
    value: &'a Value,
    slots: Vec<f64>,
    stack: Vec<f64>,
}

impl Capacity for Text<'_> {
    fn at(&mut self, temperature: f64) -> Option<f64> {
        self.slots[slot::OWN as usize] = temperature;
        self.value.on(&self.slots, &mut self.stack).ok()
    }

    fn over(&mut self, from: f64, to: f64) -> Taylor {
        self.value.enclose([from, to], &self.slots)
    }
}
