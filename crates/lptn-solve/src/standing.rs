//! States whose rate reads nothing that a steady state determines: an integral at its bound, a
//! state of charge at rest.
//!
//! Such a state stays where it is if its rate is zero; otherwise it changes without end. So does one
//! that nothing reads, such as the energy lost so far.

use lptn_assembly::{JacobianForm, ThermalSystem, Workspace};
use lptn_integrate::Pattern;
use lptn_network::State;

use crate::error::SteadyError;

/// A rate in scales of the state per second below this is zero: 1e-12 of its size.
const AT_REST: f64 = 1e-10;

/// The unknowns that Newton's method solves for at these temperatures of all of them, in K: all but
/// states at rest whose rate nothing changes.
///
/// # Errors
/// [`SteadyError::Drifts`] for a state that changes whatever the temperatures are.
pub(crate) fn free(
    system: &ThermalSystem,
    work: &mut Workspace,
    unknowns: &[f64],
) -> Result<Vec<usize>, SteadyError> {
    let all = 0..unknowns.len();
    if system.network().states().is_empty() {
        return Ok(all.collect());
    }
    let mut values = vec![0.0; system.pattern().entries()];
    system.jacobian_at(work, unknowns, JacobianForm::Exact, &mut values)?;
    let mut flow = vec![0.0; unknowns.len()];
    system.flow(work, unknowns, &mut flow)?;
    let pattern = Pattern::from_symbolic(system.pattern().symbolic());
    let mut reads = vec![false; unknowns.len()];
    for column in all.clone() {
        for slot in pattern.column(column) {
            reads[pattern.row_indices()[slot]] |= values[slot] != 0.0;
        }
    }
    let mut free = Vec::new();
    for unknown in all {
        let state = system.network().state_at(system.unknowns()[unknown]);
        if is_counter(system, unknown) {
            continue;
        }
        match state.filter(|state| !state.balanced && !reads[unknown]) {
            None => free.push(unknown),
            Some(state) => at_rest(state, flow[unknown])?,
        }
    }
    Ok(free)
}

/// Checks that all other unknowns rest at these temperatures too, in K.
///
/// # Errors
/// [`SteadyError::Drifts`] for a state that rested only where the search began.
pub(crate) fn still(
    system: &ThermalSystem,
    work: &mut Workspace,
    unknowns: &[f64],
    free: &[usize],
) -> Result<(), SteadyError> {
    if free.len() == unknowns.len() {
        return Ok(());
    }
    let mut flow = vec![0.0; unknowns.len()];
    system.flow(work, unknowns, &mut flow)?;
    let held = (0..unknowns.len()).filter(|unknown| free.binary_search(unknown).is_err());
    let held = held.filter(|unknown| !is_counter(system, *unknown));
    for unknown in held {
        if let Some(state) = system.network().state_at(system.unknowns()[unknown]) {
            at_rest(state, flow[unknown])?;
        }
    }
    Ok(())
}

/// A change of a state by its size, in K.
const SIZE: f64 = 100.0;

/// True for a state that no rate and no heat reads, its own rate included: an integral of something
/// else. The others can be solved without it.
pub(crate) fn is_unread(
    system: &ThermalSystem,
    work: &mut Workspace,
    unknowns: &[f64],
    unknown: usize,
) -> Result<bool, SteadyError> {
    let state = system.unknowns().get(unknown).and_then(|node| system.network().state_at(*node));
    if state.is_none_or(|state| state.balanced) {
        return Ok(false);
    }
    let mut flow = |by: f64| -> Result<Vec<f64>, SteadyError> {
        let (mut moved, mut flow) = (unknowns.to_vec(), vec![0.0; unknowns.len()]);
        moved[unknown] += by;
        system.flow(work, &moved, &mut flow)?;
        Ok(flow)
    };
    let here = flow(0.0)?;
    Ok(flow(SIZE)? == here && flow(-SIZE)? == here)
}

/// True for the state that counts the fluid of a pipe: it goes on while the temperatures rest.
pub(crate) fn is_counter(system: &ThermalSystem, unknown: usize) -> bool {
    let (network, node) = (system.network(), system.unknowns()[unknown]);
    network.pipes().iter().any(|pipe| network.counter_of(pipe) == node)
}

/// Checks the flow into the node of a state, in W.
fn at_rest(state: &State, flow: f64) -> Result<(), SteadyError> {
    if flow.abs() <= AT_REST {
        return Ok(());
    }
    let unit = state.ty.dimension.si_unit();
    Err(SteadyError::Drifts { name: state.name.clone(), rate: state.value(flow), unit })
}
