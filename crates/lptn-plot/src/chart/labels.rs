//! Names at the ends of curves, which identify them without legend and colour.

use super::area::{Area, NAME, shortened};
use super::{curves, range};
use crate::figure::{Panel, Scale};
use crate::ink::Ink;
use crate::scene::{Dash, Scene, Stroke, Text, circle, line};

/// Room between a curve's end and its name.
pub(super) const GAP: f64 = 14.0;

/// Distance between two names.
const LINE: f64 = NAME + 2.0;

struct Label<'a> {
    name: &'a str,
    ink: Ink,
    /// End of the curve; `y` is the height of its name.
    end: (f64, f64),
    y: f64,
}

/// Writes the names. Those that would overlap are moved apart, with a line to their end.
pub(super) fn draw(scene: &mut Scene, panel: &Panel, area: &Area, right: f64) {
    let mut labels = ends(panel, area);
    let room = ((area.bottom - area.top + LINE) / LINE).floor().max(1.0) as usize;
    let left_out = labels.len().saturating_sub(room);
    if left_out > 0 {
        labels.truncate(room - 1);
    }
    labels.sort_by(|a, b| a.end.1.total_cmp(&b.end.1));
    // the curves of a list have no end: their names are a legend next to it
    let is_list = matches!(panel.y.scale, Scale::Names(_));
    let place = |label: &Label<'_>| if is_list { area.top } else { label.end.1 };
    let wanted: Vec<f64> = labels.iter().map(place).collect();
    let places = apart(&wanted, LINE, (area.top, area.bottom));
    for (label, y) in labels.iter_mut().zip(places) {
        label.y = y;
    }
    let x = area.right + GAP;
    for label in &labels {
        if is_list {
            scene.put(circle((x - 8.0, label.y), 3.0).filled(label.ink, 1.0));
        } else {
            connect(scene, label, (area.right, x));
        }
        let text = shortened(label.name, NAME, right - x);
        scene.write(Text::new(text, (x, label.y + 0.36 * NAME), NAME, label.ink));
    }
    if left_out > 0 {
        let text = format!("and {} more", left_out + 1);
        scene.write(Text::new(text, (x, area.bottom + 0.36 * NAME), NAME, Ink::Faint));
    }
}

fn connect(scene: &mut Scene, label: &Label<'_>, (edge, x): (f64, f64)) {
    let from = (edge.max(label.end.0) + 2.0, label.end.1);
    if edge - label.end.0 > 2.0 {
        // grey and dotted, or the curve would seem to continue
        let stroke = Stroke { ink: Ink::Frame, width: 0.7, dash: Dash::Dotted };
        scene.put(line([label.end, from]).stroked(stroke));
    }
    if (label.y - label.end.1).abs() > 2.0 {
        scene.put(line([from, (x - 3.0, label.y)]).stroked(Stroke::solid(label.ink, 0.7)));
    }
}

/// The ends of the curves that have a name; one for curves that share name and ink.
fn ends<'a>(panel: &'a Panel, area: &Area) -> Vec<Label<'a>> {
    let mut labels: Vec<Label<'a>> = Vec::new();
    for (place, curve) in panel.curves.iter().enumerate() {
        let ink = curves::ink(curve, place);
        let known = labels.iter().any(|label| label.name == curve.name && label.ink == ink);
        let last = curve.points.iter().rev().find(|point| panel.shows(**point));
        let unnamed = curve.name.is_empty() || range::is_far(panel, curve);
        if let (Some(&(x, y)), false, false) = (last, known, unnamed) {
            let end = (area.x_at(x), area.y_at(y));
            labels.push(Label { name: &curve.name, ink, end, y: end.1 });
        }
    }
    labels
}

/// Places in order, at least `distance` apart and inside a range if they fit, close to the wanted
/// ones. Neighbours that would overlap become a block around the mean of their wanted places.
pub(crate) fn apart(wanted: &[f64], distance: f64, (low, high): (f64, f64)) -> Vec<f64> {
    struct Block {
        first: f64,
        count: usize,
        sum: f64,
    }
    let mut blocks: Vec<Block> = Vec::new();
    for &want in wanted {
        let mut block = Block { first: want, count: 1, sum: want };
        while let Some(above) =
            blocks.pop_if(|above| block.first < above.first + above.count as f64 * distance)
        {
            // the wanted places, less the offsets of their names in the block
            block.sum += above.sum - block.count as f64 * above.count as f64 * distance;
            block.count += above.count;
            block.first = block.sum / block.count as f64;
        }
        let length = (block.count - 1) as f64 * distance;
        block.first = block.first.min(high - length).max(low);
        blocks.push(block);
    }
    let mut places = Vec::with_capacity(wanted.len());
    for block in blocks {
        places.extend((0..block.count).map(|i| block.first + i as f64 * distance));
    }
    // places before a block that the end of the range pushed back
    for i in (1..places.len()).rev() {
        places[i - 1] = places[i - 1].min(places[i] - distance);
    }
    places
}
