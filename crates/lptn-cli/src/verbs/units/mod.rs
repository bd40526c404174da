//! `lptn units`

mod args;
mod conversions;

pub(crate) use args::UnitsArgs;

use conversions::{ABSOLUTE, USUAL};
use lptn_report::{Align, Column, TextTable, WIDTH, labelled, significant};
use lptn_units::{Quantity, Type, Unit, format_number, parse_quantity};

use crate::console::Console;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::input::wrong_unit;

pub(crate) fn units(args: &UnitsArgs, console: &Console) -> Result<Exit, Failure> {
    let Some(text) = &args.quantity else { return console.print(&list()) };
    let quantity = parse_quantity(text, None).map_err(|error| wrong_unit("QUANTITY", text, &error))?;
    console.print(&describe(text, &quantity))
}

/// The value in SI, what it is, and the value in other units.
fn describe(text: &str, quantity: &Quantity) -> String {
    let ty = quantity.ty;
    let si_unit = if ty.absolute { "K".to_owned() } else { ty.dimension.si_unit() };
    let unit = if si_unit == "1" { String::new() } else { format!(" {si_unit}") };
    let deviation = quantity.deviation.map_or(String::new(), |d| format!(" ± {}", format_number(d)));
    let mut lines = vec![
        format!("{} = {}{deviation}{unit}", text.trim(), format_number(quantity.value)),
        String::new(),
        format!(
            "quantity    {}",
            ty.dimension.quantity_name().filter(|_| !ty.absolute).unwrap_or(unnamed(ty))
        ),
        format!("dimension   {}", ty.dimension),
    ];
    let others = if ty.absolute { ABSOLUTE } else { conversions::of(ty.dimension) };
    let known = |unit: &str| unit == si_unit || text.trim().ends_with(&format!(" {unit}"));
    let others = others.iter().filter(|unit| !known(unit));
    let others: Vec<String> = others.filter_map(|unit| in_unit(quantity.value, unit)).collect();
    if !others.is_empty() {
        lines.extend(labelled("also        ", &separated(others), WIDTH));
    }
    lines.extend(note(text, ty).map(|note| format!("note        {note}")));
    lines.join("\n") + "\n"
}

fn unnamed(ty: Type) -> &'static str {
    if ty.absolute { "absolute temperature" } else { "no usual name" }
}

fn in_unit(si: f64, unit: &str) -> Option<String> {
    let value = Unit::parse(unit).ok()?.from_si(si);
    Some(format!("{} {unit}", significant(value, 7)))
}

fn separated(texts: Vec<String>) -> Vec<String> {
    let last = texts.len().saturating_sub(1);
    texts.into_iter().enumerate().map(|(i, text)| if i < last { text + "," } else { text }).collect()
}

/// A temperature in K is the one quantity whose meaning depends on where it stands.
fn note(text: &str, ty: Type) -> Option<&'static str> {
    let kelvin = ty == Type::of(lptn_units::Dimension::TEMPERATURE) && text.trim().ends_with('K');
    kelvin.then_some("as `T` or `T0` of a netlist this is an absolute temperature")
}

/// Every quantity with its usual units.
fn list() -> String {
    let absolute = ("absolute temperature".to_owned(), ABSOLUTE.join(", ") + ", K");
    let of = |(dimension, units): &(lptn_units::Dimension, &[&str])| {
        (dimension.quantity_name().unwrap_or_default().to_owned(), units.join(", "))
    };
    let rows: Vec<(String, String)> = std::iter::once(absolute).chain(USUAL.iter().map(of)).collect();
    let (names, units) = rows.into_iter().unzip();
    let table = TextTable::new(vec![
        Column::new("quantity", Align::Left, names),
        Column::new("usual units, SI first", Align::Left, units),
    ]);
    let rest = "Units are combined with spaces, `/`, `^` and brackets: W/(m^2 K).\n\
                SI units take prefixes: mK, kJ, um.\n";
    format!("{}\n\n{rest}", table.lines(WIDTH).join("\n"))
}
