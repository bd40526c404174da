//! `--balance`: heat into and out of one node or boundary, largest path first.

use lptn_netlist::{Diagnostic, Files, Netlist, Span};
use lptn_network::{End, Item, Network};
use lptn_report::{
    Format, Text, TextTable, TextTableOf, decimals, duration, fixed, prefix, significant,
};
use lptn_solve::{Balance, Term};
use lptn_study::SiValue;
use lptn_units::suggest;
use serde_json::{Value, json};

use crate::exit::Exit;
use crate::failure::Failure;

/// The node or boundary that the option names.
pub fn end(netlist: &Netlist, name: Option<&str>, format: Format) -> Result<Option<End>, Failure> {
    let Some(name) = name else { return Ok(None) };
    if format == Format::Csv {
        let message = "--balance is shown in the table and in JSON: CSV has columns only";
        return Err(Failure::refused(
            "balance::csv",
            message,
            "leave out `--format csv`, or write json",
        ));
    }
    let network = &netlist.network;
    match network.item(name.strip_suffix(".T").unwrap_or(name)) {
        Ok(Item::Node(id)) => Ok(Some(End::Node(id))),
        Ok(Item::Boundary(id)) => Ok(Some(End::Boundary(id))),
        found => Err(unknown(network, name, found.ok())),
    }
}

fn unknown(network: &Network, name: &str, found: Option<Item>) -> Failure {
    let mut files = Files::new();
    let file = files.add("--balance", name);
    let problem = Diagnostic::error(
        "balance::unknown_node",
        format!("no node or boundary is named `{name}`"),
    )
    .at(Span::new(file, 0..name.len()), "");
    let nodes = network.thermal_nodes().map(|id| network.nodes()[id.index()].name.as_str());
    let names: Vec<&str> =
        nodes.chain(network.boundaries().iter().map(|b| b.name.as_str())).collect();
    const SHOWN: usize = 8;
    let list = |names: &[&str]| {
        names.iter().take(SHOWN).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
    };
    let help = match (found, suggest(name, names.iter().copied())) {
        (Some(Item::Conductor(id)), _) => {
            let c = &network.conductors()[id.index()];
            let ends = [c.from, c.to].map(|end| network.name_of(end.into()));
            format!(
                "`{name}` is a path between {}: name one of them",
                ends.map(|e| format!("`{e}`")).join(" and ")
            )
        }
        (Some(Item::Source(id)), _) => {
            let into = network.heated_places(id);
            let into: Vec<&str> = into.iter().map(String::as_str).collect();
            format!("`{name}` is a source into {}", list(&into))
        }
        (_, Some(near)) => format!("did you mean `{near}`?"),
        (_, None) => format!("its nodes and boundaries are {}", list(&names)),
    };
    Failure::at(Exit::Input, files, problem.help(help))
}

/// A line of the table: a term with its name and its other end, or the sum of all.
/// Power in W, heat in J.
struct Line {
    name: String,
    other: String,
    power: f64,
    heat: f64,
}

/// Adds a column of amounts in one unit, and one of their percentages of `turned_over`.
fn amounts<'a>(
    table: TextTableOf<'a, Line>,
    (when, unit, turned_over): (String, &str, f64),
    value: fn(&Line) -> f64,
) -> TextTableOf<'a, Line> {
    let (scale, letter) = prefix(turned_over);
    let digits = decimals(turned_over / scale, 4, 0);
    let share = |line: &Line| match turned_over > 0.0 {
        true => fixed(100.0 * value(line) / turned_over, 1),
        false => "-".into(),
    };
    let table =
        table.right(format!("{when} [{letter}{unit}]"), |line| fixed(value(line) / scale, digits));
    table.right("%", share)
}

/// The balance as a section; `times` are start and end of the run in s, none for a steady state.
pub fn section(
    text: &mut Text,
    network: &Network,
    (balance, times): (&Balance, Option<(f64, f64)>),
) {
    let line = |term: &Term| Line {
        name: network.name_of(term.item).into_owned(),
        other: other(network, term),
        power: term.power,
        heat: term.heat.unwrap_or(f64::NAN),
    };
    let sum = Line {
        name: rest(balance, times.is_none()).to_owned(),
        other: String::new(),
        power: balance.power(),
        heat: balance.stored.unwrap_or(f64::NAN),
    };
    let lines: Vec<Line> = balance.largest_first().iter().map(line).chain([sum]).collect();
    let when = times.map_or("steady".to_owned(), |(_, end)| format!("at {}", duration(end, 4)));
    let table = TextTable::of(&lines)
        .left(format!("heat into {}", network.name_of(balance.of.into())), |line| {
            line.name.as_str()
        })
        .left("", |line| line.other.as_str())
        .names();
    let mut table = amounts(table, (when, "W", balance.power_turned_over()), |line| line.power);
    if let (Some((start, end)), Some(_), Some(all)) =
        (times, balance.stored, balance.heat_turned_over())
    {
        let over = format!("over {}", duration(end - start, 4));
        table = amounts(table, (over, "J", all), |line| line.heat);
    }
    text.section().table(table);
    text.line("positive: into it; 100 % is all heat in or all heat out, the larger of the two");
    text.lines(
        open(balance).map(|open| {
            format!("the paths and the stored heat differ by {} J", significant(open, 2))
        }),
    );
}

/// Name of the sum of all paths and sources.
fn rest(balance: &Balance, steady: bool) -> &'static str {
    match balance.of {
        End::Node(_) if steady => "sum",
        End::Node(_) => "= stored",
        End::Boundary(_) => "= taken",
    }
}

/// Residual of the balance in J if it exceeds 1e-4 of the heat turned over.
fn open(balance: &Balance) -> Option<f64> {
    let residual = balance.heat()? - balance.stored?;
    (residual.abs() > 1e-4 * balance.heat_turned_over()?).then_some(residual)
}

fn other(network: &Network, term: &Term) -> String {
    match term.other {
        Some(end) => {
            let way = if term.heat.unwrap_or(term.power) < 0.0 { "to" } else { "from" };
            format!("{way} {}", place(network, term, end))
        }
        None => "source".into(),
    }
}

/// The name of an end; that of the face for a path to all its cells.
fn place(network: &Network, term: &Term, end: End) -> String {
    match (term.item, end) {
        (Item::FacePath(_), End::Node(id)) => network.place_name(id),
        _ => network.name_of(end.into()).into_owned(),
    }
}

/// `{ of, terms, power, heat, stored, … }` with a term
/// `{ name, other, power, power_share, heat, heat_share }` each, in SI, largest first.
pub fn json(network: &Network, balance: &Balance) -> Value {
    let scalar = SiValue::new;
    let heat = |value: Option<f64>| value.map(|value| scalar(value, "J"));
    let share = |value: f64, all: f64| (all > 0.0).then(|| scalar(value / all, "1"));
    let (power, all) = (balance.power_turned_over(), balance.heat_turned_over());
    let term = |term: &Term| {
        let shares = term.heat.zip(all).and_then(|(heat, all)| share(heat, all));
        json!({
            "name": network.name_of(term.item),
            "other": term.other.map(|end| place(network, term, end)),
            "power": scalar(term.power, "W"),
            "power_share": share(term.power, power),
            "heat": heat(term.heat),
            "heat_share": shares,
        })
    };
    json!({
        "of": network.name_of(balance.of.into()),
        "terms": balance.largest_first().iter().map(term).collect::<Vec<_>>(),
        "power": scalar(balance.power(), "W"),
        "power_turned_over": scalar(power, "W"),
        "heat": heat(balance.heat()),
        "heat_turned_over": heat(all),
        "stored": heat(balance.stored),
    })
}
