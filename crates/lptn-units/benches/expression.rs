//! A law compiled by this crate against the same law in Rust.
//!
//! The ratio of the two times is what matters; the target is 4.

#![allow(missing_docs, reason = "the macros of criterion write undocumented functions")]
#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use lptn_units::{Dual, Expression, Program, Scope, Symbol, Type};

const LAW: &str = "0.000087*w^(5/3) + (1.2+0.01*T)*1.32*abs(T-Tamb)^1.25 + exp(-T/300)*T";
const POINT: [f64; 3] = [733.0, 355.0, 298.0];

struct Names;

impl Scope for Names {
    fn symbol(&self, name: &str) -> Option<Symbol> {
        let slot = ["w", "T", "Tamb"].iter().position(|known| *known == name)?;
        Some(Symbol { slot: u32::try_from(slot).ok()?, ty: Type::SCALAR, in_comparison: None })
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

fn native([w, t, tamb]: [f64; 3]) -> f64 {
    0.000087 * w.powf(5.0 / 3.0)
        + (1.2 + 0.01 * t) * 1.32 * (t - tamb).abs().powf(1.25)
        + (-t / 300.0).exp() * t
}

fn law(c: &mut Criterion) {
    let program: Program = Expression::parse(LAW).unwrap().compile(&Names, None).unwrap();
    let mut stack = Vec::with_capacity(program.stack_size());
    assert!((program.eval(&POINT, &mut stack).unwrap() / native(POINT) - 1.0).abs() < 1e-14);
    c.bench_function("native", |b| b.iter(|| native(black_box(POINT))));
    c.bench_function("compiled", |b| b.iter(|| program.eval(black_box(&POINT), &mut stack)));
    let duals =
        [Dual::<2>::constant(POINT[0]), Dual::variable(POINT[1], 0), Dual::variable(POINT[2], 1)];
    let mut stack = Vec::with_capacity(program.stack_size());
    c.bench_function("compiled, two derivatives", |b| {
        b.iter(|| program.eval(black_box(&duals), &mut stack))
    });
}

criterion_group!(benches, law);
criterion_main!(benches);
