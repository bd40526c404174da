//! Reference: numbers printed in textbooks. The digits of Incropera's and Holman's examples are also found in
//! the transcripts of FOSSEE (Python-Textbook-Companions, commit 206d035; Scilab-TBC-Uploads, commit b1f5c3f).

use std::f64::consts::PI;

use lptn_laws::{
    Melting, biot, contact, cylinder, diffusion_time, effective_emissivity_concentric,
    effective_emissivity_parallel_plates, film, joule, linear_temperature_factor, power_conductance,
    radiation_conductance, radiation_exchange_area, rod, slab, sphere,
};

/// Textbooks round the Stefan-Boltzmann constant to 5.67e-8, which is 6.6e-5 of it too little.
const ROUNDED_SIGMA: f64 = 6.7e-5;

#[track_caller]
fn near(found: f64, printed: f64, tolerance: f64) {
    assert!((found - printed).abs() <= tolerance, "{found}, printed {printed} (tolerance {tolerance})");
}

fn series(conductances: &[f64]) -> f64 {
    1.0 / conductances.iter().map(|g| 1.0 / g).sum::<f64>()
}

fn radiation(gr: f64, t_from: f64, t_to: f64) -> f64 {
    radiation_conductance(gr, t_from, t_to) * (t_from - t_to)
}

/// Incropera, 6th edition, example 1.1: fireclay brick between 1400 and 1150 K loses 1700 W.
#[test]
fn slab_of_fireclay() {
    near(slab(1.7, 0.5 * 1.2, 0.15) * 250.0, 1700.0, 1e-9);
}

/// Incropera, 6th edition, example 1.2: bare steam pipe in a room, 998 W/m; 998.38 W in the transcript.
#[test]
fn pipe_by_convection_and_radiation() {
    let area = PI * 0.07;
    let gr = radiation_exchange_area(0.8, area, 1.0);
    let radiated = radiation(gr, 473.15, 298.15);
    near(film(15.0, area) * 175.0 + radiated, 998.38, 0.005 + ROUNDED_SIGMA * radiated);
}

/// Incropera, 6th edition, example 3.2: a chip of 1e4 W/m^2 is at 75.3 degC; 75.31 in the transcript.
#[test]
fn chip_on_epoxy_and_aluminium() {
    let below = series(&[contact(1.0 / 0.9e-4, 1.0), slab(239.0, 1.0, 0.008), film(100.0, 1.0)]);
    near(25.0 + 1e4 / (film(100.0, 1.0) + below), 75.31, 0.005);
}

/// Incropera, 6th edition, example 5.1: a bead of 0.706 mm with a time constant of 1 s at 400 W/(m^2 K); its Biot
/// number is far below 0.1. The time constant over the diffusion time is the Biot number: h L / k.
#[test]
fn thermocouple_is_a_lump() {
    let (diameter, h, k, rho, cp) = (7.06e-4, 400.0, 20.0, 8500.0, 400.0);
    let length = diameter / 6.0;
    near(biot(h, length, k), 2.353e-3, 5e-7);
    let tau = rho * cp * length / h;
    near(tau, 1.0, 5e-4);
    near(diffusion_time(length, k, rho, cp) / tau, biot(h, length, k), 1e-15);
}

/// Incropera, 6th edition, example 5.4: pipeline wall of 40 mm steel, k = 63.9 W/(m K), in hot oil of 500 W/(m^2 K): Bi =
/// 0.313, no lump; after 8 min its Fourier number is 5.64 (alpha = 18.8e-6 m^2/s).
#[test]
fn pipeline_is_no_lump() {
    near(biot(500.0, 0.04, 63.9), 0.313, 5e-4);
    // rho = 7832 kg/m^3, cp = 434 J/(kg K)
    near(480.0 / diffusion_time(0.04, 63.9, 7832.0, 434.0), 5.64, 5e-3);
}

/// Incropera, 6th edition, example 3.3: the conductivity of a carbon nanotube between two heated islands on
/// beams; 3111.86 W/(m K) in the transcript.
#[test]
fn rod_of_carbon() {
    let (t_sensing, t_room, power) = (308.4, 300.0, 11.3e-6);
    let (platinum, nitride) = (1e-6 * 0.2e-6, 3e-6 * 0.5e-6 - 1e-6 * 0.2e-6);
    let beam = slab(71.6, platinum, 250e-6) + slab(15.5, nitride, 250e-6);
    let through_tube = 2.0 * beam * (t_sensing - t_room);
    let t_heated = t_room + (power - through_tube) / (2.0 * beam);
    let found = rod(3111.86, 14e-9, 5e-6) * (t_heated - t_sensing);
    near(found / through_tube, 1.0, 0.005 / 3111.86);
}

/// The library ht (Caleb Bell), R_cylinder: wall from 0.9 to 1.0 m, k = 20 W/(m K), length 10 m.
#[test]
fn wall_of_a_cylinder() {
    near(1.0 / cylinder(20.0, 0.9, 1.0, 10.0), 8.384323e-5, 5e-12);
}

/// Incropera, 6th edition, example 3.6: liquid nitrogen of 77 K in a sphere with evacuated silica powder, air of
/// 300 K with 20 W/(m^2 K): 13.06 W.
#[test]
fn sphere_of_nitrogen() {
    let powder = sphere(0.0017, 0.25, 0.275);
    let air = film(20.0, 4.0 * PI * 0.275 * 0.275);
    near(1.0 / powder, 17.02, 0.005);
    near(1.0 / air, 0.05, 0.005);
    near(series(&[powder, air]) * (300.0 - 77.0), 13.06, 0.005);
}

/// Holman, Heat Transfer, example 8-10: plates of 0.3 and 0.8 exchange 0.279 of black ones, 0.01902 with a shield
/// of 0.04 between them.
#[test]
fn parallel_plates_with_a_shield() {
    near(effective_emissivity_parallel_plates(0.3, 0.8), 0.279, 5e-4);
    let halves =
        [effective_emissivity_parallel_plates(0.3, 0.04), effective_emissivity_parallel_plates(0.04, 0.8)];
    near(series(&halves), 0.01902, 5e-6);
}

/// Incropera, 6th edition, example 13.5: a cryogenic tube in a tube gains 0.50 W/m, 49.55 % less with a shield.
#[test]
fn concentric_tubes_with_a_shield() {
    let tube = |e_inner: f64, d_inner: f64, e_outer: f64, d_outer: f64| {
        effective_emissivity_concentric(e_inner, e_outer, d_inner / d_outer) * PI * d_inner
    };
    let bare = tube(0.02, 0.02, 0.05, 0.05);
    near(radiation(bare, 300.0, 77.0), 0.50, 0.005);
    let shielded = series(&[tube(0.02, 0.02, 0.02, 0.035), tube(0.02, 0.035, 0.05, 0.05)]);
    near(100.0 * (shielded / bare - 1.0), -49.55, 0.005);
}

/// Cengel and Ghajar, Heat and Mass Transfer, 5th edition, problem 13-163: concentric spheres of 45 and 280 degC,
/// emissivities 0.25 and 0.7, diameters 0.3 to 1: 1169 W per m^2 of the inner one (K = degC + 273).
#[test]
fn concentric_spheres() {
    let gr = effective_emissivity_concentric(0.25, 0.7, 0.3 * 0.3);
    near(radiation(gr, 553.0, 318.0), 1169.0, 0.5 + ROUNDED_SIGMA * 1169.0);
}

/// Holman, Heat Transfer, example 7-7: a pipe of 0.3048 m, 250 degC, in air of 15 degC by the simplified relation
/// h = 1.32 (dT/d)^(1/4): 1.57 kW/m.
#[test]
fn natural_convection_of_a_pipe() {
    let d: f64 = 0.3048;
    let c = film(1.32 / d.powf(0.25), PI * d);
    near(power_conductance(c, 0.25, 235.0) * 235.0, 1570.0, 5.0);
}

/// IEC 60034-1: copper resistances at two temperatures are as (235 + t2) / (235 + t1), t in degC.
#[test]
fn copper_by_the_rule_of_235() {
    near(linear_temperature_factor(1.0 / (235.0 + 20.0), 368.15, 293.15), 330.0 / 255.0, 1e-12);
}

/// Modelica.Electrical.Machines.Thermal.convertResistance: alpha at another reference is alpha20 /
/// (1 + alpha20 (T_ref - 293.15)); the Motor example of the library has 0.00303 at 368.15 K.
#[test]
fn copper_from_another_reference() {
    let to_hot = linear_temperature_factor(0.00393, 368.15, 293.15);
    let alpha = 0.00393 / to_hot;
    near(alpha, 0.00303, 1e-5);
    let found = to_hot * linear_temperature_factor(alpha, 420.0, 368.15);
    near(found, linear_temperature_factor(0.00393, 420.0, 293.15), 1e-14);
}

#[test]
fn joule_heat_of_a_kettle() {
    near(joule(230.0, 52.9), 1000.0, 1e-9); // 230^2 / 52.9
}

/// Schoolbook: 10 g of ice of -20 degC (2.1 J/(g K), 336 J/g) to water of 40 degC (4.2 J/(g K)): 420 + 3360 + 1680
/// = 5460 J (Careers360, school questions).
#[test]
fn ice_to_water() {
    let ice =
        Melting { c_solid: 21.0, c_liquid: 42.0, latent_heat: 3360.0, solidus: 273.15, liquidus: 273.15 };
    let start = ice.enthalpy(253.15);
    near(start, -420.0, 1e-9);
    near(ice.enthalpy(313.15) - start, 5460.0, 1e-9);
    near(ice.temperature(start + 5460.0), 313.15, 1e-12);
    near(ice.temperature(start + 420.0 + 1680.0), 273.15, 1e-12);
    near(ice.melted(start + 420.0 + 1680.0), 0.5, 1e-12);
    near(ice.heat_of_melting(), 3360.0, 0.0);
}
