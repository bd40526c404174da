//! `[churning]`: gears and shafts that turn in oil.

use std::f64::consts::PI;

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{FieldDeclaration, KindDeclaration, Law, LawDeclaration, Range};
use crate::loss::{LOSS, SPEED, THIN_OIL, VISCOSITY, length, mm, mm2_per_s, rpm, viscosity};

/// `[churning]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Churning: KindDeclaration = KindDeclaration {
    section: "churning",
    sentence: "The churning of a part of a gear or shaft that dips into oil.",
    selector: Some("part"),
    example: "{ into = \"sump\", speed = \"1500 rpm\", D = \"120 mm\", nu = \"60 mm^2/s\", dip = 0.5, \
        part = \"sides\" }",
    elsewhere: &[
        ("n", "the speed of rotation is `speed`"),
        ("omega", "the speed of rotation is `speed`"),
        ("P", "a heat that is known belongs in [source]"),
    ],
    later: &[],
    surface: None,
};

/// A part that turns in oil: the diameter D in m, the share of it that dips in, the viscosity in
/// m^2/s, the constant A_g of the arrangement, and the speed in rad/s, of either sign.
#[derive(Clone, Copy, Debug)]
pub struct Churned<S> {
    /// Outer diameter D in m, above 0.
    pub diameter: S,
    /// Factor f_g of dipping in: 0 above the oil, 1 below it.
    pub dip: S,
    /// Kinematic viscosity nu in m^2/s, at least 0.
    pub nu: S,
    /// Constant A_g of the arrangement, above 0; 0.2.
    pub arrangement: S,
    /// omega in rad/s, of either sign.
    pub speed: S,
}

impl<S: Scalar> Churned<S> {
    /// The churning of a smooth cylinder of this length in m, in W: 7.37 f_g nu n^3 D^4.7 L / (A_g
    /// 1e26) in kW, of nu in mm^2/s, n in rpm, D and L in mm.
    ///
    /// Source: ISO/TR 14179-1, not read in the original.
    pub fn cylinder(&self, length: S) -> S {
        self.common(7.37, 4.7) * mm(length)
    }

    /// The churning of both smooth sides of a disc, in W: 1.474 f_g nu n^3 D^5.7 / (A_g 1e26) in kW.
    ///
    /// Source as in [`Churned::cylinder`].
    pub fn sides(&self) -> S {
        self.common(1.474, 5.7)
    }

    /// The churning of the teeth, in W: 7.37 f_g nu n^3 D^4.7 b R_f / (A_g 1e26 sqrt(tan beta)) in
    /// kW, with R_f = 7.93 - 4.648 / m_t, and beta of at least 10 degrees.
    ///
    /// * `width`: b in m, above 0
    /// * `module`: m_t, transverse, in m, above 0.586 mm: below R_f is 0
    /// * `helix`: beta in rad, of either sign
    ///
    /// Source as in [`Churned::cylinder`].
    pub fn teeth(&self, width: S, module: S, helix: S) -> S {
        let rough = S::from_f64(7.93) - S::from_f64(4.648) / mm(module);
        let helix = S::from_f64(10.0 * PI / 180.0).max(helix.abs());
        let slope = helix.sin() / helix.cos();
        self.cylinder(width) * S::from_f64(0.0).max(rough) / slope.sqrt()
    }

    /// `constant f_g nu n^3 D^exponent / (A_g 1e26)` in W.
    fn common(&self, constant: f64, exponent: f64) -> S {
        let speed = rpm(self.speed).powi(3) * mm(self.diameter).powf(exponent);
        S::from_f64(constant * 1e-23) * self.dip * mm2_per_s(self.nu) * speed / self.arrangement
    }
}

const DIAMETER: FieldDeclaration = length("D", "outer diameter", "\"120 mm\"");

const DIP: FieldDeclaration = FieldDeclaration {
    range: Range::Fraction,
    ..FieldDeclaration::new("dip", Type::SCALAR, "factor of dipping in: 1 below the oil", "0.6")
};

const ARRANGEMENT: FieldDeclaration =
    FieldDeclaration::given("A_g", "constant of the arrangement", "0.2").or(0.2);

/// The first values of each law.
fn churned<S: Scalar>(values: &[S]) -> Churned<S> {
    Churned {
        speed: values[0],
        diameter: values[1],
        nu: values[2],
        dip: values[3],
        arrangement: values[4],
    }
}

/// A smooth cylinder.
#[derive(Debug)]
pub(crate) struct ChurnedCylinder;

impl Law for ChurnedCylinder {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "cylinder",
        sentence: "A smooth cylinder, such as a shaft.",
        equation: "Q = 7.37e-23 W f_g nu n^3 D^4.7 L / A_g",
        kinds: &[Kind::Churning],
        fields: &[
            SPEED,
            DIAMETER,
            VISCOSITY,
            DIP,
            ARRANGEMENT,
            length("length", "length in the oil", "\"80 mm\""),
        ],
        validity: "n in rpm, nu in mm^2/s, lengths in mm. Oil, not grease.",
        source: "ISO/TR 14179-1 (AGMA 6123 has the same form)",
        confidence: crate::Confidence::Medium,
        groups: &[THIN_OIL],
        ..LOSS
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        churned(values).cylinder(values[5])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        vec![viscosity::<Self>(values)]
    }
}

/// Both sides of a gear.
#[derive(Debug)]
pub(crate) struct ChurnedSides;

impl Law for ChurnedSides {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "sides",
        sentence: "The two smooth sides of a gear.",
        equation: "Q = 1.474e-23 W f_g nu n^3 D^5.7 / A_g",
        fields: &[SPEED, DIAMETER, VISCOSITY, DIP, ARRANGEMENT],
        ..ChurnedCylinder::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        churned(values).sides()
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        vec![viscosity::<Self>(values)]
    }
}

/// The teeth of a gear.
#[derive(Debug)]
pub(crate) struct ChurnedTeeth;

impl Law for ChurnedTeeth {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "teeth",
        sentence: "The teeth of a gear.",
        equation: "Q = 7.37e-23 W f_g nu n^3 D^4.7 b R_f / (A_g sqrt(tan beta)), R_f = 7.93 - 4.648 \
            / m_t",
        fields: &[
            SPEED,
            DIAMETER,
            VISCOSITY,
            DIP,
            ARRANGEMENT,
            length("width", "width of the teeth", "\"30 mm\""),
            length("module", "transverse module", "\"3 mm\""),
            FieldDeclaration {
                ..FieldDeclaration::new(
                    "helix_angle",
                    Type::of(Dimension::ANGLE),
                    "helix angle, of which at least 10 degrees count",
                    "\"15 deg\"",
                )
                .degrees(-60, 60)
                .or(0.0)
            },
        ],
        validity: "n in rpm, nu in mm^2/s, lengths in mm. Oil, not grease; modules above 0.586 mm.",
        ..ChurnedCylinder::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        churned(values).teeth(values[5], values[6], values[7])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        vec![viscosity::<Self>(values)]
    }
}
