//! A network from CSV files is the network that TOML writes: the same bits of every result.

use std::fmt::Write as _;
use std::io::{Error, ErrorKind};
use std::path::Path;

use lptn::prelude::*;
use lptn_netlist::{Netlist, parse_with};
use lptn_network::{End, Item};

const SIDE: usize = 7;

/// Numbers that are not round ones, one for each element: the fractions of multiples of the golden
/// ratio.
fn spread(k: usize) -> f64 {
    (k as f64 * 0.618_033_988_749_895).fract() + 0.05
}

/// A plate with a junction in every fifth cell, as rows of its four files.
#[derive(Default)]
struct Plate {
    nodes: Vec<(String, Option<f64>)>,
    conductors: Vec<(String, String, f64)>,
    /// Films with their coefficient and area.
    films: Vec<(String, f64, f64)>,
    /// Exchange areas to the node two places on.
    seen: Vec<(String, String, f64)>,
    sources: Vec<(String, f64)>,
}

fn plate() -> Plate {
    let mut plate = Plate::default();
    for k in 0..SIDE * SIDE {
        plate.nodes.push((format!("n{k}"), (k % 5 != 0).then(|| 1.0 + spread(k))));
        if k % SIDE + 1 < SIDE {
            plate.conductors.push((format!("n{k}"), format!("n{}", k + 1), spread(3 * k)));
        }
        if k + SIDE < SIDE * SIDE {
            plate.conductors.push((format!("n{}", k + SIDE), format!("n{k}"), spread(3 * k + 1)));
        }
        plate.conductors.push((format!("n{k}"), "air".into(), 0.1 * spread(3 * k + 2)));
        if k % 4 == 1 {
            plate.films.push((format!("n{k}"), 9.0 * spread(k + 1), 0.01 * spread(k + 2)));
            let seen = format!("n{}", (k + 2) % (SIDE * SIDE));
            plate.seen.push((seen, format!("n{k}"), 0.02 * spread(k + 3)));
        }
        if k % 3 == 0 {
            plate.sources.push((format!("n{k}"), 10.0 * spread(k)));
        }
    }
    plate
}

const RUN: &str = "[run]\nstop = \"20 s\"\noutput = { every = \"0.5 s\" }\n";

fn toml() -> Netlist {
    let (plate, mut text) =
        (plate(), "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\n".to_owned());
    for (name, capacity) in &plate.nodes {
        let _ = match capacity {
            Some(c) => writeln!(text, "{name} = {{ C = \"{c} J/K\" }}"),
            None => writeln!(text, "{name} = {{ massless = true }}"),
        };
    }
    text += "[boundary]\nair = { T = \"18.5 degC\" }\n[resistor]\n";
    for (i, (from, to, g)) in plate.conductors.iter().enumerate() {
        let _ = writeln!(text, "r{i} = {{ from = \"{from}\", to = \"{to}\", G = \"{g} W/K\" }}");
    }
    text += "[convection]\n";
    for (i, (from, h, area)) in plate.films.iter().enumerate() {
        let film = format!("h = \"{h} W/(m^2 K)\", area = \"{area} m^2\"");
        let _ = writeln!(text, "f{i} = {{ from = \"{from}\", to = \"air\", {film} }}");
    }
    text += "[radiation]\n";
    for (i, (from, to, area)) in plate.seen.iter().enumerate() {
        let _ =
            writeln!(text, "g{i} = {{ from = \"{from}\", to = \"{to}\", Gr = \"{area} m^2\" }}");
    }
    text += "[source]\n";
    for (i, (into, power)) in plate.sources.iter().enumerate() {
        let _ = writeln!(text, "s{i} = {{ into = \"{into}\", P = \"{power} W\" }}");
    }
    parse_with("plate.toml", &(text + RUN), &mut |_| Err(Error::from(ErrorKind::NotFound)))
        .expect("it reads")
}

fn csv() -> Netlist {
    let plate = plate();
    let mut nodes = "name,C [J/K],T0 [degC]\n".to_owned();
    for (name, capacity) in &plate.nodes {
        let _ = writeln!(nodes, "{name},{},20", capacity.map_or(String::new(), |c| c.to_string()));
    }
    let mut conductors = "from,to,G [W/K]\n".to_owned();
    plate.conductors.iter().for_each(|(from, to, g)| {
        let _ = writeln!(conductors, "{from},{to},{g}");
    });
    let mut films = "to,from,area [m^2],h [W/(m^2 K)]\n".to_owned();
    plate.films.iter().for_each(|(from, h, area)| {
        let _ = writeln!(films, "air,{from},{area},{h}");
    });
    let mut seen = "from,to,Gr [m^2]\n".to_owned();
    plate.seen.iter().for_each(|(from, to, area)| {
        let _ = writeln!(seen, "{from},{to},{area}");
    });
    let mut sources = "into,P [W]\n".to_owned();
    plate.sources.iter().for_each(|(into, power)| {
        let _ = writeln!(sources, "{into},{power}");
    });
    let main = "format = 1\n[import]\nnodes = \"n.csv\"\nboundaries = \"b.csv\"\nconductors \
        = [\"c.csv\", \"f.csv\", \"g.csv\"]\nsources = \"s.csv\"\n";
    parse_with("plate.toml", &format!("{main}{RUN}"), &mut |path: &Path| match path.to_str() {
        Some("n.csv") => Ok(nodes.clone().into_bytes()),
        Some("b.csv") => Ok(b"name,T [degC]\nair,18.5\n".to_vec()),
        Some("c.csv") => Ok(conductors.clone().into_bytes()),
        Some("f.csv") => Ok(films.clone().into_bytes()),
        Some("g.csv") => Ok(seen.clone().into_bytes()),
        Some("s.csv") => Ok(sources.clone().into_bytes()),
        _ => Err(Error::from(ErrorKind::NotFound)),
    })
    .expect("it reads")
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn an_import_equals_the_same_network_in_toml_to_the_bit() {
    let (toml, csv) = (toml(), csv());
    let (a, b) = (&toml.network, &csv.network);
    assert_eq!((a.nodes().len(), a.conductors().len()), (b.nodes().len(), b.conductors().len()));
    let ends = |c: &lptn_network::Conductor| [c.from, c.to];
    let all = |network: &Network| network.conductors().iter().flat_map(ends).collect::<Vec<End>>();
    assert_eq!(all(a), all(b));
    let systems = [a, b].map(|network| ThermalSystem::assemble(network).expect("it assembles"));
    let [steady_a, steady_b] =
        [&systems[0], &systems[1]].map(|s| SteadyState::solve(s, 0.0).expect("it rests"));
    assert_eq!(bits(&steady_a.temperatures), bits(&steady_b.temperatures));
    assert_eq!(bits(&steady_a.conductor_heat), bits(&steady_b.conductor_heat));
    let run = |system: &ThermalSystem| {
        let solution =
            Transient::until(Time(20.0)).every(Time(0.5)).solve(system).expect("it runs");
        (0..solution.times().len()).flat_map(|row| bits(solution.row(row))).collect::<Vec<u64>>()
    };
    assert_eq!(run(&systems[0]), run(&systems[1]));
}

#[test]
fn an_import_repeats_to_the_bit() {
    let steady = || {
        let system = ThermalSystem::assemble(&csv().network).expect("it assembles");
        bits(&SteadyState::solve(&system, 0.0).expect("it rests").temperatures)
    };
    assert_eq!(steady(), steady());
}

/// A netlist whose files are in `tests/decks`.
fn deck(main: &str) -> Netlist {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/decks");
    parse_with("deck.toml", main, &mut |path: &Path| std::fs::read(folder.join(path)))
        .expect("it reads")
}

/// The temperatures of some nodes in K after a run.
fn after<const N: usize>(netlist: &Netlist, time: f64, nodes: [&str; N]) -> [f64; N] {
    let network = &netlist.network;
    let system = ThermalSystem::assemble(network).expect("it assembles");
    let solution = Transient::until(Time(time)).solve(&system).expect("it runs");
    let last = solution.times().len() - 1;
    nodes.map(|name| {
        let node = network.node(name).expect("it is there");
        solution.temperature(node).expect("it is recorded")[last]
    })
}

/// A box of 60 nodes with 90 linear couplings and 500 by radiation, as decks of spacecraft list
/// them. Expected: SciPy, Radau with rtol 1e-10, from the same lists.
#[test]
fn a_deck_of_linear_and_radiation_couplings_is_three_lists() {
    let netlist = deck(
        "format = 1\n[default]\ntemperature_unit = \"K\"\n[import]\nnodes = \
         \"box_nodes.csv\"\nconductors = [\"box_lines.csv\", \"box_radiation.csv\"]\nsources = \
         \"box_sources.csv\"\n[boundary]\nspace = { T = \"2.73 K\" }\n",
    );
    let network = &netlist.network;
    let last = network.conductor_ids().last().map(|id| network.name_of(Item::Conductor(id)));
    assert_eq!(last.as_deref(), Some("import.conductor[590]"));
    let found = after(&netlist, 3600.0, ["n3", "n40", "n0"]);
    let expected = [360.809_255_3, 309.664_161_1, 339.055_400_9];
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }
}

/// Six panels of a small satellite: couplings by radiation from a file, sunlight as a signal.
/// Expected: SciPy, DOP853 with rtol 1e-12, after 60 orbits of 95 min.
#[test]
fn panels_in_an_orbit_take_their_couplings_from_a_file() {
    let netlist = deck(
        "format = 1\n[param]\nabsorbed = \"0.11 * 0.01 [m^2] * 1361 [W/m^2]\"\n[signal]\nsun = \
         { t = [0, 60], v = [1, 0], t_unit = \"min\", v_unit = \"1\", interp = \"previous\", \
         after_end = \"repeat\", period = \"95 min\" }\n[default]\ntemperature_unit = \
         \"K\"\n[import]\nnodes = \"panels_nodes.csv\"\nboundaries = \
         \"panels_boundaries.csv\"\nconductors = \"panels_radiation.csv\"\n[source]\nsunlight = \
         { into = \"px\", P = \"absorbed * sun\" }\nelectronics = { into = \"mz\", P = \"0.4 W\" \
         }\n",
    );
    let found = after(&netlist, 95.0 * 3600.0, ["mx", "mz", "px"]);
    let expected = [294.734_686_47, 300.674_298_11, 303.977_141_72];
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }
}
