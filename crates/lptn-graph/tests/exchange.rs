//! Kind: analytic. The paths between places that are all joined to each other: one box in the
//! circuit, and a table with each of them.

use lptn_graph::{Grouping, Laid};
use lptn_plot::Scene;
use lptn_plot::scene::Shape;
use std::fmt::Write as _;

use crate::common::{check, drawn};

/// The widest circuit of six surfaces: letters of 12 pixels on a page of 960.
const WIDE: f64 = 1000.0;

fn picture(text: &str) -> Scene {
    let netlist = lptn_netlist::parse("held.toml", text).unwrap();
    Laid::of(&drawn(&netlist, true, Grouping::Auto)).scene().unwrap()
}

fn texts(scene: &Scene) -> Vec<&str> {
    let shapes = scene.shapes.iter();
    shapes
        .filter_map(|s| if let Shape::Text(text) = s { Some(&*text.text) } else { None })
        .collect()
}

/// The words that appear if a reader points at a thing.
fn tips(scene: &Scene) -> Vec<&str> {
    let shapes = scene.shapes.iter();
    let tip = shapes.map(|s| if let Shape::Path(path) = s { path.tip.as_deref() } else { None });
    tip.flatten().collect()
}

/// Places that are held at 10, 20, 30 … degC by 1 nK/W, and all joined by 1 K/W.
fn held(count: usize, section: &str, value: &str) -> String {
    let (mut nodes, mut walls, mut holds, mut paths) = <[String; 4]>::default().into();
    for i in 1..=count {
        writeln!(nodes, "n{i} = {{ massless = true }}").unwrap();
        writeln!(walls, "w{i} = {{ T = '{} degC' }}", 10 * i).unwrap();
        writeln!(holds, "h{i} = {{ from = 'w{i}', to = 'n{i}', R = '1e-9 K/W' }}").unwrap();
        for j in i + 1..=count {
            writeln!(paths, "p{i}_{j} = {{ from = 'n{i}', to = 'n{j}', {value} }}").unwrap();
        }
    }
    let own = if section == "resistor" { String::new() } else { format!("[{section}]\n") };
    format!("format = 1\n[node]\n{nodes}[boundary]\n{walls}[resistor]\n{holds}{own}{paths}")
}

/// Between four places at 10, 20, 30 and 40 degC, 10 W flow over 1 K/W for each step of 10 K. Every
/// path is in the table, and at the box are the sums: 60, 20, 20 and 60 W.
#[test]
fn every_path_of_an_exchange_is_in_its_table_with_its_heat() {
    let scene = picture(&held(4, "resistor", "R = '1 K/W'"));
    check(&scene, "four");
    let tips = tips(&scene);
    for (i, j) in [(1, 2), (1, 3), (1, 4), (2, 3), (2, 4), (3, 4)] {
        let begin = format!("p{i}_{j}, n{i} to n{j}, 1 K/W, \u{2212}");
        let told = tips.iter().find_map(|tip| tip.strip_prefix(begin.as_str()));
        let watts: f64 = told.unwrap().trim_end_matches(" W").parse().unwrap();
        assert!((watts - f64::from(10 * (j - i))).abs() < 1e-6, "{begin}{watts}");
    }
    let texts = texts(&scene);
    assert!(texts.contains(&"6 paths, table below"), "{texts:?}");
    let watts: Vec<f64> =
        texts.iter().filter_map(|text| text.strip_suffix(" W")?.parse().ok()).collect();
    for heat in [60.0, 20.0] {
        // two at the box, two at the paths that hold these places, one 20 W in the table
        let told = watts.iter().filter(|watts| (**watts - heat).abs() < 1e-6).count();
        assert!(told >= 4, "{heat}: {texts:?}");
    }
}

/// Six surfaces that see each other, with space and two sources: no wider than a page, and each of
/// the 15 paths is named.
#[test]
fn six_surfaces_fit_a_page() {
    let mut text = held(6, "radiation", "Gr = '1.8e-3 m^2'");
    text += "[source]\nsun = { into = 'n4', P = '1 W' }\nload = { into = 'n3', P = '0.4 W' }\n";
    let scene = picture(&text);
    check(&scene, "six");
    assert!(scene.size.0 <= WIDE, "{} pixels", scene.size.0);
    let texts = texts(&scene);
    for (i, j) in (1..=6).flat_map(|i| (i + 1..=6).map(move |j| (i, j))) {
        let name = format!("p{i}_{j}");
        assert_eq!(texts.iter().filter(|text| **text == name).count(), 1, "{name}");
    }
}

/// Sixteen surfaces: 120 paths on a page, each with a tip.
#[test]
fn a_large_exchange_fits_a_page() {
    for count in [12, 16, 40] {
        let scene = picture(&held(count, "radiation", "Gr = '1e-3 m^2'"));
        check(&scene, "many");
        assert!(scene.size.0 <= WIDE, "{count}: {} pixels", scene.size.0);
        let paths = tips(&scene).iter().filter(|tip| tip.starts_with('p')).count();
        assert_eq!(paths, count * (count - 1) / 2);
    }
}

/// Three places, a ring of four, streams and boundaries keep their paths.
#[test]
fn other_paths_are_drawn_one_by_one() {
    let ring = held(4, "resistor", "R = '1 K/W'");
    let ring: Vec<&str> = ring.lines().filter(|line| !line.starts_with("p1_3")).collect();
    for text in [held(3, "resistor", "R = '1 K/W'"), ring.join("\n")] {
        let scene = picture(&text);
        assert!(!texts(&scene).iter().any(|text| text.contains("table below")));
        assert!(texts(&scene).contains(&"p1_2"));
    }
}
