//! Exact sensitivities of temperatures by parameters: for every kind of element against
//! central differences of whole runs.

#![allow(clippy::unwrap_used, reason = "what fails here fails the test")]

use crate::support;

use lptn::prelude::*;
use lptn_network::ParameterId;
use support::{parsed, transient};

/// Central differences of runs with a tolerance of 1e-10 K and this relative change of a parameter.
const CHANGE: f64 = 2e-4;

/// Relative to the largest sensitivity of the record.
const AGREEMENT: f64 = 1e-5;

fn run(text: &str, change: Option<(ParameterId, f64)>, by: &[ParameterId]) -> Solution {
    let (netlist, _) = parsed(text);
    let mut overrides = netlist.network.overrides();
    if let Some((id, value)) = change {
        overrides.set(id, value);
    }
    let network = netlist.network.with(&overrides).unwrap();
    let system = ThermalSystem::assemble(&network).unwrap();
    transient(&netlist).tolerance(1e-10).sensitivities(by).solve(&system).unwrap()
}

/// Every node's sensitivity by every parameter.
fn agrees(text: &str) {
    let (netlist, _) = parsed(text);
    agrees_by(text, &netlist.network.parameter_ids().collect::<Vec<_>>());
}

fn agrees_by(text: &str, all: &[ParameterId]) {
    let (netlist, _) = parsed(text);
    let network = &netlist.network;
    let exact = run(text, None, all);
    for &id in all {
        let value = network.parameter_value(id);
        // a change of an absolute temperature is one in K
        let step =
            if network.parameters()[id.index()].ty.absolute { 0.05 } else { CHANGE * value.abs() };
        let above = run(text, Some((id, value + step)), &[]);
        let below = run(text, Some((id, value - step)), &[]);
        for node in network.node_ids() {
            let [above, below] = [&above, &below].map(|s| s.temperature(node).unwrap());
            let differences: Vec<f64> =
                above.iter().zip(&below).map(|(a, b)| (a - b) / (2.0 * step)).collect();
            let found = exact.sensitivity(id, node).unwrap();
            let largest = differences.iter().map(|d| d.abs()).fold(0.0, f64::max);
            // what the runs themselves do not resolve
            let least = 1e-9 / step;
            for (row, (found, expected)) in found.iter().zip(&differences).enumerate() {
                let name = &network.nodes()[node.index()].name;
                let parameter = &network.parameters()[id.index()].name;
                assert!(
                    (found - expected).abs() <= AGREEMENT * largest + least,
                    "d {name} / d {parameter} at row {row}: {found:e}, differences say \
                     {expected:e} of {largest:e}"
                );
            }
        }
    }
}

/// A block that is heated and cooled through the element under test, `ends` being its ends.
fn with(param: &str, element: &str) -> String {
    format!(
        "format = 1
[param]
P = \"50 W\"
C = \"200 J/K\"
{param}
[node]
hot = {{ T0 = \"40 degC\", C = \"C\" }}
cold = {{ T0 = \"20 degC\", C = \"300 J/K\" }}
[boundary]
air = {{ T = \"20 degC\" }}
[resistor]
out = {{ from = \"cold\", to = \"air\", G = \"2 W/K\" }}
[source]
heat = {{ into = \"hot\", P = \"P\" }}
{element}
[run]
stop = \"10 min\"
output = {{ every = \"30 s\" }}
"
    )
}

#[test]
fn resistors_and_conductances() {
    agrees(&with("R = \"0.5 K/W\"", "[resistor.path]\nfrom = \"hot\"\nto = \"cold\"\nR = \"R\""));
    agrees(&with("G = \"3 W/K\"", "[resistor.path]\nfrom = \"hot\"\nto = \"cold\"\nG = \"G\""));
    let varying = "[resistor.path]\nfrom = \"hot\"\nto = \"cold\"\nG = \"G * (1 + b * dT + 0.01 \
        [1/K] * (T_mean - 20 [degC]))\"";
    agrees(&with("G = \"3 W/K\"\nb = \"0.02 1/K\"", varying));
}

#[test]
fn bodies_that_conduct() {
    let material = "[material.alloy]\nk = \"k0 * (1 + beta * (T - 20 [degC]))\"\n";
    let param = "k0 = \"40 W/(m K)\"\nbeta = \"0.002 1/K\"\na = \"0.01 m^2\"\nlength = \"0.1 \
        m\"\nr1 = \"20 mm\"\nr2 = \"30 mm\"";
    for shape in [
        "shape = \"slab\"\narea = \"a\"\nthickness = \"length\"",
        "shape = \"cylinder\"\nr_in = \"r1\"\nr_out = \"r2\"\nlength = \"length / 10\"",
        "shape = \"sphere\"\nr_in = \"r1\"\nr_out = \"r2\"",
        "shape = \"rod\"\ndiameter = \"2 * r1\"\nlength = \"length\"",
    ] {
        let element = format!(
            "{material}[conduction.path]\nfrom = \"hot\"\nto = \"cold\"\nmaterial \
             = \"alloy\"\n{shape}"
        );
        agrees(&with(param, &element));
    }
}

#[test]
fn films_and_contacts() {
    let element = "[convection.path]\nfrom = \"hot\"\nto = \"cold\"\nh = \"h * (1 + abs(dT / 10 \
        [K]))^0.25\"\narea = \"a\"
[contact.joint]\nfrom = \"hot\"\nto = \"cold\"\nh = \"hc\"\narea = \"a\"";
    agrees(&with("h = \"20 W/(m^2 K)\"\na = \"0.05 m^2\"\nhc = \"10 W/(m^2 K)\"", element));
}

#[test]
fn radiation() {
    let areas = "[radiation.path]\nfrom = \"hot\"\nto = \"cold\"\nGr = \"Gr\"";
    agrees(&with("Gr = \"0.05 m^2\"", areas));
    let surfaces = "[radiation.path]\nfrom = \"hot\"\nto = \"air\"\nemissivity = \"e\"\narea \
        = \"a\"\nview_factor = \"F\"";
    agrees(&with("e = 0.8\na = \"0.1 m^2\"\nF = 0.9", surfaces));
    let plates = "[radiation.path]\nfrom = \"hot\"\nto = \"cold\"\nemissivity = \
        [\"e1\", \"e2\"]\narea = \"a\"";
    agrees(&with("e1 = 0.8\ne2 = 0.5\na = \"0.3 m^2\"", plates));
}

#[test]
fn streams() {
    let rate = "[advection.path]\nfrom = \"hot\"\nto = \"cold\"\nmcp \
        = \"m\"\n[advection.back]\nfrom = \"cold\"\nto = \"hot\"\nmcp = \"m\"";
    agrees(&with("m = \"3 W/K\"", rate));
    let fluid = "[fluid.oil]\ndensity = \"rho * (1 - 0.0006 [1/K] * (T - 20 [degC]))\"\ncp \
        = \"2000 [J/(kg K)] * (1 + 0.002 [1/K] * (T - 20 [degC]))\"
[advection.path]\nfrom = \"hot\"\nto = \"cold\"\nfluid = \"oil\"\nflow = \"V\"\nflow_T = \"T_pump\"
[advection.back]\nfrom = \"cold\"\nto = \"hot\"\nfluid = \"oil\"\nflow = \"V\"\nflow_T \
= \"T_pump\"";
    agrees(&with("rho = \"870 kg/m^3\"\nV = \"0.1 L/min\"\nT_pump = \"30 degC\"", fluid));
    let mass = "[fluid.oil]\ncp = \"cp\"\n[advection.path]\nfrom = \"hot\"\nto = \"cold\"\nfluid \
        = \"oil\"\nflow = \"m\"
[advection.back]\nfrom = \"cold\"\nto = \"hot\"\nfluid = \"oil\"\nflow = \"m\"";
    agrees(&with("cp = \"2000 J/(kg K)\"\nm = \"2 g/s\"", mass));
}

#[test]
fn boundaries_and_starts() {
    let text = "format = 1
[param]
T_room = \"22 degC\"
dT_start = \"5 K\"
G = \"1.5 W/K\"
swing = \"4 K\"
[boundary]
room = { T = \"T_room + swing * sin(2 * pi * t / 20 [min])\" }
[node]
a = { T0 = \"T_room + dT_start\", C = \"100 J/K\" }
b = { T0 = \"T_room - 2 * dT_start\", C = \"50 J/K\" }
[resistor]
ab = { from = \"a\", to = \"b\", G = \"G\" }
out = { from = \"b\", to = \"room\", G = \"0.5 W/K\" }
[radiation]
sky = { from = \"a\", to = \"room\", Gr = \"0.1 m^2\" }
[run]
stop = \"10 min\"
output = { every = \"30 s\" }
";
    agrees(text);
}

#[test]
fn sources_of_time_temperature_and_signals() {
    let element =
        "[signal]\nduty = { t = [\"0 s\", \"3 min\", \"5 min\"], v = [1, 0, 0.5], interp \
        = \"previous\", after_end = \"hold\" }
shaped = \"gain * duty * (1 + t / tau)\"
[source.more]\ninto = { hot = 0.25, cold = 0.75 }\nP = \"30 [W] * shaped\"
[source.loss]\ninto = \"hot\"\nP = \"q0 * exp(-b * (T - 20 [degC])) + 0.1 [W/K] * (cold.T - 20 \
[degC])\"";
    agrees(&with("gain = 1.2\ntau = \"4 min\"\nq0 = \"20 W\"\nb = \"0.02 1/K\"", element));
}

#[test]
fn tables_of_speed_and_temperature() {
    let element = "[table]
loss = { x = [\"0 rpm\", \"3000 rpm\", \"7000 rpm\"], y = [\"0 W\", \"30 W\", \"90 W\"], interp \
= \"pchip\" }
thin = { x = [\"0 degC\", \"40 degC\", \"200 degC\"], y = [1, 0.7, 0.3] }
[source.mesh]\ninto = \"hot\"\nP = \"loss(omega) * thin(T)\"
[resistor.path]\nfrom = \"hot\"\nto = \"cold\"\nG = \"1 [W/K] * (1 + thin(T_mean)) * (omega / 4000 \
[rpm])^0.5\"";
    agrees(&with("omega = \"4200 rpm\"", element));
}

#[test]
fn parts_written_as_templates() {
    let element = "[template.stage]
port = [\"case\"]
[template.stage.param]
R = { unit = \"K/W\" }
[template.stage.node]
gear = { T0 = \"20 degC\", C = \"80 J/K\" }
[template.stage.resistor]
mesh = { from = \"gear\", to = \"case\", R = \"R\" }
[use.stages]
template = \"stage\"
count = 2
connect = { case = \"cold\" }
set = { R = \"2 * R_mesh\" }
[resistor.path]\nfrom = \"hot\"\nto = \"stages[1].gear\"\nR = \"R_mesh\"";
    let text = with("R_mesh = \"0.2 K/W\"", element);
    let (netlist, _) = parsed(&text);
    agrees_by(&text, &[netlist.network.parameter("R_mesh").unwrap()]); // those of the stages follow it
}

#[test]
fn capacities_of_parts_and_materials() {
    let text = |capacity: &str| {
        format!(
            "format = 1
[param]
m = \"1.5 kg\"
m2 = \"0.5 kg\"
c0 = \"470 J/(kg K)\"
bend = \"0.002 1/K\"
P = \"300 W\"
T_start = \"20 degC\"
[material]
steel = {{ density = \"7800 kg/m^3\", cp = \"c0 * (1 + bend * (T - 20 [degC]))\" }}
brass = {{ density = \"8500 kg/m^3\", cp = \"380 J/(kg K)\" }}
[boundary]
air = {{ T = \"20 degC\" }}
[node]
body = {{ T0 = \"T_start\"{capacity} }}
[resistor]
out = {{ from = \"body\", to = \"air\", G = \"4 W/K\" }}
[source]
heat = {{ into = \"body\", P = \"P\" }}
[run]
stop = \"10 min\"
output = {{ every = \"30 s\" }}
"
        )
    };
    agrees(&text(", C = \"m * c0 + 100 [J/K]\""));
    agrees(&text(", material = \"brass\", volume = \"m / (8500 [kg/m^3])\""));
    agrees(&text(", material = \"steel\", mass = \"m\""));
    let parts = text("")
        + "[capacitor]\ngears = { node = \"body\", material = \"steel\", mass = \"m\" }\ncase = { \
            node = \"body\", material = \"brass\", mass = \"m2\" }\n";
    agrees(&parts);
}

#[test]
fn wax_that_melts() {
    let text = "format = 1
[param]
m = \"0.05 kg\"
P = \"20 W\"
G = \"0.3 W/K\"
[material.wax]
density = \"900 kg/m^3\"
cp = \"2000 J/(kg K)\"
solidus = \"40 degC\"
liquidus = \"44 degC\"
latent_heat = \"200 kJ/kg\"
[boundary]
air = { T = \"20 degC\" }
[node]
pack = { T0 = \"20 degC\", material = \"wax\", mass = \"m\" }
[resistor]
out = { from = \"pack\", to = \"air\", G = \"G\" }
[source]
heat = { into = \"pack\", P = \"P\" }
[run]
stop = \"20 min\"
output = { every = \"1 min\" }
";
    agrees(text);
}

#[test]
fn massless_nodes_linear_and_not() {
    let text = "format = 1
[param]
P = \"40 W\"
R1 = \"0.4 K/W\"
R2 = \"0.7 K/W\"
Gr = \"0.2 m^2\"
T_air = \"25 degC\"
[boundary]
air = { T = \"T_air\" }
[node]
hot = { T0 = \"25 degC\", C = \"150 J/K\" }
star = { massless = true }
skin = { massless = true }
[resistor]
a = { from = \"hot\", to = \"star\", R = \"R1\" }
b = { from = \"star\", to = \"air\", R = \"R2\" }
c = { from = \"hot\", to = \"skin\", R = \"R1 + R2\" }
[radiation]
glow = { from = \"skin\", to = \"air\", Gr = \"Gr\" }
[source]
heat = { into = { hot = 0.5, star = 0.5 }, P = \"P\" }
sun = { into = \"skin\", P = \"P / 8\" }
[run]
stop = \"10 min\"
output = { every = \"30 s\" }
";
    agrees(text);
}

#[test]
fn networks_without_any_capacity() {
    let text = "format = 1
[param]
P = \"40 W\"
R = \"0.4 K/W\"
Gr = \"0.2 m^2\"
T_air = \"25 degC\"
[boundary]
air = { T = \"T_air\" }
[node]
star = { massless = true }
skin = { massless = true }
[resistor]
a = { from = \"star\", to = \"skin\", R = \"R\" }
[radiation]
glow = { from = \"skin\", to = \"air\", Gr = \"Gr\" }
[source]
heat = { into = \"star\", P = \"P * (1 + t / 10 [min])\" }
[run]
stop = \"10 min\"
output = { every = \"1 min\" }
";
    agrees(text);
}

#[test]
fn grids() {
    let text = "format = 1
[param]
k = \"15 W/(m K)\"
L = \"40 mm\"
P = \"60 W\"
[material.alloy]
density = \"7900 kg/m^3\"
cp = \"500 J/(kg K)\"
k = \"k\"
[grid.wall]
size = [\"L\", \"50 mm\", \"50 mm\"]
cells = [5, 2, 1]
material = \"alloy\"
T0 = \"20 degC\"
[boundary]
air = { T = \"20 degC\" }
[node]
plate = { T0 = \"20 degC\", C = \"40 J/K\" }
[contact]
foot = { from = \"plate\", to = \"wall.x0\", h = \"2000 W/(m^2 K)\", area = \"25 cm^2\" }
[convection]
skin = { from = \"wall.x1\", to = \"air\", h = \"200 W/(m^2 K)\", area = \"25 cm^2\" }
[source]
heat = { into = \"plate\", P = \"P\" }
[run]
stop = \"10 min\"
output = { every = \"1 min\" }
";
    agrees(text);
}

#[test]
fn parameters_on_parameters() {
    let element = "[resistor.path]\nfrom = \"hot\"\nto = \"cold\"\nR = \"R\"";
    let text = with("r = \"0.1 K/W\"\nR = \"r * 5\"", element);
    let (netlist, _) = parsed(&text);
    let [r, on_r] = ["r", "R"].map(|name| netlist.network.parameter(name).unwrap());
    agrees_by(&text, &[r]);
    agrees_by(&text, &[on_r]);
    // asked for together, each is a variable of its own and nothing is left that reads `r`
    let both = run(&text, None, &[r, on_r]);
    let hot = netlist.network.node("hot").unwrap();
    assert!(both.sensitivity(r, hot).unwrap().iter().all(|s| *s == 0.0));
}

#[test]
fn what_has_no_exact_derivative_is_refused() {
    let controlled = with(
        "P2 = \"5 W\"",
        "[resistor.path]\nfrom = \"hot\"\nto = \"cold\"\nG = \"1 [W/K] + 2 [W/K] * \
         fan\"\n[control]\nfan = { sense = \"hot\", on_above = \"60 degC\", off_below = \"50 \
         degC\" }",
    );
    let moving = with(
        "t_on = \"2 min\"",
        "[resistor.path]\nfrom = \"hot\"\nto = \"cold\"\nG = \"if(t > t_on, 2 [W/K], 1 [W/K])\"",
    );
    for (text, words) in [(controlled, "switches"), (moving, "jumps at a time that moves")] {
        let (netlist, system) = parsed(&text);
        let ids: Vec<ParameterId> = netlist.network.parameter_ids().collect();
        let error = transient(&netlist).sensitivities(&ids).solve(&system).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
    let still = with(
        "t_on = \"2 min\"",
        "[resistor.path]\nfrom = \"hot\"\nto = \"cold\"\nG = \"if(t > 3 [min], 2 [W/K], 1 [W/K])\"",
    );
    agrees(&still);
}
