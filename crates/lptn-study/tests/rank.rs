//! What one temperature answers, against closed forms.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use lptn_assembly::ThermalSystem;
use lptn_netlist::{Netlist, parse};
use lptn_network::Item;
use lptn_solve::{Influence, Proceed, SteadyState};
use lptn_study::{RankError, Ranking, effect, has_effect};

fn read(text: &str) -> Netlist {
    parse("rank.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn steady(netlist: &Netlist, node: Option<&str>) -> Ranking {
    let network = &netlist.network;
    let system = ThermalSystem::assemble(network).unwrap();
    let steady = SteadyState::solve(&system, 0.0).unwrap();
    let node = node.map(|name| network.node(name).unwrap());
    Ranking::steady(&system, &steady, node).unwrap_or_else(|error| panic!("{error}"))
}

fn of_run(netlist: &Netlist) -> Result<Ranking, RankError> {
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let settings = netlist.run.as_ref().unwrap();
    Ranking::of_run(&system, (settings, None), &|_| Proceed::Continue)
}

/// The change for 10 % or 1 K by the name of what is changed.
fn change(netlist: &Netlist, influences: &[Influence], name: &str) -> f64 {
    let network = &netlist.network;
    let found = influences.iter().find(|influence| {
        let own = network.name_of(influence.of);
        match influence.of {
            Item::Parameter(_) => own == name,
            _ => format!("{own}.{}", influence.field.key()) == name,
        }
    });
    effect(found.unwrap_or_else(|| panic!("{name} does nothing")))
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{found:e} is not {expected:e}");
}

/// 100 W over R_in and a massless joint into air of 20 degC: T = T_air + P (R_in + 1 / G).
const CHAIN: &str = "format = 1\n[param]\nP = \"100 W\"\nG = \"4 W/K\"\nT_air = \"20 degC\"\n\
    idle = 3\n[default]\nT0 = \"20 degC\"\n[node]\ncore = { C = \"1 kJ/K\" }\njoint = { massless = \
    true }\n[boundary]\nair = { T = \"T_air\" }\n[resistor]\nfit = { from = \"core\", to = \
    \"joint\", R = \"0.05 K/W\" }\nskin = { from = \"joint\", to = \"air\", G = \"G\" }\n[source]\n\
    loss = { into = \"core\", P = \"P\" }\n[run]\nstop = \"10 min\"\ntolerance = \"1e-8 K\"\n";

#[test]
fn a_chain_is_ranked_by_its_temperature_drops() {
    let netlist = read(CHAIN);
    let ranking = steady(&netlist, None);
    let elements = |name| change(&netlist, &ranking.elements, name);
    near(elements("loss.P"), 0.1 * 100.0 * (0.05 + 0.25));
    near(elements("fit.R"), 0.1 * 100.0 * 0.05);
    near(elements("skin.G"), -0.1 * 100.0 * 0.25);
    near(elements("air.T"), 1.0);
    let parameters = |name| change(&netlist, &ranking.parameters, name);
    near(parameters("P"), 3.0);
    near(parameters("G"), -2.5);
    near(parameters("T_air"), 1.0);
    // an element that does nothing is not there, a parameter is; the most comes first
    assert_eq!((ranking.parameters.len(), ranking.elements.len()), (4, 4));
    let sizes: Vec<f64> = ranking.elements.iter().map(|i| effect(i).abs()).collect();
    assert!(sizes.is_sorted_by(|a, b| a >= b), "{sizes:?}");
    assert!(ranking.feedback.is_none());
    // a massless node answers too: T_air + P / G
    let joint = steady(&netlist, Some("joint"));
    near(change(&netlist, &joint.elements, "skin.G"), -2.5);
    assert!(joint.elements.iter().all(|i| netlist.network.name_of(i.of) != "fit"));
}

/// T = T_air + P R (1 - exp(-t / (R C))) is highest at the end of a run.
#[test]
fn the_end_of_a_step_is_ranked_by_its_exponential() {
    let text = "format = 1\n[param]\nP = \"50 W\"\nR = \"0.5 K/W\"\nC = \"800 J/K\"\nT_air = \"20 \
        degC\"\n[node]\nbody = { C = \"C\", T0 = \"T_air\" }\n[boundary]\nair = { T = \"T_air\" \
        }\n[resistor]\nskin = { from = \"body\", to = \"air\", R = \"R\" }\n[source]\nloss = { \
        into = \"body\", P = \"P\" }\n[run]\nstop = \"10 min\"\ntolerance = \"1e-9 K\"\n";
    let netlist = read(text);
    let ranking = of_run(&netlist).unwrap();
    let (p, r, c, t): (f64, f64, f64, f64) = (50.0, 0.5, 800.0, 600.0);
    let x = t / (r * c);
    let left = (-x).exp();
    assert!((ranking.temperature - 293.15 - p * r * (1.0 - left)).abs() < 1e-6);
    assert!((ranking.at.unwrap() - t).abs() < 1e-9);
    let close = |name: &str, exact: f64| {
        let found = change(&netlist, &ranking.parameters, name);
        assert!((found - exact).abs() < 1e-6, "{name}: {found} is not {exact}");
    };
    close("P", 0.1 * p * r * (1.0 - left));
    close("R", 0.1 * p * r * (1.0 - left - x * left));
    close("C", -0.1 * p * r * x * left);
    close("T_air", 1.0);
    assert!(ranking.elements.is_empty() && ranking.differences.is_none());
}

/// Heat of 20 W + a (T - T_air) over R comes back a R times: T - T_air = 20 W R / (1 - a R).
#[test]
fn heat_that_grows_with_temperature_comes_back() {
    let text = "format = 1\n[param]\na = \"0.6 W/K\"\n[node]\nbody = { C = \"1 kJ/K\", T0 = \"20 \
        degC\" }\n[boundary]\nair = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"body\", to \
        = \"air\", R = \"1.25 K/W\" }\n[source]\nloss = { into = \"body\", P = \"20 [W] + a * \
        (body.T - air.T)\" }\n";
    let netlist = read(text);
    let ranking = steady(&netlist, None);
    let feedback = ranking.feedback.as_ref().unwrap();
    near(feedback.gain, 0.75);
    near(ranking.slowest.unwrap(), (0.8 - 0.6) / 1000.0);
    assert_eq!(netlist.network.sources()[feedback.source.index()].name(), "loss");
    near(change(&netlist, &ranking.parameters, "a"), 0.1 * 0.6 * 20.0 * 1.25 * 1.25 / 0.0625);
    near(change(&netlist, &ranking.elements, "skin.R"), 0.1 * 20.0 * 1.25 / 0.0625);
    // all of it shifts with the air
    near(change(&netlist, &ranking.elements, "air.T"), 1.0);
}

/// Air that streams through two nodes, one of which glows: boundaries against differences.
#[test]
fn boundaries_act_through_streams_and_radiation() {
    let text = "format = 1\n[param]\nT_in = \"20 degC\"\nT_wall = \"60 degC\"\n[default]\nT0 = \"20 \
        degC\"\n[node]\na = { C = \"1 J/K\" }\nb = { C = \"1 J/K\" }\nplate = { C = \"1 kJ/K\" \
        }\n[boundary]\ninlet = { T = \"T_in\" }\nwall = { T = \"T_wall\" }\n[advection]\ns1 = { \
        from = \"inlet\", to = \"a\", mcp = \"2 W/K\" }\ns2 = { from = \"a\", to = \"b\", mcp = \"2 \
        W/K\" }\ns3 = { from = \"b\", to = \"inlet\", mcp = \"2 W/K\" }\n[convection]\nfilm = { \
        from = \"plate\", to = \"b\", h = \"8 [W/(m^2 K)]*(abs(dT)/1 [K])^0.25\", area = \"0.2 m^2\" \
        }\n[radiation]\nglow = { from = \"plate\", to = \"wall\", emissivity = 0.8, area = \"0.3 \
        m^2\" }\n[source]\nloss = { into = \"plate\", P = \"300 W\" }\n";
    let netlist = read(text);
    let ranking = steady(&netlist, Some("plate"));
    let at = |inlet: f64, wall: f64| {
        let network = &netlist.network;
        let mut given = network.given();
        for (name, value) in [("T_in", inlet), ("T_wall", wall)] {
            given.set(network.parameter(name).unwrap(), 273.15 + value);
        }
        let system = ThermalSystem::of(network, &given).unwrap();
        SteadyState::solve(&system, 0.0).unwrap()[network.node("plate").unwrap()]
    };
    let slope = |of: &dyn Fn(f64) -> f64| {
        let pair = |step: f64| (of(step) - of(-step)) / (2.0 * step);
        (4.0 * pair(0.01) - pair(0.02)) / 3.0
    };
    for (name, exact) in [
        ("inlet.T", slope(&|step| at(20.0 + step, 60.0))),
        ("wall.T", slope(&|step| at(20.0, 60.0 + step))),
    ] {
        let found = change(&netlist, &ranking.elements, name);
        assert!((found - exact).abs() < 1e-7, "{name}: {found} is not {exact}");
    }
}

/// The paths of a body are one value: a wall of cells is a resistance of L / (k A).
#[test]
fn a_body_has_one_conductivity() {
    let text = "format = 1\n[grid.wall]\nsize = [\"0.1 m\", \"0.4 m\", \"0.5 m\"]\ncells = [5, 2, \
        2]\nk = \"2 W/(m K)\"\ndensity = \"1000 kg/m^3\"\ncp = \"1000 J/(kg K)\"\nT0 = \"20 degC\"\n\
        [boundary]\nroom = { T = \"20 degC\" }\n[convection]\nskin = { from = \"wall.x1\", to = \
        \"room\", h = \"10 W/(m^2 K)\" }\n[source]\nsun = { into = \"wall.x0\", P = \"50 W\" }\n";
    let netlist = read(text);
    let ranking = steady(&netlist, None);
    assert!((ranking.temperature - 293.15 - 50.0 * (0.1 / 0.4 + 1.0 / 2.0)).abs() < 1e-9);
    near(change(&netlist, &ranking.elements, "wall.k"), -0.1 * 50.0 * 0.25);
    near(change(&netlist, &ranking.elements, "skin.h"), -0.1 * 50.0 * 0.5);
    let area = ranking.elements.iter().find(|influence| influence.field.key() == "area").unwrap();
    near(area.value, 0.2);
}

/// As in `uncertainty_linear.rs`: P_high warms the chip by R_pad + R_skin (1 - exp(-2)) each W before
/// it falls to P_low, which comes too late.
#[test]
fn a_peak_before_a_jump_is_ranked_on_its_own_side() {
    let netlist = read(
        "format = 1\n[param]\nP_high = \"100 W\"\nP_low = \"60 W\"\n[node]\nbody = { C = \"1 kJ/K\", T0 \
         = \"20 degC\" }\nchip = { massless = true }\n[boundary]\nair = { T = \"20 degC\" }\n\
         [resistor]\npad = { from = \"chip\", to = \"body\", R = \"0.5 K/W\" }\nskin = { from = \
         \"body\", to = \"air\", R = \"0.3 K/W\" }\n[source]\nloss = { into = \"chip\", P = \"if(t < 10 \
         [min], P_high, P_low)\" }\n[run]\nstop = \"20 min\"\n",
    );
    let ranking = of_run(&netlist).unwrap();
    let exact = 10.0 * (0.5 - 0.3 * f64::exp_m1(-2.0));
    assert!((change(&netlist, &ranking.parameters, "P_high") - exact).abs() < 1e-4);
    // P_low comes too late: it is listed, and does nothing
    let idle = ranking.parameters.iter().filter(|influence| !has_effect(influence));
    assert_eq!((idle.count(), ranking.parameters.len()), (1, 2));
    assert_eq!(change(&netlist, &ranking.parameters, "P_low").to_bits(), 0);
}

/// Teeth are counted, so no value next to theirs has a run; the rest is ranked, in steady state, with
/// exact sensitivities and by differences alike.
#[test]
fn counts_are_left_out_and_the_rest_is_ranked() {
    let text = |skin: &str, fan: &str| {
        format!(
            "format = 1\n[param]\nteeth = 20\nG = \"1 W/K\"\n[node]\ngears = {{ C = \"2 kJ/K\", T0 = \"20 \
             degC\" }}\n[boundary]\nair = {{ T = \"20 degC\" }}\n{fan}[resistor]\nskin = {{ from = \
             \"gears\", to = \"air\", G = \"{skin}\" }}\n[mesh.pair]\ninto = \"gears\"\nspeed = \"1500 \
             rpm\"\ntorque = \"30 N m\"\nz1 = \"teeth\"\nz2 = 60\nmodule = \"3 mm\"\nwidth = \"30 mm\"\n\
             Ra = \"0.5 um\"\nnu = \"60 mm^2/s\"\ndensity = \"860 kg/m^3\"\nmodel = \"external\"\n\
             [run]\nstop = \"30 min\"\n"
        )
    };
    let fan =
        "[control]\nfan = { sense = \"gears\", on_above = \"90 degC\", off_below = \"80 degC\" }\n";
    for (netlist, over_run) in [
        (read(&text("G", "")), false),
        (read(&text("G", "")), true),
        (read(&text("G * (1 + fan)", fan)), true),
    ] {
        let ranking = if over_run { of_run(&netlist).unwrap() } else { steady(&netlist, None) };
        let names = |ids: Vec<Item>| -> Vec<String> {
            ids.into_iter().map(|id| netlist.network.name_of(id).into_owned()).collect()
        };
        let fixed = ranking.fixed.iter().map(|(id, _)| Item::Parameter(*id)).collect();
        assert_eq!(names(fixed), ["teeth"]);
        assert_eq!(names(ranking.parameters.iter().map(|i| i.of).collect()), ["G"]);
    }
}

/// A value at the end of its range has a slope to one side, of the second order: m = 0 and
/// k <= 0 by differences of runs, since the heater switches. At t << tau the rise is P t / C.
#[test]
fn a_value_at_the_end_of_its_range_is_moved_to_the_other_side() {
    let netlist = read(
        "format = 1\n[param]\nsolid = \"50 degC\"\nliquid = \"50 degC\"\nP = \"100 W\"\n[material]\nwax = \
         { cp = \"2 kJ/(kg K)\", solidus = \"solid\", liquidus = \"liquid\", latent_heat = \"200 \
         kJ/kg\" }\n[node]\nw = { material = \"wax\", mass = \"0.1 kg\", T0 = \"20 degC\" }\n\
         [boundary]\nair = { T = \"20 degC\" }\n[resistor]\nskin = { from = \"w\", to = \"air\", R = \
         \"1 K/W\" }\n[control]\nheater = { sense = \"w\", on_below = \"30 degC\", off_above = \"200 \
         degC\", start = \"on\" }\n[source]\nloss = { into = \"w\", P = \"P * heater\" }\n[run]\nstop = \
         \"200 s\"\ntolerance = \"1e-7 K\"\n",
    );
    let ranking = of_run(&netlist).unwrap();
    assert!(ranking.differences.is_some() && ranking.fixed.is_empty());
    // still melting at the end, at 50 degC: with the liquidus higher it is part of the way up to it
    assert!((ranking.temperature - 323.15).abs() < 1e-3, "{}", ranking.temperature);
    let tau = 200.0;
    let melts = -tau * f64::ln(1.0 - 30.0 / 100.0);
    let molten = (100.0 - 30.0) * (tau - melts) / 20_000.0;
    for (name, expected) in [("solid", 1.0 - molten), ("liquid", molten)] {
        let found = change(&netlist, &ranking.parameters, name);
        assert!((found - expected).abs() < 0.03, "{name}: {found} is not {expected}");
    }
}
