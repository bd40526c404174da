//! Superposition.

use super::apart::scale;
use super::warmer;
use crate::random::model::{Field, Net};
use crate::random::random::Random;

/// Another excitation of a linear network, and the mean of both: its temperatures are the means.
pub fn superposed(net: &Net, random: &mut Random) -> Option<[Net; 2]> {
    if !net.linear {
        return None;
    }
    let (mut other, mut mean) = (net.clone(), net.clone());
    for (one, half) in other.entries.iter_mut().zip(&mut mean.entries) {
        let (factor, rise) = (random.between(-1.0, 3.0), random.between(-10.0, 30.0));
        let key = match one.kind() {
            "source" => "P",
            "boundary" => "T",
            "node" | "grid" => "T0",
            _ => continue,
        };
        let (Some(one), Some(half)) = (one.get_mut(key), half.get_mut(key)) else { continue };
        if key == "P" {
            scale(one, factor);
            scale(half, 0.5 * (1.0 + factor));
        } else {
            warm(one, rise);
            warm(half, 0.5 * rise);
        }
    }
    Some([other, mean])
}

fn warm(field: &mut Field, by: f64) {
    if let Field::Value(pieces) = field {
        *pieces = warmer(pieces, by);
    }
}
