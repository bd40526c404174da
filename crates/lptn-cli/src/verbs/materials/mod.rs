//! `lptn materials`

mod args;

pub(crate) use args::MaterialsArgs;

use std::io;

use lptn_netlist::Diagnostic;
use lptn_netlist::library::{self, LibraryLubricant, LibrarySubstance};
use lptn_report::{Json, Page, RowColumn, Rows, Text, TextTable, significant};
use lptn_study::SiValue;
use serde_json::{Value, json};

use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;

/// Names and units of the columns of numbers.
const NUMBERS: [(&str, &str); 5] = [
    ("density", "kg/m^3"),
    ("cp", "J/(kg K)"),
    ("k", "W/(m K)"),
    ("k_through", "W/(m K)"),
    ("T", "K"),
];

/// Digits that are shown: the sources give no more.
const DIGITS: usize = 5;

pub(crate) fn materials(args: &MaterialsArgs, console: &Console) -> Result<Exit, Failure> {
    let name = args.name.as_deref();
    let asked = |other: &str| name.is_none_or(|name| name == other);
    let of = |records: &'static [LibrarySubstance]| {
        records.iter().filter(|record| asked(&record.name)).collect::<Records>()
    };
    let found = Found {
        materials: of(library::materials()),
        fluids: of(library::fluids()),
        lubricants: library::lubricants().filter(|oil| asked(&oil.name)).collect(),
        named: name.is_some(),
    };
    match name {
        Some(name) if found.is_empty() => Err(unknown(name)),
        _ => console.show(&found, args.printed.format),
    }
}

type Records = Vec<&'static LibrarySubstance>;

fn unknown(name: &str) -> Failure {
    let problem =
        Diagnostic::error("materials::unknown", format!("the library has no material `{name}`"));
    let substances = library::materials().iter().chain(library::fluids());
    let names = substances.map(|record| record.name.clone());
    let names: Vec<String> = names.chain(library::lubricants().map(|oil| oil.name)).collect();
    let parts: Vec<String> = names.iter().filter(|own| own.contains(name)).cloned().collect();
    let all = || match parts.is_empty() {
        true => "`lptn materials` lists them all".into(),
        false => format!("its names with `{name}` are `{}`", parts.join("`, `")),
    };
    Failure::new(Exit::Input, problem.did_you_mean(name, names.iter().map(String::as_str), all))
}

fn number(value: Option<f64>) -> String {
    value.map_or("-".into(), |value| significant(value, DIGITS))
}

/// The records that were requested.
struct Found {
    materials: Records,
    fluids: Records,
    lubricants: Vec<LibraryLubricant>,
    /// True if they were requested by name.
    named: bool,
}

impl Found {
    fn is_empty(&self) -> bool {
        self.materials.is_empty() && self.fluids.is_empty() && self.lubricants.is_empty()
    }
}

impl Page for Found {
    fn text(&self) -> Text {
        let mut text = Text::new();
        if self.named {
            self.materials
                .iter()
                .chain(&self.fluids)
                .for_each(|record| describe(record, &mut text));
            self.lubricants.iter().for_each(|oil| describe_oil(oil, &mut text));
            return text;
        }
        text.table(table("material", &self.materials));
        text.section().table(table("fluid", &self.fluids));
        text.section().table(oils(&self.lubricants));
        text.section().sentence(
            "",
            "Sources and states: lptn materials NAME, or --format csv. In a netlist: \
             material = \"steel_8620\", with mass or volume; lubricant = \"iso_vg_220\".",
        );
        text
    }

    fn rows(&self) -> Rows<'_> {
        Rows::Columns(rows(self))
    }

    fn json(&self, json: &mut Json<'_>) -> io::Result<()> {
        json.member("format", &1)?;
        json.member("materials", &members(&self.materials))?;
        json.member("fluids", &members(&self.fluids))?;
        json.member("lubricants", &oil_members(&self.lubricants))
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

fn oils(oils: &[LibraryLubricant]) -> TextTable {
    TextTable::of(oils)
        .left("lubricant", |oil| oil.name.as_str())
        .right("mm^2/s at 40 degC", |oil| significant(oil.viscosity[0] * 1e6, DIGITS))
        .right("at 100 degC", |oil| significant(oil.viscosity[1] * 1e6, 4))
        .right("kg/m^3", |oil| significant(oil.density, DIGITS))
        .left("", |oil| oil.title.as_str())
        .optional()
        .into()
}

fn describe_oil(oil: &LibraryLubricant, text: &mut Text) {
    text.line(format!("{}: {}", oil.name, oil.title));
    text.section();
    let [nu_40, nu_100] = oil.viscosity.map(|nu| significant(nu * 1e6, 4));
    text.line(format!("{:22}{nu_40} mm^2/s at 40 degC, {nu_100} mm^2/s at 100 degC", "viscosity"));
    text.line(format!("{:22}{} kg/m^3", "density at 15 degC", significant(oil.density, DIGITS)));
    text.sentence(&format!("{:22}", "source"), &oil.source);
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
        ("k through plane", record.k_through, "W/(m K)"),
        ("temperature", record.temperature, "K"),
    ];
    for (label, value, unit) in lines {
        text.lines(value.map(|value| format!("{label:22}{} {unit}", significant(value, DIGITS))));
    }
    text.sentence(&format!("{:22}", "source"), &record.source);
}

/// A record of any kind as a row.
struct Row<'a> {
    words: [&'a str; 2],
    /// Density, cp, k, k through the plane, temperature.
    numbers: [Option<f64>; 5],
    title: String,
    source: &'a str,
}

impl<'a> Row<'a> {
    fn substance(kind: &'a str, r: &'a LibrarySubstance) -> Self {
        Row {
            words: [&r.name, kind],
            numbers: [r.density, r.cp, r.k, r.k_through, r.temperature],
            title: r.title.clone(),
            source: &r.source,
        }
    }

    /// The viscosities are in the title, so that the columns stay the same.
    fn oil(oil: &'a LibraryLubricant) -> Self {
        let [nu_40, nu_100] = oil.viscosity.map(|nu| significant(nu * 1e6, 4));
        Row {
            words: [&oil.name, "lubricant"],
            numbers: [Some(oil.density), None, None, None, None],
            title: format!("{}, {nu_40} mm^2/s at 40 degC, {nu_100} mm^2/s at 100 degC", oil.title),
            source: &oil.source,
        }
    }
}

fn rows(found: &Found) -> Vec<RowColumn<'static>> {
    let materials = found.materials.iter().map(|record| Row::substance("material", record));
    let fluids = found.fluids.iter().map(|record| Row::substance("fluid", record));
    let oils = found.lubricants.iter().map(Row::oil);
    let rows: Vec<Row<'_>> = materials.chain(fluids).chain(oils).collect();
    let words = |name: &str, cell: &dyn Fn(&Row<'_>) -> String| {
        RowColumn::words(name, rows.iter().map(cell).collect::<Vec<String>>())
    };
    let numbers = |(place, (name, unit)): (usize, (&str, &str))| {
        let cell = |row: &Row<'_>| row.numbers[place].unwrap_or(f64::NAN);
        RowColumn::numbers(name, unit, rows.iter().map(cell).collect::<Vec<f64>>())
    };
    let mut columns =
        vec![words("name", &|r| r.words[0].to_owned()), words("kind", &|r| r.words[1].to_owned())];
    columns.extend(NUMBERS.into_iter().enumerate().map(numbers));
    columns.extend([words("title", &|r| r.title.clone()), words("source", &|r| r.source.into())]);
    columns
}

fn oil_members(oils: &[LibraryLubricant]) -> Value {
    let member = |oil: &LibraryLubricant| {
        let value = json!({
            "title": oil.title,
            "nu_40": SiValue::new(oil.viscosity[0], "m^2/s"),
            "nu_100": SiValue::new(oil.viscosity[1], "m^2/s"),
            "density": SiValue::new(oil.density, "kg/m^3"),
            "source": oil.source,
        });
        (oil.name.clone(), value)
    };
    oils.iter().map(member).collect()
}

fn members(records: &[&LibrarySubstance]) -> Value {
    let scalar = |value: Option<f64>, unit: &str| value.map(|value| SiValue::new(value, unit));
    let member = |record: &&LibrarySubstance| {
        let value = json!({
            "title": record.title,
            "density": scalar(record.density, "kg/m^3"),
            "cp": scalar(record.cp, "J/(kg K)"),
            "k": scalar(record.k, "W/(m K)"),
            "k_through": scalar(record.k_through, "W/(m K)"),
            "T": scalar(record.temperature, "K"),
            "source": record.source,
        });
        (record.name.clone(), value)
    };
    records.iter().map(member).collect()
}
