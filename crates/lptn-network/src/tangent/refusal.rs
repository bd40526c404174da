//! What cannot be differentiated by a parameter.

use std::fmt;

use super::live::Live;
use crate::id::{FluidId, Item, NodeId};
use crate::network::Network;

/// Why a network cannot be differentiated by some parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoTangents {
    /// It switches: the times of events move with the parameters.
    Events {
        /// The first control, or what a comparison of temperatures stands in.
        item: Item,
    },
    /// An input jumps at a time that moves with a parameter.
    MovingJump {
        /// The input.
        item: Item,
    },
    /// A massless node leaps from one solution of its balance to another, at a time that moves with the parameters. A run
    /// finds that, not the form of the network.
    Leaps,
    /// How a node melts changes by more than its size.
    Melting {
        /// The node.
        node: NodeId,
    },
    /// The specific heat of a fluid depends on its temperature and on a parameter.
    Fluid {
        /// The fluid.
        fluid: FluidId,
    },
}

pub(super) fn check(network: &Network, live: &Live<'_>) -> Result<(), NoTangents> {
    if let Some(item) = live.event() {
        return Err(NoTangents::Events { item });
    }
    if let Some(item) = live.moving_jump() {
        return Err(NoTangents::MovingJump { item });
    }
    let varying = network.fluid_ids().zip(&network.numbers.fluids).filter(|(_, curve)| curve.is_some());
    let mut changing = varying.filter(|(id, _)| live.value(&network.fluids()[id.index()].cp));
    match changing.next() {
        Some((fluid, _)) => Err(NoTangents::Fluid { fluid }),
        None => Ok(()),
    }
}

impl NoTangents {
    /// What it is said of, in words; the name in backquotes.
    pub fn describe(&self, network: &Network) -> String {
        let name = |item| format!("`{}`", network.name_of(item));
        match *self {
            Self::Events { item } => {
                format!("{} switches, at times that move with the parameters", name(item))
            }
            Self::MovingJump { item } => {
                format!("{} jumps at a time that moves with a parameter", name(item))
            }
            Self::Leaps => self.to_string(),
            Self::Melting { node } => {
                format!("how {} melts depends on a parameter", name(Item::Node(node)))
            }
            Self::Fluid { fluid } => {
                format!("the specific heat of {} depends on a parameter and on T", name(Item::Fluid(fluid)))
            }
        }
    }
}

impl fmt::Display for NoTangents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Events { .. } => "the network switches, at times that move with the parameters",
            Self::MovingJump { .. } => "an input jumps at a time that moves with a parameter",
            Self::Leaps => "a massless node leaps, at a time that moves with the parameters",
            Self::Melting { .. } => "how a node melts depends on a parameter",
            Self::Fluid { .. } => {
                "the specific heat of a fluid depends on a parameter and on its temperature"
            }
        })
    }
}

impl std::error::Error for NoTangents {}
