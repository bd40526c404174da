//! Heat flows as bands: widths by hand, what comes in goes out, whatever the network, and nothing
//! lies upon a text.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{EVIL, check, networks};
use lptn_assembly::ThermalSystem;
use lptn_graph::{
    BarRole, Diagram, Grouping, HeatFlows, Laid, MOST_PLACES, NoSankey, View, diagram,
};
use lptn_netlist::Netlist;
use lptn_plot::scene::{Shape, Step};
use lptn_plot::{Scene, svg};
use lptn_solve::{Snapshot, SteadyState, Transient};
use lptn_units::Unit;

fn read(text: &str) -> Netlist {
    lptn_netlist::parse("test", text).unwrap()
}

fn drawn(netlist: &Netlist, state: Option<&Snapshot>, grouping: Grouping) -> Diagram {
    let unit = Unit::parse("degC").unwrap();
    diagram(&netlist.network, &View { title: "title", grouping, unit: &unit, state, marked: false })
}

fn steady(netlist: &Netlist) -> Option<Snapshot> {
    let system = ThermalSystem::assemble(&netlist.network).ok()?;
    SteadyState::solve(&system, 0.0).ok().map(|steady| steady.state)
}

/// The state in the middle of the rows of the run.
fn midway(netlist: &Netlist) -> Option<Snapshot> {
    let system = ThermalSystem::assemble(&netlist.network).ok()?;
    let run = Transient::of(&netlist.network, netlist.run.as_ref()?);
    let solution = run.solve(&system).unwrap();
    solution.snapshot(solution.times().len() / 2)
}

/// Name of the band, names of its ends, heat in W.
fn bands(flows: &HeatFlows) -> Vec<(&str, &str, &str, f64)> {
    let name = |bar: usize| flows.bars[bar].name.as_str();
    let bands = flows.bands.iter();
    bands.map(|band| (band.name.as_str(), name(band.from), name(band.to), band.heat)).collect()
}

fn same(flows: &HeatFlows, expected: &[(&str, &str, &str, f64)]) {
    let found = bands(flows);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert_eq!((found.0, found.1, found.2), (expected.0, expected.1, expected.2));
        assert!((found.3 - expected.3).abs() < 1e-6 * expected.3, "{found:?} {expected:?}");
    }
}

/// 12 W into `hot`, which leaves 9 W to `cold` and 3 W to the air: T_hot = 20 + 3 * 10 = 50 degC
/// and T_cold = 50 - 9 * 2 = 32 degC. There 4 W are taken out, so that (32 - 20) / 2.4 = 5 W go on.
const PAIR: &str = r#"
format = 1
[node]
hot = { C = "100 J/K", T0 = "20 degC" }
cold = { C = "50 J/K", T0 = "20 degC" }
[boundary]
air = { T = "20 degC" }
[source]
heater = { into = "hot", P = "12 W" }
cooler = { into = "cold", P = "-4 W" }
[resistor]
joint = { from = "cold", to = "hot", R = "2 K/W" }
skin = { from = "hot", to = "air", R = "10 K/W" }
foot = { from = "cold", to = "air", R = "2.4 K/W" }
[run]
stop = "1 h"
"#;

/// 1, 2, 3, 4 and 5 W into `hot` are one bar of 15 W. Those that cool have their own.
#[test]
fn many_sources_of_a_place_are_one_bar() {
    let one = |i: i32| format!("s{i} = {{ into = \"hot\", P = \"{i} W\" }}\n");
    let many: String = (1..=5).map(one).collect();
    let four = PAIR.replace("heater = { into = \"hot\", P = \"12 W\" }\n", "");
    let four = four.replace("[source]\n", &format!("[source]\n{many}"));
    let four = four.replace("[resistor]", "drain = { into = \"hot\", P = \"-3 W\" }\n[resistor]");
    let netlist = read(&four);
    let state = steady(&netlist).unwrap();
    let flows = HeatFlows::of(&drawn(&netlist, Some(&state), Grouping::No));
    let sources: Vec<(&str, f64, f64)> = flows
        .bars
        .iter()
        .filter(|bar| bar.role == BarRole::Source)
        .map(|bar| (bar.name.as_str(), bar.into, bar.out))
        .collect();
    assert_eq!(sources, [("5 sources", 0.0, 15.0), ("cooler", 4.0, 0.0), ("drain", 3.0, 0.0)]);
}

#[test]
fn bands_are_those_of_the_closed_form() {
    let netlist = read(PAIR);
    let state = steady(&netlist).unwrap();
    same(
        &HeatFlows::of(&drawn(&netlist, Some(&state), Grouping::No)),
        &[
            ("heater", "heater", "hot", 12.0),
            ("cooler", "cold", "cooler", 4.0),
            ("joint", "hot", "cold", 9.0),
            ("skin", "hot", "air", 3.0),
            ("foot", "cold", "air", 5.0),
        ],
    );
}

/// At its start everything is at 20 degC: no path carries heat, `hot` stores 12 W, and `cold` gives
/// back 4 W.
#[test]
fn what_stays_is_stored_and_what_is_missing_is_released() {
    let netlist = read(PAIR);
    let system = ThermalSystem::assemble(&netlist.network).unwrap();
    let run = Transient::of(&netlist.network, netlist.run.as_ref().unwrap());
    let state = run.solve(&system).unwrap().snapshot(0).unwrap();
    let of = drawn(&netlist, Some(&state), Grouping::No);
    assert_eq!(of.scales.as_ref().unwrap().caption, "at 0 s");
    assert_eq!(of.state_of(&of.places[0]), ["20.0 °C", "stores 12.00 W"]);
    assert_eq!(of.state_of(&of.places[1]), ["20.0 °C", "releases 4.00 W"]);
    assert_eq!(of.state_of(&of.places[2]), ["20.0 °C"]);
    same(
        &HeatFlows::of(&of),
        &[
            ("heater", "heater", "hot", 12.0),
            ("cooler", "cold", "cooler", 4.0),
            ("stored in hot", "hot", "stored", 12.0),
            ("released by cold", "released", "cold", 4.0),
        ],
    );
}

/// 2 W/K flow from an inlet of 60 degC through `pot` to a drain of 20 degC; `skin` takes 0.5 K/W to
/// the air of 20 degC: `pot` is at 40 degC. Above the 20 degC of the drain the fluid brings 80 W from
/// the inlet, of which 40 W go on. `chill` flows at 1 W/K from a boundary of 10 degC into a second
/// pot, which 15 W keep at 25 degC, and ends there: it carries them away.
#[test]
fn a_stream_joins_its_source_and_its_sink() {
    let netlist = read(
        r#"
format = 1
[default]
T0 = "20 degC"
[node]
pot = { C = "100 J/K" }
second = { C = "100 J/K" }
[boundary]
inlet = { T = "60 degC" }
air = { T = "20 degC" }
drain = { T = "20 degC" }
cold = { T = "10 degC" }
[source]
heater = { into = "second", P = "15 W" }
[advection]
feed = { from = "pot", to = "inlet", mcp = "-2 W/K" }
waste = { from = "pot", to = "drain", mcp = "2 W/K" }
chill = { from = "cold", to = "second", mcp = "1 W/K" }
[resistor]
skin = { from = "pot", to = "air", R = "0.5 K/W" }
"#,
    );
    let state = steady(&netlist).unwrap();
    same(
        &HeatFlows::of(&drawn(&netlist, Some(&state), Grouping::No)),
        &[
            ("heater", "heater", "second", 15.0),
            ("skin", "pot", "air", 40.0),
            ("feed", "inlet", "pot", 80.0),
            ("waste", "pot", "drain", 40.0),
            ("chill", "second", "chill", 15.0),
        ],
    );
}

/// Water of 30 degC takes 971 W from a jacket and brings them to its chiller: one chain, no island.
/// 971 W at 500 W/K are 1.942 K.
const LOOP: &str = r#"
format = 1
[node]
jacket = { C = "100 J/K", T0 = "30 degC" }
[boundary]
chiller = { T = "30 degC" }
[source]
losses = { into = "jacket", P = "971 W" }
[advection]
feed = { from = "chiller", to = "jacket", mcp = "500 W/K" }
back = { from = "jacket", to = "chiller", mcp = "500 W/K" }
"#;

#[test]
fn a_coolant_is_not_an_island() {
    let netlist = read(LOOP);
    let state = steady(&netlist).unwrap();
    let of = drawn(&netlist, Some(&state), Grouping::No);
    let expected = [("losses", "losses", "jacket", 971.0), ("back", "jacket", "chiller", 971.0)];
    same(&HeatFlows::of(&of), &expected);
    let scene = Laid::of(&of).sankey().unwrap();
    let said =
        |shape: &Shape| matches!(shape, Shape::Text(text) if text.text.contains("above 30.0"));
    assert!(scene.shapes.iter().any(said), "the reference is said");
}

/// Six cells in series on 10 W/K, each heated by 5 W: the fluid carries 5, 10 .. 30 W, and the six
/// instances of the template are one box.
#[test]
fn a_row_of_cells_is_one_box_that_its_coolant_passes() {
    let mut text = "format = 1\n[default]\nT0 = \"20 degC\"\n[template.c.node]\nbody = { C = \"10 J/K\" }\n\
                    [use]\ncell = { template = \"c\", count = 6 }\n[boundary]\nsupply = { T = \"20 degC\" }\n\
                    drain = { T = \"20 degC\" }\n[source]\n"
        .to_owned();
    (1..=6).for_each(|i| text += &format!("s{i} = {{ into = \"cell[{i}].body\", P = \"5 W\" }}\n"));
    text += "[advection]\nin = { from = \"supply\", to = \"cell[1].body\", mcp = \"10 W/K\" }\n";
    for i in 1..6 {
        let (from, to) = (i, i + 1);
        text += &format!(
            "f{i} = {{ from = \"cell[{from}].body\", to = \"cell[{to}].body\", mcp = \"10 W/K\" }}\n"
        );
    }
    text += "out = { from = \"cell[6].body\", to = \"drain\", mcp = \"10 W/K\" }\n";
    let netlist = read(&text);
    let state = steady(&netlist).unwrap();
    let every = HeatFlows::of(&drawn(&netlist, Some(&state), Grouping::No));
    let carried: Vec<f64> = bands(&every).iter().skip(6).map(|band| band.3).collect();
    for (found, expected) in carried.iter().zip([5.0, 10.0, 15.0, 20.0, 25.0, 30.0]) {
        assert!((found - expected).abs() < 1e-9, "{carried:?}");
    }
    assert_eq!(carried.len(), 6, "no fluid is left over: {:?}", bands(&every));
    let of = drawn(&netlist, Some(&state), Grouping::Auto);
    assert_eq!(of.grouped, ["cell[*]: \u{d7} 6"]);
    let flows = HeatFlows::of(&of);
    let last = bands(&flows).into_iter().last().unwrap();
    assert_eq!((last.0, last.1, last.2), ("out", "cell[*]", "drain"));
    assert!((last.3 - 30.0).abs() < 1e-9, "{last:?}");
    balanced(&flows);
}

/// A body at 300 K that radiates into space at 2.7 K: the scale is that of the bodies.
#[test]
fn empty_space_does_not_set_the_scale_of_colours() {
    let text = PAIR.replace("[source]", "space = { T = \"2.7 K\" }\n[source]");
    let text =
        text.replace("[run]", "far = { from = \"hot\", to = \"space\", R = \"1e6 K/W\" }\n[run]");
    let netlist = read(&text);
    let state = steady(&netlist).unwrap();
    let scales = drawn(&netlist, Some(&state), Grouping::No).scales.unwrap();
    assert!((scales.span[0] - 293.15).abs() < 1e-9, "air is the coldest: {:?}", scales.span);
    assert!(scales.caption.contains("; space, "), "{}", scales.caption);
    assert!(scales.caption.ends_with("is below the scale"), "{}", scales.caption);
}

/// 9 W leave an instance for `middle`, where 1 W is taken out; 8 W come back to its colder node and
/// leave by `out`.
const ROUND: &str = r#"
format = 1
[default]
T0 = "20 degC"
[template.p.node]
hot = { C = "10 J/K" }
cold = { C = "10 J/K" }
[use]
q = { template = "p" }
[node]
middle = { C = "10 J/K" }
[boundary]
air = { T = "20 degC" }
[source]
heater = { into = "q.hot", P = "9 W" }
cooler = { into = "middle", P = "-1 W" }
[resistor]
on = { from = "q.hot", to = "middle", R = "2 K/W" }
back = { from = "middle", to = "q.cold", R = "2 K/W" }
out = { from = "q.cold", to = "air", R = "9 K/W" }
"#;

#[test]
fn heat_that_goes_round_bears_an_arrow() {
    let netlist = read(ROUND);
    let state = steady(&netlist).unwrap();
    let of = drawn(&netlist, Some(&state), Grouping::Yes);
    same(
        &HeatFlows::of(&of),
        &[
            ("heater", "heater", "q", 9.0),
            ("cooler", "middle", "cooler", 1.0),
            ("on", "q", "middle", 9.0),
            ("back", "middle", "q", 8.0),
            ("out", "q", "air", 8.0),
        ],
    );
    let scene = Laid::of(&of).sankey().unwrap();
    check(&scene, "round");
    let arrow = |shape: &&Shape| matches!(shape, Shape::Path(path) if path.steps.len() == 4);
    assert_eq!(scene.shapes.iter().filter(arrow).count(), 1);
}

/// Streams of both directions between two groups, of 1 W/K and 3 W/K, and one inside a group, of 2
/// W/K: boundaries hold every temperature. `a.x` is at 50 degC, `a.y` at 30 degC, `b` at 20 degC.
#[test]
fn streams_of_groups_bring_what_each_of_them_brings() {
    let mut text = r#"
format = 1
[default]
T0 = "20 degC"
[template.p.node]
x = { C = "10 J/K" }
y = { C = "10 J/K" }
[use]
a = { template = "p" }
b = { template = "p" }
[boundary]
"#
    .to_owned();
    let nodes = [("a.x", "50"), ("a.y", "30"), ("b.x", "20"), ("b.y", "20")];
    for (i, (_, degrees)) in nodes.iter().enumerate() {
        text += &format!("hold{i} = {{ T = \"{degrees} degC\" }}\n");
    }
    text += "[resistor]\n";
    for (i, (node, _)) in nodes.iter().enumerate() {
        text += &format!("r{i} = {{ from = \"hold{i}\", to = \"{node}\", R = \"1e-9 K/W\" }}\n");
    }
    text += "[advection]\n";
    for (i, rate) in ["1", "1", "-3", "1"].iter().enumerate() {
        let (from, to) = [("a.x", "b.x"), ("a.x", "b.y"), ("a.x", "b.x"), ("a.y", "b.x")][i];
        text += &format!("s{i} = {{ from = \"{from}\", to = \"{to}\", mcp = \"{rate} W/K\" }}\n");
    }
    text += "inner = { from = \"a.x\", to = \"a.y\", mcp = \"2 W/K\" }\n";
    let netlist = read(&text);
    let state = steady(&netlist).unwrap();
    let flows = HeatFlows::of(&drawn(&netlist, Some(&state), Grouping::Yes));
    let streams: Vec<_> =
        bands(&flows).into_iter().filter(|band| !band.0.starts_with('r')).collect();
    // to b 30 W and 30 W and 10 W, to a -90 W; inside of a 40 W
    let expected = [
        ("4 paths", "4 paths", "b", 70.0),
        ("4 paths", "a", "4 paths", 90.0),
        ("streams in a", "streams in a", "a", 40.0),
    ];
    assert_eq!(streams.len(), expected.len(), "{streams:?}");
    for (found, expected) in streams.iter().zip(&expected) {
        assert_eq!((found.0, found.1, found.2), (expected.0, expected.1, expected.2));
        assert!((found.3 - expected.3).abs() < 1e-3, "{found:?}");
    }
    balanced(&flows);
}

/// The sums of a bar are those of its bands.
fn balanced(flows: &HeatFlows) {
    let most = flows.bars.iter().map(lptn_graph::Bar::heat).fold(0.0, f64::max);
    for (i, bar) in flows.bars.iter().enumerate() {
        let sum = |end: fn(&lptn_graph::Band) -> usize| -> f64 {
            flows.bands.iter().filter(|band| end(band) == i).map(|band| band.heat).sum()
        };
        let (into, out) = (sum(|band| band.to), sum(|band| band.from));
        let rounding = 1e-12 * most;
        assert!((into - bar.into).abs() <= rounding && (out - bar.out).abs() <= rounding);
    }
}

fn conserves(netlist: &Netlist, state: &Snapshot, grouping: Grouping, name: &str) {
    let of = drawn(netlist, Some(state), grouping);
    let flows = HeatFlows::of(&of);
    balanced(&flows);
    let most = flows.bands.iter().map(|band| band.heat).fold(0.0, f64::max);
    // paths below 1e-9 W count as rounding in every diagram
    let rounding = 1e-9 * most + 1e-9 * flows.bands.len() as f64;
    for bar in &flows.bars {
        let free = match bar.role {
            BarRole::Place(i) => of.places[i].role == lptn_graph::PlaceRole::Boundary,
            _ => true,
        };
        let open = (bar.into - bar.out).abs();
        assert!(free || open <= rounding, "{name}: {open} W of {bar:?}");
    }
    match Laid::of(&of).sankey() {
        Ok(scene) => {
            check(&scene, name);
            widths(&scene, &flows, name);
        }
        Err(error) => {
            let nothing = flows.bars.is_empty() && error == NoSankey::NoHeat;
            let many = flows.bars.len() > MOST_PLACES;
            assert!(nothing || many, "{name}: {error}");
        }
    }
}

/// Bands are drawn as wide as they are large, all at one scale, but for hairlines.
fn widths(scene: &Scene, flows: &HeatFlows, name: &str) {
    let paths = scene.shapes.iter().filter_map(|shape| match shape {
        Shape::Path(path) => Some(path),
        Shape::Text(_) => None,
    });
    let tipped: Vec<_> = paths.filter(|path| path.tip.is_some()).take(flows.bands.len()).collect();
    let width = |i: usize| match (tipped[i].steps.first(), tipped[i].steps.iter().rev().nth(1)) {
        (Some(Step::Move(_, top)), Some(Step::Line(_, low) | Step::Curve([_, _, (_, low)]))) => {
            low - top
        }
        other => panic!("{name}: {other:?}"),
    };
    let of = |i: &usize| flows.bands[*i].heat;
    let widest = (0..flows.bands.len()).max_by(|a, b| of(a).total_cmp(&of(b))).unwrap();
    let scale = width(widest) / of(&widest);
    for i in 0..flows.bands.len() {
        let expected = (scale * of(&i)).max(0.8);
        assert!((width(i) - expected).abs() < 1e-6, "{name}: {} {expected}", width(i));
    }
}

#[test]
fn what_comes_in_goes_out_in_every_network() {
    let (mut settled, mut runs) = (0, 0);
    for path in networks() {
        let netlist = lptn_netlist::read(&path).unwrap();
        let name = path.display().to_string();
        for grouping in [Grouping::No, Grouping::Yes] {
            if let Some(state) = steady(&netlist) {
                conserves(&netlist, &state, grouping, &name);
                settled += 1;
            }
            if let Some(state) = midway(&netlist) {
                conserves(&netlist, &state, grouping, &format!("{name} in a run"));
                runs += 1;
            }
        }
    }
    assert!(settled > 50 && runs > 40, "{settled} {runs}");
}

/// A chain of so many nodes.
fn chain(count: usize) -> Netlist {
    let mut text = "format = 1\n[default]\nT0 = \"20 degC\"\n[node]\n".to_owned();
    (1..=count).for_each(|i| text += &format!("n{i} = {{ C = \"{i} J/K\" }}\n"));
    text += "[boundary]\nair = { T = \"20 degC\" }\n[resistor]\n";
    for i in 1..=count {
        let to = if i == count { "air".to_owned() } else { format!("n{}", i + 1) };
        text += &format!("r{i} = {{ from = \"n{i}\", to = \"{to}\", R = \"0.1 K/W\" }}\n");
    }
    read(&(text + "[source]\nheat = { into = \"n1\", P = \"9 W\" }\n"))
}

#[test]
fn what_cannot_be_drawn_is_said() {
    let many = chain(MOST_PLACES);
    let state = steady(&many).unwrap();
    let error = Laid::of(&drawn(&many, Some(&state), Grouping::No)).sankey().unwrap_err();
    assert_eq!(error, NoSankey::TooMany { bars: MOST_PLACES + 2 });
    assert!(Laid::of(&drawn(&many, Some(&state), Grouping::Auto)).sankey().is_ok());
    assert_eq!(
        Laid::of(&drawn(&many, None, Grouping::No)).sankey().unwrap_err(),
        NoSankey::NoState
    );
    let cold = read(&PAIR.replace("\"12 W\"", "\"0 W\"").replace("\"-4 W\"", "\"0 W\""));
    let state = steady(&cold).unwrap();
    assert_eq!(
        Laid::of(&drawn(&cold, Some(&state), Grouping::No)).sankey().unwrap_err(),
        NoSankey::NoHeat
    );
}

#[test]
fn the_same_network_gives_the_same_bytes_and_long_chains_are_drawn() {
    let netlist = chain(60);
    let state = steady(&netlist).unwrap();
    let all =
        || svg::write(&Laid::of(&drawn(&netlist, Some(&state), Grouping::No)).sankey().unwrap());
    assert!(all() == all());
}

#[test]
fn names_cannot_become_elements_of_svg() {
    let netlist = read(PAIR);
    let state = midway(&netlist).unwrap();
    let mut of = drawn(&netlist, Some(&state), Grouping::No);
    of.title = EVIL.into();
    of.places.iter_mut().for_each(|place| place.name = EVIL.into());
    of.links.iter_mut().for_each(|link| link.name = EVIL.into());
    of.sources.iter_mut().for_each(|source| source.name = EVIL.into());
    let text = svg::write(&Laid::of(&of).sankey().unwrap());
    assert!(!text.contains("<script") && text.matches("</svg>").count() == 1, "{text}");
}
