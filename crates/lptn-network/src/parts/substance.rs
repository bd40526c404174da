//! Materials and fluids.

use crate::value::Value;

/// A solid with its properties, each where it is known.
#[derive(Clone, Debug)]
pub struct Material {
    /// Its name; materials have a name space of their own.
    pub name: String,
    /// Density in kg/m^3.
    pub density: Option<Value>,
    /// Specific heat capacity in J/(kg K).
    pub cp: Option<Value>,
    /// Thermal conductivity in W/(m K).
    pub k: Option<Value>,
    /// How it melts.
    pub melting: Option<Melting>,
    /// Where the numbers come from.
    pub source: Option<String>,
}

/// A change of phase: latent heat, taken up evenly from the solidus to the liquidus.
#[derive(Clone, Debug)]
pub struct Melting<T = Value> {
    /// Absolute temperature in K at which melting begins.
    pub solidus: T,
    /// Absolute temperature in K at which all is molten; not below the solidus, and equal to it for
    /// a pure substance.
    pub liquidus: T,
    /// Latent heat in J/kg.
    pub heat: T,
}

/// A fluid with its properties, constant or depending on its own temperature `T`.
#[derive(Clone, Debug)]
pub struct Fluid {
    /// Its name; fluids have a name space of their own.
    pub name: String,
    /// Density in kg/m^3.
    pub density: Option<Value>,
    /// Specific heat capacity in J/(kg K).
    pub cp: Value,
    /// Where the numbers come from.
    pub source: Option<String>,
}
