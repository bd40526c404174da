//! `[seal]`: radial shaft seals.

use lptn_units::Scalar;

use crate::Kind;
use crate::declare::{FieldDeclaration, KindDeclaration, Law, LawDeclaration};
use crate::loss::{LOSS, SPEED, length, mm, rpm};

/// `[seal]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Seal: KindDeclaration = KindDeclaration {
    section: "seal",
    sentence: "The friction of a radial shaft seal.",
    selector: Some("model"),
    example: "{ into = \"a\", speed = \"1500 rpm\", d = \"50 mm\", model = \"shaft\" }",
    elsewhere: &[
        ("n", "the speed of rotation is `speed`"),
        ("omega", "the speed of rotation is `speed`"),
        ("P", "a heat that is known belongs in [source]"),
    ],
    later: &[],
    surface: None,
};

const SHAFT: FieldDeclaration = length("d", "diameter of the shaft below the lip", "\"50 mm\"");

/// Friction of a radial shaft seal: P = 7.69e-6 d^2 n in W, of d in mm and n in rpm.
///
/// * `diameter`: d of the shaft in m, above 0
/// * `speed`: omega in rad/s, of either sign
///
/// Source: ISO/TR 14179-2.
///
/// ```
/// let omega = 1000.0 * std::f64::consts::PI / 30.0;
/// assert!((lptn_laws::shaft_seal(0.05, omega) - 19.225).abs() < 1e-9);
/// ```
pub fn shaft_seal<S: Scalar>(diameter: S, speed: S) -> S {
    S::from_f64(7.69e-6) * mm(diameter).powi(2) * rpm(speed)
}

/// Friction of a lip seal: P = c d omega in W.
///
/// * `constant`: c in N m per mm of diameter, 3.737e-3 for fluoro rubber, 2.429e-3 for nitrile
///   rubber
/// * `diameter`: d of the shaft in m, above 0
/// * `speed`: omega in rad/s, of either sign
///
/// Source: ISO/TR 14179-1, not read in the original: its value for fluoro rubber and that of
/// ISO/TR 14179-2 are equal at 50.9 mm.
pub fn lip_seal<S: Scalar>(constant: f64, diameter: S, speed: S) -> S {
    S::from_f64(constant) * mm(diameter) * speed.abs()
}

/// After ISO/TR 14179-2.
#[derive(Debug)]
pub(crate) struct SealShaft;

impl Law for SealShaft {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "shaft",
        sentence: "A radial shaft seal, by the square of its diameter.",
        equation: "Q = 7.69e-6 W d^2 n",
        kinds: &[Kind::Seal],
        fields: &[SPEED, SHAFT],
        validity: "d in mm, n in rpm. Nitrile and fluoro rubber in oil.",
        source: "ISO/TR 14179-2",
        ..LOSS
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        shaft_seal(values[1], values[0])
    }
}

/// Fluoro rubber, after ISO/TR 14179-1.
#[derive(Debug)]
pub(crate) struct SealFkm;

impl Law for SealFkm {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "fkm",
        sentence: "A lip seal of fluoro rubber (FKM, Viton).",
        equation: "Q = 3.737e-3 N m d omega",
        validity: "d in mm. In oil.",
        source: "ISO/TR 14179-1",
        confidence: crate::Confidence::Medium,
        ..SealShaft::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        lip_seal(3.737e-3, values[1], values[0])
    }
}

/// Nitrile rubber, after ISO/TR 14179-1.
#[derive(Debug)]
pub(crate) struct SealNbr;

impl Law for SealNbr {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "nbr",
        sentence: "A lip seal of nitrile rubber (NBR, Buna-N).",
        equation: "Q = 2.429e-3 N m d omega",
        ..SealFkm::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        lip_seal(2.429e-3, values[1], values[0])
    }
}
