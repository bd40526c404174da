//! Properties of substances as functions: printed values, names, places.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_netlist::{Netlist, parse};

fn netlist(text: &str) -> Netlist {
    let text = format!(
        "format = 1\n[boundary]\nair = {{ T = \"25 degC\" }}\n[node]\na = {{ C = \"1 J/K\", T0 = \
         \"25 degC\" }}\n[resistor]\nr = {{ from = \"a\", to = \"air\", R = \"1 K/W\" }}\n{text}"
    );
    parse("net.toml", &text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

/// Reference: values printed in tables. Water: IAPWS R6-95 and R12-08 at saturation, rounded as in
/// VDI Heat Atlas (2010), D2.1, table 2 (rho, cp, lambda, eta). Air at 1 atm: Incropera et al., 7th
/// edition, table A.4, 350 K. Steel: EN 1993-1-2, 3.4.1.2 and 3.4.1.3, 600 degC:
/// 666 + 13002/(738 - 600) = 760.2 J/(kg K), 54 - 0.0333 * 600 = 34.0 W/(m K).
#[test]
fn functions_are_those_of_printed_tables() {
    let cases = [
        ("water.density(20 [degC])", 998.2, 1e-3),
        ("water.cp(20 [degC])", 4185.0, 1e-3),
        ("water.k(20 [degC])", 0.598, 3e-3),
        ("water.viscosity(20 [degC])", 1001.6e-6, 1e-3),
        ("water.density(80 [degC])", 971.8, 1e-3),
        ("water.viscosity(80 [degC])", 354.0e-6, 2e-3),
        ("water.expansion(50 [degC])", 0.4576e-3, 1e-2),
        ("air.density(76.85 [degC])", 0.9950, 1.5e-2),
        ("air.k(76.85 [degC])", 0.0300, 2e-3),
        ("air.viscosity(76.85 [degC])", 208.2e-7, 3e-3),
        ("air.cp(76.85 [degC])", 1009.0, 1e-3),
        ("steel_en_1993.cp(600 [degC])", 760.2, 1e-3),
        ("steel_en_1993.k(600 [degC])", 34.02, 1e-3),
    ];
    for (text, expected, within) in cases {
        let netlist = netlist(&format!("[param]\nvalue = \"{text}\"\n"));
        let id = netlist.network.parameter("value").unwrap();
        let found = netlist.network.parameter_value(id);
        assert!((found / expected - 1.0).abs() < within, "{text}: {found} is not {expected}");
    }
}

/// A fluid of the file hides that of the library, and its use by a call counts as one.
#[test]
fn a_fluid_of_the_file_hides_that_of_the_library() {
    let netlist = netlist(
        "[fluid]\nwater = { cp = \"1 J/(kg K)\", k = { x = [\"0 degC\", \"100 degC\"], y = [\"1 \
         W/(m K)\", \"3 W/(m K)\"] } }\n[param]\nk = \"water.k(50 [degC])\"\n[source]\nP = { into = \
         \"a\", P = \"k * 1 [m K]\" }\n",
    );
    let k = netlist.network.parameter("k").unwrap();
    assert!((netlist.network.parameter_value(k) - 2.0).abs() < 1e-12);
    assert!(netlist.warnings.is_empty(), "{:?}", netlist.warnings);
}
