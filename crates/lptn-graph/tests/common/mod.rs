//! What tests of pictures share.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};

use lptn_assembly::ThermalSystem;
use lptn_graph::{Diagram, Grouping, View, diagram};
use lptn_netlist::Netlist;
use lptn_plot::scene::{Align, Shape, Step, Text};
use lptn_plot::{Ink, Scene, font};
use lptn_solve::SteadyState;
use lptn_units::Unit;

pub(crate) fn networks() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../networks");
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    paths.sort();
    assert!(paths.len() > 30);
    paths
}

/// What a title or a name might hold.
pub(crate) const EVIL: &str =
    "\"] --> end\n<script>alert(1)</script>\\ %%{init}%% `x` | é☃ ]] ));</svg>";

type Box = [f64; 4];

fn box_of(text: &Text) -> Box {
    let wide = font::width(&text.text, text.size, text.bold);
    let left = match text.align {
        Align::Start => text.at.0,
        Align::Middle => text.at.0 - wide / 2.0,
        Align::End => text.at.0 - wide,
    };
    [left, left + wide, text.at.1 - 0.75 * text.size, text.at.1 + 0.2 * text.size]
}

fn overlap(a: Box, b: Box) -> bool {
    a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3]
}

/// The straight pieces of all lines and outlines of marks, with their widths.
fn lines(scene: &Scene) -> Vec<Box> {
    let mut found = Vec::new();
    for shape in &scene.shapes {
        let Shape::Path(path) = shape else { continue };
        let mark = path.fill.is_some_and(|fill| fill.ink == Ink::Text);
        let half = match path.stroke {
            Some(stroke) => stroke.width / 2.0,
            None if mark => 0.5,
            None => continue,
        };
        let mut piece = |from: (f64, f64), to: (f64, f64)| {
            found.push([
                to.0.min(from.0) - half,
                to.0.max(from.0) + half,
                to.1.min(from.1) - half,
                to.1.max(from.1) + half,
            ]);
        };
        let mut last = (0.0, 0.0);
        for step in &path.steps {
            match *step {
                Step::Move(x, y) => last = (x, y),
                Step::Line(x, y) => {
                    piece(last, (x, y));
                    last = (x, y);
                }
                Step::Curve([a, b, end]) => {
                    let start = last;
                    for i in 1..=8 {
                        let t = f64::from(i) / 8.0;
                        let at = |p: [f64; 4]| {
                            let u = 1.0 - t;
                            p[0] * u.powi(3)
                                + 3.0 * p[1] * u * u * t
                                + 3.0 * p[2] * u * t * t
                                + p[3] * t.powi(3)
                        };
                        let to = (at([start.0, a.0, b.0, end.0]), at([start.1, a.1, b.1, end.1]));
                        piece(last, to);
                        last = to;
                    }
                }
                Step::Circle((x, y), r) => {
                    let at = |i: i32| {
                        let angle = std::f64::consts::TAU * f64::from(i) / 32.0;
                        (x + r * angle.cos(), y + r * angle.sin())
                    };
                    (0..32).for_each(|i| piece(at(i), at(i + 1)));
                }
                Step::Close => {}
            }
        }
    }
    found
}

pub(crate) fn check(scene: &Scene, name: &str) {
    let texts: Vec<&Text> = scene
        .shapes
        .iter()
        .filter_map(|shape| match shape {
            Shape::Text(text) => Some(text),
            Shape::Path(_) => None,
        })
        .collect();
    let lines = lines(scene);
    for (i, text) in texts.iter().enumerate() {
        let own = box_of(text);
        let (wide, tall) = scene.size;
        let inside = own[0] >= 0.0 && own[1] <= wide && own[2] >= 0.0 && own[3] <= tall;
        assert!(inside, "{name}: `{}` is not on the page", text.text);
        for other in &texts[..i] {
            let over = overlap(own, box_of(other));
            assert!(!over, "{name}: `{}` lies upon `{}`", text.text, other.text);
        }
        let line = lines.iter().find(|line| overlap(own, **line));
        assert_eq!(line, None, "{name}: a line goes through `{}` {own:?}", text.text);
    }
}

/// The networks, and those of the pages.
pub(crate) fn pages_and_networks() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/netlists");
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    paths.sort();
    assert!(paths.len() > 30);
    networks().into_iter().chain(paths).collect()
}

pub(crate) fn drawn(netlist: &Netlist, steady: bool, grouping: Grouping) -> Diagram {
    let network = &netlist.network;
    let unit = Unit::parse("degC").unwrap();
    let system = ThermalSystem::assemble(network).unwrap();
    // some cycle: they are drawn without
    let steady = steady.then(|| SteadyState::solve(&system, 0.0).ok()).flatten();
    let title = network.title().unwrap_or("untitled");
    diagram(network, &View { title, grouping, unit: &unit, state: steady.as_deref(), marked: true })
}
