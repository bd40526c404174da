//! The rank of each place, from left to right.

use super::Element;

/// Ranks of places from 0, and a flag for each element that runs against its direction.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ranks {
    pub(crate) rank: Vec<usize>,
    pub(crate) reversed: Vec<bool>,
}

/// Puts each place to the right of all places from which an element leads to it. Elements that
/// would close a circle are reversed.
pub(crate) fn ranks(places: usize, elements: &[Element]) -> Ranks {
    let mut out: Vec<Vec<(usize, usize)>> = vec![Vec::new(); places];
    let mut entered = vec![false; places];
    for (e, element) in elements.iter().enumerate() {
        if let Some(from) = element.from {
            out[from].push((e, element.to));
            entered[element.to] = true;
        }
    }
    let (reversed, finished) = walk(&out, &entered, elements.len());
    // the last that was left comes first
    let mut rank = vec![0_usize; places];
    let mut into: Vec<Vec<usize>> = vec![Vec::new(); places];
    for (e, element) in elements.iter().enumerate() {
        if let Some(from) = element.from {
            let (a, b) = if reversed[e] { (element.to, from) } else { (from, element.to) };
            into[b].push(a);
        }
    }
    for &place in finished.iter().rev() {
        rank[place] = into[place].iter().map(|a| rank[*a] + 1).max().unwrap_or(0);
    }
    shorten(&mut rank, &into);
    Ranks { rank, reversed }
}

/// Goes through all places from those that nothing leads to. Returns a flag for each element that
/// leads back to a place on the way, and the places in the order in which they were left.
fn walk(out: &[Vec<(usize, usize)>], entered: &[bool], elements: usize) -> (Vec<bool>, Vec<usize>) {
    let places = out.len();
    let mut reversed = vec![false; elements];
    let mut finished = Vec::with_capacity(places);
    // 0: not seen, 1: on the way, 2: left
    let mut state = vec![0_u8; places];
    let roots = (0..places).filter(|p| !entered[*p]).chain(0..places);
    for root in roots {
        if state[root] != 0 {
            continue;
        }
        let mut way = vec![(root, 0)];
        state[root] = 1;
        while let Some((place, next)) = way.last_mut() {
            let Some(&(element, to)) = out[*place].get(*next) else {
                state[*place] = 2;
                finished.push(*place);
                way.pop();
                continue;
            };
            *next += 1;
            match state[to] {
                0 => {
                    state[to] = 1;
                    way.push((to, 0));
                }
                1 => reversed[element] = true,
                _ => {}
            }
        }
    }
    (reversed, finished)
}

/// Rounds in which places move; each round moves every place at most by one to each side.
const ROUNDS: usize = 64;

/// Moves places, each with those that it pushes on, as long as this shortens wires: a place is
/// joined to the first of those that lead to it by one wire.
fn shorten(rank: &mut [usize], into: &[Vec<usize>]) {
    let mut out = vec![Vec::new(); rank.len()];
    for (place, before) in into.iter().enumerate() {
        before.iter().for_each(|a| out[*a].push(place));
    }
    for _ in 0..ROUNDS {
        let mut moved = false;
        for place in 0..rank.len() {
            for right in [true, false] {
                let next = if right { &out } else { into };
                let Some(pushed) = pushed(place, rank, (next, right)) else { continue };
                let ends = ends(&pushed, &out);
                let before = length(&ends, rank, into);
                shift(rank, &pushed, right);
                if length(&ends, rank, into) < before {
                    moved = true;
                } else {
                    shift(rank, &pushed, !right);
                }
            }
        }
        if !moved {
            break;
        }
    }
    let least = rank.iter().min().copied().unwrap_or(0);
    rank.iter_mut().for_each(|rank| *rank -= least);
}

fn shift(rank: &mut [usize], places: &[usize], right: bool) {
    places.iter().for_each(|p| rank[*p] = if right { rank[*p] + 1 } else { rank[*p] - 1 });
}

/// A place and those that have to move with it by one column; `None` if one of them is in the
/// first column and should go left.
fn pushed(
    place: usize,
    rank: &[usize],
    (next, right): (&[Vec<usize>], bool),
) -> Option<Vec<usize>> {
    let mut found = vec![place];
    let mut seen = vec![false; rank.len()];
    seen[place] = true;
    let mut at = 0;
    while let Some(&place) = found.get(at) {
        if !right && rank[place] == 0 {
            return None;
        }
        for &other in &next[place] {
            if rank[other].abs_diff(rank[place]) == 1 && !seen[other] {
                seen[other] = true;
                found.push(other);
            }
        }
        at += 1;
    }
    Some(found)
}

/// Some places, and those to which they lead: only their wires change if the places move.
fn ends(places: &[usize], out: &[Vec<usize>]) -> Vec<usize> {
    let mut ends: Vec<usize> = places.iter().flat_map(|place| &out[*place]).copied().collect();
    ends.extend(places);
    ends.sort_unstable();
    ends.dedup();
    ends
}

/// Columns that the wires to these places pass.
fn length(places: &[usize], rank: &[usize], into: &[Vec<usize>]) -> usize {
    let of = |&place: &usize| {
        let first = into[place].iter().map(|a| rank[*a]).min();
        first.map_or(0, |first| rank[place] - first)
    };
    places.iter().map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::super::{Element, Room};
    use super::ranks;

    fn elements(pairs: &[(usize, usize)]) -> Vec<Element> {
        let block = Room::default();
        pairs.iter().map(|&(a, b)| Element { block, from: Some(a), to: b }).collect()
    }

    #[test]
    fn a_circle_is_opened_and_a_late_beginning_stands_near() {
        // 3 leads into the circle 2, 0, 1; 5 leads to its end
        let found = ranks(6, &elements(&[(0, 1), (1, 2), (2, 0), (3, 2), (2, 4), (5, 4)]));
        assert_eq!(found.rank, [2, 3, 1, 0, 2, 1]);
        assert_eq!(found.reversed, [false, true, false, false, false, false]);
    }
}
