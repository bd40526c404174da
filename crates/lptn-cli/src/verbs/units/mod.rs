//! `lptn units`

mod args;
mod conversions;

pub(crate) use args::UnitsArgs;

use conversions::{ABSOLUTE, USUAL};
use lptn_report::{Format, Text, TextTable, significant};
use lptn_units::{Dimension, Quantity, Spread, Type, Unit, format_number, parse_quantity};

use crate::console::Console;
use lptn_answer::exit::Exit;
use lptn_answer::failure::Failure;
use lptn_answer::input::wrong_unit;
use lptn_answer::words::spaced;

pub(crate) fn units(args: &UnitsArgs, console: &Console) -> Result<Exit, Failure> {
    let text = match &args.quantity {
        None => list(),
        Some(text) => {
            let quantity =
                parse_quantity(text, None).map_err(|error| wrong_unit("QUANTITY", text, &error))?;
            describe(text, &quantity)
        }
    };
    console.show(&text, Format::Table)
}

/// The value in SI, its quantity, and the value in other units.
fn describe(given: &str, quantity: &Quantity) -> Text {
    let ty = quantity.ty;
    let si_unit = ty.dimension.si_unit();
    let unit = spaced(&si_unit);
    let deviation = quantity.deviation.map_or(String::new(), |spread| {
        let behind = quantity.sigma() * spread.distribution.written();
        format!(" ± {}", format_number(behind))
    });
    let distributed = quantity.deviation.map_or(String::new(), Spread::suffix);
    let name = ty.dimension.quantity_name().filter(|_| !ty.absolute).unwrap_or(unnamed(ty));
    let others = if ty.absolute { ABSOLUTE } else { conversions::of(ty.dimension) };
    let known = |unit: &str| unit == si_unit || given.trim().ends_with(&format!(" {unit}"));
    let others = others.iter().filter(|unit| !known(unit));
    let others: Vec<String> = others.filter_map(|unit| in_unit(quantity.value, unit)).collect();
    let mut text = Text::new();
    let value = format_number(quantity.value);
    text.line(format!("{} = {value}{deviation}{unit}{distributed}", given.trim()));
    text.section().line(format!("quantity    {name}"));
    text.line(format!("dimension   {}", ty.dimension));
    if !others.is_empty() {
        text.labelled("also        ", separated(others));
    }
    if !distributed.is_empty() {
        let sigma = format_number(quantity.sigma());
        text.line(format!("deviation   one standard deviation is {sigma}{unit}"));
    }
    text.lines(note(given, ty).map(|note| format!("note        {note}")));
    text
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
    texts
        .into_iter()
        .enumerate()
        .map(|(i, text)| if i < last { text + "," } else { text })
        .collect()
}

/// Note on a temperature in K, the only quantity whose meaning depends on its place.
fn note(text: &str, ty: Type) -> Option<&'static str> {
    let kelvin = ty == Type::of(Dimension::TEMPERATURE) && text.trim().ends_with('K');
    kelvin.then_some("as `T` or `T0` of a netlist this is an absolute temperature")
}

/// Every quantity with its usual units.
fn list() -> Text {
    let absolute = ("absolute temperature", ABSOLUTE.join(", ") + ", K");
    let of = |(dimension, units): &(Dimension, &[&str])| {
        (dimension.quantity_name().unwrap_or_default(), units.join(", "))
    };
    let rows: Vec<(&str, String)> = std::iter::once(absolute).chain(USUAL.iter().map(of)).collect();
    let mut text = Text::new();
    text.table(
        TextTable::of(&rows)
            .left("quantity", |row| row.0)
            .left("usual units, SI first", |row| &row.1),
    );
    text.section().line("Units are combined with spaces, `/`, `^` and brackets: W/(m^2 K).");
    text.line("SI units take prefixes: mK, kJ, um.");
    text
}
