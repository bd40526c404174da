//! `lptn rank`

mod args;
mod figure;
mod page;

pub(crate) use args::RankArgs;

use args::Over;
use lptn_assembly::ThermalSystem;
use lptn_network::{Item, NodeId};
use lptn_solve::AdjointError;
use lptn_study::{RankError, Ranking};
use lptn_units::Unit;

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::{self, Input};
use crate::interrupt::Interrupt;
use crate::operating_point;
use crate::progress::ProgressLine;
use crate::verbs::run::job::{self, no_run};
use crate::verbs::steady;

pub(crate) fn rank(args: &RankArgs, console: &Console) -> Result<Exit, Failure> {
    let input = Input::load(&args.source)?;
    let unit = input::temperature_unit(args.scale.temperature_unit.as_deref(), &input.netlist)?;
    let node = args.of.as_deref().map(|name| node(&input, name)).transpose()?;
    let system = input.assemble()?;
    let ranking = match args.over {
        Over::Steady => {
            let steady = operating_point::steady(&input, &unit, console)?;
            Ranking::steady(&system, &steady, node)
        }
        Over::Run => of_run(&input, (&system, node), console)?,
    };
    let ranking = ranking.map_err(|error| failed(&input, &error))?;
    console.warn(&input.netlist.files, &input.netlist.warnings);
    console.show(&View { input: &input, ranking, unit }, args.printed.format)
}

fn of_run(
    input: &Input,
    (system, node): (&ThermalSystem, Option<NodeId>),
    console: &Console,
) -> Result<Result<Ranking, RankError>, Failure> {
    let settings = input.netlist.run.as_ref().ok_or_else(|| no_run(input))?;
    let interrupt = Interrupt::listen();
    let line = std::cell::RefCell::new(ProgressLine::new(console.quiet));
    let ranking = Ranking::of_run(system, (settings, node), &|progress| {
        line.borrow_mut().update(progress);
        interrupt.control()
    });
    line.borrow_mut().clear();
    Ok(ranking)
}

/// The node that `--of` names.
fn node(input: &Input, name: &str) -> Result<NodeId, Failure> {
    input.netlist.network.node(name).map_err(|error| input.failure(&error, None))
}

/// With the place of what has no slope.
fn failed(input: &Input, error: &RankError) -> Failure {
    match error {
        RankError::Steady(error) => steady::failed(input, error),
        RankError::Run(error) => job::failed(input, error),
        RankError::Adjoint(AdjointError::Linearised(inner)) => {
            input.failure(error, operating_point::place(input, inner))
        }
        RankError::Input(inner) => input.failure(error, input.place_of(inner)),
        _ => input.failure(error, None),
    }
}

/// A ranking and how it is shown.
struct View<'a> {
    input: &'a Input,
    ranking: Ranking,
    unit: Unit,
}

impl View<'_> {
    /// The name of the node that answers.
    fn node(&self) -> &str {
        &self.input.netlist.network.nodes()[self.ranking.node.index()].name
    }

    /// What a value belongs to: `skin.h`, `h_fan`.
    fn name(&self, influence: &lptn_solve::Influence) -> String {
        let own = self.input.netlist.network.name_of(influence.of);
        match influence.of {
            Item::Parameter(_) => own.into_owned(),
            _ => format!("{own}.{}", influence.field.key()),
        }
    }

    /// The value with its unit: a parameter in its own, others in SI units.
    fn value(&self, influence: &lptn_solve::Influence) -> (f64, String) {
        let unit = match influence.of {
            Item::Parameter(id) => self.input.unit_of(id),
            _ if influence.absolute => self.unit.clone(),
            _ => return (influence.value, self.dimension(influence)),
        };
        (unit.from_si(influence.value), unit.text.clone())
    }

    fn dimension(&self, influence: &lptn_solve::Influence) -> String {
        influence.ty.dimension.si_unit()
    }
}
