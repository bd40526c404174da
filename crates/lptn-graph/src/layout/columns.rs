//! Columns of places and of elements, and the nets in the channels between them.

use super::order::Neighbours;
use super::rank::Ranks;
use super::{Element, Room};

/// A vertex of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Vertex {
    /// A place.
    Place(usize),
    /// An element.
    Element(usize),
    /// The wire of a place on its way through a column.
    Pass(usize),
}

/// The wire of a place in one channel, with the vertices that it joins to its left and right.
#[derive(Clone, Debug, Default)]
pub(crate) struct Net {
    pub(crate) left: Vec<usize>,
    pub(crate) right: Vec<usize>,
}

/// Columns from left to right: places and elements alternate.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) blocks: Vec<Room>,
    /// The weight with which each keeps its level.
    pub(crate) weights: Vec<f64>,
    /// The vertices of each column from top to bottom.
    pub(crate) layers: Vec<Vec<usize>>,
    /// The nets between each column and the next.
    pub(crate) nets: Vec<Vec<Net>>,
}

/// Weights with which vertices keep their level: a wire through a column has more than a place or
/// element. The elements on the longest way from a place have most.
const PASS: f64 = 30.0;
const MAIN: f64 = 1e6;

/// Room that a wire on its way has.
const WIRE: Room = Room { pin: 0.0, half: 0.0, above: 6.0, below: 6.0 };

impl Columns {
    /// Every place and element in its column.
    pub(crate) fn of(places: &[Room], elements: &[Element], ranks: &Ranks) -> Self {
        // a source at the first place is in a column before it
        let first = usize::from(elements.iter().any(|e| e.from.is_none() && ranks.rank[e.to] == 0));
        let main = main_ways(places.len(), elements, ranks);
        let column = |place: usize| 2 * ranks.rank[place] + first;
        let count = (0..places.len()).map(column).max().map_or(0, |last| last + 1);
        let mut all = Self {
            vertices: Vec::new(),
            blocks: Vec::new(),
            weights: Vec::new(),
            layers: vec![Vec::new(); count],
            nets: vec![Vec::new(); count.saturating_sub(1)],
        };
        // by place: its vertex, elements to its left and right with their columns
        let mut at: Vec<Vec<(usize, usize, bool)>> = vec![Vec::new(); places.len()];
        for (e, element) in elements.iter().enumerate() {
            let (left, right) = match element.from {
                Some(from) if ranks.reversed[e] => (Some(element.to), from),
                from => (from, element.to),
            };
            let layer = left.map_or_else(|| column(right) - 1, |left| column(left) + 1);
            let vertex = all.add(Vertex::Element(e), element.block, layer);
            if main[e] {
                all.weights[vertex] = MAIN;
            }
            at[right].push((layer, vertex, true));
            if let Some(left) = left {
                at[left].push((layer, vertex, false));
            }
        }
        for (place, block) in places.iter().enumerate() {
            let vertex = all.add(Vertex::Place(place), *block, column(place));
            all.wire(place, (column(place), vertex), &at[place]);
        }
        all
    }

    fn add(&mut self, vertex: Vertex, block: Room, layer: usize) -> usize {
        self.vertices.push(vertex);
        self.blocks.push(block);
        self.weights.push(if matches!(vertex, Vertex::Pass(_)) { PASS } else { 1.0 });
        self.layers[layer].push(self.vertices.len() - 1);
        self.vertices.len() - 1
    }

    /// Joins a place to its elements, those of the columns before it by a wire through the columns.
    fn wire(&mut self, place: usize, (own, vertex): (usize, usize), at: &[(usize, usize, bool)]) {
        let leftmost = at.iter().filter(|(_, _, before)| *before).map(|(layer, ..)| *layer).min();
        let mut last = None;
        for channel in leftmost.unwrap_or(own)..own {
            let joined = at.iter().filter(|(layer, _, before)| *before && *layer == channel);
            let mut net = Net { left: joined.map(|(_, v, _)| *v).collect(), right: Vec::new() };
            net.left.extend(last);
            let next = match channel + 1 == own {
                true => vertex,
                false => self.add(Vertex::Pass(place), WIRE, channel + 1),
            };
            net.right.push(next);
            self.nets[channel].push(net);
            last = Some(next);
        }
        let after = at.iter().filter(|(_, _, before)| !before);
        let right: Vec<usize> = after.map(|(_, v, _)| *v).collect();
        if !right.is_empty() {
            self.nets[own].push(Net { left: vec![vertex], right });
        }
    }

    /// Half the width of a column.
    pub(crate) fn half(&self, layer: usize) -> f64 {
        self.layers[layer].iter().map(|v| self.blocks[*v].half).fold(0.0, f64::max)
    }

    /// For each side, left and right, true if a wire leaves the vertex there.
    pub(crate) fn sides(&self, vertex: usize) -> [bool; 2] {
        let layer = self.layers.iter().position(|layer| layer.contains(&vertex)).unwrap_or(0);
        let left = layer.checked_sub(1).and_then(|channel| self.nets.get(channel));
        let right = self.nets.get(layer);
        [
            left.is_some_and(|nets| nets.iter().any(|net| net.right.contains(&vertex))),
            right.is_some_and(|nets| nets.iter().any(|net| net.left.contains(&vertex))),
        ]
    }

    /// For each vertex, the vertices that it is joined to in the columns before and after its own.
    pub(crate) fn neighbours(&self) -> Neighbours {
        let mut before = vec![Vec::new(); self.vertices.len()];
        let mut after = before.clone();
        for net in self.nets.iter().flatten() {
            for l in &net.left {
                after[*l].extend_from_slice(&net.right);
            }
            for r in &net.right {
                before[*r].extend_from_slice(&net.left);
            }
        }
        [before, after]
    }
}

/// For each element, true if only it starts the longest way on from the place to its left.
fn main_ways(places: usize, elements: &[Element], ranks: &Ranks) -> Vec<bool> {
    let ends = |e: usize| match elements[e].from {
        Some(from) if ranks.reversed[e] => Some((elements[e].to, from)),
        Some(from) => Some((from, elements[e].to)),
        None => None,
    };
    let mut out: Vec<Vec<(usize, usize)>> = vec![Vec::new(); places];
    for e in 0..elements.len() {
        if let Some((left, right)) = ends(e) {
            out[left].push((e, right));
        }
    }
    let mut order: Vec<usize> = (0..places).collect();
    order.sort_by_key(|place| std::cmp::Reverse(ranks.rank[*place]));
    let mut depth = vec![0_usize; places];
    let mut main = vec![false; elements.len()];
    for place in order {
        let Some(longest) = out[place].iter().map(|(_, to)| depth[*to]).max() else { continue };
        depth[place] = longest + 1;
        let mut ways = out[place].iter().filter(|(_, to)| depth[*to] == longest);
        if let (Some((way, _)), None) = (ways.next(), ways.next()) {
            main[*way] = true;
        }
    }
    main
}
