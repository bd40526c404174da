//! Geometry of gears with profile shift: working pressure angle, tips and path of contact.
//!
//! Signs are those of ISO 21771 with the teeth of a ring counted positive here: a positive shift
//! always moves the tips away from the material, so that of a ring moves them towards its axis.
//! Rings have u - 1 for u + 1, and shifts of a ring reduce the centre distance.

use std::f64::consts::PI;

use lptn_units::Scalar;

/// Profile shifts, tips and centre distance of two gears.
#[derive(Clone, Copy, Debug)]
pub struct Profile<S> {
    /// Profile shift coefficients x1 and x2, of either sign; of a ring positive towards its axis.
    pub shifts: [S; 2],
    /// From the reference circle to the tip, in normal modules; `None`: 1 + x - k.
    pub addenda: [Option<S>; 2],
    /// Tip shortening k in modules, at least 0, of the addenda that are not given.
    pub shortening: S,
    /// Distance of the shafts in m, above 0; `None`: that of the shifts without backlash.
    pub distance: Option<S>,
}

impl<S: Scalar> Profile<S> {
    /// The pair of gears without shift, with addenda of one module, at the reference centre distance.
    pub fn standard() -> Self {
        let zero = S::from_f64(0.0);
        Self { shifts: [zero; 2], addenda: [None; 2], shortening: zero, distance: None }
    }

    /// The addenda in modules.
    fn tips(&self) -> [S; 2] {
        let usual = |shift: S| S::from_f64(1.0) + shift - self.shortening;
        let [first, second] = self.shifts;
        [
            self.addenda[0].unwrap_or_else(|| usual(first)),
            self.addenda[1].unwrap_or_else(|| usual(second)),
        ]
    }
}

/// Two cylindrical gears in mesh.
#[derive(Clone, Copy, Debug)]
pub struct GearPair<S> {
    /// Teeth z1 of the pinion and z2 of the wheel or ring.
    pub teeth: [S; 2],
    /// True if the wheel is a ring with internal teeth.
    pub internal: bool,
    /// Normal module in m.
    pub module: S,
    /// Common width in m.
    pub width: S,
    /// Normal pressure angle of the basic rack in rad.
    pub pressure: S,
    /// Helix angle in rad, of either sign.
    pub helix: S,
    /// Profile shifts, tips and centre distance.
    pub profile: Profile<S>,
}

/// z2 + z1, or z2 - z1 for an internal mesh.
pub(crate) fn joined<S: Scalar>(z2: S, z1: S, internal: bool) -> S {
    if internal { z2 - z1 } else { z2 + z1 }
}

/// Geometry in the transverse section.
pub(crate) struct Transverse<S> {
    /// Module in m.
    pub(crate) module: S,
    /// Cosine of the pressure angle at the reference circle.
    pub(crate) cosine: S,
    /// Tangent of the working pressure angle.
    pub(crate) working: S,
    /// Cosine of the helix angle at the base circle.
    pub(crate) cos_base: S,
}

/// The mesh of two gears at their centre distance, for checks of their dimensions.
#[derive(Clone, Copy, Debug)]
pub struct Engagement {
    /// Distance of the shafts in m.
    pub distance: f64,
    /// The distance in m that the shifts give without backlash; NaN if there is none.
    pub free: f64,
    /// The sum of the shifts that gives `distance` without backlash.
    pub sum: f64,
    /// Working pressure angle in rad, in the transverse section.
    pub angle: f64,
    /// Tip contact ratios eps_1 and eps_2; NaN if a tip is inside its base circle.
    pub contact: [f64; 2],
    /// Overlap ratio eps_beta, at least 0.
    pub overlap: f64,
    /// Radii of curvature in m: of the pinion where teeth come into mesh, of the wheel where they
    /// leave it. Below 0 the tip of the other gear is beyond the point where the line of action
    /// touches the base circle.
    pub curvature: [f64; 2],
    /// Radii of the base circles in m.
    pub base: [f64; 2],
    /// Radii of the tip circles in m.
    pub tip: [f64; 2],
    /// Thickness of the teeth at the tips in m, in the transverse section, that the shifts give
    /// without backlash. Below 0 the flanks meet before the tip: the teeth are pointed.
    pub thickness: [f64; 2],
}

impl<S: Scalar> GearPair<S> {
    /// The radius of the working pitch circle of the pinion in m.
    pub fn pitch_radius(&self) -> S {
        let (at, one) = (self.transverse(), S::from_f64(1.0));
        let base = at.module * self.teeth[0] * S::from_f64(0.5) * at.cosine;
        base * (one + at.working * at.working).sqrt()
    }

    pub(crate) fn transverse(&self) -> Transverse<S> {
        let one = S::from_f64(1.0);
        let module = self.module / self.helix.cos();
        let normal = self.pressure.sin() / self.pressure.cos();
        let tangent = normal / self.helix.cos();
        let cosine = one / (one + tangent * tangent).sqrt();
        let sine_base = self.helix.sin() * self.pressure.cos();
        let cos_base = (one - sine_base * sine_base).sqrt();
        let working = match self.profile.distance {
            Some(distance) => {
                let secant = distance / (self.reference_distance(module) * cosine);
                (secant * secant - one).sqrt()
            }
            None => self.without_backlash(normal, tangent),
        };
        Transverse { module, cosine, working, cos_base }
    }

    /// The distance of the shafts at which the reference circles touch, in m.
    fn reference_distance(&self, module: S) -> S {
        let [z1, z2] = self.teeth;
        S::from_f64(0.5) * module * joined(z2, z1, self.internal)
    }

    /// The tangent of the working pressure angle without backlash: inv a_w = inv a_t + 2 tan a_n
    /// (x1 + x2) / (z1 + z2), in a ring - 2 tan a_n (x1 + x2) / (z2 - z1). Source: ISO 21771:2007;
    /// DIN 3960:1987. NaN if there is no such angle.
    fn without_backlash(&self, normal: S, tangent: S) -> S {
        let [x1, x2] = self.profile.shifts;
        let [z1, z2] = self.teeth;
        let sign = S::from_f64(if self.internal { -2.0 } else { 2.0 });
        let wanted = involute(tangent) + sign * normal * (x1 + x2) / joined(z2, z1, self.internal);
        let found = match (x1 + x2).value() == 0.0 {
            true => tangent.value(),
            false => tangent_of(wanted.value(), tangent.value()),
        };
        wanted.chain(found, 1.0 + 1.0 / (found * found))
    }

    /// The tip contact ratios of pinion and wheel, eps = z (tan a_a - tan a_w) / (2 pi), of a ring
    /// with the opposite sign. Source: ISO 21771:2007.
    pub(crate) fn contact(&self, at: &Transverse<S>) -> [S; 2] {
        let (half, one, turn) = (S::from_f64(0.5), S::from_f64(1.0), S::from_f64(2.0 * PI));
        let tips = self.profile.tips();
        let ratio = |teeth: S, addendum: S, sign: f64| {
            let sign = S::from_f64(sign);
            let base = half * teeth * at.cosine; // in transverse modules
            let tip = half * teeth + sign * addendum * self.module / at.module;
            sign * teeth * (((tip / base).powi(2) - one).sqrt() - at.working) / turn
        };
        let ring = if self.internal { -1.0 } else { 1.0 };
        [ratio(self.teeth[0], tips[0], 1.0), ratio(self.teeth[1], tips[1], ring)]
    }
}

impl GearPair<f64> {
    /// Centre distance, contact ratios and ends of the path of contact. Source: ISO 21771:2007.
    ///
    /// ```
    /// # use lptn_laws::{GearPair, Profile};
    /// // the gears C of FZG: 16 and 24 teeth of 4.5 mm are 91.5 mm apart
    /// let profile = Profile { shifts: [0.1817, 0.1715], ..Profile::standard() };
    /// let (teeth, pressure) = ([16.0, 24.0], 20f64.to_radians());
    /// let (module, width) = (4.5e-3, 14e-3);
    /// let pair = GearPair { teeth, internal: false, module, width, pressure, helix: 0.0, profile };
    /// assert!((pair.engagement().distance - 91.5e-3).abs() < 1e-6);
    /// ```
    pub fn engagement(&self) -> Engagement {
        let at = self.transverse();
        let step = PI * at.module * at.cosine;
        let contact = self.contact(&at);
        let reference = self.reference_distance(at.module) * at.cosine;
        let secant = |tangent: f64| (1.0 + tangent * tangent).sqrt();
        let normal = self.pressure.tan();
        let free = self.without_backlash(normal, normal / self.helix.cos());
        let [z1, z2] = self.teeth;
        let side = if self.internal { -1.0 } else { 1.0 };
        let twist = involute(at.working) - involute(normal / self.helix.cos());
        let base = self.teeth.map(|teeth| 0.5 * at.module * teeth * at.cosine);
        let [beyond, before] = contact.map(|ratio| ratio * step);
        let last = base[1] * at.working - side * beyond;
        let [tip, other] = self.profile.tips().map(|tip| tip * self.module);
        let tip = [0.5 * at.module * z1 + tip, 0.5 * at.module * z2 + side * other];
        let turned = involute(normal / self.helix.cos());
        // half of the tooth at the reference circle as an angle, with its turn up to the tip
        let thickness = |gear: usize, side: f64| {
            let half = 0.25 * PI + self.profile.shifts[gear] * normal;
            let angle = (base[gear] / tip[gear]).acos();
            let turn = side * (turned - (angle.tan() - angle));
            2.0 * tip[gear] * (2.0 * half / self.teeth[gear] + turn)
        };
        let thickness = [thickness(0, 1.0), thickness(1, side)];
        Engagement {
            distance: reference * secant(at.working),
            free: reference * secant(free),
            sum: side * 0.5 * twist * joined(z2, z1, self.internal) / normal,
            angle: at.working.atan(),
            contact,
            overlap: self.width * self.helix.sin().abs() / (PI * self.module),
            curvature: [base[0] * at.working - before, last],
            base,
            tip,
            thickness,
        }
    }
}

/// inv a = tan a - a of the tangent of an angle.
fn involute<S: Scalar>(tangent: S) -> S {
    let value = tangent.value();
    tangent - tangent.chain(value.atan(), 1.0 / (1.0 + value * value))
}

/// The tangent of the angle with this involute, by Newton's method from the tangent of another
/// angle; NaN if the involute is not above 0. t - atan t is convex and rises for t > 0, so that
/// steps after the first one approach from one side.
fn tangent_of(wanted: f64, start: f64) -> f64 {
    if wanted.is_nan() || wanted <= 0.0 {
        return f64::NAN;
    }
    let mut tangent = start;
    for _ in 0..100 {
        let step = (involute(tangent) - wanted) * (1.0 + 1.0 / (tangent * tangent));
        // never across 0, where the slope vanishes
        tangent = (tangent - step).max(0.1 * tangent);
        if step.abs() <= 4.0 * f64::EPSILON * tangent {
            break;
        }
    }
    tangent
}
