//! The sources of a place as one element: a line for each.

use lptn_plot::font::width;
use lptn_plot::scene::{Align, Text};
use lptn_plot::{Ink, Scene};
use lptn_report::shortened;

use crate::labels::{LETTERS, LINE, NAME, SMALL, VALUE, element_block};
use crate::layout::{Point, Room};
use crate::model::{Diagram, Scales, Supply};
use crate::symbols::{self, SOURCE};

/// The sources that heat one place.
pub(crate) struct Supplies<'a> {
    pub(crate) into: usize,
    sources: Vec<&'a Supply>,
}

/// Between the name of a source and its value.
const GAP: f64 = 10.0;

/// The sources of each place, in the order of the first of each.
pub(crate) fn supplies(diagram: &Diagram) -> Vec<Supplies<'_>> {
    let mut found: Vec<Supplies<'_>> = Vec::new();
    for source in &diagram.sources {
        match found.iter_mut().find(|all| all.into == source.into) {
            Some(all) => all.sources.push(source),
            None => found.push(Supplies { into: source.into, sources: vec![source] }),
        }
    }
    found
}

impl Supplies<'_> {
    /// The line above the symbol: the name of the only source, or their number.
    fn head(&self) -> String {
        match self.sources.as_slice() {
            [one] => shortened(&one.name, LETTERS),
            all => format!("{} sources", all.len()),
        }
    }

    /// The heat of several in the state that is shown, in words.
    fn sum(&self, scales: Option<&Scales>) -> Option<String> {
        let heat: Option<f64> = self.sources.iter().map(|source| source.heat).sum();
        scales.zip(heat).map(|(scales, heat)| signed(scales, heat))
    }

    /// Names and values of several, the widths of both, in pixels.
    fn lines(&self, scales: Option<&Scales>) -> (Vec<[String; 2]>, [f64; 2]) {
        let one =
            |source: &&Supply| [shortened(&source.name, LETTERS), words(source, scales).join(", ")];
        let lines: Vec<[String; 2]> = self.sources.iter().map(one).collect();
        let most = |side: usize| {
            lines.iter().map(|line| width(&line[side], SMALL, false)).fold(0.0, f64::max)
        };
        let wide = [most(0), most(1)];
        (lines, wide)
    }

    /// The room that they need.
    pub(crate) fn block(&self, scales: Option<&Scales>) -> Room {
        if let [one] = self.sources.as_slice() {
            return element_block(&self.head(), &words(one, scales), (None, SOURCE, SOURCE));
        }
        let sum = self.sum(scales);
        let room = element_block(&self.head(), sum.as_slice(), (None, SOURCE, SOURCE));
        let (lines, wide) = self.lines(scales);
        let half = (wide[0] + GAP + wide[1]) / 2.0 + 6.0;
        let below = room.below + LINE * lines.len() as f64;
        Room { half: room.half.max(half.ceil()), below, ..room }
    }

    /// Draws them around a middle.
    pub(crate) fn draw(&self, scene: &mut Scene, (x, y): Point, scales: Option<&Scales>) {
        symbols::source(scene, (x, y));
        let mut write = |text: String, at: Point, (size, ink, align): (f64, Ink, Align)| {
            scene.write(Text::new(text, at, size, ink).aligned(align));
        };
        let middle = |size: f64, ink: Ink| (size, ink, Align::Middle);
        write(self.head(), (x, y - SOURCE - 6.0), middle(NAME, Ink::Text));
        let first = y + SOURCE + LINE - 1.0;
        if let [one] = self.sources.as_slice() {
            for (i, text) in words(one, scales).into_iter().enumerate() {
                let style = if i == 0 { (VALUE, Ink::Text) } else { (SMALL, Ink::Faint) };
                write(text, (x, first + LINE * i as f64), middle(style.0, style.1));
            }
            return;
        }
        let sum = self.sum(scales);
        let start = first + LINE * f64::from(u8::from(sum.is_some()));
        sum.into_iter().for_each(|text| write(text, (x, first), middle(VALUE, Ink::Text)));
        let (lines, wide) = self.lines(scales);
        let half = (wide[0] + GAP + wide[1]) / 2.0;
        for (i, [name, value]) in lines.into_iter().enumerate() {
            let level = start + LINE * i as f64;
            write(name, (x - half, level), (SMALL, Ink::Faint, Align::Start));
            write(value, (x + half, level), (SMALL, Ink::Text, Align::End));
        }
    }
}

fn signed(scales: &Scales, heat: f64) -> String {
    let sign = if heat < 0.0 { "-" } else { "" };
    format!("{sign}{}", scales.heat(heat))
}

/// The value of a source; if its heat in the state that is shown differs, also that heat.
fn words(source: &Supply, scales: Option<&Scales>) -> Vec<String> {
    let heat = scales.zip(source.heat).map(|(scales, heat)| signed(scales, heat));
    match heat {
        Some(heat) if source.value.starts_with('P') => vec![source.value.clone(), heat],
        _ => vec![source.value.clone()],
    }
}
