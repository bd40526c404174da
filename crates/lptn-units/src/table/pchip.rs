//! Slopes of the monotone piecewise cubic.
//!
//! Source: F. N. Fritsch and J. Butland, A method for constructing local monotone piecewise cubic
//! interpolants, SIAM Journal on Scientific and Statistical Computing 5 (1984) 300 (weighted
//! harmonic mean); ends: C. Moler, Numerical Computing with MATLAB (SIAM 2004) 3.4. These are the
//! slopes of SciPy's `PchipInterpolator`.

/// One slope per point. Two points or more.
pub(super) fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let widths: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secants: Vec<f64> =
        y.windows(2).zip(&widths).map(|(pair, h)| (pair[1] - pair[0]) / h).collect();
    let (&[.., h_before, h_last], &[.., m_before, m_last]) = (&widths[..], &secants[..]) else {
        return secants.iter().chain(secants.last()).copied().collect();
    };
    let inner =
        widths.windows(2).zip(secants.windows(2)).map(|(h, m)| inner([h[0], h[1]], [m[0], m[1]]));
    let first = end([widths[0], widths[1]], [secants[0], secants[1]]);
    let last = end([h_last, h_before], [m_last, m_before]);
    std::iter::once(first).chain(inner).chain([last]).collect()
}

/// Between two secants: their harmonic mean, weighted by the widths; 0 at a peak and next to a flat
/// piece.
fn inner(h: [f64; 2], m: [f64; 2]) -> f64 {
    if !same_sign(m[0], m[1]) {
        return 0.0;
    }
    let weights = [2.0 * h[1] + h[0], h[1] + 2.0 * h[0]];
    (weights[0] + weights[1]) / (weights[0] / m[0] + weights[1] / m[1])
}

/// At an end: the parabola through three points, limited so that the first piece rises or falls as
/// its ends do. Width and secant of the outer interval come first.
fn end(h: [f64; 2], m: [f64; 2]) -> f64 {
    let slope = ((2.0 * h[0] + h[1]) * m[0] - h[0] * m[1]) / (h[0] + h[1]);
    if !same_sign(slope, m[0]) {
        0.0
    } else if !same_sign(m[0], m[1]) && slope.abs() > 3.0 * m[0].abs() {
        3.0 * m[0]
    } else {
        slope
    }
}

/// Both above or both below 0.
fn same_sign(a: f64, b: f64) -> bool {
    (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0)
}

/// The cubic piece over `x0 … x1` with these values and slopes at its ends: value and slope at
/// `x`, exact at both ends.
pub(super) fn cubic(
    [x0, x1]: [f64; 2],
    [y0, y1]: [f64; 2],
    [d0, d1]: [f64; 2],
    x: f64,
) -> (f64, f64) {
    let (width, rise) = (x1 - x0, y1 - y0);
    let (t, u) = ((x - x0) / width, (x1 - x) / width);
    let step = if t <= u {
        y0 + rise * (t * t * (3.0 - 2.0 * t))
    } else {
        y1 - rise * (u * u * (3.0 - 2.0 * u))
    };
    let value = step + width * t * u * (u * d0 - t * d1);
    let slope = 6.0 * t * u * (rise / width) + d0 * (u * (u - 2.0 * t)) + d1 * (t * (t - 2.0 * u));
    (value, slope)
}

/// The same piece by powers of `t` from 0 to 1, with the slopes by `t`.
pub(super) fn powers([y0, y1]: [f64; 2], [d0, d1]: [f64; 2]) -> [f64; 4] {
    let rise = y1 - y0;
    [y0, d0, 3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise]
}
