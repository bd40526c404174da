//! Materials and fluids.

use crate::id::Field;
use crate::value::Value;

/// A solid with its properties, as far as they are known.
#[derive(Clone, Debug)]
pub struct Material {
    /// Its name; materials have their own name space.
    pub name: String,
    /// Density in kg/m^3.
    pub density: Option<Value>,
    /// Specific heat capacity in J/(kg K).
    pub cp: Option<Value>,
    /// Thermal conductivity in W/(m K); of layers in their plane, of wires across them.
    pub k: Option<Value>,
    /// Thermal conductivity along its axis in W/(m K), if it differs: across layers, along wires.
    pub k_axis: Option<Value>,
    /// The wires that it is made of, if it is a winding.
    pub winding: Option<Winding>,
    /// Its melting, if it melts.
    pub melting: Option<Melting>,
    /// Source of the numbers.
    pub source: Option<String>,
}

/// The parts of a winding, from which its properties were computed. The parts are names of
/// materials.
#[derive(Clone, Debug)]
pub struct Winding<T = Value> {
    /// Share of the conductor in the volume.
    pub fill: T,
    /// Share of the enamel in the volume.
    pub enamel_fill: T,
    /// Material of the conductor.
    pub wire: String,
    /// Material of the enamel, if there is any.
    pub enamel: Option<String>,
    /// Material between the wires.
    pub resin: String,
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
    /// Its name; fluids have their own name space.
    pub name: String,
    /// Density in kg/m^3.
    pub density: Option<Value>,
    /// Specific heat capacity in J/(kg K).
    pub cp: Value,
    /// Further properties that films take, as fields of their laws, as far as they are known. For a
    /// fluid of the library they replace these two.
    pub film: Vec<(Field, Value)>,
    /// Source of the numbers.
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
