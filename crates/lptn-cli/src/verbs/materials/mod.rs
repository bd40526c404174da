//! `lptn materials`

mod args;

pub(crate) use args::MaterialsArgs;

use std::io;

use lptn_netlist::Diagnostic;
use lptn_netlist::library::{self, LibrarySubstance};
use lptn_report::{Json, Page, Rows, Text, TextTable, significant};
use lptn_study::SiValue;
use serde_json::{Value, json};

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;

/// Digits that are shown: the sources give no more.
const DIGITS: usize = 5;

pub(crate) fn materials(args: &MaterialsArgs, console: &Console) -> Result<Exit, Failure> {
    let (materials, fluids) = match &args.name {
        None => (all(library::materials()), all(library::fluids())),
        Some(name) => one(name)?,
    };
    let found = Found { materials, fluids, named: args.name.is_some() };
    console.show(&found, args.printed.format)
}

type Records = Vec<&'static LibrarySubstance>;

fn all(records: &'static [LibrarySubstance]) -> Records {
    records.iter().collect()
}

fn one(name: &str) -> Result<(Records, Records), Failure> {
    let of = |records: &'static [LibrarySubstance]| {
        records.iter().filter(|r| r.name == name).collect::<Records>()
    };
    let found = (of(library::materials()), of(library::fluids()));
    if found.0.is_empty() && found.1.is_empty() {
        return Err(unknown(name));
    }
    Ok(found)
}

fn unknown(name: &str) -> Failure {
    let problem =
        Diagnostic::error("materials::unknown", format!("the library has no material `{name}`"));
    let names =
        library::materials().iter().chain(library::fluids()).map(|record| record.name.as_str());
    let all = || "`lptn materials` lists them all".into();
    Failure::new(Exit::Input, problem.did_you_mean(name, names, all))
}

fn number(value: Option<f64>) -> String {
    value.map_or("-".into(), |value| significant(value, DIGITS))
}

/// The records that were asked for.
struct Found {
    materials: Records,
    fluids: Records,
    /// Whether by name.
    named: bool,
}

impl Page for Found {
    fn text(&self) -> Text {
        let mut text = Text::new();
        if self.named {
            self.materials
                .iter()
                .chain(&self.fluids)
                .for_each(|record| describe(record, &mut text));
            return text;
        }
        text.table(table("material", &self.materials));
        text.section().table(table("fluid", &self.fluids));
        text.section().sentence(
            "",
            "Sources and states: lptn materials NAME, or --format csv. In a netlist: \
             material = \"steel_8620\", with mass or volume.",
        );
        text
    }

    fn rows(&self) -> Rows<'_> {
        Rows::Words(rows(&self.materials, &self.fluids))
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        json.member("format", &1)?;
        json.member("materials", &members(&self.materials))?;
        json.member("fluids", &members(&self.fluids))
    }
}

fn table(title: &str, records: &[&LibrarySubstance]) -> TextTable {
    TextTable::of(records)
        .left(title, |r| r.name.as_str())
        .right("kg/m^3", |r| number(r.density))
        .right("J/(kg K)", |r| number(r.cp))
        .right("W/(m K)", |r| number(r.k))
        .left("", |r| short(&r.title))
        .optional()
        .into()
}

/// A title that leaves room for the numbers.
fn short(title: &str) -> String {
    title.split([',', ';', '(']).next().unwrap_or(title).trim().to_owned()
}

fn describe(record: &LibrarySubstance, text: &mut Text) {
    text.line(format!("{}: {}", record.name, record.title));
    text.section();
    let lines = [
        ("density", record.density, "kg/m^3"),
        ("specific heat cp", record.cp, "J/(kg K)"),
        ("conductivity k", record.k, "W/(m K)"),
        ("temperature", record.temperature, "K"),
    ];
    for (label, value, unit) in lines {
        text.lines(value.map(|value| format!("{label:22}{} {unit}", significant(value, DIGITS))));
    }
    text.sentence(&format!("{:22}", "source"), &record.source);
}

fn rows(materials: &[&LibrarySubstance], fluids: &[&LibrarySubstance]) -> Vec<Vec<String>> {
    let heading = [
        "name",
        "kind",
        "density [kg/m^3]",
        "cp [J/(kg K)]",
        "k [W/(m K)]",
        "T [K]",
        "title",
        "source",
    ];
    let cell = |value: Option<f64>| value.map_or(String::new(), lptn_units::format_number);
    let row = |kind: &str, r: &LibrarySubstance| {
        let numbers = [r.density, r.cp, r.k, r.temperature].map(cell);
        let words = [r.name.clone(), kind.to_owned()];
        words.into_iter().chain(numbers).chain([r.title.clone(), r.source.clone()]).collect()
    };
    std::iter::once(heading.map(str::to_owned).to_vec())
        .chain(materials.iter().map(|r| row("material", r)))
        .chain(fluids.iter().map(|r| row("fluid", r)))
        .collect()
}

fn members(records: &[&LibrarySubstance]) -> Value {
    let scalar = |value: Option<f64>, unit: &str| value.map(|value| SiValue::new(value, unit));
    let member = |record: &&LibrarySubstance| {
        let value = json!({
            "title": record.title,
            "density": scalar(record.density, "kg/m^3"),
            "cp": scalar(record.cp, "J/(kg K)"),
            "k": scalar(record.k, "W/(m K)"),
            "T": scalar(record.temperature, "K"),
            "source": record.source,
        });
        (record.name.clone(), value)
    };
    records.iter().map(member).collect()
}
