use lptn_units::{Expression, Program, Scope, Symbol, Taylor, Type};

use super::*;

/// A capacity written as an expression of the temperature `x`.
struct Written(Program);

impl Capacity for Written {
    fn at(&mut self, temperature: f64) -> Option<f64> {
        self.0.eval(&[temperature], &mut Vec::new()).ok()
    }

    fn over(&mut self, from: f64, to: f64) -> Taylor {
        self.0.enclose(0, [from, to], &[0.0])
    }
}

struct OnlyX;

impl Scope for OnlyX {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        (name == "x").then_some(Symbol { slot: 0, ty: Type::SCALAR, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        vec!["x".into()]
    }
}

fn written(text: &str) -> Written {
    Written(Expression::parse(text).unwrap().compile(&OnlyX, None).unwrap())
}

/// The curve around 300 K of a capacity without bends.
fn curve_of(text: &str, latent: &[Latent]) -> Enthalpy {
    Enthalpy::new(&mut written(text), 300.0, &[], latent).unwrap()
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-11 * b.abs().max(1.0), "{a} {b}");
}

#[test]
fn heat_content_of_a_linear_capacity_is_its_integral() {
    // C = 100 + 0.5 (T - 300): H(T) = 100 (T - 300) + 0.25 (T - 300)^2
    let curve = curve_of("100 + 0.5 * (x - 300)", &[]);
    for t in [150.0_f64, 299.0, 300.0, 301.5, 777.7, 3000.0] {
        let heat = 100.0 * (t - 300.0) + 0.25 * (t - 300.0).powi(2);
        close(curve.heat(t).unwrap(), heat);
        let content = curve.temperature(heat).unwrap();
        close(content.temperature, t);
        close(content.capacity, 100.0 + 0.5 * (t - 300.0));
    }
    assert!((curve.range().0 - 100.0).abs() < 1e-5, "the capacity is positive from 100 K on");
    assert_eq!(curve.heat(50.0), None);
}

/// Ends of panels, isothermal ones and values outside included.
#[test]
fn a_remembered_panel_changes_no_digit() {
    let at = |solidus: f64, liquidus: f64| Latent { solidus, liquidus, heat: 5000.0 };
    let curve = curve_of("100 + 0.5 * (x - 300)", &[at(310.0, 312.0), at(330.0, 330.0)]);
    let ends = curve.panels.iter().flat_map(|p| [p.heat, p.heat + p.rise]);
    let mut heats: Vec<f64> = ends.flat_map(|h| [h, h.next_up(), h.next_down()]).collect();
    heats.extend((-40..80).map(|i| 400.0 * f64::from(i)));
    heats.extend([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
    let bits = |c: Content| (c.temperature.to_bits(), c.capacity.to_bits());
    for panel in (0..=curve.panels.len()).chain([usize::MAX]) {
        for &heat in &heats {
            let (mut near, known) = (panel, curve.temperature(heat).map(bits));
            assert_eq!(curve.temperature_near(heat, &mut near).map(bits), known, "{heat}");
            assert_eq!(curve.temperature_near(heat, &mut near).map(bits), known, "{heat}");
        }
    }
}

#[test]
fn a_curved_capacity_is_met_to_rounding() {
    // C = 50 exp(T / 200): H = 10000 (exp(T / 200) - exp(1.5))
    let curve = curve_of("50 * exp(x / 200)", &[]);
    for t in [200.0_f64, 333.3, 450.0, 600.0] {
        close(curve.heat(t).unwrap(), 1e4 * ((t / 200.0).exp() - 1.5_f64.exp()));
    }
}

#[test]
fn a_capacity_with_a_hole_ends_before_it() {
    // it was covered on both sides once, and a node jumped over the hole
    let curve = curve_of("100 + 0 * sqrt((x - 330) * (x - 340))", &[]);
    assert!((curve.range().1 - 330.0).abs() < 1e-5, "{:?}", curve.range());
    assert_eq!(curve.temperature(100.0 * 41.0), None);
}

#[test]
fn a_capacity_with_rounding_in_it_is_covered_at_once() {
    // a difference of large numbers: its last digits are noise
    let curve = curve_of("1e7 + 100 + 1e-3 * sin(7 * x) - 1e7", &[]);
    assert!(curve.panels.len() < 100_000, "{}", curve.panels.len());
    assert!((curve.heat(400.0).unwrap() - 1e4).abs() < 0.1);
}

#[test]
fn curves_share_panels_whatever_their_size_and_start() {
    let curve = curve_of("100 + 0.5 * (x - 300)", &[]);
    let other = curve.rescaled(3.0, 350.0).unwrap();
    close(other.heat(350.0).unwrap(), 0.0);
    close(other.heat(400.0).unwrap(), 3.0 * (50.0 * 100.0 + 0.25 * (1e4 - 2500.0)));
    close(other.temperature(other.heat(420.0).unwrap()).unwrap().temperature, 420.0);
    assert!(Arc::ptr_eq(&curve.panels, &other.panels));
}

#[test]
fn a_kink_is_found() {
    let curve = curve_of("10 + abs(x - 350)", &[]);
    // from 300 to 400: 1000 + 2 * 50^2 / 2
    assert!((curve.heat(400.0).unwrap() - 3500.0).abs() < 1e-6);
}

#[test]
fn latent_heat_at_one_temperature_holds_it() {
    let latent = Latent::new((330.0, 330.0), 5000.0);
    let curve = curve_of("100", &[latent]);
    close(curve.temperature(3000.0 + 2500.0).unwrap().temperature, 330.0);
    assert!(curve.temperature(5500.0).unwrap().capacity.is_infinite());
    close(curve.temperature(3000.0 + 5000.0 + 700.0).unwrap().temperature, 337.0);
    close(curve.heat(340.0).unwrap(), 9000.0);
}

#[test]
fn a_curve_may_begin_amid_melting() {
    let latent = Latent::new((330.0, 330.0), 5000.0);
    let curve = curve_of("100", &[latent]);
    assert_eq!(curve.melted(2000.0), None);
    close(curve.melted(3000.0 + 1500.0).unwrap(), 0.3);
    let amid = curve.rescaled(2.0, 310.0).unwrap().partly_molten(330.0, 0.3).unwrap();
    close(amid.melted(0.0).unwrap(), 0.3);
    // 0.7 of 10 kJ are left to melt, then 200 J/K
    close(amid.temperature(7000.0 + 400.0).unwrap().temperature, 332.0);
    close(amid.temperature(-3000.0 - 400.0).unwrap().temperature, 328.0);
    assert!(curve.partly_molten(331.0, 0.3).is_none(), "it melts at 330 K alone");
}

#[test]
fn latent_heat_over_an_interval_adds_to_the_capacity() {
    let latent = Latent::new((320.0, 330.0), 5000.0);
    let curve = curve_of("100", &[latent]);
    close(curve.capacity(325.0).unwrap(), 600.0);
    close(curve.heat(330.0).unwrap(), 8000.0);
    close(curve.temperature(2000.0 + 3000.0).unwrap().temperature, 325.0);
}

#[test]
fn a_peak_is_never_lost_however_narrow_it_is_and_wherever() {
    // a Gaussian of area 200 on a capacity of 2: from 40 K below to 40 K above it takes up 2 * 80 +
    // 200
    for width in [2.0, 0.5, 0.2, 0.05, 0.01, 1e-3, 1e-5] {
        for peak in [307.5, 320.4637, 323.15, 333.3333, 346.0001, 364.0, 372.999] {
            let height = 200.0 / (width * (2.0 * std::f64::consts::PI).sqrt());
            let curve =
                curve_of(&format!("2 + {height} * exp(-0.5 * ((x - {peak}) / {width})^2)"), &[]);
            close(curve.heat(peak + 40.0).unwrap() - curve.heat(peak - 40.0).unwrap(), 360.0);
            let middle = curve.heat(peak - 40.0).unwrap() + 180.0;
            assert!((curve.temperature(middle).unwrap().temperature - peak).abs() < 1e-9);
        }
    }
}

#[test]
fn other_narrow_changes_are_met_too() {
    // each adds 50 above the heat that 100 J/K take up from 300 K to 400 K
    let heat = |text: &str| curve_of(text, &[]).heat(400.0).unwrap();
    let pi = std::f64::consts::PI;
    close(heat("100 + 0.5 * (1 + tanh((x - 350.0137) / 1e-3))"), 1e4 + 49.9863);
    close(heat("100 + 5e4 * max(0, 1 - abs(x - 331.3) / 1e-3)"), 1e4 + 50.0);
    let lorentz = 50.0 / pi * ((400.0_f64 - 341.7) / 1e-6).atan()
        + 50.0 / pi * ((341.7_f64 - 300.0) / 1e-6).atan();
    close(
        heat(&format!("100 + {} / (1 + ((x - 341.7) / 1e-6)^2)", 50.0 / pi / 1e-6)),
        1e4 + lorentz,
    );
    close(heat("100 + if(x < 350.123456789, 0, 1)"), 1e4 + 49.876543211);
}

#[test]
fn a_capacity_that_cannot_be_followed_is_refused() {
    let refused = |text: &str| Enthalpy::new(&mut written(text), 300.0, &[], &[]).err();
    assert_eq!(refused("100 + sin(1e9 * x)"), Some(NoCurve::TooQuick));
    assert_eq!(refused("x - 300"), Some(NoCurve::Unknown));
}

#[test]
fn a_dip_below_zero_ends_the_curve_however_narrow_it_is() {
    let curve = curve_of("100 - 150 * exp(-0.5 * ((x - 331.3) / 1e-3)^2)", &[]);
    assert!((curve.range().1 - 331.3).abs() < 1e-2, "{:?}", curve.range());
}

#[test]
fn melting_keeps_its_heat_whatever_its_width() {
    // from 0 over the rounding of a change of units to some kelvin
    let widths = [
        0.0, 5.7e-14, 1.2e-13, 1e-12, 1e-11, 1e-10, 3e-10, 1e-9, 3.3e-8, 1e-7, 1e-6, 1e-3, 0.7,
        20.0,
    ];
    for solidus in [304.85, 310.0, 333.3333, 363.999, 364.0] {
        for width in widths.into_iter().flat_map(|w| [w, -w]).filter(|w| *w > -1e-10) {
            let latent = Latent::new((solidus, solidus + width), 2e4);
            let curve = curve_of("200", &[latent]);
            let heat = |t: f64| curve.heat(t).unwrap();
            close(heat(390.0) - heat(303.0), 200.0 * 87.0 + 2e4);
            let half = curve.temperature(200.0 * (solidus - 300.0) + 1e4).unwrap().temperature;
            assert!(
                (half - solidus).abs() <= 0.5 * width.abs() + 1e-9,
                "{solidus} {width}: {half}"
            );
        }
    }
}

#[test]
fn a_temperature_is_found_to_its_last_digits_in_few_steps() {
    let curve = curve_of("100 + 20 * tanh((x - 340) / 3) + 0.1 * x + 1e4 * exp(-(x - 340)^2)", &[]);
    for i in 0..2000 {
        let t = 250.0 + 0.1 * f64::from(i) + 1e-3;
        let found = curve.temperature(curve.heat(t).unwrap()).unwrap().temperature;
        assert!((found - t).abs() < 1e-12 * t, "{found} {t}");
    }
}

/// A run stops at the bends of a curve: given ones and melting, never the ends of the range.
#[test]
fn stops_are_the_bends_strictly_between_two_temperatures() {
    let latent = Latent::new((330.0, 330.0), 5000.0);
    let mut capacity = written("100 + abs(x - 320)");
    let curve = Enthalpy::new(&mut capacity, 300.0, &[320.0, 350.0], &[latent]).unwrap();
    let stops = curve.stops(310.0, 360.0);
    assert!(stops.windows(2).all(|pair| pair[0] < pair[1]), "{stops:?}");
    assert!(stops.iter().all(|t| *t > 310.0 && *t < 360.0), "{stops:?}");
    for bend in [320.0, 330.0, 350.0] {
        assert!(stops.contains(&bend), "{bend}: {stops:?}");
    }
    let inner = curve.stops(320.0, 350.0);
    assert!(
        inner.contains(&330.0) && !inner.contains(&320.0) && !inner.contains(&350.0),
        "{inner:?}"
    );
}
