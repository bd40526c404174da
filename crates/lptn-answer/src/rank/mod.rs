//! Ranking of values by their effect on a temperature.

mod figure;
mod page;

use std::sync::Arc;

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Diagnostic, Files};
use lptn_network::{Item, NodeId};
use lptn_report::significant;
use lptn_solve::{AdjointError, Influence};
use lptn_study::{RankError, Ranking, effect};
use lptn_units::Unit;

use crate::answer::Answer;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::listener::Listener;
use crate::operating_point;
use crate::refused::{no_run, run_failed, steady_failed};
use crate::words::spaced;

/// Temperature of a node that is ranked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Over {
    /// The one of the steady state.
    #[default]
    Steady,
    /// The highest of the run.
    Run,
}

/// Asks which values affect a temperature most.
#[derive(Clone, Debug, Default)]
pub struct RankQuestion {
    /// The node of the temperature; `None` for the hottest.
    pub node: Option<String>,
    /// The temperature of it that is ranked.
    pub over: Over,
    /// The unit of temperatures; `None` for that of the netlist.
    pub temperature_unit: Option<String>,
}

/// A ranking, and the unit of its temperatures.
#[derive(Debug)]
pub struct RankAnswer {
    input: Arc<Input>,
    /// The change of the temperature by each value.
    pub ranking: Ranking,
    /// The unit of temperatures.
    pub unit: Unit,
    /// Doubts in the state that is ranked.
    doubts: Vec<Diagnostic>,
}

impl Answer for RankAnswer {
    fn files(&self) -> &Files {
        &self.input.netlist.files
    }

    fn doubts(&self) -> Vec<Diagnostic> {
        [self.input.netlist.warnings.as_slice(), &self.doubts].concat()
    }
}

impl RankQuestion {
    /// Asks a netlist.
    ///
    /// # Errors
    /// A node or unit that does not exist, and a state or run that has no slopes.
    pub fn ask(&self, input: Arc<Input>, listener: &dyn Listener) -> Result<RankAnswer, Failure> {
        let unit = input::temperature_unit(self.temperature_unit.as_deref(), &input.netlist)?;
        let node = self.node.as_deref().map(|name| node(&input, name)).transpose()?;
        let system = input.assemble()?;
        let mut doubts = Vec::new();
        let ranking = match self.over {
            Over::Steady => {
                let (steady, of_steady) = operating_point::steady(&input, &unit)?;
                doubts = of_steady;
                Ranking::steady(&system, &steady, node)
            }
            Over::Run => of_run(&input, (&system, node), listener)?,
        };
        let ranking = ranking.map_err(|error| {
            listener.warn(&input.netlist.files, &doubts);
            failed(&input, &error)
        })?;
        Ok(RankAnswer { input, ranking, unit, doubts })
    }
}

fn of_run(
    input: &Input,
    (system, node): (&ThermalSystem, Option<NodeId>),
    listener: &dyn Listener,
) -> Result<Result<Ranking, RankError>, Failure> {
    let settings = input.netlist.run.as_ref().ok_or_else(|| no_run(input))?;
    let listen = |progress| listener.progress(progress);
    Ok(Ranking::of_run(system, (settings, node), &listen))
}

/// The node of this name.
fn node(input: &Input, name: &str) -> Result<NodeId, Failure> {
    input.netlist.network.node(name).map_err(|error| input.failure(&error, None))
}

/// A failure at the place of the value without a slope.
fn failed(input: &Input, error: &RankError) -> Failure {
    match error {
        RankError::Steady(error) => steady_failed(input, error),
        RankError::Run(error) => run_failed(input, error),
        RankError::Adjoint(AdjointError::Linearised(inner)) => {
            input.failure(error, operating_point::place(input, inner))
        }
        RankError::Input(inner) => input.failure(error, input.place_of(inner)),
        _ => input.failure(error, None),
    }
}

impl RankAnswer {
    /// The name of the node whose temperature is ranked.
    fn node(&self) -> &str {
        &self.input.netlist.network.nodes()[self.ranking.node.index()].name
    }

    /// The name of a value: `skin.h`, `h_fan`.
    fn name(&self, influence: &Influence) -> String {
        let own = self.input.netlist.network.name_of(influence.of);
        match influence.of {
            Item::Parameter(_) => own.into_owned(),
            _ => format!("{own}.{}", influence.field.key()),
        }
    }

    /// The value with its unit: a parameter in its own, others in SI units.
    fn value(&self, influence: &Influence) -> (f64, String) {
        let unit = match influence.of {
            Item::Parameter(id) => self.input.unit_of(id),
            _ if influence.absolute => self.unit.clone(),
            _ => return (influence.value, self.dimension(influence)),
        };
        (unit.from_si(influence.value), unit.text.clone())
    }

    /// The change of a value that is ranked: a share, or a small part of its unit if there is none.
    fn change(&self, influence: &Influence) -> String {
        match (influence.absolute, influence.is_zero()) {
            (true, _) => "+1 K".to_owned(),
            (_, false) => "+10 %".to_owned(),
            (_, true) => {
                let (step, unit) = (self.step(influence), self.value(influence).1);
                format!("+{}{}", significant(step, 3), spaced(&unit))
            }
        }
    }

    /// The change of a value of 0, in its unit: the largest of 1, 0.1, 0.01 and so on that changes
    /// the temperature by at most 1 K, so that the slope describes it.
    fn step(&self, zero: &Influence) -> f64 {
        let decades = (zero.change * self.scale(zero)).abs().max(1.0).log10().ceil();
        1.0 / 10_f64.powf(decades)
    }

    /// The unit of a value that is not a temperature, in SI units.
    fn scale(&self, influence: &Influence) -> f64 {
        match influence.of {
            Item::Parameter(id) => self.input.unit_of(id).scale,
            _ => 1.0,
        }
    }

    /// The change of the temperature by that, in the unit of its differences.
    fn effect(&self, influence: &Influence) -> f64 {
        let kelvin = match influence.is_zero() {
            true => influence.change * self.scale(influence) * self.step(influence),
            false => effect(influence),
        };
        kelvin / self.unit.scale
    }

    fn dimension(&self, influence: &Influence) -> String {
        influence.ty.dimension.si_unit()
    }
}
