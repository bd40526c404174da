//! `[bearing]`: rolling bearings.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{FieldDeclaration, Hints, KindDeclaration, Law, LawDeclaration};
use crate::loss::{LOSS, SPEED, THIN_OIL, VISCOSITY, length, mm, mm2_per_s, rpm, viscosity};

/// `[bearing]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Bearing: KindDeclaration = KindDeclaration {
    section: "bearing",
    sentence: "The friction of a rolling bearing.",
    selector: Some("model"),
    example: "{ into = \"a\", speed = \"1500 rpm\", model = \"no_load\", d_m = \"60 mm\", f0 = 2, nu \
        = \"60 mm^2/s\" }",
    elsewhere: &[
        ("n", "the speed of rotation is `speed`"),
        ("omega", "the speed of rotation is `speed`"),
        ("P", "a heat that is known belongs in [source]"),
    ],
    later: &[],
    surface: None,
};

const MEAN_DIAMETER: FieldDeclaration =
    length("d_m", "mean diameter, half of bore and outer diameter together", "\"60 mm\"");

/// The least (nu n)^(2/3) of [`bearing_no_load`], with nu n in mm^2/s rpm: below it the torque is
/// constant.
const LEAST: f64 = 160.0;

/// Friction of a bearing without load: P = M0 omega, in W, with M0 = 1e-7 f0 (nu n)^(2/3) d_m^3 in N
/// mm, and at least 160e-7 f0 d_m^3.
///
/// * `d_m`: mean diameter in m, above 0
/// * `f0`: factor of type and lubrication, above 0: deep groove ball bearings 0.7 to 2 with grease,
///   2 in a bath of oil
/// * `nu`: kinematic viscosity in m^2/s at least 0, of the base oil of a grease
/// * `speed`: omega in rad/s, of either sign
///
/// Source: A. Palmgren, Grundlagen der Wälzlagertechnik; T. A. Harris, Rolling Bearing Analysis. The
/// constant branch is printed for nu n < 2000 mm^2/s rpm, where the other one is 0.8 % lower; here
/// they meet where they are equal, at 160^1.5 = 2023.86.
///
/// ```
/// // P in kW is 1e-10 f0 d_m^3 (nu n)^(2/3) n / 9549 as ISO/TR 14179-1 has it
/// let (n, omega) = (1500.0_f64, 1500.0 * std::f64::consts::PI / 30.0);
/// let power = lptn_laws::bearing_no_load(0.06, 2.0, 60e-6, omega);
/// let printed = 1e3 * 1e-10 * 2.0 * 60f64.powi(3) * (60.0 * n).powf(2.0 / 3.0) * n / 9549.0;
/// assert!((power - printed).abs() < 1e-4 * printed);
/// ```
pub fn bearing_no_load<S: Scalar>(d_m: S, f0: S, nu: S, speed: S) -> S {
    let rolled = (mm2_per_s(nu) * rpm(speed)).powf(2.0 / 3.0);
    let torque = S::from_f64(1e-10) * f0 * S::from_f64(LEAST).max(rolled) * mm(d_m).powi(3);
    torque * speed.abs()
}

/// Friction of a bearing by its load: P = f1 P1 d_m omega, in W.
///
/// * `d_m`: mean diameter in m, above 0
/// * `f1`: coefficient of type and load, above 0: z (P0/C0)^y, of deep groove ball bearings z =
///   0.0006 to 0.0009 and y = 0.55; cylindrical rollers 0.0002 to 0.0004
/// * `load`: P1, the load that decides the moment, in N, at least 0
/// * `speed`: omega in rad/s, of either sign
///
/// Source: A. Palmgren, Grundlagen der Wälzlagertechnik; T. A. Harris, Rolling Bearing Analysis.
pub fn bearing_load<S: Scalar>(d_m: S, f1: S, load: S, speed: S) -> S {
    f1 * load * d_m * speed.abs()
}

/// The part without load.
#[derive(Debug)]
pub(crate) struct BearingNoLoad;

impl Law for BearingNoLoad {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "no_load",
        sentence: "The friction of a rolling bearing without load, which is that of its lubricant.",
        equation: "Q = M0 omega, M0 = 1e-7 N mm f0 (nu n)^(2/3) d_m^3",
        kinds: &[Kind::Bearing],
        fields: &[
            SPEED,
            MEAN_DIAMETER,
            FieldDeclaration::given("f0", "factor of type and lubrication", "2"),
            VISCOSITY,
        ],
        validity: "M0 with n in rpm, nu in mm^2/s, d_m in mm. Below nu n = 2024 mm^2/s rpm M0 is \
            constant (printed for 2000, where the two branches differ by 0.8 %). f0: deep groove \
            ball 0.7 to 2 with grease, 2 in oil, 4 with a jet; cylindrical roller 0.6 to 1, 2.2 to \
            4, 2.2 to 4; taper 6, 6, 8 to 10; needle 12, 12, 24.",
        source: "A. Palmgren, Grundlagen der Wälzlagertechnik; T. A. Harris, Rolling Bearing \
            Analysis; ISO/TR 14179-1",
        groups: &[THIN_OIL],
        ..LOSS
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        bearing_no_load(values[1], values[2], values[3], values[0])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        vec![viscosity::<Self>(values)]
    }
}

/// The part of the load.
#[derive(Debug)]
pub(crate) struct BearingLoad;

impl Law for BearingLoad {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "load",
        sentence: "The friction of a rolling bearing that its load adds.",
        equation: "Q = f1 P1 d_m omega",
        kinds: &[Kind::Bearing],
        fields: &[
            SPEED,
            MEAN_DIAMETER,
            FieldDeclaration::given("f1", "coefficient of type and load", "0.0004"),
            FieldDeclaration {
                hints: Hints::GIVEN,
                ..FieldDeclaration::new(
                    "load",
                    Type::of(Dimension::FORCE),
                    "load P1 that determines the moment of friction",
                    "\"2 kN\"",
                )
                .from_zero()
            },
        ],
        validity: "f1 = z (P0/C0)^y: deep groove ball z 0.0006 to 0.0009, y 0.55; cylindrical \
            roller f1 0.0002 to 0.0004; taper 0.0004.",
        source: "A. Palmgren, Grundlagen der Wälzlagertechnik; T. A. Harris, Rolling Bearing \
            Analysis",
        confidence: crate::Confidence::Medium,
        ..LOSS
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        bearing_load(values[1], values[2], values[3], values[0])
    }
}
