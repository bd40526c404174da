//! Several figures in one: the same quantities share a panel.

use lptn_plot::Figure;
use lptn_plot::figure::{Axis, Curve, Look, Panel};
use lptn_report::{TEMPERATURE, plain};
use lptn_units::Unit;

use super::source::Source;

/// Height of the panel of residuals.
const RESIDUALS: f64 = 0.4;

/// One figure of all sources. If there are several runs, a curve is named by its run.
/// A panel with measured and computed values of the same name has their differences below it.
pub fn overlay(sources: Vec<Source>) -> Figure {
    let runs = sources.iter().filter(|source| !source.measured).count();
    let several = sources.len() > 1;
    let sources = in_one_scale(named_apart(sources));
    let mut whole = Figure::default();
    let mut titles: Vec<&str> = sources.iter().map(|source| source.figure.title.as_str()).collect();
    titles.dedup();
    whole.title = titles.join(" \u{b7} ");
    let mut measured = Vec::new();
    for mut source in sources {
        if several && (runs > 1 || source.measured) {
            let name = if source.measured && runs <= 1 { "" } else { source.name.as_str() };
            rename(&mut source.figure, name);
        }
        if !source.figure.note.is_empty() {
            whole.note += &format!("{}\n", source.figure.note);
        }
        if source.measured {
            measured.push(source.figure);
        } else {
            source.figure.panels.into_iter().for_each(|panel| join(&mut whole.panels, panel));
        }
    }
    let computed = whole.panels.clone();
    let measured: Vec<Panel> = measured.into_iter().flat_map(|figure| figure.panels).collect();
    for panel in &measured {
        join(&mut whole.panels, matched(panel, &computed));
    }
    with_residuals(&mut whole.panels, &computed, &measured);
    whole
}

/// Names those of one name by their paths.
fn named_apart(mut sources: Vec<Source>) -> Vec<Source> {
    let names: Vec<String> = sources.iter().map(|source| source.name.clone()).collect();
    for source in &mut sources {
        if names.iter().filter(|name| **name == source.name).count() > 1 {
            source.name = plain(&source.path.display().to_string());
        }
    }
    sources
}

/// Gives all temperatures the unit of the first run or, if there is none, of the first record.
fn in_one_scale(mut sources: Vec<Source>) -> Vec<Source> {
    let first = |measured: bool| {
        let of = sources.iter().filter(move |source| source.measured == measured);
        let mut panels = of.flat_map(|source| &source.figure.panels);
        panels.find(|panel| panel.y.name == TEMPERATURE).map(|panel| panel.y.unit.clone())
    };
    let unit = first(false).or_else(|| first(true)).and_then(|unit| Unit::parse(&unit).ok());
    let Some(unit) = unit else { return sources };
    let panels = sources.iter_mut().flat_map(|source| &mut source.figure.panels);
    for panel in panels.filter(|panel| panel.y.name == TEMPERATURE && panel.y.unit != unit.text) {
        if let Ok(own) = Unit::parse(&panel.y.unit) {
            convert(panel, &own, &unit);
        }
    }
    sources
}

fn convert(panel: &mut Panel, from: &Unit, to: &Unit) {
    let of = |value: &mut f64| *value = to.from_si(from.to_si(*value));
    for curve in &mut panel.curves {
        curve.points.iter_mut().for_each(|point| of(&mut point.1));
        curve.spread.iter_mut().for_each(|(low, high)| {
            of(low);
            of(high);
        });
    }
    panel.limits.iter_mut().for_each(|limit| of(&mut limit.value));
    panel.y.unit.clone_from(&to.text);
}

/// Puts the name of the source before those of the curves.
fn rename(figure: &mut Figure, source: &str) {
    if source.is_empty() {
        return;
    }
    for curve in figure.panels.iter_mut().flat_map(|panel| &mut panel.curves) {
        curve.name = format!("{source}: {}", curve.name);
        // the same node of several runs
        curve.place = None;
    }
}

fn is_same(a: &Panel, b: &Panel) -> bool {
    a.x == b.x && a.y == b.y
}

/// Adds a panel to the one with the same axes, or below them all.
fn join(panels: &mut Vec<Panel>, panel: Panel) {
    match panels.iter_mut().find(|other| is_same(other, &panel)) {
        Some(other) => {
            panel.curves.into_iter().for_each(|curve| add(&mut other.curves, curve));
            for limit in panel.limits {
                if !other.limits.contains(&limit) {
                    other.limits.push(limit);
                }
            }
            other.moments.extend(panel.moments);
        }
        None => panels.push(panel),
    }
}

/// Adds a curve, unless it lies on one of the same thing in another run, such as the air around.
fn add(curves: &mut Vec<Curve>, curve: Curve) {
    let bare = |name: &str| name.rsplit(": ").next().map(str::to_owned);
    let is_same =
        |other: &&mut Curve| bare(&other.name) == bare(&curve.name) && other.points == curve.points;
    match curves.iter_mut().find(is_same) {
        Some(other) => other.name = bare(&curve.name).unwrap_or_default(),
        None => curves.push(curve),
    }
}

/// The computed curve of the same name, and the place whose ink it has.
fn computed_of<'a>(name: &str, panel: &Panel, computed: &'a [Panel]) -> Option<(usize, &'a Curve)> {
    let here = computed.iter().find(|other| is_same(other, panel))?;
    let bare = name.rsplit(": ").next().unwrap_or(name);
    let (place, curve) = here.curves.iter().enumerate().find(|(_, curve)| curve.name == bare)?;
    Some((curve.place.unwrap_or(place), curve))
}

/// Gives measured curves the ink of the computed ones.
fn matched(panel: &Panel, computed: &[Panel]) -> Panel {
    let mut panel = panel.clone();
    let places: Vec<Option<usize>> = panel
        .curves
        .iter()
        .map(|curve| computed_of(&curve.name, &panel, computed).map(|(place, _)| place))
        .collect();
    for (curve, place) in panel.curves.iter_mut().zip(places) {
        curve.place = place;
    }
    panel
}

fn with_residuals(panels: &mut Vec<Panel>, computed: &[Panel], measured: &[Panel]) {
    for panel in measured {
        let residual = |curve: &Curve| {
            let (place, of) = computed_of(&curve.name, panel, computed)?;
            let points = curve.points.iter().map(|&(x, y)| (x, y - at(&of.points, x)));
            let points: Vec<(f64, f64)> = points.collect();
            // a record of another time leaves nothing to compare
            points.iter().find(|point| point.1.is_finite())?;
            let line = Curve::line(&curve.name, points);
            Some(line.looks(Look::Dots).as_place(place))
        };
        let curves: Vec<Curve> = panel.curves.iter().filter_map(residual).collect();
        let place = panels.iter().position(|other| is_same(other, panel));
        if let (Some(place), false) = (place, curves.is_empty()) {
            let unit = panel.y.unit.replace("degC", "K").replace("degF", "degR");
            let axis = Axis::linear("measured \u{2212} run", unit);
            let residuals = Panel { curves, share: RESIDUALS, ..Panel::new(panel.x.clone(), axis) };
            panels.insert(place + 1, residuals);
        }
    }
}

/// The value of a curve between its points; nothing outside of them.
fn at(points: &[(f64, f64)], x: f64) -> f64 {
    let after = points.partition_point(|point| point.0 < x);
    match (after.checked_sub(1).and_then(|before| points.get(before)), points.get(after)) {
        (_, Some(&(next, value))) if next <= x => value,
        (Some(&(x0, y0)), Some(&(x1, y1))) => y0 + (y1 - y0) * (x - x0) / (x1 - x0),
        _ => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use lptn_plot::Figure;
    use lptn_plot::figure::{Axis, Curve, Level, Look, Panel};

    use super::{Source, at, overlay};

    fn source(name: &str, measured: bool, curve: Curve) -> Source {
        let mut panel = Panel::new(Axis::time(), Axis::linear("temperature", "degC"));
        panel.curves.push(curve);
        let figure = Figure { title: name.into(), note: String::new(), panels: vec![panel] };
        Source {
            name: name.into(),
            path: name.into(),
            measured,
            figure,
            doubts: Default::default(),
        }
    }

    #[test]
    fn a_value_between_points_is_on_the_line() {
        let points = [(0.0, 1.0), (2.0, 5.0)];
        assert!((at(&points, 0.5) - 2.0).abs() < 1e-12 && (at(&points, 2.0) - 5.0).abs() < 1e-12);
        assert!(at(&points, 2.1).is_nan() && at(&points, -0.1).is_nan());
    }

    #[test]
    fn what_was_measured_stands_over_the_run_with_the_differences_below() {
        let run = Curve::line("steel", vec![(0.0, 20.0), (10.0, 40.0)]);
        let record = Curve::line("steel", vec![(5.0, 33.0)]).looks(Look::Dots);
        let whole = overlay(vec![source("motor", false, run), source("tc", true, record)]);
        assert_eq!(whole.panels.len(), 2);
        let upper: Vec<_> = whole.panels[0].curves.iter().map(|c| (&*c.name, c.place)).collect();
        assert_eq!(upper, [("steel", None), ("steel", Some(0))]);
        assert_eq!(whole.panels[1].y.unit, "K");
        assert_eq!(whole.panels[1].curves[0].points, [(5.0, 3.0)]);
    }

    /// 68 degF is 20 degC, 86 degF is 30 degC; 303.15 K is 30 degC.
    #[test]
    fn a_temperature_of_any_unit_is_one_quantity() {
        let in_unit = |mut source: Source, unit: &str| {
            source.figure.panels[0].y.unit = unit.into();
            source.figure.panels[0].limits = vec![Level { name: "l".into(), value: 303.15 }];
            source
        };
        let run = source("m", false, Curve::line("a", vec![(0.0, 68.0), (10.0, 86.0)]));
        let record = source("tc", true, Curve::line("a", vec![(5.0, 303.15)]));
        let whole = overlay(vec![in_unit(record, "K"), in_unit(run, "degF")]);
        assert_eq!(whole.panels.len(), 2);
        let upper = &whole.panels[0];
        assert_eq!(upper.y.unit, "degF");
        assert!((upper.curves[1].points[0].1 - 86.0).abs() < 1e-9);
        assert!((upper.limits[1].value - 86.0).abs() < 1e-9, "{:?}", upper.limits);
        // 77 degF is in the middle of the run
        let residual = whole.panels[1].curves[0].points[0].1;
        assert!((residual - 9.0).abs() < 1e-9, "{residual}");
    }

    #[test]
    fn curves_of_several_runs_are_named_by_them() {
        let line = |y| Curve::line("steel", vec![(0.0, y)]);
        let whole =
            overlay(vec![source("small", false, line(20.0)), source("large", false, line(30.0))]);
        let names: Vec<_> = whole.panels[0].curves.iter().map(|curve| &*curve.name).collect();
        assert_eq!(names, ["small: steel", "large: steel"]);
        let air = || source("a", false, Curve::line("air", vec![(0.0, 25.0)]));
        let names = overlay(vec![air(), air()]).panels.remove(0).curves;
        assert_eq!((names.len(), names[0].name.as_str()), (1, "air"));
    }
}
