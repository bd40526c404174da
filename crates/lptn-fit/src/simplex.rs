//! The minimum of a function of some numbers without its derivatives.

/// Uses the simplex of J. A. Nelder and R. Mead (Computer Journal 7 (1965) 308), to 1e-3 of the
/// function and 1e-2 of the numbers, all of order 1, or 40 steps for two of them. It begins with
/// corners that are `size` apart.
pub(crate) fn minimum(function: impl Fn(&[f64]) -> f64, start: &[f64], size: f64) -> Vec<f64> {
    let count = start.len();
    let at = |p: Vec<f64>| {
        let value = function(&p);
        (p, if value.is_nan() { f64::INFINITY } else { value })
    };
    let mut corners = vec![at(start.to_vec())];
    corners.extend((0..count).map(|k| {
        let mut corner = start.to_vec();
        corner[k] += size;
        at(corner)
    }));
    for _ in 0..20 * count {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let Some(((worst, highest), others)) = corners.split_last() else { break };
        let (best, lowest) = (&others[0].0, others[0].1);
        let apart = |(corner, _): &(Vec<f64>, f64)| {
            corner.iter().zip(best).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        if (highest - lowest).abs() < 1e-3 && corners.iter().map(apart).fold(0.0, f64::max) < 1e-2 {
            break;
        }
        // on the line from the worst corner through the middle of the others
        let along = |by: f64| -> Vec<f64> {
            let middle = |k: usize| others.iter().map(|c| c.0[k]).sum::<f64>() / count as f64;
            (0..count).map(|k| middle(k) + by * (middle(k) - worst[k])).collect()
        };
        let second = others[count - 1].1;
        let reflected = at(along(1.0));
        let next = if reflected.1 < lowest {
            let far = at(along(2.0));
            if far.1 < reflected.1 { far } else { reflected }
        } else if reflected.1 < second {
            reflected
        } else {
            at(along(if reflected.1 < *highest { 0.5 } else { -0.5 }))
        };
        if next.1 < *highest {
            corners[count] = next;
            continue;
        }
        let best = best.clone();
        for corner in &mut corners[1..] {
            *corner = at(corner.0.iter().zip(&best).map(|(p, b)| 0.5 * (p + b)).collect());
        }
    }
    corners.sort_by(|a, b| a.1.total_cmp(&b.1));
    corners.swap_remove(0).0
}

#[cfg(test)]
mod tests {
    use super::minimum;

    #[test]
    fn analytic_the_least_of_a_bent_valley_is_found() {
        let valley = |p: &[f64]| {
            3.0 * (p[0] - 1.0).powi(2) + (p[1] - p[0] * p[0]).powi(2) + (p[2] + 2.0).powi(2)
        };
        let found = minimum(valley, &[0.0, 0.0, 0.0], 0.6);
        for (found, expected) in found.iter().zip([1.0, 1.0, -2.0]) {
            assert!((found - expected).abs() < 0.03, "{found} {expected}");
        }
        let one = minimum(|p| (p[0] - 3.0).powi(2), &[0.0], 1.0);
        assert!((one[0] - 3.0).abs() < 0.02);
    }
}
