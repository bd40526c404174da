//! The codes of problems of a CSV file, and help for its cells.

use lptn_units::{Dimension, Type, Unit};

/// The codes of the problems of a file.
#[derive(Debug)]
pub(crate) struct Codes {
    /// True for measured data: gaps are allowed, units are required; a command line names the file.
    pub(crate) of_record: bool,
    pub(crate) empty: &'static str,
    pub(crate) separator: &'static str,
    pub(crate) no_header: &'static str,
    pub(crate) no_column: &'static str,
    pub(crate) two_columns: &'static str,
    pub(crate) unit: &'static str,
    pub(crate) extra_value: &'static str,
    pub(crate) short_row: &'static str,
    pub(crate) missing_value: &'static str,
    pub(crate) not_a_number: &'static str,
    pub(crate) not_finite: &'static str,
    pub(crate) undecided: &'static str,
    pub(crate) dates: &'static str,
    pub(crate) start: &'static str,
    pub(crate) clock_change: &'static str,
    pub(crate) read_as: &'static str,
}

/// Codes for records and sheets of points.
pub(crate) const RECORD: &Codes = &Codes {
    of_record: true,
    empty: "record::empty",
    separator: "record::separator",
    no_header: "record::no_header",
    no_column: "record::no_column",
    two_columns: "record::two_columns",
    unit: "record::unit",
    extra_value: "record::extra_value",
    short_row: "record::short_row",
    missing_value: "record::missing_value",
    not_a_number: "record::not_a_number",
    not_finite: "record::not_finite",
    undecided: "record::decimal",
    dates: "record::dates",
    start: "record::start",
    clock_change: "record::clock_change",
    read_as: "record::read_as",
};

/// Codes for the files that a netlist names.
pub(crate) const NETLIST: &Codes = &Codes {
    of_record: false,
    empty: "netlist::csv_empty",
    separator: "netlist::csv_separator",
    no_header: "netlist::csv_no_header",
    no_column: "netlist::csv_column",
    two_columns: "netlist::csv_two_columns",
    unit: "netlist::csv_unit",
    extra_value: "netlist::csv_extra_value",
    short_row: "netlist::csv_short_row",
    missing_value: "netlist::csv_missing_value",
    not_a_number: "netlist::csv_not_a_number",
    not_finite: "netlist::csv_not_finite",
    undecided: "netlist::csv_decimal",
    dates: "netlist::csv_dates",
    start: "netlist::csv_start",
    clock_change: "netlist::csv_clock_change",
    read_as: "netlist::csv_read_as",
};

/// The name and the unit of `ring (degC)`, `ring/degC`, `ring_degC`, `ring in degC`.
pub(crate) fn other_brackets(name: &str) -> Option<(&str, &str)> {
    let at = name.find(['(', '/', ',', '{']).or_else(|| name.rfind(['_', ' ']))?;
    let (bare, unit) = name.split_at(at);
    let unit = unit.trim_matches(['(', ')', '/', ',', '{', '}', '_', ' ']);
    let unit = if matches!(unit, "C" | "°C") { "degC" } else { unit };
    let bare = bare.trim();
    let bare = bare.strip_suffix(" in").unwrap_or(bare).trim_end();
    (!bare.is_empty() && Unit::parse(unit).is_ok()).then_some((bare, unit))
}

/// `--unit ring=degC`, for a column without a unit: the one that its name ends in, else that of
/// `wanted`.
pub fn unit_option(name: &str, wanted: Type) -> String {
    let unit = other_brackets(name).map(|(_, unit)| unit.to_owned());
    option(name, &unit.unwrap_or_else(|| wanted.usual_unit()))
}

/// `--unit n=rpm`, for a column of a speed whose unit is that of a frequency, `1/min`.
pub fn revolutions_option(name: &str, unit: &Unit) -> Option<String> {
    let is = |scale: f64| (unit.scale / scale - 1.0).abs() < 1e-12;
    let frequency = unit.ty == Type::of(Dimension::FREQUENCY);
    let found = [(1.0, "rev/s"), (1.0 / 60.0, "rpm")].into_iter().find(|(scale, _)| is(*scale));
    found.filter(|_| frequency).map(|(_, text)| option(name, text))
}

fn option(name: &str, unit: &str) -> String {
    let statement = format!("{name}={unit}");
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-.=/".contains(c);
    match statement.chars().all(plain) {
        true => format!("--unit {statement}"),
        false => format!("--unit \"{}\"", statement.replace('"', "\\\"")),
    }
}

/// Help for a text in a cell that needs a number.
pub(crate) fn text_help(name: &str, cell: &str) -> String {
    let point = cell.replacen(',', ".", 1);
    if cell.contains(',') && point.parse::<f64>().is_ok() {
        // three digits after the comma may be thousands
        let whole = cell.replacen(',', "", 1);
        return match cell.split_once(',').is_some_and(|(_, rest)| rest.len() == 3) {
            true => {
                format!("write numbers with a point, `{point}`, or without thousands, `{whole}`")
            }
            false => format!("write numbers with a point: `{point}`"),
        };
    }
    if is_moment(cell) {
        return format!(
            "a column with a unit contains numbers: write the header of dates and clock times \
             without a unit, `{name}`"
        );
    }
    if cell.contains(';') {
        return "the columns are separated by `;` in this row: write commas".to_owned();
    }
    let number: String =
        cell.chars().take_while(|c| c.is_ascii_digit() || "+-.".contains(*c)).collect();
    let unit = cell.get(number.len()..).unwrap_or_default().trim();
    if !number.is_empty() && number.parse::<f64>().is_ok() && Unit::parse(unit).is_ok() {
        return format!("write the unit once, in the header: `{name} [{unit}]`");
    }
    "a cell contains one number; its unit is in the header".to_owned()
}

/// A clock time or a date: `12:00:05`, `2024-05-03`, `03.05.2024`, `3/5/2024`.
fn is_moment(cell: &str) -> bool {
    let digits = cell.starts_with(|c: char| c.is_ascii_digit());
    let twice = |c: char| cell.matches(c).count() == 2;
    digits
        && (cell.contains(':') || twice('-') || twice('/') || twice('.'))
        && cell.parse::<f64>().is_err()
}
