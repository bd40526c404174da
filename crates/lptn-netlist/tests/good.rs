//! Netlists that are right: what they mean, and where each part of it stands.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that cannot go on has failed; exact numbers"
)]

use lptn_netlist::{Netlist, Severity, parse};
use lptn_network::{Bound, LimitSeverity, OutputTimes};
use lptn_network::{ConductorKind, End, Field, Item};

/// The example at the end of the format's description.
const GEARBOX: &str = include_str!("good/gearbox.toml");

fn good(text: &str) -> Netlist {
    parse("net.toml", text).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found} is not {expected}");
}

fn conductance(netlist: &Netlist, name: &str) -> f64 {
    match netlist.network.item(name).unwrap() {
        Item::Conductor(id) => netlist.network.conductance(id).unwrap(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_gearbox_has_the_numbers_of_the_paper() {
    let netlist = good(GEARBOX);
    let network = &netlist.network;
    assert_eq!(network.title(), Some("Planetary gearbox on the mill bed (seed paper, Figure 2)"));
    let (steel, aluminium) = (network.node("steel").unwrap(), network.node("aluminium").unwrap());
    close(network.capacity(steel), 1235.0);
    close(network.capacity(aluminium), 1424.0);
    close(network.initial(steel), 298.65);
    close(1.0 / conductance(&netlist, "internal"), 1.7 / 220.6);
    close(conductance(&netlist, "mill_bed"), 0.7 * 220.6 / 65.5);
    close(conductance(&netlist, "skin"), 0.3 * 220.6 / 65.5);
    let mut powers = [0.0];
    network.source_powers(&mut network.evaluation(), &mut powers).unwrap();
    close(powers[0], 220.6);
    let mut boundaries = [0.0; 2];
    network.boundary_temperatures(&mut network.evaluation(), &mut boundaries).unwrap();
    close(boundaries[1], 298.65);
    let run = netlist.run.as_ref().unwrap();
    assert_eq!((run.start, run.stop, &run.output), (0.0, 1500.0, &OutputTimes::Every(5.0)));
    assert_eq!((run.tolerance, run.select.len()), (1e-5, 0));
    assert_eq!(netlist.temperature_unit.text, "degC");
    assert!(netlist.warnings.is_empty());
}

#[test]
fn names_and_kinds_follow_the_file() {
    let netlist = good(GEARBOX);
    let network = &netlist.network;
    let names: Vec<&str> = network.nodes().iter().map(|n| n.name.as_str()).collect();
    assert_eq!(names, ["steel", "aluminium"]);
    let parts: Vec<&str> = network.capacitors().iter().map(|c| c.name.as_str()).collect();
    assert_eq!(parts, ["gears", "shaft_and_bearings", "housing", "carrier_and_hub"]);
    let skin = &network.conductors()[2];
    assert_eq!((&*skin.name(), skin.kind), ("skin", ConductorKind::Convection));
    assert_eq!(skin.from, End::Node(network.node("aluminium").unwrap()));
    assert!(matches!(skin.to, End::Boundary(_)));
}

#[test]
fn sections_and_parameters_may_stand_in_any_order() {
    let netlist = good(GEARBOX);
    // whole sections the other way round, and the parameters among themselves
    let (head, rest) = GEARBOX.split_once("[param]").unwrap();
    let mut sections: Vec<&str> = rest.split("\n\n").collect();
    let mut parameters: Vec<&str> = sections[0].trim().lines().collect();
    parameters.reverse();
    sections.remove(0);
    sections.reverse();
    let text = format!("{head}{}\n\n[param]\n{}\n", sections.join("\n\n"), parameters.join("\n"));
    let other = good(&text);
    for name in ["internal", "mill_bed", "skin"] {
        close(conductance(&other, name), conductance(&netlist, name));
    }
    assert_eq!(other.run, netlist.run);
    let capacities = |n: &Netlist| -> Vec<f64> {
        n.network.node_ids().map(|id| n.network.capacity(id)).collect()
    };
    assert_eq!(capacities(&other), capacities(&netlist));
}

#[test]
fn both_forms_of_a_table_are_the_same() {
    let inline = "format = 1\n[node]\na = { T0 = '1 degC', C = '2 J/K' }\nb = { T0 = '2 degC', C = \
        '3 J/K' }\n\
                  [resistor]\nab = { from = 'a', to = 'b', R = '2 K/W' }\n[run]\nstop = '1 \
                  s'\noutput = { every = '0.5 s' }\n";
    let headings = "format = 1\n[node.a]\nT0 = '1 degC'\nC = '2 J/K'\n[node.b]\nT0 = '2 degC'\nC = \
        '3 J/K'\n\
                    [resistor.ab]\nfrom = 'a'\nto = 'b'\nR = '2 K/W'\n[run]\nstop = '1 \
                    s'\n[run.output]\nevery = '0.5 s'\n";
    let dotted = "format = 1\nnode.a.T0 = '1 degC'\nnode.a.C = '2 J/K'\nnode.b = { T0 = '2 degC', \
        C = '3 J/K' }\n\
                  resistor.ab = { from = 'a', to = 'b', R = '2 K/W' }\nrun.stop = '1 \
                  s'\nrun.output.every = '0.5 s'\n";
    let of = |text| {
        let netlist = good(text);
        let capacity: Vec<f64> =
            netlist.network.node_ids().map(|id| netlist.network.capacity(id)).collect();
        (capacity, conductance(&netlist, "ab"), netlist.run)
    };
    assert_eq!(of(inline), of(headings));
    assert_eq!(of(inline), of(dotted));
}

#[test]
fn places_are_those_of_the_text() {
    let netlist = good(GEARBOX);
    let at = |item, field| netlist.files.at(&netlist.source_map.get(item, field).unwrap());
    let steel = Item::Node(netlist.network.node("steel").unwrap());
    assert_eq!(at(steel, Field::Name), "steel");
    assert_eq!(at(steel, Field::Initial), "\"T_amb\"");
    let internal = netlist.network.item("internal").unwrap();
    assert_eq!(at(internal, Field::of_law("R").unwrap()), "\"1.7 [K] / P_7000\"");
    assert_eq!(
        (at(internal, Field::From), at(internal, Field::To)),
        ("\"steel\"", "\"aluminium\"")
    );
    let share = netlist.network.parameter("bed_share").unwrap();
    assert_eq!(netlist.files.at(&netlist.source_map.parameter(share).unwrap()), "0.7");
    let span = netlist.source_map.name(internal).unwrap();
    assert_eq!(netlist.files.line_column(&span), (28, 1));
}

/// Every part has the place of its name and of each of its values.
#[test]
fn no_part_is_without_a_place() {
    let netlist = good(GEARBOX);
    let network = &netlist.network;
    let map = &netlist.source_map;
    let items =
        network.node_ids().map(Item::Node).chain(network.boundary_ids().map(Item::Boundary));
    let items = items.chain(network.capacitor_ids().map(Item::Capacitor));
    let items = items.chain(network.conductor_ids().map(Item::Conductor));
    let items = items.chain(network.source_ids().map(Item::Source));
    for item in items.chain(network.parameter_ids().map(Item::Parameter)) {
        assert_eq!(netlist.files.at(&map.name(item).unwrap()), network.name_of(item));
    }
    let has = |item, field| assert!(map.get(item, field).is_some(), "{item:?} {field:?}");
    network.capacitor_ids().for_each(|id| has(Item::Capacitor(id), Field::Capacity));
    network.boundary_ids().for_each(|id| has(Item::Boundary(id), Field::Temperature));
    network.source_ids().for_each(|id| has(Item::Source(id), Field::POWER));
    network.source_ids().for_each(|id| has(Item::Source(id), Field::Into));
}

const BLOCK: &str = "format = 1\n[node]\nblock = { T0 = '300 K', C = '0.5 kJ/K' }\n[boundary]\nair \
    = { T = '20 degC' }\n";

#[test]
fn every_form_of_a_path_and_parallel_paths() {
    let netlist = good(&format!(
        "{BLOCK}[resistor]\na = {{ from = 'block', to = 'air', R = '4 K/W' }}\nb = {{ from = \
         'block', to = 'air', G = '3 W/K' }}\n\
         [convection]\nc = {{ from = 'block', to = 'air', h = '10 W/(m^2 K)', area = '20 cm^2' \
         }}\nd = {{ from = 'air', to = 'block', R = '2 K/W' }}\n"
    ));
    for (name, expected) in [("a", 0.25), ("b", 3.0), ("c", 0.02), ("d", 0.5)] {
        close(conductance(&netlist, name), expected);
    }
    close(netlist.network.initial(netlist.network.node("block").unwrap()), 300.0);
    assert!(netlist.run.is_none());
}

#[test]
fn junctions_need_neither_capacity_nor_start() {
    let netlist = good(
        "format = 1\n[node]\nblock = { T0 = '300 K', C = '5 J/K' }\njoint = { massless = true }\n\
         [resistor]\na = { from = 'block', to = 'joint', R = '1 K/W' }\n",
    );
    let joint = netlist.network.node("joint").unwrap();
    assert!(netlist.network.nodes()[joint.index()].massless);
    assert!(netlist.network.initial(joint).is_nan());
}

#[test]
fn inputs_may_depend_on_time() {
    let netlist = good(&format!(
        "{BLOCK}[param]\nstep = '60 s'\n[resistor]\na = {{ from = 'block', to = 'air', R = '4 K/W' \
         }}\n\
         [source]\nloss = {{ into = 'block', P = 'if(t < step, 5 [W], 2 [W])' }}\n"
    ));
    assert!(netlist.network.has_time_dependent_inputs());
    assert_eq!(netlist.network.breakpoints(0.0, 100.0).unwrap(), [60.0]);
}

#[test]
fn deviations_stay_with_their_parameters() {
    let netlist = good(&format!("{BLOCK}[param]\na = '87 ± 15 W'\nb = '100 W +- 5 %'\n"));
    let deviations: Vec<Option<f64>> =
        netlist.network.parameters().iter().map(|p| p.deviation.map(|d| d.sigma(200.0))).collect();
    assert_eq!(deviations, [Some(15.0), Some(10.0)]);
    let warnings: Vec<&str> = netlist.warnings.iter().map(|w| w.code).collect();
    assert_eq!(warnings[..2], ["network::no_boundary", "network::idle_boundary"]);
    assert_eq!(warnings[2..], ["netlist::unused_parameter"; 2]);
    assert!(netlist.warnings.iter().all(|w| w.severity == Severity::Warning));
}

#[test]
fn a_parameter_comes_after_those_it_uses() {
    let netlist = good(&format!("{BLOCK}[param]\nz = 'y + 1'\ny = 'x * 2'\nfree = 5\nx = 3.5\n"));
    let names: Vec<&str> = netlist.network.parameters().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["x", "y", "z", "free"]);
    close(netlist.network.parameter_value(netlist.network.parameter("z").unwrap()), 8.0);
}

#[test]
fn run_takes_expressions_and_lists() {
    let netlist = good(&format!(
        "{BLOCK}[param]\ntau = '10 s'\n[run]\nstart = '-5 s'\nstop = '3 * tau'\noutput = {{ at = \
         ['0 s', 'tau', '0.5 min'] }}\n\
         select = ['*.T', 'loss.P']\ntolerance = '1 mK'\nintegrator = \
         'auto'\n[default]\ntemperature_unit = 'K'\n"
    ));
    let run = netlist.run.as_ref().unwrap();
    assert_eq!((run.start, run.stop, run.tolerance), (-5.0, 30.0, 1e-3));
    assert_eq!(run.output, OutputTimes::At(vec![0.0, 10.0, 30.0]));
    assert_eq!(run.select, ["*.T", "loss.P"]);
    assert_eq!(netlist.files.at(&netlist.source_map.select()[1]), "'loss.P'");
    close(netlist.temperature_unit.from_si(300.0), 300.0);
}

#[test]
fn output_is_a_three_hundredth_unless_said() {
    let netlist = good(&format!("{BLOCK}[run]\nstop = '300 s'\n"));
    assert_eq!(netlist.run.unwrap().output, OutputTimes::Every(1.0));
}

#[test]
fn line_ends_and_byte_order_mark_do_not_matter() {
    let windows = format!("\u{feff}{}", GEARBOX.replace('\n', "\r\n"));
    let netlist = good(&windows);
    close(conductance(&netlist, "skin"), 0.3 * 220.6 / 65.5);
    let skin = netlist.network.item("skin").unwrap();
    assert_eq!(netlist.files.line_column(&netlist.source_map.name(skin).unwrap()), (32, 1));
}

#[test]
fn reading_a_file_that_is_not_there_names_it() {
    let error = lptn_netlist::read(std::path::Path::new("no/such.toml")).unwrap_err();
    assert!(error.to_string().starts_with("cannot read no/such.toml: "), "{error}");
}

#[test]
fn limits_name_temperatures_parameters_and_time() {
    let netlist = good(
        "format = 1\n[param]\nT_max = \"110 degC\"\nspare = \"10 K\"\n\
         [node]\nsteel = { T0 = \"25 degC\", C = \"500 J/K\" }\n[boundary]\nair = { T = \"25 \
         degC\" }\n\
         [resistor]\ncooling = { from = \"steel\", to = \"air\", R = \"0.3 K/W\" }\n\
         [limit]\nhot = { of = \"steel.T\", below = \"T_max - spare\" }\n\
         rise = { of = \"steel.T - air.T\", above = \"-5 K\", severity = \"warning\" }\n",
    );
    let network = &netlist.network;
    let limits = network.limits();
    assert_eq!((limits[0].name.as_str(), limits[0].text.as_str()), ("hot", "steel.T"));
    assert_eq!((limits[0].bound, limits[1].bound), (Bound::Below, Bound::Above));
    assert_eq!(
        (limits[0].severity, limits[1].severity),
        (LimitSeverity::Error, LimitSeverity::Warning)
    );
    let mut scope = network.evaluation();
    scope.set_temperatures(&[350.0], &[298.15]);
    let margins: Vec<f64> =
        network.limit_ids().map(|id| network.limit_margin(id, &mut scope).unwrap()).collect();
    close(margins[0], 373.15 - 350.0);
    close(margins[1], 350.0 - 298.15 + 5.0);
    for id in network.limit_ids() {
        let item = Item::Limit(id);
        let span = netlist.source_map.get(item, Field::Of).unwrap();
        assert_eq!(netlist.files.at(&span).trim_matches('"'), limits[id.index()].text);
        assert!(netlist.source_map.get(item, limits[id.index()].bound.field()).is_some());
    }
    assert!(netlist.warnings.is_empty());
}

#[test]
fn what_has_no_effect_is_a_warning() {
    let text = "format = 1
[node]
block = { T0 = \"20 degC\", C = \"500 J/K\" }
joint = { T0 = \"20 degC\", massless = true, L_char = \"1 cm\" }
[boundary]
air = { T = \"25 degC\" }
[resistor]
inner = { from = \"block\", to = \"joint\", R = \"1 K/W\" }
outer = { from = \"joint\", to = \"air\", R = \"1 K/W\" }
[source]
pulse = { into = \"block\", P = \"if(t == 5 [s], 100 [W], 0 [W])\" }
";
    let netlist = lptn_netlist::parse("a.toml", text).unwrap();
    let found: Vec<String> = netlist.warnings.iter().map(|w| netlist.files.plain(w)).collect();
    let expected = "\
warning[netlist::massless_initial]: `T0` of node `joint` is only the first guess of its balance: \
the node is massless
 --> a.toml:4:16
  = help: leave `T0` out, unless tables do not reach to the other temperatures, or the balance has \
several solutions
warning[netlist::massless_length]: `L_char` of node `joint` has no effect: the node is massless
 --> a.toml:4:53
  = help: leave it out: a junction is not a body
warning[netlist::moment]: `P` of source `pulse` compares the time by equality, which lasts for no \
time
 --> a.toml:11:35: never acts
  = help: use `<` or `>=`; a pulse is `if(t < 5 [s], a, if(t < 6 [s], b, a))`";
    assert_eq!(found.join("\n"), expected);
}

/// A power and a conductivity in files of loggers.
const LOGGED: &str = r#"
format = 1

[node]
a = { C = "1 J/K", T0 = "30 degC" }

[boundary]
air = { T = "20 degC" }

[signal.power]
csv = "p.csv"
time = "Datum"
value = "Leistung"
start = "03.05.2026 08:00:30"
units = { Leistung = "W" }

[table]
k = { csv = "k.csv", x = "T", value = "k" }

[source]
heat = { into = "a", P = "power + k(30 [degC]) * 1 [K m]" }

[resistor]
skin = { from = "a", to = "air", G = "1 W/K" }
"#;

/// A signal and a table from the files of loggers: at 08:00:30, half way between two rows, the
/// signal is 15.5 W; at 30 degC, half way between two rows, the table is 205 W/(m K).
#[test]
fn signals_and_tables_are_read_from_files_of_loggers() {
    let files: [(&str, &[u8]); 2] = [
        (
            "p.csv",
            b"Pr\xfcfstand;;\nDatum;Uhrzeit;Leistung\n03.05.2026;08:00;10,5\n\
            03.05.2026;08:01;20,5\n",
        ),
        ("k.csv", b"rods of alloy\nT (\xb0C)\tk [W/(m K)]\n20\t200,0\n40\t210,0\n"),
    ];
    let netlist = lptn_netlist::parse_with("net.toml", LOGGED, &mut |path: &std::path::Path| {
        let found = files.iter().find(|(name, _)| path.to_str() == Some(name));
        Ok(found.map(|(_, bytes)| bytes.to_vec()).unwrap_or_default())
    });
    let netlist = netlist.unwrap_or_else(|rejected| panic!("{rejected}"));
    let network = &netlist.network;
    let mut powers = [0.0];
    network.source_powers(&mut network.evaluation(), &mut powers).unwrap();
    close(powers[0], 15.5 + 205.0);
    let notes: Vec<&str> = netlist.warnings.iter().map(|note| note.message.as_str()).collect();
    assert_eq!(
        notes,
        [
            "p.csv is read with `;` between columns, decimal commas, encoding Windows-1252, one \
             line above the header left out, 0 s at 03.05.2026 08:00:30",
            "k.csv is read with tabs between columns, decimal commas, encoding Windows-1252, one \
             line above the header left out",
        ]
    );
    assert!(netlist.warnings.iter().all(|note| note.severity == Severity::Note));
}
