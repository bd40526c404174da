//! Heat sinks with parallel straight fins: the film between them, and conduction in the fins.
//!
//! All properties are those at the film temperature, the mean of base and fluid.

use lptn_units::Scalar;

use crate::declare::{Confidence, Extent, FieldDeclaration, Group, Law, LawDeclaration};
use crate::fins::{K_FIN, StraightFins, finned};
use crate::fluid::{EXPANSION, Fluid, length, of_fluid, prandtl};
use crate::forced_convection::SPEED;
use crate::free_convection::rayleigh;

/// Mean Nusselt number between vertical plates of one temperature in still air, over their distance
/// S.
///
/// Nu = (576 / El^2 + 2.873 / sqrt(El))^(-1/2)
///
/// * `elenbaas`: El = Ra_S S / L with the height L of the plates, at least 0; 0.1 to 1e5
///
/// The first part applies to plates so close that the flow between them is developed, the second to
/// single plates in air. Source: A. Bar-Cohen and W. M. Rohsenow, Journal of Heat Transfer 106
/// (1984) 116; Incropera et al., 6th edition, section 9.7.1.
///
/// ```
/// // Cengel: thin fins side by side give off most at S = 2.714 L / Ra_L^(1/4), where Nu = 1.307
/// let nu = lptn_laws::nusselt_between_plates(2.714_f64.powi(4));
/// assert!((nu - 1.307).abs() < 5e-4);
/// ```
pub fn nusselt_between_plates<S: Scalar>(elenbaas: S) -> S {
    let [close, single] = [576.0, 2.873].map(S::from_f64);
    elenbaas / (close + single * elenbaas.powf(1.5)).sqrt()
}

/// Mean Nusselt number of a laminar flow between plates of one temperature, over their distance S.
///
/// Nu = ((Re* Pr / 2)^-3 + (0.664 sqrt(Re*) Pr^(1/3) sqrt(1 + 3.65 / sqrt(Re*)))^-3)^(-1/3)
///
/// * `re`: Re* = Re_S S / L with the length L along the flow, at least 0; 0.1 to 100
/// * `pr`: Prandtl number, that of air
///
/// The first part is the heat that the air between the plates can take up: the temperature of the
/// fluid is that at its inlet. Source: P. Teertstra, M. M. Yovanovich, J. R. Culham and T. Lemczyk,
/// 15th IEEE SEMI-THERM (1999) 34; J. R. Culham and Y. S. Muzychka, IEEE Transactions on Components
/// and Packaging Technologies 24 (2001) 159.
pub fn nusselt_through_plates<S: Scalar>(re: S, pr: S) -> S {
    let [one, two, flat, late] = [1.0, 2.0, 0.664, 3.65].map(S::from_f64);
    let taken = re * pr / two;
    // the first part over the second, whose power with sqrt(Re*) has a slope at 0
    let root = (re.max(S::from_f64(NO_FLOW))).sqrt();
    let ratio = pr.powf(2.0 / 3.0) * re.powf(0.75) / (two * flat * (root + late).sqrt());
    taken / (one + ratio.powi(3)).powf(1.0 / 3.0)
}

/// Re* that counts as no flow.
const NO_FLOW: f64 = 1e-12;

const GAP: FieldDeclaration = length("fin_gap", "clear distance between two fins", "\"8 mm\"");
const LENGTH: FieldDeclaration =
    length("fin_length", "length of a fin from root to tip", "\"30 mm\"");
const THICKNESS: FieldDeclaration = length("fin_thickness", "thickness of a fin", "\"1.5 mm\"");
const FINS: FieldDeclaration = FieldDeclaration::given("fins", "number of fins", "12").counted();

/// Dimensions of a sink: S, L along the flow, fin length, thickness, k and number of fins.
struct Sink<S> {
    gap: S,
    along: S,
    length: S,
    thickness: S,
    conductivity: S,
    fins: S,
}

impl<S: Scalar> Sink<S> {
    /// From its fields, in this order.
    fn of(values: &[S]) -> Self {
        let [gap, along, length, thickness, conductivity, fins] =
            std::array::from_fn(|i| values[i]);
        Self { gap, along, length, thickness, conductivity, fins }
    }

    /// The conductance in W/K with a film of this Nusselt number over the gap.
    fn conductance(&self, nusselt: S, fluid: Fluid<S>) -> S {
        let [one, two] = [1.0, 2.0].map(S::from_f64);
        let h = nusselt * fluid.conductivity / self.gap;
        let ml = (two * h / (self.conductivity * self.thickness)).sqrt() * self.length;
        let bare = (self.fins - one) * self.gap * self.along;
        finned(h, [bare, two * self.fins * self.length * self.along], ml)
    }
}

/// A sink with upright fins in still air.
#[derive(Debug)]
pub(crate) struct PlateFins;

impl PlateFins {
    fn state<S: Scalar>(values: &[S], [from, to]: [S; 2]) -> (Fluid<S>, Sink<S>, S) {
        let (fluid, sink) = (Fluid::of(values), Sink::of(&values[5..]));
        let elenbaas = rayleigh(fluid, values[4], from - to, sink.gap) * sink.gap / sink.along;
        (fluid, sink, elenbaas)
    }
}

impl Law for PlateFins {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "plate_fins",
        sentence: "A heat sink with upright fins side by side in still air.",
        equation: "Q = h (A + eta A_fins) (T_from - T_to), h = Nu k / S, Nu = (576/El^2 + \
            2.873/El^(1/2))^(-1/2), El = Ra_S S / L, A = (n - 1) S L, A_fins = 2 n l L, eta as of \
            straight_fins",
        fields: of_fluid![
            EXPANSION,
            GAP,
            length("height", "height of the fins, L", "\"150 mm\""),
            LENGTH,
            THICKNESS,
            K_FIN,
            FINS,
        ],
        reads_ends: true,
        validity: "Upright channels, open below and above; `from` is the base, and fins much \
            colder than it convect less. Radiation is a separate path.",
        groups: &[
            Group { name: "El", meaning: "Elenbaas number Ra_S S / L", from: 0.1, to: 1e5 },
            prandtl(0.6, 0.8),
        ],
        source: "Bar-Cohen and Rohsenow, J. Heat Transfer 106 (1984) 116; Incropera et al., 6th \
            edition, section 9.7.1",
        ..SINK
    };

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        let (fluid, sink, elenbaas) = Self::state(values, ends);
        sink.conductance(nusselt_between_plates(elenbaas), fluid)
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let (fluid, _, elenbaas) = Self::state(values, ends);
        vec![Some(elenbaas), Some(fluid.prandtl())]
    }
}

/// A sink that is blown through.
#[derive(Debug)]
pub(crate) struct PlateFinsBlown;

impl PlateFinsBlown {
    fn state<S: Scalar>(values: &[S]) -> (Fluid<S>, Sink<S>, S) {
        let (fluid, sink) = (Fluid::of(values), Sink::of(&values[5..]));
        let re = fluid.reynolds(values[4], sink.gap) * sink.gap / sink.along;
        (fluid, sink, re)
    }
}

impl Law for PlateFinsBlown {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "plate_fins_blown",
        sentence: "A heat sink with fins side by side that is blown through.",
        equation: "Q = h (A + eta A_fins) (T_from - T_to), h = Nu k / S, Nu = ((Re* Pr/2)^-3 + \
            (0.664 Re*^(1/2) Pr^(1/3) (1 + 3.65/Re*^(1/2))^(1/2))^-3)^(-1/3), Re* = Re_S S / L, A \
            and A_fins as of plate_fins",
        fields: of_fluid![
            FieldDeclaration { meaning: "velocity between the fins, of either sign", ..SPEED },
            GAP,
            length("length", "length of the fins along the flow, L", "\"100 mm\""),
            LENGTH,
            THICKNESS,
            K_FIN,
            FINS,
        ],
        validity: "All of the flow passes between the fins, laminar; `from` is the base, `to` the \
            air as it enters. At rest it carries no heat: natural convection is plate_fins.",
        groups: &[
            Group { name: "Re*", meaning: "Reynolds number Re_S S / L", from: 0.1, to: 100.0 },
            prandtl(0.6, 0.8),
            Group {
                name: "Q/Q_air",
                meaning: "heat flow over the most that the air between the fins can take",
                from: 0.0,
                to: 1.0,
            },
        ],
        source: "Teertstra et al., 15th IEEE SEMI-THERM (1999) 34; Culham and Muzychka, IEEE \
            Trans. Comp. Pack. Techn. 24 (2001) 159",
        ..SINK
    };

    fn value<S: Scalar>(values: &[S], _: [S; 2]) -> S {
        let (fluid, sink, re) = Self::state(values);
        sink.conductance(nusselt_through_plates(re, fluid.prandtl()), fluid)
    }

    fn groups(values: &[f64], _: [f64; 2]) -> Vec<Option<f64>> {
        let (fluid, sink, re) = Self::state(values);
        // outer faces and the base count in full, so that few fins seem to heat more air than passes
        let section = sink.gap * sink.length * (sink.fins - 1.0);
        let rate = values[1] * values[2] * values[4].abs() * section;
        let share = Self::value(values, [0.0; 2]) / rate;
        vec![Some(re), Some(fluid.prandtl()), (re != 0.0).then_some(share)]
    }
}

/// The common part of the sinks.
const SINK: LawDeclaration = LawDeclaration {
    confidence: Confidence::Medium,
    extent: Extent::Whole,
    ..StraightFins::DECLARATION
};
