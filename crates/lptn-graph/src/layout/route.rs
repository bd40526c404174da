//! Wires in the channels between columns.

use super::columns::{Columns, Net};
use super::{Arranged, Point};

/// Between two wires that run side by side.
const TRACK: f64 = 10.0;

/// Levels closer than this are one.
const SAME: f64 = 4.0;

/// A net with the levels of its pins.
#[derive(Clone, Debug)]
struct Wire {
    /// Its net, by its position in the channel.
    net: usize,
    left: Vec<f64>,
    right: Vec<f64>,
    track: usize,
}

/// The wires between two columns.
#[derive(Clone, Debug)]
pub(crate) struct Channel {
    wires: Vec<Wire>,
    tracks: usize,
}

impl Wire {
    fn of((number, net): (usize, &Net), levels: &[f64]) -> Self {
        let of = |pins: &[usize]| pins.iter().map(|v| levels[*v]).collect();
        Self { net: number, left: of(&net.left), right: of(&net.right), track: 0 }
    }

    fn range(&self) -> (f64, f64) {
        let all = self.left.iter().chain(&self.right);
        all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (a.min(*y), b.max(*y)))
    }

    /// True if it needs no piece that runs downwards.
    fn is_straight(&self) -> bool {
        let (top, bottom) = self.range();
        top >= bottom
    }

    /// Cost if this one runs down to the left of another: crossings, and pieces that lie upon each
    /// other.
    fn left_of(&self, other: &Self) -> usize {
        const OVER: usize = 1000;
        let cost = |pins: &[f64], (top, bottom): (f64, f64)| {
            pins.iter().filter(|y| (top - SAME..=bottom + SAME).contains(*y)).count()
        };
        let upon = self
            .right
            .iter()
            .map(|a| other.left.iter().filter(|b| (**b - a).abs() < SAME).count())
            .sum::<usize>();
        cost(&other.left, self.range()) + cost(&self.right, other.range()) + OVER * upon
    }
}

/// The wires of a channel, with a track for each that runs down.
pub(crate) fn channel(columns: &Columns, levels: &[f64], channel: usize) -> Channel {
    let mut wires: Vec<Wire> =
        columns.nets[channel].iter().enumerate().map(|net| Wire::of(net, levels)).collect();
    let straight = wires.iter().filter(|wire| wire.is_straight()).cloned().collect::<Vec<_>>();
    wires.retain(|wire| !wire.is_straight());
    wires.sort_by(|a, b| a.range().0.total_cmp(&b.range().0));
    for _ in 0..wires.len() {
        let mut moved = false;
        for i in 1..wires.len() {
            if wires[i].left_of(&wires[i - 1]) < wires[i - 1].left_of(&wires[i]) {
                wires.swap(i, i - 1);
                moved = true;
            }
        }
        if !moved {
            break;
        }
    }
    let mut tracks = 0;
    for i in 0..wires.len() {
        let (top, bottom) = wires[i].range();
        let meets = |other: &&Wire| {
            let (first, last) = other.range();
            first <= bottom + SAME && top <= last + SAME
        };
        wires[i].track =
            wires[..i].iter().filter(meets).map(|other| other.track + 1).max().unwrap_or(0);
        tracks = tracks.max(wires[i].track + 1);
    }
    wires.extend(straight);
    Channel { wires, tracks }
}

/// Distance by which a vertex is moved if its wire would lie upon another. Twice that is less than
/// the gap between two neighbours of a column.
const NUDGE: f64 = 6.0;

/// Moves vertices by a little if two wires have to pass each other on the same levels: drawn upon
/// each other they would look joined.
pub(super) fn pull_apart(columns: &Columns, levels: &mut [f64]) {
    for number in 0..columns.nets.len() {
        for _ in 0..2 {
            let Some((net, level)) = channel(columns, levels, number).upon() else { break };
            let pins = columns.nets[number][net].right.iter();
            let moved: Vec<usize> =
                pins.copied().filter(|v| (levels[*v] - level).abs() < SAME).collect();
            moved.into_iter().for_each(|v| levels[v] += NUDGE);
        }
    }
}

impl Channel {
    /// The net, and the level of its pin to the right, of a wire that lies upon another one.
    pub(super) fn upon(&self) -> Option<(usize, f64)> {
        let bent = || self.wires.iter().filter(|wire| !wire.is_straight());
        bent().find_map(|wire| {
            let others = bent().filter(|other| other.net != wire.net && other.track > wire.track);
            let mut levels = others.flat_map(|other| &other.left);
            levels.find_map(|y| {
                let pin = wire.right.iter().find(|pin| (*pin - y).abs() < SAME);
                pin.map(|pin| (wire.net, *pin))
            })
        })
    }

    /// Its width in pixels.
    pub(crate) fn width(&self) -> f64 {
        TRACK * (self.tracks as f64 + 1.0)
    }

    /// Draws it from `x` on, levels moved by `shift`.
    pub(crate) fn draw(&self, out: &mut Arranged, x: f64, shift: f64) {
        let end = x + self.width();
        for wire in &self.wires {
            let at = |y: &f64| y + shift;
            if wire.is_straight() {
                let y = at(&wire.left[0]);
                out.wires.push([(x, y), (end, y)]);
                continue;
            }
            let middle = x + TRACK * (wire.track as f64 + 1.0);
            let (top, bottom) = wire.range();
            out.wires.push([(middle, top + shift), (middle, bottom + shift)]);
            out.wires.extend(wire.left.iter().map(|y| [(x, at(y)), (middle, at(y))]));
            out.wires.extend(wire.right.iter().map(|y| [(middle, at(y)), (end, at(y))]));
            for y in wire.left.iter().chain(&wire.right) {
                let inside = *y > top && *y < bottom;
                let through = wire.left.contains(y) && wire.right.contains(y);
                if inside || through {
                    out.dots.push((middle, at(y)));
                }
            }
        }
    }
}

/// The same wires with pieces that go on straight as one.
pub(crate) fn joined(wires: Vec<[Point; 2]>) -> Vec<[Point; 2]> {
    let mut lines: Vec<(bool, f64, f64, f64)> = wires
        .into_iter()
        .map(|[(x, y), (u, v)]| match y.total_cmp(&v).is_eq() {
            true => (false, y, x.min(u), x.max(u)),
            false => (true, x, y.min(v), y.max(v)),
        })
        .collect();
    lines.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.total_cmp(&b.2)));
    let mut found: Vec<(bool, f64, f64, f64)> = Vec::new();
    for line in lines {
        match found.last_mut() {
            Some(last)
                if last.0 == line.0
                    && last.1.total_cmp(&line.1).is_eq()
                    && line.2 <= last.3 + 0.01 =>
            {
                last.3 = last.3.max(line.3);
            }
            _ => found.push(line),
        }
    }
    let wire = |(down, at, a, b): (bool, f64, f64, f64)| match down {
        true => [(at, a), (at, b)],
        false => [(a, at), (b, at)],
    };
    found.into_iter().map(wire).collect()
}

/// At most this many wires go on from a row to the next one, so that a reader can follow them.
pub(crate) const MOST_TURNING: usize = 2;

/// A wire on its way to the next row: its net, and the point at which it turns downwards again.
pub(crate) type Turned = (usize, Point);

/// The width in pixels that wires take next to a row.
pub(crate) fn beside(wires: usize) -> f64 {
    if wires == 0 { 0.0 } else { TRACK * (wires as f64 + 1.0) }
}

impl Channel {
    /// Number of its wires.
    pub(crate) fn count(&self) -> usize {
        self.wires.len()
    }

    /// Leads every wire from the end of a row at `x` down below its `bottom` and back to the left.
    pub(crate) fn leave(&self, out: &mut Arranged, (x, bottom): Point, shift: f64) -> Vec<Turned> {
        let mut wires: Vec<&Wire> = self.wires.iter().collect();
        wires.sort_by(|a, b| a.left[0].total_cmp(&b.left[0]));
        let mut turned = Vec::new();
        for (i, wire) in wires.iter().enumerate() {
            // the highest runs furthest outside, so that none crosses another
            let track = TRACK * (wires.len() - i) as f64;
            let (outer, level) = (x + track, bottom + track);
            let levels = || wire.left.iter().map(|y| y + shift);
            let top = levels().fold(f64::INFINITY, f64::min);
            out.wires.extend(levels().map(|y| [(x, y), (outer, y)]));
            out.wires.push([(outer, top), (outer, level)]);
            out.dots.extend(levels().filter(|y| *y > top).map(|y| (outer, y)));
            out.wires.push([(outer, level), (track, level)]);
            turned.push((wire.net, (track, level)));
        }
        turned
    }

    /// Leads the wires that come from the row before to the beginning of this one, at `x`.
    pub(crate) fn enter(&self, out: &mut Arranged, turned: &[Turned], (x, shift): (f64, f64)) {
        for wire in &self.wires {
            let Some((_, at)) = turned.iter().find(|(net, _)| *net == wire.net) else { continue };
            let levels = || wire.right.iter().map(|y| y + shift);
            let bottom = levels().fold(f64::NEG_INFINITY, f64::max);
            out.wires.push([*at, (at.0, bottom)]);
            out.wires.extend(levels().map(|y| [(at.0, y), (x, y)]));
            out.dots.extend(levels().filter(|y| *y < bottom).map(|y| (at.0, y)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Room;
    use super::super::columns::{Columns, Net, Vertex};
    use super::{channel, pull_apart};

    /// Two wires change places: one of them has to be moved.
    #[test]
    fn wires_that_change_places_do_not_lie_upon_each_other() {
        let net = |left: usize, right: usize| Net { left: vec![left], right: vec![right] };
        let columns = Columns {
            vertices: (0..4).map(Vertex::Place).collect(),
            blocks: vec![Room::default(); 4],
            weights: vec![1.0; 4],
            layers: vec![vec![0, 1], vec![2, 3]],
            nets: vec![vec![net(0, 3), net(1, 2)]],
        };
        let mut levels = vec![0.0, 50.0, 0.0, 50.0];
        assert!(channel(&columns, &levels, 0).upon().is_some());
        pull_apart(&columns, &mut levels);
        assert!(channel(&columns, &levels, 0).upon().is_none(), "{levels:?}");
    }
}
