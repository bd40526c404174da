//! From row to row: every part of a network responds to the inputs of a panel in closed form.

use lptn_network::InputError;

use super::ExactError;
use super::carried::{Carried, Lengths};
use super::inputs::{Inputs, Panel};
use super::modal::Modal;
use super::reduced::Reduced;
use super::spectrum::{Island, groups};

/// Allowed error of the series instead of the inputs, in K.
const TARGET: f64 = 1e-10;

/// Panels in all; more are a sign of an input that no series follows.
const MOST_PANELS: u64 = 5_000_000;

/// Fewest panels, if a series represents an input.
const LEAST_PANELS: f64 = 300.0;

/// States that are joined to each other and to no others.
enum Part<'a> {
    Modal(Box<Modal>),
    Carried(Box<Carried<'a>>),
}

impl<'a> Part<'a> {
    fn all(
        (reduced, boundaries): (&'a Reduced, usize),
        rises: &[f64],
        lengths: Lengths,
    ) -> Result<Vec<Self>, ExactError> {
        let ties = reduced.ties(boundaries);
        let of = |members: Vec<usize>| {
            let inside = |&(to, _, _): &(usize, usize, f64)| members.binary_search(&to).is_ok();
            if reduced.streams.iter().any(inside) {
                let carried = Carried::new((reduced, boundaries), members, rises, lengths)?;
                return Ok(Self::Carried(Box::new(carried)));
            }
            let island = Island::of(reduced, &ties, members)?;
            Ok(Self::Modal(Box::new(Modal::new(island, reduced, rises))))
        };
        groups(reduced).into_iter().map(of).collect()
    }

    fn step(&mut self, panel: &Panel, (from, to): (f64, f64)) {
        match self {
            Self::Modal(part) => part.step(panel, to - from),
            Self::Carried(part) => part.step(panel, (from, to)),
        }
    }

    fn add_rises(&self, sum: &mut [f64]) {
        match self {
            Self::Modal(part) => part.add_rises(sum),
            Self::Carried(part) => part.add_rises(sum),
        }
    }

    fn add_slopes(&self, inputs: &[f64], sum: &mut [f64]) {
        match self {
            Self::Modal(part) => part.add_slopes(inputs, sum),
            Self::Carried(part) => part.add_slopes(inputs, sum),
        }
    }

    /// The largest effect of heat into each state in W for `duration` in s on one of them.
    fn largest_rise(&self, duration: f64, heat: &[f64]) -> f64 {
        match self {
            Self::Modal(part) => part.largest_rise(duration, heat),
            Self::Carried(part) => part.largest_rise(heat),
        }
    }
}

/// Effect of one unit of an input's error on a temperature.
#[derive(Clone, Copy)]
struct Gain {
    /// K per unit that lasts.
    lasting: f64,
    /// K/s per unit, at the node it acts on first.
    at_once: f64,
}

pub(crate) struct March<'a> {
    reduced: &'a Reduced,
    inputs: Inputs<'a>,
    parts: Vec<Part<'a>>,
    gains: Vec<Gain>,
    duration: f64,
    panels: u64,
    /// No panel is longer if a series represents an input: changes between its points might be
    /// missed.
    longest: f64,
    /// Largest error of the series up to now, in K: that of panels on which it lasts, and the sum of
    /// those on which it is made short instead.
    lasting: f64,
    summed: f64,
}

impl<'a> March<'a> {
    /// Starts from the rises of the states over the reference of the inputs; `usual` is the most
    /// frequent distance of two rows in s.
    ///
    /// # Errors
    /// [`ExactError`] if the numbers fail.
    pub(crate) fn new(
        inputs: Inputs<'a>,
        reduced: &'a Reduced,
        rises: &[f64],
        (usual, duration): (f64, f64),
    ) -> Result<Self, ExactError> {
        let longest =
            if inputs.need_quadrature() { duration / LEAST_PANELS } else { f64::INFINITY };
        let mut unit = usual;
        while unit > longest {
            unit *= 0.5; // as panels are halved
        }
        let lengths = Lengths { unit, duration, terms: inputs.terms() };
        let parts = Part::all((reduced, inputs.boundaries()), rises, lengths)?;
        let columns = 0..reduced.feeds.ncols();
        let gains = columns.map(|i| gain(reduced, &parts, i, duration)).collect();
        Ok(Self {
            reduced,
            inputs,
            parts,
            gains,
            duration,
            panels: 0,
            longest,
            lasting: 0.0,
            summed: 0.0,
        })
    }

    /// Enters a segment: comparisons of `t` are read inside it.
    pub(crate) fn enter(&mut self, inside: f64) {
        self.inputs.inside = inside;
    }

    /// All inputs at a time.
    pub(crate) fn inputs(&mut self, time: f64) -> Result<Vec<f64>, InputError> {
        self.inputs.at(time)
    }

    /// Error of the series instead of the inputs up to now, in K; `None` if every input is constant or
    /// a straight line, so that there is no such error.
    pub(crate) fn series_error(&self) -> Option<f64> {
        self.inputs.need_quadrature().then_some(self.lasting + self.summed)
    }

    /// Goes on to a later time of the same segment, in as many panels as the inputs need.
    pub(crate) fn advance(&mut self, from: f64, to: f64) -> Result<(), ExactError> {
        let mut open = vec![(from, to)];
        while let Some((from, to)) = open.pop() {
            self.panels += 1;
            let panel = self.inputs.panel((from, to))?;
            let middle = 0.5 * (from + to);
            let divisible = from < middle && middle < to;
            if !divisible || self.accepts(&panel, to - from) {
                self.parts.iter_mut().for_each(|part| part.step(&panel, (from, to)));
            } else if self.panels < MOST_PANELS {
                open.extend([(middle, to), (from, middle)]);
            } else {
                return Err(ExactError::Quadrature { time: from });
            }
        }
        Ok(())
    }

    /// True if the series are good enough: their error is small for any duration, or very small
    /// over this short time.
    fn accepts(&mut self, panel: &Panel, length: f64) -> bool {
        if length > self.longest {
            return false;
        }
        let sum = |gain: &dyn Fn(&Gain) -> f64| -> f64 {
            panel.errors.iter().zip(&self.gains).map(|(error, g)| error * gain(g)).sum()
        };
        let lasting = sum(&|g| g.lasting);
        let short = sum(&|g| g.at_once * length);
        if lasting <= TARGET {
            self.lasting = self.lasting.max(lasting);
        } else if short <= 1e-3 * TARGET {
            self.summed += short;
        } else {
            return false;
        }
        true
    }

    /// Forgets everything that a boundary takes: from this start the effect of a cycle shows. It is
    /// for networks without streams only.
    pub(crate) fn forget(&mut self) {
        self.modal().for_each(Modal::forget);
    }

    /// The amplitudes that a cycle of `period` in s leads back to, after one cycle from
    /// [`March::forget`]. With the effect c of the cycle, they obey `y = exp(-r period) y + c`.
    pub(crate) fn repeat(&mut self, period: f64) {
        self.modal().for_each(|part| part.repeat(period));
    }

    /// The slowest rate of a mode that a boundary takes part in, in 1/s.
    pub(crate) fn slowest(&mut self) -> f64 {
        self.modal().map(|part| part.slowest()).fold(f64::INFINITY, f64::min)
    }

    fn modal(&mut self) -> impl Iterator<Item = &mut Modal> {
        self.parts.iter_mut().filter_map(|part| match part {
            Part::Modal(part) => Some(&mut **part),
            Part::Carried(_) => None,
        })
    }

    /// Number of states that advance by the exponential of a matrix, and their rounding in K.
    pub(crate) fn carried(&self) -> (usize, f64) {
        let carried = self.parts.iter().filter_map(|part| match part {
            Part::Modal(_) => None,
            Part::Carried(part) => Some((part.states(), part.rounding())),
        });
        carried.fold((0, 0.0), |sum: (usize, f64), part| (sum.0 + part.0, sum.1.max(part.1)))
    }

    /// Rises of the states.
    pub(crate) fn rises(&self) -> Vec<f64> {
        let mut sum = vec![0.0; self.reduced.states.len()];
        self.parts.iter().for_each(|part| part.add_rises(&mut sum));
        sum
    }

    /// Error of the modes and matrices, in K. Their rates of change at `time` are put into the heat
    /// balance of every node, path by path. The residual counts as heat that lasts for the whole
    /// run. An eigenvector or a rate that is off shows here, whatever the reason.
    pub(crate) fn defect(&mut self, time: f64) -> Result<f64, InputError> {
        let inputs = self.inputs.at(time)?;
        let rises = self.rises();
        let mut slopes = vec![0.0; rises.len()];
        self.parts.iter().for_each(|part| part.add_slopes(&inputs, &mut slopes));
        let boundaries = self.inputs.boundaries();
        let mut left: Vec<f64> =
            slopes.iter().zip(&self.reduced.capacity).map(|(slope, c)| -c * slope).collect();
        for &(a, b, g) in &self.reduced.links {
            let heat = g * (rises[a] - rises[b]);
            left[a] -= heat;
            left[b] += heat;
        }
        for &(to, from, g) in &self.reduced.streams {
            left[to] += g * (rises[from] - rises[to]);
        }
        for (i, left) in left.iter_mut().enumerate() {
            for (j, u) in inputs.iter().enumerate() {
                let u = if j < boundaries { u - rises[i] } else { *u };
                *left += self.reduced.feeds[(i, j)] * u;
            }
        }
        let rises = self.parts.iter().map(|part| part.largest_rise(self.duration, &left));
        Ok(rises.fold(0.0, f64::max))
    }
}

fn gain(reduced: &Reduced, parts: &[Part<'_>], input: usize, duration: f64) -> Gain {
    let feeds: Vec<f64> = (0..reduced.states.len()).map(|i| reduced.feeds[(i, input)]).collect();
    let rises = parts.iter().map(|part| part.largest_rise(duration, &feeds));
    let lasting = rises.fold(0.0, f64::max);
    let at_once = feeds.iter().zip(&reduced.capacity).map(|(feed, c)| feed / c).fold(0.0, f64::max);
    Gain { lasting, at_once }
}
