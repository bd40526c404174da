//! `lptn materials`

mod args;

pub(crate) use args::MaterialsArgs;

use lptn_netlist::Diagnostic;
use lptn_netlist::library::{self, Record};
use lptn_report::{Align, Column, JsonWriter, TextTable, WIDTH, labelled, significant, write_rows};
use lptn_study::Scalar;
use lptn_units::suggest;
use serde_json::{Map, Value, json};

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::options::Format;

/// Digits that are shown: the sources give no more.
const DIGITS: usize = 5;

pub(crate) fn materials(args: &MaterialsArgs, console: &Console) -> Result<Exit, Failure> {
    let (materials, fluids) = match &args.name {
        None => (all(library::materials()), all(library::fluids())),
        Some(name) => one(name)?,
    };
    match args.printed.format {
        Format::Table if args.name.is_some() => {
            let texts: Vec<String> =
                materials.iter().chain(&fluids).map(|record| described(record)).collect();
            console.print(&texts.concat())
        }
        Format::Table => console.print(&list(&materials, &fluids)),
        Format::Csv => {
            console.write(|out| write_rows(&rows(&materials, &fluids), out))?;
            Ok(Exit::Done)
        }
        Format::Json => {
            console.write(|out| {
                let mut json = JsonWriter::new(out);
                json.member("format", &json!(1))?;
                json.member("materials", &members(&materials))?;
                json.member("fluids", &members(&fluids))?;
                json.finish().map(drop)
            })?;
            Ok(Exit::Done)
        }
    }
}

type Records = Vec<&'static Record>;

fn all(records: &'static [Record]) -> Records {
    records.iter().collect()
}

fn one(name: &str) -> Result<(Records, Records), Failure> {
    let of = |records: &'static [Record]| records.iter().filter(|r| r.name == name).collect::<Records>();
    let found = (of(library::materials()), of(library::fluids()));
    if found.0.is_empty() && found.1.is_empty() {
        return Err(unknown(name));
    }
    Ok(found)
}

fn unknown(name: &str) -> Failure {
    let problem = Diagnostic::error("materials::unknown", format!("the library has no material `{name}`"));
    let names = library::materials().iter().chain(library::fluids()).map(|record| record.name.as_str());
    let help = match suggest(name, names) {
        Some(near) => format!("did you mean `{near}`?"),
        None => "`lptn materials` lists them all".into(),
    };
    Failure::new(Exit::Input, problem.help(help))
}

fn number(value: Option<f64>) -> String {
    value.map_or("-".into(), |value| significant(value, DIGITS))
}

fn list(materials: &[&Record], fluids: &[&Record]) -> String {
    let mut lines = table("material", materials);
    lines.push(String::new());
    lines.extend(table("fluid", fluids));
    let note = "Sources and states: lptn materials NAME, or --format csv. In a netlist: \
                material = \"steel_8620\", with mass or volume.";
    lines.push(String::new());
    lines.extend(labelled("", &note.split(' ').map(str::to_owned).collect::<Vec<_>>(), WIDTH));
    lines.join("\n") + "\n"
}

fn table(title: &str, records: &[&Record]) -> Vec<String> {
    let column = |title: &str, align, text: &dyn Fn(&Record) -> String| {
        Column::new(title, align, records.iter().map(|record| text(record)).collect())
    };
    TextTable::new(vec![
        column(title, Align::Left, &|r| r.name.clone()),
        column("kg/m^3", Align::Right, &|r| number(r.density)),
        column("J/(kg K)", Align::Right, &|r| number(r.cp)),
        column("W/(m K)", Align::Right, &|r| number(r.k)),
        column("", Align::Left, &|r| short(&r.title)).optional(),
    ])
    .lines(WIDTH)
}

/// A title that leaves room for the numbers.
fn short(title: &str) -> String {
    title.split([',', ';', '(']).next().unwrap_or(title).trim().to_owned()
}

fn described(record: &Record) -> String {
    let line = |label: &str, value: Option<f64>, unit: &str| {
        value.map(|value| format!("{label:22}{} {unit}", significant(value, DIGITS)))
    };
    let mut lines = vec![format!("{}: {}", record.name, record.title), String::new()];
    lines.extend(line("density", record.density, "kg/m^3"));
    lines.extend(line("specific heat cp", record.cp, "J/(kg K)"));
    lines.extend(line("conductivity k", record.k, "W/(m K)"));
    lines.extend(line("temperature", record.temperature, "K"));
    let words: Vec<String> = record.source.split(' ').map(str::to_owned).collect();
    lines.extend(labelled(&format!("{:22}", "source"), &words, WIDTH));
    lines.join("\n") + "\n"
}

fn rows(materials: &[&Record], fluids: &[&Record]) -> Vec<Vec<String>> {
    let heading =
        ["name", "kind", "density [kg/m^3]", "cp [J/(kg K)]", "k [W/(m K)]", "T [K]", "title", "source"];
    let cell = |value: Option<f64>| value.map_or(String::new(), lptn_units::format_number);
    let row = |kind: &str, r: &Record| {
        let numbers = [r.density, r.cp, r.k, r.temperature].map(cell);
        let words = [r.name.clone(), kind.to_owned()];
        words.into_iter().chain(numbers).chain([r.title.clone(), r.source.clone()]).collect()
    };
    std::iter::once(heading.map(str::to_owned).to_vec())
        .chain(materials.iter().map(|r| row("material", r)))
        .chain(fluids.iter().map(|r| row("fluid", r)))
        .collect()
}

fn members(records: &[&Record]) -> Value {
    let scalar = |value: Option<f64>, unit: &str| value.map_or(Value::Null, |v| Scalar::new(v, unit).json());
    let member = |record: &&Record| {
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
    Value::Object(records.iter().map(member).collect::<Map<_, _>>())
}
