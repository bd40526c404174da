//! The places of the bars, and the points at which bands leave and reach them.

use super::flows::{Bar, BarRole, HeatFlows};
use crate::layout::order::{Neighbours, exchange};
use crate::layout::place::settle;
use crate::layout::rank::Ranks;
use crate::layout::{Arranged, Room};

/// Pixels of all the heat in the column that has most.
const TALL: f64 = 260.0;

/// The least width of a band, and height of a bar, in pixels.
const HAIR: f64 = 0.8;

/// Room that the two lines of text at a bar take.
pub(crate) const LABEL: f64 = 34.0;

/// Around a band on its way through a column.
const BESIDE: f64 = 2.0;

/// Between parts of the picture that no band joins.
const APART: f64 = 24.0;

/// Factor by which a vertex in line keeps its level more firmly than others.
const HELD: f64 = 1e6;

/// Number of rounds that draw bars towards their neighbours.
const ROUNDS: usize = 40;

/// The positions of everything. Levels are in pixels downwards from the highest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Placed {
    pub(crate) bars: Vec<PlacedBar>,
    pub(crate) bands: Vec<PlacedBand>,
    pub(crate) columns: usize,
    pub(crate) height: f64,
}

#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PlacedBar {
    pub(crate) column: usize,
    pub(crate) middle: f64,
    pub(crate) half: f64,
}

/// A band from left to right.
#[derive(Clone, Debug)]
pub(crate) struct PlacedBand {
    /// The column in which it begins.
    pub(crate) column: usize,
    /// Its middle in each column from there to its end.
    pub(crate) levels: Vec<f64>,
    pub(crate) width: f64,
    /// True if its heat flows from right to left: it closes a circle.
    pub(crate) reversed: bool,
}

/// A piece of a band between two neighbouring columns: its vertices, and how far below their
/// middles it is.
#[derive(Clone, Copy, Debug)]
struct Piece {
    band: usize,
    ends: [usize; 2],
    offsets: [f64; 2],
}

/// Bars, then the bands on their way through columns, as vertices of a layered graph.
struct Layers {
    layers: Vec<Vec<usize>>,
    /// For each vertex half its height, and its room.
    halves: Vec<f64>,
    rooms: Vec<Room>,
    /// In pixels, by band.
    widths: Vec<f64>,
    /// From left to right, band by band.
    pieces: Vec<Piece>,
}

/// Places the bars: those of places in the columns and in the order of the circuit.
pub(crate) fn place(flows: &HeatFlows, circuit: &Arranged) -> Placed {
    let ranks = ranks(flows, circuit);
    let mut layers = Layers::new(flows, &ranks);
    let neighbours = layers.neighbours();
    let part = parts(&neighbours);
    let heights = layers.heights(flows, circuit);
    layers.layers.iter_mut().for_each(|layer| {
        layer.sort_by(|a, b| part[*a].cmp(&part[*b]).then(heights[*a].total_cmp(&heights[*b])));
    });
    let is_place =
        |bar: usize| flows.bars.get(bar).is_some_and(|bar| matches!(bar.role, BarRole::Place(_)));
    let may = |a: usize, b: usize| part[a] == part[b] && !(is_place(a) && is_place(b));
    exchange(&mut layers.layers, &neighbours, &may);
    layers.join();
    let mut levels = layers.levels();
    layers.stack(&mut levels, &part);
    layers.placed(&ranks, &levels)
}

/// The column of each bar, and the bands that flow to the left. Places have the columns of the
/// circuit, or of its mirror image if more heat would flow to the left than to the right.
fn ranks(flows: &HeatFlows, circuit: &Arranged) -> Ranks {
    let own = |bar: &Bar| match bar.role {
        BarRole::Place(i) => Some(circuit.ranks[i] + 1),
        _ => None,
    };
    let mut columns: Vec<Option<usize>> = flows.bars.iter().map(own).collect();
    let to_the_right: f64 = flows
        .bands
        .iter()
        .map(|band| {
            let ends = columns[band.from].zip(columns[band.to]);
            ends.map_or(0.0, |(a, b)| if a < b { band.heat } else { -band.heat })
        })
        .sum();
    if to_the_right < 0.0 {
        let ends = columns.iter().flatten().copied().max().unwrap_or(0) + 1;
        columns.iter_mut().flatten().for_each(|column| *column = ends - *column);
    }
    let mut rank: Vec<usize> = columns.iter().map(|column| column.unwrap_or(0)).collect();
    for (bar, _) in columns.iter().enumerate().filter(|(_, column)| column.is_none()) {
        let after = flows.bands.iter().filter(|band| band.from == bar).map(|band| rank[band.to]);
        let before = flows.bands.iter().filter(|band| band.to == bar).map(|band| rank[band.from]);
        let first = after.min().map(|first| first.saturating_sub(1));
        rank[bar] = first.unwrap_or_else(|| before.max().map_or(0, |last| last + 1));
    }
    let mut used = rank.clone();
    used.sort_unstable();
    used.dedup();
    rank.iter_mut().for_each(|rank| *rank = used.partition_point(|other| other < rank));
    let reversed = flows.bands.iter().map(|band| rank[band.from] > rank[band.to]).collect();
    Ranks { rank, reversed }
}

/// The height that a band of this width takes at a bar: a little more, to distinguish the next one.
fn slot(width: f64) -> f64 {
    width + (0.2 * width).min(1.2)
}

/// For each vertex the part it belongs to, which no band joins to another; numbered in the order of
/// the vertices.
fn parts(neighbours: &Neighbours) -> Vec<usize> {
    let mut part = vec![usize::MAX; neighbours[0].len()];
    let mut count = 0;
    for first in 0..part.len() {
        if part[first] != usize::MAX {
            continue;
        }
        let mut open = vec![first];
        while let Some(vertex) = open.pop() {
            if part[vertex] == usize::MAX {
                part[vertex] = count;
                open.extend(neighbours.iter().flat_map(|side| &side[vertex]));
            }
        }
        count += 1;
    }
    part
}

impl Layers {
    fn new(flows: &HeatFlows, ranks: &Ranks) -> Self {
        let count = ranks.rank.iter().max().map_or(0, |last| last + 1);
        let mut layers = vec![Vec::new(); count];
        let mut heat = vec![0.0; count];
        for (bar, &rank) in ranks.rank.iter().enumerate() {
            layers[rank].push(bar);
            heat[rank] += flows.bars[bar].heat();
        }
        let mut vertices = flows.bars.len();
        let mut pieces = Vec::new();
        for (i, (band, reversed)) in flows.bands.iter().zip(&ranks.reversed).enumerate() {
            let (left, right) = if *reversed { (band.to, band.from) } else { (band.from, band.to) };
            let mut last = left;
            for column in ranks.rank[left] + 1..ranks.rank[right] {
                layers[column].push(vertices);
                heat[column] += band.heat;
                pieces.push(Piece { band: i, ends: [last, vertices], offsets: [0.0; 2] });
                last = vertices;
                vertices += 1;
            }
            pieces.push(Piece { band: i, ends: [last, right], offsets: [0.0; 2] });
        }
        let scale = TALL / heat.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        let widths = flows.bands.iter().map(|band| (scale * band.heat).max(HAIR)).collect();
        let mut all = Self { layers, halves: Vec::new(), rooms: Vec::new(), widths, pieces };
        all.make_room(flows.bars.len(), vertices);
        all
    }

    /// Each vertex is as high as the bands at its larger side need.
    fn make_room(&mut self, bars: usize, vertices: usize) {
        let mut sides = vec![[0.0; 2]; vertices];
        for piece in &self.pieces {
            let slot = slot(self.widths[piece.band]);
            sides[piece.ends[0]][1] += slot;
            sides[piece.ends[1]][0] += slot;
        }
        self.halves = sides.iter().map(|[left, right]| f64::max(*left, *right) / 2.0).collect();
        let room = |(vertex, half): (usize, &f64)| {
            let reach = if vertex < bars { half.max(LABEL / 2.0) } else { half + BESIDE };
            Room { above: reach, below: reach, ..Room::default() }
        };
        self.rooms = self.halves.iter().enumerate().map(room).collect();
    }

    fn neighbours(&self) -> Neighbours {
        let mut found = [vec![Vec::new(); self.halves.len()], vec![Vec::new(); self.halves.len()]];
        for Piece { ends: [left, right], .. } in &self.pieces {
            found[0][*right].push(*left);
            found[1][*left].push(*right);
        }
        found
    }

    /// The height in the circuit of each vertex: of other bars that of the place that they heat or
    /// cool, of bands on their way that between their ends.
    fn heights(&self, flows: &HeatFlows, circuit: &Arranged) -> Vec<f64> {
        let own = |bar: usize| match flows.bars[bar].role {
            BarRole::Place(i) => Some(circuit.levels[i]),
            _ => None,
        };
        let bar = |bar: usize| {
            let ends = flows.bands.iter().filter(|band| band.from == bar || band.to == bar);
            let others = ends.filter_map(|band| own(band.from + band.to - bar));
            let (sum, count) = others.fold((0.0, 0.0), |(sum, n), level| (sum + level, n + 1.0));
            own(bar).unwrap_or(if count > 0.0 { sum / count } else { 0.0 })
        };
        let mut heights: Vec<f64> = (0..flows.bars.len()).map(bar).collect();
        heights.resize(self.halves.len(), 0.0);
        let bars = flows.bars.len();
        for pieces in self.pieces.chunk_by(|a, b| a.band == b.band) {
            let (first, last) = (pieces[0].ends[0], pieces[pieces.len() - 1].ends[1]);
            let (begin, end) = (heights[first], heights[last]);
            for (i, piece) in pieces.iter().enumerate().filter(|(_, p)| p.ends[1] >= bars) {
                let share = (i + 1) as f64 / pieces.len() as f64;
                heights[piece.ends[1]] = begin + share * (end - begin);
            }
        }
        heights
    }

    /// Joins the bands to both sides of every vertex in the order of their other ends.
    fn join(&mut self) {
        let mut at = vec![0; self.halves.len()];
        for layer in &self.layers {
            layer.iter().enumerate().for_each(|(i, vertex)| at[*vertex] = i);
        }
        for side in [0, 1] {
            let mut order: Vec<usize> = (0..self.pieces.len()).collect();
            order.sort_by_key(|i| at[self.pieces[*i].ends[1 - side]]);
            let mut sums = vec![0.0; self.halves.len()];
            for i in &order {
                let piece = &mut self.pieces[*i];
                let (sum, slot) = (&mut sums[piece.ends[side]], slot(self.widths[piece.band]));
                piece.offsets[side] = *sum + slot / 2.0;
                *sum += slot;
            }
            for piece in &mut self.pieces {
                piece.offsets[side] -= sums[piece.ends[side]] / 2.0;
            }
        }
    }

    /// The middle of each vertex, such that wide bands are nearly straight.
    fn levels(&self) -> Vec<f64> {
        let joined = self.joined();
        let count = self.layers.len();
        let mut at = vec![0.0; self.halves.len()];
        let mut settle = |layer: usize, held: f64, wish: &dyn Fn(usize, &[f64]) -> Option<f64>| {
            settle(&self.rooms, &self.layers[layer], &mut at, &|vertex, at| {
                let weight = 1.0 + self.halves[vertex];
                wish(vertex, at).map_or((at[vertex], weight), |level| (level, held * weight))
            });
        };
        (0..count).for_each(|layer| settle(layer, 1.0, &|_, _| None));
        for round in 0..ROUNDS {
            let sides = if round < ROUNDS / 2 { round % 2..round % 2 + 1 } else { 0..2 };
            for k in 0..count {
                let layer = if round % 2 == 0 { k } else { count - 1 - k };
                settle(layer, 1.0, &|vertex, at| {
                    self.mean(joined[vertex][sides.clone()].iter().flatten(), vertex, at)
                });
            }
        }
        // nearly straight bands become straight: wide bands from the left, then those that come
        // first
        let main = |vertex: usize, side: usize| -> Option<usize> {
            let width = |i: &&usize| self.widths[self.pieces[**i].band];
            joined[vertex][side].iter().max_by(|a, b| width(a).total_cmp(&width(b))).copied()
        };
        for layer in 0..count {
            settle(layer, HELD, &|vertex, at| {
                let piece = main(vertex, 0)?;
                let mutual = main(self.pieces[piece].ends[0], 1) == Some(piece);
                mutual.then(|| self.straight(piece, vertex, at).0)
            });
        }
        for layer in (0..count).rev() {
            settle(layer, HELD, &|vertex, at| {
                let piece = main(vertex, 1).filter(|_| joined[vertex][0].is_empty())?;
                Some(self.straight(piece, vertex, at).0)
            });
        }
        at
    }

    /// For each vertex the pieces to its left and to its right.
    fn joined(&self) -> Vec<[Vec<usize>; 2]> {
        let mut joined = vec![[Vec::new(), Vec::new()]; self.halves.len()];
        for (i, piece) in self.pieces.iter().enumerate() {
            joined[piece.ends[0]][1].push(i);
            joined[piece.ends[1]][0].push(i);
        }
        joined
    }

    /// The level at which these pieces of a vertex would be straight; wide ones decide.
    fn mean<'a>(
        &self,
        pieces: impl Iterator<Item = &'a usize>,
        vertex: usize,
        at: &[f64],
    ) -> Option<f64> {
        let (sum, weight) = pieces.fold((0.0, 0.0), |(sum, weight), i| {
            let (level, width) = self.straight(*i, vertex, at);
            (sum + width.powi(2) * level, weight + width.powi(2))
        });
        (weight > 0.0).then(|| sum / weight)
    }

    /// The level of a vertex at which a piece is straight, and the width of the piece.
    fn straight(&self, piece: usize, vertex: usize, at: &[f64]) -> (f64, f64) {
        let Piece { band, ends, offsets } = self.pieces[piece];
        let own = usize::from(ends[1] == vertex);
        (at[ends[1 - own]] + offsets[1 - own] - offsets[own], self.widths[band])
    }

    /// Puts parts below each other, so that no room is left between them.
    fn stack(&self, at: &mut [f64], part: &[usize]) {
        let count = part.iter().max().map_or(0, |last| last + 1);
        let mut ends = vec![(f64::INFINITY, f64::NEG_INFINITY); count];
        for (vertex, room) in self.rooms.iter().enumerate() {
            let (high, low) = &mut ends[part[vertex]];
            *high = high.min(at[vertex] - room.above);
            *low = low.max(at[vertex] + room.below);
        }
        let mut next = 0.0;
        let shifts = ends.iter().map(|(high, low)| {
            let shift = next - high;
            next += low - high + APART;
            shift
        });
        let shifts: Vec<f64> = shifts.collect();
        at.iter_mut().zip(part).for_each(|(level, part)| *level += shifts[*part]);
    }

    fn placed(&self, ranks: &Ranks, at: &[f64]) -> Placed {
        let reach = |sign: f64| {
            let ends = at.iter().zip(&self.rooms).map(move |(at, room)| sign * at + room.above);
            ends.fold(f64::NEG_INFINITY, f64::max)
        };
        let top = -reach(-1.0);
        let bar = |(bar, column): (usize, &usize)| PlacedBar {
            column: *column,
            middle: at[bar] - top,
            half: self.halves[bar],
        };
        let mut bands: Vec<PlacedBand> = Vec::new();
        for Piece { band, ends, offsets } in &self.pieces {
            let level = |end: usize| at[ends[end]] + offsets[end] - top;
            if *band == bands.len() {
                let (width, reversed) = (self.widths[*band], ranks.reversed[*band]);
                let column = ranks.rank[ends[0]];
                bands.push(PlacedBand { column, levels: vec![level(0)], width, reversed });
            }
            bands[*band].levels.push(level(1));
        }
        Placed {
            bars: ranks.rank.iter().enumerate().map(bar).collect(),
            bands,
            columns: self.layers.len(),
            height: reach(1.0) - top,
        }
    }
}
