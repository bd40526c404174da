//! Elements that give heat to boundaries.

use crate::element::{Element, Kind};
use crate::positions::chosen;
use crate::radiation::Radiation;

/// Radiation and elements that give heat to boundaries, and sources that depend on temperatures, by
/// their positions in the lists of the system. The heat of boundaries is integrated over every step
/// and needs no others.
#[derive(Clone, Debug)]
pub(crate) struct Outer {
    pub(crate) radiation: Vec<u32>,
    pub(crate) elements: Vec<u32>,
}

impl Outer {
    /// Those of a network with this number of nodes.
    pub(crate) fn of(nodes: usize, radiation: &[Radiation], elements: &[Element]) -> Self {
        let outside = |vertices: &[u32]| vertices.iter().any(|&v| v as usize >= nodes);
        let is_outer = |e: &Element| matches!(e.kind, Kind::Source(_)) || outside(&e.receivers);
        Self {
            radiation: chosen(radiation, |r| outside(&r.ends)),
            elements: chosen(elements, is_outer),
        }
    }
}
