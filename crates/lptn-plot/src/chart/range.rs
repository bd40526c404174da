//! Ranges of axes.
//!
//! Limits, boundaries such as empty space, and single measured values may be so far away that the
//! curves would be flat. They do not set the scale then, and the picture names them.

use crate::figure::{Curve, Level, Look, Panel, Scale};

/// Limits and curves farther away than this share of the range of the other curves are not shown.
const FAR: f64 = 1.5;

/// Dots farther away than this share of the range of their inner 98 % do not set the scale.
const OUTLYING: f64 = 3.0;

/// Fewer dots have no outliers.
const FEWEST: usize = 50;

/// Room above and below the curves, as a share of their range.
const AIR: f64 = 0.05;

type Range = (f64, f64);

const NOTHING: Range = (f64::INFINITY, f64::NEG_INFINITY);

fn with((low, high): Range, value: f64) -> Range {
    if value.is_finite() { (low.min(value), high.max(value)) } else { (low, high) }
}

/// The range, or one up to 1 if it is empty.
fn some((low, high): Range, logarithmic: bool) -> Range {
    let lowest = if logarithmic { 0.1 } else { 0.0 };
    if low <= high { (low, high) } else { (lowest, 1.0) }
}

/// The horizontal range of panels that share it.
pub(crate) fn across<'a>(panels: impl Iterator<Item = &'a Panel>) -> Range {
    let (mut range, mut scale, mut dotted) = (NOTHING, &Scale::Linear, false);
    for panel in panels {
        scale = &panel.x.scale;
        dotted |= panel.curves.iter().any(|curve| matches!(curve.look, Look::Dots | Look::Stems));
        let points = panel.curves.iter().flat_map(|curve| &curve.points);
        let moments = panel.moments.iter().map(|moment| moment.at);
        let bars = panel.curves.iter().filter(|curve| curve.look == Look::Bars);
        let bars = bars.flat_map(|curve| &curve.spread).flat_map(|&(low, high)| [low, high]);
        let all = points.map(|point| point.0).chain(moments).chain(bars);
        range = all.filter(|x| scale.shows(*x)).fold(range, with);
    }
    let range = some(range, *scale == Scale::Log);
    // a dot on the edge would be cut in two; a time axis begins with its record
    if dotted && *scale != Scale::Time { aired(range, scale) } else { range }
}

/// A range with room at its ends.
fn aired((low, high): Range, scale: &Scale) -> Range {
    if *scale == Scale::Log {
        let air = (high / low).powf(AIR);
        return (low / air, high * air);
    }
    let air = AIR * (high - low);
    (low - air, high + air)
}

/// The vertical range.
pub(crate) fn upward(panel: &Panel) -> Range {
    let curves = of_curves(panel);
    let range = panel.limits.iter().filter(|limit| is_near(limit.value, curves));
    let logarithmic = panel.y.scale == Scale::Log;
    let all = range.fold(curves, |range, limit| with(range, limit.value));
    aired(some(all, logarithmic), &panel.y.scale)
}

/// The range of the curves that set the scale.
fn of_curves(panel: &Panel) -> Range {
    let joined = |a: Range, b: Range| (a.0.min(b.0), a.1.max(b.1));
    let range = |aside: bool| {
        let curves = panel.curves.iter().filter(move |curve| curve.aside == aside);
        curves.map(|curve| of_curve(panel, curve))
    };
    let main = range(false).fold(NOTHING, joined);
    let near = |range: &Range| is_near(range.0, main) && is_near(range.1, main);
    range(true).filter(near).fold(main, joined)
}

/// The range of a curve without its outliers.
fn of_curve(panel: &Panel, curve: &Curve) -> Range {
    let spread = curve.spread.iter().flat_map(|&(low, high)| [low, high]);
    let all = curve.points.iter().map(|point| point.1).chain(spread);
    // stems start at zero
    let foot = (curve.look == Look::Stems).then_some(0.0);
    let range = all.chain(foot).filter(|y| panel.y.scale.shows(*y)).fold(NOTHING, with);
    let Some((low, high)) = usual(panel, curve) else { return range };
    (range.0.max(low), range.1.min(high))
}

/// The range outside of which dots are outliers; `None` if there is none.
fn usual(panel: &Panel, curve: &Curve) -> Option<Range> {
    if curve.look != Look::Dots || panel.y.scale != Scale::Linear || curve.points.len() < FEWEST {
        return None;
    }
    let mut values: Vec<f64> =
        curve.points.iter().map(|point| point.1).filter(|y| y.is_finite()).collect();
    values.sort_unstable_by(f64::total_cmp);
    let last = values.len().checked_sub(1)?;
    let (low, high) = (values[last / 100], values[last - last / 100]);
    let reach = OUTLYING * (high - low).max(1e-3 * high.abs().max(low.abs()));
    let inside = |y: f64| y >= low - reach && y <= high + reach;
    let (least, most) =
        (values.iter().find(|y| inside(**y))?, values.iter().rfind(|y| inside(**y))?);
    (*least > values[0] || *most < values[last]).then_some((*least, *most))
}

/// True if a curve is too far away from the others to be shown.
pub fn is_far(panel: &Panel, curve: &Curve) -> bool {
    if !curve.aside {
        return false;
    }
    let (range, shown) = (of_curve(panel, curve), of_curves(panel));
    range.0 < shown.0 || range.1 > shown.1
}

/// The dots of a curve that are outside of the range shown, and the farthest of their values.
pub(super) fn outliers(panel: &Panel, curve: &Curve) -> Option<(usize, f64)> {
    let (low, high) = usual(panel, curve)?;
    let beyond = |y: f64| (low - y).max(y - high);
    let values = || curve.points.iter().map(|point| point.1).filter(|y| beyond(*y) > 0.0);
    let farthest = values().max_by(|a, b| beyond(*a).total_cmp(&beyond(*b)))?;
    Some((values().count(), farthest))
}

/// True if a limit can be shown without flattening the curves, or if there are no curves.
fn is_near(limit: f64, (low, high): Range) -> bool {
    let span = (high - low).max(1e-3 * high.abs());
    low > high || (limit >= low - FAR * span && limit <= high + FAR * span)
}

/// Limits that are too far away from the curves to be shown.
pub(super) fn far(panel: &Panel) -> impl Iterator<Item = &Level> {
    let curves = of_curves(panel);
    panel.limits.iter().filter(move |limit| !is_near(limit.value, curves))
}

/// Limits that are shown.
pub(super) fn near(panel: &Panel) -> impl Iterator<Item = &Level> {
    let curves = of_curves(panel);
    panel.limits.iter().filter(move |limit| is_near(limit.value, curves))
}
