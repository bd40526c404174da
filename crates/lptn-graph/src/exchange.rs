//! Places that are all joined to each other by paths of one kind: drawn one by one, the paths of
//! six surfaces that see each other fill a page, and no reader follows them.
//!
//! A circuit has one box for all paths of such an exchange. Each place is joined to it by one
//! element with the sum of its heat flows, and a table below the circuit has every path with its
//! value and heat. Boundaries keep their own paths: heat ends there.

use std::collections::{BTreeMap, BTreeSet};

use lptn_plot::font::width;
use lptn_plot::scene::{Align, Stroke, Text, rectangle};
use lptn_plot::{Ink, Scene};
use lptn_report::shortened;

use crate::labels::{LINE, NAME, SMALL, VALUE};
use crate::layout::{Arranged, Point};
use crate::model::{Diagram, Link, Place, PlaceRole, Scales};

/// The least number of places whose paths are one box: six paths.
const LEAST: usize = 4;

/// The widest table, in pixels: a page is 960 pixels wide.
const MOST_WIDTH: f64 = 900.0;

/// Letters of the name of a path in a table, and of a place next to it and above it.
const LETTERS: usize = 12;

/// Room between a text and the edge of its cell.
const PAD: f64 = 7.0;

/// Room above a table and its title.
const GAP: f64 = 26.0;

/// Opacity of the cell with the largest heat flow.
const TINT: f64 = 0.35;

/// Places that are all joined to each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Exchange {
    /// At least four of [`Diagram::places`].
    pub(crate) places: Vec<usize>,
    /// The path of each pair, smaller place first, of [`Diagram::links`].
    pub(crate) paths: BTreeMap<(usize, usize), usize>,
}

/// A diagram as it is drawn: the last places are the boxes of its exchanges.
#[derive(Clone, Debug)]
pub(crate) struct Compact {
    pub(crate) diagram: Diagram,
    pub(crate) exchanges: Vec<Exchange>,
}

/// The exchanges of a diagram, the largest first.
pub(crate) fn exchanges(diagram: &Diagram) -> Vec<Exchange> {
    let mut of_kind: BTreeMap<_, BTreeMap<(usize, usize), usize>> = BTreeMap::new();
    for (i, link) in diagram.links.iter().enumerate() {
        let ends = [link.from, link.to];
        let joins = ends.iter().all(|end| diagram.places[*end].role != PlaceRole::Boundary);
        if joins && !link.stream && link.from != link.to {
            let pair = (link.from.min(link.to), link.from.max(link.to));
            of_kind.entry(link.kind).or_default().entry(pair).or_insert(i);
        }
    }
    let mut found = Vec::new();
    for mut paths in of_kind.into_values() {
        while let Some(places) = largest(&paths) {
            let pairs = pairs(&places);
            let own = pairs.filter_map(|pair| Some((pair, paths.remove(&pair)?))).collect();
            found.push(Exchange { places, paths: own });
        }
    }
    found.sort_by_key(|exchange| std::cmp::Reverse(exchange.places.len()));
    found
}

fn pairs(places: &[usize]) -> impl Iterator<Item = (usize, usize)> + '_ {
    places.iter().enumerate().flat_map(|(i, a)| places[i + 1..].iter().map(move |b| (*a, *b)))
}

/// The most places that are all joined to each other, ascending, of those found from each place by
/// taking its neighbours in their order.
fn largest(paths: &BTreeMap<(usize, usize), usize>) -> Option<Vec<usize>> {
    let mut neighbours: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
    for &(a, b) in paths.keys() {
        neighbours.entry(a).or_default().insert(b);
        neighbours.entry(b).or_default().insert(a);
    }
    let mut best: Vec<usize> = Vec::new();
    for (first, others) in neighbours.iter().filter(|(_, others)| others.len() + 1 >= LEAST) {
        let mut places = vec![*first];
        for other in others {
            if places.iter().all(|place| neighbours[other].contains(place)) {
                places.push(*other);
            }
        }
        if places.len() > best.len() {
            best = places;
        }
    }
    best.sort_unstable();
    (best.len() >= LEAST).then_some(best)
}

impl Compact {
    /// `None` if no places are all joined to each other.
    pub(crate) fn of(diagram: &Diagram) -> Option<Self> {
        let exchanges = exchanges(diagram);
        if exchanges.is_empty() {
            return None;
        }
        let inside: BTreeSet<usize> =
            exchanges.iter().flat_map(|exchange| exchange.paths.values().copied()).collect();
        let mut drawn = diagram.clone();
        let links = diagram.links.iter().enumerate().filter(|(i, _)| !inside.contains(i));
        drawn.links = links.map(|(_, link)| link.clone()).collect();
        for exchange in &exchanges {
            let into = drawn.places.len();
            drawn.places.push(exchange.as_place(diagram));
            let join = |place: &usize| exchange.join(diagram, *place, into);
            drawn.links.extend(exchange.places.iter().map(join));
        }
        Some(Self { diagram: drawn, exchanges })
    }
}

impl Exchange {
    fn kind<'a>(&self, diagram: &'a Diagram) -> Option<&'a Link> {
        self.paths.values().next().map(|path| &diagram.links[*path])
    }

    /// Its box.
    fn as_place(&self, diagram: &Diagram) -> Place {
        let kind = self.kind(diagram).map_or("", |link| link.kind.declaration().section);
        Place {
            name: kind.to_owned(),
            role: PlaceRole::Junction,
            temperature: Some(format!("{} paths, table below", self.paths.len())),
            kelvin: None,
            stored: None,
            within: 0.0,
            series: None,
        }
    }

    /// The paths of a place as one link to the box, with the sum of their heat.
    fn join(&self, diagram: &Diagram, place: usize, into: usize) -> Link {
        let own = self.paths.iter().filter(|((a, b), _)| *a == place || *b == place);
        let heats = own.map(|(_, path)| {
            let link = &diagram.links[*path];
            link.heat.map(|heat| if link.from == place { heat } else { -heat })
        });
        let heat: Option<f64> = heats.sum();
        let link = self.kind(diagram).unwrap_or(&diagram.links[0]);
        let name = format!("{} paths", self.places.len() - 1);
        let value = Some(String::new());
        Link { name, from: place, to: into, value, heat, carries: None, ..link.clone() }
    }
}

/// A heat flow with its sign, unless it is printed as 0.
fn signed(scales: &Scales, heat: f64) -> String {
    let text = scales.heat(heat);
    let is_zero = !text.contains(|letter: char| letter.is_ascii_digit() && letter != '0');
    if heat < 0.0 && !is_zero { format!("\u{2212}{text}") } else { text }
}

/// Amount of text in the cells of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Says {
    /// Name, value and heat.
    All,
    /// The heat, or the name if it is not known.
    One,
    /// Nothing but its colour; a reader who points at it sees all.
    Nothing,
}

/// The table of an exchange: one row and one column for each place, above the diagonal.
pub(crate) struct Matrix<'a> {
    diagram: &'a Diagram,
    exchange: &'a Exchange,
    /// The places in the order of rows and columns.
    order: Vec<usize>,
    says: Says,
    /// Width of the names of rows; width and height of a cell.
    head: f64,
    cell: Point,
}

impl<'a> Matrix<'a> {
    /// A table with its places in their order in the circuit, from left to right and down.
    pub(crate) fn of(diagram: &'a Diagram, exchange: &'a Exchange, circuit: &Arranged) -> Self {
        let mut order = exchange.places.clone();
        order.sort_by(|a, b| {
            let column = circuit.ranks[*a].cmp(&circuit.ranks[*b]);
            column.then(circuit.levels[*a].total_cmp(&circuit.levels[*b]))
        });
        let name =
            |place: &usize| width(&shortened(&diagram.places[*place].name, LETTERS), NAME, true);
        let names = order.iter().map(name).fold(0.0, f64::max) + 2.0 * PAD;
        let mut table = Self {
            diagram,
            exchange,
            order,
            says: Says::All,
            head: names.ceil(),
            cell: (0.0, 0.0),
        };
        let columns = exchange.places.len() as f64 - 1.0;
        for says in [Says::All, Says::One, Says::Nothing] {
            table.says = says;
            table.cell = table.cell_size(names);
            if table.head + columns * table.cell.0 <= MOST_WIDTH {
                break;
            }
        }
        table
    }

    fn cell_size(&self, names: f64) -> Point {
        let links = self.exchange.paths.values().map(|path| &self.diagram.links[*path]);
        let (mut widest, mut most) = (0.0_f64, 0);
        for lines in links.map(|link| self.lines(link)) {
            let wide = lines.iter().map(|(text, size, bold)| width(text, *size, *bold));
            (widest, most) = (wide.fold(widest, f64::max), most.max(lines.len()));
        }
        match self.says {
            Says::Nothing => (16.0, 16.0),
            _ => ((widest + 2.0 * PAD).max(names).ceil(), LINE * most as f64 + 8.0),
        }
    }

    /// The lines of a cell, with the sizes of their letters, bold or not.
    fn lines(&self, link: &Link) -> Vec<(String, f64, bool)> {
        let name = (shortened(&link.name, LETTERS), SMALL, false);
        let heat = self.diagram.scales.as_ref().zip(link.heat);
        let heat = heat.map(|(scales, heat)| (self.to_the_column(scales, link, heat), VALUE, true));
        match self.says {
            Says::All => {
                let value = link.value.clone().map(|value| (value, SMALL, false));
                [Some(name), value, heat].into_iter().flatten().collect()
            }
            Says::One => vec![heat.unwrap_or(name)],
            Says::Nothing => Vec::new(),
        }
    }

    /// The heat from the place of the row to that of the column.
    fn to_the_column(&self, scales: &Scales, link: &Link, heat: f64) -> String {
        let place = |end: usize| self.order.iter().position(|place| *place == end);
        let back = place(link.from) > place(link.to);
        signed(scales, if back { -heat } else { heat })
    }

    /// Its width and height with its title.
    pub(crate) fn size(&self) -> Point {
        let cells = self.order.len() as f64 - 1.0;
        let height = GAP + 3.0 * LINE + cells * self.cell.1;
        ((self.head + cells * self.cell.0).max(width(&self.title(), VALUE, false)), height)
    }

    fn title(&self) -> String {
        let kind = self.exchange.kind(self.diagram).map_or("", |l| l.kind.declaration().section);
        let heat = if self.diagram.scales.is_some() { ": heat from row to column" } else { "" };
        format!("{kind} between {} places{heat}", self.order.len())
    }

    /// Draws it from its upper left corner.
    pub(crate) fn draw(&self, scene: &mut Scene, (x, y): Point) {
        let top = y + GAP + LINE;
        scene.write(Text::new(self.title(), (x, top - 5.0), VALUE, Ink::Faint));
        let (wide, tall) = self.cell;
        let (left, first) = (x + self.head, top + 1.5 * LINE);
        for (i, place) in self.order.iter().enumerate() {
            let name = shortened(&self.diagram.places[*place].name, LETTERS);
            let write = |at: Point, align| {
                Text::new(name.clone(), at, NAME, Ink::Text).bold().aligned(align)
            };
            if i > 0 && self.says != Says::Nothing {
                let at = (left + (i as f64 - 0.5) * wide, first - 6.0);
                scene.write(write(at, Align::Middle));
            }
            if i + 1 < self.order.len() {
                let at = (left - PAD, first + (i as f64 + 0.5) * tall + 4.5);
                scene.write(write(at, Align::End));
            }
        }
        for (i, a) in self.order.iter().enumerate() {
            for (j, b) in self.order.iter().enumerate().skip(i + 1) {
                let Some(path) = self.exchange.paths.get(&(*a.min(b), *a.max(b))) else { continue };
                let corner = (left + (j as f64 - 1.0) * wide, first + i as f64 * tall);
                self.draw_cell(scene, &self.diagram.links[*path], corner);
            }
        }
    }

    fn draw_cell(&self, scene: &mut Scene, link: &Link, corner: Point) {
        let (wide, tall) = self.cell;
        let of = |end: usize| self.diagram.places[end].name.as_str();
        let heat = self.diagram.scales.as_ref().zip(link.heat);
        let told = heat.map(|(scales, heat)| signed(scales, heat));
        let ends = format!("{} to {}", of(link.from), of(link.to));
        let all = [Some(link.name.clone()), Some(ends), link.value.clone(), told];
        let tip = all.into_iter().flatten().collect::<Vec<_>>().join(", ");
        let most = self.exchange.paths.values().filter_map(|path| self.diagram.links[*path].heat);
        let most = most.map(f64::abs).fold(0.0, f64::max);
        let share = link.heat.map_or(0.0, |heat| if most > 0.0 { heat.abs() / most } else { 0.0 });
        let cell = rectangle(corner, (wide, tall), 0.0);
        scene.put(cell.clone().filled(Ink::Limit, TINT * share));
        scene.put(cell.stroked(Stroke::solid(Ink::Frame, 1.0)).tipped(tip));
        for (i, (text, size, bold)) in self.lines(link).into_iter().enumerate() {
            let at = (corner.0 + wide / 2.0, corner.1 + LINE * (i as f64 + 1.0) - 1.0);
            let ink = if bold || i == 0 { Ink::Text } else { Ink::Faint };
            let text = Text::new(text, at, size, ink).aligned(Align::Middle);
            scene.write(if bold { text.bold() } else { text });
        }
    }
}
