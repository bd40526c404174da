//! Other views of figures over time: a part of the time, and days instead of hours.

use crate::figure::{Curve, Day, Figure, Look, Panel, Scale};
use crate::thin::thinned;

/// A day in s.
const DAY: f64 = 86_400.0;

/// A time in s in which days can no longer be distinguished.
pub const LONG: f64 = 60.0 * DAY;

/// A line of more points than this is thinned on a page, to four in each of these stretches.
const MOST_POINTS: usize = 20_000;
const STRETCHES: usize = 4000;

/// The values of a day that are many.
const MANY: f64 = 4.0;

impl Figure {
    /// The part of a figure between two times in s. A line ends on its value there.
    #[must_use]
    pub fn between(mut self, (from, to): (f64, f64)) -> Self {
        for panel in self.panels.iter_mut().filter(|panel| panel.x.scale == Scale::Time) {
            panel.moments.retain(|moment| moment.at >= from && moment.at <= to);
            panel.curves.iter_mut().for_each(|curve| cut(curve, (from, to)));
            panel.curves.retain(|curve| !curve.points.is_empty());
        }
        self.panels.retain(|panel| !panel.curves.is_empty());
        self
    }

    /// The mean of each day, with a band from the lowest to the highest value of the day. Days
    /// begin at multiples of 24 h. A curve that does not know its [days](Curve::days) is straight
    /// between its points. Dots and bands of lines stay as they are.
    #[must_use]
    pub fn daily(mut self) -> Self {
        let mut straight = false;
        for panel in self.panels.iter_mut().filter(|panel| panel.x.scale == Scale::Time) {
            panel.moments.clear();
            let lines = |curve: &&mut Curve| curve.look != Look::Dots && curve.spread.is_empty();
            for curve in panel.curves.iter_mut().filter(lines) {
                straight |= curve.days.is_empty();
                by_day(curve);
            }
        }
        let between = if straight { ", straight between rows" } else { "" };
        let days = format!("means of days, bands from the lowest to the highest value{between}");
        let notes = [self.note, days].into_iter().filter(|text| !text.is_empty());
        self.note = notes.collect::<Vec<_>>().join("\n");
        self
    }

    /// [Days](Self::daily) if the time is longer than 60 d and has more than four values a day;
    /// else the figure as it is.
    #[must_use]
    pub fn legible(self) -> Self {
        let lines = self.panels.iter().filter(|panel| panel.x.scale == Scale::Time);
        let mut lines =
            lines.flat_map(|panel| &panel.curves).filter(|curve| curve.look == Look::Line);
        let is_dense = |curve: &Curve| {
            let [Some(first), Some(last)] = [curve.points.first(), curve.points.last()] else {
                return false;
            };
            let time = last.0 - first.0;
            time > LONG && curve.points.len() as f64 > MANY * time / DAY
        };
        if lines.any(is_dense) { self.daily() } else { self }
    }

    /// Each small panel as a figure, named by its first curve, before the figure of the others.
    #[must_use]
    pub fn apart(mut self) -> Vec<Self> {
        let (small, others): (Vec<_>, Vec<_>) =
            self.panels.into_iter().partition(|panel| panel.small);
        let name = |panel: &Panel| panel.curves.first().map_or(String::new(), |c| c.name.clone());
        let one = |panel| Self { title: name(&panel), note: String::new(), panels: vec![panel] };
        let mut figures: Vec<Self> = small.into_iter().map(one).collect();
        self.panels = others;
        if let (Some(first), true) = (figures.first_mut(), self.panels.is_empty()) {
            first.note = std::mem::take(&mut self.note);
        }
        figures.into_iter().chain([self]).collect()
    }

    /// Lines of very many points thinned, with the lowest and the highest value of each stretch:
    /// no screen shows the difference, and a page can be sent.
    #[must_use]
    pub fn light(mut self) -> Self {
        let curves = self.panels.iter_mut().flat_map(|panel| &mut panel.curves);
        for curve in curves.filter(|curve| curve.look == Look::Line && curve.spread.is_empty()) {
            if curve.points.len() > MOST_POINTS && curve.points.is_sorted_by(|a, b| a.0 <= b.0) {
                curve.points = thinned(&curve.points, STRETCHES);
            }
        }
        self
    }

    /// Multiplies the values of a unit and gives them another one.
    #[must_use]
    pub fn in_unit(mut self, unit: &str, (other, factor): (&str, f64)) -> Self {
        for panel in self.panels.iter_mut().filter(|panel| panel.y.unit == unit) {
            other.clone_into(&mut panel.y.unit);
            scale(panel, factor);
        }
        self
    }
}

fn scale(panel: &mut Panel, factor: f64) {
    panel.limits.iter_mut().for_each(|limit| limit.value *= factor);
    for curve in &mut panel.curves {
        curve.points.iter_mut().for_each(|point| point.1 *= factor);
        curve
            .spread
            .iter_mut()
            .for_each(|(low, high)| (*low, *high) = (*low * factor, *high * factor));
        for day in &mut curve.days {
            let (low, high) = day.range;
            (day.mean, day.range) = (day.mean * factor, (low * factor, high * factor));
        }
    }
}

/// The value between two points at a time.
fn between((a, b): ((f64, f64), (f64, f64)), at: f64) -> f64 {
    if b.0 > a.0 { a.1 + (b.1 - a.1) * (at - a.0) / (b.0 - a.0) } else { b.1 }
}

/// Keeps the part of a curve between two times.
fn cut(curve: &mut Curve, (from, to): (f64, f64)) {
    curve.days.retain(|day| day.from >= from && day.to <= to);
    let times: Vec<f64> = curve.points.iter().map(|point| point.0).collect();
    let ends = if curve.look == Look::Dots { Vec::new() } else { vec![from, to] };
    let along = |values: &[f64]| -> Vec<(f64, f64)> {
        let points: Vec<(f64, f64)> = times.iter().copied().zip(values.iter().copied()).collect();
        let inside = points.iter().copied().filter(|(x, _)| *x >= from && *x <= to);
        let mut kept: Vec<(f64, f64)> = inside.collect();
        for &end in ends.iter().filter(|end| !times.contains(end)) {
            let pair = points.windows(2).find(|pair| pair[0].0 < end && end < pair[1].0);
            kept.extend(pair.map(|pair| (end, between((pair[0], pair[1]), end))));
        }
        kept.sort_by(|a, b| a.0.total_cmp(&b.0));
        kept
    };
    let side = |of: fn(&(f64, f64)) -> f64| -> Vec<f64> {
        along(&curve.spread.iter().map(of).collect::<Vec<_>>()).iter().map(|p| p.1).collect()
    };
    let spread = match curve.spread.is_empty() {
        true => Vec::new(),
        false => side(|s| s.0).into_iter().zip(side(|s| s.1)).collect(),
    };
    curve.points = along(&curve.points.iter().map(|point| point.1).collect::<Vec<_>>());
    curve.spread = spread;
}

/// Mean, lowest and highest value of a line in each day.
fn by_day(curve: &mut Curve) {
    curve.aside = false;
    if !curve.days.is_empty() {
        let day = |day: &Day| ((f64::midpoint(day.from, day.to), day.mean), day.range);
        (curve.points, curve.spread) = curve.days.iter().map(day).unzip();
        return;
    }
    let (Some(first), Some(last)) = (curve.points.first(), curve.points.last()) else { return };
    let (start, stop) = ((first.0 / DAY).floor(), last.0);
    let mut days: Vec<((f64, f64), (f64, f64))> = Vec::new();
    let mut day = start;
    while day * DAY < stop {
        let span = (day * DAY, (day + 1.0) * DAY);
        let from = curve.points.partition_point(|point| point.0 < span.0).saturating_sub(1);
        let to = curve.points.partition_point(|point| point.0 <= span.1);
        let near = curve.points[from..curve.points.len().min(to + 1)].to_vec();
        let mut part = Curve::line("", near);
        cut(&mut part, span);
        days.extend(of_day(&part.points));
        day += 1.0;
    }
    (curve.points, curve.spread) = days.into_iter().unzip();
}

/// The middle and the mean of a line over a day, and its extremes.
fn of_day(points: &[(f64, f64)]) -> Option<((f64, f64), (f64, f64))> {
    let (first, last) = (points.first()?, points.last()?);
    let length = last.0 - first.0;
    let area: f64 =
        points.windows(2).map(|p| (p[1].0 - p[0].0) * f64::midpoint(p[0].1, p[1].1)).sum();
    let ends = points
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p.1), high.max(p.1)));
    (length > 0.0).then(|| ((f64::midpoint(first.0, last.0), area / length), ends))
}

#[cfg(test)]
mod tests {
    use crate::figure::{Axis, Curve, Day, Figure, Panel};

    fn figure(points: Vec<(f64, f64)>) -> Figure {
        let mut panel = Panel::new(Axis::time(), Axis::linear("heat", "J"));
        panel.curves.push(Curve::line("a", points));
        Figure { panels: vec![panel], ..Figure::default() }
    }

    #[test]
    fn a_part_ends_on_its_line() {
        let part = figure(vec![(0.0, 0.0), (10.0, 20.0), (20.0, 0.0)]).between((5.0, 15.0));
        assert_eq!(part.panels[0].curves[0].points, [(5.0, 10.0), (10.0, 20.0), (15.0, 10.0)]);
        assert!(figure(vec![(0.0, 1.0), (1.0, 1.0)]).between((5.0, 6.0)).panels.is_empty());
    }

    /// A ramp of 24 a day, then a day at 24: means of 12 and 24.
    #[test]
    fn days_have_their_mean_and_their_extremes() {
        let day = 86_400.0;
        let days = figure(vec![(0.0, 0.0), (day, 24.0), (2.0 * day, 24.0)]).daily();
        let curve = &days.panels[0].curves[0];
        assert_eq!(curve.points, [(0.5 * day, 12.0), (1.5 * day, 24.0)]);
        assert_eq!(curve.spread, [(0.0, 24.0), (24.0, 24.0)]);
    }

    /// Days that are known better than by the points of a curve stay as they are; a part has the
    /// whole ones in it, and 3.6 MJ are 1 kWh.
    #[test]
    fn known_days_are_drawn() {
        let day = 86_400.0;
        let mut known = figure(vec![(0.0, 0.0), (2.0 * day, 0.0)]);
        let of =
            |from: f64, mean: f64| Day { from, to: from + day, mean, range: (0.0, 2.0 * mean) };
        known.panels[0].curves[0].days = vec![of(0.0, 3.6e6), of(day, 7.2e6)];
        let part = known.clone().between((0.5 * day, 2.0 * day)).in_unit("J", ("kWh", 1.0 / 3.6e6));
        let (all, part) = (known.daily(), part.daily());
        assert_eq!(all.panels[0].curves[0].points, [(0.5 * day, 3.6e6), (1.5 * day, 7.2e6)]);
        let part = &part.panels[0].curves[0];
        let ([(at, mean)], [(low, high)]) = (&part.points[..], &part.spread[..]) else {
            panic!("{part:?}")
        };
        assert!((at - 1.5 * day).abs() < 1e-6 && (mean - 2.0).abs() < 1e-12, "{part:?}");
        assert!(low.abs() < 1e-12 && (high - 4.0).abs() < 1e-12, "{part:?}");
        assert!(!all.note.contains("rows"), "{}", all.note);
    }

    /// A peak of one point among 100,000 stays, and no line of 20,000 points is touched.
    #[test]
    fn a_light_line_keeps_its_peaks() {
        let line = |count: u32| -> Vec<(f64, f64)> {
            (0..count).map(|i| (f64::from(i), if i == 777 { 9.0 } else { 0.0 })).collect()
        };
        let light = figure(line(100_000)).light();
        let points = &light.panels[0].curves[0].points;
        assert!(points.len() <= 16_000 && points.contains(&(777.0, 9.0)), "{}", points.len());
        assert_eq!(figure(line(20_000)).light(), figure(line(20_000)));
    }

    /// Small panels are figures with the names of their curves; the others stay together.
    #[test]
    fn small_panels_are_figures_of_their_own() {
        let mut of = figure(vec![(0.0, 1.0)]);
        of.note = "note".into();
        let small = Panel { small: true, ..of.panels[0].clone() };
        of.panels.insert(0, small);
        let apart = of.clone().apart();
        let told: Vec<(&str, &str)> = apart.iter().map(|f| (&*f.title, &*f.note)).collect();
        assert_eq!(told, [("a", ""), ("", "note")]);
        of.panels.truncate(1);
        assert_eq!(of.apart()[0].note, "note");
    }

    /// Hours of 61 days are shown as days, those of 59 are not, and neither are weeks.
    #[test]
    fn only_days_that_cannot_be_told_apart_are_means() {
        let of = |days: u32, step: u32| {
            let points = (0..=days * 24).step_by(step as usize);
            figure(points.map(|h| (f64::from(h) * 3600.0, 0.0)).collect()).legible()
        };
        let count = |figure: Figure| figure.panels[0].curves[0].points.len();
        assert_eq!(count(of(61, 1)), 61);
        assert_eq!(count(of(59, 1)), 59 * 24 + 1);
        assert_eq!(count(of(63, 168)), 10);
    }

    /// 1 kWh is 3.6 MJ by definition.
    #[test]
    fn an_energy_takes_another_unit() {
        let energy = figure(vec![(0.0, 7.2e6)]).in_unit("J", ("kWh", 1.0 / 3.6e6));
        assert_eq!(energy.panels[0].y.unit, "kWh");
        assert!((energy.panels[0].curves[0].points[0].1 - 2.0).abs() < 1e-12);
    }
}
