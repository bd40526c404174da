//! Convection from the walls of housings: in a wind, and by the rules for gearboxes of ISO/TR 14179-2.

use lptn_units::Scalar;

use crate::convection::AREA;
use crate::declare::{Confidence, FieldDeclaration, Group, Law, LawDeclaration};
use crate::fluid::{DENSITY, EXPANSION, Fluid, VISCOSITY, length, of_fluid, prandtl, reynolds};
use crate::forced_convection::{SPEED, nusselt_flat_plate};
use crate::free_convection::{
    GRAVITY, VerticalPlate, magnitude, nusselt_vertical_plate, rayleigh, rayleigh_within,
};

/// Film coefficient of forced and natural convection together, in W/(m^2 K):
/// h = (h_F^3 + h_N^3)^(1/3).
///
/// * `forced`, `natural`: the coefficient of each alone, in W/(m^2 K), at least 0
///
/// The flow helps the natural one or crosses it; against it the powers would be subtracted. Source:
/// Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equation 9.64.
pub fn combined<S: Scalar>(forced: S, natural: S) -> S {
    (forced.powi(3) + natural.powi(3)).powf(1.0 / 3.0)
}

/// Film coefficient of a flow along the natural one or against it, in W/(m^2 K):
/// h^3 = |h_F^3 + h_N^3| or |h_F^3 - h_N^3|.
///
/// * `forced`, `natural`: the coefficient of each alone, in W/(m^2 K), at least 0
/// * `opposed`: true if they run against each other
///
/// If both are equal and opposed, the printed h is 0 with no slope, unlike any film: |x| is taken
/// as (x^2 + (0.01 (h_F^3 + h_N^3))^2)^(1/2), larger by 1.7e-5 of h if one of them is 0 and by
/// 1.5e-4 if the cubes are as 1 to 2. Source: Incropera et al., 6th edition, equation 9.64.
///
/// ```
/// use lptn_laws::along;
/// assert!((along(2.0_f64, 1.0, true) - 7_f64.cbrt()).abs() < 1e-4);
/// assert!((along(2.0_f64, 1.0, false) - 9_f64.cbrt()).abs() < 1e-4);
/// ```
pub fn along<S: Scalar>(forced: S, natural: S, opposed: bool) -> S {
    let [forced, natural] = [forced, natural].map(|h| h.powi(3));
    let sum = forced + natural;
    let left = if opposed { forced - natural } else { sum };
    let blurred = sum * S::from_f64(BLUR);
    (left * left + blurred * blurred).powf(1.0 / 6.0)
}

/// The share of both cubes that remains if they are equal and opposed.
const BLUR: f64 = 0.01;

/// Film coefficient of a gearbox in still air, in W/(m^2 K): h = 18 H^(-1/10) (|dT|/T)^(3/10).
///
/// * `height`: H of the housing in m, above 0
/// * `t_from`, `t_to`: temperatures of housing and air in K, in any order; T is the colder
///
/// Convection alone. |dT| is smooth at 0 as in [`rayleigh`]. Source: W. Funck (1985) in ISO/TR
/// 14179-2; not read in the primary source.
pub fn gearbox_wall<S: Scalar>(height: S, t_from: S, t_to: S) -> S {
    let share = magnitude(t_from - t_to) / t_from.min(t_to);
    S::from_f64(18.0) * height.powf(-0.1) * share.powf(0.3)
}

/// Film coefficient of a gearbox in a flow of air, in W/(m^2 K): h = 0.0086 Re'^0.64 / L with
/// Re' = sqrt(Re^2 + Gr/2.5).
///
/// * `re`: Reynolds number of the length, at least 0
/// * `gr`: Grashof number of the length, above 0
/// * `length`: L in m, along the flow, above 0
///
/// Convection alone, in air: its conductivity is in the factor. Source: as for [`gearbox_wall`].
pub fn gearbox_wall_blown<S: Scalar>(re: S, gr: S, length: S) -> S {
    let both = re * re + gr / S::from_f64(2.5);
    S::from_f64(0.0086) * both.powf(0.32) / length
}

/// A wall in a wind.
#[derive(Debug)]
pub(crate) struct WallInWind;

impl WallInWind {
    /// Re, Ra, Pr and the film coefficient.
    fn state<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> ([S; 3], S) {
        let fluid = Fluid::of(values);
        let (expansion, speed, length, height) = (values[4], values[5], values[6], values[7]);
        let re = fluid.reynolds(speed, length);
        let ra = rayleigh(fluid, expansion, from - to, height);
        let pr = fluid.prandtl();
        let one = S::from_f64(1.0);
        let forced = fluid.film(nusselt_flat_plate(re, pr), length, one);
        let natural = fluid.film(nusselt_vertical_plate(ra, pr), height, one);
        ([re, ra, pr], combined(forced, natural))
    }
}

impl Law for WallInWind {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "wall_in_wind",
        sentence: "A vertical surface with a flow that crosses it horizontally, down to no flow.",
        equation: "Q = (h_F^3 + h_N^3)^(1/3) A (T_from - T_to), h_F of a flat plate, h_N of a \
            vertical plate",
        fields: of_fluid![
            EXPANSION,
            SPEED,
            length("length", "length of the surface along the flow", "\"0.3 m\""),
            length("height", "height of the surface", "\"25 cm\""),
            AREA,
        ],
        validity: "The flow is horizontal: one that comes from above works against the other.",
        groups: &[
            reynolds(0.0, 1e8),
            rayleigh_within("Rayleigh number", 0.0, 1e12),
            prandtl(0.6, 60.0),
        ],
        source: "Incropera et al., 6th edition, equation 9.64 with 7.30, 7.38 and 9.26",
        ..VerticalPlate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        Self::state(values, ends).1 * values[8]
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        Self::state(values, ends).0.map(Some).to_vec()
    }
}

/// A wall with a flow up or down along it.
#[derive(Debug)]
pub(crate) struct WallInVerticalFlow;

impl WallInVerticalFlow {
    /// Re, Ra, Pr, the ratio of the cubes if they oppose each other, and the film coefficient.
    fn state<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> ([S; 3], Option<S>, S) {
        let fluid = Fluid::of(values);
        let (expansion, speed, height) = (values[4], values[5], values[6]);
        let re = fluid.reynolds(speed, height);
        let ra = rayleigh(fluid, expansion, from - to, height);
        let pr = fluid.prandtl();
        let one = S::from_f64(1.0);
        let forced = fluid.film(nusselt_flat_plate(re, pr), height, one);
        let natural = fluid.film(nusselt_vertical_plate(ra, pr), height, one);
        let opposed = speed.value() * (from - to).value() < 0.0;
        let share = || (forced.min(natural) / forced.max(natural)).powi(3);
        ([re, ra, pr], opposed.then(share), along(forced, natural, opposed))
    }
}

impl Law for WallInVerticalFlow {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "wall_in_vertical_flow",
        sentence: "A vertical surface with a flow that runs up or down along it, down to no flow.",
        equation: "Q = |h_F^3 +- h_N^3|^(1/3) A (T_from - T_to), h_F of a flat plate, h_N of a \
            vertical plate, + up a warm or down a cold wall",
        fields: of_fluid![
            EXPANSION,
            FieldDeclaration { meaning: "velocity of the flow, positive upwards", ..SPEED },
            length("height", "height of the surface", "\"25 cm\""),
            AREA,
        ],
        validity: "`from` is the wall. If the flow opposes the natural one and the cubes of both \
            are nearer than 1 to 2, they nearly cancel, which is reported.",
        groups: &[
            reynolds(0.0, 1e8),
            rayleigh_within("Rayleigh number", 0.0, 1e12),
            prandtl(0.6, 60.0),
            Group {
                name: "cancelled share",
                meaning: "share of h^3 that flows against each other cancel",
                from: 0.0,
                to: 0.5,
            },
        ],
        source: "Incropera et al., 6th edition, equation 9.64 with 7.30, 7.38 and 9.26",
        ..VerticalPlate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        Self::state(values, ends).2 * values[7]
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let (groups, share, _) = Self::state(values, ends);
        groups.map(Some).into_iter().chain([share]).collect()
    }
}

/// The wall of a gearbox in still air.
#[derive(Debug)]
pub(crate) struct GearboxWall;

impl Law for GearboxWall {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "gearbox_wall",
        sentence: "The housing of a gearbox in still air.",
        equation: "Q = 18 height^(-0.1) (|dT|/T)^0.3 A (T_from - T_to), height in m, T of the \
            colder end in K, h in W/(m^2 K)",
        fields: &[length("height", "height of the surface", "\"25 cm\""), AREA],
        validity: "Air; convection alone: add a [radiation] for the heat that the housing \
            radiates.",
        groups: &[],
        source: "Funck (1985) in ISO/TR 14179-2",
        confidence: Confidence::Medium,
        ..VerticalPlate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> S {
        gearbox_wall(values[0], from, to) * values[1]
    }

    fn groups(_: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        Vec::new()
    }
}

/// The wall of a gearbox in a flow of air.
#[derive(Debug)]
pub(crate) struct GearboxWallBlown;

impl Law for GearboxWallBlown {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "gearbox_wall_blown",
        sentence: "The housing of a gearbox in a flow of air.",
        equation: "Q = 0.0086 Re'^0.64 / length A (T_from - T_to), Re' = sqrt(Re^2 + Gr/2.5), \
            length in m, h in W/(m^2 K)",
        fields: &[
            DENSITY,
            VISCOSITY,
            EXPANSION,
            SPEED,
            length("length", "length of the surface along the flow", "\"0.3 m\""),
            AREA,
        ],
        ..GearboxWall::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> S {
        let (nu, expansion) = (values[1] / values[0], values[2]);
        let (speed, length) = (values[3], values[4]);
        let re = speed.abs() * length / nu;
        let drive = S::from_f64(GRAVITY) * expansion * magnitude(from - to);
        let gr = drive * length.powi(3) / (nu * nu);
        gearbox_wall_blown(re, gr, length) * values[5]
    }
}
