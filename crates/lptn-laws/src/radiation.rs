//! Radiation between grey, diffuse surfaces.

use lptn_units::Scalar;

/// The Stefan-Boltzmann constant in W/(m^2 K^4).
///
/// Exact since the SI of 2019: 2 pi^5 k^4 / (15 h^3 c^2), of which CODATA 2018 and 2022 print 5.670374419...e-8.
/// The digits printed are kept here, as other programs do; the next would change it by 3e-11.
pub const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

/// Conductance of radiation: G = sigma gr (Ta^2 + Tb^2) (Ta + Tb), in W/K.
///
/// * `gr`: exchange area in m^2, at least 0 ([`radiation_exchange_area`])
/// * `t_from`, `t_to`: absolute temperatures in K, at least 0
///
/// The heat is q = G (T_from - T_to) = sigma gr (T_from^4 - T_to^4), positive from `from` to `to`. In this form
/// nothing cancels where the temperatures are close, and at dT = 0 the derivative is 4 sigma gr T^3.
///
/// Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equations 1.8 and 1.9.
pub fn radiation_conductance<S: Scalar>(gr: S, t_from: S, t_to: S) -> S {
    S::from_f64(STEFAN_BOLTZMANN) * gr * (t_from * t_from + t_to * t_to) * (t_from + t_to)
}

/// Exchange area of two surfaces: Gr = e A F, in m^2.
///
/// * `emissivity`: effective emissivity of the pair, 0 to 1 ([`effective_emissivity_parallel_plates`],
///   [`effective_emissivity_concentric`]; the emissivity of a small body in a large room)
/// * `area`: A of the surface that `view_factor` and `emissivity` refer to, in m^2, above 0
/// * `view_factor`: F from that area to the other surface, 0 to 1. It is 1 where the effective emissivity already
///   holds the geometry
///
/// With e = 1 the exchange of black surfaces; with F = 1 that of a two-surface enclosure; with both below 1 an
/// approximation, as the reflected part is taken to leave. Source: Incropera et al., Fundamentals of Heat and
/// Mass Transfer, 6th edition, equations 13.17 (black) and 13.18 (enclosure).
pub fn radiation_exchange_area<S: Scalar>(emissivity: S, area: S, view_factor: S) -> S {
    emissivity * area * view_factor
}

/// Effective emissivity of two large parallel plates: e = 1 / (1/e1 + 1/e2 - 1).
///
/// * `e1`, `e2`: emissivities, 0 to 1, one of them above 0
///
/// Evaluated as e1 e2 / (e1 + e2 - e1 e2), which also takes a perfect mirror. The gap is small against the
/// plates. Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equation 13.19 (table
/// 13.3).
///
/// ```
/// assert!((lptn_laws::effective_emissivity_parallel_plates(0.5, 0.5) - 1.0 / 3.0).abs() < 1e-15);
/// ```
pub fn effective_emissivity_parallel_plates<S: Scalar>(e1: S, e2: S) -> S {
    effective_emissivity_concentric(e1, e2, S::from_f64(1.0))
}

/// Effective emissivity of a body inside another: e = 1 / (1/e_in + a (1/e_out - 1)), referred to the inner area.
///
/// * `e_inner`, `e_outer`: emissivities, 0 to 1, one of them above 0
/// * `area_ratio`: a = A_inner / A_outer, 0 to 1: r_in / r_out of long concentric cylinders, (r_in / r_out)^2 of
///   concentric spheres, 0 for a small body in a large room, which gives e = e_inner
///
/// Evaluated as e_in e_out / (e_out + a e_in (1 - e_out)). The inner surface is convex and sees the outer one
/// only. Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equations 13.20 to 13.22
/// (table 13.3).
pub fn effective_emissivity_concentric<S: Scalar>(e_inner: S, e_outer: S, area_ratio: S) -> S {
    let back = area_ratio * e_inner * (S::from_f64(1.0) - e_outer);
    e_inner * e_outer / (e_outer + back)
}
