//! Elements and inputs in time of netlists that are right: numbers by hand, in any order of the
//! text.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; exact numbers"
)]

use std::io;
use std::path::Path;

use lptn_netlist::{Netlist, Severity, parse, parse_with};
use lptn_network::{ConductorFlow, Field, Formula, Item, Network};

const ELEMENTS: &str = include_str!("good/elements.toml");

/// The files of `tests/good`, from memory.
fn load(path: &Path) -> io::Result<Vec<u8>> {
    Ok(match path.to_str() {
        Some("cycle.csv") => include_bytes!("good/cycle.csv").to_vec(),
        Some("map.csv") => include_bytes!("good/map.csv").to_vec(),
        Some("film.csv") => include_bytes!("good/film.csv").to_vec(),
        _ => return Err(io::ErrorKind::NotFound.into()),
    })
}

fn read(text: &str) -> Netlist {
    parse_with("elements.toml", text, &mut load).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs().max(1e-9),
        "{found} is not {expected}"
    );
}

/// Heat received by the two ends of a path that is not a constant, at these temperatures in degC.
fn exchange(network: &Network, name: &str, time: f64, nodes: [f64; 4]) -> [f64; 2] {
    let Item::Conductor(id) = network.item(name).unwrap() else { panic!("{name} is not a path") };
    let mut scope = network.evaluation();
    scope.set_time(time, time);
    let mut boundaries = [0.0; 2];
    network.boundary_temperatures(&mut scope, &mut boundaries).unwrap();
    let temperatures: Vec<f64> = nodes.iter().map(|t| t + 273.15).chain(boundaries).collect();
    network.exchange(id, &mut scope, &temperatures).unwrap()
}

const WARM: [f64; 4] = [80.0, 60.0, 50.0, 45.0];

/// A signal as the only name in scope.
struct Only(lptn_units::Symbol);

impl lptn_units::Scope for Only {
    fn symbol(&self, _: &str) -> Option<lptn_units::Symbol> {
        Some(self.0)
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// The value of a signal in SI units.
fn value(netlist: &Netlist, name: &str, time: f64) -> f64 {
    let network = &netlist.network;
    let id = network.signal_ids().find(|id| network.signals()[id.index()].name == name).unwrap();
    let (slot, ty) = (network.signal_slot(id), network.signals()[id.index()].ty);
    let symbol = lptn_units::Symbol { slot, ty, in_comparison: None };
    let program =
        lptn_units::Expression::parse(name).unwrap().compile(&Only(symbol), None).unwrap();
    let mut at = network.evaluation();
    at.set_time(time, time);
    lptn_network::Value::Expression(program.into()).at(&mut at).unwrap()
}

#[test]
fn nothing_is_odd_but_its_streams() {
    let netlist = read(ELEMENTS);
    let warnings: Vec<String> = netlist.warnings.iter().map(|w| netlist.files.plain(w)).collect();
    assert_eq!(warnings.len(), 3, "{}", warnings.join("\n"));
    assert!(netlist.warnings.iter().all(|w| w.code == "network::unbalanced_streams"));
    assert!(
        warnings[0].contains("streams bring 88.8 W/K into node `sump` and take 40.2 W/K out of it")
    );
    assert_eq!(netlist.network.conductors().len(), 14);
    assert_eq!(netlist.network.fluids().len(), 2);
    assert_eq!(netlist.network.materials().len(), 3, "cast, wax and the copper of the library");
}

#[test]
fn signals_go_through_their_points() {
    let netlist = read(ELEMENTS);
    let rpm = std::f64::consts::TAU / 60.0;
    // 1000 rpm at 50 s, and again 100 s later
    for (time, speed) in [(0.0, 0.0), (25.0, 500.0), (50.0, 1000.0), (75.0, 500.0), (125.0, 500.0)]
    {
        close(value(&netlist, "speed", time), speed * rpm);
    }
    for (time, torque) in [(0.0, 0.0), (59.0, 0.0), (60.0, 10.0), (1000.0, 10.0)] {
        close(value(&netlist, "torque", time), torque);
    }
    close(value(&netlist, "T_room", 50.0), 298.15);
    close(value(&netlist, "T_room", 200.0), 303.15);
    // the map is bilinear: at 500 rpm half of 0 and 3 W, at 10 N m half of 5 and 9 W; the sine is 1
    // at 10 s
    close(value(&netlist, "power", 10.0), 0.2 * 3.0 + 1.0);
    close(value(&netlist, "power", 125.0), 7.0 + (std::f64::consts::TAU * 125.0 / 40.0).sin());
}

#[test]
fn parameters_may_read_tables() {
    let netlist = read(ELEMENTS);
    let id = netlist.network.parameter("P_base").unwrap();
    close(netlist.network.parameter_value(id), 2.0 * 20.0);
}

#[test]
fn bodies_conduct_by_their_shape() {
    let network = read(ELEMENTS).network;
    let conductance = |name: &str| match network.item(name).unwrap() {
        Item::Conductor(id) => network.conductance(id).unwrap(),
        other => panic!("{other:?}"),
    };
    let pi = std::f64::consts::PI;
    close(conductance("tube"), 2.0 * pi * 40.0 * 0.1 / 1.25_f64.ln());
    close(conductance("shell"), 4.0 * pi * 40.0 / (1.0 / 0.02 - 1.0 / 0.025));
    close(conductance("shaft"), 401.0 * pi * 0.005 * 0.005 / 0.2);
    close(conductance("joint"), 1.2);
    // k at the mean of 60 and 45 degC
    let k = 40.0 - 0.01 * 32.5;
    close(exchange(&network, "wall", 0.0, WARM)[1], k * 2e-3 / 1e-2 * 15.0);
}

#[test]
fn paths_depend_on_the_temperatures_of_their_ends() {
    let network = read(ELEMENTS).network;
    // held at 100 degC: 6 W/K; a mean of 120 and a difference of 40
    let hot = exchange(&network, "mesh", 0.0, [140.0, 100.0, 50.0, 45.0]);
    close(hot[1], (6.0 + 4.0) * 40.0);
    assert_eq!(hot[0], -hot[1]);
    // the room is at 25 degC at 50 s; h = 4 + 0.1 * 35
    close(exchange(&network, "skin", 50.0, WARM)[1], 7.5 * 0.2 * 35.0);
}

#[test]
fn surfaces_radiate_at_absolute_temperatures() {
    let network = read(ELEMENTS).network;
    let flow = |name: &str| match network.item(name).unwrap() {
        Item::Conductor(id) => network.flow(id),
        other => panic!("{other:?}"),
    };
    let ConductorFlow::Radiation(grey) = flow("grey") else { panic!("{:?}", flow("grey")) };
    close(grey, 0.8 * 0.2);
    // two parallel plates: 1 / (1/e1 + 1/e2 - 1)
    let ConductorFlow::Radiation(plates) = flow("plates") else { panic!("{:?}", flow("plates")) };
    close(plates, 0.01 / (1.0 / 0.8 + 1.0 / 0.4 - 1.0));
    assert_eq!(flow("gap"), ConductorFlow::Radiation(0.01));
}

#[test]
fn streams_carry_heat_one_way() {
    let network = read(ELEMENTS).network;
    // 3 L/min of 900 - 0.6 * 20 kg/m^3 with 2000 J/(kg K)
    let feed = 3e-3 / 60.0 * 888.0 * 2000.0;
    for (name, rate) in [("feed", feed), ("through", 0.02 * 2010.0), ("given", 12.0)] {
        let Item::Conductor(id) = network.item(name).unwrap() else { panic!("{name}") };
        let ConductorFlow::Stream(found) = network.flow(id) else { panic!("{name}") };
        close(found, rate);
    }
}

#[test]
fn sources_are_shared_and_depend_on_temperatures() {
    let network = read(ELEMENTS).network;
    let source = |name: &str| match network.item(name).unwrap() {
        Item::Source(id) => id,
        other => panic!("{other:?}"),
    };
    let into = &network.sources()[source("P_loss").index()].into;
    let (steel, ring) = (network.node("steel").unwrap(), network.node("ring").unwrap());
    assert_eq!(into, &[(steel, 0.7), (ring, 0.3)]);
    let temperatures: Vec<f64> = WARM.iter().chain(&[20.0, 40.0]).map(|t| t + 273.15).collect();
    let heat =
        network.source_heat(source("P_copper"), &mut network.evaluation(), &temperatures).unwrap();
    close(heat, 40.0 * (1.0 + 0.004 * 60.0) + 0.1 * -20.0);
}

#[test]
fn capacities_follow_their_own_temperature() {
    let network = read(ELEMENTS).network;
    let heat = |name: &str, celsius: f64| {
        network.enthalpy(network.node(name).unwrap()).unwrap().heat(celsius + 273.15).unwrap()
    };
    // the integral of 700 + 0.5 (T - 20) from 20 degC
    close(heat("steel", 80.0), 700.0 * 60.0 + 0.25 * 3600.0);
    // 2 kg of 460 + 0.4 T: from 20 to 60 degC
    close(heat("ring", 60.0), 2.0 * (460.0 * 40.0 + 0.2 * (3600.0 - 400.0)));
    // 0.5 kg of wax, molten at 60 degC
    assert!((heat("store", 60.0) - 0.5 * (2000.0 * 40.0 + 200e3)).abs() < 1e-6);
}

/// Every bit of what a network computes, by name.
fn numbers(netlist: &Netlist) -> Vec<(String, u64)> {
    let network = &netlist.network;
    let mut found: Vec<(String, u64)> = Vec::new();
    let mut scope = network.evaluation();
    scope.set_time(70.0, 70.0);
    let mut boundaries = [0.0; 2];
    network.boundary_temperatures(&mut scope, &mut boundaries).unwrap();
    let celsius = |name: &str| match name {
        "steel" => 80.0,
        "ring" => 60.0,
        "store" => 50.0,
        _ => 45.0,
    };
    let nodes = network.nodes().iter().map(|node| celsius(&node.name) + 273.15);
    let temperatures: Vec<f64> = nodes.chain(boundaries).collect();
    for (boundary, t) in network.boundaries().iter().zip(boundaries) {
        found.push((boundary.name.clone(), t.to_bits()));
    }
    for id in network.node_ids() {
        found.push((network.nodes()[id.index()].name.clone(), network.capacity(id).to_bits()));
    }
    for id in network.conductor_ids() {
        let name = network.conductors()[id.index()].name();
        let [from, to] = match network.flow(id) {
            ConductorFlow::Conductance(x)
            | ConductorFlow::Radiation(x)
            | ConductorFlow::Stream(x) => [x, x],
            ConductorFlow::Variable => network.exchange(id, &mut scope, &temperatures).unwrap(),
        };
        found.push((format!("{name} from"), from.to_bits()));
        found.push((name.into_owned(), to.to_bits()));
    }
    for id in network.source_ids() {
        let heat = network.source_heat(id, &mut scope, &temperatures).unwrap();
        found.push((network.sources()[id.index()].name().into_owned(), heat.to_bits()));
    }
    for id in network.parameter_ids() {
        let name = network.parameters()[id.index()].name.clone();
        found.push((name, network.parameter_value(id).to_bits()));
    }
    found.sort();
    found
}

/// Sections, and the lines inside them, the other way round and turned by every amount.
#[test]
fn the_order_of_the_text_changes_no_bit() {
    let expected = numbers(&read(ELEMENTS));
    let (head, rest) = ELEMENTS.split_once("[param]").unwrap();
    let rest = format!("[param]{rest}");
    let sections: Vec<(String, Vec<&str>)> = rest
        .split("\n\n")
        .map(|section| {
            let (heading, lines) = section.split_once('\n').unwrap();
            (heading.to_owned(), lines.lines().collect())
        })
        .collect();
    for turn in 0..sections.len() {
        let mut sections = sections.clone();
        sections.rotate_left(turn);
        sections.iter_mut().for_each(|(_, lines)| lines.reverse());
        let sections: Vec<String> = sections
            .iter()
            .map(|(heading, lines)| format!("{heading}\n{}", lines.join("\n")))
            .collect();
        let found = numbers(&read(&format!("{head}{}\n", sections.join("\n\n"))));
        assert_eq!(found, expected, "turned by {turn}");
    }
}

#[test]
fn csv_files_are_inputs_like_those_that_are_included() {
    let netlist = read(ELEMENTS);
    let inputs: Vec<(&str, usize)> =
        netlist.inputs().map(|(name, text)| (name, text.len())).collect();
    let names: Vec<&str> = inputs.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["elements.toml", "map.csv", "film.csv", "cycle.csv"]);
    assert_eq!(inputs[2].1, include_bytes!("good/film.csv").len());
}

#[test]
fn a_text_without_a_file_cannot_read_one() {
    let rejected = parse("stdin", ELEMENTS).unwrap_err();
    let codes: Vec<&str> = rejected.diagnostics.iter().map(|d| d.code).collect();
    assert_eq!(codes, ["netlist::csv_without_folder"; 3]);
}

/// The path is relative to the file that names it, and a file that two read is there once.
#[test]
fn csv_files_stand_beside_the_file_that_names_them() {
    let main = "format = 1\ninclude = [\"parts/drive.toml\"]\n[node]\na = { C = \"1 J/K\", T0 \
        = \"0 degC\" }\n\
                [source]\nP = { into = \"a\", P = \"1 [W/rpm] * (speed + twice)\" }\n";
    let drive = "format = 1\n[signal]\nspeed = { csv = \"c.csv\", time = \"t\", value = \"speed\" \
        }\n\
                 twice = { csv = \"c.csv\", time = \"t\", value = \"speed\" }\n";
    let mut asked = Vec::new();
    let mut load = |path: &Path| {
        asked.push(path.to_str().unwrap().to_owned());
        Ok(match asked.len() {
            1 => drive.as_bytes().to_vec(),
            _ => include_bytes!("good/cycle.csv").to_vec(),
        })
    };
    let netlist = parse_with("models/main.toml", main, &mut load).unwrap_or_else(|r| panic!("{r}"));
    assert_eq!(asked, ["models/parts/drive.toml", "models/parts/c.csv"]);
    assert_eq!(netlist.inputs().count(), 3);
}

#[test]
fn parameters_reach_every_kind_of_element() {
    let mut netlist = read(ELEMENTS);
    netlist.set(&["scale=3".into(), "eps=0.5".into(), "T_amb=10degC".into()]).unwrap();
    let network = &netlist.network;
    close(network.parameter_value(network.parameter("P_base").unwrap()), 60.0);
    let Item::Conductor(grey) = network.item("grey").unwrap() else { panic!() };
    assert_eq!(network.flow(grey), ConductorFlow::Radiation(0.5 * 0.2));
    close(network.initial(network.node("store").unwrap()), 283.15);
}

/// What a new value breaks is named, with the assignment that did it.
#[test]
fn assignments_that_break_an_element_are_named() {
    let text = "format = 1\n[param]\nd = \"5 mm\"\neps = 0.8\nm = \"1 kg/s\"\nrate = \"1 \
        W\"\nspare = 1\nthick = \"d * spare\"\n\
                [signal]\ncourse = \"rate * if(t < 5 [s], 1, 2)\"\n\
                [node]\na = { C = \"1 J/K\", T0 = \"0 degC\" }\nb = { C = \"1 J/K\", T0 = \"0 \
                degC\" }\n\
                [conduction]\nw = { from = \"a\", to = \"b\", k = \"1 W/(m K)\", shape = \"slab\", \
                area = \"1 m^2\", thickness = \"thick\" }\n\
                [radiation]\nr = { from = \"a\", to = \"b\", emissivity = \"eps\", area = \"1 \
                m^2\" }\n\
                [advection]\ns = { from = \"a\", to = \"b\", fluid = \"engine_oil\", flow = \"m\" }\n\
                [source]\nP = { into = \"a\", P = \"course\" }\n";
    let mut netlist = parse("a.toml", text).unwrap_or_else(|r| panic!("{r}"));
    let mut refused = |assignments: &[&str]| -> Vec<(String, Vec<String>)> {
        let assignments: Vec<String> = assignments.iter().map(|a| (*a).to_owned()).collect();
        let rejected = netlist.set(&assignments).unwrap_err();
        let of = |d: &lptn_netlist::Diagnostic| {
            let labels = d.labels.iter().map(|l| l.text.clone()).filter(|t| !t.is_empty());
            (d.code.to_owned(), labels.collect())
        };
        rejected.diagnostics.iter().map(of).collect()
    };
    let of = |code: &str, label: &str| vec![(code.to_owned(), vec![label.to_owned()])];
    assert_eq!(
        refused(&["spare=-1", "m=2kg/s"]),
        of("network::not_positive", "`spare` is set here")
    );
    assert_eq!(
        refused(&["eps=1.5", "m=2kg/s"]),
        of("network::not_a_fraction", "`eps` is set here")
    );
    netlist.set(&["m=-2kg/s".into(), "d=1mm".into()]).unwrap();
    let Item::Conductor(s) = netlist.network.item("s").unwrap() else { panic!() };
    assert_eq!(netlist.network.flow(s), ConductorFlow::Stream(-2.0 * 2076.0));
}

#[test]
fn a_signal_is_no_parameter_to_set() {
    let rejected = read(ELEMENTS).set(&["speed=5rpm".into()]).unwrap_err();
    let text = rejected.to_string();
    assert!(
        text.contains("there is no parameter `speed`") && text.contains(": a signal"),
        "{text}"
    );
}

#[test]
fn a_device_is_no_csv_file() {
    let text = "format = 1\n[signal]\ns = { csv = \"/dev/zero\", time = \"t\", value = \"v\" }\n";
    let rejected = lptn_netlist::parse_file(Path::new("a.toml"), text.as_bytes()).unwrap_err();
    assert!(rejected.to_string().contains("netlist::csv_not_found"), "{rejected}");
}

/// What flows into a node flows out of it, whichever way its streams are named.
#[test]
fn streams_that_balance_are_no_warning() {
    let of = |streams: &str| {
        let text = format!(
            "format = 1\n[boundary]\nin = {{ T = \"40 degC\" }}\nout = {{ T = \"0 degC\" }}\n\
             [node]\na = {{ C = \"1 J/K\", T0 = \"0 degC\" }}\n[advection]\n{streams}"
        );
        let netlist = parse("a.toml", &text).unwrap_or_else(|r| panic!("{r}"));
        let codes: Vec<&str> = netlist.warnings.iter().map(|w| w.code).collect();
        codes.join(" ")
    };
    let feed = "x = { from = \"in\", to = \"a\", mcp = \"2 W/K\" }\n";
    assert_eq!(of(feed), "network::idle_boundary network::unbalanced_streams");
    assert_eq!(of(&format!("{feed}y = {{ from = \"a\", to = \"out\", mcp = \"2 W/K\" }}\n")), "");
    assert_eq!(of(&format!("{feed}y = {{ from = \"out\", to = \"a\", mcp = \"-2 W/K\" }}\n")), "");
    // what varies is judged as it stands at the start
    let varies = "x = { from = \"in\", to = \"a\", mcp = \"2 [W/K] + 1 [W/(K s)] * t\" }\n";
    assert_eq!(of(varies), "network::idle_boundary network::unbalanced_streams");
    assert_eq!(of(&varies.replace("2 [W/K]", "0 [W/K]")), "network::idle_boundary");
}

/// A tabulated property is constant in all but the temperature, whatever unit its list has.
#[test]
fn kelvin_in_a_table_over_temperature_is_absolute() {
    let of = |x: &str| {
        let text = format!(
            "format = 1\n[material]\nm = {{ cp = {{ {x}, y = [\"400 J/(kg K)\", \"500 J/(kg K)\"] \
             }} }}\n\
             [node]\na = {{ T0 = \"300 K\", material = \"m\", mass = \"1 kg\" }}\n"
        );
        let netlist = parse("a.toml", &text).unwrap_or_else(|r| panic!("{r}"));
        netlist.network.capacity(netlist.network.node("a").unwrap())
    };
    close(of("x = [\"273.15 K\", \"373.15 K\"]"), 400.0 + 26.85);
    close(of("x = [0, 100], x_unit = \"degC\""), 400.0 + 26.85);
    close(of("x = [273.15, 373.15], x_unit = \"K\""), 400.0 + 26.85);
    close(of("x = [32, 212], x_unit = \"degF\""), 400.0 + 26.85);
}

#[test]
fn places_of_the_new_sections_are_known() {
    let netlist = read(ELEMENTS);
    let at = |name: &str, field| {
        let item = netlist.network.item(name).unwrap();
        netlist.files.at(&netlist.source_map.get(item, field).unwrap())
    };
    assert_eq!(at("tube", Field::of_law("r_in").unwrap()), "\"20 mm\"");
    assert_eq!(at("grey", Field::of_law("emissivity").unwrap()), "\"eps\"");
    assert_eq!(at("feed", Field::of_law("flow_T").unwrap()), "\"40 degC\"");
    assert_eq!(at("P_loss", Field::Into), "{ steel = 0.7, ring = 0.3 }");
    for id in netlist.network.signal_ids() {
        let name = netlist.source_map.name(Item::Signal(id)).unwrap();
        assert_eq!(netlist.files.at(&name), netlist.network.signals()[id.index()].name);
    }
    let Item::Conductor(wall) = netlist.network.item("wall").unwrap() else { panic!() };
    assert_eq!(netlist.network.conductors()[wall.index()].law.formula(), Formula::Slab);
}

#[test]
fn what_nothing_uses_is_a_warning() {
    let text = "format = 1\n[table]\nx = { x = [0, 1], y = [0, 1] }\n[signal]\ny = \"t / 1 [s]\"\n\
                [fluid]\nz = { cp = \"1 kJ/(kg K)\" }\n[node]\na = { C = \"1 J/K\", T0 = \"0 \
                degC\" }\n";
    let netlist = parse("a.toml", text).unwrap();
    let codes: Vec<&str> = netlist.warnings.iter().map(|w| w.code).collect();
    let unused = ["netlist::unused_table", "netlist::unused_signal", "netlist::unused_fluid"];
    assert_eq!(codes, [&unused[..], &["network::no_boundary"]].concat());
    assert!(netlist.warnings.iter().all(|w| w.severity == Severity::Warning));
}
