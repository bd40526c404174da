//! `[param]`, `[table]`, `[signal]`, `[default]`.

use std::borrow::Cow;
use std::sync::Arc;

use lptn_network::{Evaluation, Item, Parameter, ParameterId, Value, ZERO_CELSIUS};
use lptn_units::{
    Dimension, Interpolation, LookupTable, Outside, Spread, Table1, TableSymbol, Type,
    format_number,
};

use super::Writer;
use crate::course_text::course;
use crate::raw::{RawKind, RawTable, RawValue};
use crate::toml_text::{TomlFields, celsius, list, list_in, point, quantity, string, strings};

/// A value of this unit with its deviation, which is in percent again if it was.
fn uncertain(number: &str, unit: &str, (spread, value): (Spread, f64)) -> String {
    let suffix = spread.suffix();
    match spread.percent() {
        // `2 ± 5 %` would be a number in percent
        Some(percent) => {
            let unit = if unit.is_empty() { "m/m" } else { unit };
            format!("\"{number} {unit} ± {} %{suffix}\"", format_number(percent))
        }
        None => {
            let behind = format_number(spread.sigma(value) * spread.distribution.written());
            let space = if unit.is_empty() { "" } else { " " };
            format!("\"{number} ± {behind}{space}{unit}{suffix}\"")
        }
    }
}

impl Writer<'_> {
    pub(super) fn parameters(&mut self) {
        let (network, mut fields) = (&self.network, TomlFields::default());
        let mut scope = network.evaluation();
        for (id, parameter) in network.parameter_ids().zip(network.parameters()) {
            fields.put(&parameter.name, self.parameter((id, parameter), &mut scope));
        }
        self.section("param", &fields);
    }

    /// An expression, unless another value was set.
    fn parameter(
        &self,
        (id, parameter): (ParameterId, &Parameter),
        scope: &mut Evaluation,
    ) -> String {
        let network = &self.network;
        let number = network.parameter_value(id);
        let own = parameter.value.at(scope);
        if let (Value::Expression(program), true) =
            (&parameter.value, own.is_ok_and(|own| own.to_bits() == number.to_bits()))
        {
            return string(program.text().trim());
        }
        let set = self.origin.overrides().deviation(id).or(parameter.deviation);
        // no share of 0 is a deviation
        let set = set.filter(|spread| number.abs() > 0.0 || spread.sigma(number) > 0.0);
        match (set, parameter.ty.absolute) {
            (None, true) => point(number),
            (None, false) => quantity(number, parameter.ty),
            (Some(spread), true) => uncertain(&celsius(number), "degC", (spread, number)),
            (Some(spread), false) => {
                let unit = match parameter.ty.is_scalar() {
                    true => String::new(),
                    false => parameter.ty.dimension.si_unit(),
                };
                uncertain(&format_number(number), &unit, (spread, number))
            }
        }
    }

    pub(super) fn tables(&mut self) {
        let (network, mut fields) = (&self.network, TomlFields::default());
        for (name, symbol) in network.tables() {
            let is_of_lubricant = network.tables().any(|(other, _)| is_lubricant(other, name));
            if is_of_lubricant || self.is_property(name, symbol) {
                continue;
            }
            let written = match (&*symbol.table, self.map_of(&symbol.table)) {
                (LookupTable::DoubleLog(_) | LookupTable::PowerLaw(_), _) => continue,
                (LookupTable::One(table), _) => of_one(table, symbol).inline(),
                (LookupTable::Two(_), Some(raw)) => self.csv_map(raw),
                (LookupTable::Two(_), None) => continue,
            };
            fields.put(name, written);
        }
        self.section("table", &fields);
    }

    pub(super) fn lubricants(&mut self) {
        let (network, mut section) = (&self.network, TomlFields::default());
        for (name, symbol) in network.tables() {
            let LookupTable::DoubleLog(line) = &*symbol.table else { continue };
            let pair = |[t, nu]: [f64; 2]| format!("[{}, {}]", point(t), quantity(nu, symbol.ty));
            let mut fields = TomlFields::default();
            fields.put("viscosity", format!("[{}]", line.points().map(pair).join(", ")));
            fields.put("c", format_number(line.shift()));
            let mut tables = network.tables();
            if let Some((_, density)) = tables.find(|(other, _)| is_lubricant(name, other))
                && let LookupTable::One(table) = &*density.table
                && let ([x0, x1], [y0, y1]) = (table.knots(), table.values())
            {
                let slope = (y1 - y0) / (x1 - x0);
                let at_15 = twelve_digits(y0 + slope * (ZERO_CELSIUS + 15.0 - x0));
                fields.put("density", quantity(at_15, density.ty));
                let expansion = Type::of(Dimension::EXPANSION_COEFFICIENT);
                fields.put("expansion", quantity(twelve_digits(-slope / at_15), expansion));
            }
            section.put(name.strip_suffix(".nu").unwrap_or(name), fields.inline());
        }
        self.section("lubricant", &section);
    }

    /// Fans by their point at rated speed.
    pub(super) fn fans(&mut self) {
        let (network, mut section) = (&self.network, TomlFields::default());
        let of = |name: &str, what: &str| {
            let wanted = format!("{name}.{what}");
            let mut tables = network.tables();
            let symbol = tables.find(|(other, _)| *other == wanted)?.1;
            let LookupTable::PowerLaw(law) = &*symbol.table else { return None };
            Some((law.point(), symbol))
        };
        for (flow, _) in network.tables() {
            let Some(name) = flow.strip_suffix(".flow") else { continue };
            let (Some(flow), Some(pressure)) = (of(name, "flow"), of(name, "pressure")) else {
                continue;
            };
            let [duty, head] = [flow, pressure].map(|(point, of)| quantity(point[1], of.ty));
            let mut fields = TomlFields::default();
            fields.put("duty", format!("[{duty}, {head}]"));
            let speed = flow.1.arguments.first().copied().unwrap_or(Type::SCALAR);
            fields.put("rated_speed", quantity(flow.0[0], speed));
            if let Some((point, power)) = of(name, "power") {
                fields.put("power", quantity(point[1], power.ty));
            }
            section.put(name, fields.inline());
        }
        self.section("fan", &section);
    }

    /// The line of a table of two arguments in the netlist that it comes from.
    fn map_of(&self, table: &Arc<LookupTable>) -> Option<&RawTable> {
        let known = &self.origin.network;
        let mut named = known.table_ids().zip(known.tables());
        let (id, _) = named.find(|(_, (_, symbol))| Arc::ptr_eq(&symbol.table, table))?;
        self.origin.source_map.csv_map(id)
    }

    /// A table of two arguments, which has no other form than its file.
    fn csv_map(&self, raw: &RawTable) -> String {
        let mut fields = TomlFields::default();
        for entry in &raw.entries {
            if let RawKind::Array(files) = &entry.value.kind {
                let path = |file: &RawValue| match &file.kind {
                    RawKind::String { text, .. } => Some(self.path(file.span.file, text)),
                    _ => None,
                };
                let paths: Vec<String> = files.iter().filter_map(path).collect();
                fields.put(&entry.key, strings(paths.iter().map(String::as_str)));
            }
            let RawKind::String { text, .. } = &entry.value.kind else { continue };
            if entry.key == "csv" {
                fields.word(&entry.key, &self.path(entry.value.span.file, text));
            } else {
                fields.word(&entry.key, text);
            }
        }
        fields.inline()
    }

    pub(super) fn signals(&mut self) {
        let mut fields = TomlFields::default();
        for signal in self.network.signals() {
            fields.put(&signal.name, course(signal));
        }
        self.section("signal", &fields);
    }

    pub(super) fn default(&mut self) {
        let mut fields = TomlFields::default();
        let unit = &self.origin.temperature_unit.text;
        if unit != "degC" {
            fields.word("temperature_unit", unit);
        }
        self.section("default", &fields);
    }

    /// The name of a table of the network.
    pub(super) fn name_of_table(&self, table: &Arc<LookupTable>) -> Option<&str> {
        let mut named =
            self.network.tables().filter(|(_, symbol)| Arc::ptr_eq(&symbol.table, table));
        named.next().map(|(name, _)| name)
    }

    /// The name of an item, for sections that refer to it.
    pub(super) fn name(&self, item: impl Into<Item>) -> Cow<'_, str> {
        self.network.name_of(item.into())
    }
}

/// A table of one argument.
fn of_one(table: &Table1, symbol: &TableSymbol) -> TomlFields {
    let argument = symbol.arguments.first().copied().unwrap_or(Type::SCALAR);
    let mut fields = TomlFields::default();
    fields.list("x", list_in(table.knots(), argument, symbol.units.first()));
    fields.list("y", list_in(table.values(), symbol.ty, symbol.units.get(1)));
    joined(&mut fields, table);
    fields
}

/// A property over temperature; its argument is a point on the temperature scale in any case.
pub(super) fn over_temperature(table: &Table1, ty: Type) -> String {
    let mut fields = TomlFields::default();
    let (knots, _) = list(table.knots(), Type::SCALAR);
    fields.list("x", (knots, Some("K".to_owned())));
    fields.list("y", list(table.values(), ty));
    joined(&mut fields, table);
    fields.inline()
}

/// The interpolation of a table and its values outside, if they are not the default.
fn joined(fields: &mut TomlFields, table: &Table1) {
    if table.interpolation() == Interpolation::Pchip {
        fields.word("interp", "pchip");
    }
    if table.outside() == Outside::Hold {
        fields.word("outside", "hold");
    }
}

/// True if two tables are the viscosity and the density of one lubricant.
fn is_lubricant(viscosity: &str, density: &str) -> bool {
    let [of_viscosity, of_density] =
        [viscosity.strip_suffix(".nu"), density.strip_suffix(".density")];
    of_viscosity.is_some() && of_viscosity == of_density
}

/// A number without its last digits, so that it is written the same again after it was read and
/// computed.
fn twelve_digits(number: f64) -> f64 {
    format!("{number:.11e}").parse().unwrap_or(number)
}
