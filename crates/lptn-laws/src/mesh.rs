//! `[mesh]`: pairs of cylindrical gears under load.
//!
//! If several laws have the same name, the keys select one of them. A mesh with `scuffing` is a
//! separate law with more fields and results. The columns of other meshes stay the same, and
//! nothing inside a law is optional.

use std::f64::consts::PI;

use lptn_units::{Dimension, Scalar, Type};

use crate::declare::{
    FieldDeclaration, Group, Hints, KindDeclaration, Law, LawDeclaration, Substance,
};
use crate::involute::{GearPair, Profile, joined};
use crate::loss::{LOSS, SPEED, THIN_OIL, VISCOSITY, length, mm, viscosity};
use crate::{Formula, Kind};

/// `[mesh]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const Mesh: KindDeclaration = KindDeclaration {
    section: "mesh",
    sentence: "The friction of the teeth of two cylindrical gears.",
    selector: Some("model"),
    example: "{ into = { pinion = 0.5, wheel = 0.5 }, speed = \"1500 rpm\", torque = \"50 N m\", z1 = 20, \
        z2 = 60, module = \"3 mm\", width = \"30 mm\", Ra = \"0.5 um\", nu = \"60 mm^2/s\", density = \"860 \
        kg/m^3\", model = \"external\" }",
    elsewhere: &[
        ("n", "the speed of the pinion is `speed`; in a planetary stage that against the carrier"),
        ("omega", "the speed of the pinion is `speed`"),
        ("P", "a heat that is known belongs in [source]"),
        ("eta", "the viscosity is `nu`, with the `density`"),
    ],
    later: &[],
    surface: None,
};

/// Upper bound of the coefficient of friction: the formula has none at low speed.
const MOST_FRICTION: f64 = 0.2;

/// The factor of gear loss H_V = pi (u + 1) / (z1 u cos beta_b) (1 - eps_alpha + eps_1^2 + eps_2^2),
/// with u - 1 for an internal mesh.
///
/// * `teeth`: z1 of the pinion, z2 of the wheel or ring, above 0; of a ring z2 > z1
/// * `internal`: true if the wheel is a ring with internal teeth
/// * `cos_base`: cosine of the helix angle at the base circle
/// * `contact`: eps_1 and eps_2, tip contact ratios of pinion and wheel; eps_alpha is their sum
///
/// The power lost is P mu H_V. It is never negative, for 1 - e1 - e2 + e1^2 + e2^2 >= 1/2. Source:
/// H. Ohlendorf, Verlustleistung und Erwärmung von Stirnrädern (TU München 1958); G. Niemann, H.
/// Winter, Maschinenelemente II. Internal: by its radii of curvature.
///
/// ```
/// let h_v = lptn_laws::gear_loss_factor([20.0, 60.0], false, 1.0, [0.8, 0.9]);
/// assert!((h_v - std::f64::consts::PI * 4.0 / 60.0 * (1.0 - 1.7 + 0.64 + 0.81)).abs() < 1e-14);
/// ```
pub fn gear_loss_factor<S: Scalar>(
    teeth: [S; 2],
    internal: bool,
    cos_base: S,
    contact: [S; 2],
) -> S {
    let (one, [z1, z2], [e1, e2]) = (S::from_f64(1.0), teeth, contact);
    let shape = S::from_f64(PI) * joined(z2, z1, internal) / (z1 * z2 * cos_base);
    shape * (one - e1 - e2 + e1 * e1 + e2 * e2)
}

/// The mean coefficient of friction of a mesh: mu = 0.048 (F_bt/b / (v_sum rho))^0.2 eta^-0.05
/// Ra^0.25 X_L, at most 0.2.
///
/// * `line_load`: F_bt / b in N/mm, at least 0
/// * `speed`: v_sum, the sum of the rolling speeds at the pitch point, in m/s, at least 0
/// * `radius`: rho, the radius of relative curvature at the pitch point, in mm, above 0
/// * `viscosity`: eta, dynamic, in mPa s, above 0
/// * `roughness`: Ra, mean of the two flanks, in um, at least 0
/// * `lubricant`: X_L: 1 for mineral oil, 0.8 for PAO and ester
///
/// Source: L. Schlenk, Untersuchungen zur Fresstragfähigkeit von Großzahnrädern (TU München 1994);
/// ISO/TR 14179-2.
pub fn mesh_friction<S: Scalar>(
    [line_load, speed, radius]: [S; 3],
    viscosity: S,
    roughness: S,
    lubricant: S,
) -> S {
    let rest = S::from_f64(0.048) * viscosity.powf(-0.05) * roughness.powf(0.25) * lubricant;
    // compared without the quotient, which has no value at rest
    let bound = (line_load / radius).value() * (rest.value() / MOST_FRICTION).powi(5);
    match speed.value() > bound {
        true => rest * (line_load / (speed * radius)).powf(0.2),
        false => S::from_f64(MOST_FRICTION),
    }
}

impl<S: Scalar> GearPair<S> {
    /// Friction of its teeth: P = abs(T1 omega1) mu H_V, in W.
    ///
    /// * `speed`: omega1 of the pinion in rad/s, of either sign; in a planetary stage relative to
    ///   the carrier, so that the rolling power counts
    /// * `torque`: T1 of the pinion in N m, of either sign
    /// * `oil`: nu in m^2/s and density in kg/m^3, above 0, and X_L as in [`mesh_friction`]
    /// * `roughness`: Ra, mean of the two flanks, in m, at least 0
    ///
    /// Source: [`gear_loss_factor`], [`mesh_friction`].
    pub fn power(&self, speed: S, torque: S, oil: [S; 3], roughness: S) -> S {
        let friction = self.friction(speed, torque, oil, roughness);
        speed.abs() * torque.abs() * friction * self.loss_factor()
    }

    /// Its [factor of gear loss](gear_loss_factor) H_V, at the working centre distance.
    pub fn loss_factor(&self) -> S {
        let at = self.transverse();
        gear_loss_factor(self.teeth, self.internal, at.cos_base, self.contact(&at))
    }

    /// Its mean coefficient of friction, with the arguments of [`GearPair::power`]. Rolling speeds
    /// and radii of curvature are those at the pitch point of the working centre distance.
    pub fn friction(&self, speed: S, torque: S, oil: [S; 3], roughness: S) -> S {
        let [nu, density, lubricant] = oil;
        let [z1, z2] = self.teeth;
        let (speed, torque) = (speed.abs(), torque.abs());
        let at = self.transverse();
        let base = at.module * z1 * S::from_f64(0.5) * at.cosine;
        let line_load = torque / base / mm(self.width);
        let sum = S::from_f64(2.0) * speed * base * at.working;
        let curved = base * at.working * z2 / (at.cos_base * joined(z2, z1, self.internal));
        mesh_friction(
            [line_load, sum, mm(curved)],
            S::from_f64(1e3) * nu * density,
            S::from_f64(1e6) * roughness,
            lubricant,
        )
    }
}

/// An angle of either sign.
const fn angle(
    key: &'static str,
    meaning: &'static str,
    example: &'static str,
    default: f64,
) -> FieldDeclaration {
    FieldDeclaration::measure(key, Type::of(Dimension::ANGLE), meaning, example).or(default)
}

/// A length of the teeth in modules that may be 0, which is its default.
const fn modules(
    key: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    FieldDeclaration::given(key, meaning, example).from_zero().or(0.0)
}

/// A coefficient of profile shift.
const fn shift(
    key: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    FieldDeclaration::given(key, meaning, example).signed().or(0.0)
}

/// The reason why a mesh without `scuffing` has no results of it.
const BULK: &str = "needs `scuffing` in the mesh: a bulk temperature alone is not safe, for the \
    flash temperature depends on load, speed and geometry";

/// Two external gears.
#[derive(Debug)]
pub(crate) struct MeshExternal;

impl Law for MeshExternal {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "external",
        sentence: "Two cylindrical gears with external teeth.",
        equation: "Q = abs(T1 omega1) mu H_V, mu = 0.048 (F_bt/b / (v_sum rho))^0.2 eta^-0.05 \
            Ra^0.25 X_L",
        kinds: &[Kind::Mesh],
        fields: &[
            SPEED,
            FieldDeclaration::new(
                "torque",
                Type::of(Dimension::TORQUE),
                "torque of the pinion, of either direction",
                "\"50 N m\"",
            )
            .signed(),
            FieldDeclaration::given("z1", "teeth of the pinion", "20").counted(),
            FieldDeclaration::given("z2", "teeth of the wheel, or of the ring", "60").counted(),
            length("module", "normal module", "\"3 mm\""),
            length("width", "common width of the teeth", "\"30 mm\""),
            length("Ra", "roughness, mean of the two flanks", "\"0.5 um\""),
            VISCOSITY,
            FieldDeclaration {
                hints: Hints::GIVEN,
                property: Some(Substance::Lubricant),
                ..FieldDeclaration::new(
                    "density",
                    Type::of(Dimension::DENSITY),
                    "density of the lubricant",
                    "\"860 kg/m^3\"",
                )
            },
            FieldDeclaration::given("X_L", "lubricant: mineral 1, PAO and ester 0.8", "1").or(1.0),
            angle("pressure_angle", "normal pressure angle", "\"20 deg\"", 20.0 * PI / 180.0)
                .degrees(0, 45),
            angle("helix_angle", "helix angle", "\"15 deg\"", 0.0).degrees(-60, 60),
            modules(
                "addendum_1",
                "of the pinion, from reference circle to tip in modules; 0: 1 + x_1 - \
                 tip_shortening",
                "1.2",
            ),
            modules("addendum_2", "the same of the wheel or ring, with x_2", "1.1"),
            shift("x_1", "profile shift coefficient of the pinion", "0.2"),
            shift("x_2", "of the wheel; of a ring positive towards its axis (ISO 21771)", "0.1"),
            modules("tip_shortening", "of both gears in modules, if no addendum is given", "0.02"),
            FieldDeclaration {
                hints: Hints::GIVEN,
                ..length(
                    "centre_distance",
                    "distance of the shafts; 0: that of x_1 and x_2 without backlash",
                    "\"125.11 mm\"",
                )
            }
            .from_zero()
            .or(0.0),
        ],
        validity: "H_V after Ohlendorf; F_bt/b in N/mm, v_sum in m/s, rho in mm, eta in mPa s, Ra in \
            um, at the working pitch point. mu is at most 0.2, which it reaches near rest. PAG: X_L = \
            0.75 (6 / v_sum)^0.2.",
        groups: &[
            Group { name: "v", meaning: "pitch line velocity in m/s", from: 2.0, to: 25.0 },
            THIN_OIL,
            Group { name: "eps_alpha", meaning: "transverse contact ratio", from: 1.0, to: 2.0 },
        ],
        source: "L. Schlenk (TU München 1994); H. Ohlendorf (TU München 1958); ISO/TR 14179-2; \
            profile shift: ISO 21771, DIN 3960",
        idle: &[("flash", BULK), ("contact", BULK), ("scuffing", BULK), ("margin", BULK)],
        ..LOSS
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        mesh(values, false)
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        groups(values, false, viscosity::<Self>(values))
    }
}

/// A pinion or planet in a ring.
#[derive(Debug)]
pub(crate) struct MeshInternal;

impl Law for MeshInternal {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "internal",
        sentence: "A pinion or planet in a ring with internal teeth.",
        fields: &INTERNAL,
        ordered: &[["z1", "z2"]],
        confidence: crate::Confidence::Medium,
        ..MeshExternal::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        mesh(values, true)
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        groups(values, true, viscosity::<Self>(values))
    }
}

/// The fields of a ring: those of two external gears with examples that fit.
const INTERNAL: [FieldDeclaration; MeshExternal::DECLARATION.fields.len()] = {
    let mut all = [SPEED; MeshExternal::DECLARATION.fields.len()];
    let mut i = 0;
    while i < all.len() {
        all[i] = MeshExternal::DECLARATION.fields[i];
        i += 1;
    }
    all[13].example = "0.8";
    all[15].example = "-0.2";
    all[17].example = "\"62.12 mm\"";
    all
};

/// The gears of these values of the fields.
pub(crate) fn pair_of<S: Scalar>(values: &[S], internal: bool) -> GearPair<S> {
    let given = |value: S| (value.value() != 0.0).then_some(value);
    GearPair {
        teeth: [values[2], values[3]],
        internal,
        module: values[4],
        width: values[5],
        pressure: values[10],
        helix: values[11],
        profile: Profile {
            addenda: [given(values[12]), given(values[13])],
            shifts: [values[14], values[15]],
            shortening: values[16],
            distance: given(values[17]),
        },
    }
}

impl Formula {
    /// The gears of a law of `[mesh]` with these values of its fields, in SI units; `None` of other
    /// laws. Values that are not about their dimensions may be NaN.
    pub fn gears(self, values: &[f64]) -> Option<GearPair<f64>> {
        match self {
            Self::MeshExternal | Self::MeshExternalScuffing => Some(pair_of(values, false)),
            Self::MeshInternal | Self::MeshInternalScuffing => Some(pair_of(values, true)),
            _ => None,
        }
    }
}

fn mesh<S: Scalar>(values: &[S], internal: bool) -> S {
    let oil = [values[7], values[8], values[9]];
    pair_of(values, internal).power(values[0], values[1], oil, values[6])
}

/// Pitch line velocity in m/s, viscosity and transverse contact ratio; `None` at rest or without
/// torque, when nothing is lost.
fn groups(values: &[f64], internal: bool, viscosity: Option<f64>) -> Vec<Option<f64>> {
    let pair = pair_of(values, internal);
    let (speed, torque) = (values[0].abs(), values[1].abs());
    let velocity = speed * pair.pitch_radius();
    let loaded = torque > 0.0 && velocity > 0.0;
    let [first, second] = pair.engagement().contact;
    vec![loaded.then_some(velocity), viscosity, loaded.then_some(first + second)]
}
