//! What is kept of a fit of a network that was interrupted.

use lptn_fit::network::{FitStage, NetworkFitTask};
use lptn_report::{Format, Text, TextTable, significant};

use super::NetworkArgs;
use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::{Input, quoted};
use lptn_answer::words::spaced;

/// Digits with which a search goes on from where it was.
const DIGITS: usize = 8;

/// Shows the best values so far, and how to go on from them.
pub(crate) fn tell(
    (input, task): (&Input, &NetworkFitTask<'_>),
    (stage, best): (FitStage, Option<Vec<f64>>),
    (args, console): (&NetworkArgs, &Console),
) -> Result<Exit, Failure> {
    let Some(best) = best else {
        console.message(&format!("interrupted in {stage}: nothing is fitted"));
        return Ok(Exit::Interrupted);
    };
    let values: Vec<[String; 3]> = task
        .parameters
        .iter()
        .zip(&best)
        .map(|(varied, si)| cells(input, varied.parameter, *si))
        .collect();
    if args.printed.format == Format::Table {
        let mut text = Text::new();
        let table = TextTable::of(&values).left("parameter", |cells| &cells[0]).names();
        text.table(table.right("best so far", |cells| &cells[1]).left("unit", |cells| &cells[2]));
        console.page(&text, Format::Table)?;
    }
    let mut message = format!(
        "interrupted in {stage}: these values are not a result, and have no standard errors"
    );
    if let Some(file) = input.typed() {
        let study = args.name.as_ref().map_or(String::new(), |name| format!(" {}", quoted(name)));
        message += &format!("\ngo on from them: lptn fit network {file}{study}");
        for [name, value, unit] in &values {
            let unit = spaced(unit);
            message += &format!(" --set {}", quoted(&format!("{name}={value}{unit}")));
        }
    }
    console.message(&message);
    Ok(Exit::Interrupted)
}

/// Name, value and unit of a parameter.
fn cells(input: &Input, parameter: lptn_network::ParameterId, si: f64) -> [String; 3] {
    let unit = input.unit_of(parameter);
    let name = &input.netlist.network.parameters()[parameter.index()].name;
    [name.clone(), significant(unit.from_si(si), DIGITS), unit.text]
}
