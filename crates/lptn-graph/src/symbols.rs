//! The symbols of elements.

use lptn_plot::scene::{Path, Step, Stroke, circle, line, polygon};
use lptn_plot::{Ink, Scene};

/// Half the length of a symbol between two wires.
pub(crate) const HALF: f64 = 24.0;

/// Reach of a symbol above and below its wires.
pub(crate) const REACH: f64 = 9.0;

/// Radius of a source.
pub(crate) const SOURCE: f64 = 14.0;

/// The room that a capacity takes below its node, and half its width.
pub(crate) const CAPACITY: (f64, f64) = (38.0, 13.0);

/// The width of wires.
pub(crate) const WIRE: f64 = 1.3;

/// The line of symbols and wires.
pub(crate) fn pen() -> Stroke {
    Stroke::solid(Ink::Text, WIRE)
}

/// A conductor: a zigzag around its middle.
pub(crate) fn resistor(scene: &mut Scene, (x, y): (f64, f64)) {
    const TEETH: usize = 6;
    let pitch = (2.0 * HALF - 8.0) / TEETH as f64;
    let start = x - HALF + 4.0;
    let tooth = |i: usize| {
        let side = if i.is_multiple_of(2) { -1.0 } else { 1.0 };
        (start + pitch * (i as f64 + 0.5), y + side * 7.0)
    };
    let ends = [(x - HALF, y), (start, y)];
    let back = [(x + HALF - 4.0, y), (x + HALF, y)];
    scene.put(line(ends.into_iter().chain((0..TEETH).map(tooth)).chain(back)).stroked(pen()));
}

/// Radiation: a wave around its middle.
pub(crate) fn wave(scene: &mut Scene, (x, y): (f64, f64)) {
    const WAVES: usize = 4;
    let pitch = 2.0 * HALF / WAVES as f64;
    let mut steps = vec![Step::Move(x - HALF, y)];
    for i in 0..WAVES {
        let at = x - HALF + pitch * i as f64;
        let height = 12.0;
        steps.push(Step::Curve([
            (at + pitch / 3.0, y - height),
            (at + 2.0 * pitch / 3.0, y + height),
            (at + pitch, y),
        ]));
    }
    scene.put(Path::new(steps).stroked(pen()));
}

/// A stream: a pipe with an arrow in the direction of the flow.
pub(crate) fn stream(scene: &mut Scene, (x, y): (f64, f64), to_the_right: bool) {
    let sign = if to_the_right { 1.0 } else { -1.0 };
    for side in [-7.0, 7.0] {
        scene.put(line([(x - HALF, y + side), (x + HALF, y + side)]).stroked(pen()));
    }
    arrow(scene, [(x - sign * HALF, y), (x + sign * HALF, y)], (Ink::Text, 2.0));
}

/// Heat put in: a circle with an arrow.
pub(crate) fn source(scene: &mut Scene, (x, y): (f64, f64)) {
    scene.put(circle((x, y), SOURCE).filled(Ink::Paper, 1.0).stroked(pen()));
    arrow(scene, [(x - 9.0, y), (x + 9.0, y)], (Ink::Text, 1.6));
}

/// A straight arrow from one point to another on its level.
pub(crate) fn arrow(scene: &mut Scene, [from, to]: [(f64, f64); 2], (ink, width): (Ink, f64)) {
    let sign = if to.0 > from.0 { 1.0 } else { -1.0 };
    let (long, half) = (5.0 + 1.2 * width, 2.5 + 0.75 * width);
    let neck = to.0 - sign * long;
    scene.put(line([from, (neck, to.1)]).stroked(Stroke::solid(ink, width)));
    let head = [to, (neck, to.1 - half), (neck, to.1 + half)];
    scene.put(polygon(head).filled(ink, 1.0));
}

/// A capacity below a point, to ground.
pub(crate) fn capacity(scene: &mut Scene, (x, y): (f64, f64)) {
    let plate = CAPACITY.1;
    scene.put(line([(x, y), (x, y + 11.0)]).stroked(pen()));
    for level in [11.0, 17.0] {
        let plate = line([(x - plate, y + level), (x + plate, y + level)]);
        scene.put(plate.stroked(Stroke::solid(Ink::Text, 2.0)));
    }
    scene.put(line([(x, y + 17.0), (x, y + 27.0)]).stroked(pen()));
    for (i, half) in [9.0, 6.0, 3.0].into_iter().enumerate() {
        let level = y + 27.0 + 4.0 * i as f64;
        scene.put(line([(x - half, level), (x + half, level)]).stroked(pen()));
    }
}

/// Below this line nothing changes: hatching from one x to another.
pub(crate) fn hatching(scene: &mut Scene, [from, to]: [f64; 2], y: f64) {
    scene.put(line([(from, y), (to, y)]).stroked(Stroke::solid(Ink::Text, 2.4)));
    let count = ((to - from) / 8.0).floor() as usize;
    for i in 0..count {
        let x = from + 7.0 + 8.0 * i as f64;
        scene.put(line([(x, y), (x - 6.0, y + 6.0)]).stroked(Stroke::solid(Ink::Text, 1.0)));
    }
}

/// Radius of the mark of a curve.
pub(crate) const MARK: f64 = 4.5;

/// The mark of a node or boundary: the ink of its curve over time.
pub(crate) fn mark(scene: &mut Scene, at: (f64, f64), series: usize) {
    let outline = Stroke::solid(Ink::Paper, 1.5);
    scene.put(circle(at, MARK).filled(Ink::Series(series), 1.0).stroked(outline));
}
