//! Groups of nodes of a network that form the next coarser level.
//!
//! Nodes are paired along strong links, the pairs again and again: Y. Notay, Electron. Trans.
//! Numer. Anal. 37 (2010) 123. Temperatures in a group are corrected together, so at least one end
//! of a link has to follow the other one. The result is a network again: links between groups
//! are the sums of those between their nodes.

use std::sync::Arc;

use super::super::shape::{Triangle, short};

/// The least strength of a link between two nodes that are paired: its conductance over the
/// diagonal of each of them, summed. The condition of two levels is then 8 at most (section 3 of
/// Notay's paper).
const STRONG: f64 = 0.25;

/// Weaker links are allowed if neither end has one that is stronger by more than this factor: in a
/// uniform body all links are alike.
const ALIKE: f64 = 2.0;

/// A node joins the group at the end of a link that is at least this part of its diagonal.
const JOINS: f64 = 0.5;

/// A node whose links are less than this part of its path to ground needs no correction.
const LOOSE: f64 = 0.2;

/// Rounds in which nodes choose each other before the others are paired in order.
const ROUNDS: usize = 3;

/// The group of a node that is in none.
pub(super) const NONE: u32 = u32::MAX;

/// A network: links below the diagonal and the path of each node to ground, in W/K.
pub(super) struct Network {
    pub(super) triangle: Arc<Triangle>,
    /// The conductance of each link, negative if the matrix has a positive entry.
    pub(super) links: Vec<f64>,
    /// From each node to ground.
    pub(super) ground: Vec<f64>,
}

impl Network {
    /// Passes all links to `tell`: row, column, conductance.
    pub(super) fn each_link(&self, mut tell: impl FnMut(usize, usize, f64)) {
        for run in &self.triangle.runs {
            for row in run.places() {
                let own = run.entries(row);
                for (&column, &link) in
                    self.triangle.columns[own.clone()].iter().zip(&self.links[own])
                {
                    tell(row, column as usize, link);
                }
            }
        }
    }

    /// The diagonal of its matrix.
    pub(super) fn diagonal(&self) -> Vec<f64> {
        let mut diagonal = self.ground.clone();
        self.each_link(|row, column, link| {
            diagonal[row] += link;
            diagonal[column] += link;
        });
        diagonal
    }

    /// Nodes and links.
    pub(super) fn size(&self) -> usize {
        self.ground.len() + self.links.len()
    }

    /// The group of each node, and the network of the groups.
    pub(super) fn paired(&self) -> (Vec<u32>, Self) {
        let diagonal = self.diagonal();
        let loose: Vec<bool> = diagonal
            .iter()
            .zip(&self.ground)
            .map(|(diagonal, ground)| diagonal - ground <= LOOSE * ground)
            .collect();
        let partner = self.partners(&diagonal, &loose);
        let mut groups = vec![NONE; partner.len()];
        let mut count = 0;
        for (node, &other) in partner.iter().enumerate() {
            if loose[node] || groups[node] != NONE {
                continue;
            }
            groups[node] = count;
            if other != NONE {
                match groups[other as usize] {
                    NONE => groups[other as usize] = count,
                    // its partner has another one
                    known => groups[node] = known,
                }
            }
            count += u32::from(groups[node] == count);
        }
        let coarse = self.merged(&groups, count as usize);
        (groups, coarse)
    }

    /// The partner of each node, `NONE` if it stays alone. A node may join one that has another
    /// partner.
    fn partners(&self, diagonal: &[f64], loose: &[bool]) -> Vec<u32> {
        let inverse: Vec<f64> = diagonal.iter().map(|d| d.recip()).collect();
        let takes_part = |row: usize, column: usize| !loose[row] && !loose[column];
        let mut strongest = vec![0.0; loose.len()];
        self.each_link(|row, column, link| {
            let strength = link * (inverse[row] + inverse[column]);
            strongest[row] = f64::max(strongest[row], strength);
            strongest[column] = f64::max(strongest[column], strength);
        });
        let is_strong = |row: usize, column: usize, strength: f64| {
            let other = f64::max(strongest[row], strongest[column]);
            strength >= STRONG.min(other / ALIKE) && strength > 0.0
        };
        let mut partner = vec![NONE; loose.len()];
        for _ in 0..ROUNDS {
            let mut best = vec![(0.0, NONE); partner.len()];
            self.each_link(|row, column, link| {
                let strength = link * (inverse[row] + inverse[column]);
                let free = partner[row] == NONE && partner[column] == NONE;
                if free && is_strong(row, column, strength) && takes_part(row, column) {
                    let strength = strength * (1.0 + scatter(row, column));
                    for (node, other) in [(row, column), (column, row)] {
                        if strength > best[node].0 {
                            best[node] = (strength, short(other));
                        }
                    }
                }
            });
            for (node, &(_, other)) in best.iter().enumerate() {
                if other != NONE && best[other as usize].1 == short(node) {
                    partner[node] = other;
                }
            }
        }
        self.each_link(|row, column, link| {
            let free = partner[row] == NONE && partner[column] == NONE;
            let strong = is_strong(row, column, link * (inverse[row] + inverse[column]));
            if free && strong && takes_part(row, column) {
                (partner[row], partner[column]) = (short(column), short(row));
            }
        });
        self.each_link(|row, column, link| {
            for (node, other) in [(row, column), (column, row)] {
                let joins = partner[node] == NONE && link * inverse[node] >= JOINS;
                if joins && takes_part(row, column) {
                    partner[node] = short(other);
                }
            }
        });
        partner
    }

    /// The network of the groups; a link to a node without a group goes to ground.
    fn merged(&self, groups: &[u32], count: usize) -> Self {
        let mut ground = vec![0.0; count];
        for (&group, own) in groups.iter().zip(&self.ground) {
            if group != NONE {
                ground[group as usize] += own;
            }
        }
        // links sorted by row: the start of each row, then the links themselves
        let mut begins = vec![0_u32; count + 1];
        self.each_link(|row, column, link| match (groups[row], groups[column]) {
            (NONE, NONE) => {}
            (NONE, group) | (group, NONE) => ground[group as usize] += link,
            (a, b) if a == b => {}
            (a, b) => begins[a.max(b) as usize + 1] += 1,
        });
        (0..count).for_each(|row| begins[row + 1] += begins[row]);
        let mut sorted = vec![(0_u32, 0.0); begins[count] as usize];
        let mut next = begins.clone();
        self.each_link(|row, column, link| {
            let (a, b) = (groups[row], groups[column]);
            if a != b && a != NONE && b != NONE {
                let place = &mut next[a.max(b) as usize];
                sorted[*place as usize] = (a.min(b), link);
                *place += 1;
            }
        });
        summed(&begins, &sorted, ground)
    }
}

/// A network from links sorted by row, with those to the same column summed.
fn summed(begins: &[u32], sorted: &[(u32, f64)], ground: Vec<f64>) -> Network {
    let (mut triangle, mut links) = (Triangle::default(), Vec::new());
    let mut place = vec![NONE; ground.len()];
    for ends in begins.windows(2) {
        let first = triangle.columns.len();
        for &(column, link) in &sorted[ends[0] as usize..ends[1] as usize] {
            let known = place[column as usize] as usize;
            if known >= first && triangle.columns.get(known) == Some(&column) {
                links[known] += link;
            } else {
                place[column as usize] = short(links.len());
                triangle.columns.push(column);
                links.push(link);
            }
        }
        triangle.end_row();
    }
    Network { triangle: Arc::new(triangle), links, ground }
}

/// A small number for a link, so that equal links do not all prefer the same end.
fn scatter(row: usize, column: usize) -> f64 {
    let mixed = (row as u64 ^ (column as u64).rotate_left(32)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed >> 44) as f64 * 1e-12
}
