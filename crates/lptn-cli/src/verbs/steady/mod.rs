//! `lptn steady`

mod args;
mod periodic;
mod view;

pub(crate) use args::SteadyArgs;

use lptn_analysis::LimitResult;
use lptn_netlist::RunSettings;
use lptn_report::Format;
use lptn_solve::{Selection, SteadyError, SteadyState, Table};
use lptn_units::Unit;
use view::View;

use crate::console::{Console, Detail};
use crate::input::Load as _;
use crate::verdict;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{self, Input};
use lptn_answer::refused::steady_failed;
use lptn_answer::trust;
use lptn_answer::{balance, select};

pub(crate) fn steady(args: &SteadyArgs, console: &Console) -> Result<Exit, Failure> {
    if args.cycle.periodic {
        return periodic::periodic(args, console);
    }
    let phases = &console.phases;
    let input = phases.timed("read", || Input::load(&args.source))?;
    let netlist = &input.netlist;
    let selection = select::of_option(netlist, &args.shown.select)?;
    let unit = input::temperature_unit(args.shown.scale.temperature_unit.as_deref(), netlist)?;
    let balance = balance::end(netlist, args.balance.as_deref(), args.shown.format)?;
    let system = phases.timed("assemble", || input.assemble())?;
    let start = netlist.run.as_ref().map_or(0.0, |run: &RunSettings| run.start);
    let steady = phases.timed("solve", || lptn_analysis::steady(&system, start));
    let steady = steady.map_err(|error| steady_failed(&input, &error))?;
    console.warn(&netlist.files, &netlist.warnings);
    let limits = LimitResult::of_steady(&netlist.network, &steady);
    let limits = limits.map_err(|error| steady_failed(&input, &SteadyError::Input(error)))?;
    let table = table(&input, &steady, &selection, &unit)?;
    let balance = balance.map(|of| steady.balance(&netlist.network, of));
    let view = View {
        input: &input,
        steady: &steady,
        trust: &steady.trust,
        table: &table,
        unit: &unit,
        limits: &limits,
        balance: balance.as_ref(),
        all: args.shown.select.is_empty(),
        fold: args.shown.select.is_empty() && console.detail < Detail::Verbose,
    };
    console.show(&view, args.shown.format)?;
    if args.shown.format == Format::Table {
        view.messages(console);
    } else {
        let hidden = select::hidden(netlist).filter(|_| args.shown.select.is_empty());
        hidden.iter().for_each(|hidden| console.note(hidden));
        console.warn(&netlist.files, &view.doubts());
    }
    console.warn(&netlist.files, &trust::doubts(netlist, &steady.trust, false));
    Ok(verdict::conclude(&view.judgement(), console))
}

fn table(
    input: &Input,
    steady: &SteadyState,
    selection: &Selection,
    unit: &Unit,
) -> Result<Table, Failure> {
    let table = Table::of_steady(&input.netlist.network, steady, selection, unit);
    table.map_err(|error| steady_failed(input, &SteadyError::Input(error)))
}
