//! A plan as a picture: errors over the measured time, over more sensors, and by run.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Level, Look, Moment, Panel};
use lptn_report::shortened;

use super::PlanAnswer;

/// Runs that are drawn, at most.
const MOST_RUNS: usize = 12;

/// Letters of a name next to its dots.
const NAME: usize = 24;

/// Errors above this multiple of the wanted one, or of the least one, are not drawn.
const FAR: f64 = 100.0;

const ERROR: &str = "error / wanted error";

impl PlanAnswer {
    pub(super) fn pictures(&self) -> Vec<Figure> {
        let mut panels = Vec::new();
        if !self.design.curve.is_empty() {
            panels.push(self.over_time());
        }
        if self.design.sets.len() > 1 {
            panels.push(self.over_sensors());
        }
        if self.design.next.len() > 1 {
            panels.push(self.over_runs());
        }
        let title = format!("{}: plan {}", self.input.title(), self.study.name);
        vec![Figure { title, note: String::new(), panels }]
    }

    fn ratio(&self, known: usize, errors: &[f64]) -> f64 {
        let known = &self.task.known[known];
        errors[known.unknown] / known.error
    }

    fn name(&self, known: usize) -> &str {
        &self.names[self.task.known[known].unknown]
    }

    fn curves(&self, points: &dyn Fn(usize) -> Vec<(f64, f64)>) -> Vec<Curve> {
        let all = 0..self.task.known.len();
        all.map(|known| Curve::line(self.name(known), points(known)).as_place(known)).collect()
    }

    fn over_time(&self) -> Panel {
        let mut panel = Panel::new(Axis::time(), Axis::log(ERROR, ""));
        panel.curves = self.curves(&|known| {
            let points = self.design.curve.iter();
            let points = points.map(|(seconds, errors)| (*seconds, self.ratio(known, errors)));
            let all: Vec<(f64, f64)> = points.collect();
            // the first samples determine next to nothing
            let least = all.iter().map(|point| point.1).fold(1.0, f64::min);
            all.into_iter().filter(|point| point.1 < FAR * least).collect()
        });
        panel.limits.push(Level { name: "wanted".into(), value: 1.0 });
        if let Some(plan) = self.design.plan.as_ref().filter(|plan| plan.reached) {
            let at = plan.runs.iter().map(|(_, samples)| self.task.lasts(*samples)).sum();
            panel.moments.push(Moment { name: "enough".into(), at });
        }
        panel
    }

    fn over_sensors(&self) -> Panel {
        let sets = self.design.sets.iter();
        let sets = sets.map(|set| (self.places(&set.places).join(", "), set.errors.as_slice()));
        self.dots("best sensors", sets.collect())
    }

    fn over_runs(&self) -> Panel {
        let shown = self.design.next.iter().take(MOST_RUNS);
        let runs = shown.map(|next| (self.run(next.run.0).to_owned(), next.errors.as_slice()));
        self.dots("next run", runs.collect())
    }

    /// A line for each of some things, with the errors that each leaves.
    fn dots(&self, name: &str, things: Vec<(String, &[f64])>) -> Panel {
        let names = things.iter().map(|(name, _)| shortened(name, NAME)).collect();
        let mut panel = Panel::new(Axis::log(ERROR, ""), Axis::names(name, names));
        panel.curves = self.curves(&|known| {
            let points = things.iter().zip((0..).map(f64::from));
            points.map(|((_, errors), place)| (self.ratio(known, errors), place)).collect()
        });
        panel.curves = panel.curves.into_iter().map(|curve| curve.looks(Look::Dots)).collect();
        panel.moments.push(Moment { name: "wanted".into(), at: 1.0 });
        panel
    }
}
