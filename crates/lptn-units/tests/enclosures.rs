//! Bounds on expressions hold everywhere, and their Taylor coefficients are those of the published
//! series.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::sync::Arc;

use lptn_units::{
    Dimension, Dual, Expression, Interpolation, LookupTable, Outside, Program, Scope, Symbol,
    Table1, Table2, TableSymbol, Taylor, Type,
};

/// `x` in slot 0, `a` in slot 1, and three tables.
struct Names;

impl Scope for Names {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = ["x", "a"].iter().position(|known| *known == name)?;
        Some(Symbol { slot: u32::try_from(slot).unwrap(), ty: Type::SCALAR, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        vec!["x".into(), "a".into()]
    }

    fn table(&self, name: &str) -> Option<TableSymbol> {
        let (x, y) = (vec![-4.0, -1.0, 0.5, 2.0, 5.0], vec![3.0, 1.0, 1.0, -2.0, 7.0]);
        let table = match name {
            "lines" => {
                LookupTable::One(Table1::new(x, y, Interpolation::Linear, Outside::Hold).unwrap())
            }
            "smooth" => {
                LookupTable::One(Table1::new(x, y, Interpolation::Pchip, Outside::Error).unwrap())
            }
            "map" => {
                let values = vec![0.0, 4.0, -1.0, 10.0, 16.0, 3.0];
                LookupTable::Two(
                    Table2::new(vec![0.0, 1.0], vec![-1.0, 0.0, 2.0], values, Outside::Hold)
                        .unwrap(),
                )
            }
            _ => return None,
        };
        let arguments = vec![Type::of(Dimension::NONE); table.dimension()];
        Some(TableSymbol { table: Arc::new(table), arguments, ty: Type::SCALAR, units: Vec::new() })
    }
}

fn program(text: &str) -> Program {
    Expression::parse(text).unwrap().compile(&Names, None).unwrap()
}

const A: f64 = 0.7;

fn over(text: &str, from: f64, to: f64) -> Taylor {
    program(text).enclose(0, [from, to], &[f64::NAN, A])
}

/// Value and slope at a number.
fn at(program: &Program, x: f64) -> Option<Dual<1>> {
    let slots = [Dual::variable(x, 0), Dual::constant(A)];
    program.eval(&slots, &mut Vec::new()).ok()
}

const EXPRESSIONS: [&str; 24] = [
    "x",
    "3 - 2 * x + x^2 - 0.1 * x^3",
    "a * x^4 - x^5",
    "1 / (x - 6)",
    "x / (1 + x^2)",
    "(x - 1) / (x^2 + a)",
    "exp(-0.5 * ((x - 1.3) / 0.2)^2)",
    "ln(x + 5)",
    "sqrt(x^2 + 1)",
    "sqrt(x + 4)",
    "(x + 4.5)^1.7 + (x + 4.5)^-0.3",
    "(x^2 + 1)^a",
    "a^x",
    "sin(3 * x) * cos(x - 2)",
    "tanh(5 * (x - 0.2))",
    "abs(x - 0.5) + abs(sin(x))",
    "min(x, 1, 2 - x) + max(x, a)",
    "if(x < 0.9, x^2, 3 - x)",
    "if(x >= 0.9, if(x == 2, 5, x), -x)",
    "lines(x) + lines(2 * x - 1)",
    "smooth(0.9 * x)",
    "map(x / 4, x - 1) + map(a, x)",
    "x^-2 + 1 / x",
    "mean(x, 2 * x, a)^6",
];

#[test]
fn every_value_and_slope_lies_within_the_bounds() {
    for text in EXPRESSIONS {
        let program = program(text);
        for (from, width) in [-4.0, -1.1, -0.3, 0.4, 0.89, 1.9, 3.5]
            .iter()
            .flat_map(|f| [(*f, 0.01), (*f, 0.3), (*f, 1.2)])
        {
            let bounds = program.enclose(0, [from, from + width], &[f64::NAN, A]);
            for i in 0..=50 {
                let x = from + width * f64::from(i) / 50.0;
                let found = at(&program, x);
                let Some([low, high]) = bounds.range() else { continue };
                let found =
                    found.unwrap_or_else(|| panic!("{text} has no value at {x}, but bounds"));
                let slack = 1e-12 * (1.0 + found.value.abs());
                assert!(
                    low - slack <= found.value && found.value <= high + slack,
                    "{text} at {x}: {low} {found:?} {high}"
                );
                if i == 0 || i == 50 {
                    continue; // a kink at an end has its slope from outside
                }
                let steepest = bounds.largest(1) * (1.0 + 1e-9) + 1e-12;
                assert!(
                    found.derivatives[0].abs() <= steepest,
                    "{text} at {x}: {found:?}, {steepest}"
                );
            }
        }
    }
}

/// Halving an interval often enough bounds every smooth function as narrowly as is asked.
#[test]
fn bounds_close_in_on_the_function() {
    for text in EXPRESSIONS {
        let program = program(text);
        let x = 1.234_567;
        let bounds = program.enclose(0, [x, x + 1e-9], &[f64::NAN, A]);
        let [low, high] = bounds.range().unwrap_or_else(|| panic!("{text}"));
        assert!(high - low < 1e-6, "{text}: {low} {high}");
        for order in 0..=Taylor::ORDER {
            assert!(bounds.largest(order).is_finite(), "{text}: order {order}");
        }
    }
}

/// The Maclaurin series, as in Abramowitz and Stegun 3.6.8, 4.1.24, 4.2.1, 4.3.65, 4.3.66 and
/// 4.5.64.
#[test]
fn coefficients_are_those_of_the_series() {
    let factorial = |k: usize| (1..=k).map(|i| i as f64).product::<f64>();
    let odd = |k: usize| k % 2 == 1;
    let binomial =
        |k: usize| (0..k).map(|i| (0.5 - i as f64) / (i as f64 + 1.0)).product::<f64>().abs();
    let tanh = [0.0, 1.0, 0.0, 1.0 / 3.0, 0.0, 2.0 / 15.0, 0.0, 17.0 / 315.0, 0.0, 62.0 / 2835.0];
    for (k, of_tanh) in tanh.into_iter().enumerate() {
        let cases = [
            ("exp(x)", 1.0 / factorial(k)),
            ("ln(1 + x)", if k == 0 { 0.0 } else { 1.0 / k as f64 }),
            ("sin(x)", if odd(k) { 1.0 / factorial(k) } else { 0.0 }),
            ("cos(x)", if odd(k) { 0.0 } else { 1.0 / factorial(k) }),
            ("1 / (1 + x)", 1.0),
            ("sqrt(1 + x)", binomial(k)),
            ("tanh(x)", of_tanh),
            ("(2 + x)^3", [8.0, 12.0, 6.0, 1.0].get(k).copied().unwrap_or(0.0)),
        ];
        for (text, right) in cases {
            let found = over(text, 0.0, 0.0).largest(k);
            assert!((found - right).abs() < 1e-14, "{text}, order {k}: {found}, not {right}");
        }
    }
}

/// The same with their signs: less the series itself nothing is left of any order.
#[test]
fn coefficients_have_the_signs_of_the_series() {
    let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
    let factorial = |k: usize| (1..=k).map(|i| i as f64).product::<f64>();
    let binomial = |power: f64, k: usize| {
        (0..k).map(|i| (power - i as f64) / (i as f64 + 1.0)).product::<f64>()
    };
    let tanh = [0.0, 1.0, 0.0, -1.0 / 3.0, 0.0, 2.0 / 15.0, 0.0, -17.0 / 315.0, 0.0, 62.0 / 2835.0];
    let of = |coefficient: &dyn Fn(usize) -> f64| {
        (0..=Taylor::ORDER).map(coefficient).collect::<Vec<f64>>()
    };
    let cases = [
        ("exp(-x)", of(&|k| sign(k) / factorial(k))),
        ("ln(1 + x)", of(&|k| if k == 0 { 0.0 } else { -sign(k) / k as f64 })),
        ("1 / (1 + x)", of(&sign)),
        ("(1 + x)^-2", of(&|k| sign(k) * (k as f64 + 1.0))),
        ("sqrt(1 + x)", of(&|k| binomial(0.5, k))),
        ("(1 + x)^-0.3", of(&|k| binomial(-0.3, k))),
        ("(1 - x)^1.7", of(&|k| sign(k) * binomial(1.7, k))),
        ("sin(x)", of(&|k| if k % 2 == 1 { sign(k / 2) / factorial(k) } else { 0.0 })),
        ("cos(x)", of(&|k| if k % 2 == 0 { sign(k / 2) / factorial(k) } else { 0.0 })),
        ("tanh(x)", of(&|k| tanh[k])),
    ];
    for (text, series) in &cases {
        let terms: Vec<String> =
            series.iter().enumerate().map(|(k, c)| format!("({c:?}) * x^{k}")).collect();
        let less = over(&format!("{text} - ({})", terms.join(" + ")), 0.0, 0.0);
        for k in 0..=Taylor::ORDER {
            assert!(less.largest(k) < 1e-14, "{text}, order {k}: {}", less.largest(k));
        }
    }
}

/// Of 64 forks each follows two branches: beyond them nothing is known.
#[test]
fn so_many_branches_are_followed_and_no_more() {
    let sum = |count: usize| vec!["if(x < 0.9, x^2, 3 - x)"; count].join(" + ");
    let [low, high] = over(&sum(5), 0.0, 2.0).range().unwrap();
    assert!(low <= 5.0 && high >= 5.0 * 2.1, "{low} {high}");
    assert_eq!(over(&sum(12), 0.0, 2.0).range(), None);
    // where it is known which is taken none is followed twice
    assert_eq!(over(&sum(12), 1.0, 2.0).range(), Some([12.0, 24.0]));
}

/// Beyond its ends a table that is held is a number, up to the knot itself.
#[test]
fn a_held_table_stands_still() {
    for (from, to, value) in
        [(-6.0, -5.0, 3.0), (-6.0, -4.0, 3.0), (5.0, 6.0, 7.0), (5.5, 6.0, 7.0)]
    {
        let found = over("lines(x)", from, to);
        assert_eq!((found.range(), found.largest(1)), (Some([value, value]), 0.0), "{from} {to}");
    }
    assert!((over("lines(x)", 4.0, 5.0).largest(1) - 3.0).abs() < 1e-14);
    assert!((over("lines(x)", -4.0, -1.0).largest(1) - 2.0 / 3.0).abs() < 1e-14);
    assert!(over("lines(x)", -5.0, -3.0).largest(1).is_infinite());
    // a power whose base comes down to 0 has bounds, and no slope
    let [low, high] = over("x^1.5", 0.0, 4.0).range().unwrap();
    assert!(low.abs() < 1e-15 && (high - 8.0).abs() < 1e-14);
    assert!(
        over("x^1.5", 0.0, 4.0).largest(1).is_infinite()
            && over("x^-1.5", 0.0, 4.0).range().is_none()
    );
}

#[test]
fn what_may_have_no_value_has_no_bounds() {
    for text in ["1 / x", "ln(x)", "sqrt(x)", "x^0.5", "x^-1", "smooth(5 * x)", "0 * sqrt(x)"] {
        assert_eq!(over(text, -1.0, 1.5).range(), None, "{text}");
    }
}

#[test]
fn the_degree_is_that_of_the_polynomial() {
    for (text, degree) in [
        ("a", 0),
        ("2 * x + a", 1),
        ("x^2 * x", 3),
        ("lines(x)", 1),
        ("smooth(x)", 3),
        ("exp(x)", 9),
    ] {
        assert_eq!(over(text, 0.6, 1.0).degree(), degree, "{text}");
    }
}

/// A kink inside the interval is not part of a polynomial; neither is the end of a table whose last
/// value is held.
#[test]
fn a_kink_bounds_no_slope() {
    for text in [
        "abs(x)",
        "max(x, 0)",
        "lines(x + 0.5)",
        "smooth(x + 0.5)",
        "map(x, 0.5)",
        "map(x + 1, 0.5)",
        "map(0.5, x)",
        "map(a, x - 1)",
        "lines(x - 4)",
        "if(x < 0, x, 2 * x)",
    ] {
        assert!(over(text, -0.1, 0.1).largest(2).is_infinite(), "{text}");
        assert!(over(text, 0.0, 0.1).largest(2) < 1e3 || text.starts_with("if"), "{text}");
    }
}

/// Where an expression turns on the way of `x` between two numbers.
fn turns(text: &str, from: f64, to: f64) -> Vec<f64> {
    let way = |slot: u32| if slot == 0 { [from, to] } else { [A; 2] };
    let turns = program(text).turns(&way, 1e-7);
    turns.iter().map(|[a, b]| from + a.midpoint(*b) * (to - from)).collect()
}

#[test]
fn a_peak_or_dip_is_found_however_narrow_it_is() {
    for width in [30.0, 1.0, 0.01] {
        for text in [
            format!("100 + exp(-((x - 47.3) / {width})^2)"),
            format!("1 / (1 + ((x - 47.3) / {width})^2)"),
            format!("a * (tanh((x - 47.3) / {width} + 1) - tanh((x - 47.3) / {width} - 1))"),
            format!("x - x + max(0, 1 - abs(x - 47.3) / {width})"),
        ] {
            let found = turns(&text, -100.0, 500.0);
            assert_eq!(found.len(), 1, "{text}: {found:?}");
            assert!((found[0] - 47.3).abs() < 0.5 * width, "{text}: {found:?}");
        }
    }
}

#[test]
fn turns_of_tables_are_at_their_knots_and_flat_parts_are_none() {
    let found = turns("lines(x)", -5.0, 6.0);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!((found[0] - 2.0).abs() < 0.3, "{found:?}");
    let back = turns("lines(1 - x)", 7.0, -4.0);
    assert!(back.len() == 1 && (back[0] + 1.0).abs() < 0.3, "{back:?}");
    assert!(turns("smooth(x)", -30.0, 30.0).len() <= 1, "nothing is told outside");
}

#[test]
fn what_goes_one_way_has_no_turn() {
    for text in ["exp(x / 7)", "tanh(x * 1000)", "x + abs(x)", "3 * x - 7", "a", "max(x, a)^3"] {
        assert_eq!(turns(text, -20.0, 33.0), Vec::<f64>::new(), "{text}");
    }
    assert_eq!(turns("sin(x)", 0.0, 20.0).len(), 6);
}
