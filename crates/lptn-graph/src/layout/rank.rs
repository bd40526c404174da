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
    draw_near(&mut rank, &into);
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

/// Moves places that nothing leads to just before the first that they lead to.
fn draw_near(rank: &mut [usize], into: &[Vec<usize>]) {
    let mut first = vec![usize::MAX; rank.len()];
    for (place, before) in into.iter().enumerate() {
        for a in before {
            first[*a] = first[*a].min(rank[place]);
        }
    }
    for (place, before) in into.iter().enumerate() {
        if before.is_empty() && first[place] != usize::MAX {
            rank[place] = first[place] - 1;
        }
    }
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
