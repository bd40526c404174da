//! Films, contacts and natural convection.

use lptn_units::Scalar;

/// Conductance of a film between a surface and a fluid: G = h A, in W/K (Newton's law of cooling).
///
/// * `h`: film coefficient in W/(m^2 K), at least 0
/// * `area`: A of the wetted surface in m^2, above 0
///
/// Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equations 1.3a and 3.9.
pub fn film<S: Scalar>(h: S, area: S) -> S {
    h * area
}

/// Conductance of a joint between two solids: G = h A, in W/K.
///
/// * `h`: contact conductance in W/(m^2 K), above 0: the reciprocal of the tabulated contact resistance R''
/// * `area`: A of the nominal, not the true, area of contact in m^2, above 0
///
/// Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equation 3.20, with values in
/// tables 3.1 and 3.2.
pub fn contact<S: Scalar>(h: S, area: S) -> S {
    h * area
}

/// Conductance of natural convection as a power law: G = c abs(dT)^n, in W/K.
///
/// * `c`: in W/K^(1 + n), at least 0: its value at a difference of 1 K
/// * `n`: at least 0; 1/4 for laminar and 1/3 for turbulent layers of air at usual temperatures
/// * `dt`: difference between the surface and the fluid in K, of either sign
///
/// The heat is q = G dT. Its derivative, (1 + n) c abs(dT)^n, is 0 at dT = 0 for n > 0. The slope of G alone is
/// infinite there for 0 < n < 1; it is given as 0, which leaves the product G dT with its true derivative.
///
/// Source of the form: A. Bejan and A. D. Kraus (editors), Heat Transfer Handbook (Wiley 2003), equation 3.286;
/// of c and n: the simplified equations for air, J. P. Holman, Heat Transfer, table 7-2, for example h = 1.42
/// (dT/L)^(1/4) on vertical walls of height L with 1e4 < Gr Pr < 1e9.
///
/// ```
/// use lptn_laws::power_conductance;
///
/// assert!((power_conductance(0.35, 0.25, -16.0) - 0.7).abs() < 1e-15);
/// assert_eq!(power_conductance(0.35, 0.25, 0.0), 0.0);
/// ```
pub fn power_conductance<S: Scalar>(c: S, n: S, dt: S) -> S {
    c * dt.abs().pow(n)
}
