//! Random things that are narrow over temperature, as expressions and as functions of this test.

#![allow(dead_code, reason = "each test takes a part")]

use std::cell::OnceCell;
use std::ops::RangeInclusive;

/// Absolute zero in degC, with its sign turned.
pub(crate) const ZERO: f64 = 273.15;

/// Points to the unit of a table of an integral; corners of all shapes lie on them.
const FINE: f64 = 64.0;

/// Beyond so many widths a shape is constant to rounding.
const BEYOND: f64 = 7.0;

/// Numbers between 0 and 1 that look random.
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        let mut dice = Self(seed | 1);
        (0..8).for_each(|_| {
            dice.roll();
        });
        dice
    }

    pub(crate) fn roll(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.roll()
    }

    pub(crate) fn in_ratio(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub(crate) fn one_of(&mut self, count: u64) -> u64 {
        (0..count).find(|k| self.roll() * ((count - k) as f64) < 1.0).unwrap_or(count - 1)
    }
}

/// The seeds that are tried: 1 to `normal`, unless `LPTN_GUARD_CASES` gives another number, or the
/// first and the last as in `200-400`.
pub(crate) fn seeds(normal: u64) -> RangeInclusive<u64> {
    let Ok(text) = std::env::var("LPTN_GUARD_CASES") else { return 1..=normal };
    let (first, last) = text.split_once('-').unwrap_or(("1", &text));
    match (first.trim().parse(), last.trim().parse()) {
        (Ok(first), Ok(last)) => first..=last,
        _ => 1..=normal,
    }
}

/// Something narrow around a temperature in degC, at most 1 high.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    Gauss,
    Tanh,
    Tent,
    Ramp,
    Table(Vec<f64>),
    /// The same points with a smooth curve through them.
    Pchip(Vec<f64>),
}

#[derive(Clone, Debug)]
pub(crate) struct Feature {
    pub(crate) shape: Shape,
    pub(crate) at: f64,
    pub(crate) width: f64,
    pub(crate) size: f64,
    /// Of the shape from its left on, at fine points.
    integral: OnceCell<Vec<f64>>,
    slopes: OnceCell<Vec<f64>>,
}

impl Feature {
    pub(crate) fn random(dice: &mut Dice, (low, high): (f64, f64)) -> Self {
        let shape = match dice.one_of(5) {
            0 => Shape::Gauss,
            1 => Shape::Tanh,
            2 => Shape::Tent,
            3 => Shape::Ramp,
            _ => Shape::Table((0..7).map(|_| dice.roll()).collect()),
        };
        let size =
            if dice.roll() < 0.5 { dice.between(0.3, 5.0) } else { dice.between(-0.3, -0.05) };
        let (at, width) = (dice.between(low, high), dice.in_ratio(0.1, 20.0));
        Self::new(shape, (at, width, size))
    }

    pub(crate) fn new(shape: Shape, (at, width, size): (f64, f64, f64)) -> Self {
        Self { shape, at, width, size, integral: OnceCell::new(), slopes: OnceCell::new() }
    }

    /// Half of the tables are smooth.
    pub(crate) fn or_smooth(self, dice: &mut Dice) -> Self {
        match &self.shape {
            Shape::Table(y) if dice.roll() < 0.5 => Self { shape: Shape::Pchip(y.clone()), ..self },
            _ => self,
        }
    }

    pub(crate) fn of(&self, celsius: f64) -> f64 {
        self.size * self.shape((celsius - self.at) / self.width)
    }

    fn shape(&self, x: f64) -> f64 {
        match &self.shape {
            Shape::Gauss => (-x * x).exp(),
            Shape::Tanh => 0.5 * ((4.0 * x + 2.0).tanh() - (4.0 * x - 2.0).tanh()),
            Shape::Tent => (1.0 - x.abs()).max(0.0),
            Shape::Ramp => x.clamp(0.0, 1.0),
            Shape::Table(y) => {
                let (k, part) = cell(x);
                point(y, k) + part * (point(y, k + 1) - point(y, k))
            }
            Shape::Pchip(y) => {
                let (k, t) = cell(x);
                let slopes = self.slopes.get_or_init(|| slopes(y));
                let rise = point(y, k + 1) - point(y, k);
                let (a, b) = (slopes[k] - rise, rise - slopes[k + 1]);
                point(y, k) + t * rise + t * (1.0 - t) * ((1.0 - t) * a + t * b)
            }
        }
    }

    /// Its integral in K from one temperature in degC to another.
    pub(crate) fn integral(&self, from: f64, to: f64) -> f64 {
        let [from, to] = [from, to].map(|t| self.below((t - self.at) / self.width));
        self.size * self.width * (to - from)
    }

    /// The integral of its shape up to a place, from the left of all that it does.
    fn below(&self, x: f64) -> f64 {
        let sums = self.integral.get_or_init(|| self.sums());
        let place = ((x + BEYOND) * FINE).max(0.0);
        let k = (place as usize).min(sums.len() - 1);
        let from = k as f64 / FINE - BEYOND;
        sums[k] + if x > from { self.part(from, x) } else { 0.0 }
    }

    fn sums(&self) -> Vec<f64> {
        let mut sums = vec![0.0];
        for k in 0..(2.0 * BEYOND * FINE) as u32 {
            let from = f64::from(k) / FINE - BEYOND;
            sums.push(sums[sums.len() - 1] + self.part(from, from + FINE.recip()));
        }
        sums
    }

    /// Gauss's quadrature at three points.
    fn part(&self, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let at = |x: f64| self.shape(middle + half * x);
        let edge = 0.6_f64.sqrt();
        half / 9.0 * (5.0 * (at(-edge) + at(edge)) + 8.0 * at(0.0))
    }

    /// The temperatures in degC at which it has corners.
    pub(crate) fn corners(&self) -> Vec<f64> {
        let places = match self.shape {
            Shape::Gauss | Shape::Tanh => vec![],
            Shape::Tent => vec![-1.0, 0.0, 1.0],
            Shape::Ramp => vec![0.0, 1.0],
            Shape::Table(_) | Shape::Pchip(_) => {
                (0..9).map(|k| 0.25 * f64::from(k) - 1.0).collect()
            }
        };
        places.into_iter().map(|x| self.at + x * self.width).collect()
    }

    /// How far a temperature in degC may go at once for steps that see all of it.
    pub(crate) fn reach(&self, celsius: f64) -> f64 {
        (0.2 * self.width).max(0.3 * ((celsius - self.at).abs() - 5.0 * self.width))
    }

    /// An expression of a temperature, or of a difference of two.
    pub(crate) fn text(&self, number: usize, temperature: &str, unit: &str) -> String {
        let Self { at, width, size, .. } = self;
        let x = format!("(({temperature} - {at:?} [{unit}]) / {width:?} [K])");
        let shape = match &self.shape {
            Shape::Gauss => format!("exp(-{x}^2)"),
            Shape::Tanh => format!("0.5 * (tanh(4 * {x} + 2) - tanh(4 * {x} - 2))"),
            Shape::Tent => format!("max(1 - abs({x}), 0)"),
            Shape::Ramp => format!("min(max({x}, 0), 1)"),
            Shape::Table(_) | Shape::Pchip(_) => format!("shape{number}({x})"),
        };
        format!("{size:?} * {shape}")
    }

    /// The points of its table, if it is one.
    pub(crate) fn table(&self) -> Option<(Vec<f64>, Vec<f64>)> {
        let (Shape::Table(values) | Shape::Pchip(values)) = &self.shape else { return None };
        let x = (0..9).map(|k| 0.25 * f64::from(k) - 1.0).collect();
        Some((x, [&[0.0], &values[..], &[0.0]].concat()))
    }
}

/// The cell of a table and the part of it.
fn cell(x: f64) -> (usize, f64) {
    let place = (x + 1.0).clamp(0.0, 2.0) * 4.0;
    let k = (place as usize).min(7);
    (k, place - k as f64)
}

fn point(values: &[f64], k: usize) -> f64 {
    if k == 0 || k == 8 { 0.0 } else { values[k - 1] }
}

/// Fritsch and Butland's slopes per cell: harmonic means of the rises, 0 where they differ in sign.
fn slopes(values: &[f64]) -> Vec<f64> {
    let rises: Vec<f64> = (0..8).map(|k| point(values, k + 1) - point(values, k)).collect();
    let inner = |k: usize| match (rises[k - 1], rises[k]) {
        (a, b) if a * b <= 0.0 => 0.0,
        (a, b) => 2.0 * a * b / (a + b),
    };
    let end = |a: f64, b: f64| match 1.5 * a - 0.5 * b {
        slope if slope * a <= 0.0 => 0.0,
        slope if a * b <= 0.0 && slope.abs() > 3.0 * a.abs() => 3.0 * a,
        slope => slope,
    };
    let mut slopes = vec![end(rises[0], rises[1])];
    slopes.extend((1..8).map(inner));
    slopes.push(end(rises[7], rises[6]));
    slopes
}
