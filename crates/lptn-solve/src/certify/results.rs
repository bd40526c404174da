//! Bounds on results that follow from temperatures: heats, reports, limits, and their extremes,
//! integrals and crossings over the run.
//!
//! At every time of a step the solution is the way plus an error within the bounds. The laws are
//! evaluated on Taylor coefficients whose first ones are as wide as these bounds. That gives one
//! polynomial and one allowance for every such solution, so extremes and integrals over the step
//! are enclosed too, between the rows as at them.

use lptn_assembly::ThermalSystem;
use lptn_network::{ControlId, Evaluation, HeatOf, History, InputBounds, LimitId, Network, NodeId};
use lptn_units::Taylor;

use super::ROUNDING;
use super::polynomial::Course;
use super::way::{SAMPLES, Way};
use crate::limit::of_moments;
use crate::quantity::Quantity;
use crate::readings::Readings;

/// A number that is followed over the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Followed {
    Quantity(Quantity),
    Margin(LimitId),
}

/// Bounds on the history of a number over a run, in SI units: a lower and an upper end of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Enclosed {
    pub(crate) last: [f64; 2],
    pub(crate) min: [f64; 2],
    pub(crate) max: [f64; 2],
    pub(crate) integral: [f64; 2],
    /// Time in s for which it is above zero.
    pub(crate) positive: [f64; 2],
    /// Time in s up to which it is surely not below zero, and one at which it surely is; infinite if
    /// there is none.
    pub(crate) falls: [f64; 2],
}

impl Enclosed {
    const NOTHING: Self = Self {
        last: [f64::NAN; 2],
        min: [f64::INFINITY; 2],
        max: [f64::NEG_INFINITY; 2],
        integral: [0.0; 2],
        positive: [0.0; 2],
        falls: [f64::INFINITY; 2],
    };

    /// Takes in a stretch from a time in s to another.
    fn take(&mut self, course: &Course, (from, to): (f64, f64)) {
        let half = 0.5 * (to - from);
        let allowance = course.allowance + ROUNDING * course.size();
        let wide = |value: f64| [value - allowance, value + allowance];
        self.last = wide(course.at(1.0));
        let [low, high] = course.range();
        let ([mut min, mut max], integral) = ([low, high].map(wide), wide(0.5 * course.integral()));
        let slack = Course::SLACK * course.allowance + ROUNDING * course.size();
        min[1] += slack;
        max[0] -= slack;
        let above = course.above_zero(allowance);
        for (end, away) in [(0, -f64::EPSILON), (1, f64::EPSILON)] {
            self.min[end] = self.min[end].min(min[end]);
            self.max[end] = self.max[end].max(max[end]);
            let sums = [(&mut self.integral, integral), (&mut self.positive, above)];
            for (sum, part) in sums {
                sum[end] += 2.0 * half * part[end];
                sum[end] += away * sum[end].abs(); // of this addition
            }
        }
        let time = |place: f64| from + half * (1.0 + place);
        if self.falls[0].is_infinite() && min[0] < 0.0 {
            self.falls[0] = course.may_fall_below(allowance).map_or(self.falls[0], time);
        }
        if self.falls[1].is_infinite() && min[1] < 0.0 {
            self.falls[1] = course.falls_below(-allowance).map_or(self.falls[1], time);
        }
    }
}

/// Bounds that were found.
#[derive(Clone, Debug, Default)]
pub(crate) struct ResultBounds {
    /// The quantities whose rows have bounds.
    columns: Vec<Quantity>,
    /// Row by row, the range of each of them in SI units; NaN if there is none.
    rows: Vec<[f64; 2]>,
    followed: Vec<(Followed, Option<Enclosed>)>,
    /// The times in s up to which it goes, from its start.
    span: Option<(f64, f64)>,
}

impl ResultBounds {
    /// The ranges of a quantity in the rows.
    pub(crate) fn ranges(&self, quantity: Quantity) -> Option<impl Iterator<Item = [f64; 2]>> {
        let column = self.columns.iter().position(|known| *known == quantity)?;
        Some(self.rows.iter().skip(column).step_by(self.columns.len()).copied())
    }

    /// Bounds on the history of a number; `None` if there are none.
    pub(crate) fn of(&self, number: Followed) -> Option<&Enclosed> {
        self.span?;
        self.followed.iter().find(|(known, _)| *known == number)?.1.as_ref()
    }

    /// The time in s up to which it goes.
    pub(crate) fn end(&self) -> Option<f64> {
        self.span.map(|(_, end)| end)
    }

    /// The lower and the upper ends of the statistics of a quantity; `None` if there are none.
    pub(crate) fn histories(&self, quantity: Quantity) -> Option<[History; 2]> {
        let seen = self.of(Followed::Quantity(quantity))?;
        let length = self.span.map(|(start, end)| end - start)?;
        Some([0, 1].map(|end| History {
            last: seen.last[end],
            min: seen.min[end],
            max: seen.max[end],
            mean: seen.integral[end] / length,
            positive: seen.positive[end],
            length,
        }))
    }
}

/// The bounds of results during a run.
pub(crate) struct Results<'a> {
    system: &'a ThermalSystem,
    readings: Readings,
    found: ResultBounds,
}

/// Temperatures, and the heat of boundaries, that results read.
pub(super) struct Placed {
    inputs: InputBounds,
    vertices: Vec<Taylor>,
    given: Vec<Option<Taylor>>,
}

impl<'a> Results<'a> {
    /// For a run that records these nodes, and rows of these columns.
    pub(crate) fn new(
        system: &'a ThermalSystem,
        (recorded, columns): (&[NodeId], Vec<Quantity>),
        readings: Readings,
    ) -> Self {
        let network = system.network();
        let over_time = |id: &LimitId| !network.limits()[id.index()].is_of_moments();
        let sides = network.limit_ids().filter(over_time);
        let sides = sides.flat_map(|id| [Quantity::Side(id, 0), Quantity::Side(id, 1)]);
        let sources = network.heat_sources().map(HeatOf::Source);
        let heats = sources.chain(network.boundary_ids().map(HeatOf::Boundary));
        let reports = network.reports_over_time().map(Quantity::Report);
        let quantities = recorded.iter().map(|id| Quantity::Node(*id));
        let quantities = quantities.chain(heats.map(Quantity::Heat)).chain(reports).chain(sides);
        let all =
            quantities.map(Followed::Quantity).chain(of_moments(network).map(Followed::Margin));
        let followed = all.map(|number| (number, Some(Enclosed::NOTHING))).collect();
        let columns = columns.into_iter().filter(|quantity| reaches(*quantity)).collect();
        Self {
            system,
            readings,
            found: ResultBounds { columns, followed, ..ResultBounds::default() },
        }
    }

    /// The times at which results may bend or jump, in s.
    pub(super) fn breaks(&self) -> &[f64] {
        self.readings.inner()
    }

    /// Takes in a part of a step, in which a control may have either state if one is given.
    pub(super) fn take(
        &mut self,
        scope: &mut Evaluation,
        (from, to): (f64, f64),
        (way, bound): (&Way<SAMPLES>, &dyn Fn(usize) -> f64),
        open: Option<ControlId>,
    ) {
        self.found.span = Some((self.found.span.map_or(from, |(start, _)| start), to));
        let network = self.system.network();
        let mut inputs = network.input_bounds(scope, (from, to), self.readings.inside(from));
        let loosen =
            |inputs: &mut InputBounds| open.iter().for_each(|id| network.loosen(inputs, *id));
        inputs.iter_mut().for_each(loosen);
        let ([over, at], [whole, middle]) = (inputs, way.tube(bound));
        let place = |inputs, y: &[Taylor]| Placed::new(self.system, inputs, y);
        let placed = place(over, &whole).zip(place(at, &middle));
        let Some((mut over, mut at)) = placed else {
            self.found.followed.iter_mut().for_each(|(_, seen)| *seen = None);
            return;
        };
        for (number, seen) in &mut self.found.followed {
            let Some(enclosed) = seen else { continue };
            let bounds = over.followed(network, *number).zip(at.followed(network, *number));
            match bounds.and_then(|(whole, middle)| Course::of(&middle, &whole)) {
                Some(course) => enclosed.take(&course, (from, to)),
                None => *seen = None,
            }
        }
    }

    /// Takes in a row: its time in s, and the unknowns in K with their bounds.
    pub(super) fn row(
        &mut self,
        scope: &mut Evaluation,
        (time, open): (f64, Option<ControlId>),
        (state, bounds): (&[f64], &[f64]),
    ) {
        if self.found.columns.is_empty() {
            return;
        }
        let network = self.system.network();
        let [mut inputs, _] = network.input_bounds(scope, (time, time), self.readings.inside(time));
        open.iter().for_each(|id| network.loosen(&mut inputs, *id));
        let wide = |(t, bound): (&f64, &f64)| {
            let bound = bound + ROUNDING * t;
            Taylor::between(&[[t - bound, t + bound]])
        };
        let y: Vec<Taylor> = state.iter().zip(bounds).map(wide).collect();
        let mut placed = Placed::new(self.system, inputs, &y);
        let range = |quantity: &Quantity| {
            let bounds = placed.as_mut().and_then(|placed| placed.value(network, *quantity));
            bounds.and_then(|bounds| bounds.range()).unwrap_or([f64::NAN; 2])
        };
        let row: Vec<[f64; 2]> = self.found.columns.iter().map(range).collect();
        self.found.rows.extend(row);
    }

    pub(super) fn into_found(self) -> ResultBounds {
        self.found
    }
}

impl Placed {
    /// Places bounds on all temperatures for the results that read them; `None` if there are none.
    pub(super) fn new(
        system: &ThermalSystem,
        mut inputs: InputBounds,
        y: &[Taylor],
    ) -> Option<Self> {
        let network = system.network();
        let vertices = system.enclose_vertices(&mut inputs, y).ok()?;
        let given = network.enclose_given(&mut inputs, &vertices);
        network.place_bounds(&mut inputs, &vertices);
        let heats: Vec<Option<Taylor>> = network
            .named_heats()
            .map(|heat| network.enclose_heat(heat, &mut inputs, (&vertices, &given)))
            .collect();
        network.place_heat_bounds(&mut inputs, &heats);
        Some(Self { inputs, vertices, given })
    }

    pub(super) fn followed(&mut self, network: &Network, number: Followed) -> Option<Taylor> {
        match number {
            Followed::Quantity(quantity) => self.value(network, quantity),
            Followed::Margin(id) => network.enclose_margin(id, &mut self.inputs),
        }
    }

    fn value(&mut self, network: &Network, quantity: Quantity) -> Option<Taylor> {
        let Self { inputs, vertices, given } = self;
        match quantity {
            Quantity::Node(id) => Some(vertices[id.index()]),
            Quantity::Grid(value) => Some(network.enclose_grid_value(value, vertices)),
            Quantity::Heat(heat) => network.enclose_heat(heat, inputs, (vertices, given)),
            Quantity::State(id) => Some(network.enclose_state(id, vertices)),
            Quantity::Report(id) => network.enclose_report(id, inputs),
            Quantity::Side(id, side) => network.enclose_side((id, side), inputs),
            Quantity::BoundaryTemperature(_) | Quantity::Signal(_) | Quantity::Control(_) => None,
        }
    }
}

/// True for a column that errors of temperatures reach. Those of nodes have separate bounds.
pub(crate) fn reaches(quantity: Quantity) -> bool {
    use Quantity::{Grid, Heat, Report, State};
    matches!(quantity, Grid(_) | Heat(_) | State(_) | Report(_))
}
