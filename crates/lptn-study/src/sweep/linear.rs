//! Candidates of small linear networks: no system and no integrator, the modes in closed form.

use lptn_netlist::{Functional, SweepOver};
use lptn_network::{Bound, Evaluation, History, IntegratorChoice, Limit, ParameterId, Value};
use lptn_solve::{CourseSeen, FollowedQuantity, LinearVariants, Look};

use crate::sweep::limits::is_temperature;
use crate::sweep::task::{Candidate, SweepTask};

/// A sweep whose candidates are solved in closed form. A candidate that has no closed form is left
/// to [`SweepTask::candidate`], so that every row is the same however the sweep is divided.
pub struct LinearSweep<'a> {
    task: &'a SweepTask,
    linear: LinearVariants<'a>,
    quantities: Vec<FollowedQuantity<'a>>,
    /// Start and stop of the run in s, the times between at which inputs bend, and its tolerance in
    /// K; for a steady state the time of its inputs.
    span: (f64, f64),
    breakpoints: Vec<f64>,
    tolerance: f64,
    /// For each limit of a steady state true if no input that changes with time determines it.
    constant: Vec<bool>,
}

impl<'a> LinearSweep<'a> {
    /// For a sweep over steady states or runs of a small linear network, whose reports are linear
    /// in temperatures and heat flows; `None` for others.
    pub fn new(task: &'a SweepTask) -> Option<Self> {
        let (network, netlist) = (task.network(), task.netlist());
        let changed: Vec<ParameterId> = task.cases().parameters().collect();
        let plain = netlist.gearboxes().is_empty() && netlist.initial().is_none();
        let linear = LinearVariants::new(network, &changed).filter(|_| plain)?;
        let (mut quantities, mut breakpoints) = (Vec::new(), Vec::new());
        let (mut span, mut tolerance) = ((task.start(), task.start()), f64::NAN);
        match task.study().over {
            SweepOver::Steady => {}
            SweepOver::Periodic => return None,
            SweepOver::Run => {
                let run = netlist.run.as_ref()?;
                let fixed = !netlist.run_values().any(|v| network.depends_on(v, &changed));
                // a closed form has no energy balance to check against a given share
                let chosen =
                    run.integrator != IntegratorChoice::Auto || run.balance_error.is_some();
                if !fixed || chosen || !linear.runs() || !network.ranged().is_empty() {
                    return None;
                }
                quantities = followed(task)?;
                breakpoints = network.breakpoints(run.start, run.stop).ok()?;
                (span, tolerance) = ((run.start, run.stop), run.tolerance);
            }
        }
        let known = network.ranged().is_empty();
        let inputs = network.limits().iter().map(Limit::sides);
        let constant = inputs.map(|sides| network.changing_inputs_of(&sides).is_empty()).collect();
        known.then_some(Self { task, linear, quantities, span, breakpoints, tolerance, constant })
    }

    /// Solves a candidate; `false` if it has to be solved as others are.
    pub fn solve(&mut self, case: u64, candidate: &mut Candidate) -> bool {
        candidate.values.resize(self.task.cases().parameters().len(), 0.0);
        self.task.cases().values(case, &mut candidate.values);
        (candidate.outside, candidate.failed) = (0, None);
        candidate.reports.clear();
        candidate.limits.clear();
        self.linear.set(&candidate.values) && self.reported(candidate).is_some()
    }

    fn reported(&mut self, Candidate { reports, limits, .. }: &mut Candidate) -> Option<()> {
        let study = self.task.study();
        if study.over == SweepOver::Steady {
            self.linear.steady(self.span.0)?;
            for measure in &study.reports {
                reports.push(measure.of.at(self.linear.scope()).ok()? + 0.0);
            }
            let margins = self.linear.limit_margins().ok()?;
            let judged = margins.iter().zip(&self.constant);
            limits.extend(
                judged.map(|(margin, constant)| if *constant { *margin } else { f64::NAN }),
            );
        } else {
            let asked = (self.quantities.as_slice(), self.tolerance);
            let seen = self.linear.run(self.span, &self.breakpoints, asked)?;
            let (mut seen, length) = (seen.iter(), self.span.1 - self.span.0);
            for measure in &study.reports {
                let number = match measure.functional() {
                    Functional::Value => measure.of.at(self.linear.scope()).ok()?,
                    functional => functional.of(&of_course(seen.next()?, length), None),
                };
                reports.push(number + 0.0);
            }
            for limit in self.task.network().limits() {
                let seen = of_course(seen.next()?, length);
                limits.push(margin((limit, &seen), self.linear.scope(), self.tolerance)?);
            }
        }
        reports.iter().all(|number| number.is_finite()).then_some(())
    }
}

/// The quantities that the reports over time and the limits follow.
fn followed<'a>(task: &'a SweepTask) -> Option<Vec<FollowedQuantity<'a>>> {
    let timed = task.study().reports.iter().filter(|measure| measure.is_over_time());
    let timed = timed.map(|measure| (&measure.of, measure.functional()));
    let limits = task.network().limits().iter().map(|limit| (&limit.of, of_limit(limit)));
    let one = |(value, functional): (&'a Value, Functional)| {
        let with = task.network().follows(value)?;
        let look = match functional {
            Functional::Life => return None,
            Functional::Last | Functional::Value => Look::End,
            Functional::Mean | Functional::Integral => Look::Integral,
            _ => Look::Extremes,
        };
        Some(FollowedQuantity { value, with, look })
    };
    timed.chain(limits).map(one).collect()
}

/// The functional that a limit compares.
fn of_limit(limit: &Limit) -> Functional {
    match (&limit.over_time[0], limit.bound) {
        (Some(over_time), _) => over_time.functional,
        (None, Bound::Below) => Functional::Max,
        (None, Bound::Above) => Functional::Min,
    }
}

/// The margin of a limit over a run. `None` if a temperature passes it by no more than the error of
/// a run: the run decides then, which knows whether it is broken from the start.
fn margin(
    (limit, seen): (&Limit, &History),
    scope: &mut Evaluation,
    tolerance: f64,
) -> Option<f64> {
    let (of, bound) = (of_limit(limit).of(seen, None), limit.value.at(scope).ok()?);
    let margin = if limit.bound == Bound::Below { bound - of } else { of - bound };
    let near = is_temperature(limit) && margin < 0.0 && margin >= -10.0 * tolerance.max(1e-9);
    (margin.is_finite() && !near).then_some(margin)
}

fn of_course(seen: &CourseSeen, length: f64) -> History {
    let CourseSeen { last, min, max, integral, positive } = *seen;
    History { last, min, max, mean: integral / length, positive, length }
}
