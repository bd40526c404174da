//! Streams as bands from place to place.
//!
//! A stream takes no heat from the node that it leaves: heat is exchanged where it arrives. A band
//! between two places therefore needs a reference, as enthalpies do. It is the coldest temperature
//! that streams joined to each other reach. A stream carries its capacity rate times the
//! temperature of the place it leaves, above the reference. If as much fluid leaves a place as
//! enters it, its bands balance. Otherwise the difference is a separate bar: fluid that begins or
//! ends there brings it or carries it away.

use crate::model::{Diagram, Link, PlaceRole};

/// The heat of the streams of a diagram.
#[derive(Debug)]
pub(super) struct Streams {
    /// By link, the heat in W above the reference that it carries from its first place to its
    /// second. `None` if it is not a stream, or is one with an unknown rate.
    pub(super) carried: Vec<Option<f64>>,
    /// By place, the heat in W that streams bring in addition, with its name.
    pub(super) left: Vec<(String, f64)>,
}

/// Heat below this share of the enthalpies at a place is rounding.
const ROUNDING: f64 = 1e-9;

impl Streams {
    pub(super) fn of(diagram: &Diagram) -> Self {
        let references = references(diagram);
        let carried = |link: &Link| {
            let (rate, product) = link.carries?;
            Some(product - rate * references[link.from])
        };
        let carried: Vec<Option<f64>> = diagram.links.iter().map(carried).collect();
        let places = 0..diagram.places.len();
        let left = places.map(|place| left(diagram, place, &carried)).collect();
        Self { carried, left }
    }
}

/// Heat that streams bring to a place beyond the bands between places, with the name of its bar.
fn left(diagram: &Diagram, place: usize, carried: &[Option<f64>]) -> (String, f64) {
    let of = &diagram.places[place];
    let inside = (format!("streams in {}", of.name), of.within);
    let links = diagram.links.iter().zip(carried);
    let joined = links.filter_map(|(link, carried)| Some((link, (*carried)?)));
    let at = |(link, _): &(&Link, f64)| link.from == place || link.to == place;
    let joined: Vec<(&Link, f64)> = joined.filter(at).collect();
    if joined.is_empty() || of.role == PlaceRole::Boundary {
        return inside;
    }
    let (mut heat, mut size) = (of.within, 0.0_f64);
    for (link, carried) in &joined {
        let enters = link.to == place;
        heat += if enters { link.heat.unwrap_or(0.0) - carried } else { *carried };
        size = size.max(carried.abs());
    }
    let names = joined.iter().filter(|(link, _)| link.to == place).map(|(link, _)| &link.name);
    let name = names.chain(joined.iter().map(|(link, _)| &link.name)).next();
    let name = if of.within == 0.0 { name.cloned() } else { None };
    (name.unwrap_or(inside.0), if heat.abs() > ROUNDING * size { heat } else { 0.0 })
}

/// By place, the coldest temperature in K that streams reach from there.
fn references(diagram: &Diagram) -> Vec<f64> {
    let mut coldest: Vec<f64> =
        diagram.places.iter().map(|place| place.kelvin.unwrap_or(f64::INFINITY)).collect();
    let streams = || diagram.links.iter().filter(|link| link.carries.is_some());
    // a group has the mean of its members; its fluid may be colder
    for (link, (rate, product)) in streams().filter_map(|link| Some((link, link.carries?))) {
        if rate > 0.0 {
            coldest[link.from] = coldest[link.from].min(product / rate);
        }
    }
    for _ in 0..diagram.places.len() {
        let mut moved = false;
        for link in streams() {
            let least = coldest[link.from].min(coldest[link.to]);
            for place in [link.from, link.to] {
                moved |= coldest[place] > least;
                coldest[place] = least;
            }
        }
        if !moved {
            break;
        }
    }
    coldest
}

/// The reference of the streams in K, if all have the same.
pub(super) fn reference(diagram: &Diagram) -> Option<f64> {
    let references = references(diagram);
    let of_streams = diagram.links.iter().filter(|link| link.carries.is_some());
    let mut all = of_streams.map(|link| references[link.from]);
    let first = all.next()?;
    all.all(|other| other.to_bits() == first.to_bits()).then_some(first)
}
