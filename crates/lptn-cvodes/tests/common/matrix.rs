//! The matrix exponential, by scaling, a Taylor series and squaring.

const SIZE: usize = 6;
type Square = [[f64; SIZE]; SIZE];

fn product(a: &Square, b: &Square) -> Square {
    let mut c = [[0.0; SIZE]; SIZE];
    for i in 0..SIZE {
        for j in 0..SIZE {
            c[i][j] = (0..SIZE).map(|k| a[i][k] * b[k][j]).sum();
        }
    }
    c
}

fn exponential(a: &Square) -> Square {
    let halvings = 12;
    let small = a.map(|row| row.map(|x| x / 2.0_f64.powi(halvings)));
    let mut sum = [[0.0; SIZE]; SIZE];
    (0..SIZE).for_each(|i| sum[i][i] = 1.0);
    let mut term = sum;
    for k in 1..30 {
        term = product(&term, &small).map(|row| row.map(|x| x / f64::from(k)));
        (0..SIZE).for_each(|i| (0..SIZE).for_each(|j| sum[i][j] += term[i][j]));
    }
    (0..halvings).fold(sum, |power, _| product(&power, &power))
}

/// `[y, 1]' = A [y, 1]` for two nodes of capacity `c`, linked by `g`, the second to 0 by `out`,
/// `power` into the first.
fn affine((g, out, power, c): (f64, f64, f64, f64)) -> [[f64; 3]; 3] {
    [[-g / c, g / c, power / c], [g / c, -(g + out) / c, 0.0], [0.0; 3]]
}

/// The derivative of both temperatures at `t` by parameter `i` of `[g, out, power, c]`: the upper
/// right block of the exponential of `[[A, dA], [0, A]]` times the start.
pub(crate) fn two_nodes_by(
    i: usize,
    p: (f64, f64, f64, f64),
    (t, y0): (f64, [f64; 2]),
) -> [f64; 2] {
    let a = affine(p);
    let (g, out, power, c) = p;
    // linear in all but the capacity, which divides everything
    let by = match i {
        0 => affine((1.0, 0.0, 0.0, c)),
        1 => affine((0.0, 1.0, 0.0, c)),
        2 => affine((0.0, 0.0, 1.0, c)),
        _ => affine((g, out, power, -c * c)),
    };
    let mut large = [[0.0; SIZE]; SIZE];
    for row in 0..3 {
        for column in 0..3 {
            large[row][column] = t * a[row][column];
            large[row + 3][column + 3] = t * a[row][column];
            large[row][column + 3] = t * by[row][column];
        }
    }
    let e = exponential(&large);
    let start = [y0[0], y0[1], 1.0];
    [0, 1].map(|row| (0..3).map(|k| e[row][k + 3] * start[k]).sum())
}
