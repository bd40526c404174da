//! The minimum of a function of two numbers without its derivatives.

/// By the simplex of J. A. Nelder and R. Mead (Computer Journal 7 (1965) 308), to 1e-3 of the
/// function and 1e-2 of the numbers, both of order 1, or 80 evaluations.
pub(super) fn minimum(function: impl Fn([f64; 2]) -> f64, start: [f64; 2]) -> [f64; 2] {
    let at = |p: [f64; 2]| (p, function(p));
    let mut corners = [at(start), at([start[0] + 0.6, start[1]]), at([start[0], start[1] + 0.6])];
    for _ in 0..40 {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let [best, good, worst] = corners;
        let size = (0..2)
            .map(|k| (worst.0[k] - best.0[k]).abs().max((good.0[k] - best.0[k]).abs()))
            .fold(0.0, f64::max);
        if (worst.1 - best.1).abs() < 1e-3 && size < 1e-2 {
            break;
        }
        // on the line from the worst corner through the middle of the others
        let along = |by: f64| -> [f64; 2] {
            std::array::from_fn(|k| {
                let middle = 0.5 * (best.0[k] + good.0[k]);
                middle + by * (middle - worst.0[k])
            })
        };
        let reflected = at(along(1.0));
        corners[2] = if reflected.1 < best.1 {
            let far = at(along(2.0));
            if far.1 < reflected.1 { far } else { reflected }
        } else if reflected.1 < good.1 {
            reflected
        } else {
            at(along(if reflected.1 < worst.1 { 0.5 } else { -0.5 }))
        };
        if corners[2].1 >= worst.1 {
            let halfway = |p: [f64; 2]| std::array::from_fn(|k| 0.5 * (p[k] + best.0[k]));
            corners = [best, at(halfway(good.0)), at(halfway(worst.0))];
        }
    }
    corners.sort_by(|a, b| a.1.total_cmp(&b.1));
    corners[0].0
}
