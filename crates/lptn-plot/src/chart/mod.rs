//! Lays out a figure as a drawing.

mod area;
mod curves;
mod frame;
mod labels;
mod range;

pub use curves::ink;
pub use frame::far;
pub(crate) use labels::apart;
pub use range::is_far;
pub(crate) use range::{across, upward};

use area::{Area, NAME, SMALL, TITLE};

use crate::figure::{Figure, Panel, Scale};
use crate::font::width;
use crate::ink::Ink;
use crate::scene::{Scene, Text};
use crate::ticks::Ruler;

/// Largest room for the numbers and title of the vertical axis.
const WIDEST: f64 = 240.0;

/// Room around everything.
const MARGIN: f64 = 14.0;

/// Height of an ordinary panel.
const HEIGHT: f64 = 300.0;

/// Height in pixels for each number of the vertical axis.
const ROW: f64 = 38.0;

/// Largest share of the width for the names of curves, which should be whole.
const NAMES: f64 = 0.45;

/// Least share of its usual height that a panel keeps in a low picture.
const LEAST: f64 = 0.25;

/// Size and arrangement of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Width in CSS pixels.
    pub width: f64,
    /// Height in CSS pixels; `None` for one that follows from the panels.
    pub height: Option<f64>,
    /// Number of figures next to each other; of one figure, its panels.
    pub columns: usize,
}

/// A layout with the height of its panels over the usual one.
#[derive(Clone, Copy)]
struct Sizes {
    width: f64,
    columns: usize,
    stretch: f64,
}

/// Figures below each other as a drawing of this width in pixels; its height follows from the
/// panels.
pub fn scene(figures: &[Figure], width: f64) -> Scene {
    arranged(figures, &Layout { width, height: None, columns: 1 })
}

/// Figures as a drawing of this size. If the height is too small, the drawing is higher.
pub fn arranged(figures: &[Figure], layout: &Layout) -> Scene {
    let &Layout { width, columns, height } = layout;
    let usual = Sizes { width, columns: columns.max(1), stretch: 1.0 };
    let scene = at_sizes(figures, usual);
    let Some(height) = height else { return scene };
    // heights are linear in the stretch
    let half = at_sizes(figures, Sizes { stretch: 0.5, ..usual });
    let of_panels = 2.0 * (scene.size.1 - half.size.1);
    if of_panels <= 0.0 {
        return scene;
    }
    let stretch = 1.0 + (height - scene.size.1) / of_panels;
    at_sizes(figures, Sizes { stretch: stretch.max(LEAST), ..usual })
}

fn at_sizes(figures: &[Figure], sizes: Sizes) -> Scene {
    let title = figures.first().map_or("", |figure| figure.title.as_str());
    let mut shapes = Scene::new((sizes.width, 0.0), title);
    let top = match figures {
        [one] if sizes.columns > 1 => {
            let top = header(one, (0.0, sizes.width), &mut shapes);
            let alone = |panel: &Panel| Figure { panels: vec![panel.clone()], ..Figure::default() };
            let panels: Vec<Figure> = one.panels.iter().map(alone).collect();
            side_by_side(&panels, top - MARGIN, sizes, &mut shapes)
        }
        figures => side_by_side(figures, 0.0, sizes, &mut shapes),
    };
    let mut scene = Scene::new((sizes.width, top + MARGIN / 2.0), title);
    scene.shapes.extend(shapes.shapes.into_iter().skip(1));
    scene
}

/// Draws figures in rows of columns from `top` on, and returns the y of their end in pixels.
fn side_by_side(figures: &[Figure], top: f64, sizes: Sizes, scene: &mut Scene) -> f64 {
    let width = sizes.width / sizes.columns as f64;
    figures.chunks(sizes.columns).fold(top, |top, row| {
        let mut bottom = top;
        for (i, figure) in row.iter().enumerate() {
            let mut part = Scene::new((width, 0.0), "");
            bottom = draw(figure, (top, width, sizes.stretch), &mut part).max(bottom);
            scene.add(part, (i as f64 * width, 0.0));
        }
        bottom
    })
}

/// Draws a figure from `top` on and returns the y of its end, in pixels.
fn draw(figure: &Figure, (top, width, stretch): (f64, f64, f64), scene: &mut Scene) -> f64 {
    let mut top = header(figure, (top, width), scene);
    let margins = (left_margin(figure), right_margin(figure, width));
    for (i, panel) in figure.panels.iter().enumerate() {
        let shared = figure.panels.get(i + 1).is_some_and(|next| next.x == panel.x);
        let begin = top + frame::room_above(panel);
        let vertical = (begin, begin + panel_height(panel, stretch));
        let area = area(figure, panel, (margins.0, width - margins.1), vertical);
        frame::draw(scene, panel, &area, shared);
        frame::marks(scene, panel, &area);
        curves::draw(scene, panel, &area);
        labels::draw(scene, panel, &area, width - MARGIN);
        top = area.bottom + if shared { MARGIN } else { frame::ROOM_BELOW };
    }
    top
}

/// The horizontal and the vertical range of a panel of a figure.
pub fn ranges(figure: &Figure, panel: &Panel) -> [(f64, f64); 2] {
    let sharing = figure.panels.iter().filter(|other| other.x == panel.x);
    let across = range::across(sharing);
    // a range of one value is widened as for the picture
    let opened = |axis, range| Ruler::new(axis, range, 2.0, false).range;
    [opened(&panel.x, across), opened(&panel.y, range::upward(panel))]
}

fn panel_height(panel: &Panel, stretch: f64) -> f64 {
    match &panel.y.scale {
        Scale::Names(names) => 22.0 * names.len() as f64 + 10.0,
        _ => HEIGHT * panel.share * stretch,
    }
}

fn area(
    figure: &Figure,
    panel: &Panel,
    (left, right): (f64, f64),
    (top, bottom): (f64, f64),
) -> Area {
    let sharing = figure.panels.iter().filter(|other| other.x == panel.x);
    let across = range::across(sharing);
    let x = Ruler::new(&panel.x, across, (right - left) / 80.0, false);
    let y = Ruler::new(&panel.y, range::upward(panel), (bottom - top) / ROW, false);
    let downward = matches!(panel.y.scale, Scale::Names(_));
    Area { left, right, top, bottom, x, y, downward }
}

/// Draws title and note and returns the y at which the panels begin, in pixels.
fn header(figure: &Figure, (top, page): (f64, f64), scene: &mut Scene) -> f64 {
    let mut top = top + MARGIN;
    let room = page - 2.0 * MARGIN;
    for line in wrapped(&figure.title, TITLE, room, true) {
        top += TITLE + 2.0;
        scene.write(Text::new(line, (MARGIN, top), TITLE, Ink::Text).bold());
    }
    for line in figure.note.lines().flat_map(|line| wrapped(line, SMALL, room, false)) {
        top += SMALL + 5.0;
        scene.write(Text::new(line, (MARGIN, top), SMALL, Ink::Faint));
    }
    top + MARGIN
}

/// A text in lines that are not wider than `room`, except for longer words.
fn wrapped(text: &str, size: f64, room: f64, bold: bool) -> Vec<String> {
    in_lines(text, |line| width(line, size, bold) <= room)
}

/// A text in lines that fit, except for longer words.
pub(crate) fn in_lines(text: &str, fits: impl Fn(&str) -> bool) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if fits(&format!("{line} {word}")) => *line = format!("{line} {word}"),
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

fn left_margin(figure: &Figure) -> f64 {
    let numbers = |panel: &Panel| {
        let ruler =
            Ruler::new(&panel.y, range::upward(panel), panel_height(panel, 1.0) / ROW, false);
        let is_list = matches!(panel.y.scale, Scale::Names(_));
        let size = if is_list { NAME } else { SMALL };
        let widths = ruler.ticks.iter().map(|(_, text)| width(text, size, false));
        widths.fold(0.0, f64::max) + if ruler.title.is_empty() { 0.0 } else { NAME + 8.0 }
    };
    MARGIN + 9.0 + figure.panels.iter().map(numbers).fold(0.0, f64::max).min(WIDEST)
}

fn right_margin(figure: &Figure, page: f64) -> f64 {
    let names = figure.panels.iter().flat_map(|panel| &panel.curves);
    let widest = names.map(|curve| width(&curve.name, NAME, false)).fold(0.0, f64::max);
    let room = if widest > 0.0 { labels::GAP } else { 0.0 };
    MARGIN + (widest + room).min(NAMES * page)
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
