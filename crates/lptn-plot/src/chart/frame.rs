//! Axes, grid lines, limits and moments of a panel.

use super::area::{Area, NAME, SMALL, shortened};
use super::range;
use crate::figure::{Curve, Level, Panel, Scale};
use crate::font::width;
use crate::ink::Ink;
use crate::scene::{Align, Dash, Scene, Stroke, Text, line};
use crate::ticks::{printed, short};

/// Room for the numbers and the title of the horizontal axis.
pub(super) const ROOM_BELOW: f64 = 46.0;

/// Largest number of lines for limits, and for curves, that are too far away to be shown.
const FAR: usize = 3;

/// Smallest distance between the names of two moments.
const APART: f64 = 14.0;

/// Room above a panel for the texts on limits that are too far away to be shown.
pub(super) fn room_above(panel: &Panel) -> f64 {
    far(panel).len() as f64 * (SMALL + 4.0)
}

/// Grid, axes and their numbers. If the panel below shares the horizontal axis, that panel writes
/// its numbers.
pub(super) fn draw(scene: &mut Scene, panel: &Panel, area: &Area, shared: bool) {
    let grid = Stroke::solid(Ink::Grid, 1.0);
    let is_list = matches!(panel.y.scale, Scale::Names(_));
    for (value, text) in &area.y.ticks {
        let y = area.y_at(*value);
        scene.put(line([(area.left, y), (area.right, y)]).stroked(grid));
        let size = if is_list { NAME } else { SMALL };
        let text = shortened(text, size, area.left - 7.0);
        let text = Text::new(text, (area.left - 7.0, y + 0.36 * size), size, Ink::Faint);
        scene.write(text.aligned(Align::End));
    }
    for (value, text) in &area.x.ticks {
        let x = area.x_at(*value);
        scene.put(line([(x, area.top), (x, area.bottom)]).stroked(grid));
        for (line, below) in text.lines().zip(1..).filter(|_| !shared) {
            let y = area.bottom + f64::from(below) * (SMALL + 2.0) + 3.0;
            scene.write(Text::new(line, (x, y), SMALL, Ink::Faint).aligned(Align::Middle));
        }
    }
    axes(scene, area);
    titles(scene, area, shared);
}

fn axes(scene: &mut Scene, area: &Area) {
    let frame = Stroke::solid(Ink::Frame, 1.0);
    let corner = [(area.left, area.top), (area.left, area.bottom), (area.right, area.bottom)];
    scene.put(line(corner).stroked(frame));
}

fn titles(scene: &mut Scene, area: &Area, shared: bool) {
    let middle = f64::midpoint(area.top, area.bottom);
    let title = shortened(&area.y.title, NAME, area.bottom - area.top + 2.0 * NAME);
    let upward = Text::new(title, (NAME + 8.0, middle), NAME, Ink::Text);
    scene.write(upward.aligned(Align::Middle).upward());
    if !shared {
        let middle = f64::midpoint(area.left, area.right);
        let right = Text::new(&area.x.title, (middle, area.bottom + 36.0), NAME, Ink::Text);
        scene.write(right.aligned(Align::Middle));
    }
}

/// Limits and moments, over the curves.
pub(super) fn marks(scene: &mut Scene, panel: &Panel, area: &Area) {
    let mut named: Vec<(f64, Vec<&str>)> = Vec::new();
    for limit in range::near(panel) {
        let y = area.y_at(limit.value);
        let stroke = Stroke { ink: Ink::Limit, width: 1.3, dash: Dash::Dashed };
        scene.put(line([(area.left, y), (area.right, y)]).stroked(stroke).tipped(&limit.name));
        let below = y - area.top < SMALL + 4.0;
        let y = if below { y + SMALL + 2.0 } else { y - 4.0 };
        match named.iter_mut().find(|(at, _)| (at - y).abs() < SMALL) {
            Some((_, names)) => names.push(&limit.name),
            None => named.push((y, vec![&limit.name])),
        }
    }
    for (y, names) in named {
        scene.write(Text::new(together(&names), (area.left + 6.0, y), SMALL, Ink::Limit));
    }
    let limits = beyond_limits(panel).len();
    for (i, text) in far(panel).into_iter().enumerate() {
        let y = area.top - 5.0 - i as f64 * (SMALL + 4.0);
        let ink = if i < limits { Ink::Limit } else { Ink::Faint };
        let text = shortened(&text, SMALL, scene.size.0 - area.left - 20.0);
        scene.write(Text::new(text, (area.left + 6.0, y), SMALL, ink));
    }
    moments(scene, panel, area);
}

/// One text for limits whose names would cover each other.
fn together(names: &[&str]) -> String {
    match names {
        [one, other] => format!("{one}; {other}"),
        [first, _, _, ..] => format!("{first}; {} more", names.len() - 1),
        _ => names.concat(),
    }
}

/// Texts on limits, curves and dots that are too far away to be shown, limits first.
pub fn far(panel: &Panel) -> Vec<String> {
    let curves = at_most(FAR, beyond_curves(panel), "curves");
    beyond_limits(panel).into_iter().chain(curves).collect()
}

fn beyond_limits(panel: &Panel) -> Vec<String> {
    let text = |limit: &Level| format!("{}, {}", limit.name, way(panel, limit.value));
    at_most(FAR, range::far(panel).map(text).collect(), "limits")
}

fn beyond_curves(panel: &Panel) -> Vec<String> {
    let told = |value: f64| format!("{} {}", short(value), printed(&panel.y.unit));
    let text = |curve: &Curve| {
        if range::is_far(panel, curve) {
            let end = curve.points.iter().rev().map(|point| point.1).find(|y| y.is_finite())?;
            return Some(format!("{} at {}, {}", curve.name, told(end), way(panel, end)));
        }
        let (count, farthest) = range::outliers(panel, curve)?;
        let (all, name) = (curve.points.len(), &curve.name);
        let what = format!("dots of {name} outside of the range shown: {count} of {all}");
        Some(format!("{what}, the farthest at {}", told(farthest)))
    };
    panel.curves.iter().filter_map(text).collect()
}

/// The direction of a value that is not shown.
fn way(panel: &Panel, value: f64) -> &'static str {
    let (low, high) = range::upward(panel);
    match value > f64::midpoint(low, high) {
        true => "above the range shown",
        false => "below the range shown",
    }
}

fn at_most(most: usize, mut texts: Vec<String>, what: &str) -> Vec<String> {
    if texts.len() > most {
        let more = texts.len() - most + 1;
        texts.truncate(most - 1);
        texts.push(format!("and {more} more {what} beyond the range shown"));
    }
    texts
}

fn moments(scene: &mut Scene, panel: &Panel, area: &Area) {
    let mut last = f64::NEG_INFINITY;
    for moment in &panel.moments {
        let x = area.x_at(moment.at);
        let stroke = Stroke { ink: Ink::Frame, width: 1.0, dash: Dash::Dotted };
        let path = line([(x, area.top), (x, area.bottom)]).stroked(stroke);
        scene.put(path.tipped(&moment.name));
        let fits = !moment.name.is_empty()
            && width(&moment.name, SMALL, false) < area.bottom - area.top - 8.0;
        if x - last < APART || !fits {
            continue;
        }
        last = x;
        // left of the line, but right of it close to the axis
        let x = if x - area.left < APART { x + SMALL } else { x - 4.0 };
        let text = Text::new(&moment.name, (x, area.bottom - 6.0), SMALL, Ink::Faint);
        scene.write(text.upward());
    }
}
