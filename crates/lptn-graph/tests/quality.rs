//! Kind: counters. Pictures of every network of the collection and of the pages: no wire through a
//! box, few crossings, short wires, letters that can be read on a page. Ceilings are in pixels of
//! the drawing; a page shows it 960 pixels wide.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use crate::common;

use common::{drawn, pages_and_networks};
use lptn_graph::{Diagram, Grouping, Laid};
use lptn_plot::scene::{Shape, Step, Text};
use lptn_plot::{Ink, Scene, font, svg};

/// Names of 13 pixels have 9 on a page.
const MOST_WIDE: f64 = 1380.0;

/// Wires for each path or group of sources, in pixels: in one picture, and in the mean over all.
const MOST_WIRE: f64 = 470.0;
const MEAN_WIRE: f64 = 160.0;

/// Crossings in one picture, and in all.
const MOST_CROSSINGS: usize = 2;
const ALL_CROSSINGS: usize = 6;

type Piece = [(f64, f64); 2];

fn paths(scene: &Scene) -> impl Iterator<Item = &lptn_plot::scene::Path> {
    scene.shapes.iter().filter_map(|shape| match shape {
        Shape::Path(path) => Some(path),
        Shape::Text(_) => None,
    })
}

/// Level and upright lines as thin as wires.
fn wires(scene: &Scene) -> Vec<Piece> {
    let of = |path: &lptn_plot::scene::Path| {
        let stroke = path.stroke.filter(|stroke| stroke.ink == Ink::Text)?;
        let [Step::Move(x, y), Step::Line(u, v)] = path.steps[..] else { return None };
        let straight = (x - u).abs() < 1e-9 || (y - v).abs() < 1e-9;
        let thin = (stroke.width - 1.3).abs() < 1e-9;
        (straight && thin).then_some([(x, y), (u, v)])
    };
    paths(scene).filter_map(of).collect()
}

/// Boxes of nodes and boundaries: what bears a name to point at.
fn boxes(scene: &Scene) -> Vec<Piece> {
    let framed = paths(scene).filter(|path| path.tip.is_some());
    let corners = |path: &lptn_plot::scene::Path| {
        let points = path.steps.iter().filter_map(|step| match *step {
            Step::Move(x, y) | Step::Line(x, y) | Step::Curve([.., (x, y)]) => Some((x, y)),
            _ => None,
        });
        let none = [(f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY)];
        points.fold(none, |[low, high], (x, y)| {
            [(low.0.min(x), low.1.min(y)), (high.0.max(x), high.1.max(y))]
        })
    };
    framed.map(corners).collect()
}

/// Pairs of wires that pass over each other without a dot.
fn crossings(scene: &Scene) -> usize {
    let wires = wires(scene);
    let dots: Vec<(f64, f64)> = paths(scene)
        .filter_map(|path| match path.steps[..] {
            [Step::Circle(at, r)] if r < 4.0 => Some(at),
            _ => None,
        })
        .collect();
    let (level, upright): (Vec<&Piece>, Vec<&Piece>) =
        wires.iter().partition(|[a, b]| (a.1 - b.1).abs() < 1e-9);
    let inside = |v: f64, p: f64, q: f64| v > p.min(q) + 1.0 && v < p.max(q) - 1.0;
    let cross = |a: &Piece, b: &Piece| {
        let (x, y) = (b[0].0, a[0].1);
        let joined = dots.iter().any(|dot| (dot.0 - x).hypot(dot.1 - y) < 2.0);
        inside(x, a[0].0, a[1].0) && inside(y, b[0].1, b[1].1) && !joined
    };
    level.iter().map(|a| upright.iter().filter(|b| cross(a, b)).count()).sum()
}

#[test]
fn counters_circuits_are_short_and_clear() {
    let (mut all, mut wire, mut pictures) = (0, 0.0, 0.0);
    for path in pages_and_networks() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let netlist = lptn_netlist::read(&path).unwrap();
        let of = drawn(&netlist, true, Grouping::Auto);
        let picture = Laid::of(&of).scene().unwrap();
        assert!(picture.size.0 <= MOST_WIDE, "{name}: {} pixels wide", picture.size.0);
        let wires = wires(&picture);
        for [low, high] in boxes(&picture) {
            let through = wires.iter().find(|[a, b]| {
                a.0.max(b.0) > low.0 + 2.0
                    && a.0.min(b.0) < high.0 - 2.0
                    && a.1.max(b.1) > low.1 + 2.0
                    && a.1.min(b.1) < high.1 - 2.0
            });
            assert_eq!(through, None, "{name}: a wire through the box at {low:?}");
        }
        let places: std::collections::BTreeSet<usize> = of.sources.iter().map(|s| s.into).collect();
        let elements = (of.links.len() + places.len()) as f64;
        let long: f64 = wires.iter().map(|[a, b]| (a.0 - b.0).abs() + (a.1 - b.1).abs()).sum();
        assert!(long <= MOST_WIRE * elements, "{name}: {:.0} pixels of wire", long / elements);
        let crossings = crossings(&picture);
        assert!(crossings <= MOST_CROSSINGS, "{name}: {crossings} crossings");
        (all, wire, pictures) = (all + crossings, wire + long / elements, pictures + 1.0);
    }
    assert!(all <= ALL_CROSSINGS, "{all} crossings");
    assert!(wire <= MEAN_WIRE * pictures, "{:.1} pixels of wire", wire / pictures);
}

/// The position of each place: where its name is written.
fn positions(of: &Diagram, picture: &Scene) -> Vec<Option<(f64, f64)>> {
    let texts: Vec<&Text> = picture
        .shapes
        .iter()
        .filter_map(|shape| match shape {
            Shape::Text(text) if text.bold => Some(text),
            _ => None,
        })
        .collect();
    let at = |name: &str| texts.iter().find(|text| text.text == name).map(|text| text.at);
    of.places.iter().map(|place| at(&place.name)).collect()
}

/// From left to right, and from top to bottom in a column, nodes have one order in both pictures.
#[test]
fn heat_flows_have_the_order_of_the_circuit() {
    let named = ["gearbox", "motor_jacket", "motor_housing", "inverter", "chip", "paper_bed"];
    let mut seen = 0;
    for path in pages_and_networks() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if !named.contains(&name.as_str()) {
            continue;
        }
        let of = drawn(&lptn_netlist::read(&path).unwrap(), true, Grouping::Auto);
        let circuit = positions(&of, &Laid::of(&of).scene().unwrap());
        let bands = positions(&of, &Laid::of(&of).sankey().unwrap());
        for i in 0..of.places.len() {
            for j in 0..i {
                let (Some(a), Some(b)) = (circuit[i], circuit[j]) else { panic!("{name}") };
                let (Some(c), Some(d)) = (bands[i], bands[j]) else { continue };
                let same = |x: f64, y: f64| (x - y).abs() < 1.0;
                let (first, second) = (&of.places[i].name, &of.places[j].name);
                let beside = if same(c.0, d.0) { (a.1 - b.1) * (c.1 - d.1) } else { 1.0 };
                let along = if same(a.0, b.0) { 1.0 } else { (a.0 - b.0) * (c.0 - d.0) };
                assert!(beside > 0.0 && along >= 0.0, "{name}: {first} and {second}");
                seen += 1;
            }
        }
    }
    assert!(seen > 40, "{seen}");
}

/// Three surfaces that see each other and space, written from the coldest on. The middle of the
/// heat is closest to the only source: by symmetry `lit` has the largest potential, and the two
/// others have the same, so that they keep the order of the file.
#[test]
fn heat_goes_to_the_right_whatever_the_order_of_the_file() {
    let netlist = lptn_netlist::parse(
        "surfaces",
        r#"
format = 1
[node]
dark = { C = "9 J/K", T0 = "20 degC" }
side = { C = "9 J/K", T0 = "20 degC" }
lit = { C = "9 J/K", T0 = "20 degC" }
[boundary]
space = { T = "0 degC" }
[source]
sun = { into = "lit", P = "9 W" }
[resistor]
a = { from = "dark", to = "side", R = "1 K/W" }
b = { from = "dark", to = "lit", R = "1 K/W" }
c = { from = "side", to = "lit", R = "1 K/W" }
d = { from = "dark", to = "space", R = "1 K/W" }
e = { from = "space", to = "side", R = "1 K/W" }
f = { from = "space", to = "lit", R = "1 K/W" }
"#,
    )
    .unwrap();
    for steady in [false, true] {
        let of = drawn(&netlist, steady, Grouping::No);
        let at = positions(&of, &Laid::of(&of).scene().unwrap());
        let [dark, side, lit, space] = [0, 1, 2, 3].map(|i: usize| at[i].unwrap().0);
        assert!(lit < dark && dark < side && side < space, "{at:?}");
    }
}

/// A wider font that stands in for the first one has the widths of the first one, so that no word
/// covers another. A single letter has no room to lose.
#[test]
fn words_have_the_width_that_they_were_placed_by() {
    let mut scene = Scene::new((90.0, 90.0), "title");
    scene.write(Text::new("steel", (1.0, 2.0), 12.0, Ink::Text).bold());
    scene.write(Text::new("x", (1.0, 2.0), 12.0, Ink::Text));
    let wide = svg::length(font::width("steel", 12.0, true));
    let text = svg::write(&scene);
    assert!(text.contains(&format!(" textLength=\"{wide}\" lengthAdjust=")), "{text}");
    assert_eq!(text.matches("textLength").count(), 1);
}
