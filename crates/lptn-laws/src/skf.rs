//! The SKF model of the friction of rolling bearings.

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{FieldDeclaration, Hints, Law, LawDeclaration};
use crate::loss::{LOSS, SPEED, THIN_OIL, VISCOSITY, length, mm, mm2_per_s, rpm, viscosity};

/// A deep groove ball bearing in the SKF model: sizes and loads in SI units, constants as the
/// catalogue prints them.
#[derive(Clone, Copy, Debug)]
pub struct SkfBearing<S> {
    /// Bore in m, above 0.
    pub bore: S,
    /// Outer diameter in m, above the bore.
    pub outer: S,
    /// Radial load in N, at least 0.
    pub radial: S,
    /// Axial load in N, at least 0.
    pub axial: S,
    /// Basic static load rating C0 in N, above 0.
    pub static_rating: S,
    /// R1 and R2 of rolling friction.
    pub rolling: [S; 2],
    /// S1 and S2 of sliding friction.
    pub sliding: [S; 2],
    /// K_Z of type and geometry, and K_rs of replenishment.
    pub starvation: [S; 2],
    /// mu_bl of additives, and mu_EHL of the full film.
    pub friction: [S; 2],
    /// Drag of the oil: V_M K_ball / 1e-12 of the older form, 0 without a bath.
    pub drag: S,
    /// Moment of the seals in N m, at least 0.
    pub seals: S,
}

impl<S: Scalar> SkfBearing<S> {
    /// Its friction: P = M omega, in W, with M = phi_ish phi_rs M_rr + M_sl + M_drag + M_seal.
    ///
    /// * `nu`: kinematic viscosity in m^2/s, at least 0, of the base oil of a grease
    /// * `speed`: omega in rad/s, of either sign
    ///
    /// Source: SKF, Rolling bearings (catalogue), "The SKF model for calculating the frictional
    /// moment". An axial load changes the form of the sliding part; as printed, it does not tend to
    /// the form without axial load. Drag in the form of the older catalogue.
    pub fn power(&self, nu: S, speed: S) -> S {
        let (n, nu) = (rpm(speed), mm2_per_s(nu));
        let moment = self.rolling_moment(nu, n) + self.sliding_moment(nu, n) + self.drag_moment(n);
        (moment * S::from_f64(1e-3) + self.seals) * speed.abs()
    }

    /// Mean diameter in mm.
    fn mean(&self) -> S {
        mm(self.bore + self.outer) * S::from_f64(0.5)
    }

    /// The sine of the contact angle under an axial load: alpha = 24.6 (F_a/C0)^0.24 in degrees.
    fn sine(&self) -> S {
        let degrees = S::from_f64(24.6) * (self.axial / self.static_rating).powf(0.24);
        degrees.min(S::from_f64(90.0)).sin_of_degrees()
    }

    /// phi_ish phi_rs G_rr (nu n)^0.6 in N mm, of nu in mm^2/s and n in rpm.
    fn rolling_moment(&self, nu: S, n: S) -> S {
        let (one, d_m) = (S::from_f64(1.0), self.mean());
        let [r1, r2] = self.rolling;
        let load = match self.axial.value() > 0.0 {
            true => self.radial + r2 / self.sine() * self.axial,
            false => self.radial,
        };
        let heating = S::from_f64(1.84e-9) * (n * d_m).powf(1.28) * nu.powf(0.64);
        let [k_z, k_rs] = self.starvation;
        let (sum, difference) = (mm(self.bore + self.outer), mm(self.outer - self.bore));
        let starved = k_rs * nu * n * sum * (k_z / (S::from_f64(2.0) * difference)).sqrt();
        let basic = r1 * d_m.powf(1.96) * load.powf(0.54) * (nu * n).powf(0.6);
        one / (one + heating) * (-starved).exp() * basic
    }

    /// G_sl mu_sl in N mm.
    fn sliding_moment(&self, nu: S, n: S) -> S {
        let d_m = self.mean();
        let [s1, s2] = self.sliding;
        let basic = match self.axial.value() > 0.0 {
            true => {
                let axial = s2 * d_m.powf(1.5) / self.sine() * self.axial.powi(4);
                s1 * d_m.powf(-0.145) * (self.radial.powi(5) + axial).powf(1.0 / 3.0)
            }
            false => s1 * d_m.powf(-0.26) * self.radial.powf(5.0 / 3.0),
        };
        let mixed = (S::from_f64(-2.6e-8) * (n * nu).powf(1.4) * d_m).exp();
        let [boundary, film] = self.friction;
        basic * (film + mixed * (boundary - film))
    }

    /// V_M K_ball d_m^5 n^2 in N mm.
    fn drag_moment(&self, n: S) -> S {
        let shape = self.starvation[0] * (self.outer + self.bore) / (self.outer - self.bore);
        self.drag * shape * S::from_f64(1e-12) * self.mean().powi(5) * n * n
    }
}

/// The sine of an angle in degrees.
trait Degrees {
    fn sin_of_degrees(self) -> Self;
}

impl<S: Scalar> Degrees for S {
    fn sin_of_degrees(self) -> Self {
        (self * S::from_f64(std::f64::consts::PI / 180.0)).sin()
    }
}

/// A force that is at least 0.
const fn force(
    key: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    let ty = Type::of(Dimension::FORCE);
    FieldDeclaration { hints: Hints::GIVEN, ..FieldDeclaration::new(key, ty, meaning, example) }
}

/// The model of the catalogue.
#[derive(Debug)]
pub(crate) struct BearingSkf;

impl Law for BearingSkf {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "skf",
        sentence: "The SKF model of a deep groove ball bearing: rolling, sliding, drag and seals.",
        equation: "Q = (phi_ish phi_rs G_rr (nu n)^0.6 + G_sl mu_sl + M_drag + M_seal) omega",
        kinds: &[Kind::Bearing],
        fields: &[
            SPEED,
            length("d", "bore diameter", "\"30 mm\""),
            length("D", "outer diameter", "\"62 mm\""),
            VISCOSITY,
            force("F_r", "radial load", "\"1 kN\"").from_zero(),
            force("F_a", "axial load", "\"200 N\"").from_zero().or(0.0),
            force("C_0", "basic static load rating", "\"11.2 kN\""),
            FieldDeclaration::given("R1", "constant of rolling friction", "4.3e-7").or(4.3e-7),
            FieldDeclaration::given("R2", "constant of rolling friction", "1.7").or(1.7),
            FieldDeclaration::given("S1", "constant of sliding friction", "4.63e-3").or(4.63e-3),
            FieldDeclaration::given("S2", "constant of sliding friction", "4.25").or(4.25),
            FieldDeclaration::given("K_Z", "constant of type and geometry", "3.1").or(3.1),
            FieldDeclaration::given("K_rs", "3e-8 for oil, 6e-8 for grease", "3e-8").or(3e-8),
            FieldDeclaration::given("mu_bl", "friction of boundary lubrication", "0.12").or(0.12),
            FieldDeclaration::given("mu_EHL", "friction of a full film", "0.05").or(0.05),
            FieldDeclaration::given("V_M", "factor of drag, of the level of the oil", "0.0001")
                .from_zero()
                .or(0.0),
            FieldDeclaration {
                hints: Hints::GIVEN,
                ..FieldDeclaration::new(
                    "M_seal",
                    Type::of(Dimension::TORQUE),
                    "moment of its seals",
                    "\"20 N mm\"",
                )
                .from_zero()
                .or(0.0)
            },
        ],
        ordered: &[["d", "D"]],
        groups: &[THIN_OIL],
        validity: "Default constants: series 160 and 161, in a bath of oil, mineral oil (mu_EHL \
            0.04 synthetic), without drag. As printed, the sliding part jumps where an axial load \
            begins. mu_bl is 0.15 in the catalogue of 2016.",
        source: "SKF, Rolling bearings (catalogue), the SKF model for calculating the frictional \
            moment; drag: the edition of 2003",
        ..LOSS
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let bearing = SkfBearing {
            bore: values[1],
            outer: values[2],
            radial: values[4],
            axial: values[5],
            static_rating: values[6],
            rolling: [values[7], values[8]],
            sliding: [values[9], values[10]],
            starvation: [values[11], values[12]],
            friction: [values[13], values[14]],
            drag: values[15],
            seals: values[16],
        };
        bearing.power(values[3], values[0])
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        vec![viscosity::<Self>(values)]
    }
}
