//! Melting and solidification of a lump of uniform temperature, by the enthalpy method.

use lptn_units::Scalar;

/// Capacity that a melt adds between solidus and liquidus: C = L / (T_liquidus - T_solidus), in
/// J/K, or J/(kg K).
///
/// * `latent_heat`: L in J, or J/kg, at least 0
/// * `solidus`, `liquidus`: temperatures in K, solidus < liquidus; a pure substance takes up L at
///   one temperature
///
/// The melted fraction is linear between the two, so that the latent heat is taken up evenly.
/// Source: V. R. Voller, C. R. Swaminathan, B. G. Thomas, Fixed grid techniques for phase change
/// problems: a review, International Journal for Numerical Methods in Engineering 30 (1990)
/// 875-898.
///
/// ```
/// // wax: 200 kJ/kg between 55 and 57 degC
/// assert_eq!(lptn_laws::melting_capacity(200e3, 328.15, 330.15), 100e3);
/// ```
pub fn melting_capacity<S: Scalar>(latent_heat: S, solidus: S, liquidus: S) -> S {
    latent_heat / (liquidus - solidus)
}
