//! Numbers that show if a body is a lump: how uniform its temperature is inside.

use lptn_units::Scalar;

/// Biot number of a body: Bi = h L / k, the resistance inside over that of its surface,
/// dimensionless.
///
/// * `coefficient`: h of the surface in W/(m^2 K), not negative
/// * `length`: characteristic length L in m, volume over the surface that gives off heat; above 0
/// * `conductivity`: k of the body in W/(m K), above 0
///
/// Below 0.1 one temperature represents the body: the error of the lumped capacitance method is
/// small. Source: Incropera, DeWitt, Bergman, Lavine, Fundamentals of Heat and Mass Transfer, 6th
/// edition, equations 5.9 and 5.10.
///
/// ```
/// // example 5.1: a thermocouple bead, a sphere of 0.706 mm; volume over surface is a sixth
/// let bead = lptn_laws::biot(400.0, 0.706e-3 / 6.0, 20.0);
/// assert!((bead - 2.35e-3).abs() < 5e-6);
/// ```
pub fn biot<S: Scalar>(coefficient: S, length: S, conductivity: S) -> S {
    coefficient * length / conductivity
}

/// Diffusion time of a body: L^2 / alpha with alpha = k / (rho cp), in s.
///
/// * `length`: characteristic length L in m
/// * `conductivity`: k in W/(m K), above 0
/// * `density`: rho in kg/m^3
/// * `specific_heat`: cp in J/(kg K)
///
/// After a jump of its surface the profile inside a body has settled at a Fourier number of 0.2,
/// which is 0.2 L^2/alpha for a plate of half thickness L, and 0.8 and 1.8 of it for a long
/// cylinder and a sphere, whose radius is 2 L and 3 L. Source: Incropera et al., 6th edition,
/// equations 5.12 and 5.33, section 5.5.2.
///
/// ```
/// // 1 cm of steel: k = 50 W/(m K), rho cp = 7850 * 475 J/(m^3 K)
/// assert!((lptn_laws::diffusion_time(0.01, 50.0, 7850.0, 475.0) - 7.4575).abs() < 1e-12);
/// ```
pub fn diffusion_time<S: Scalar>(length: S, conductivity: S, density: S, specific_heat: S) -> S {
    length * length * density * specific_heat / conductivity
}
