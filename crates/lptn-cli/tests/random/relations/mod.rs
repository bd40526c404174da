//! Changes of a network that leave its meaning as it is.

mod apart;
mod beside;
mod elsewhere;
mod flat;
mod linear;
mod words;

use std::collections::BTreeMap;

use super::compare::split;
use super::model::{Net, Piece, base, piece, wrapped};
use super::random::Random;
use super::units::Kind;

pub use apart::{in_parallel, in_series};
pub use beside::{idle_nodes, more_outputs};
pub use elsewhere::{imported, included, templated};
pub use flat::grid_written_out;
pub use linear::superposed;
pub use words::{changed_units, later_start, renamed, reordered};

/// What a column is in the other network.
pub enum As {
    /// It has none.
    Nothing,
    /// Every one of these.
    Each(Vec<String>),
    /// The sum of these.
    Sum(Vec<String>),
}

/// A network that means the same.
#[derive(Clone, Default)]
pub struct Variant {
    pub net: Net,
    /// New names by old ones.
    pub names: BTreeMap<String, String>,
    /// What became of elements that are no longer one: their parts, and whether a heat flow is the
    /// sum of theirs.
    pub parts: BTreeMap<String, (Vec<String>, bool)>,
    /// How much later everything happens, in s.
    pub shift: f64,
    /// Whether the numbers have to be the same to the last digit.
    pub exact: bool,
}

/// A relation: `None` where there is nothing to change.
pub type Relation = fn(&Net, &mut Random) -> Option<Variant>;

/// Relations that turn one network into one that has to give the same, by name.
pub const RELATIONS: [(&str, Relation); 12] = [
    ("renamed", renamed),
    ("reordered", reordered),
    ("in other units", changed_units),
    ("split in series", in_series),
    ("split in parallel", in_parallel),
    ("made of a template", templated),
    ("imported", imported),
    ("included", included),
    ("beside idle nodes", idle_nodes),
    ("with a later start", later_start),
    ("with more outputs", more_outputs),
    ("with its grid written out", grid_written_out),
];

impl Variant {
    pub fn of(net: &Net) -> Self {
        Self { net: net.clone(), ..Self::default() }
    }

    pub fn renamed(&self, name: &str) -> String {
        // every name of a path by itself
        let mut text = String::new();
        let mut word = String::new();
        for c in name.chars().chain(['\0']) {
            if c.is_alphanumeric() || c == '_' {
                word.push(c);
                continue;
            }
            text += self.names.get(&word).unwrap_or(&word);
            word.clear();
            if c != '\0' {
                text.push(c);
            }
        }
        text
    }

    pub fn columns(&self, column: &str) -> As {
        if self.parts.contains_key(column) {
            return As::Nothing;
        }
        let (element, what) = split(column);
        let rest = |whole: &str| format!("{}{what}", &element[whole.len()..]);
        let found = [element, base(element)]
            .into_iter()
            .find_map(|name| Some((name, self.parts.get(name)?)));
        let Some((whole, (parts, sum))) = found else {
            return As::Each(vec![self.renamed(column)]);
        };
        let names: Vec<String> =
            parts.iter().map(|part| format!("{part}{}", rest(whole))).collect();
        match (names.is_empty(), sum) {
            (true, _) => As::Nothing,
            (_, true) => As::Sum(names),
            (_, false) => As::Each(names),
        }
    }

    /// The one column that has the same values.
    pub fn single(&self, column: &str) -> Option<String> {
        match self.columns(column) {
            As::Each(names) => names.into_iter().next(),
            _ => None,
        }
    }
}

/// The network with every start and every boundary warmer by so many K.
pub fn disturbed(net: &Net, by: f64) -> Net {
    let mut net = net.clone();
    for entry in &mut net.entries {
        let key = if entry.section == "boundary" { "T" } else { "T0" };
        if let Some(super::model::Field::Value(pieces)) = entry.get_mut(key) {
            *pieces = warmer(pieces, by);
        }
    }
    net
}

/// An absolute temperature that is higher by so many K.
pub fn warmer(pieces: &[Piece], by: f64) -> Vec<Piece> {
    match pieces {
        [Piece::Number(number)] => {
            let mut number = *number;
            number.value += by;
            vec![Piece::Number(number)]
        }
        pieces => wrapped("{value} + {}", pieces, [piece(by, Kind::Difference)]),
    }
}
