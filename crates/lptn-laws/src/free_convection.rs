//! Natural convection from plates and cylinders into a fluid at rest.
//!
//! All properties are those at the film temperature, the mean of surface and fluid.
//!
//! Printed formulas that do not meet at a limit of their ranges are joined at their intersection. A
//! jump of heat has no steady state and stops an integrator. The validity of each law says how it
//! differs from its source. For the same reason |dT| is sqrt(dT^2 + (1 mK)^2). If it matters which
//! side of a path is the surface, the name of the law says so (`upper_side_of_from`).

use lptn_units::Scalar;

use crate::Kind;
use crate::convection::{AREA, Film};
use crate::declare::{Extent, Form, Group, Law, LawDeclaration};
use crate::fluid::{EXPANSION, Fluid, length, of_fluid, prandtl};

/// Standard acceleration of gravity in m/s^2, exact by definition (CGPM 1901).
pub(crate) const GRAVITY: f64 = 9.806_65;

/// Difference of temperatures in K below which |dT| is smoothed: see [`rayleigh`].
const STILL: f64 = 1e-3;

/// Rayleigh number: Ra = g beta |dT| L^3 / (nu alpha), dimensionless.
///
/// * `fluid`: at the film temperature
/// * `expansion`: volumetric expansion coefficient beta in 1/K, above 0
/// * `difference`: dT in K, of either sign
/// * `length`: L in m, above 0
///
/// Powers of |dT| below 1 have no slope at 0, and a film without conductance cuts a node off. So
/// |dT| is taken as sqrt(dT^2 + (1 mK)^2), which is smooth. A film proportional to Ra^(1/3) is then
/// too large by 1.7e-7 of itself at 1 K and by 1.7e-5 at 0.1 K, others by less. At dT = 0 it is
/// that of 1 mK, and carries no heat.
///
/// Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, equation 9.25.
pub fn rayleigh<S: Scalar>(fluid: Fluid<S>, expansion: S, difference: S, length: S) -> S {
    let difference = magnitude(difference);
    let Fluid { conductivity, density, specific_heat, viscosity } = fluid;
    let drive = S::from_f64(GRAVITY) * expansion * difference * length.powi(3);
    drive * density * density * specific_heat / (viscosity * conductivity)
}

/// The magnitude of a difference of temperatures in K, as in [`rayleigh`].
pub(crate) fn magnitude<S: Scalar>(difference: S) -> S {
    (difference * difference + S::from_f64(STILL * STILL)).sqrt()
}

/// The factor with which Churchill and Chu weigh Ra: (1 + (c/Pr)^(9/16))^(-16/9).
fn weight<S: Scalar>(pr: S, c: f64) -> S {
    let one = S::from_f64(1.0);
    one / (one + (S::from_f64(c) / pr).powf(9.0 / 16.0)).powf(16.0 / 9.0)
}

/// Mean Nusselt number of a vertical plate, over its height.
///
/// Nu = (0.825 + 0.387 Ra^(1/6) / (1 + (0.492/Pr)^(9/16))^(8/27))^2
///
/// * `ra`: Rayleigh number of the height, at least 0, at most 1e12; it is laminar below 1e9
/// * `pr`: Prandtl number, above 0
///
/// Source: S. W. Churchill and H. H. S. Chu, International Journal of Heat and Mass Transfer 18
/// (1975) 1323; Incropera et al., 6th edition, equation 9.26.
///
/// ```
/// // Gr = 2.63e9, Pr = 0.69: the library ht (Caleb Bell) prints 147.16185
/// let nu = lptn_laws::nusselt_vertical_plate(0.69 * 2.63e9, 0.69);
/// assert!((nu - 147.161_85).abs() < 5e-6);
/// ```
pub fn nusselt_vertical_plate<S: Scalar>(ra: S, pr: S) -> S {
    let root = (ra * weight(pr, 0.492)).powf(1.0 / 6.0);
    (S::from_f64(0.825) + S::from_f64(0.387) * root).powi(2)
}

/// Mean Nusselt number of a long horizontal cylinder, over its diameter.
///
/// Nu = (0.60 + 0.387 Ra^(1/6) / (1 + (0.559/Pr)^(9/16))^(8/27))^2
///
/// * `ra`: Rayleigh number of the diameter, at least 0, at most 1e12
/// * `pr`: Prandtl number, above 0
///
/// Source: S. W. Churchill and H. H. S. Chu, International Journal of Heat and Mass Transfer 18
/// (1975) 1049; Incropera et al., 6th edition, equation 9.34.
pub fn nusselt_horizontal_cylinder<S: Scalar>(ra: S, pr: S) -> S {
    let root = (ra * weight(pr, 0.559)).powf(1.0 / 6.0);
    (S::from_f64(0.60) + S::from_f64(0.387) * root).powi(2)
}

/// Mean Nusselt number of a horizontal plate that drives the fluid away: the upper side of a warm
/// plate, the lower side of a cold one.
///
/// Nu = 0.54 Ra^(1/4) or 0.15 Ra^(1/3), whichever is larger
///
/// * `ra`: Rayleigh number of the length A/P, area over perimeter; 1e4 to 1e11
///
/// The source changes from the first to the second at Ra = 1e7, with a jump of 6 % in Nu. Here the
/// change is at their intersection, 4.7e6. Source: W. H. McAdams, Heat Transmission, 3rd edition
/// (McGraw-Hill 1954), page 180; Incropera et al., 6th edition, equations 9.30 and 9.31.
pub fn nusselt_plate_driven<S: Scalar>(ra: S) -> S {
    let laminar = S::from_f64(0.54) * ra.powf(0.25);
    laminar.max(S::from_f64(0.15) * ra.powf(1.0 / 3.0))
}

/// Mean Nusselt number of a horizontal plate with a still layer of fluid: the lower side of a warm
/// plate, the upper side of a cold one.
///
/// Nu = 0.27 Ra^(1/4)
///
/// * `ra`: Rayleigh number of the length A/P, area over perimeter; 1e5 to 1e10
///
/// Source: as for [`nusselt_plate_driven`], equation 9.32.
pub fn nusselt_plate_layered<S: Scalar>(ra: S) -> S {
    S::from_f64(0.27) * ra.powf(0.25)
}

/// The fluid, Ra and Pr, from the fields that begin with those of [`BODY`]; the length comes next.
fn state<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> (Fluid<S>, S, S) {
    let fluid = Fluid::of(values);
    (fluid, rayleigh(fluid, values[4], from - to, values[5]), fluid.prandtl())
}

/// The common part of these laws.
const BODY: LawDeclaration = LawDeclaration {
    kinds: &[Kind::Convection],
    named: true,
    reads_ends: true,
    form: Form::Other,
    extent: Extent::Divided(&["area"]),
    ..Film::DECLARATION
};

/// Rayleigh numbers in a range.
pub(crate) const fn rayleigh_within(meaning: &'static str, from: f64, to: f64) -> Group {
    Group { name: "Ra", meaning, from, to }
}

/// A vertical plate.
#[derive(Debug)]
pub(crate) struct VerticalPlate;

impl Law for VerticalPlate {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "vertical_plate",
        sentence: "A vertical surface in a fluid at rest.",
        equation: "Q = Nu k / height A (T_from - T_to), Nu = (0.825 + 0.387 Ra^(1/6) / (1 + \
            (0.492/Pr)^(9/16))^(8/27))^2",
        fields: of_fluid![EXPANSION, length("height", "height of the surface", "\"25 cm\""), AREA,],
        validity: "One temperature over the height; a cylinder counts as a plate if its diameter \
            is at least 35 height / Gr^(1/4).",
        groups: &[rayleigh_within("Rayleigh number", 0.0, 1e12)],
        source: "Churchill and Chu, Int. J. Heat Mass Transfer 18 (1975) 1323; Incropera et al., \
            6th edition, equation 9.26",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        let (fluid, ra, pr) = state(values, ends);
        fluid.film(nusselt_vertical_plate(ra, pr), values[5], values[6])
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        vec![Some(state(values, ends).1)]
    }
}

/// A horizontal cylinder.
#[derive(Debug)]
pub(crate) struct HorizontalCylinder;

impl Law for HorizontalCylinder {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "horizontal_cylinder",
        sentence: "The outer surface of a long horizontal cylinder in a fluid at rest.",
        equation: "Q = Nu k / diameter A (T_from - T_to), Nu = (0.60 + 0.387 Ra^(1/6) / (1 + \
            (0.559/Pr)^(9/16))^(8/27))^2",
        fields: of_fluid![
            EXPANSION,
            length("diameter", "outer diameter of the cylinder", "\"80 mm\""),
            AREA,
        ],
        validity: "One temperature around it; longer than wide.",
        groups: &[rayleigh_within("Rayleigh number", 0.0, 1e12)],
        source: "Churchill and Chu, Int. J. Heat Mass Transfer 18 (1975) 1049; Incropera et al., \
            6th edition, equation 9.34",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        let (fluid, ra, pr) = state(values, ends);
        fluid.film(nusselt_horizontal_cylinder(ra, pr), values[5], values[6])
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        VerticalPlate::groups(values, ends)
    }
}

/// A side of a horizontal plate.
#[derive(Clone, Copy)]
enum Side {
    Upper,
    Lower,
}

impl Side {
    /// True if this side of `from` drives the fluid away, false if the fluid lies still; `None` if
    /// the temperatures are equal.
    fn drives<S: Scalar>(self, [from, to]: [S; 2]) -> Option<bool> {
        let warmer = from.value() > to.value();
        let differ = warmer || from.value() < to.value();
        differ.then_some(match self {
            Self::Upper => warmer,
            Self::Lower => !warmer,
        })
    }

    fn conductance<S: Scalar>(self, values: &[S], ends: [S; 2]) -> S {
        let (fluid, ra, _) = state(values, ends);
        let nusselt = match self.drives(ends) {
            Some(true) => nusselt_plate_driven(ra),
            _ => nusselt_plate_layered(ra),
        };
        fluid.film(nusselt, values[5], values[6])
    }

    fn groups(self, values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let (_, ra, pr) = state(values, ends);
        let if_drives = |wanted| self.drives(ends).filter(|drives| *drives == wanted).map(|_| ra);
        vec![if_drives(true), if_drives(false), Some(pr)]
    }
}

/// The upper side of a horizontal plate.
#[derive(Debug)]
pub(crate) struct UpperSide;

impl Law for UpperSide {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "upper_side_of_from",
        sentence: "The upper side of `from`, a horizontal plate, in a fluid at rest; the formula \
            follows from the warmer of the two.",
        equation: "Q = Nu k / length A (T_from - T_to), Nu = max(0.54 Ra^(1/4), 0.15 Ra^(1/3)) \
            while `from` is the warmer, else 0.27 Ra^(1/4)",
        fields: of_fluid![
            EXPANSION,
            length("length", "area of the plate over its perimeter", "\"30 mm\""),
            AREA,
        ],
        validity: "One temperature over the plate; nothing above it within some lengths. The \
            source changes at Ra = 1e7, lptn at the crossing of the two, 4.7e6.",
        groups: &[
            rayleigh_within("Rayleigh number of a fluid that rises or sinks away", 1e4, 1e11),
            rayleigh_within("Rayleigh number of a fluid that lies still", 1e5, 1e10),
            prandtl(0.7, f64::INFINITY),
        ],
        source: "McAdams, Heat Transmission, 3rd edition, page 180; Incropera et al., 6th \
            edition, equations 9.30 to 9.32",
        ..BODY
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        Side::Upper.conductance(values, ends)
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        Side::Upper.groups(values, ends)
    }
}

/// The lower side of a horizontal plate.
#[derive(Debug)]
pub(crate) struct LowerSide;

impl Law for LowerSide {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "lower_side_of_from",
        sentence: "The lower side of `from`, a horizontal plate, in a fluid at rest; the formula \
            follows from the warmer of the two.",
        equation: "Q = Nu k / length A (T_from - T_to), Nu = 0.27 Ra^(1/4) while `from` is the \
            warmer, else max(0.54 Ra^(1/4), 0.15 Ra^(1/3))",
        validity: "One temperature over the plate; nothing below it within some lengths. The \
            source changes at Ra = 1e7, lptn at the crossing of the two, 4.7e6.",
        ..UpperSide::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        Side::Lower.conductance(values, ends)
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        Side::Lower.groups(values, ends)
    }
}
