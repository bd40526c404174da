//! Coordinates: levels in the columns, and rows of columns.

use std::ops::Range;

use super::Room;
use super::columns::{Columns, Vertex};
use super::route::{Channel, MOST_TURNING};

/// Between two neighbours of a column.
const GAP: f64 = 14.0;

/// Rows have to make a drawing narrower than this share of its width in one row: wires between rows
/// are long.
const WORTH: f64 = 0.75;

/// Number of rounds that draw levels towards their neighbours.
const ROUNDS: usize = 24;

/// The weight of vertices that are in line already.
const HELD: f64 = 1e9;

/// The level of each vertex, downwards, such that wires are nearly straight.
pub(crate) fn levels(columns: &Columns) -> Vec<f64> {
    let neighbours = columns.neighbours();
    let mut at = vec![0.0; columns.vertices.len()];
    let count = columns.layers.len();
    let rooms = rooms(columns);
    let settle = |layer: usize, at: &mut [f64], wish: &dyn Fn(usize, &[f64]) -> Wish| {
        settle(&rooms, &columns.layers[layer], at, wish);
    };
    (0..count).for_each(|layer| settle(layer, &mut at, &|_, _| (0.0, 1.0)));
    for round in 0..ROUNDS {
        let both = round >= ROUNDS / 2;
        let forth = round % 2 == 0;
        for k in 0..count {
            let layer = if forth { k } else { count - 1 - k };
            settle(layer, &mut at, &|v, at| {
                let before = mean(&neighbours[0][v], at);
                let after = mean(&neighbours[1][v], at);
                let wish = match (both, before, after) {
                    (true, Some(a), Some(b)) => Some((a + b) / 2.0),
                    (true, a, b) => a.or(b),
                    (false, a, b) => {
                        if forth {
                            a
                        } else {
                            b
                        }
                    }
                };
                (wish.unwrap_or(at[v]), 1.0)
            });
        }
    }
    // the first vertices stay, and the rest is put in line with them
    for layer in 0..count {
        settle(layer, &mut at, &|v, at| {
            let wish = in_line(columns, &neighbours[0][v], at);
            (wish.unwrap_or(at[v]), columns.weights[v])
        });
    }
    for layer in (0..count).rev() {
        settle(layer, &mut at, &|v, at| match (
            &neighbours[0][v],
            in_line(columns, &neighbours[1][v], at),
        ) {
            (before, Some(after)) if before.is_empty() => (after, 1.0),
            _ => (at[v], HELD),
        });
    }
    at.iter().map(|level| level.round()).collect()
}

/// The room of each vertex; vertices in line have that of the tallest, so that nothing bends them.
fn rooms(columns: &Columns) -> Vec<Room> {
    let mut rooms = columns.blocks.clone();
    let passes = |v: usize| matches!(columns.vertices[v], Vertex::Pass(_));
    let channels = 0..columns.nets.len();
    for channel in channels.clone().chain(channels.rev()) {
        for net in &columns.nets[channel] {
            let ([a], [b]) = (net.left.as_slice(), net.right.as_slice()) else { continue };
            if passes(*a) || passes(*b) {
                continue;
            }
            let above = rooms[*a].above.max(rooms[*b].above);
            let below = rooms[*a].below.max(rooms[*b].below);
            for v in [*a, *b] {
                rooms[v] = Room { above, below, ..rooms[v] };
            }
        }
    }
    rooms
}

/// The mean level of some vertices.
fn mean(of: &[usize], at: &[f64]) -> Option<f64> {
    (!of.is_empty()).then(|| of.iter().map(|v| at[*v]).sum::<f64>() / of.len() as f64)
}

/// The level of the heaviest of some vertices; that in the middle of several.
fn in_line(columns: &Columns, of: &[usize], at: &[f64]) -> Option<f64> {
    let most = of.iter().map(|v| columns.weights[*v]).fold(0.0, f64::max);
    let heavy = of.iter().filter(|v| columns.weights[**v] >= most);
    let mut levels: Vec<f64> = heavy.map(|v| at[*v]).collect();
    levels.sort_by(f64::total_cmp);
    let middle = levels.len() / 2;
    match levels.len() {
        0 => None,
        n if n % 2 == 1 => Some(levels[middle]),
        _ => Some((levels[middle - 1] + levels[middle]) / 2.0),
    }
}

/// A level that a vertex wishes to have, and how much.
pub(crate) type Wish = (f64, f64);

/// Puts the vertices of a column as near to where they wish to be as their sizes and order allow,
/// in the least squares: isotonic regression by pooling adjacent violators.
pub(crate) fn settle(
    rooms: &[Room],
    vertices: &[usize],
    at: &mut [f64],
    wish: &dyn Fn(usize, &[f64]) -> Wish,
) {
    let mut offset = 0.0;
    let mut offsets = Vec::with_capacity(vertices.len());
    for (i, v) in vertices.iter().enumerate() {
        if let Some(last) = i.checked_sub(1).map(|i| vertices[i]) {
            offset += rooms[last].below + GAP + rooms[*v].above;
        }
        offsets.push(offset);
    }
    // pools of neighbours that touch: mean, weight, number
    let mut pools: Vec<(f64, f64, usize)> = Vec::new();
    for (v, offset) in vertices.iter().zip(&offsets) {
        let (level, weight) = wish(*v, at);
        let mut pool = (level - offset, weight, 1);
        while let Some((mean, weight, count)) = pools.pop_if(|last| last.0 > pool.0) {
            let sum = mean * weight + pool.0 * pool.1;
            pool = (sum / (weight + pool.1), weight + pool.1, count + pool.2);
        }
        pools.push(pool);
    }
    let means = pools.iter().flat_map(|(mean, _, count)| std::iter::repeat_n(*mean, *count));
    for ((v, offset), mean) in vertices.iter().zip(&offsets).zip(means) {
        at[*v] = mean + offset;
    }
}

/// The highest and the lowest level that anything of some columns takes up.
pub(crate) fn extent(columns: &Columns, levels: &[f64], row: &Range<usize>) -> (f64, f64) {
    let vertices = columns.layers[row.clone()].iter().flatten();
    vertices.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        let block = columns.blocks[*v];
        (low.min(levels[*v] - block.above), high.max(levels[*v] + block.below))
    })
}

/// Rows of columns, as few as possible, of at most `most` pixels; the widest is as narrow as
/// possible. A row ends after places from which few wires go on.
pub(crate) fn rows(columns: &Columns, routes: &[Channel], most: f64) -> Vec<Range<usize>> {
    let count = columns.layers.len();
    let width =
        |layer: usize| 2.0 * columns.half(layer) + routes.get(layer).map_or(0.0, Channel::width);
    let mut left = vec![0.0; count + 1];
    (0..count).for_each(|layer| left[layer + 1] = left[layer] + width(layer));
    let is_place = |v: &usize| matches!(columns.vertices[*v], Vertex::Place(_));
    let may_end = |end: &usize| {
        *end == count
            || columns.nets[end - 1].len() <= MOST_TURNING
                && columns.layers[end - 1].iter().any(is_place)
    };
    let mut stops = vec![0];
    stops.extend((1..=count).filter(may_end));
    // by number of rows: the least width of the widest up to each stop, and the stop before it
    let mut best: Vec<Vec<(f64, usize)>> =
        vec![stops.iter().map(|stop| (left[*stop], 0)).collect()];
    while best[best.len() - 1][stops.len() - 1].0 > most && best.len() + 1 < stops.len() {
        let last = &best[best.len() - 1];
        let to = |end: usize| {
            let over = |from: usize| (last[from].0.max(left[stops[end]] - left[stops[from]]), from);
            (1..end).map(over).min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, 0))
        };
        let next = (0..stops.len()).map(to).collect();
        best.push(next);
    }
    let least = |row: &[(f64, usize)]| row[stops.len() - 1].0;
    let fits = best.iter().map(|row| least(row)).fold(f64::INFINITY, f64::min).max(most);
    let number = best.iter().position(|row| least(row) <= fits).unwrap_or(0);
    let number = if least(&best[number]) < WORTH * least(&best[0]) { number } else { 0 };
    let (mut rows, mut end) = (Vec::new(), stops.len() - 1);
    for row in best[..=number].iter().rev() {
        rows.push(stops[row[end].1]..stops[end]);
        end = row[end].1;
    }
    rows.reverse();
    rows
}
