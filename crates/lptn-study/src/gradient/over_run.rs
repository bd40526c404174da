//! Gradients of a run.

use lptn_analysis::{RunAnalysis, Trusted};
use lptn_assembly::ThermalSystem;
use lptn_network::{Functional, InputError, Item, LimitId, Network, ParameterId, RunSettings};
use lptn_solve::{
    EventKind, Gradient, Proceed, Progress, RecordedNodes, SensitiveRun, on_both_sides, own_side,
};

use crate::gradient::error::GradientError;
use crate::gradient::followed::{Followed, Gradients};

/// Points and weights of Gauss and Legendre's rule on (-1, 1), exact to degree 9.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
    (0.906_179_845_938_664, 0.236_926_885_056_189_08),
];

/// Least number of parts of a run over which a quantity is integrated.
const PARTS: f64 = 100.0;

/// Largest error of an integral, as a part of that of the absolute value.
const RESOLVED: f64 = 1e-6;

/// Two times that are nearer than this part of the run are the same.
const SAME: f64 = 1e-9;

/// A jump is larger than this part of the value.
const JUMP: f64 = 1e-6;

/// A run, and the same with its sensitivities at the times that the gradients need.
pub(super) struct OverRun<'a> {
    system: &'a ThermalSystem,
    ids: &'a [ParameterId],
    followed: &'a [Followed],
    ends: (f64, f64),
    /// For each quantity the time at which its margin is least.
    worst: Vec<(f64, f64)>,
    /// Ends of the parts over which quantities are integrated; none if none is.
    parts: Vec<f64>,
    /// Times between them at which something switches.
    events: Vec<f64>,
    /// Times between them at which inputs bend or jump.
    breakpoints: Vec<f64>,
    run: Trusted<SensitiveRun>,
}

impl<'a> OverRun<'a> {
    pub(super) fn of(
        (system, ids): (&'a ThermalSystem, &'a [ParameterId]),
        settings: &RunSettings,
        followed: &'a [Followed],
        observer: &dyn Fn(Progress) -> Proceed,
    ) -> Result<Self, GradientError> {
        let network = system.network();
        let run = RunAnalysis::of(network, settings).bare();
        let ends = (run.start(), run.stop());
        let seen = run.solve(system, &mut |progress| observer(progress))?;
        let worst = |one: &Followed| {
            let limit = seen.limits()[one.limit.index()];
            (limit.worst_at, limit.margin)
        };
        let worst: Vec<(f64, f64)> = followed.iter().map(worst).collect();
        let is_limit = |kind: &EventKind| matches!(kind, EventKind::Limit(_));
        let events = seen.events().iter().filter(|event| !is_limit(&event.kind));
        let events: Vec<f64> = events.map(|event| event.time).collect();
        let breakpoints = breakpoints(network, followed, ends)?;
        let mut parts = Vec::new();
        if followed.iter().any(Followed::is_integrated) {
            parts = ends_of_parts(&run.rows()?, [&events, &breakpoints], ends);
        }
        let inside = parts.windows(2).flat_map(|part| points((part[0], part[1])));
        let moments = worst.iter().map(|(at, _)| *at).chain(events.iter().copied());
        let moments = on_both_sides(moments.chain(breakpoints.iter().copied()), ends);
        let mut times: Vec<f64> = inside.map(|(time, _)| time).chain(moments).collect();
        times.extend([ends.0, ends.1]);
        times.retain(|time| (ends.0..=ends.1).contains(time));
        times.sort_by(f64::total_cmp);
        times.dedup();
        let run = run.at(times).keeping(RecordedNodes::All);
        let run = run.with_slopes((network, ids), observer)?;
        match &run.gradient {
            Gradient::Differences(why) => Err(GradientError::Differences { why: why.to_string() }),
            Gradient::Exact => {
                Ok(Self { system, ids, followed, ends, worst, parts, events, breakpoints, run })
            }
        }
    }

    pub(super) fn gradients(&self) -> Result<Gradients, GradientError> {
        let mut found = Gradients::default();
        for (place, one) in self.followed.iter().enumerate() {
            let (value, slopes) = if one.is_integrated() {
                self.integrated(one)?
            } else {
                let row = self.row_of(place, one)?;
                let value = match one.functional {
                    Functional::Max | Functional::Min => self.worst[place].1,
                    _ => self.run.margin_in_row(one.limit, row)?,
                };
                (value, self.slopes(one.limit, row)?)
            };
            found.add(one.sign * value, slopes.iter().map(|slope| one.sign * slope).collect());
        }
        Ok(found)
    }

    /// The row with the value of a quantity.
    fn row_of(&self, place: usize, one: &Followed) -> Result<usize, GradientError> {
        let times = self.run.solution.times();
        if !matches!(one.functional, Functional::Max | Functional::Min) {
            return Ok(times.len() - 1);
        }
        let margins: Result<Vec<f64>, _> =
            (0..times.len()).map(|row| self.run.margin_in_row(one.limit, row)).collect();
        let margins = margins?;
        Ok(own_side((times, |row| margins[row]), self.worst[place], self.ends))
    }

    fn slopes(&self, limit: LimitId, row: usize) -> Result<Vec<f64>, GradientError> {
        let one = |&id: &ParameterId| Ok(self.run.margin_derivative(id, (limit, row))?);
        self.ids.iter().map(one).collect()
    }

    /// The mean or the integral of a margin, and its derivatives.
    fn integrated(&self, one: &Followed) -> Result<(f64, Vec<f64>), GradientError> {
        let mut sums = vec![Sum::default(); 1 + self.ids.len()];
        for part in self.parts.windows(2) {
            for (k, (time, weight)) in points((part[0], part[1])).into_iter().enumerate() {
                let row = self.row_at(time);
                let rough = 0.5 * (part[1] - part[0]) * ROUGH[k];
                let margin = self.run.margin_in_row(one.limit, row)?;
                let values = [margin].into_iter().chain(self.slopes(one.limit, row)?);
                sums.iter_mut().zip(values).for_each(|(sum, v)| sum.add(v, (weight, rough)));
            }
        }
        if !sums.iter().all(Sum::is_resolved) {
            return Err(GradientError::Unresolved { name: one.name.clone() });
        }
        self.check_jumps(one)?;
        let over = if one.functional == Functional::Mean { self.ends.1 - self.ends.0 } else { 1.0 };
        let mut values = sums.iter().map(|sum| sum.fine / over);
        Ok((values.next().unwrap_or(f64::NAN), values.collect()))
    }

    fn row_at(&self, time: f64) -> usize {
        self.run.solution.times().partition_point(|known| *known < time)
    }

    /// Refuses a quantity that jumps at a time which parameters move.
    fn check_jumps(&self, one: &Followed) -> Result<(), GradientError> {
        let jumps = |&&time: &&f64| {
            let after = self.row_at(time);
            let rows = [after.saturating_sub(1), after];
            let [before, after] =
                rows.map(|row| self.run.margin_in_row(one.limit, row).unwrap_or(f64::NAN));
            (after - before).abs() > JUMP * (before.abs() + after.abs())
        };
        let moved = self.events.iter().find(jumps);
        let bent = self.breakpoints.iter().find(jumps).filter(|_| self.moves_breakpoints());
        let jump = |&time: &f64| Err(GradientError::Jumps { name: one.name.clone(), time });
        moved.or(bent).map_or(Ok(()), jump)
    }

    /// True if a parameter moves a time at which inputs bend or jump.
    fn moves_breakpoints(&self) -> bool {
        let network = self.system.network();
        self.ids.iter().any(|&id| {
            let own = network.parameter_value(id);
            let mut changed = network.given();
            changed.set(id, own + 1e-3 * if own == 0.0 { 1.0 } else { own });
            let other = network.with(&changed).ok();
            let times = other.and_then(|other| breakpoints(&other, self.followed, self.ends).ok());
            times.is_none_or(|times| times != self.breakpoints)
        })
    }
}

/// The times at which inputs or the quantities bend or jump.
fn breakpoints(
    network: &Network,
    followed: &[Followed],
    ends: (f64, f64),
) -> Result<Vec<f64>, InputError> {
    let limits: Vec<Item> = followed.iter().map(|one| Item::Limit(one.limit)).collect();
    let mut times = network.breakpoints(ends.0, ends.1)?;
    times.extend(network.result_breakpoints(&limits, ends)?);
    times.sort_by(f64::total_cmp);
    Ok(times)
}

/// Weights of the rule through the outer points and the middle one of [`GAUSS`], exact to degree 3.
const ROUGH: [f64; 5] =
    [0.405_928_877_095_966_4, 0.0, 1.188_142_245_808_067_3, 0.0, 0.405_928_877_095_966_4];

/// An integral by two rules.
#[derive(Clone, Copy, Default)]
struct Sum {
    fine: f64,
    rough: f64,
    /// Integral of the absolute value.
    size: f64,
}

impl Sum {
    fn add(&mut self, value: f64, (fine, rough): (f64, f64)) {
        self.fine += fine * value;
        self.rough += rough * value;
        self.size += fine * value.abs();
    }

    fn is_resolved(&self) -> bool {
        (self.fine - self.rough).abs() <= RESOLVED * self.size
    }
}

/// The points in a part of a run, and their weights in s.
fn points((from, to): (f64, f64)) -> [(f64, f64); 5] {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    GAUSS.map(|(place, weight)| (middle + half * place, half * weight))
}

/// The ends of the parts over which quantities are integrated.
fn ends_of_parts(rows: &[f64], more: [&[f64]; 2], (start, stop): (f64, f64)) -> Vec<f64> {
    let length = stop - start;
    let even = (0..=100).map(|k| start + length * f64::from(k) / PARTS);
    let mut all: Vec<f64> = more.concat();
    all.extend(rows.iter().copied().chain(even));
    all.retain(|time| (start..=stop).contains(time));
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| *a - *b < SAME * length);
    all
}
