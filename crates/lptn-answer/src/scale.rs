//! Temperatures for programs: the whole object has one unit, the one that is shown
//! ([`Unit::shown`]). All else is in SI.

use lptn_solve::Table;
use lptn_units::{Dimension, Type, Unit};
use serde_json::{Value, json};

use crate::words::difference;

/// The unit in which files keep temperatures.
pub fn kelvin() -> Unit {
    Unit { text: "K".into(), scale: 1.0, offset: 0.0, ty: Type::ABSOLUTE_TEMPERATURE }
}

/// A value of SI with its unit: a temperature in `unit`, all else in SI.
/// A difference of temperatures is in K or degR, as belongs to `unit`.
pub fn scalar(si: f64, ty: Type, unit: &Unit) -> Value {
    let (value, unit) = in_unit(si, ty, unit);
    json!({ "value": value, "unit": unit })
}

/// The same as a number, and its unit.
pub fn in_unit(si: f64, ty: Type, unit: &Unit) -> (f64, String) {
    (unit.show(si, ty), unit.shown(ty).text)
}

/// A temperature in K.
pub fn temperature(kelvin: f64, unit: &Unit) -> Value {
    scalar(kelvin, Type::ABSOLUTE_TEMPERATURE, unit)
}

/// A difference of temperatures in K.
pub fn of_difference(kelvin: f64, unit: &Unit) -> Value {
    scalar(kelvin, Type::of(Dimension::TEMPERATURE), unit)
}

/// A table of a study, whose differences are in K, with those that belong to `unit`.
pub fn table(table: Table, unit: &Unit) -> Table {
    if difference(unit) == "K" {
        return table;
    }
    let rows: Vec<usize> = (0..table.rows()).collect();
    let mut scaled = Table::of(&rows);
    table.labels().iter().for_each(|of| scaled.label(&of.name, |&row| of.cells[row].clone()));
    for of in table.columns() {
        match of.unit.as_str() {
            "K" => scaled.column(&of.name, difference(unit), |&row| of.values[row] / unit.scale),
            own => scaled.column(&of.name, own, |&row| of.values[row]),
        }
    }
    scaled.done()
}
