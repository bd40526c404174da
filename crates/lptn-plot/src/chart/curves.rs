//! Lines, dots, bands and bars of a panel.

use super::area::Area;
use super::range;
use crate::figure::{Curve, Look, Panel, Scale};
use crate::ink::{Ink, SERIES};
use crate::scene::{Dash, Path, Scene, Step, Stroke, circle, line, polygon, rectangle};
use crate::thin::thinned;

/// Width of a curve, one among few and one among many of the same name.
const LINES: [f64; 2] = [1.8, 0.7];

/// More curves of the same name than this are many.
const FEW: usize = 20;

/// Height of a bar across.
const BAR: f64 = 13.0;

/// Radius of a dot, one among few and one among many.
const DOTS: [f64; 2] = [3.0, 1.5];

/// More dots than this are thinned even if they are not over time.
const MOST_DOTS: usize = 10_000;

/// Width in pixels of the stretches in which very many dots are thinned.
const PER_DOT: f64 = 3.0;

/// The ink of the curve at a place of a panel.
pub fn ink(curve: &Curve, place: usize) -> Ink {
    Ink::Series(curve.place.unwrap_or(place))
}

/// Draws the curves of a panel with their bands and bars.
pub(super) fn draw(scene: &mut Scene, panel: &Panel, area: &Area) {
    let shown = |(_, curve): &(usize, &Curve)| !range::is_far(panel, curve);
    for (place, curve) in panel.curves.iter().enumerate().filter(shown) {
        let ink = ink(curve, place);
        spread(scene, curve, (panel, area), ink);
        // dashes distinguish the second round of colours
        let second = curve.place.unwrap_or(place) >= SERIES;
        let dash = if second || curve.look == Look::Dashed { Dash::Dashed } else { Dash::Solid };
        let stroke = Stroke { ink, width: width(panel, curve), dash };
        match curve.look {
            Look::Line | Look::Dashed => lines(scene, curve, (panel, area), stroke),
            Look::Dots => dots(scene, curve, (panel, area), ink),
            Look::Stems => stems(scene, curve, (panel, area), ink),
            Look::Bars => across(scene, curve, (panel, area), ink),
        }
    }
}

/// Lines of one kind are thin if they are many.
fn width(panel: &Panel, curve: &Curve) -> f64 {
    let alike =
        panel.curves.iter().filter(|other| other.name == curve.name && !curve.name.is_empty());
    LINES[usize::from(alike.count() > FEW)]
}

type Place<'a> = (&'a Panel, &'a Area);

fn on_page((panel, area): Place<'_>, (x, y): (f64, f64)) -> Option<(f64, f64)> {
    panel.shows((x, y)).then(|| (area.x_at(x), area.y_at(y)))
}

/// The points of a curve on the page, thinned to this number of stretches if they are in order;
/// gaps are not finite.
fn placed(points: &[(f64, f64)], place: Place<'_>, stretches: usize) -> Vec<(f64, f64)> {
    let gap = |(x, _): (f64, f64)| (if x.is_finite() { place.1.x_at(x) } else { x }, f64::NAN);
    let on_page: Vec<_> =
        points.iter().map(|&point| on_page(place, point).unwrap_or_else(|| gap(point))).collect();
    let in_order = on_page.windows(2).all(|pair| pair[0].0 <= pair[1].0);
    if in_order { thinned(&on_page, stretches) } else { on_page }
}

fn lines(scene: &mut Scene, curve: &Curve, place: Place<'_>, stroke: Stroke) {
    let points = placed(&curve.points, place, place.1.width() as usize);
    let pieces = points.split(|point| !point.1.is_finite());
    let mut steps: Vec<Step> = Vec::new();
    for piece in pieces.filter(|piece| !piece.is_empty()) {
        steps.extend(line(piece.iter().copied()).steps);
    }
    if !steps.is_empty() {
        let tip = curve.tips.first().unwrap_or(&curve.name);
        scene.put(Path::new(steps).stroked(stroke).tipped(tip));
    }
}

/// Draws dots. Those outside of the range are triangles at its edge. If there are very many over
/// time, outliers stay; those of a scatter are all there.
fn dots(scene: &mut Scene, curve: &Curve, place: Place<'_>, ink: Ink) {
    let stretches = (place.1.width() / PER_DOT) as usize;
    let thins = place.0.x.scale == Scale::Time || curve.points.len() > MOST_DOTS;
    let most = if thins { stretches } else { curve.points.len() };
    let radius = DOTS[usize::from(curve.points.len() > stretches / 3)];
    if !curve.tips.is_empty() {
        let dots = curve.points.iter().zip(&curve.tips);
        for (at, tip) in dots.filter_map(|(point, tip)| Some((on_page(place, *point)?, tip))) {
            scene.put(circle(at, radius).filled(ink, 1.0).tipped(tip));
        }
        return;
    }
    let shown = placed(&curve.points, place, most).into_iter().filter(|at| at.1.is_finite());
    let steps = |(x, y): (f64, f64)| match place.1.edge(y) {
        None => circle((x, y), radius).steps,
        Some((edge, up)) => triangle((x, edge), if up { DOTS[0] } else { -DOTS[0] }).steps,
    };
    let steps: Vec<Step> = shown.flat_map(steps).collect();
    if !steps.is_empty() {
        scene.put(Path::new(steps).filled(ink, 1.0).tipped(&curve.name));
    }
}

/// A triangle that points up from its base by twice its half width, or down if that is negative.
fn triangle((x, y): (f64, f64), half: f64) -> Path {
    polygon([(x - half, y + 2.0 * half), (x + half, y + 2.0 * half), (x, y)])
}

fn stems(scene: &mut Scene, curve: &Curve, place: Place<'_>, ink: Ink) {
    let foot = if place.0.y.scale == Scale::Log { place.1.y.range.0 } else { 0.0 };
    for &(x, y) in &curve.points {
        if let (Some(top), Some(foot)) = (on_page(place, (x, y)), on_page(place, (x, foot))) {
            scene.put(line([foot, top]).stroked(Stroke::solid(ink, LINES[0])));
            scene.put(circle(top, DOTS[0]).filled(ink, 1.0));
        }
    }
}

/// Draws bars across, each in the row of its point.
fn across(scene: &mut Scene, curve: &Curve, (panel, area): Place<'_>, ink: Ink) {
    for (i, (&(_, row), &(low, high))) in curve.points.iter().zip(&curve.spread).enumerate() {
        if let (true, true) = (panel.shows((low, row)), panel.shows((high, row))) {
            let (from, to, y) = (area.x_at(low), area.x_at(high), area.y_at(row));
            let bar = rectangle((from, y - BAR / 2.0), (to - from, BAR), 0.0).filled(ink, 1.0);
            scene.put(bar.tipped(curve.tips.get(i).unwrap_or(&curve.name)));
        }
    }
}

fn spread(scene: &mut Scene, curve: &Curve, place: Place<'_>, ink: Ink) {
    if curve.spread.is_empty() || curve.look == Look::Bars {
        return;
    }
    let side = |of: fn(&(f64, f64)) -> f64| -> Vec<(f64, f64)> {
        let points = curve.points.iter().zip(&curve.spread);
        points.map(|(point, spread)| (point.0, of(spread))).collect()
    };
    let (low, high) = (side(|spread| spread.0), side(|spread| spread.1));
    if curve.look == Look::Dots || curve.look == Look::Stems {
        return bars(scene, (&low, &high), place, ink);
    }
    let finite = |points: Vec<(f64, f64)>| points.into_iter().filter(|point| point.1.is_finite());
    let pixels = place.1.width() as usize;
    let upper = finite(placed(&high, place, pixels));
    let lower: Vec<_> = finite(placed(&low, place, pixels)).collect();
    scene.put(polygon(upper.chain(lower.into_iter().rev())).filled(ink, 0.18));
}

type Points<'a> = &'a [(f64, f64)];

fn bars(scene: &mut Scene, (low, high): (Points<'_>, Points<'_>), place: Place<'_>, ink: Ink) {
    let cap = 3.0;
    for (&low, &high) in low.iter().zip(high) {
        let (Some(a), Some(b)) = (on_page(place, low), on_page(place, high)) else { continue };
        let mut steps = line([a, b]).steps;
        for (x, y) in [a, b] {
            steps.extend([Step::Move(x - cap, y), Step::Line(x + cap, y)]);
        }
        scene.put(Path::new(steps).stroked(Stroke::solid(ink, 1.2)));
    }
}
