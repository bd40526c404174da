//! The smallest network that still shows a difference.

use super::model::{Field, Net, Piece, base};

/// Tries so many smaller networks, at most.
const TRIES: usize = 300;

/// Takes away what can be taken away while `fails` stays true.
pub fn smallest(net: &Net, fails: &dyn Fn(&Net) -> bool) -> Net {
    let mut best = net.clone();
    let mut tries = 0;
    loop {
        let before = best.clone();
        for i in (0..best.entries.len()).rev() {
            for candidate in [without(&best, i), simpler(&best, i)].into_iter().flatten() {
                tries += 1;
                if tries < TRIES && candidate != best && fails(&candidate) {
                    best = candidate;
                    break;
                }
            }
        }
        if best == before || tries >= TRIES {
            return best;
        }
    }
}

/// Without an entry, and without what names it.
fn without(net: &Net, i: usize) -> Option<Net> {
    let gone = net.entries.get(i)?;
    if gone.section == "run" {
        return None;
    }
    let mut net = net.clone();
    let mut names = vec![net.entries.remove(i).name];
    while let Some(name) = names.pop() {
        let uses = |entry: &mut super::model::Entry| {
            let mut found = false;
            entry
                .fields
                .iter_mut()
                .for_each(|(_, field)| field.names(&mut |other| found |= base(other) == name));
            found
        };
        let mut at = 0;
        while at < net.entries.len() {
            if uses(&mut net.entries[at]) {
                names.push(net.entries.remove(at).name);
            } else {
                at += 1;
            }
        }
    }
    Some(net)
}

/// With the first number of every expression of an entry in its place.
fn simpler(net: &Net, i: usize) -> Option<Net> {
    let mut net = net.clone();
    let entry = net.entries.get_mut(i)?;
    entry.long = false;
    for (_, field) in &mut entry.fields {
        let Field::Value(pieces) = field else { continue };
        let first = pieces.iter().find(|piece| matches!(piece, Piece::Number(_))).cloned();
        if let (Some(first), true) = (first, pieces.len() > 1) {
            *pieces = vec![first];
        }
    }
    Some(net)
}
