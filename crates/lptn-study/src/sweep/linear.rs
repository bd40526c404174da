//! Candidates of small linear networks: no system and no integrator, the modes in closed form.

use lptn_netlist::{Functional, SweepOver};
use lptn_network::{History, IntegratorChoice, ParameterId};
use lptn_solve::{CourseSeen, FollowedQuantity, LinearVariants, Look};

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
        known.then_some(Self { task, linear, quantities, span, breakpoints, tolerance })
    }

    /// Solves a candidate; `false` if it has to be solved as others are.
    pub fn solve(&mut self, case: u64, candidate: &mut Candidate) -> bool {
        candidate.values.resize(self.task.cases().parameters().len(), 0.0);
        self.task.cases().values(case, &mut candidate.values);
        (candidate.outside, candidate.failed) = (0, None);
        candidate.reports.clear();
        self.linear.set(&candidate.values) && self.reported(&mut candidate.reports).is_some()
    }

    fn reported(&mut self, reports: &mut Vec<f64>) -> Option<()> {
        let study = self.task.study();
        if study.over == SweepOver::Steady {
            self.linear.steady(self.span.0)?;
            for measure in &study.reports {
                reports.push(measure.of.at(self.linear.scope()).ok()? + 0.0);
            }
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
        }
        reports.iter().all(|number| number.is_finite()).then_some(())
    }
}

/// The quantities that the reports over time follow.
fn followed<'a>(task: &'a SweepTask) -> Option<Vec<FollowedQuantity<'a>>> {
    let timed = task.study().reports.iter().filter(|r| r.functional() != Functional::Value);
    timed
        .map(|measure| {
            let with = task.network().follows(&measure.of)?;
            let look = match measure.functional() {
                Functional::Life => return None,
                Functional::Last | Functional::Value => Look::End,
                Functional::Mean | Functional::Integral => Look::Integral,
                _ => Look::Extremes,
            };
            Some(FollowedQuantity { value: &measure.of, with, look })
        })
        .collect()
}

fn of_course(seen: &CourseSeen, length: f64) -> History {
    let CourseSeen { last, min, max, integral, positive } = *seen;
    History { last, min, max, mean: integral / length, positive, length }
}
