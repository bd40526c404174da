//! Layout of a diagram: places and elements in columns from left to right, with wires between them.
//!
//! Sugiyama, Tagawa and Toda (IEEE Trans. SMC 11(2), 1981): directions, ranks, order by
//! barycentres, coordinates. Two things differ. A path is an element in a separate column instead
//! of a line, so nothing else enters the room of its words. All wires at a place are one net, which
//! branches as in a circuit diagram.
//!
//! Libraries for the layout of graphs draw lines where an engineer expects symbols, and layout-rs
//! takes half a minute for 1000 nodes. Elements in series keep their level. The longest way from a
//! place has the largest weight, so that chains stay straight.

mod columns;
pub(crate) mod order;
pub(crate) mod place;
pub(crate) mod rank;
mod route;

use columns::{Columns, Vertex};

/// The room of a thing around its pins in pixels. Its pins are on one level left and right of its
/// middle.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Room {
    /// From the middle to a pin.
    pub(crate) pin: f64,
    /// From the middle to its left and right ends.
    pub(crate) half: f64,
    /// Above the pins.
    pub(crate) above: f64,
    /// Below the pins.
    pub(crate) below: f64,
}

/// A path between two places, or a source before one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    pub(crate) block: Room,
    /// The place that should be to its left; none for a source.
    pub(crate) from: Option<usize>,
    /// The place that should be to its right.
    pub(crate) to: usize,
}

/// Room between two rows, in pixels.
const BETWEEN_ROWS: f64 = 14.0;

/// A point of a picture.
pub(crate) type Point = (f64, f64);

/// The positions of everything.
#[derive(Clone, Debug, Default)]
pub(crate) struct Arranged {
    /// The middle of each place, at the level of its pins.
    pub(crate) places: Vec<Point>,
    /// The middle of each element.
    pub(crate) elements: Vec<Point>,
    /// True if `from` of an element is to its right.
    pub(crate) reversed: Vec<bool>,
    /// Straight pieces of wire.
    pub(crate) wires: Vec<[Point; 2]>,
    /// Points at which three of them meet.
    pub(crate) dots: Vec<Point>,
    /// Width and height.
    pub(crate) size: Point,
    /// The column of each place from the left, if all were in one row.
    pub(crate) ranks: Vec<usize>,
    /// The level of each place, if all were in one row.
    pub(crate) levels: Vec<f64>,
}

/// Arranges places and elements in columns. There are several rows of columns if one row would be
/// wider than `most` pixels.
pub(crate) fn arrange(places: &[Room], elements: &[Element], most: f64) -> Arranged {
    let ranks = rank::ranks(places.len(), elements);
    let mut columns = Columns::of(places, elements, &ranks);
    let neighbours = columns.neighbours();
    order::reduce_crossings(&mut columns.layers, &neighbours);
    let mut levels = place::levels(&columns);
    route::pull_apart(&columns, &mut levels);
    let routes: Vec<route::Channel> =
        (0..columns.nets.len()).map(|channel| route::channel(&columns, &levels, channel)).collect();
    let mut arranged = Arranged {
        places: vec![(0.0, 0.0); places.len()],
        elements: vec![(0.0, 0.0); elements.len()],
        reversed: ranks.reversed,
        ranks: ranks.rank,
        levels: vec![0.0; places.len()],
        ..Arranged::default()
    };
    for (vertex, level) in columns.vertices.iter().zip(&levels) {
        if let Vertex::Place(i) = *vertex {
            arranged.levels[i] = *level;
        }
    }
    let mut turned = Vec::new();
    for row in place::rows(&columns, &routes, most) {
        let row = Row { columns: &columns, levels: &levels, routes: &routes, row };
        turned = row.draw(&mut arranged, turned);
    }
    arranged.wires = route::joined(arranged.wires);
    arranged
}

/// A row of columns.
struct Row<'a> {
    columns: &'a Columns,
    levels: &'a [f64],
    routes: &'a [route::Channel],
    row: std::ops::Range<usize>,
}

impl Row<'_> {
    /// Draws a row below the previous ones, with the wires from the row before. Returns the wires
    /// that go on to the next row.
    fn draw(&self, out: &mut Arranged, turned: Vec<route::Turned>) -> Vec<route::Turned> {
        let (low, high) = place::extent(self.columns, self.levels, &self.row);
        let shift = if turned.is_empty() { out.size.1 } else { out.size.1 + BETWEEN_ROWS } - low;
        let start = route::beside(turned.len());
        if let Some(channel) = self.row.start.checked_sub(1).map(|before| &self.routes[before]) {
            channel.enter(out, &turned, (start, shift));
        }
        let mut x = start;
        let mut goes_on = Vec::new();
        for layer in self.row.clone() {
            let half = self.columns.half(layer);
            for v in &self.columns.layers[layer] {
                self.put(out, (*v, (x + half, self.levels[*v] + shift), half));
            }
            x += 2.0 * half;
            match self.routes.get(layer) {
                Some(channel) if layer + 1 == self.row.end => {
                    goes_on = channel.leave(out, (x, high + shift), shift);
                    x += route::beside(channel.count());
                }
                Some(channel) => {
                    channel.draw(out, x, shift);
                    x += channel.width();
                }
                None => {}
            }
        }
        out.size = (out.size.0.max(x), high + shift + route::beside(goes_on.len()));
        goes_on
    }

    /// One vertex, with its wires to both sides of its column.
    fn put(&self, out: &mut Arranged, (v, (x, y), half): (usize, Point, f64)) {
        let (pin, sides) = match self.columns.vertices[v] {
            Vertex::Place(i) => {
                out.places[i] = (x, y);
                (self.columns.blocks[v].pin, self.columns.sides(v))
            }
            Vertex::Element(i) => {
                out.elements[i] = (x, y);
                (self.columns.blocks[v].pin, self.columns.sides(v))
            }
            Vertex::Pass(_) => (0.0, [true, true]),
        };
        if sides[0] && half > pin {
            out.wires.push([(x - half, y), (x - pin, y)]);
        }
        if sides[1] && half > pin {
            out.wires.push([(x + pin, y), (x + half, y)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::columns::Columns;
    use super::{Arranged, Element, Room, arrange, place, rank, route};

    /// Numbers in an order that is always the same (Marsaglia's xorshift, 2003).
    struct Chance(u64);

    impl Chance {
        fn below(&mut self, most: usize) -> usize {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            (self.0 % most as u64) as usize
        }
    }

    type Box = [f64; 4];

    fn boxes(places: &[Room], elements: &[Element], arranged: &Arranged) -> Vec<Box> {
        let of = |block: &Room, (x, y): (f64, f64)| {
            [x - block.half, x + block.half, y - block.above, y + block.below]
        };
        let places = places.iter().zip(&arranged.places).map(|(block, at)| of(block, *at));
        let elements =
            elements.iter().zip(&arranged.elements).map(|(element, at)| of(&element.block, *at));
        places.chain(elements).collect()
    }

    fn overlap(a: Box, b: Box) -> bool {
        const SLACK: f64 = 0.01;
        a[0] < b[1] - SLACK && b[0] < a[1] - SLACK && a[2] < b[3] - SLACK && b[2] < a[3] - SLACK
    }

    /// A wire that lies upon another one, by its channel, net and level.
    fn upon(places: &[Room], elements: &[Element]) -> Option<(usize, (usize, f64))> {
        let ranks = rank::ranks(places.len(), elements);
        let mut columns = Columns::of(places, elements, &ranks);
        let neighbours = columns.neighbours();
        super::order::reduce_crossings(&mut columns.layers, &neighbours);
        let mut levels = place::levels(&columns);
        route::pull_apart(&columns, &mut levels);
        (0..columns.nets.len())
            .find_map(|i| Some((i, route::channel(&columns, &levels, i).upon()?)))
    }

    /// In any network nothing lies upon anything else, no wire crosses the words above and below an
    /// element, and everything is on the page.
    #[test]
    fn random_networks_are_laid_out_without_overlap() {
        let mut chance = Chance(0x2545_f491_4f6c_dd1d);
        for _ in 0..60 {
            let count = 2 + chance.below(24);
            let places: Vec<Room> = (0..count)
                .map(|_| Room {
                    pin: 30.0,
                    half: 40.0,
                    above: 20.0,
                    below: 20.0 + chance.below(40) as f64,
                })
                .collect();
            let block = Room { pin: 24.0, half: 50.0, above: 25.0, below: 40.0 };
            let links = (0..count + chance.below(count)).map(|_| {
                let from = chance.below(count);
                let to = (from + 1 + chance.below(count - 1)) % count;
                Element { block, from: Some(from), to }
            });
            let mut elements: Vec<Element> = links.collect();
            elements.push(Element { block, from: None, to: chance.below(count) });
            let most = if chance.below(2) == 0 { 800.0 } else { 1e9 };
            let arranged = arrange(&places, &elements, most);
            assert_eq!(upon(&places, &elements), None);
            let boxes = boxes(&places, &elements, &arranged);
            for (i, a) in boxes.iter().enumerate() {
                assert!(a[0] > -0.01 && a[1] < arranged.size.0 + 0.01, "{a:?} {:?}", arranged.size);
                assert!(a[2] > -0.01 && a[3] < arranged.size.1 + 0.01, "{a:?} {:?}", arranged.size);
                assert!(!boxes[..i].iter().any(|b| overlap(*a, *b)), "{a:?}");
                let level = (a[2], a[3]);
                for [(x, y), (u, v)] in &arranged.wires {
                    let wire = [x.min(*u) - 0.5, x.max(*u) + 0.5, y.min(*v) - 0.5, y.max(*v) + 0.5];
                    // its own wires reach its pins on their level
                    let own = (y - v).abs() < 0.01
                        && arranged.places.iter().chain(&arranged.elements).any(|at| {
                            (at.1 - y).abs() < 0.01
                                && level.0 < at.1
                                && at.1 < level.1
                                && a[0] < at.0
                                && at.0 < a[1]
                        });
                    assert!(own || !overlap(*a, wire), "{a:?} {wire:?}");
                }
            }
        }
    }
}
