//! Ranges of axes.

use crate::figure::{Look, Panel, Scale};

/// Limits farther away than this share of the range of the curves are not shown.
const FAR: f64 = 1.5;

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

fn of_curves(panel: &Panel) -> Range {
    let mut range = NOTHING;
    for curve in &panel.curves {
        let spread = curve.spread.iter().flat_map(|&(low, high)| [low, high]);
        let all = curve.points.iter().map(|point| point.1).chain(spread);
        // stems start at zero
        let foot = (curve.look == Look::Stems).then_some(0.0);
        range = all.chain(foot).filter(|y| panel.y.scale.shows(*y)).fold(range, with);
    }
    range
}

/// True if a limit can be shown without flattening the curves, or if there are no curves.
fn is_near(limit: f64, (low, high): Range) -> bool {
    let span = (high - low).max(1e-3 * high.abs());
    low > high || (limit >= low - FAR * span && limit <= high + FAR * span)
}

/// Limits that are too far away from the curves to be shown.
pub(super) fn far(panel: &Panel) -> impl Iterator<Item = &crate::figure::Level> {
    let curves = of_curves(panel);
    panel.limits.iter().filter(move |limit| !is_near(limit.value, curves))
}

/// Limits that are shown.
pub(super) fn near(panel: &Panel) -> impl Iterator<Item = &crate::figure::Level> {
    let curves = of_curves(panel);
    panel.limits.iter().filter(move |limit| is_near(limit.value, curves))
}
