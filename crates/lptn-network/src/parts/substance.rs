//! Materials and fluids.

use crate::id::Field;
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
    /// What films take beside or, of a fluid of the library, in place of these two, as fields of
    /// their laws; each where it is known.
    pub film: Vec<(Field, Value)>,
    /// Where the numbers come from.
    pub source: Option<String>,
}

impl Fluid {
    /// The property of this key that a film takes, if it is known.
    pub fn film_property(&self, key: &str) -> Option<&Value> {
        let own = match key {
            "density" => self.density.as_ref(),
            "cp" => Some(&self.cp),
            _ => None,
        };
        let of_films = self.film.iter().find(|(field, _)| field.key() == key);
        of_films.map(|(_, value)| value).or(own)
    }
}
