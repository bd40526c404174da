//! Matrices of networks.
#![allow(dead_code, clippy::unwrap_used, reason = "each test uses a part of it")]

use lptn_integrate::Pattern;

pub(crate) fn matrix(n: usize, entries: &[(usize, usize, f64)]) -> (Pattern, Vec<f64>) {
    let pattern = Pattern::new(n, entries.iter().map(|&(i, j, _)| (i, j)));
    let mut values = vec![0.0; pattern.len()];
    for &(i, j, value) in entries {
        values[pattern.slot(i, j).unwrap()] += value;
    }
    (pattern, values)
}

/// Numbers between 0 and 1 that are the same in every run.
pub(crate) fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// `M + G` of a random connected network; not symmetric if `upwind`.
pub(crate) fn random_network(n: usize, upwind: bool) -> (Pattern, Vec<f64>) {
    let mut next = numbers(n as u64);
    let mut entries = Vec::new();
    for i in 0..n {
        entries.push((i, i, 0.1 + next()));
        for _ in 0..3 {
            let (j, g) = ((next() * n as f64) as usize % n, 10_f64.powf(4.0 * next() - 2.0));
            if i != j {
                entries.extend([(i, i, g), (i, j, -g)]);
                if !upwind {
                    entries.extend([(j, j, g), (j, i, -g)]);
                }
            }
        }
    }
    matrix(n, &entries)
}

/// A chain of links of 1 with the boundary link `g` at its end.
pub(crate) fn chain(n: usize, g: f64) -> (Pattern, Vec<f64>) {
    let mut entries = vec![(n - 1, n - 1, g)];
    for i in 1..n {
        entries.extend([(i, i, 1.0), (i - 1, i - 1, 1.0), (i, i - 1, -1.0), (i - 1, i, -1.0)]);
    }
    matrix(n, &entries)
}

/// `M + G` of a cube of `n` cells along each axis, links of 1 between neighbours, masses of `mass`.
pub(crate) fn cube(n: usize, mass: f64) -> (Pattern, Vec<f64>) {
    let mut entries = Vec::new();
    for cell in 0..n * n * n {
        entries.push((cell, cell, mass));
        for (stride, place) in [(1, cell % n), (n, cell / n % n), (n * n, cell / (n * n))] {
            if place + 1 < n {
                let next = cell + stride;
                entries.extend([
                    (cell, cell, 1.0),
                    (next, next, 1.0),
                    (cell, next, -1.0),
                    (next, cell, -1.0),
                ]);
            }
        }
    }
    matrix(n * n * n, &entries)
}
