//! Sizing as a picture: margins of every requirement over the range.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Level, Look, Moment, Panel};
use lptn_study::Design;

use super::Asked;
use super::single::Sized;

/// A range that spans more than this is shown by its logarithms.
const WIDE: f64 = 10.0;

impl Sized {
    /// The margins over the parameter; the answer is marked.
    pub(super) fn figure(&self) -> Figure {
        let answer = if self.sizing.feasible() { "the answer" } else { "comes closest" };
        let at = self.unit.from_si(self.sizing.trial.value);
        let marked = Some(Moment { name: answer.into(), at });
        figure(&self.asked, (&|| self.across(), marked), |i| self.curve(i))
    }

    /// The axis of the parameter; logarithmic if its values span more than [`WIDE`].
    fn across(&self) -> Axis {
        let values = self.sizing.looked_at.iter().map(|trial| self.unit.from_si(trial.value));
        let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
        let (name, unit) = (self.name.as_str(), &self.unit.text);
        if low > 0.0 && high / low > WIDE {
            Axis::log(name, unit)
        } else {
            Axis::linear(name, unit)
        }
    }

    fn curve(&self, i: usize) -> Curve {
        let mut trials: Vec<_> = self.sizing.looked_at.iter().collect();
        trials.push(&self.sizing.trial);
        trials.sort_by(|a, b| a.value.total_cmp(&b.value));
        let points =
            trials.iter().map(|trial| (self.unit.from_si(trial.value), trial.judged.margins[i]));
        Curve::line(self.asked.kept.text(i), points.collect())
    }
}

/// Margins of designs over the objective; the answer is marked.
pub(super) fn designs(asked: &Asked, all: &[&Design], answer: Option<&Design>) -> Figure {
    let objective = &asked.study.objective;
    let across = || Axis::linear(&objective.text, objective.ty.dimension.si_unit());
    let marked = answer.map(|design| Moment { name: "the answer".into(), at: design.objective });
    figure(asked, (&across, marked), |i| {
        let points = all.iter().map(|design| (design.objective, design.judged.margins[i]));
        Curve::line(asked.kept.text(i), points.collect()).looks(Look::Dots)
    })
}

/// The margin of every requirement as a curve, in a panel for each unit.
fn figure(
    asked: &Asked,
    (across, marked): (&dyn Fn() -> Axis, Option<Moment>),
    curve: impl Fn(usize) -> Curve,
) -> Figure {
    let mut panels: Vec<Panel> = Vec::new();
    for i in asked.kept.all() {
        let axis = Axis::linear("margin", asked.kept.unit(i));
        match panels.iter_mut().find(|panel| panel.y == axis) {
            Some(panel) => panel.curves.push(curve(i)),
            None => {
                let mut panel = Panel::new(across(), axis);
                panel.curves.push(curve(i));
                panels.push(panel);
            }
        }
    }
    for panel in &mut panels {
        panel.limits.push(Level { name: "margin 0: broken below it".into(), value: 0.0 });
        panel.moments.extend(marked.clone());
    }
    let title = format!("{}: size {}", asked.input.title(), asked.study.name);
    Figure { title, note: String::new(), panels }
}
