//! Reference: numbers printed in textbooks. The digits of Incropera's and Holman's examples are
//! also found in the transcripts of FOSSEE (Python-Textbook-Companions, commit 206d035;
//! Scilab-TBC-Uploads, commit b1f5c3f).

use std::f64::consts::PI;

use lptn_laws::{
    biot, cylinder, diffusion_time, effective_emissivity_parallel_plates, film, melting_capacity,
    radiation_conductance, radiation_exchange_area, rod, slab, sphere,
};

/// Textbooks round the Stefan-Boltzmann constant to 5.67e-8, which is 6.6e-5 of it too little.
const ROUNDED_SIGMA: f64 = 6.7e-5;

#[track_caller]
fn near(found: f64, printed: f64, tolerance: f64) {
    assert!(
        (found - printed).abs() <= tolerance,
        "{found}, printed {printed} (tolerance {tolerance})"
    );
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

/// Incropera, 6th edition, example 1.2: bare steam pipe in a room, 998 W/m; 998.38 W in the
/// transcript.
#[test]
fn pipe_by_convection_and_radiation() {
    let area = PI * 0.07;
    let gr = radiation_exchange_area(0.8, area, 1.0);
    let radiated = radiation(gr, 473.15, 298.15);
    near(film(15.0, area) * 175.0 + radiated, 998.38, 0.005 + ROUNDED_SIGMA * radiated);
}

/// Incropera, 6th edition, example 3.2: a chip of 1e4 W/m^2 is at 75.3 degC; 75.31 in the
/// transcript.
#[test]
fn chip_on_epoxy_and_aluminium() {
    let below = series(&[film(1.0 / 0.9e-4, 1.0), slab(239.0, 1.0, 0.008), film(100.0, 1.0)]);
    near(25.0 + 1e4 / (film(100.0, 1.0) + below), 75.31, 0.005);
}

/// Incropera, 6th edition, example 5.1: a bead of 0.706 mm with a time constant of 1 s at 400
/// W/(m^2 K); its Biot number is far below 0.1. The time constant over the diffusion time is the
/// Biot number: h L / k.
#[test]
fn thermocouple_is_a_lump() {
    let (diameter, h, k, rho, cp) = (7.06e-4, 400.0, 20.0, 8500.0, 400.0);
    let length = diameter / 6.0;
    near(biot(h, length, k), 2.353e-3, 5e-7);
    let tau = rho * cp * length / h;
    near(tau, 1.0, 5e-4);
    near(diffusion_time(length, k, rho, cp) / tau, biot(h, length, k), 1e-15);
}

/// Incropera, 6th edition, example 5.4: pipeline wall of 40 mm steel, k = 63.9 W/(m K), in hot oil
/// of 500 W/(m^2 K): Bi = 0.313, no lump; after 8 min its Fourier number is 5.64 (alpha = 18.8e-6
/// m^2/s).
#[test]
fn pipeline_is_no_lump() {
    near(biot(500.0, 0.04, 63.9), 0.313, 5e-4);
    // rho = 7832 kg/m^3, cp = 434 J/(kg K)
    near(480.0 / diffusion_time(0.04, 63.9, 7832.0, 434.0), 5.64, 5e-3);
}

/// Incropera, 6th edition, example 3.3: the conductivity of a carbon nanotube between two heated
/// islands on beams; 3111.86 W/(m K) in the transcript.
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

/// Incropera, 6th edition, example 3.6: liquid nitrogen of 77 K in a sphere with evacuated silica
/// powder, air of 300 K with 20 W/(m^2 K): 13.06 W.
#[test]
fn sphere_of_nitrogen() {
    let powder = sphere(0.0017, 0.25, 0.275);
    let air = film(20.0, 4.0 * PI * 0.275 * 0.275);
    near(1.0 / powder, 17.02, 0.005);
    near(1.0 / air, 0.05, 0.005);
    near(series(&[powder, air]) * (300.0 - 77.0), 13.06, 0.005);
}

/// Holman, Heat Transfer, example 8-10: plates of 0.3 and 0.8 exchange 0.279 of black ones, 0.01902
/// with a shield of 0.04 between them.
#[test]
fn parallel_plates_with_a_shield() {
    near(effective_emissivity_parallel_plates(0.3, 0.8), 0.279, 5e-4);
    let halves = [
        effective_emissivity_parallel_plates(0.3, 0.04),
        effective_emissivity_parallel_plates(0.04, 0.8),
    ];
    near(series(&halves), 0.01902, 5e-6);
}

/// Schoolbook: 336 J/g melt 10 g of ice (Careers360, school questions): 3360 J, here taken up over
/// 2 K.
#[test]
fn ice_to_water() {
    near(melting_capacity(3360.0, 272.15, 274.15) * 2.0, 3360.0, 1e-9);
}
