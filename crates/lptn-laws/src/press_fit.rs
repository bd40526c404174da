//! `[press_fit]`: interference fits, whose pressure follows the temperatures of hub and shaft.

use std::f64::consts::PI;

use lptn_units::{Dimension, Scalar, Type};

use crate::Kind;
use crate::declare::{
    Carries, Confidence, Extent, FieldDeclaration, Form, Group, Hints, KindDeclaration, Law,
    LawDeclaration, Range, ResultDeclaration, SurfaceKind,
};
use crate::joint::{
    CONDUCTIVITY, GAP, HARDNESS, RELATIVE_PRESSURE, ROUGHNESS, SLOPE, contact_conductance,
};

/// `[press_fit]`, as netlists declare it.
#[allow(non_upper_case_globals, reason = "named as in the list")]
pub(crate) const PressFit: KindDeclaration = KindDeclaration {
    section: "press_fit",
    sentence: "A hub on a shaft, joined by interference.",
    selector: None,
    example: "{ from = \"hub\", to = \"shaft\", diameter = \"100 mm\", hub_diameter = \"130 mm\", \
        length = \"30 mm\", interference = \"78 um\", T_fit = \"25 degC\", alpha = [\"23.6e-6 1/K\", \
        \"12e-6 1/K\"], E = [\"70 GPa\", \"210 GPa\"], poisson = [0.33, 0.3], k = [\"167 W/(m K)\", \
        \"45 W/(m K)\"], slope = 0.15, roughness = \"1 um\", hardness = \"1.1 GPa\" }",
    elsewhere: &[
        ("R", "a path given by `R` belongs in [resistor]"),
        ("G", "a path given by `G` belongs in [resistor]"),
        ("d", "the diameter of the joint is `diameter`"),
        ("D", "the outer diameter of the hub is `hub_diameter`"),
        ("pressure", "the pressure follows from `interference` and the temperatures"),
        ("h", "a joint whose conductance is known belongs in [contact]"),
    ],
    later: &[],
    surface: Some(SurfaceKind::Touching),
};

/// A hub on a shaft: lengths in m, of the cold and free parts.
#[derive(Clone, Copy, Debug)]
pub struct Fit<S> {
    /// Diameter d of the joint, above 0.
    pub diameter: S,
    /// Outer diameter D of the hub, above d.
    pub hub: S,
    /// Diameter of the bore of the shaft, at least 0, below d.
    pub bore: S,
    /// Interference at `fitted`: diameter of the shaft less that of the hub, in m.
    pub interference: S,
    /// Temperature at which the interference was measured, in K.
    pub fitted: S,
    /// Expansion coefficients of hub and shaft in 1/K.
    pub expansion: [S; 2],
    /// Moduli of elasticity of hub and shaft in Pa, above 0.
    pub modulus: [S; 2],
    /// Poisson's ratios of hub and shaft.
    pub poisson: [S; 2],
}

impl<S: Scalar> Fit<S> {
    /// Interference in m at temperatures of hub and shaft in K; below 0 it is a clearance:
    /// delta = delta_0 - d (alpha_hub (T_hub - T_0) - alpha_shaft (T_shaft - T_0)).
    pub fn interference_at(&self, [hub, shaft]: [S; 2]) -> S {
        let grown = self.expansion[0] * (hub - self.fitted);
        let filled = self.expansion[1] * (shaft - self.fitted);
        self.interference - self.diameter * (grown - filled)
    }

    /// Pressure in Pa at temperatures of hub and shaft in K; 0 if there is a clearance.
    ///
    /// Lamé's thick-walled cylinders in plane stress, elastic: p = delta / (d (c_h / E_h + c_s /
    /// E_s)) with c_h = (D^2 + d^2)/(D^2 - d^2) + nu_h and c_s = (d^2 + b^2)/(d^2 - b^2) - nu_s.
    /// Source: R. G. Budynas, J. K. Nisbett, Shigley's Mechanical Engineering Design, press and
    /// shrink fits; DIN 7190-1.
    ///
    /// ```
    /// # use lptn_laws::Fit;
    /// // one steel, a solid shaft: p = E delta / (2 d) (1 - (d/D)^2)
    /// let fit = Fit { diameter: 0.05, hub: 0.1, bore: 0.0, interference: 50e-6, fitted: 293.15,
    ///     expansion: [12e-6; 2], modulus: [200e9; 2], poisson: [0.3; 2] };
    /// assert!((fit.pressure([350.0; 2]) - 75e6).abs() < 1.0);
    /// ```
    pub fn pressure(&self, ends: [S; 2]) -> S {
        let [joint, hub, bore] = [self.diameter, self.hub, self.bore].map(|d| d * d);
        let outside = (hub + joint) / (hub - joint) + self.poisson[0];
        let inside = (joint + bore) / (joint - bore) - self.poisson[1];
        let given = outside / self.modulus[0] + inside / self.modulus[1];
        self.interference_at(ends).max(S::from_f64(0.0)) / (self.diameter * given)
    }

    /// Common rise of hub and shaft in K until the fit is lost, or common fall if the shaft expands
    /// more. Negative if the fit is lost, infinite if both expand alike.
    ///
    /// ```
    /// # use lptn_laws::Fit;
    /// // aluminium on steel: 78 um of 100 mm are lost 67.24 K above 25 degC, at 92.24 degC
    /// let fit = Fit { diameter: 0.1, hub: 0.13, bore: 0.0, interference: 78e-6, fitted: 298.15,
    ///     expansion: [23.6e-6, 12e-6], modulus: [70e9, 210e9], poisson: [0.33, 0.3] };
    /// assert!((fit.margin([298.15; 2]) - 67.24).abs() < 0.005);
    /// ```
    pub fn margin(&self, ends: [S; 2]) -> S {
        let difference = (self.expansion[0] - self.expansion[1]).abs();
        self.interference_at(ends) / (self.diameter * difference)
    }
}

/// A hub on a shaft.
#[derive(Debug)]
pub(crate) struct Interference;

const fn diameter(
    key: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    FieldDeclaration::measure(key, Type::of(Dimension::LENGTH), meaning, example)
}

const EXPANSION: FieldDeclaration = FieldDeclaration::new(
    "alpha",
    Type::of(Dimension::EXPANSION_COEFFICIENT),
    "coefficient of linear expansion of hub and shaft",
    "\"23.6e-6 1/K\"",
)
.from_zero();

const MODULUS: FieldDeclaration = FieldDeclaration {
    hints: Hints::PROPERTY,
    ..FieldDeclaration::new(
        "E",
        Type::of(Dimension::PRESSURE),
        "modulus of elasticity of hub and shaft",
        "\"70 GPa\"",
    )
};

const POISSON: FieldDeclaration =
    FieldDeclaration::given("poisson", "Poisson's ratio of hub and shaft", "0.3").from_zero();

impl Law for Interference {
    const DECLARATION: LawDeclaration = LawDeclaration {
        name: "interference",
        sentence: "A hub on a shaft, pressed together by their interference, which changes as they \
            expand.",
        equation: "Q = (1.25 ks (m / sigma) (p / H)^0.95 + h_gap) pi d L (T_from - T_to), p of Lamé \
            from delta = delta_0 - d (alpha_hub (T_from - T_fit) - alpha_shaft (T_to - T_fit))",
        kinds: &[Kind::PressFit],
        named: false,
        fields: &[
            diameter("diameter", "diameter of the joint", "\"100 mm\""),
            diameter("hub_diameter", "outer diameter of the hub", "\"130 mm\""),
            diameter("bore", "bore of the shaft", "\"20 mm\"").from_zero().or(0.0),
            diameter("length", "length of the joint", "\"30 mm\""),
            diameter("interference", "diameter of the shaft less that of the hub", "\"78 um\"")
                .from_zero(),
            FieldDeclaration {
                range: Range::Temperature,
                ..FieldDeclaration::new(
                    "T_fit",
                    Type::ABSOLUTE_TEMPERATURE,
                    "temperature at which the interference was measured",
                    "\"25 degC\"",
                )
            }
            .or(293.15),
            EXPANSION,
            EXPANSION,
            MODULUS,
            MODULUS,
            POISSON,
            POISSON,
            CONDUCTIVITY,
            CONDUCTIVITY,
            SLOPE,
            ROUGHNESS,
            HARDNESS,
            GAP,
        ],
        carries: Carries::Conductance,
        reads_ends: true,
        form: Form::Other,
        ordered: &[["diameter", "hub_diameter"], ["bore", "diameter"]],
        area: &[],
        extent: Extent::Divided(&["length"]),
        validity: "`from` is the hub, `to` the shaft. Elastic, as long as each other, at rest: \
            centrifugal forces loosen a fast hub further. If the fit is lost, only `h_gap` \
            conducts.",
        // when the fit is lost the pressure passes through 0
        groups: &[Group { from: 0.0, ..RELATIVE_PRESSURE }],
        source: "R. G. Budynas, J. K. Nisbett, Shigley's Mechanical Engineering Design, press and \
            shrink fits; DIN 7190-1; conductance as of [contact]",
        idle: &[],
        confidence: Confidence::High,
    };

    const RESULTS: &'static [ResultDeclaration] = &[
        ResultDeclaration {
            key: "pressure",
            ty: Type::of(Dimension::PRESSURE),
            meaning: "pressure in the joint",
            missing: "",
        },
        ResultDeclaration {
            key: "margin",
            ty: Type::of(Dimension::TEMPERATURE),
            meaning: "common rise of hub and shaft until the fit is lost",
            missing: "if both parts expand alike",
        },
    ];

    fn value<S: Scalar>(values: &[S], ends: [S; 2]) -> S {
        let pressure = fit_of(values).pressure(ends);
        let surface = [values[14], values[15], values[16]];
        let h = contact_conductance([values[12], values[13]], surface, pressure, values[17]);
        h * S::from_f64(PI) * values[0] * values[3]
    }

    fn groups(values: &[f64], ends: [f64; 2]) -> Vec<Option<f64>> {
        let pressure = fit_of(values).pressure(ends);
        vec![(pressure > 0.0).then(|| pressure / values[16])]
    }

    fn results(values: &[f64], ends: [f64; 2]) -> Vec<f64> {
        let fit = fit_of(values);
        vec![fit.pressure(ends), fit.margin(ends)]
    }
}

fn fit_of<S: Scalar>(values: &[S]) -> Fit<S> {
    let pair = |at: usize| [values[at], values[at + 1]];
    Fit {
        diameter: values[0],
        hub: values[1],
        bore: values[2],
        interference: values[4],
        fitted: values[5],
        expansion: pair(6),
        modulus: pair(8),
        poisson: pair(10),
    }
}
