//! Families in `min`, `max`, `mean` and `sum`: one argument for each instance.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

use lptn_units::{Expression, Scope, Symbol, Type};

/// `cell[1].T` to `cell[3].T` in degC, `cell[k].P` as numbers, and `x`.
struct Cells;

impl Scope for Cells {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = self.names().iter().position(|known| known == name)?;
        let ty = if slot < 3 { Type::ABSOLUTE_TEMPERATURE } else { Type::SCALAR };
        Some(Symbol { slot: u32::try_from(slot).unwrap(), ty, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        let of = |key: &str| (1..=3).map(|k| format!("cell[{k}].{key}")).collect::<Vec<_>>();
        [of("T"), of("P"), vec!["x".to_owned()]].concat()
    }
}

fn members(name: &str) -> Option<Vec<String>> {
    let key = name.strip_prefix("cell[*]")?;
    Some((1..=3).map(|k| format!("cell[{k}]{key}")).collect())
}

const SLOTS: [f64; 7] = [300.0, 310.0, 302.0, 1.0, 2.0, 4.0, 10.0];

fn value(text: &str) -> f64 {
    let expression = Expression::parse(text).unwrap();
    let program = expression.with_members(&members).compile(&Cells, None);
    program.unwrap_or_else(|e| panic!("{text}: {e:?}")).eval(&SLOTS, &mut Vec::new()).unwrap()
}

#[test]
fn every_instance_is_an_argument() {
    assert!((value("max(cell[*].T) - min(cell[*].T)") - 10.0).abs() < 1e-12);
    assert!((value("mean(cell[*].P)") - 7.0 / 3.0).abs() < 1e-12);
    assert!((value("sum(cell[*].P)") - 7.0).abs() < 1e-12);
    assert!((value("x * sum(cell[*].P, 3)") - 100.0).abs() < 1e-12);
    // the same index in one argument: 1 * 1 + 2 * 2 + 4 * 4
    assert!((value("sum(cell[*].P * cell[*].P)") - 21.0).abs() < 1e-12);
    assert!((value("max(abs(kelvin(cell[*].T) / 1 [K] - 305), x)") - 10.0).abs() < 1e-12);
}

#[test]
fn a_family_elsewhere_stays_an_unknown_name() {
    for text in
        ["cell[*].T", "abs(cell[*].P)", "max(bolt[*].T, 3)", "max(cell[*].P, 1) + cell[*].P"]
    {
        let expression = Expression::parse(text).unwrap();
        let found = expression.with_members(&members).compile(&Cells, None);
        assert!(found.is_err(), "{text}");
    }
}

#[test]
fn temperatures_on_the_scale_have_no_sum() {
    let expression = Expression::parse("sum(cell[*].T)").unwrap();
    let found = expression.with_members(&members).compile(&Cells, None).unwrap_err();
    assert!(found.iter().next().unwrap().to_string().contains("added to another one"), "{found:?}");
}

#[test]
fn the_text_names_every_instance() {
    let meant = |text: &str, members: &dyn Fn(&str) -> Option<Vec<String>>| {
        Expression::parse(text).unwrap().with_members(members).meant()
    };
    let all = "2 * max(cell[1].P - 1, cell[2].P - 1, cell[3].P - 1, x)";
    assert_eq!(meant("2 * max(cell[*].P - 1, x)", &members), all);
    let one = |name: &str| Some(vec![name.replace("[*]", "[1]")]);
    assert_eq!(meant("1 + max(cell[*].P)", &one), "1 + cell[1].P");
    // the innermost call takes a family
    let inner = meant("max(mean(cell[*].P), x)", &members);
    assert_eq!(inner, "max(mean(cell[1].P, cell[2].P, cell[3].P), x)");
}
