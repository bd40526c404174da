//! Steady conduction through simple shapes, in one dimension.
//!
//! Source of all four: F. P. Incropera, D. P. DeWitt, T. L. Bergman, A. S. Lavine, Fundamentals of Heat and Mass
//! Transfer, 6th edition (Wiley 2007), table 3.3 (one-dimensional, steady, without generation).

use std::f64::consts::PI;

use lptn_units::Scalar;

/// Conductance of a plane layer: G = k A / L, in W/K.
///
/// * `k`: conductivity in W/(m K), above 0; where it depends on temperature, its mean over the layer
/// * `area`: A in m^2, normal to the heat, above 0
/// * `thickness`: L in m, along the heat, above 0
///
/// Exact for heat in one direction: edges are insulated or far away. Source: Incropera et al., 6th edition,
/// equation 3.6.
///
/// ```
/// // 10 cm of brick, 2 m^2
/// assert!((lptn_laws::slab(0.72, 2.0, 0.1) - 14.4).abs() < 1e-12);
/// ```
pub fn slab<S: Scalar>(k: S, area: S, thickness: S) -> S {
    k * area / thickness
}

/// Conductance of a hollow cylinder, radially: G = 2 pi k L / ln(r_out / r_in), in W/K.
///
/// * `k`: conductivity in W/(m K), above 0
/// * `r_in`, `r_out`: radii in m, 0 < r_in < r_out
/// * `length`: L in m, above 0
///
/// Exact for heat that flows radially only: ends are insulated or the cylinder is long. Source: Incropera et
/// al., 6th edition, equation 3.28.
pub fn cylinder<S: Scalar>(k: S, r_in: S, r_out: S, length: S) -> S {
    S::from_f64(2.0 * PI) * k * length / (r_out / r_in).ln()
}

/// Conductance of a hollow sphere, radially: G = 4 pi k / (1/r_in - 1/r_out), in W/K.
///
/// * `k`: conductivity in W/(m K), above 0
/// * `r_in`, `r_out`: radii in m, 0 < r_in < r_out
///
/// Evaluated as 4 pi k r_in r_out / (r_out - r_in), which does not cancel in thin shells. Source: Incropera et
/// al., 6th edition, equation 3.36.
pub fn sphere<S: Scalar>(k: S, r_in: S, r_out: S) -> S {
    S::from_f64(4.0 * PI) * k * r_in * r_out / (r_out - r_in)
}

/// Conductance of a round rod, along its axis: G = k pi d^2 / (4 L), in W/K.
///
/// * `k`: conductivity in W/(m K), above 0
/// * `diameter`: d in m, above 0
/// * `length`: L in m, above 0
///
/// A plane layer with the area of the cross-section; the skin is insulated. Source: Incropera et al., 6th
/// edition, equation 3.6.
pub fn rod<S: Scalar>(k: S, diameter: S, length: S) -> S {
    slab(k, S::from_f64(PI / 4.0) * diameter * diameter, length)
}
