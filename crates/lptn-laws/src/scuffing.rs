//! Scuffing of gears: the flash temperature of the flanks over the path of contact.

use std::f64::consts::PI;

use lptn_units::{Dimension, Scalar, Type};

use crate::declare::{
    Confidence, FieldDeclaration, Hints, Law, LawDeclaration, Range, ResultDeclaration,
};
use crate::involute::{GearPair, Transverse};
use crate::mesh::{MeshExternal, MeshInternal, pair_of};

/// The material of the flanks of two gears.
#[derive(Clone, Copy, Debug)]
pub struct Flanks<S> {
    /// Modulus of elasticity in Pa, above 0.
    pub modulus: S,
    /// Poisson's ratio.
    pub poisson: S,
    /// Thermal conductivity in W/(m K), above 0.
    pub conductivity: S,
    /// Heat capacity of a volume, density times specific heat, in J/(m^3 K), above 0.
    pub capacity: S,
}

impl<S: Scalar> Flanks<S> {
    /// Blok's flash temperature in K: the rise of the hottest point of a band of contact above the
    /// bulk, 1.11 mu w (sqrt(v1) - sqrt(v2)) / (B sqrt(2 b)), with b of Hertz.
    ///
    /// * `friction`: coefficient mu, at least 0
    /// * `line_load`: w, normal to the flanks, in N per m of the line of contact, at least 0
    /// * `radius`: of relative curvature in m, above 0
    /// * `speeds`: v of the two surfaces over the contact in m/s, at least 0
    ///
    /// B = sqrt(k rho c), b = sqrt(8 w R / (pi E_r)) is half the width, E_r = E / (1 - nu^2). The
    /// heat is distributed like the pressure of Hertz, and the surfaces are so fast that it does
    /// not spread sideways (Péclet numbers above 10). Source: H. Blok, Les températures de surface
    /// dans des conditions de graissage sous extrême pression (1937); 1.11 over the whole width: T.
    /// A. Stolarski, Tribology in Machine Design, section 2.
    ///
    /// ```
    /// # use lptn_laws::Flanks;
    /// let steel = Flanks { modulus: 206e9, poisson: 0.3, conductivity: 48.7, capacity: 3.8e6 };
    /// // 100 N/mm, 10 mm, 4 and 1 m/s: b = 0.10605 mm, B = 13603.7 W s^0.5/(m^2 K)
    /// assert!((steel.flash(0.05, 1e5, 0.01, [4.0, 1.0]) - 28.01).abs() < 0.01);
    /// ```
    pub fn flash(&self, friction: S, line_load: S, radius: S, speeds: [S; 2]) -> S {
        let (one, of) = (S::from_f64(1.0), S::from_f64);
        let reduced = self.modulus / (one - self.poisson * self.poisson);
        // w / sqrt(b), which is finite without load
        let pressed = line_load.powf(0.75) / (of(8.0 / PI) * radius / reduced).powf(0.25);
        let [first, second] = speeds.map(|speed| speed.sqrt());
        let entered = (self.conductivity * self.capacity).sqrt() * of(2.0_f64.sqrt());
        of(1.11) * friction * pressed * (first - second).abs() / entered
    }
}

/// Points of each stretch of the path of contact at which the flash temperature is evaluated.
const POINTS: usize = 64;

/// Spur teeth: the share of the load of a pair that comes into mesh.
const FIRST_SHARE: f64 = 1.0 / 3.0;

impl GearPair<f64> {
    /// The highest flash temperature over the path of contact in K; NaN if the path reaches below a
    /// base circle, in which no involute exists.
    ///
    /// * `speed`, `torque` of the pinion in rad/s and N m, of either sign
    /// * `friction`: the mean coefficient over the path
    ///
    /// A pair of teeth carries a third of the load when it comes into mesh, two thirds just before
    /// it is the only one, and as much on the way out. Helical teeth carry 1 + 0.3 eps_beta times
    /// as much, 1.3 at most, and the mean, 1 / eps_alpha, if eps_alpha + eps_beta is above 2. If
    /// spur teeth are never alone in mesh one of them is assumed to carry all. Tip relief and
    /// dynamic or application factors are not included: give the torque with them. Source: AGMA
    /// 925-A03 and ISO/TR 13989-1, by accounts of them.
    pub fn flash(&self, speed: f64, torque: f64, friction: f64, flanks: &Flanks<f64>) -> f64 {
        let at = self.transverse();
        let path = Path::new(self, &at);
        let overlap = self.width * self.helix.sin().abs() / (PI * self.module);
        let ends = 1.0 + 0.3 * overlap.min(1.0);
        let full = torque.abs() / (path.base * self.width);
        let flash_at = |place: f64, share: f64| {
            let [rho1, rho2] = path.curvatures(place);
            if rho1 <= 0.0 || rho2 <= 0.0 {
                return f64::NAN;
            }
            let speeds = [speed.abs() * rho1, speed.abs() * rho2 * path.slower];
            let joined = if self.internal { rho2 - rho1 } else { rho1 + rho2 };
            let radius = rho1 * rho2 / joined / at.cos_base;
            flanks.flash(friction, full * share * ends, radius, speeds)
        };
        let worst = |most: f64, now: f64| if now.is_nan() || now > most { now } else { most };
        let mut most = 0.0;
        for [(from, first), (to, last)] in path.stretches(overlap) {
            for point in 0..=POINTS {
                let part = point as f64 / POINTS as f64;
                let (place, share) = (from + part * (to - from), first + part * (last - first));
                most = if f64::is_nan(most) { most } else { worst(most, flash_at(place, share)) };
            }
        }
        most
    }
}

/// The path of contact in the transverse section, in m from the pitch point towards the tip of the
/// pinion.
struct Path {
    /// Radius of the base circle of the pinion.
    base: f64,
    /// Radii of curvature at the pitch point.
    pitch: [f64; 2],
    internal: bool,
    /// Speed of the wheel over that of the pinion.
    slower: f64,
    /// Distance between two pairs of teeth.
    step: f64,
    /// The places at which a pair comes into mesh and leaves it.
    ends: [f64; 2],
}

/// A place and the share of the load there.
type Loaded = (f64, f64);

impl Path {
    fn new(pair: &GearPair<f64>, at: &Transverse<f64>) -> Self {
        let bases = pair.teeth.map(|teeth| 0.5 * at.module * teeth * at.cosine);
        let step = PI * at.module * at.cosine;
        let [beyond, before] = pair.contact(at).map(|ratio| ratio * step);
        Self {
            base: bases[0],
            pitch: bases.map(|base| base * at.working),
            internal: pair.internal,
            slower: pair.teeth[0] / pair.teeth[1],
            step,
            ends: [-before, beyond],
        }
    }

    fn curvatures(&self, place: f64) -> [f64; 2] {
        let other = if self.internal { place } else { -place };
        [self.pitch[0] + place, self.pitch[1] + other]
    }

    /// Stretches with the share of the load at their ends.
    fn stretches(&self, overlap: f64) -> Vec<[Loaded; 2]> {
        let [start, end] = self.ends;
        let ratio = (end - start) / self.step;
        if overlap > 0.0 && ratio + overlap > 2.0 {
            return vec![[(start, 1.0 / ratio), (end, 1.0 / ratio)]];
        }
        let [alone, shared] = [end - self.step, start + self.step];
        if !(1.0..2.0).contains(&ratio) {
            return vec![[(start, 1.0), (end, 1.0)]];
        }
        let most = 1.0 - FIRST_SHARE;
        vec![
            [(start, FIRST_SHARE), (alone, most)],
            [(alone, 1.0), (shared, 1.0)],
            [(shared, most), (end, FIRST_SHARE)],
        ]
    }
}

/// The fields that describe how the flanks scuff.
const OWN: [FieldDeclaration; 5] = [
    FieldDeclaration {
        range: Range::Temperature,
        words: &[
            ("mineral", "63 [degC] + 33 [K] * ln(OIL.nu(40 [degC]) / 1 [mm^2/s])"),
            ("mineral_ep", "118 [degC] + 33 [K] * ln(OIL.nu(40 [degC]) / 1 [mm^2/s])"),
        ],
        ..FieldDeclaration::new(
            "scuffing",
            Type::ABSOLUTE_TEMPERATURE,
            "temperature at which the flanks scuff; `mineral`, or `mineral_ep` for an oil with \
             additives against it: of AGMA 925 from its viscosity at 40 degC",
            "\"250 degC\"",
        )
    },
    flank("E", Dimension::PRESSURE, "modulus of elasticity of the flanks", "\"206 GPa\"", 206e9),
    FieldDeclaration::given("poisson", "Poisson's ratio of the flanks", "0.3").from_zero().or(0.3),
    flank("k", Dimension::CONDUCTIVITY, "conductivity of the flanks", "\"48.7 W/(m K)\"", 48.7),
    flank(
        "heat_capacity",
        Dimension::VOLUMETRIC_HEAT_CAPACITY,
        "density times specific heat of the flanks",
        "\"3.8 MJ/(m^3 K)\"",
        3.8e6,
    ),
];

const fn flank(
    key: &'static str,
    dimension: Dimension,
    meaning: &'static str,
    example: &'static str,
    steel: f64,
) -> FieldDeclaration {
    let field = FieldDeclaration::new(key, Type::of(dimension), meaning, example).or(steel);
    FieldDeclaration { hints: Hints::PROPERTY, ..field }
}

/// Number of fields of a mesh without these.
const PLAIN: usize = MeshExternal::DECLARATION.fields.len();

/// The fields of two external gears, and these.
const EXTERNAL: [FieldDeclaration; PLAIN + OWN.len()] = fields(MeshExternal::DECLARATION.fields);

/// The fields of a pinion in a ring, and these.
const INTERNAL: [FieldDeclaration; PLAIN + OWN.len()] = fields(MeshInternal::DECLARATION.fields);

/// The fields of a mesh, and these.
const fn fields(plain: &[FieldDeclaration]) -> [FieldDeclaration; PLAIN + OWN.len()] {
    let mut all = [OWN[0]; PLAIN + OWN.len()];
    let mut i = 0;
    while i < all.len() {
        all[i] = if i < PLAIN { plain[i] } else { OWN[i - PLAIN] };
        i += 1;
    }
    all
}

/// The reason why there is no flash temperature.
const UNDERCUT: &str = "if the path of contact reaches below a base circle, which has no involute: \
    less addendum, or more teeth";

const RESULTS: &[ResultDeclaration] = &[
    ResultDeclaration {
        key: "flash",
        ty: Type::of(Dimension::TEMPERATURE),
        meaning: "highest flash temperature of the flanks, above the bulk",
        missing: UNDERCUT,
    },
    ResultDeclaration {
        key: "contact",
        ty: Type::ABSOLUTE_TEMPERATURE,
        meaning: "highest temperature of the flanks: that of the hottest node of `into` and `flash`",
        missing: UNDERCUT,
    },
    ResultDeclaration {
        key: "scuffing",
        ty: Type::ABSOLUTE_TEMPERATURE,
        meaning: "temperature at which they scuff",
        missing: "",
    },
    ResultDeclaration {
        key: "margin",
        ty: Type::of(Dimension::TEMPERATURE),
        meaning: "distance of `contact` below `scuffing`",
        missing: UNDERCUT,
    },
];

const EQUATION: &str = "Q as without `scuffing`; flash = 1.11 mu w abs(sqrt(v1) - sqrt(v2)) / \
    (sqrt(k rho c) sqrt(2 b)), b = sqrt(8 w rho / (pi E_r)), at most over the path of contact";

const VALIDITY: &str = "As without `scuffing`; flash temperature after Blok with the mean mu, over \
    the path of contact without tip relief. `into` heats the gears themselves, whose temperature is \
    that of the bulk: a sump is colder. Both gears of one material. 63 and 118 degC + 33 K ln(nu_40 \
    in mm^2/s): mineral oils.";

const SOURCE: &str = "as without `scuffing`; H. Blok (1937); T. A. Stolarski, Tribology in Machine \
    Design; AGMA 925-A03, ISO/TR 13989-1 by accounts of them";

/// Two external gears that may scuff.
#[derive(Debug)]
pub(crate) struct MeshExternalScuffing;

impl Law for MeshExternalScuffing {
    const DECLARATION: LawDeclaration = LawDeclaration {
        sentence: "Two cylindrical gears with external teeth that may scuff.",
        equation: EQUATION,
        fields: &EXTERNAL,
        validity: VALIDITY,
        source: SOURCE,
        confidence: Confidence::Medium,
        idle: &[],
        ..MeshExternal::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        MeshExternal::value(values, ends)
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        MeshExternal::groups(values, ends)
    }

    const RESULTS: &'static [ResultDeclaration] = RESULTS;

    fn results(values: &[f64], ends: [f64; 2]) -> Vec<f64> {
        results(values, ends, false)
    }

    fn judges(values: &[f64], _: [f64; 2]) -> bool {
        is_loaded(values)
    }
}

/// A pinion or planet in a ring that may scuff.
#[derive(Debug)]
pub(crate) struct MeshInternalScuffing;

impl Law for MeshInternalScuffing {
    const DECLARATION: LawDeclaration = LawDeclaration {
        sentence: "A pinion or planet in a ring with internal teeth that may scuff.",
        equation: EQUATION,
        fields: &INTERNAL,
        validity: VALIDITY,
        source: SOURCE,
        idle: &[],
        ..MeshInternal::DECLARATION
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        MeshInternal::value(values, ends)
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        MeshInternal::groups(values, ends)
    }

    const RESULTS: &'static [ResultDeclaration] = RESULTS;

    fn results(values: &[f64], ends: [f64; 2]) -> Vec<f64> {
        results(values, ends, true)
    }

    fn judges(values: &[f64], _: [f64; 2]) -> bool {
        is_loaded(values)
    }
}

/// True if flanks slide under load: otherwise there is no flash temperature.
fn is_loaded(values: &[f64]) -> bool {
    let [speed, torque] = [values[0], values[1]];
    speed != 0.0 && torque != 0.0
}

fn results(values: &[f64], [bulk, _]: [f64; 2], internal: bool) -> Vec<f64> {
    let pair = pair_of(values, internal);
    let [limit, modulus, poisson, conductivity, capacity] =
        std::array::from_fn(|i| values[PLAIN + i]);
    let flanks = Flanks { modulus, poisson, conductivity, capacity };
    let friction =
        pair.friction(values[0], values[1], [values[7], values[8], values[9]], values[6]);
    let flash = pair.flash(values[0], values[1], friction, &flanks);
    vec![flash, bulk + flash, limit, limit - bulk - flash]
}
