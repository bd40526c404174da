//! Which way an expression goes with a variable: what is claimed holds wherever one looks, and what
//! can be told is.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use std::sync::Arc;

use lptn_units::{
    Expression, Interpolation, LookupTable, Outside, Program, Scope, Symbol, Table1, Table2,
    TableSymbol, Trend, Type,
};

/// `x` in slot 0 is the variable, `u` in slot 1 is held and not known, `n` in slot 2 is 3, `z` in
/// slot 3 is 0.
struct Names;

const KNOWN: [&str; 4] = ["x", "u", "n", "z"];

impl Scope for Names {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = KNOWN.iter().position(|known| *known == name)?;
        Some(Symbol { slot: u32::try_from(slot).unwrap(), ty: Type::SCALAR, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        KNOWN.map(str::to_owned).to_vec()
    }

    fn table(&self, name: &str) -> Option<TableSymbol> {
        let y = match name {
            "up" => vec![1.0, 2.0, 2.0, 5.0],
            "down" => vec![4.0, 4.0, 0.5, -1.0],
            "flat" => vec![2.0; 4],
            "hill" => vec![0.0, 3.0, 1.0, 0.0],
            "map" => vec![0.0, 1.0, 2.0, 3.0],
            _ => return None,
        };
        let table = if name == "map" {
            LookupTable::Two(Table2::new(vec![0.0, 1.0], vec![0.0, 1.0], y, Outside::Hold).unwrap())
        } else {
            let knots = vec![0.0, 1.0, 2.0, 3.0];
            LookupTable::One(Table1::new(knots, y, Interpolation::Linear, Outside::Hold).unwrap())
        };
        let arguments = vec![Type::SCALAR; table.dimension()];
        Some(TableSymbol { table: Arc::new(table), arguments, ty: Type::SCALAR, units: Vec::new() })
    }
}

fn program(text: &str) -> Program {
    Expression::parse(text)
        .unwrap()
        .compile(&Names, None)
        .unwrap_or_else(|errors| panic!("{text}: {errors:?}"))
}

fn trend(text: &str, x: Trend) -> Trend {
    program(text).trend(&|slot| match slot {
        0 => x,
        1 => Trend::HELD,
        2 => Trend::constant(3.0),
        _ => Trend::constant(0.0),
    })
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Way {
    Up,
    Down,
    Held,
    Open,
}
use Way::{Down, Held, Open, Up};

const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

fn from(low: f64) -> [f64; 2] {
    [low, f64::INFINITY]
}

fn to(high: f64) -> [f64; 2] {
    [f64::NEG_INFINITY, high]
}

#[track_caller]
fn check(x: Trend, table: &[(&str, Way, [f64; 2])]) {
    for (text, way, range) in table {
        let found = trend(text, x);
        let goes = match (found.rises, found.falls) {
            (true, false) => Up,
            (false, true) => Down,
            (true, true) => Held,
            (false, false) => Open,
        };
        assert_eq!((goes, [found.low, found.high]), (*way, *range), "{text}: {found:?}");
        assert_eq!(found.is_held(), *way == Held, "{text}");
    }
}

/// Ranges and ways by hand, of an x from 0 on.
#[test]
fn sums_and_products_go_the_way_of_their_parts() {
    check(
        Trend::VARIABLE,
        &[
            ("x", Up, from(0.0)),
            ("-x", Down, to(0.0)),
            ("x + n", Up, from(3.0)),
            ("n - x", Down, to(3.0)),
            ("x - x", Open, ANY),
            ("x - u", Up, ANY),
            ("2 * x", Up, from(0.0)),
            ("x * -2", Down, to(0.0)),
            ("-x * -x", Up, from(0.0)),
            ("-x * (x + 2)", Down, to(0.0)),
            ("(x + 1) * (x + 2)", Up, from(2.0)),
            ("(x + 1) * (n - 5)", Down, to(-2.0)),
            ("(-x - 1) * (n - 5)", Up, from(2.0)),
            ("(-x - 1) * (-n - x)", Up, from(3.0)),
            ("x * u", Open, ANY),
            ("(x - 5) * n", Up, ANY),
            ("n * (x - 5)", Up, ANY),
            ("(x - 5) * (n - 9)", Down, ANY),
            ("(x - 5) * (x - 7)", Open, ANY),
            ("x * (x - 5)", Open, ANY),
            ("n * 2", Held, [6.0, 6.0]),
            ("n * -2", Held, [-6.0, -6.0]),
            ("u * n", Held, ANY),
            ("abs(u) * n", Held, from(0.0)),
            ("u * -2", Held, ANY),
            ("x / n", Up, from(0.0)),
            ("1 / (x + 2)", Down, [0.0, 0.5]),
            ("1 / (-x - 2)", Up, [-0.5, 0.0]),
            ("1 / (x - 5)", Open, ANY),
            ("1 / u", Held, ANY),
            ("(x + 2) / (1 / (x + 4))", Up, from(8.0)),
        ],
    );
}

#[test]
fn functions_that_never_fall_keep_the_way() {
    check(
        Trend::VARIABLE,
        &[
            ("min(x, n)", Up, [0.0, 3.0]),
            ("max(x, n)", Up, from(3.0)),
            ("min(n - x, 1)", Down, to(1.0)),
            ("max(x, n - x)", Open, from(0.0)),
            ("exp(-x)", Down, [0.0, 1.0]),
            ("ln(x + 1)", Up, from(0.0)),
            ("ln(x - 5)", Up, ANY),
            ("tanh(x)", Up, [0.0, 1.0]),
            ("sqrt(x + 4)", Up, from(2.0)),
            ("sin(x)", Open, ANY),
            ("cos(u)", Held, ANY),
            ("abs(x)", Up, from(0.0)),
            ("abs(-x)", Up, from(0.0)),
            ("abs(x - 5)", Open, from(0.0)),
            ("abs(u)", Held, from(0.0)),
            ("abs(n - 7)", Held, [4.0, 4.0]),
            ("x^2", Up, from(0.0)),
            ("x^0", Up, [1.0, 1.0]),
            ("(x + 2)^-2", Down, [0.0, 0.25]),
            ("(x + 1)^0.5", Up, from(1.0)),
            ("(x + 1)^-0.5", Down, [0.0, 1.0]),
            ("(x - 5)^1", Up, from(-5.0)),
            ("(x - 5)^2", Open, ANY),
            ("(x - 5)^3", Open, ANY),
            ("u^2", Held, ANY),
            ("n^2", Held, [9.0, 9.0]),
            ("n^u", Held, ANY),
            ("n^x", Open, ANY),
            ("x^u", Open, ANY),
            ("if(x < 2, 1, 2)", Open, ANY),
        ],
    );
}

#[test]
fn tables_go_one_way_where_their_values_do() {
    check(
        Trend::VARIABLE,
        &[
            ("up(x)", Up, [1.0, 5.0]),
            ("up(-x)", Down, [1.0, 5.0]),
            ("down(x)", Down, [-1.0, 4.0]),
            ("down(n - x)", Up, [-1.0, 4.0]),
            ("flat(x)", Held, [2.0, 2.0]),
            ("flat(sin(x))", Held, [2.0, 2.0]),
            ("hill(x)", Open, [0.0, 3.0]),
            ("up(sin(x))", Open, [1.0, 5.0]),
            ("up(u)", Held, [1.0, 5.0]),
            ("down(u)", Held, [-1.0, 4.0]),
            ("map(u, n)", Held, ANY),
            ("map(x, n)", Open, ANY),
            ("map(n, x)", Open, ANY),
        ],
    );
}

/// Of a number of either sign whose magnitude is the variable.
#[test]
fn even_functions_go_the_way_of_the_magnitude() {
    check(
        Trend::SIGNED,
        &[
            ("x", Open, ANY),
            ("abs(x)", Up, from(0.0)),
            ("abs(-x)", Up, from(0.0)),
            ("abs(2 * x)", Up, from(0.0)),
            ("abs(x * -2)", Up, from(0.0)),
            ("abs(x / n)", Up, from(0.0)),
            ("abs(u * x)", Up, from(0.0)),
            ("abs(x + 1)", Open, from(0.0)),
            ("abs(x * x)", Open, from(0.0)),
            ("abs(max(x, n))", Open, from(3.0)),
            ("abs(exp(x))", Open, from(0.0)),
            ("x^2", Up, from(0.0)),
            ("x^4", Up, from(0.0)),
            ("x^3", Open, ANY),
            ("x^-2", Down, from(0.0)),
        ],
    );
}

/// Regression: the negative of 0 is 0, and a product with what is 0 everywhere never ended: a
/// coefficient of 0 in a conductance stopped `lptn steady` with an overflow of the stack.
#[test]
fn a_product_with_nothing_ends() {
    for text in [
        "z * x",
        "x * z",
        "0 * x",
        "z * -x",
        "-x * z",
        "z * (x - 5)",
        "z * exp(-x)",
        "z * u",
        "z * z",
    ] {
        let found = trend(text, Trend::VARIABLE);
        assert!(found.low <= 0.0 && found.high >= 0.0, "{text}: {found:?}");
    }
    assert!(trend("n + z * abs(x)^0.25", Trend::SIGNED).rises);
    assert!(Trend::constant(-0.0).times(Trend::UNKNOWN).low <= 0.0);
    assert!(Trend::constant(f64::NAN).is_held() && Trend::constant(f64::NAN).low < 0.0);
}

/// Values at two places of a grid, the second further on, against what is claimed.
#[test]
fn what_is_claimed_holds_wherever_one_looks() {
    let parts = [
        "x",
        "u",
        "n",
        "z",
        "-x",
        "x - 2",
        "n - x",
        "abs(x)",
        "exp(-x)",
        "1 / (x + 1)",
        "x^2",
        "-n",
        "down(x)",
    ];
    let forms = [
        "(A) * (B)",
        "(A) + (B)",
        "(A) - (B)",
        "min(A, B)",
        "max(A, B)",
        "abs((A) * (B))",
        "((A) + (B))^2",
        "tanh((A) - (B))",
        "(A) / (1 + abs(B))",
        "up(A) * (B)",
        "exp(A) - exp(B)",
        "(B) / (n + (A)^2)",
    ];
    let mut told = 0;
    for (form, a, b) in
        forms.iter().flat_map(|f| parts.iter().flat_map(move |a| parts.map(|b| (f, a, b))))
    {
        let text = form.replace('A', a).replace('B', b);
        let compiled = program(&text);
        for (x, sign) in [(Trend::VARIABLE, 1.0), (Trend::SIGNED, 1.0), (Trend::SIGNED, -1.0)] {
            let found = trend(&text, x);
            told += usize::from(found.rises || found.falls);
            for u in [-2.0, 0.5] {
                let at = |k: i32| {
                    let slots = [sign * 0.25 * f64::from(k), u, 3.0, 0.0];
                    compiled.eval(&slots, &mut Vec::new()).ok()
                };
                for (now, next) in (0..20).filter_map(|k| at(k).zip(at(k + 1))) {
                    let slack = 1e-12 * (1.0 + now.abs());
                    assert!(
                        found.low - slack <= now && now <= found.high + slack,
                        "{text} {found:?}: {now}"
                    );
                    assert!(!found.rises || next >= now - slack, "{text} {found:?}: {now} {next}");
                    assert!(!found.falls || next <= now + slack, "{text} {found:?}: {now} {next}");
                }
            }
        }
    }
    assert!(told > 1000, "{told}");
}
