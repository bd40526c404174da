//! Formulas with the ranges they are tested in. Inputs stand in the order of the function's
//! arguments.

use lptn_laws::{
    advection_from, advection_to, biot, cylinder, diffusion_time,
    effective_emissivity_parallel_plates, film, radiation_conductance, radiation_exchange_area,
    rod, slab, sphere, stream_from, stream_to,
};
use lptn_units::{Dual, Scalar};

/// The most inputs a law has.
pub(crate) const INPUTS: usize = 4;

/// One law, to be called on numbers and on dual numbers.
pub(crate) struct Law {
    pub(crate) name: &'static str,
    pub(crate) value: fn(&[f64]) -> f64,
    pub(crate) dual: fn(&[Dual<INPUTS>]) -> Dual<INPUTS>,
    /// Ranges of all inputs, without a kink inside: one row for each branch of the law.
    pub(crate) regimes: &'static [&'static [(f64, f64)]],
    /// States at kinks, at equal temperatures, at zero flow, at the ends of the valid range.
    pub(crate) edges: &'static [&'static [f64]],
}

macro_rules! law {
    ($name:literal, |$x:ident| $body:expr, [$($regime:expr),+], [$($edge:expr),+]) => {{
        fn law<S: Scalar>($x: &[S]) -> S {
            $body
        }
        Law {
            name: $name,
            value: law::<f64>,
            dual: law::<Dual<INPUTS>>,
            regimes: &[$(&$regime),+],
            edges: &[$(&$edge),+],
        }
    }};
}

const AREA: (f64, f64) = (1e-4, 2.0);
const CONDUCTIVITY: (f64, f64) = (0.02, 400.0);
const FILM: (f64, f64) = (2.0, 5000.0);
pub(crate) const KELVIN: (f64, f64) = (150.0, 900.0);
const SHARE: (f64, f64) = (0.02, 0.98);
const FORWARD: (f64, f64) = (0.5, 200.0);
const BACKWARD: (f64, f64) = (-200.0, -0.5);
const ENTHALPY: (f64, f64) = (1e4, 4e5);

pub(crate) fn laws() -> Vec<Law> {
    [conduction(), convection(), radiation(), advection(), lumps()].into_iter().flatten().collect()
}

fn conduction() -> Vec<Law> {
    vec![
        law!(
            "slab",
            |x| slab(x[0], x[1], x[2]),
            [[CONDUCTIVITY, AREA, (1e-4, 0.5)]],
            [[0.0, 1.0, 0.1], [400.0, 1.0, 1e-9]]
        ),
        law!(
            "cylinder",
            |x| cylinder(x[0], x[1], x[2], x[3]),
            [[CONDUCTIVITY, (0.01, 0.1), (0.12, 0.5), (0.01, 2.0)]],
            [[0.0, 0.1, 0.2, 1.0], [50.0, 0.1, 0.1 + 1e-9, 1.0]]
        ),
        law!(
            "sphere",
            |x| sphere(x[0], x[1], x[2]),
            [[CONDUCTIVITY, (0.01, 0.1), (0.12, 0.5)]],
            [[0.0, 0.1, 0.2], [50.0, 0.1, 0.1 + 1e-9], [50.0, 0.1, 1e9]]
        ),
        law!(
            "rod",
            |x| rod(x[0], x[1], x[2]),
            [[CONDUCTIVITY, (1e-3, 0.2), (0.01, 2.0)]],
            [[0.0, 0.01, 0.1], [400.0, 14e-9, 5e-6]]
        ),
    ]
}

fn convection() -> Vec<Law> {
    vec![law!("film", |x| film(x[0], x[1]), [[FILM, AREA]], [[0.0, 1.0]])]
}

fn radiation() -> Vec<Law> {
    vec![
        law!(
            "radiation_conductance",
            |x| radiation_conductance(x[0], x[1], x[2]),
            [[AREA, KELVIN, KELVIN]],
            [[0.04, 300.0, 300.0], [0.04, 0.0, 0.0], [0.04, 1200.0, 0.0], [0.0, 300.0, 400.0]]
        ),
        law!(
            "radiation_exchange_area",
            |x| radiation_exchange_area(x[0], x[1], x[2]),
            [[SHARE, AREA, SHARE]],
            [[0.0, 1.0, 0.0], [1.0, 1.0, 1.0]]
        ),
        law!(
            "effective_emissivity_parallel_plates",
            |x| effective_emissivity_parallel_plates(x[0], x[1]),
            [[SHARE, SHARE]],
            [[1.0, 1.0], [0.0, 1.0], [0.5, 0.0]]
        ),
    ]
}

fn advection() -> Vec<Law> {
    vec![
        law!(
            "advection_to",
            |x| advection_to(x[0], x[1], x[2]),
            [[FORWARD, KELVIN, KELVIN], [BACKWARD, KELVIN, KELVIN]],
            [
                [0.0, 350.0, 300.0],
                [-0.0, 300.0, 350.0],
                [20.0, 300.0, 300.0],
                [-20.0, 300.0, 300.0]
            ]
        ),
        law!(
            "advection_from",
            |x| advection_from(x[0], x[1], x[2]),
            [[FORWARD, KELVIN, KELVIN], [BACKWARD, KELVIN, KELVIN]],
            [
                [0.0, 350.0, 300.0],
                [-0.0, 300.0, 350.0],
                [20.0, 300.0, 300.0],
                [-20.0, 300.0, 300.0]
            ]
        ),
        law!(
            "stream_to",
            |x| stream_to(x[0], x[1], x[2]),
            [[(1e-3, 2.0), ENTHALPY, ENTHALPY], [(-2.0, -1e-3), ENTHALPY, ENTHALPY]],
            [[0.0, 2e5, 1e5], [-0.0, 1e5, 2e5], [0.1, 1e5, 1e5], [-0.1, 1e5, 1e5]]
        ),
        law!(
            "stream_from",
            |x| stream_from(x[0], x[1], x[2]),
            [[(1e-3, 2.0), ENTHALPY, ENTHALPY], [(-2.0, -1e-3), ENTHALPY, ENTHALPY]],
            [[0.0, 2e5, 1e5], [-0.0, 1e5, 2e5], [0.1, 1e5, 1e5], [-0.1, 1e5, 1e5]]
        ),
    ]
}

fn lumps() -> Vec<Law> {
    vec![
        law!(
            "biot",
            |x| biot(x[0], x[1], x[2]),
            [[FILM, (1e-4, 0.5), CONDUCTIVITY]],
            [[0.0, 0.01, 20.0]]
        ),
        law!(
            "diffusion_time",
            |x| diffusion_time(x[0], x[1], x[2], x[3]),
            [[(1e-4, 0.5), CONDUCTIVITY, (1.0, 2e4), (100.0, 5000.0)]],
            [[0.0, 20.0, 8000.0, 400.0]]
        ),
    ]
}
