//! Bodies conduct with the mean of their conductivity over the temperatures of the path.

use std::f64::consts::PI;

use lptn_network::{ConductorKind, Formula, Input, InputProblem, Item, NetworkBuilder, Path};

use super::common::{own, quantity};
use super::{T, path, received};

/// A conductivity over x = T/K: its text, itself, its primitive.
type Kirchhoff = (&'static str, fn(f64) -> f64, fn(f64) -> f64);

const KIRCHHOFF: [Kirchhoff; 6] = [
    ("2 * x / 100", |t| t / 50.0, |t| t * t / 100.0),
    ("0.1 * (x / 100)^3", |t| 0.1e-6 * t.powi(3), |t| 0.1e-6 * t.powi(4) / 4.0),
    ("exp(x / 50)", |t| (t / 50.0).exp(), |t| 50.0 * (t / 50.0).exp()),
    ("40 / x", |t| 40.0 / t, |t| 40.0 * t.ln()),
    (
        "1 + abs(x - 313.3) / 10",
        |t| 1.0 + (t - 313.3).abs() / 10.0,
        |t| t + (t - 313.3) * (t - 313.3).abs() / 20.0,
    ),
    ("max(0, x - 321.7)", |t| (t - 321.7).max(0.0), |t| 0.5 * (t - 321.7).max(0.0).powi(2)),
];

fn over_kelvin(b: &NetworkBuilder, text: &str) -> Input {
    let text = text.replace("exp", "EXP").replace("max", "MAX").replace('x', "(kelvin(T) / 1 [K])");
    let text = text.replace("EXP", "exp").replace("MAX", "max");
    own(b, &format!("1 [W/(m K)] * ({text})"))
}

/// Kirchhoff: in every shape the heat is that of the mean of k over the temperatures.
#[test]
fn bodies_conduct_with_the_mean_of_their_conductivity() {
    let shapes: [(Formula, &[&str], f64); 4] = [
        (Formula::Slab, &["0.2 m^2", "30 mm"], 0.2 / 0.03),
        (Formula::Rod, &["10 mm", "0.2 m"], PI * 1e-4 / 4.0 / 0.2),
        (Formula::Cylinder, &["10 mm", "30 mm", "0.4 m"], 2.0 * PI * 0.4 / 3.0_f64.ln()),
        (Formula::Sphere, &["10 mm", "30 mm"], 4.0 * PI / (1.0 / 0.01 - 1.0 / 0.03)),
    ];
    for (text, k, primitive) in KIRCHHOFF {
        for (formula, measures, shape) in shapes {
            let (network, id) = path(ConductorKind::Conduction, |b| {
                let k = over_kelvin(b, text);
                let measures = measures.iter().copied().map(quantity);
                Path::new(formula, std::iter::once(k).chain(measures).collect::<Vec<_>>())
            });
            for ends in
                [[350.0, 310.0], [310.0, 350.0], [900.0, 40.0], [320.0, 384.0], [64.0, 65.0]]
            {
                let [x, y] = ends;
                let heat = shape * (primitive(x) - primitive(y));
                let [from, to] = received(&network, id, [x, y, 300.0, 290.0]);
                let off = (to - heat).abs() / heat.abs().max(1e-9);
                assert!(
                    off < 2e-12 && (from + to).abs() < f64::MIN_POSITIVE,
                    "{text} {formula:?} {ends:?}: {to} {heat}"
                );
                let (mut slopes, scope) = (Vec::new(), &mut network.evaluation());
                network.exchange_slopes(id, scope, &[x, y, 300.0, 290.0], &mut slopes).unwrap();
                for (slope, exact) in slopes.iter().zip([shape * k(x), -shape * k(y)]) {
                    // a part of it cancels against the mean
                    let allowed = 1e-11 * exact.abs() + 1e-15 * (heat / (x - y)).abs();
                    let off = (slope[1] - exact).abs();
                    assert!(
                        off <= allowed && (slope[0] + slope[1]).abs() < f64::MIN_POSITIVE,
                        "{text} {ends:?}: {slopes:?}"
                    );
                }
            }
        }
    }
}

/// However near the ends are: the mean is k itself, and its slopes are half of that of k.
#[test]
fn a_body_of_one_temperature_has_its_conductivity() {
    let (network, id) = path(ConductorKind::Conduction, |b| {
        let k = over_kelvin(b, "exp(x / 50)");
        Path::new(Formula::Slab, [k, quantity("1 m^2"), quantity("1 m")])
    });
    for x in [20.0_f64, 64.0, 320.0, 333.3] {
        let k = (x / 50.0).exp();
        for apart in [0.0, 1e-9, 1e-6, 1e-3] {
            let temperatures = [x + apart, x, 300.0, 290.0];
            let [_, to] = received(&network, id, temperatures);
            assert!(
                (to - k * (x + apart - x)).abs() <= 1.1e-2 * k * apart * (apart + 1e-9),
                "{x} {apart}"
            );
            let mut slopes = Vec::new();
            let scope = &mut network.evaluation();
            network.exchange_slopes(id, scope, &temperatures, &mut slopes).unwrap();
            let above = ((x + apart) / 50.0).exp();
            assert!((slopes[0][1] / above - 1.0).abs() < 1e-11, "{x} {apart}: {slopes:?}");
            assert!((slopes[1][1] / -k - 1.0).abs() < 1e-11, "{x} {apart}: {slopes:?}");
        }
    }
}

/// Both ends count, and what lies between them: a path through a place without k has no heat.
#[test]
fn a_conductivity_has_to_be_known_all_along_the_path() {
    let of = |text: &'static str| {
        path(ConductorKind::Conduction, move |b| {
            let k = over_kelvin(b, text);
            Path::new(Formula::Slab, [k, quantity("1 m^2"), quantity("1 m")])
        })
    };
    let refused = |text: &'static str, ends: [f64; 2]| {
        let (network, id) = of(text);
        let temperatures = [ends[0], ends[1], 300.0, 290.0];
        let error = network.exchange(id, &mut network.evaluation(), &temperatures).unwrap_err();
        assert_eq!((error.item, error.field.key()), (Item::Conductor(id), "k"));
        error.problem
    };
    // known on both sides, not between
    let hole = refused("sqrt((x - 330) * (x - 340))", [350.0, 310.0]);
    assert!(matches!(hole, InputProblem::Evaluation(_)), "{hole:?}");
    let end = refused("sqrt(x - 320)", [350.0, 310.0]);
    assert!(matches!(end, InputProblem::Evaluation(_)), "{end:?}");
    let below = refused("x - 320", [350.0, 310.0]);
    assert!(matches!(below, InputProblem::Negative(_)), "{below:?}");
    let wild = refused("1.5 + sin(1e9 * x)", [350.0, 310.0]);
    assert!(matches!(wild, InputProblem::NoMean { .. }), "{wild:?}");
    let (network, id) = of("sqrt(x - 320)");
    let heat = 2.0 / 3.0 * (30.0_f64.powf(1.5) - 5.0_f64.powf(1.5));
    let [_, found] = received(&network, id, [350.0, 325.0, 300.0, 290.0]);
    assert!((found / heat - 1.0).abs() < 1e-11, "{found} {heat}");
}

/// A conductivity that changes with time is integrated as it stands: here 2 (1 + t/10 s) T/100 K.
#[test]
fn a_conductivity_may_change_with_time_too() {
    let (network, id) = path(ConductorKind::Conduction, |b| {
        let k = own(b, "2 [W/(m K)] * (1 + t / 10 [s]) * kelvin(T)^3 / 1e6 [K^3]");
        Path::new(Formula::Slab, [k, quantity("1 m^2"), quantity("1 m")])
    });
    let mut scope = network.evaluation();
    for (time, factor) in [(0.0, 1.0), (10.0, 2.0)] {
        scope.set_time(time, time);
        let [_, found] = network.exchange(id, &mut scope, &T).unwrap();
        let heat = factor * 2e-6 * (350.0_f64.powi(4) - 310.0_f64.powi(4)) / 4.0;
        assert!((found / heat - 1.0).abs() < 1e-12, "{found} {heat}");
    }
}
