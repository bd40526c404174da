//! The example of every page in `docs/elements`: what the page prints, and what the library
//! computes, against closed forms that stand here.
//!
//! Beside a page is its netlist, `NAME.toml`, which ends with a table of results in comments. A row
//! begins with a quantity in quotes, `steady` or a time, and a value with its unit.

#[path = "devices/mod.rs"]
mod devices;
#[path = "joints/mod.rs"]
mod joints;
#[path = "losses_pages/mod.rs"]
mod losses_pages;
use crate::support;

use std::path::{Path, PathBuf};

use lptn::prelude::*;
use lptn_laws::{Formula, Kind};
use lptn_netlist::Netlist;
use lptn_units::{Unit, parse_quantity};

/// The tolerance of the runs in K; what is promised is ten times as much.
const TOLERANCE: f64 = 1e-6;

/// Quantity, `steady` or a time, and the value in the unit of the page.
pub(crate) type Closed = (&'static str, &'static str, f64);

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/elements")
}

/// The zero `x` of a falling or rising function between two places.
pub(crate) fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rising = f(high) > f(low);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if (f(middle) < 0.0) == rising { low = middle } else { high = middle }
    }
    low
}

/// Temperature of a lump that relaxes from `t0` to `end`.
pub(crate) fn relaxed(t0: f64, end: f64, time: f64, tau: f64) -> f64 {
    end + (t0 - end) * (-time / tau).exp()
}

fn node() -> Vec<Closed> {
    let block = |t| relaxed(20.0, 90.0, t, 2.5 * 500.0);
    let joint = |t: f64| 90.0 - (90.0 - block(t)) / 2.5;
    // (400 + 2 x) dx/dt = -0.8 x
    let slug = |t: f64| {
        20.0 + root(1e-9, 100.0, |x| 400.0 * (x / 100.0_f64).ln() + 2.0 * (x - 100.0) + 0.8 * t)
    };
    // 200 J/K and 2 W/K: to 55 degC, 20 kJ at 2 W/K x 35 K, then on
    let (melts, molten) =
        (100.0 * (70.0_f64 / 35.0).ln(), 100.0 * (70.0_f64 / 35.0).ln() + 20e3 / 70.0);
    let buffer = |t: f64| match t {
        t if t < melts => relaxed(20.0, 90.0, t, 100.0),
        t if t < molten => 55.0,
        t => relaxed(55.0, 90.0, t - molten, 100.0),
    };
    vec![
        ("block.T", "5 min", block(300.0)),
        ("joint.T", "5 min", joint(300.0)),
        ("slug.T", "5 min", slug(300.0)),
        ("buffer.T", "5 min", buffer(300.0)),
        ("buffer.T", "1 min", buffer(60.0)),
        ("buffer.T", "10 min", buffer(600.0)),
        ("joint.T", "steady", 90.0),
        ("slug.T", "steady", 20.0),
    ]
}

fn capacitor() -> Vec<Closed> {
    // 735 + 0.4 kg x 475 + 50 cm^3 x 7.8 g/cm^3 x 500 J/(kg K)
    let c = 735.0 + 190.0 + 195.0;
    vec![("shaft.T", "10 min", relaxed(75.0, 25.0, 600.0, 0.5 * c)), ("shaft.T", "steady", 25.0)]
}

/// Two plates of 0.8 and 0.4 and a wall that reradiates, with view factors of 1/2.
fn enclosure() -> Vec<Closed> {
    let sigma = 5.670_374_419e-8;
    let [hot, cold] = [1200.0_f64, 500.0].map(|kelvin| sigma * kelvin.powi(4));
    let q = (hot - cold) / (0.25 + 1.0 / (0.5 + 0.25) + 1.5);
    let wall = (0.5 * (hot - 0.25 * q + cold + 1.5 * q) / sigma).powf(0.25) - 273.15;
    vec![("duct.hot.Q", "steady", q), ("duct.cold.Q", "steady", -q), ("wall.T", "steady", wall)]
}

fn foster() -> Vec<Closed> {
    let table = [(0.02, 2e-3), (0.06, 50e-3), (0.04, 0.4)];
    let rise = |t: f64| table.iter().map(|(r, tau)| -500.0 * r * (-t / tau).exp_m1()).sum::<f64>();
    vec![
        ("chip.T", "10 ms", 80.0 + rise(10e-3)),
        ("chip.T", "100 ms", 80.0 + rise(0.1)),
        ("chip.T", "steady", 140.0),
    ]
}

fn boundary() -> Vec<Closed> {
    let (tau, w) = (1200.0, 2.0 * std::f64::consts::PI / 3600.0);
    let casing = |t: f64| {
        let swing = (w * t).sin() - w * tau * (w * t).cos() + w * tau * (-t / tau).exp();
        20.0 + 5.0 * swing / (1.0 + (w * tau).powi(2))
    };
    let air = |t: f64| 20.0 + 5.0 * (w * t).sin();
    vec![
        ("air.T", "15 min", air(900.0)),
        ("casing.T", "15 min", casing(900.0)),
        ("casing.T", "1 h", casing(3600.0)),
        ("air.Q", "15 min", 0.5 * (air(900.0) - casing(900.0))),
        ("casing.T", "steady", 20.0),
    ]
}

fn resistor() -> Vec<Closed> {
    // 200 J/K dx/dt = 60 W - 0.5 x - 0.02 x^2, with the zeros up > 0 > down of the right side
    let half = (0.5_f64.powi(2) + 4.0 * 0.02 * 60.0).sqrt();
    let (up, down) = ((half - 0.5) / 0.04, (-half - 0.5) / 0.04);
    let shrink = |t: f64| up / -down * (-0.02 * (up - down) * t / 200.0).exp();
    let cover = |t: f64| (up + down * shrink(t)) / (1.0 + shrink(t));
    vec![
        ("cover.T", "3 min", 20.0 + cover(180.0)),
        ("cover.T", "steady", 20.0 + up),
        ("gap.Q", "steady", 60.0),
        ("winding.T", "steady", 20.0 + up + 60.0 * 0.2),
    ]
}

fn conduction() -> Vec<Closed> {
    use std::f64::consts::PI;
    let web = 167.0 * 20e-4 / 8e-3;
    let sleeve = 2.0 * PI * 0.25 * 0.08 / (25.0_f64 / 20.0).ln();
    let shell = 4.0 * PI * 0.04 / (1.0 / 0.05 - 1.0 / 0.07);
    let bolts = 45.0 * PI * 0.01 * 0.01 / 4.0 / 0.05;
    let g = web + sleeve + shell + bolts;
    vec![
        ("core.T", "10 s", relaxed(40.0, 40.0 + 500.0 / g, 10.0, 900.0 / g)),
        ("core.T", "steady", 40.0 + 500.0 / g),
        ("web.Q", "steady", 500.0 * web / g),
        ("sleeve.Q", "steady", 500.0 * sleeve / g),
        ("shell.Q", "steady", 500.0 * shell / g),
        ("bolt.Q", "steady", 500.0 * bolts / g),
    ]
}

fn radiation() -> Vec<Closed> {
    let sigma = 5.670374419e-8;
    // the plate: C dT/dt = sigma e A (end^4 - T^4) from T0 = 293.15 K < end; primitive of 1 /
    // (end^4 - T^4)
    let (gr, walls) = (0.8 * 0.05, 293.15_f64);
    let end = (walls.powi(4) + 60.0 / (sigma * gr)).powf(0.25);
    let primitive = |t: f64| {
        ((end + t) / (end - t)).ln() / (4.0 * end.powi(3)) + (t / end).atan() / (2.0 * end.powi(3))
    };
    let rate = sigma * gr / 150.0;
    let plate = |time: f64| {
        root(walls, end * (1.0 - 1e-12), |t| primitive(t) - primitive(walls) - rate * time)
    };
    // the probe sees 0 K: T = T0 (1 + 3 sigma Gr T0^3 t / C)^(-1/3)
    let probe = |time: f64| {
        293.15 * (1.0 + 3.0 * sigma * 0.02 * 293.15_f64.powi(3) * time / 100.0).powf(-1.0 / 3.0)
    };
    let shield = 1.0 / (1.0 / 0.8 + 1.0 / 0.1 - 1.0);
    let screen = sigma * shield * 0.05 * (363.15_f64.powi(4) - walls.powi(4));
    vec![
        ("plate.T", "5 min", plate(300.0) - 273.15),
        ("plate.T", "steady", end - 273.15),
        ("skin.Q", "steady", 60.0),
        ("probe.T", "5 min", probe(300.0) - 273.15),
        ("screen.Q", "steady", screen),
    ]
}

fn advection() -> Vec<Closed> {
    // 3 L/min of 868 kg/m^3 and 2010 J/(kg K)
    let mcp = 3e-3 / 60.0 * 868.0 * 2010.0;
    let g = 12.0 * 0.25;
    let gears = 40.0 + 800.0 / mcp;
    // the housing: mcp (T_gears - T) = G (T - 20)
    let housing = (mcp * gears + g * 20.0) / (mcp + g);
    vec![
        ("gears.T", "1 min", relaxed(40.0, gears, 60.0, 3000.0 / mcp)),
        ("gears.T", "steady", gears),
        ("housing.T", "steady", housing),
        ("feed.Q_from", "steady", 0.0),
        ("feed.Q_to", "steady", -800.0),
        ("flow_on.Q_to", "steady", mcp * (gears - housing)),
        ("back.Q_to", "steady", mcp * (housing - 40.0)),
    ]
}

fn source() -> Vec<Closed> {
    // C dx/dt = 40 W (1 + 0.004 x) - 1 W/K x, x over 20 degC
    let g = 1.0 - 40.0 * 0.004;
    let coil = |t: f64| relaxed(20.0, 20.0 + 40.0 / g, t, 300.0 / g);
    vec![
        ("coil.T", "5 min", coil(300.0)),
        ("coil.T", "steady", 20.0 + 40.0 / g),
        ("copper.P", "steady", 40.0 / g),
        ("sun.T", "steady", 20.0 + 0.6 * 80.0 / 2.0),
        ("ring.T", "steady", 20.0 + 0.4 * 80.0 / 4.0),
    ]
}

fn table() -> Vec<Closed> {
    // between knots: drag linear, the map bilinear in the middle of a cell
    let drag = 20.0 + 0.5 * (60.0 - 20.0);
    let mesh = 0.25 * (10.0 + 30.0 + 25.0 + 75.0);
    // pchip through (0, 4), (40, 8), (80, 10): the slopes of the secants are 1/10 and 1/20, that at
    // the middle their harmonic mean 1/15, that at the end by three points (3 x 1/20 - 1/10) / 2 =
    // 1/40; halfway the cubic is the mean of the ends and h/8 times the difference of the slopes
    let (middle, end) = (1.0 / 15.0, 1.0 / 40.0);
    // the matrix at a quarter of its rows and 8/10 of its columns
    let along = |first: f64, last: f64| first + 0.8 * (last - first);
    let winding = along(10.0, 30.0) + 0.25 * (along(25.0, 75.0) - along(10.0, 30.0));
    let film = 0.5 * (8.0 + 10.0) + 40.0 / 8.0 * (middle - end);
    vec![
        ("churning.P", "steady", drag),
        ("mesh.P", "steady", mesh),
        ("winding.P", "steady", winding),
        ("lid.Q", "steady", film * 0.2 * 60.0),
        ("case.T", "1 h", relaxed(20.0, 20.0 + drag + mesh + winding, 3600.0, 600.0)),
    ]
}

fn signal() -> Vec<Closed> {
    // G = 1 W/K, C = 100 J/K: 1 W/s for 60 s from x, then 60 W for 60 s, and again
    let tau = 100.0;
    let ramp = |t: f64, x: f64| t - tau + (tau + x) * (-t / tau).exp();
    let held = |t: f64| relaxed(ramp(60.0, 0.0), 60.0, t, tau);
    let steps = |t: f64| match t {
        t if t < 120.0 => relaxed(0.0, 10.0, t, tau),
        t => relaxed(relaxed(0.0, 10.0, 120.0, tau), 40.0, t - 120.0, tau),
    };
    vec![
        ("gears.T", "1 min", 20.0 + ramp(60.0, 0.0)),
        ("gears.T", "90 s", 20.0 + held(30.0)),
        ("gears.T", "2 min", 20.0 + held(60.0)),
        ("gears.T", "3 min", 20.0 + ramp(60.0, held(60.0))),
        ("motor.T", "3 min", 20.0 + steps(180.0)),
        ("motor.T", "steady", 30.0),
    ]
}

fn material() -> Vec<Closed> {
    // 2 kg of cp = 460 + 0.3 T over 0 degC, x over 20 degC: (932 + 0.6 x) dx/dt = -2 x
    let fall = |x: f64, t: f64| 932.0 * (x / 200.0).ln() + 0.6 * (x - 200.0) + 2.0 * t;
    let billet = |t: f64| 20.0 + root(1e-9, 200.0, |x| fall(x, t));
    // the integral of k over T in place of k dT
    let shape = std::f64::consts::PI * 0.02 * 0.02 / 4.0 / 0.1;
    let strut = shape * (50.0 * 200.0 - 0.02 * (220.0_f64.powi(2) - 20.0_f64.powi(2)));
    // 0.05 kg/s of cp = 1800 + 4 T: 1800 (x - 40) + 2 (x^2 - 1600) = 1000 W / 0.05 kg/s
    let oil = root(40.0, 200.0, |x| 1800.0 * (x - 40.0) + 2.0 * (x * x - 1600.0) - 20e3);
    vec![
        ("billet.T", "5 min", billet(300.0)),
        ("billet.T", "30 min", billet(1800.0)),
        ("strut.Q", "steady", strut),
        ("gears.T", "steady", oil),
        ("feed.Q_to", "steady", -1000.0),
    ]
}

/// Every page with its closed forms.
fn pages() -> [(&'static str, Vec<Closed>); 22] {
    [
        ("node", node()),
        ("capacitor", capacitor()),
        ("boundary", boundary()),
        ("foster", foster()),
        ("resistor", resistor()),
        ("conduction", conduction()),
        ("convection", devices::convection()),
        ("contact", joints::contact()),
        ("press_fit", joints::press_fit()),
        ("cooler", devices::cooler()),
        ("radiation", radiation()),
        ("enclosure", enclosure()),
        ("advection", advection()),
        ("fan", devices::fan()),
        ("source", source()),
        ("bearing", losses_pages::bearing()),
        ("seal", losses_pages::seal()),
        ("mesh", losses_pages::mesh()),
        ("churning", losses_pages::churning()),
        ("table", table()),
        ("signal", signal()),
        ("material", material()),
    ]
}

/// A row of a page's table: quantity, `steady` or a time, and the value as it is printed, with its
/// unit.
struct Row {
    quantity: String,
    when: String,
    number: String,
    unit: String,
}

/// The text of a page, its netlist and the rows of its results.
fn page(name: &str) -> (String, String, Vec<Row>) {
    let read = |ending: &str| {
        let path = folder().join(format!("{name}.{ending}"));
        std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    let (text, netlist) = (read("md"), read("toml"));
    assert!(text.contains(&format!("]({name}.toml)")), "{name}.md has no link to its netlist");
    let row = |line: &str| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let (number, unit) = cells.get(3)?.split_once(' ')?;
        let quantity = cells.get(1)?.strip_prefix('`')?.strip_suffix('`')?;
        let timed = cells[2] == "steady" || parse_quantity(cells[2], None).is_ok();
        let (number, unit) = (number.to_owned(), unit.to_owned());
        timed.then(|| Row {
            quantity: quantity.to_owned(),
            when: cells[2].to_owned(),
            number,
            unit,
        })
    };
    let rows = netlist.lines().filter_map(|line| row(line.strip_prefix("# ")?)).collect();
    (text, netlist, rows)
}

/// The example in a folder with the CSV files that lie beside the page, as a reader would copy it.
fn read(name: &str, netlist: &str) -> Netlist {
    let own = format!("element-{name}-{:?}", std::thread::current().id()); // tests run at once
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(own);
    std::fs::create_dir_all(&path).expect("a folder");
    for entry in std::fs::read_dir(folder()).expect("the pages") {
        let file = entry.expect("an entry").path();
        if file.extension().is_some_and(|e| e == "csv") {
            std::fs::copy(&file, path.join(file.file_name().expect("a name"))).expect("a copy");
        }
    }
    let file = path.join("example.toml");
    std::fs::write(&file, netlist).expect("the example is written");
    lptn::read(&file).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The value of a column at a row.
fn value(table: &Table, quantity: &str, row: usize) -> Option<f64> {
    let column = table.columns().iter().find(|column| column.name == quantity)?;
    column.values.get(row).copied()
}

fn seconds(time: &str) -> f64 {
    parse_quantity(time, None).expect("a time").value
}

#[test]
fn every_example_gives_what_its_closed_form_says() {
    let unit = Unit::parse("degC").expect("a unit");
    for (name, closed) in pages() {
        let netlist = read(name, &page(name).1);
        assert!(netlist.warnings.is_empty(), "{name}: {:?}", netlist.warnings);
        let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
        let selection = Selection::all(&netlist.network);
        let steady = SteadyState::solve(&system, 0.0).map(|steady| {
            Table::of_steady(&netlist.network, &steady, &selection, &unit).expect("a table")
        });
        let run =
            support::transient(&netlist).tolerance(TOLERANCE).solve(&system).expect("it runs");
        assert!(run.ledger().closes(), "{name}: {:?}", run.ledger());
        let table = Table::of_solution(&run, &selection, &unit);
        for (quantity, when, expected) in closed {
            let found = match when {
                "steady" => value(steady.as_ref().expect("a steady state"), quantity, 0),
                time => {
                    let row = run.times().iter().position(|t| (t - seconds(time)).abs() < 1e-9);
                    row.and_then(|row| value(&table, quantity, row))
                }
            };
            let found = found.unwrap_or_else(|| panic!("{name}: no {quantity} at {when}"));
            let most = if when == "steady" { 1e-8 } else { 10.0 * TOLERANCE };
            let error = (found - expected).abs();
            assert!(error <= most, "{name}: {quantity} at {when} is {found}, not {expected}");
        }
    }
}

#[test]
fn every_law_stands_in_an_example() {
    let mut laws = Vec::new();
    for kind in Kind::ALL {
        let name = kind.declaration().section;
        let network = read(name, &page(name).1).network;
        laws.extend(network.conductors().iter().map(|conductor| conductor.law.formula()));
        laws.extend(network.sources().iter().map(|source| source.law.formula()));
    }
    for law in Formula::ALL {
        assert!(laws.contains(law), "no example in docs/elements has the law {law:?}");
    }
}

#[test]
fn every_page_prints_its_closed_forms() {
    for (name, closed) in pages() {
        let (_, _, rows) = page(name);
        let listed: Vec<(&str, &str)> =
            rows.iter().map(|r| (r.quantity.as_str(), r.when.as_str())).collect();
        let known: Vec<(&str, &str)> =
            closed.iter().map(|(quantity, when, _)| (*quantity, *when)).collect();
        assert_eq!(listed, known, "{name}");
        for (row, (quantity, when, expected)) in rows.iter().zip(closed) {
            let decimals = row.number.split_once('.').map_or(0, |(_, fraction)| fraction.len());
            assert!(matches!(row.unit.as_str(), "degC" | "W" | "K"), "{name}: {}", row.unit);
            assert_eq!(
                row.number,
                format!("{expected:.decimals$}"),
                "{name}: {quantity} at {when}"
            );
        }
    }
}

#[test]
fn the_index_names_every_page_and_nothing_else() {
    let index = std::fs::read_to_string(folder().join("README.md")).expect("the index");
    let mut files: Vec<String> = std::fs::read_dir(folder())
        .expect("the pages")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a name in UTF-8"))
        .filter(|file| file.ends_with(".md") && file != "README.md")
        .collect();
    files.sort();
    let mut known: Vec<String> = pages().iter().map(|(name, _)| format!("{name}.md")).collect();
    known.sort();
    assert_eq!(files, known);
    for file in files {
        assert!(index.contains(&format!("]({file})")), "the index has no link to {file}");
    }
}

/// Every `.rs` file below a folder.
fn sources(folder: &Path, found: &mut String) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() && !path.ends_with("tests") {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push_str(&std::fs::read_to_string(&path).expect("a source"));
        }
    }
}

#[test]
fn the_codes_on_the_pages_are_codes_of_diagnostics() {
    let (mut code, mut count) = (String::new(), 0);
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("crates"), &mut code);
    for (name, _) in pages() {
        let text = page(name).0;
        let codes: Vec<&str> =
            text.split('`').filter(|part| part.contains("::") && !part.contains(' ')).collect();
        count += codes.len();
        for wanted in codes {
            assert!(
                code.contains(&format!("\"{wanted}\"")),
                "{name}: no diagnostic has the code {wanted}"
            );
        }
    }
    assert!(count > 20, "only {count} codes were found");
}
