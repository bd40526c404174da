//! Heat of electric conductors.

use lptn_units::Scalar;

/// Factor of a property that is linear in temperature: f = 1 + alpha (T - T_ref), dimensionless.
///
/// * `alpha`: temperature coefficient in 1/K at `t_ref`; 0.00393 for copper at 20 degC
/// * `t`, `t_ref`: temperatures in K, or in any one unit with the size of a kelvin
///
/// A resistance is R = R_ref f. The line holds for metals over some 100 K around `t_ref`; where f reaches 0 it has
/// left its range. Source: Modelica Standard Library, Modelica.Electrical.Analog.Basic.HeatingResistor; IEC 60028
/// for copper.
///
/// ```
/// // copper at 100 degC against 20 degC
/// assert!((lptn_laws::linear_temperature_factor(0.00393, 373.15, 293.15) - 1.3144).abs() < 1e-12);
/// ```
pub fn linear_temperature_factor<S: Scalar>(alpha: S, t: S, t_ref: S) -> S {
    S::from_f64(1.0) + alpha * (t - t_ref)
}

/// Joule heat of a resistor at a voltage: P = U^2 / R, in W.
///
/// * `voltage`: U in V, of either sign (effective value where it alternates)
/// * `resistance`: R in ohm, above 0
///
/// Source: Joule's law with Ohm's law, as in Modelica.Electrical.Analog.Basic.HeatingResistor (LossPower = v i).
pub fn joule<S: Scalar>(voltage: S, resistance: S) -> S {
    voltage * voltage / resistance
}
