//! Natural convection across the gap between two plates.
//!
//! All properties are those at the mean temperature of the plates. Radiation across the gap is a
//! separate path.

use lptn_units::Scalar;

use crate::convection::AREA;
use crate::declare::{Confidence, Group, Law, LawDeclaration};
use crate::fluid::{EXPANSION, Fluid, length, of_fluid, prandtl};
use crate::free_convection::{VerticalPlate, rayleigh, rayleigh_within};

/// Nusselt number of a horizontal gap that is heated from below, over its width.
///
/// Nu = 1 + 1.44 (1 - 1708/Ra)+ + ((Ra/5830)^(1/3) - 1)+, where (x)+ is the larger of x and 0
///
/// * `ra`: Rayleigh number of the gap, at least 0, at most 1e8
///
/// Source: K. G. T. Hollands, T. E. Unny, G. D. Raithby and L. Konicek, Journal of Heat Transfer 98
/// (1976) 189, without an inclination; Incropera et al., 6th edition, equation 9.54. The Modelica library IDEAS
/// has the same constants.
pub fn nusselt_gap_from_below<S: Scalar>(ra: S) -> S {
    let [zero, one] = [0.0, 1.0].map(S::from_f64);
    let ra = ra.max(one);
    let rolls = (one - S::from_f64(1708.0) / ra).max(zero);
    let late = ((ra / S::from_f64(5830.0)).powf(1.0 / 3.0) - one).max(zero);
    one + S::from_f64(1.44) * rolls + late
}

/// Nusselt number of a vertical gap filled with air, over its width.
///
/// Nu is the largest of 0.0605 Ra^(1/3), (1 + (0.104 Ra^0.293 / (1 + (6310/Ra)^1.36))^3)^(1/3)
/// and 0.242 (Ra/a)^0.272
///
/// * `ra`: Rayleigh number of the gap, at least 0, at most 2e7
/// * `aspect`: a, height over width of the gap, 5 to 110
///
/// Source: S. M. ElSherbiny, G. D. Raithby and K. G. T. Hollands, Journal of Heat Transfer 104
/// (1982) 96; not read in the primary source.
pub fn nusselt_gap_vertical<S: Scalar>(ra: S, aspect: S) -> S {
    let one = S::from_f64(1.0);
    let ra = ra.max(one);
    let turbulent = S::from_f64(0.0605) * ra.powf(1.0 / 3.0);
    let onset = one + (S::from_f64(6310.0) / ra).powf(1.36);
    let between = S::from_f64(0.104) * ra.powf(0.293) / onset;
    let between = (one + between.powi(3)).powf(1.0 / 3.0);
    turbulent.max(between).max(S::from_f64(0.242) * (ra / aspect).powf(0.272))
}

/// A horizontal gap.
#[derive(Debug)]
pub(crate) struct GapFromBelow;

impl GapFromBelow {
    fn rayleigh<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> S {
        rayleigh(Fluid::of(values), values[4], from - to, values[5])
    }
}

impl Law for GapFromBelow {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "gap_above_from",
        sentence: "A horizontal gap whose lower plate is `from`; the fluid is at rest while `to` \
            is the warmer.",
        equation: "Q = Nu k / gap A (T_from - T_to), Nu = 1 + 1.44 max(1 - 1708/Ra, 0) + \
            max((Ra/5830)^(1/3) - 1, 0) while `from` is the warmer, else 1",
        fields: of_fluid![EXPANSION, length("gap", "width of the gap", "\"20 mm\""), AREA,],
        validity: "A gap that is thin against the plates. A liquid of large Pr carries up to a \
            fifth more.",
        groups: &[
            rayleigh_within("Rayleigh number of a gap heated from below", 0.0, 1e8),
            prandtl(0.6, f64::INFINITY),
        ],
        source: "Hollands et al., J. Heat Transfer 98 (1976) 189; Incropera et al., 6th edition, \
            equation 9.54",
        ..VerticalPlate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        let nusselt = match ends[0].value() > ends[1].value() {
            true => nusselt_gap_from_below(Self::rayleigh(values, ends)),
            false => S::from_f64(1.0),
        };
        Fluid::of(values).film(nusselt, values[5], values[6])
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let ra = (ends[0] > ends[1]).then(|| Self::rayleigh(values, ends));
        vec![ra, Some(Fluid::of(values).prandtl())]
    }
}

/// A vertical gap.
#[derive(Debug)]
pub(crate) struct GapVertical;

impl Law for GapVertical {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "vertical_gap",
        sentence: "A vertical gap filled with air between two plates.",
        equation: "Q = Nu k / gap A (T_from - T_to), Nu = the largest of 0.0605 Ra^(1/3), (1 + \
            (0.104 Ra^0.293 / (1 + (6310/Ra)^1.36))^3)^(1/3), 0.242 (Ra gap/height)^0.272",
        fields: of_fluid![
            EXPANSION,
            length("gap", "width of the gap", "\"20 mm\""),
            length("height", "height of the gap", "\"0.5 m\""),
            AREA,
        ],
        validity: "Air; one temperature over each plate, and insulated ends.",
        groups: &[
            rayleigh_within("Rayleigh number of the gap", 0.0, 2e7),
            Group { name: "H/L", meaning: "height over width of the gap", from: 5.0, to: 110.0 },
            prandtl(0.6, 0.8),
        ],
        source: "ElSherbiny, Raithby and Hollands, J. Heat Transfer 104 (1982) 96",
        confidence: Confidence::Medium,
        ..VerticalPlate::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        let ra = GapFromBelow::rayleigh(values, ends);
        let nusselt = nusselt_gap_vertical(ra, values[6] / values[5]);
        Fluid::of(values).film(nusselt, values[5], values[7])
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let ra = GapFromBelow::rayleigh(values, ends);
        vec![Some(ra), Some(values[6] / values[5]), Some(Fluid::of(values).prandtl())]
    }
}
