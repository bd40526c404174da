//! What the linear solvers cost on bodies of cells, as `M + h K` of a run or as `K` of a steady
//! state.
//!
//! ```sh
//! cargo run --release --workspace --example solvers -- grid3d 30 steady cholesky pcg
//! cargo run --release --workspace --example solvers -- grid2d 100 20 cholesky pcg
//! ```
//! Conductances spread over two decades, capacities too, faces convect; `20` is h in s. Times are
//! those of the processor.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a program to measure with")]

use std::time::Instant;

use lptn_integrate::linear::{self, Factorization, LinearSolver};
use lptn_integrate::{FactorError, Pattern};

/// Seconds of processor time so far, in steps of some milliseconds, or of the clock where the
/// system does not tell.
fn now(begin: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let spent = text.split(' ').next().and_then(|ns| ns.parse::<f64>().ok());
    spent.map_or_else(|| begin.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

/// The time in s that something takes, the mean of half a second of them.
fn mean(mut what: impl FnMut()) -> f64 {
    let begin = Instant::now();
    let (start, mut times) = (now(begin), 0);
    loop {
        what();
        times += 1;
        let spent = now(begin) - start;
        if spent > 0.5 {
            return spent / f64::from(times);
        }
    }
}

/// Numbers between 0 and 1 that are the same in every run.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Links `(row, column, conductance)` and the diagonal of what else there is.
fn body(n: usize, axes: u32, h: Option<f64>) -> (Vec<(usize, usize, f64)>, Vec<f64>) {
    let size = n.pow(axes);
    let mut next = numbers(size as u64);
    let mut spread = move |least: f64, most: f64| least * (most / least).powf(next());
    let mut links = Vec::new();
    let mut own: Vec<f64> = (0..size).map(|_| spread(1.0, 100.0)).collect();
    let scale = h.unwrap_or(1.0);
    if h.is_none() {
        own.fill(0.0);
    }
    for (cell, own) in own.iter_mut().enumerate() {
        for axis in 0..axes {
            let (stride, place) = (n.pow(axis), cell / n.pow(axis) % n);
            if place + 1 < n {
                links.push((cell + stride, cell, scale * spread(0.1, 10.0)));
            }
            if place == 0 || place + 1 == n {
                *own += scale * spread(0.01, 0.1);
            }
        }
    }
    (links, own)
}

fn matrix(links: &[(usize, usize, f64)], own: &[f64]) -> (Pattern, Vec<f64>) {
    let pattern = Pattern::new(own.len(), links.iter().map(|&(i, j, _)| (i, j)));
    let mut values = vec![0.0; pattern.len()];
    own.iter().enumerate().for_each(|(i, own)| values[pattern.diagonal_slot(i)] = *own);
    for &(i, j, g) in links {
        for (row, column, value) in [(i, j, -g), (j, i, -g), (i, i, g), (j, j, g)] {
            values[pattern.slot(row, column).unwrap()] += value;
        }
    }
    (pattern, values)
}

fn solver(name: &str, pattern: &Pattern) -> Result<Box<dyn Factorization>, FactorError> {
    match name {
        "cholesky" => linear::new(pattern, true, LinearSolver::Cholesky),
        "pcg" => linear::new(pattern, true, LinearSolver::Pcg),
        "multigrid" => Ok(Box::new(linear::Multigrid::new(pattern))),
        "steady" => linear::for_steady(pattern, LinearSolver::Auto),
        "lu" => linear::new(pattern, false, LinearSolver::Lu),
        "stages" => linear::for_stages(pattern, true, LinearSolver::Auto),
        "steps" => linear::for_steps(pattern, true, LinearSolver::Auto),
        _ => panic!("no solver `{name}`"),
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (axes, n) = (if arguments[0] == "grid2d" { 2 } else { 3 }, arguments[1].parse().unwrap());
    let (links, own) = body(n, axes, arguments[2].parse().ok());
    let (pattern, values) = matrix(&links, &own);
    drop(links);
    println!("{} rows, {} entries", pattern.size(), pattern.len());
    for name in &arguments[3..] {
        let analysis = mean(|| drop(solver(name, &pattern).unwrap()));
        let mut solver = solver(name, &pattern).unwrap();
        let factors = mean(|| solver.factorize(&values).unwrap());
        // heat of up to 20 W in every hundredth cell
        let mut next = numbers(1);
        let b: Vec<f64> =
            (0..own.len()).map(|i| if i % 100 == 0 { 20.0 * next() } else { 0.0 }).collect();
        let mut x = b.clone();
        solver.solve_in_place(&mut x).unwrap();
        let iterations = solver.iterations();
        let solution = mean(|| {
            x.copy_from_slice(&b);
            solver.solve_in_place(&mut x).unwrap();
        });
        let mut left = vec![0.0; b.len()];
        pattern.multiply(&values, &x, &mut left);
        let left = left.iter().zip(&b).map(|(l, b)| (l - b).abs()).fold(0.0, f64::max);
        println!(
            "{name:9} {:?}: analysed {:.3} ms, factorised {:.3} ms, solved {:.3} ms, fill {:.2e}, \
             {iterations} iterations of {:.2} ns/row, left {left:.1e}",
            solver.kind(),
            analysis * 1e3,
            factors * 1e3,
            solution * 1e3,
            solver.fill() as f64,
            solution * 1e9 / (iterations.max(1) as f64 * own.len() as f64),
        );
    }
}
