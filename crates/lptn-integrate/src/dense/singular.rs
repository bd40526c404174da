//! Singular values by Jacobi's method from one side: columns are turned in pairs until all are
//! orthogonal (M. R. Hestenes 1958; G. H. Golub and C. F. Van Loan, Matrix Computations, 4th ed.,
//! 8.6.3).

use super::Singular;
use super::columns::{Columns, add, dot, turn};

/// Rounds through all pairs.
const MOST_ROUNDS: usize = 60;

/// For a matrix with at least as many rows as columns, whose squares are numbers.
pub(super) fn singular(a: Columns<f64>) -> Option<Singular> {
    let (mut w, mut v) = (a.clone(), Columns::identity(a.count));
    let squares: f64 = (0..w.count).map(|k| dot(w.column(k), w.column(k))).sum();
    let rounding = f64::EPSILON * (w.rows as f64).sqrt();
    let small = rounding * squares.sqrt();
    (0..MOST_ROUNDS).find(|_| !all_pairs((&mut w, &mut v), rounding, small))?;
    Some(sorted(&w, &v, small))
}

/// Turns all pairs once; true if a pair had to be turned.
fn all_pairs((w, v): (&mut Columns<f64>, &mut Columns<f64>), rounding: f64, small: f64) -> bool {
    let mut turned = false;
    for q in 1..w.count {
        for p in 0..q {
            if let Some(by) = angle(w.column(p), w.column(q), (rounding, small)) {
                turn_pair(w, (p, q), by);
                turn_pair(v, (p, q), by);
                turned = true;
            }
        }
    }
    turned
}

/// Cosine and sine of the turn that makes two columns orthogonal; `None` if they are to
/// rounding, or one is nothing but rounding.
fn angle(x: &[f64], y: &[f64], (rounding, small): (f64, f64)) -> Option<(f64, f64)> {
    let (xx, yy, xy) = (dot(x, x), dot(y, y), dot(x, y));
    let lengths = (xx.sqrt(), yy.sqrt());
    let done = xy.abs() <= rounding * lengths.0 * lengths.1;
    if done || lengths.0.min(lengths.1) <= small {
        return None;
    }
    let zeta = (yy - xx) / (2.0 * xy);
    let tangent = 1.0_f64.copysign(zeta) / (zeta.abs() + zeta.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    Some((cosine, -cosine * tangent))
}

fn turn_pair(a: &mut Columns<f64>, (p, q): (usize, usize), by: (f64, f64)) {
    let rows = a.rows;
    let (before, rest) = a.split(q);
    turn(&mut before[p * rows..(p + 1) * rows], &mut rest[..rows], by);
}

/// Largest first.
fn sorted(w: &Columns<f64>, v: &Columns<f64>, small: f64) -> Singular {
    let lengths: Vec<f64> = (0..w.count).map(|k| dot(w.column(k), w.column(k)).sqrt()).collect();
    let mut order: Vec<usize> = (0..w.count).collect();
    order.sort_by(|&a, &b| lengths[b].total_cmp(&lengths[a]));
    let mut u: Vec<Vec<f64>> = Vec::new();
    for &k in &order {
        let column = match lengths[k] > small {
            true => w.column(k).iter().map(|x| x / lengths[k]).collect(),
            false => another(&u, w.rows),
        };
        u.push(column);
    }
    Singular {
        u: faer::Mat::from_fn(w.rows, w.count, |i, k| u[k][i]),
        values: order.iter().map(|&k| lengths[k]).collect(),
        v: faer::Mat::from_fn(w.count, w.count, |i, k| v[(i, order[k])]),
    }
}

/// A direction that is orthogonal to the known ones, for a value that is nothing but rounding:
/// the remainder of the axis with the largest remainder.
fn another(known: &[Vec<f64>], rows: usize) -> Vec<f64> {
    let left = |axis: usize| 1.0 - known.iter().map(|u| u[axis] * u[axis]).sum::<f64>();
    let more = |best: usize, axis: usize| if left(axis) > left(best) { axis } else { best };
    let mut direction = vec![0.0; rows];
    direction[(0..rows).fold(0, more)] = 1.0;
    for _ in 0..2 {
        for u in known {
            let along = dot(u, &direction);
            add(&mut direction, -along, u);
        }
    }
    let length = dot(&direction, &direction).sqrt();
    direction.iter().map(|x| x / length).collect()
}
