//! What is fuzzed: functions that take any bytes and must neither panic, nor hang, nor take memory
//! without measure, nor give NaN as if it were a result. `make fuzz` feeds them guided by coverage,
//! `cargo test --test fuzz` replays the corpus.

use std::io;
use std::path::Path;

use lptn::prelude::*;
use lptn_netlist::{
    CsvOptions, Files, Netlist, RecordQuery, Rejected, parse_bytes, parse_with, read_record,
    read_sheet,
};
use lptn_solve::{Proceed, RunStatus};
use lptn_units::{
    Dimension, Expression, Scope, Symbol, Type, Unit, UnitError, format_number, parse_quantity,
    parse_value,
};

/// A target by its name.
pub(crate) type Target = (&'static str, fn(&[u8]));

/// All targets; each has its folder below `fuzz/corpus`.
pub(crate) const TARGETS: [Target; 6] = [
    ("quantity", quantity),
    ("expression", expression),
    ("netlist", netlist),
    ("csv", csv),
    ("state", state),
    ("set", set),
];

/// Longer inputs find nothing more.
const LONGEST: usize = 16_384;

/// A run is broken off after so many steps.
const STEPS: usize = 200;

/// Rows of a run, at most.
const ROWS: f64 = 400.0;

/// Grids and templates may be large, legally: more elements than these are not tried.
const ELEMENTS: u64 = 400;

fn text(bytes: &[u8]) -> Option<&str> {
    std::str::from_utf8(bytes).ok().filter(|text| text.len() <= LONGEST)
}

/// A mistake has a place inside the text, and words.
fn explained(error: &UnitError, text: &str) {
    assert!(text.get(error.span.clone()).is_some(), "{error} at {:?} of {text:?}", error.span);
    assert!(!error.to_string().is_empty() && !error.code().is_empty());
    let _ = error.help();
}

fn rejected(rejected: &Rejected) {
    assert!(!rejected.diagnostics.is_empty(), "refused without a reason");
    assert!(!rejected.to_string().is_empty());
    places(&rejected.files, &rejected.diagnostics);
}

/// Every place can be shown.
fn places(files: &Files, diagnostics: &[lptn_netlist::Diagnostic]) {
    for diagnostic in diagnostics {
        let _ = files.plain(diagnostic);
        let Some(span) = diagnostic.place() else { continue };
        assert!(
            files.text(span.file).get(span.range.clone()).is_some(),
            "{} at {span:?}",
            diagnostic.code
        );
    }
}

/// Quantities and units.
fn quantity(bytes: &[u8]) {
    let Some(text) = text(bytes) else { return };
    let types = [
        None,
        Some(Type::of(Dimension::POWER)),
        Some(Type::of(Dimension::TEMPERATURE)),
        Some(Type::ABSOLUTE_TEMPERATURE),
    ];
    for ty in types {
        match parse_quantity(text, ty) {
            Ok(quantity) => {
                assert!(!quantity.value.is_nan(), "{text:?} is NaN");
                let again = format_number(quantity.value).parse::<f64>().expect("a number");
                assert!(
                    again.to_bits() == quantity.value.to_bits(),
                    "{again} is not {}",
                    quantity.value
                );
            }
            Err(error) => explained(&error, text),
        }
        let _ = parse_value(text, ty, &|name| name == "x").map_err(|error| explained(&error, text));
    }
    let _ = Unit::parse(text).map_err(|error| explained(&error, text));
}

/// Names for expressions.
struct Names;

const NAMES: [(&str, Type, f64); 6] = [
    ("x", Type::SCALAR, 2.0),
    ("omega", Type::of(Dimension::ANGULAR_VELOCITY), 100.0),
    ("P", Type::of(Dimension::POWER), 220.0),
    ("T", Type::ABSOLUTE_TEMPERATURE, 350.0),
    ("t", Type::of(Dimension::TIME), 60.0),
    ("n1.T", Type::ABSOLUTE_TEMPERATURE, 300.0),
];

impl Scope for Names {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = NAMES.iter().position(|(known, ..)| *known == name)?;
        Some(Symbol { slot: u32::try_from(slot).ok()?, ty: NAMES[slot].1, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        NAMES.iter().map(|(name, ..)| (*name).to_owned()).collect()
    }

    fn table(&self, _: &str) -> Option<lptn_units::TableSymbol> {
        None
    }

    fn table_names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Expressions: read, compiled and evaluated.
fn expression(bytes: &[u8]) {
    let Some(text) = text(bytes) else { return };
    let expression = match Expression::parse(text) {
        Ok(expression) => expression,
        Err(error) => return explained(&error, text),
    };
    for expected in [None, Some(Type::of(Dimension::POWER))] {
        match expression.compile(&Names, expected) {
            Ok(program) => {
                let values: Vec<f64> = NAMES.iter().map(|(_, _, value)| *value).collect();
                match program.eval(&values, &mut Vec::new()) {
                    Ok(value) => assert!(!value.is_nan(), "{text:?} is NaN"),
                    Err(error) => assert!(!error.to_string().is_empty()),
                }
            }
            Err(errors) => errors.iter().for_each(|error| explained(error, text)),
        }
    }
}

/// A whole netlist, without files beside it.
fn netlist(bytes: &[u8]) {
    if bytes.len() > LONGEST || std::str::from_utf8(bytes).is_ok_and(large) {
        return;
    }
    match parse_bytes("fuzz.toml", bytes) {
        Ok(netlist) => {
            solved(&netlist);
            if netlist.not_flat().is_none() {
                let flat = netlist.expanded();
                if let Err(problems) = lptn::parse("flat.toml", &flat) {
                    panic!("its expansion is refused: {problems}\n{flat}");
                }
            }
        }
        Err(problems) => rejected(&problems),
    }
}

/// Whether lines with `cells` or `count` ask for very many elements.
fn large(text: &str) -> bool {
    let mut elements: u64 = 1;
    for line in text.lines().filter(|line| line.contains("cells") || line.contains("count")) {
        let line = line.replace('_', "");
        if line.contains("0x") || line.contains("0b") || line.contains("0o") || line.contains('\\')
        {
            return true;
        }
        for digits in line.split(|c: char| !c.is_ascii_digit()).filter(|digits| !digits.is_empty())
        {
            elements = elements.saturating_mul(digits.parse::<u64>().unwrap_or(u64::MAX).max(1));
        }
    }
    // a list may go over several lines
    let lists = text.matches("cells").count() + text.matches("count").count();
    elements > ELEMENTS
        || lists > 0
            && text.lines().any(|line| line.trim_start().starts_with(|c: char| c.is_ascii_digit()))
}

/// What is read can be assembled, settled and run for a while, or says why not; nothing is NaN.
fn solved(netlist: &Netlist) {
    places(&netlist.files, &netlist.warnings);
    let system = match ThermalSystem::assemble(&netlist.network) {
        Ok(system) => system,
        Err(error) => return assert!(!error.to_string().is_empty()),
    };
    let start = netlist.run.as_ref().map_or(0.0, |run| run.start);
    match SteadyState::solve(&system, start) {
        Ok(steady) => {
            let wrong = steady.temperatures.iter().find(|kelvin| !kelvin.is_finite());
            assert!(wrong.is_none(), "a steady temperature is {wrong:?}");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    let Some(run) = &netlist.run else { return };
    let mut transient = lptn_solve::Transient::of(&netlist.network, run);
    if transient.rows().is_ok_and(|rows| rows.len() as f64 > ROWS) {
        transient.output = OutputTimes::Every((run.stop - run.start) / ROWS);
    }
    let mut steps = 0;
    let outcome = transient.solve_observed(&system, &mut |_| {
        steps += 1;
        if steps < STEPS { Proceed::Continue } else { Proceed::Interrupt }
    });
    match outcome {
        Ok(solution) => numbers(&solution),
        Err(error) => assert!(!error.to_string().is_empty() && !error.code().is_empty()),
    }
}

/// Temperatures and heat flows are numbers.
fn numbers(solution: &Solution) {
    let kelvin = Unit::parse("K").expect("a unit");
    let table = Table::of_solution(solution, &Selection::all(solution.network()), &kelvin);
    let meant = |name: &str| [".T", ".Q", ".P"].iter().any(|end| name.ends_with(end));
    if solution.end() == RunStatus::Reached || !solution.times().is_empty() {
        for column in table.columns().iter().filter(|column| meant(&column.name)) {
            let wrong = column.values.iter().find(|value| !value.is_finite());
            assert!(wrong.is_none(), "{} is {wrong:?}", column.name);
        }
    }
}

/// Reads a netlist that names one file, whatever it is called.
fn beside(text: &str, file: &[u8]) -> Result<Netlist, Rejected> {
    let mut loader = |_: &Path| -> io::Result<Vec<u8>> { Ok(file.to_vec()) };
    parse_with("fuzz.toml", text, &mut loader)
}

const AROUND: &str = r#"
[node]
n = { C = "100 J/K", T0 = "20 degC" }
[boundary]
room = { T = "20 degC" }
[resistor]
r = { from = "n", to = "room", R = "1 K/W" }
[run]
stop = "60 s"
output = { every = "5 s" }
"#;

/// CSV files: of signals, tables, materials, imports and records.
fn csv(bytes: &[u8]) {
    if bytes.len() > LONGEST {
        return;
    }
    let named = [
        "signal]\ns = { csv = 'a.csv', time = 't', value = 'v', after_end = 'hold' }\n[source]\nq = { into = 'n', P = 's' }\n",
        "table]\ns = { csv = 'a.csv', x = 't', value = 'v', outside = 'hold' }\n[source]\nq = { into = 'n', P = 's(t)' }\n",
        "table]\ns = { csv = 'a.csv', x = 't', y = 'u', value = 'v', outside = 'hold' }\n[source]\nq = { into = 'n', P = 's(t, t)' }\n",
        "import]\nnodes = 'a.csv'\n",
        "import]\nboundaries = 'a.csv'\n",
        "import]\nconductors = 'a.csv'\n",
        "import]\nsources = 'a.csv'\n",
    ];
    for section in named {
        match beside(&format!("format = 1\n[{section}{AROUND}"), bytes) {
            Ok(netlist) => solved(&netlist),
            Err(problems) => rejected(&problems),
        }
    }
    let path = Path::new("a.csv");
    let _ =
        read_record(path, bytes, &RecordQuery::default()).map_err(|problems| rejected(&problems));
    let _ = read_sheet(path, bytes, &CsvOptions::default()).map_err(|problems| rejected(&problems));
}

/// States that a run starts from.
fn state(bytes: &[u8]) {
    if bytes.len() > LONGEST {
        return;
    }
    let text = r#"format = 1
[node]
n = { C = "100 J/K", T0 = "20 degC" }
m = { massless = true }
wax = { material = "wax", mass = "0.1 kg", T0 = "20 degC" }
[material]
wax = { cp = "2 kJ/(kg K)", solidus = "55 degC", liquidus = "55 degC", latent_heat = "200 kJ/kg" }
[boundary]
room = { T = "20 degC" }
[control]
fan = { sense = "n", on_above = "60 degC", off_below = "50 degC", min_dwell = "10 s" }
[resistor]
a = { from = "n", to = "m", R = "1 K/W" }
b = { from = "m", to = "room", G = "1 [W/K] + 5 [W/K] * fan" }
c = { from = "n", to = "wax", R = "1 K/W" }
[run]
stop = "60 s"
output = { every = "5 s" }
initial = "state.json"
"#;
    match beside(text, bytes) {
        Ok(netlist) => solved(&netlist),
        Err(problems) => rejected(&problems),
    }
}

/// Assignments, one in each line.
fn set(bytes: &[u8]) {
    let Some(lines) = text(bytes) else { return };
    let text = r#"format = 1
[param]
R = "1 K/W"
P = "10 ± 1 W"
T_amb = "20 degC"
dT = "5 K"
k = 0.5
omega = "1000 rpm"
stop = "60 s"
C = "100 J/K"
[node]
n = { C = "C", T0 = "T_amb" }
[boundary]
room = { T = "T_amb + dT * k" }
[resistor]
r = { from = "n", to = "room", R = "R" }
[source]
q = { into = "n", P = "P * omega / 1000 [rpm]" }
[run]
stop = "stop"
"#
    .replace("dT", "rise");
    let mut netlist = lptn::parse("fuzz.toml", &text).expect("a sound netlist");
    let lines: Vec<String> = lines.lines().map(str::to_owned).collect();
    match netlist.set(&lines) {
        Ok(()) => solved(&netlist),
        Err(problems) => rejected(&problems),
    }
}
