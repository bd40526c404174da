//! The heat flows of a state as a Sankey diagram: bars that heat comes from, goes through and ends
//! in, and between them bands as wide as heat flows.
//!
//! Streams join places too, by the heat that their fluid carries above the coldest temperature that
//! it reaches: see `streams`. Streams of a bundle that run both ways are counted by the heat that
//! they bring.

mod flows;
mod place;
mod streams;

use lptn_plot::font::width;
use lptn_plot::scene::{Align, Path, Step, Text, polygon, rectangle};
use lptn_plot::{FIELD, Ink, Scene};
use lptn_report::shortened;

pub use flows::{Band, Bar, BarRole, HeatFlows};

use crate::groups::MOST_PLACES;
use crate::legend;
use crate::model::{Diagram, Scales};
use crate::picture::Laid;
use crate::symbols::{self, MARK};
use place::{LABEL, Placed, PlacedBand, place};

lptn_units::errors! {
/// There is no Sankey diagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoSankey {
    /// No heat flows are known.
    NoState = "graph::no_state",
        "the heat flows of the network are not known",
        help "draw a steady state, or a time of a run";
    /// Nothing flows.
    NoHeat = "graph::no_heat",
        "no heat flows in this state: everything is at one temperature, and no source is on",
        help "draw another time, --at 10min, or check the inputs with `lptn check`";
    /// More bars than can be read.
    TooMany { bars: usize } = "graph::too_many",
        format!("{bars} bars are too many for one picture: at most {MOST_PLACES} are drawn"),
        help "draw groups with --group";
}}

/// Sizes of letters: names, numbers, names of bands.
const NAME: f64 = 13.0;
const VALUE: f64 = 12.0;
const SMALL: f64 = 11.0;

/// Letters of a name that are shown; a reader who points at it sees all.
const LETTERS: usize = 26;

/// The width of a bar.
const BAR: f64 = 12.0;

/// Between a bar and its name.
const BESIDE: f64 = 6.0;

/// Room that the mark of a curve takes before a name.
const MARKED: f64 = 2.0 * MARK + 4.0;

/// The least room between two columns of bars, and the room that bands need there to bend.
const LEAST_GAP: f64 = 120.0;
const BEND: f64 = 34.0;

/// Around everything.
const MARGIN: f64 = 24.0;

/// A picture that would be wider than this, in pixels, has no names at its bands.
const MOST_WIDTH: f64 = 1400.0;

/// A band that is narrower than this has no room for its name.
const NAMED: f64 = 20.0;

impl Laid<'_> {
    /// The heat flows as a drawing, with its places in the columns and in the order of the
    /// [circuit](Laid::scene). Most heat flows from left to right. Bands that flow back bear an
    /// arrow.
    ///
    /// # Errors
    /// [`NoSankey`] if no state is shown, if nothing flows in it, or if there are more than
    /// [`MOST_PLACES`] bars.
    pub fn sankey(&self) -> Result<Scene, NoSankey> {
        let diagram = self.diagram;
        let scales = diagram.scales.as_ref().ok_or(NoSankey::NoState)?;
        let flows = HeatFlows::of(diagram);
        match flows.bars.len() {
            0 => return Err(NoSankey::NoHeat),
            bars if bars > MOST_PLACES => return Err(NoSankey::TooMany { bars }),
            _ => {}
        }
        let placed = place(&flows, self.arranged());
        let (flows, placed) = (&flows, &placed);
        let (x, free) = (Vec::new(), Vec::new());
        let mut drawing = Drawing { diagram, scales, flows, placed, x, free, named: true };
        let mut wide = drawing.columns();
        if wide > MOST_WIDTH {
            drawing.named = false;
            wide = drawing.columns();
        }
        let head = if diagram.title.is_empty() { 0.0 } else { 40.0 };
        let caption = caption(diagram, scales);
        let legend = legend::scale_size(&caption);
        let wide = wide.max(width(&diagram.title, 16.0, true)).max(legend.width);
        let size = (wide + 2.0 * MARGIN, head + placed.height + legend.height + 2.0 * MARGIN);
        let mut scene = Scene::new((size.0.ceil(), size.1.ceil()), diagram.title.clone());
        let title = Text::new(diagram.title.clone(), (MARGIN, MARGIN + 12.0), 16.0, Ink::Text);
        scene.write(title.bold());
        drawing.draw(&mut scene, MARGIN + head);
        let corner = (MARGIN, size.1 - MARGIN - legend.height + legend::GAP);
        legend::scale(&mut scene, (&scales.ends, &scales.ticks), &caption, corner);
        Ok(scene)
    }
}

/// The caption of the state, and the meaning of the heat of streams.
fn caption(diagram: &Diagram, scales: &Scales) -> String {
    let carried = |link: &crate::model::Link| link.carries.is_some();
    let above = match streams::reference(diagram) {
        Some(kelvin) => scales.temperature(kelvin),
        None if diagram.links.iter().any(carried) => "their coldest place".into(),
        None => return scales.caption.clone(),
    };
    format!("{}; streams carry heat above {above}", scales.caption)
}

/// Puts bars and bands on a page.
struct Drawing<'a> {
    diagram: &'a Diagram,
    scales: &'a Scales,
    flows: &'a HeatFlows,
    placed: &'a Placed,
    /// The left side of each column of bars, and the middle of the room between its words and the
    /// names of bands before the next column.
    x: Vec<f64>,
    free: Vec<f64>,
    /// True if bands bear the names of their paths.
    named: bool,
}

impl Drawing<'_> {
    /// Places the columns and returns the total width. Next to each bar there is room for its
    /// words, and before the next column for the names of the bands that end there.
    fn columns(&mut self) -> f64 {
        let mut words = vec![0.0_f64; self.placed.columns];
        let mut names = vec![0.0_f64; self.placed.columns];
        for (i, bar) in self.placed.bars.iter().enumerate() {
            let [name, value] = self.words(i);
            let named = self.mark(i).map_or(0.0, |_| MARKED) + width(&name, NAME, true);
            let wide = named.max(width(&value, VALUE, false));
            words[bar.column] = words[bar.column].max(wide + BESIDE);
        }
        for (i, band) in self.placed.bands.iter().enumerate() {
            let column = band.column + band.levels.len() - 1;
            let name = self.name(i).map_or(0.0, |text| width(&text, SMALL, false) + BESIDE);
            names[column] = names[column].max(name);
        }
        let mut x = MARGIN;
        self.x.clear();
        self.free.clear();
        for (column, words) in words.iter().enumerate() {
            let names = names.get(column + 1).copied();
            let gap = names.map_or(*words, |names| (words + names + BEND).max(LEAST_GAP));
            self.x.push(x);
            self.free.push(x + BAR + (words + gap - names.unwrap_or(0.0)) / 2.0);
            x += BAR + gap;
        }
        x - MARGIN
    }

    /// The name of a bar; its heat, and its temperature or the direction of its heat.
    fn words(&self, bar: usize) -> [String; 2] {
        let bar = &self.flows.bars[bar];
        let more = match bar.role {
            BarRole::Place(i) => self.diagram.places[i].temperature.as_deref(),
            BarRole::Source if bar.into > 0.0 => Some("taken out"),
            BarRole::Stream if bar.into > 0.0 => Some("carried away"),
            BarRole::Stream => Some("brought along"),
            _ => None,
        };
        let heat = self.scales.heat(bar.heat());
        let value = more.map_or_else(|| heat.clone(), |more| format!("{heat}, {more}"));
        [shortened(&bar.name, LETTERS), value]
    }

    /// The label at the end of a band: the name of its path, and its heat unless a bar shows it.
    fn name(&self, band: usize) -> Option<String> {
        let (placed, band) = (&self.placed.bands[band], &self.flows.bands[band]);
        if !self.named || placed.width < NAMED {
            return None;
        }
        let place = |bar: usize| matches!(self.flows.bars[bar].role, BarRole::Place(_));
        let path = place(band.from) && place(band.to);
        let alone = |bar: usize, end: fn(&Band) -> usize| {
            self.flows.bands.iter().filter(|other| end(other) == bar).count() == 1
        };
        let told = alone(band.from, |band| band.from) || alone(band.to, |band| band.to);
        let words = [
            path.then(|| shortened(&band.name, LETTERS)),
            (!told).then(|| self.scales.heat(band.heat)),
        ];
        let words: Vec<String> = words.into_iter().flatten().collect();
        (!words.is_empty()).then(|| words.join(" "))
    }

    /// The place of the curve of a bar.
    fn mark(&self, bar: usize) -> Option<usize> {
        match self.flows.bars[bar].role {
            BarRole::Place(i) => self.diagram.places[i].series,
            _ => None,
        }
    }

    /// The colour of a bar: that of its temperature.
    fn ink(&self, bar: usize) -> Ink {
        let kelvin = match self.flows.bars[bar].role {
            BarRole::Place(i) => self.diagram.places[i].kelvin,
            _ => None,
        };
        kelvin.map_or(Ink::Frame, |kelvin| {
            Ink::Field((self.scales.share(kelvin) * (FIELD - 1) as f64).round() as usize)
        })
    }

    fn draw(&self, scene: &mut Scene, top: f64) {
        for (placed, band) in self.placed.bands.iter().zip(&self.flows.bands) {
            let tip = format!("{} {}", band.name, self.scales.heat(band.heat));
            let path = self.band(placed, top).filled(self.ink(band.from), 0.32);
            scene.put(path.tipped(tip));
        }
        for (i, bar) in self.placed.bars.iter().enumerate() {
            let corner = (self.x[bar.column], top + bar.middle - bar.half);
            let path = rectangle(corner, (BAR, 2.0 * bar.half), 0.0);
            let tip = format!("{} {}", self.flows.bars[i].name, self.words(i)[1]);
            scene.put(path.filled(self.ink(i), 1.0).tipped(tip));
        }
        for (i, bar) in self.placed.bars.iter().enumerate() {
            let at = (self.x[bar.column] + BAR + BESIDE, top + bar.middle);
            let [name, value] = self.words(i);
            let beside = self.mark(i).map_or(0.0, |series| {
                symbols::mark(scene, (at.0 + MARK, at.1 - 7.5), series);
                MARKED
            });
            scene.write(Text::new(name, (at.0 + beside, at.1 - 3.0), NAME, Ink::Text).bold());
            let below = at.1 + LABEL / 2.0 - 5.0;
            scene.write(Text::new(value, (at.0, below), VALUE, Ink::Text));
        }
        for (i, placed) in self.placed.bands.iter().enumerate() {
            let (Some(name), Some(level)) = (self.name(i), placed.levels.last()) else { continue };
            let x = self.x[placed.column + placed.levels.len() - 1] - BESIDE;
            let text = Text::new(name, (x, top + level + 4.0), SMALL, Ink::Text);
            scene.write(text.aligned(Align::End));
        }
        let reversed = self.placed.bands.iter().filter(|band| band.reversed);
        reversed.for_each(|band| self.arrow(scene, band, top));
    }

    /// Its outline: along its upper edge, and back along the lower one.
    fn band(&self, band: &PlacedBand, top: f64) -> Path {
        let half = band.width / 2.0;
        let mut points = Vec::new();
        let last = band.levels.len() - 1;
        for (i, level) in band.levels.iter().enumerate() {
            let x = self.x[band.column + i];
            let sides = [x, x + BAR].into_iter().enumerate();
            let seen = sides.filter(|(side, _)| !(i == 0 && *side == 0 || i == last && *side == 1));
            points.extend(seen.map(|(_, x)| (x, top + level)));
        }
        let edge = |side: f64| points.iter().map(move |(x, y)| (*x, y + side * half));
        let (upper, lower): (Vec<_>, Vec<_>) = (edge(-1.0).collect(), edge(1.0).rev().collect());
        let begin = [Step::Move(upper[0].0, upper[0].1)].into_iter().chain(along(&upper));
        let turn = [Step::Line(lower[0].0, lower[0].1)].into_iter().chain(along(&lower));
        Path::new(begin.chain(turn).chain([Step::Close]).collect())
    }

    /// Draws an arrow to the left upon a band that leads there, in a place without words.
    fn arrow(&self, scene: &mut Scene, band: &PlacedBand, top: f64) {
        let &[first, second, ..] = band.levels.as_slice() else { return };
        let x = self.free[band.column];
        let (from, to) = (self.x[band.column] + BAR, self.x[band.column + 1]);
        let level = top + first + (second - first) * bent((x - from) / (to - from));
        let half = (band.width / 2.0).clamp(4.0, 7.0);
        let head = [(x - half, level), (x + half, level - half), (x + half, level + half)];
        scene.put(polygon(head).filled(Ink::Text, 1.0));
    }
}

/// Share of its way down that a curve between two levels has made at a share of its way to the
/// right, as [`along`] draws it.
fn bent(share: f64) -> f64 {
    let right = |t: f64| 1.5 * t * (1.0 - t) + t.powi(3);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = (low + high) / 2.0;
        if right(middle) < share { low = middle } else { high = middle }
    }
    low * low * (3.0 - 2.0 * low)
}

/// A curve from the first of some points through the others, level at each.
fn along(points: &[(f64, f64)]) -> impl Iterator<Item = Step> {
    points.windows(2).map(|pair| {
        let [(u, v), (x, y)] = [pair[0], pair[1]];
        let middle = (u + x) / 2.0;
        match v.to_bits() == y.to_bits() {
            true => Step::Line(x, y),
            false => Step::Curve([(middle, v), (middle, y), (x, y)]),
        }
    })
}
