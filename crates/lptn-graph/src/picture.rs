//! Draws a diagram.

use std::cell::OnceCell;
use std::fmt;

use lptn_network::ConductorKind;
use lptn_plot::font::width;
use lptn_plot::scene::{Align, Dash, Stroke, Text, circle, line, rectangle};
use lptn_plot::{FIELD, Ink, Scene};
use lptn_report::shortened;
use lptn_units::Problem;

use crate::direction;
use crate::exchange::{Compact, Matrix};
use crate::labels::{ARROW, ARROW_GAP, LETTERS, LINE, NAME, SMALL, VALUE, element_block};
use crate::layout::{Arranged, Element, Point, Room, arrange};
use crate::legend;
use crate::model::{Diagram, Link, Place, PlaceRole, Scales};
use crate::supplies::{Supplies, supplies};
use crate::symbols::{self, CAPACITY, HALF, REACH, WIRE};

/// More boxes than this cannot be read in any picture.
pub const MOST_DRAWN: usize = 600;

/// A diagram has too many boxes for a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooMany {
    /// Number of its boxes.
    pub boxes: usize,
}

impl fmt::Display for TooMany {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} boxes are too many for one picture: at most {MOST_DRAWN} are drawn",
            self.boxes
        )
    }
}

impl std::error::Error for TooMany {}

impl Problem for TooMany {
    fn code(&self) -> &'static str {
        "graph::too_many"
    }

    fn help(&self) -> Option<String> {
        Some("draw groups with --group, or give all of them to Graphviz with --format dot".into())
    }
}

/// Around everything.
const MARGIN: f64 = 24.0;

/// Rows of columns are about as wide as this at most, in pixels: a page is 960 pixels wide, so that
/// names of 13 pixels are printed with 10 at least.
const MOST_WIDTH: f64 = 1250.0;

/// The widest arrow of a heat flow.
const WIDEST: f64 = 6.0;

/// A diagram with the positions of everything on it, which are computed once for all its pictures.
#[derive(Debug)]
pub struct Laid<'a> {
    pub(crate) diagram: &'a Diagram,
    ends: Vec<(usize, usize)>,
    arranged: OnceCell<Arranged>,
}

impl<'a> Laid<'a> {
    /// A diagram of any size; nothing is laid out before a picture needs it.
    pub fn of(diagram: &'a Diagram) -> Self {
        Self { diagram, ends: direction::ends(diagram), arranged: OnceCell::new() }
    }

    /// The circuit as a drawing. The paths between places that are all joined to each other are one
    /// box, with a table below.
    ///
    /// # Errors
    /// [`TooMany`] for more than [`MOST_DRAWN`] boxes.
    pub fn scene(&self) -> Result<Scene, TooMany> {
        let diagram = self.diagram;
        if diagram.places.len() > MOST_DRAWN {
            return Err(TooMany { boxes: diagram.places.len() });
        }
        let Some(compact) = Compact::of(diagram) else {
            return Ok(self.drawn((diagram, &self.ends, self.arranged()), &[]));
        };
        let drawn = &compact.diagram;
        let ends = direction::ends(drawn);
        let arranged = arranged(drawn, &ends, &supplies(drawn));
        let table = |exchange| Matrix::of(diagram, exchange, &arranged);
        let tables: Vec<Matrix<'_>> = compact.exchanges.iter().map(table).collect();
        Ok(self.drawn((drawn, &ends, &arranged), &tables))
    }

    /// The circuit of `drawn`, which has a box for each of the tables below.
    fn drawn(
        &self,
        (drawn, ends, arranged): (&Diagram, &[(usize, usize)], &Arranged),
        tables: &[Matrix<'_>],
    ) -> Scene {
        let diagram = self.diagram;
        let head = if diagram.title.is_empty() { 0.0 } else { 30.0 };
        let legend = legend::legend(diagram);
        let wide = legend.width.max(width(&diagram.title, 16.0, true)).max(arranged.size.0);
        let sizes: Vec<Point> = tables.iter().map(Matrix::size).collect();
        let wide = sizes.iter().fold(wide, |wide, size| wide.max(size.0));
        let below: f64 = sizes.iter().map(|size| size.1).sum();
        let tall = head + arranged.size.1 + below + legend.height;
        let size = (wide + 2.0 * MARGIN, tall + 2.0 * MARGIN);
        let mut scene = Scene::new((size.0.ceil(), size.1.ceil()), diagram.title.clone());
        let title = Text::new(diagram.title.clone(), (MARGIN, MARGIN + 12.0), 16.0, Ink::Text);
        scene.write(title.bold());
        let corner = (MARGIN + (wide - arranged.size.0) / 2.0, MARGIN + head);
        let boxes = drawn.places.len() - tables.len();
        let mut drawing = Drawing { diagram: drawn, scene: &mut scene, corner, boxes };
        drawing.draw(arranged, (ends, &supplies(drawn)));
        let mut at = corner.1 + arranged.size.1;
        for (table, size) in tables.iter().zip(&sizes) {
            table.draw(&mut scene, (MARGIN + (wide - size.0) / 2.0, at));
            at += size.1;
        }
        legend::draw(&mut scene, diagram, (MARGIN, size.1 - MARGIN - legend.height));
        scene
    }

    /// The positions of everything: the order of places is that of every picture of the network.
    pub(crate) fn arranged(&self) -> &Arranged {
        self.arranged.get_or_init(|| arranged(self.diagram, &self.ends, &supplies(self.diagram)))
    }
}

fn arranged(diagram: &Diagram, ends: &[(usize, usize)], supplies: &[Supplies<'_>]) -> Arranged {
    let places: Vec<Room> =
        diagram.places.iter().map(|place| place_block(diagram, place)).collect();
    let links = diagram.links.iter().zip(ends).map(|(link, (from, to))| Element {
        block: link_block(link, diagram.scales.as_ref()),
        from: Some(*from),
        to: *to,
    });
    let sources = supplies.iter().map(|all| Element {
        block: all.block(diagram.scales.as_ref()),
        from: None,
        to: all.into,
    });
    arrange(&places, &links.chain(sources).collect::<Vec<_>>(), MOST_WIDTH)
}

/// The lines of text of a place.
fn lines(diagram: &Diagram, place: &Place) -> Vec<(String, bool)> {
    let mut lines = vec![(shortened(&place.name, LETTERS), true)];
    if let PlaceRole::Group(words, _) = &place.role {
        lines.push((words.clone(), false));
    }
    lines.extend(diagram.state_of(place).into_iter().map(|text| (text, false)));
    lines
}

fn capacity(place: &Place) -> Option<&str> {
    match &place.role {
        PlaceRole::Node(capacity) | PlaceRole::Group(_, Some(capacity)) => Some(capacity),
        _ => None,
    }
}

/// Half the size of the box of a place.
fn half_box(diagram: &Diagram, place: &Place) -> Point {
    let lines = lines(diagram, place);
    let widest =
        lines.iter().map(|(text, bold)| width(text, if *bold { NAME } else { VALUE }, *bold));
    let wide = widest.fold(34.0, f64::max) + 22.0;
    ((wide / 2.0).ceil(), (LINE * lines.len() as f64 + 13.0) / 2.0)
}

fn place_block(diagram: &Diagram, place: &Place) -> Room {
    let (pin, tall) = half_box(diagram, place);
    let capacity = capacity(place);
    let label = capacity.map_or(0.0, |text| (width(text, VALUE, false) / 2.0).ceil());
    let below = match &place.role {
        PlaceRole::Boundary => 9.0,
        _ if capacity.is_some() => CAPACITY.0 + LINE,
        _ => 0.0,
    };
    Room { pin, half: pin.max(label) + 4.0, above: tall, below: tall + below }
}

/// The lines below the symbol of a path: its value, and its kind if the symbol does not show it.
fn below_link(link: &Link) -> Vec<String> {
    let kind = (link.kind != ConductorKind::Resistor).then(|| link.kind.declaration().section);
    let unknown = || kind.is_none().then(|| "not constant".to_owned());
    let value = link.value.clone().or_else(unknown).filter(|text| !text.is_empty());
    value.into_iter().chain(kind.map(str::to_owned)).collect()
}

fn link_block(link: &Link, scales: Option<&Scales>) -> Room {
    let below = below_link(link);
    let flow = scales.zip(link.heat).map(|(scales, heat)| scales.heat(heat));
    element_block(&link.name, &below, (flow.as_deref(), HALF, REACH))
}

/// Puts a diagram on a page.
struct Drawing<'a> {
    diagram: &'a Diagram,
    scene: &'a mut Scene,
    corner: Point,
    /// The places from here on are boxes for the paths of a table.
    boxes: usize,
}

impl Drawing<'_> {
    fn draw(
        &mut self,
        arranged: &Arranged,
        (ends, supplies): (&[(usize, usize)], &[Supplies<'_>]),
    ) {
        let (left, top) = self.corner;
        let moved = |(x, y): Point| (x + left, y + top);
        for wire in &arranged.wires {
            // a little longer, so that corners are closed
            let [(x, y), (u, v)] = wire.map(moved);
            let over = WIRE / 2.0;
            let (dx, dy) = if x < u { (over, 0.0) } else { (0.0, over) };
            self.scene.put(line([(x - dx, y - dy), (u + dx, v + dy)]).stroked(symbols::pen()));
        }
        for dot in &arranged.dots {
            self.scene.put(circle(moved(*dot), 2.8).filled(Ink::Text, 1.0));
        }
        let (links, sources) = arranged.elements.split_at(self.diagram.links.len());
        for (i, (link, at)) in self.diagram.links.iter().zip(links).enumerate() {
            // its own first end is to the left unless it was turned once
            let turned = arranged.reversed[i] != (ends[i].0 != link.from);
            self.link(link, moved(*at), turned);
        }
        for (all, at) in supplies.iter().zip(sources) {
            all.draw(self.scene, moved(*at), self.diagram.scales.as_ref());
        }
        for (i, (place, at)) in self.diagram.places.iter().zip(&arranged.places).enumerate() {
            self.place((place, i >= self.boxes), moved(*at));
        }
    }

    /// Lines of text around a middle, the first with its base line at `y`.
    fn below(&mut self, words: &[String], (x, y): Point) {
        for (i, text) in words.iter().enumerate() {
            let at = (x, y + LINE * i as f64);
            let ink = if i == 0 { Ink::Text } else { Ink::Faint };
            let size = if i == 0 { VALUE } else { SMALL };
            self.scene.write(Text::new(text.clone(), at, size, ink).aligned(Align::Middle));
        }
    }

    fn name(&mut self, name: &str, at: Point) {
        let text = shortened(name, LETTERS);
        self.scene.write(Text::new(text, at, NAME, Ink::Text).aligned(Align::Middle));
    }

    fn link(&mut self, link: &Link, (x, y): Point, turned: bool) {
        match link.kind {
            _ if link.stream => symbols::stream(self.scene, (x, y), !turned),
            ConductorKind::Radiation => symbols::wave(self.scene, (x, y)),
            _ => symbols::resistor(self.scene, (x, y)),
        }
        self.name(&link.name, (x, y - REACH - 6.0));
        let words = below_link(link);
        let first = y + REACH + LINE - 1.0;
        self.below(&words, (x, first));
        if let Some((scales, heat)) = self.diagram.scales.as_ref().zip(link.heat) {
            // in the direction of the heat; of a stream in that of the fluid
            let right = (heat >= 0.0) != turned;
            self.flow(scales, (heat, right), (x, first + LINE * words.len() as f64));
        }
    }

    /// An arrow as wide as a heat flow is large, with its number.
    fn flow(&mut self, scales: &Scales, (heat, right): (f64, bool), (x, y): Point) {
        let text = scales.heat(heat);
        if heat == 0.0 {
            let text = Text::new(text, (x, y), VALUE, Ink::Text).aligned(Align::Middle);
            return self.scene.write(text.bold());
        }
        let start = x - (ARROW + ARROW_GAP + width(&text, VALUE, true)) / 2.0;
        let share = if scales.most > 0.0 { heat.abs() / scales.most } else { 0.0 };
        let level = y - 4.0;
        let ends = [(start, level), (start + ARROW, level)];
        let ends = if right { ends } else { [ends[1], ends[0]] };
        symbols::arrow(self.scene, ends, (Ink::Limit, 1.0 + (WIDEST - 1.0) * share));
        let at = (start + ARROW + ARROW_GAP, y);
        self.scene.write(Text::new(text, at, VALUE, Ink::Text).bold());
    }

    /// A place, or the box of a table.
    fn place(&mut self, (place, is_box): (&Place, bool), (x, y): Point) {
        let (half, tall) = half_box(self.diagram, place);
        let ink = self.diagram.scales.as_ref().zip(place.kelvin).map(|(scales, kelvin)| {
            Ink::Field((scales.share(kelvin) * (FIELD - 1) as f64).round() as usize)
        });
        let radius = if place.role == PlaceRole::Boundary { 0.0 } else { 8.0 };
        let corner = (x - half, y - tall);
        let size = (2.0 * half, 2.0 * tall);
        if matches!(place.role, PlaceRole::Group(..)) {
            let behind = rectangle((corner.0 + 4.0, corner.1 - 4.0), size, radius);
            self.scene.put(behind.filled(Ink::Paper, 1.0).stroked(symbols::pen()));
        }
        let tip = place.name.clone();
        self.scene.put(rectangle(corner, size, radius).filled(Ink::Paper, 1.0));
        let frame = rectangle(corner, size, radius).tipped(tip);
        self.scene.put(match ink {
            Some(ink) => frame.filled(ink, 0.3).stroked(Stroke::solid(ink, 3.0)),
            None if is_box => frame.stroked(Stroke { dash: Dash::Dashed, ..symbols::pen() }),
            None => frame.filled(Ink::Grid, 0.5).stroked(symbols::pen()),
        });
        if let Some(series) = place.series {
            symbols::mark(self.scene, (corner.0 + 12.0, corner.1), series);
        }
        let lines = lines(self.diagram, place);
        let first = y - LINE * (lines.len() as f64 - 1.0) / 2.0 + 4.5;
        for (i, (text, bold)) in lines.into_iter().enumerate() {
            let at = (x, first + LINE * i as f64);
            let size = if bold { NAME } else { VALUE };
            let text = Text::new(text, at, size, Ink::Text).aligned(Align::Middle);
            self.scene.write(if bold { text.bold() } else { text });
        }
        if place.role == PlaceRole::Boundary {
            symbols::hatching(self.scene, [x - half, x + half], y + tall + 1.5);
        } else if let Some(capacity) = capacity(place) {
            symbols::capacity(self.scene, (x, y + tall));
            let at = (x, y + tall + CAPACITY.0 + LINE - 4.0);
            let text = Text::new(capacity, at, VALUE, Ink::Text).aligned(Align::Middle);
            self.scene.write(text);
        }
    }
}
