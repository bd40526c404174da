use super::area::shortened;
use super::labels::apart;
use super::{scene, wrapped};
use crate::figure::{Axis, Curve, Figure, Level, Look, Moment, Panel};
use crate::font::width;
use crate::scene::{Scene, Shape, Step};
use crate::{png, svg};

fn heating() -> Figure {
    let rise = |tau: f64, by: f64| -> Vec<(f64, f64)> {
        (0..=300)
            .map(|i| 5.0 * f64::from(i))
            .map(|t| (t, 25.0 + by * (1.0 - (-t / tau).exp())))
            .collect()
    };
    let mut panel = Panel::new(Axis::time(), Axis::linear("temperature", "degC"));
    let steel = rise(800.0, 60.0);
    let spread = steel.iter().map(|(_, y)| (y - 2.0, y + 2.0)).collect();
    panel.curves.push(Curve::line("steel", steel).within(spread));
    panel.curves.push(Curve::line("aluminium", rise(810.0, 59.0)));
    panel.curves.push(Curve::line("tc1", rise(790.0, 58.0)).looks(Look::Dots).as_place(0));
    panel.limits.push(Level { name: "steel at most 90 °C".into(), value: 90.0 });
    panel.limits.push(Level { name: "seal at most 400 °C".into(), value: 400.0 });
    panel.moments.push(Moment { name: "fan on".into(), at: 600.0 });
    let mut residuals = Panel::new(Axis::time(), Axis::linear("difference", "K"));
    residuals.share = 0.35;
    residuals.curves.push(Curve::line("steel", vec![(0.0, 0.1), (1500.0, -0.2)]));
    Figure {
        title: "Gearbox".into(),
        note: "300 W for 25 min".into(),
        panels: vec![panel, residuals],
    }
}

fn texts(scene: &Scene) -> Vec<&str> {
    let text = |shape: &'_ Shape| match shape {
        Shape::Text(text) => Some(text.text.clone()),
        Shape::Path(_) => None,
    };
    let found: Vec<String> = scene.shapes.iter().filter_map(text).collect();
    found.leak().iter().map(String::as_str).collect()
}

#[test]
fn a_figure_says_names_units_limits_and_moments() {
    let scene = scene(&[heating()], 760.0);
    let texts = texts(&scene);
    for wanted in [
        "Gearbox",
        "time [min]",
        "temperature [°C]",
        "steel",
        "aluminium",
        "steel at most 90 °C",
        "seal at most 400 °C, above the range shown",
        "fan on",
        "difference [K]",
    ] {
        assert!(texts.contains(&wanted), "{wanted}: {texts:?}");
    }
    // the lower panel writes the time axis that both share
    assert_eq!(texts.iter().filter(|text| **text == "time [min]").count(), 1);
    if let Some(folder) = std::env::var_os("LPTN_PICTURES") {
        let folder = std::path::Path::new(&folder);
        std::fs::write(folder.join("heating.svg"), svg::write(&scene)).unwrap();
        std::fs::write(folder.join("heating.png"), png::write(&scene, 2.0).unwrap()).unwrap();
    }
}

/// Every text is inside the page.
#[test]
fn nothing_leaves_the_page() {
    let scene = scene(&[heating()], 500.0);
    for shape in &scene.shapes {
        if let Shape::Text(text) = shape
            && !text.upward
        {
            let wide = width(&text.text, text.size, text.bold);
            let left = match text.align {
                crate::scene::Align::Start => text.at.0,
                crate::scene::Align::Middle => text.at.0 - wide / 2.0,
                crate::scene::Align::End => text.at.0 - wide,
            };
            assert!(left >= 0.0 && left + wide <= 500.0, "{}", text.text);
            assert!(text.at.1 <= scene.size.1, "{}", text.text);
        }
    }
}

#[test]
fn a_figure_of_nothing_is_drawn() {
    let none = Panel::new(Axis::time(), Axis::log("Z", "K/W"));
    let mut gaps = none.clone();
    gaps.curves.push(Curve::line("a", vec![(0.0, f64::NAN), (1.0, -1.0)]));
    let figure = Figure { title: String::new(), note: String::new(), panels: vec![none, gaps] };
    let text = svg::write(&scene(&[figure], 400.0));
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
}

/// Two names that want the same place share it around it; both stay inside the range.
#[test]
fn names_move_apart_and_stay_inside() {
    assert_eq!(apart(&[10.0, 50.0], 12.0, (0.0, 100.0)), [10.0, 50.0]);
    assert_eq!(apart(&[50.0, 50.0], 12.0, (0.0, 100.0)), [44.0, 56.0]);
    assert_eq!(apart(&[99.0, 100.0], 12.0, (0.0, 100.0)), [88.0, 100.0]);
    assert_eq!(apart(&[0.0, 1.0, 2.0], 12.0, (0.0, 100.0)), [0.0, 12.0, 24.0]);
    assert_eq!(apart(&[80.0, 98.0, 99.0], 12.0, (0.0, 100.0)), [76.0, 88.0, 100.0]);
}

#[test]
fn texts_keep_to_their_room() {
    assert_eq!(wrapped("a line of words", 12.0, 40.0, false), ["a line", "of", "words"]);
    let short = shortened("a_very_long_name_of_a_node", 12.0, 80.0);
    assert!(short.ends_with('\u{2026}') && width(&short, 12.0, false) <= 80.0, "{short}");
}

fn steps(scene: &Scene) -> Vec<Step> {
    let paths = scene.shapes.iter().filter_map(|shape| match shape {
        Shape::Path(path) if path.tip.is_some() => Some(path.steps.clone()),
        _ => None,
    });
    paths.flatten().collect()
}

fn dotted(points: Vec<(f64, f64)>, across: Axis) -> Scene {
    let mut panel = Panel::new(across, Axis::linear("difference", "K"));
    panel.curves.push(Curve::line("ring", points).looks(Look::Dots));
    scene(&[Figure { panels: vec![panel], ..Figure::default() }], 760.0)
}

/// The one outlier among 100000 measured values is a triangle at the edge and in words, the other
/// values keep their scale, and the file stays small.
#[test]
fn no_dot_that_sticks_out_is_lost() {
    let value = |i: u32| if i == 54_321 { 7.0 } else { 0.01 * f64::from(i % 7) };
    let scene = dotted((0..100_000).map(|i| (f64::from(i), value(i))).collect(), Axis::time());
    let steps = steps(&scene);
    let dot = |step: &Step| if let Step::Circle((_, y), _) = *step { Some(y) } else { None };
    let dots: Vec<f64> = steps.iter().filter_map(dot).collect();
    assert_eq!(steps.iter().filter(|step| **step == Step::Close).count(), 1, "a triangle");
    assert!((100..1000).contains(&dots.len()), "{}", dots.len());
    let (top, bottom) =
        dots.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), y| (a.min(*y), b.max(*y)));
    assert!(bottom - top > 200.0, "they are flat: {top} to {bottom}");
    let told = "dots of ring outside of the range shown: 1 of 100000, the farthest at 7.000 K";
    assert!(texts(&scene).contains(&told), "{:?}", texts(&scene));
}

/// A scatter over another axis than time has a dot for each point, in order or not.
#[test]
fn a_scatter_shows_every_point() {
    let points = (0..2000).map(|i| (f64::from(i), f64::from(i * 37 % 101))).collect();
    let scene = dotted(points, Axis::linear("R", "K/W"));
    let dots = steps(&scene).iter().filter(|step| matches!(step, Step::Circle(..))).count();
    assert_eq!(dots, 2000);
}

/// Space at -270.3 degC is far from a body at 20 to 30 degC; air at 15 degC is near.
#[test]
fn a_constant_far_away_is_named_instead_of_drawn() {
    let mut panel = Panel::new(Axis::time(), Axis::linear("temperature", "degC"));
    panel.curves.push(Curve::line("body", vec![(0.0, 20.0), (60.0, 30.0)]));
    for (name, value) in [("space", -270.3), ("air", 15.0)] {
        let line = Curve::line(name, vec![(0.0, value), (60.0, value)]);
        panel.curves.push(Curve { aside: true, ..line });
    }
    let scene = scene(&[Figure { panels: vec![panel], ..Figure::default() }], 760.0);
    let texts = texts(&scene);
    assert!(texts.contains(&"space at \u{2212}270.3 °C, below the range shown"), "{texts:?}");
    assert!(texts.contains(&"air") && !texts.contains(&"space"), "{texts:?}");
    assert!(texts.contains(&"20") && !texts.contains(&"\u{2212}100"), "{texts:?}");
}

#[test]
fn a_figure_is_drawn_with_characters() {
    let mut figure = heating();
    figure.note = "what a reader has to know beside it ".repeat(5);
    let text = crate::terminal::write(&figure, 80, false);
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
}

/// Names of limits of one value would cover each other.
#[test]
fn limits_of_one_value_share_a_line_of_text() {
    let limits = |count: usize| {
        let mut panel = Panel::new(Axis::time(), Axis::linear("T", "degC"));
        panel.curves.push(Curve::line("a", vec![(0.0, 20.0), (60.0, 80.0)]));
        let level = |i| Level { name: format!("limit {i}"), value: 60.0 };
        panel.limits.extend((0..count).map(level));
        svg::write(&scene(&[Figure { panels: vec![panel], ..Figure::default() }], 500.0))
    };
    assert!(limits(2).contains(">limit 0; limit 1</text>"));
    assert!(limits(60).contains(">limit 0; 59 more</text>"));
    assert_eq!(limits(60).matches(">limit").count(), 60 + 1, "60 tips and one text");
}
