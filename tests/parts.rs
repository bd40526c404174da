//! Kind: reference. `networks/gearbox_parts.toml` against the printed formulas of its seals and
//! bearings, in their printed units, solved for the temperature by iteration; and the table of
//! `docs/parts.md`.

use crate::support;

use lptn::prelude::*;
use support::shipped;

const RPM: [f64; 7] = [1000.0, 2000.0, 3000.0, 4000.0, 5000.0, 6000.0, 7000.0];
const AMBIENT: f64 = 25.5;
const R_EQ: f64 = 0.3046;

/// ASTM D341 through 100 mm^2/s at 40 and 32 mm^2/s at 100 degC, in mm^2/s.
fn viscosity(celsius: f64) -> f64 {
    let ordinate = |nu: f64| (nu + 0.7).log10().log10();
    let at = |t: f64| (t + 273.15_f64).log10();
    let slope = (ordinate(32.0) - ordinate(100.0)) / (at(100.0) - at(40.0));
    let y = ordinate(100.0) + slope * (at(celsius) - at(40.0));
    10.0_f64.powf(10.0_f64.powf(y)) - 0.7
}

/// Power of the seals, of the two carrier bearings and of the three planet bearings in W.
fn parts(rpm: f64, celsius: f64) -> [f64; 3] {
    let carrier = rpm * 18.0 / 120.0;
    let planet = (rpm - carrier) * 18.0 / 42.0;
    let bearing = |f0: f64, d_m: f64, n: f64| {
        let rolled = (viscosity(celsius) * n).powf(2.0 / 3.0).max(160.0);
        1e-10 * f0 * rolled * d_m.powi(3) * n * std::f64::consts::PI / 30.0
    };
    let seals = 2.0 * 7.69e-6 * 80.0_f64.powi(2) * carrier;
    [seals, 2.0 * bearing(1.0, 90.0, carrier), 3.0 * bearing(12.0, 12.0, planet)]
}

fn total(rpm: f64, celsius: f64) -> f64 {
    parts(rpm, celsius).iter().sum()
}

/// The temperature of the steel that its own heat keeps it at, in degC.
fn settled(rpm: f64) -> f64 {
    (0..400).fold(AMBIENT, |celsius, _| AMBIENT + R_EQ * total(rpm, celsius))
}

fn exponent(rpm: f64, power: impl Fn(f64) -> f64) -> f64 {
    let step = 1e-4;
    (power(rpm * (1.0 + step)) / power(rpm * (1.0 - step))).ln()
        / ((1.0 + step) / (1.0 - step)).ln()
}

#[test]
fn the_steady_states_are_those_of_the_printed_formulas() {
    let (netlist, _) = shipped("gearbox_parts.toml");
    for rpm in RPM {
        let mut netlist = netlist.clone();
        netlist.set(&[format!("omega={rpm}rpm")]).expect("a speed");
        let system = ThermalSystem::assemble(&netlist.network).expect("it assembles");
        let steady = SteadyState::solve(&system, 0.0).expect("a steady state");
        let steel = steady.temperatures[0] - 273.15;
        assert!((steel - settled(rpm)).abs() < 1e-6, "{steel} at {rpm} rpm");
        let [seals, carrier, planets] = parts(rpm, steel);
        let found = &steady.source_heat;
        for (found, expected) in [
            (found.iter().sum::<f64>(), seals + carrier + planets),
            (steady.boundary_heat.iter().sum::<f64>(), -(seals + carrier + planets)),
        ] {
            assert!((found - expected).abs() < 1e-8 * expected.abs(), "{found}, not {expected}");
        }
        for part in [seals / 2.0, carrier / 2.0, planets / 3.0] {
            let close = |heat: &&f64| (**heat - part).abs() < 1e-8 * part;
            assert!(found.iter().filter(close).count() >= 2, "no element loses {part} W");
        }
    }
}

#[test]
fn the_page_prints_the_formulas() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let page = std::fs::read_to_string(folder.join("docs/parts.md")).expect("the page");
    for rpm in RPM {
        let steel = settled(rpm);
        let [seals, carrier, planets] = parts(rpm, steel);
        let held = exponent(rpm, |n| total(n, steel));
        let followed = exponent(rpm, |n| total(n, settled(n)));
        let row = format!(
            "| {rpm} | {steel:.1} | {seals:.1} | {carrier:.1} | {planets:.1} | {:.1} | {:.1} | \
             {held:.2} | {followed:.2} |",
            total(rpm, steel),
            87e-6 * rpm.powf(5.0 / 3.0),
        );
        assert!(page.contains(&row), "{row}");
    }
    let cold = total(7000.0, AMBIENT);
    assert!(page.contains(&format!("falls from {cold:.0} W cold to 133 W warm")), "{cold}");
}
