//! The legend below a diagram: the scale of its temperatures, its controls.

use lptn_plot::font::width;
use lptn_plot::scene::{Align, Stroke, Text, line, rectangle};
use lptn_plot::{FIELD, Ink, Scene};

use crate::model::{Diagram, Target};
use crate::symbols;

/// Room that a legend takes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Size {
    pub(crate) width: f64,
    pub(crate) height: f64,
}

/// The colours of a scale, side by side.
pub(crate) const BAR: (f64, f64) = (8.0 * FIELD as f64, 12.0);

/// The height of that with its texts.
const SCALE: f64 = BAR.1 + 2.0 * LINE + 6.0;

const SIZE: f64 = 12.0;
const LINE: f64 = 18.0;

/// Between the diagram and its legend.
pub(crate) const GAP: f64 = 22.0;

/// The size of the legend below a diagram.
pub(crate) fn legend(diagram: &Diagram) -> Size {
    let lines = lines(diagram);
    let widest = lines.iter().map(|text| width(text, SIZE, false)).fold(0.0, f64::max);
    let scale = diagram.scales.as_ref().map_or(Size::default(), |s| scale_size(&s.caption));
    let gap = if scale.height == 0.0 && !lines.is_empty() { GAP } else { 0.0 };
    let height = gap + scale.height + LINE * lines.len() as f64;
    Size { width: widest.max(scale.width), height }
}

/// The room for a scale and its caption below a drawing.
pub(crate) fn scale_size(caption: &str) -> Size {
    Size { width: width(caption, SIZE, false).max(BAR.0), height: GAP + SCALE }
}

/// A line for each control, with the names of the paths and sources that it switches.
fn lines(diagram: &Diagram) -> Vec<String> {
    let target = |target: &Target| match target {
        Target::Link(i) => diagram.links[*i].name.clone(),
        Target::Source(i) => diagram.sources[*i].name.clone(),
    };
    let controls = diagram.controls.iter().map(|control| {
        let switched: Vec<String> = control.switches.iter().map(target).collect();
        let does = if switched.is_empty() {
            String::new()
        } else {
            format!(" switches {}", switched.join(", "))
        };
        let sense = &diagram.places[control.sense].name;
        format!("control {}{does}: {}, sensed at {sense}", control.name, control.rule)
    });
    controls.collect()
}

/// Draws it from its upper left corner.
pub(crate) fn draw(scene: &mut Scene, diagram: &Diagram, (x, y): (f64, f64)) {
    let mut y = y + GAP;
    if let Some(scales) = &diagram.scales {
        scale(scene, (&scales.ends, &scales.ticks), &scales.caption, (x, y));
        y += SCALE;
    }
    for text in lines(diagram) {
        y += LINE;
        scene.write(Text::new(text, (x, y - 5.0), SIZE, Ink::Faint));
    }
}

/// Room between two texts of a scale, in pixels.
const BESIDE: f64 = 10.0;

/// A mark of a scale: its share of the way from the coldest to the hottest, and its number.
pub(crate) type Tick = (f64, String);

/// A bar of colours with the temperatures at its ends and marks, and a line of text below.
pub(crate) fn scale(
    scene: &mut Scene,
    (ends, ticks): (&[String; 2], &[Tick]),
    caption: &str,
    (x, y): (f64, f64),
) {
    let step = BAR.0 / FIELD as f64;
    for i in 0..FIELD {
        // a little wider, so that no paper shows between them
        let over = if i + 1 < FIELD { 0.5 } else { 0.0 };
        let part = rectangle((x + step * i as f64, y), (step + over, BAR.1), 0.0);
        scene.put(part.filled(Ink::Field(i), 1.0));
    }
    scene.put(rectangle((x, y), BAR, 0.0).stroked(Stroke::solid(Ink::Frame, 1.0)));
    for (text, at, align) in [(&ends[0], x, Align::Start), (&ends[1], x + BAR.0, Align::End)] {
        let text = Text::new(text.clone(), (at, y + BAR.1 + LINE - 3.0), SIZE, Ink::Text);
        scene.write(text.aligned(align));
    }
    let wide = |text: &str| width(text, SIZE, false) + BESIDE;
    let (mut free, end) = (x + wide(&ends[0]), x + BAR.0 - wide(&ends[1]));
    for (share, text) in ticks {
        let at = x + share * BAR.0;
        let half = wide(text) / 2.0;
        if at - half < free || at + half > end {
            continue;
        }
        free = at + half;
        scene.put(line([(at, y + BAR.1), (at, y + BAR.1 + 3.0)]).stroked(symbols::pen()));
        let text = Text::new(text, (at, y + BAR.1 + LINE - 3.0), SIZE, Ink::Faint);
        scene.write(text.aligned(Align::Middle));
    }
    let below = (x, y + BAR.1 + 2.0 * LINE - 1.0);
    scene.write(Text::new(caption, below, SIZE, Ink::Faint));
}
