//! Properties of fluids in correlations of heat transfer, and the dimensionless numbers from them.
//!
//! Source: Incropera et al., Fundamentals of Heat and Mass Transfer, 6th edition, table 6.2.

use lptn_units::{Dimension, Scalar, Type};

use crate::declare::{FieldDeclaration, Group, Hints, Substance};

/// A property of the fluid.
const fn property(
    key: &'static str,
    dimension: Dimension,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    FieldDeclaration {
        hints: Hints::FLUID,
        property: Some(Substance::Fluid),
        ..FieldDeclaration::new(key, Type::of(dimension), meaning, example)
    }
}

pub(crate) const CONDUCTIVITY: FieldDeclaration = property(
    "k",
    Dimension::CONDUCTIVITY,
    "thermal conductivity of the fluid",
    "\"0.0262 W/(m K)\"",
);
pub(crate) const DENSITY: FieldDeclaration =
    property("density", Dimension::DENSITY, "density of the fluid", "\"1.184 kg/m^3\"");
pub(crate) const SPECIFIC_HEAT: FieldDeclaration = property(
    "cp",
    Dimension::SPECIFIC_HEAT,
    "specific heat capacity of the fluid at constant pressure",
    "\"1006 J/(kg K)\"",
);
pub(crate) const VISCOSITY: FieldDeclaration = property(
    "viscosity",
    Dimension::DYNAMIC_VISCOSITY,
    "dynamic viscosity of the fluid",
    "\"18.4 uPa s\"",
);
pub(crate) const EXPANSION: FieldDeclaration = property(
    "expansion",
    Dimension::EXPANSION_COEFFICIENT,
    "volumetric expansion coefficient of the fluid",
    "\"0.00336 1/K\"",
);

/// The fields of a correlation: the properties that [`Fluid::of`] reads, then its own.
macro_rules! of_fluid {
    ($($own:expr),* $(,)?) => {
        &[
            $crate::fluid::CONDUCTIVITY,
            $crate::fluid::DENSITY,
            $crate::fluid::SPECIFIC_HEAT,
            $crate::fluid::VISCOSITY,
            $($own),*
        ]
    };
}
pub(crate) use of_fluid;

/// The properties of a fluid at one temperature, all above 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluid<S = f64> {
    /// Thermal conductivity k in W/(m K).
    pub conductivity: S,
    /// Density rho in kg/m^3.
    pub density: S,
    /// Specific heat capacity at constant pressure cp in J/(kg K).
    pub specific_heat: S,
    /// Dynamic viscosity mu in Pa s.
    pub viscosity: S,
}

impl<S: Scalar> Fluid<S> {
    /// From the first four fields of a correlation.
    pub(crate) fn of(values: &[S]) -> Self {
        let [conductivity, density, specific_heat, viscosity] = std::array::from_fn(|i| values[i]);
        Self { conductivity, density, specific_heat, viscosity }
    }

    /// Prandtl number Pr = mu cp / k.
    pub fn prandtl(self) -> S {
        self.viscosity * self.specific_heat / self.conductivity
    }

    /// Reynolds number Re = |u| L / nu, for flows of either direction.
    ///
    /// * `speed`: u in m/s
    /// * `length`: L in m
    pub fn reynolds(self, speed: S, length: S) -> S {
        self.density * speed.abs() * length / self.viscosity
    }

    /// Conductance of a film in W/K: G = Nu k / L A.
    ///
    /// * `nusselt`: Nu, the mean over the surface
    /// * `length`: the length L of Nu in m
    /// * `area`: A in m^2
    pub fn film(self, nusselt: S, length: S, area: S) -> S {
        nusselt * self.conductivity / length * area
    }
}

/// Prandtl numbers in a range.
pub(crate) const fn prandtl(from: f64, to: f64) -> Group {
    Group { name: "Pr", meaning: "Prandtl number", from, to }
}

/// Reynolds numbers in a range.
pub(crate) const fn reynolds(from: f64, to: f64) -> Group {
    Group { name: "Re", meaning: "Reynolds number", from, to }
}

/// A length in a correlation, or a dimension of a body.
pub(crate) const fn length(
    key: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> FieldDeclaration {
    FieldDeclaration::measure(key, Type::of(Dimension::LENGTH), meaning, example)
}
