//! Reasons for which a network cannot be differentiated by a parameter.

use std::fmt;

use lptn_units::Problem;

use super::Pass;
use super::influence::Influence;
use crate::id::{FacePathId, FluidId, GridId, GridPatch, Item, NodeId, StateId};
use crate::network::Network;
use crate::parts::shape::Shape;

lptn_units::problems! {
/// Why a network cannot be differentiated by some parameters. `say` puts an item and the kind of
/// thing it is into words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoTangents for |say: &dyn Fn(Item, &str) -> String| at Item {
    /// It switches: the times of events move with the parameters. The item is the first control, or
    /// contains a comparison of temperatures.
    Events { item: Item } = "sensitivity::events", at Some(*item),
        says format!(
            "{} switches, at times that move with the parameters",
            say(*item, "the network")
        ),
        help None;
    /// An input jumps at a time that moves with a parameter.
    MovingJump { item: Item } = "sensitivity::moving_jump", at Some(*item),
        says format!("{} jumps at a time that moves with a parameter", say(*item, "an input")),
        help None;
    /// A massless node jumps from one solution of its balance to another, at a time that moves with
    /// the parameters. A run finds this; the form of the network does not show it.
    Leaps = "sensitivity::leaps", at None,
        says "a massless node jumps, at a time that moves with the parameters".to_owned(),
        help None;
    /// The fluid that leaves a pipe entered earlier.
    Pipe { node: NodeId } = "sensitivity::pipe", at Some(Item::Node(*node)),
        says format!("the fluid in {} entered earlier", say(Item::Node(*node), "a pipe")),
        help None;
    /// A state is sampled.
    Sampled { state: StateId } = "sensitivity::sampled", at Some(Item::State(*state)),
        says format!("{} is sampled", say(Item::State(*state), "a state")),
        help None;
    /// The capacity of a node follows a state.
    Mass { node: NodeId } = "sensitivity::mass", at Some(Item::Node(*node)),
        says format!("the capacity of {} follows a state", say(Item::Node(*node), "a node")),
        help None;
    /// The place or size of a face on another one depends on a parameter: the common areas of cells
    /// bend where their borders meet.
    Faces { path: FacePathId } = "sensitivity::faces", at Some(Item::FacePath(*path)),
        says format!(
            "the faces that {} joins move with a parameter",
            say(Item::FacePath(*path), "a path")
        ),
        help None;
    /// The melting of a node changes by more than its size.
    Melting { node: NodeId } = "sensitivity::melting", at Some(Item::Node(*node)),
        says format!("how {} melts depends on a parameter", say(Item::Node(*node), "a node")),
        help None;
    /// The ratio of the radii of a round grid depends on a parameter: its rings are cut for one.
    Rings { grid: GridId } = "sensitivity::rings", at Some(Item::Grid(*grid)),
        says format!(
            "`r_in` over `r_out` of {} depends on a parameter",
            say(Item::Grid(*grid), "a grid")
        ),
        help None;
    /// The place of a patch of a face depends on a parameter: shares of heat are numbers.
    Patch { patch: GridPatch } = "sensitivity::patch", at Some(Item::Patch(*patch)),
        says format!(
            "the place of {} on its face depends on a parameter",
            say(Item::Patch(*patch), "a patch")
        ),
        help None;
    /// The specific heat of a fluid depends on its temperature and on a parameter.
    Fluid { fluid: FluidId } = "sensitivity::fluid", at Some(Item::Fluid(*fluid)),
        says format!(
            "the specific heat of {} depends on a parameter and on its temperature",
            say(Item::Fluid(*fluid), "a fluid")
        ),
        help None;
}
}

/// Refuses parameters that move events.
pub(super) fn check_events(influence: &Influence<'_>) -> Result<(), NoTangents> {
    match influence.event() {
        Some(item) => Err(NoTangents::Events { item }),
        None => Ok(()),
    }
}

/// Refuses parameters that move jumps of inputs.
pub(super) fn check_jumps(influence: &Influence<'_>) -> Result<(), NoTangents> {
    match influence.moving_jump() {
        Some(item) => Err(NoTangents::MovingJump { item }),
        None => Ok(()),
    }
}

pub(super) fn check_fluids(network: &Network, influence: &Influence<'_>) -> Result<(), NoTangents> {
    let varying =
        network.fluid_ids().zip(&network.numbers.fluids).filter(|(_, curve)| curve.is_some());
    let mut changing = varying.filter(|(id, _)| influence.value(&network.fluids()[id.index()].cp));
    match changing.next() {
        Some((fluid, _)) => Err(NoTangents::Fluid { fluid }),
        None => Ok(()),
    }
}

/// Refuses runs with pipes: their fluid has a history.
pub(super) fn check_pipes(network: &Network) -> Result<(), NoTangents> {
    match network.pipes().first() {
        Some(pipe) => Err(NoTangents::Pipe { node: pipe.node }),
        None => Ok(()),
    }
}

/// Refuses runs with sampled states: they jump at every sample.
pub(super) fn check_samples(network: &Network) -> Result<(), NoTangents> {
    match network.sampled_states().next() {
        Some((state, _)) => Err(NoTangents::Sampled { state }),
        None => Ok(()),
    }
}

/// Refuses capacities that follow states: their nodes have another balance than heat alone.
pub(super) fn check_capacities(network: &Network) -> Result<(), NoTangents> {
    match network.state_capacities().first() {
        Some(of) => Err(NoTangents::Mass { node: of.node }),
        None => Ok(()),
    }
}

/// Refuses parameters that move faces on one another.
pub(super) fn check_faces(network: &Network, influence: &Influence<'_>) -> Result<(), NoTangents> {
    let paths = network.face_path_ids().zip(network.face_paths());
    let mut moved = paths.filter(|(_, path)| {
        let blocks = network.parts.joined_blocks(path).into_iter().flatten();
        let sizes = blocks.flat_map(|at| network.grids()[at.grid.index()].shape.values());
        let mut values = sizes.chain(path.placement.offset.iter().flatten());
        path.is_moving() && values.any(|value| influence.value(value))
    });
    match moved.next() {
        Some((path, _)) => Err(NoTangents::Faces { path }),
        None => Ok(()),
    }
}

/// Refuses parameters that a patch or its face depends on.
pub(super) fn check_patches(
    network: &Network,
    influence: &Influence<'_>,
) -> Result<(), NoTangents> {
    for (id, grid) in network.grid_ids().zip(network.grids()) {
        let moved = grid.patch_ids(id).find(|patch| {
            let values = grid.values_of_patch(*patch);
            values.into_iter().any(|value| influence.value(value))
        });
        if let Some(patch) = moved {
            return Err(NoTangents::Patch { patch });
        }
    }
    Ok(())
}

/// Refuses parameters that change the ratio of the radii of a round grid.
pub(super) fn check_rings(
    network: &Network,
    influence: &Influence<'_>,
    pass: &mut Pass,
) -> Result<(), NoTangents> {
    for (grid, known) in network.grid_ids().zip(network.grids()) {
        let Shape::Cylinder { r_in: Some(r_in), r_out, .. } = &known.shape else { continue };
        if ![r_in, r_out].into_iter().any(|radius| influence.value(radius)) {
            continue;
        }
        let radii = [r_in, r_out].map(|radius| radius.on(&pass.slots, &mut pass.stack));
        let [Ok(inner), Ok(outer)] = radii else { return Err(NoTangents::Rings { grid }) };
        let slopes = inner.derivatives.iter().zip(outer.derivatives);
        let is_kept = slopes.into_iter().all(|(inner_slope, outer_slope)| {
            let terms = [inner_slope * outer.value, inner.value * outer_slope];
            (terms[0] - terms[1]).abs() <= ROUNDED * (terms[0].abs() + terms[1].abs())
        });
        if !is_kept {
            return Err(NoTangents::Rings { grid });
        }
    }
    Ok(())
}

/// Rounding of the derivatives of a ratio.
const ROUNDED: f64 = 1e-12;

impl NoTangents {
    /// The reason in words, with the name of the item in backquotes.
    pub fn describe(&self, network: &Network) -> String {
        self.message(&|item, _| format!("`{}`", network.name_of(item)))
    }
}

impl fmt::Display for NoTangents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message(&|_, kind| kind.to_owned()))
    }
}

impl std::error::Error for NoTangents {}

impl Problem for NoTangents {
    fn code(&self) -> &'static str {
        self.code()
    }

    fn help(&self) -> Option<String> {
        Some("take differences of runs: `sensitive_run` does so if it has to".to_owned())
    }
}
