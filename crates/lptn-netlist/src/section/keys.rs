//! Keys that several sections have.

use crate::format::{KeyDeclaration, key, property, text};

pub(super) const DENSITY: KeyDeclaration = key(
    "density",
    "kg/m^3",
    "density; constant: the mass of a volume does not change",
    "\"7850 kg/m^3\"",
);
pub(super) const CP: KeyDeclaration = property(
    "cp",
    "J/(kg K)",
    "specific heat capacity; constant, an expression in `T`, or a table over it",
    "\"475 J/(kg K)\"",
);
/// Specific heat of a liquid: the example is water.
pub(super) const CP_OF_FLUID: KeyDeclaration =
    KeyDeclaration { example: "\"4180 J/(kg K)\"", ..CP }.needed();
pub(super) const SOURCE_OF: KeyDeclaration =
    text("source", "text", "source of the numbers", "\"source of the numbers\"");

/// Heat capacity and material of a lump.
pub(super) const CAPACITY: KeyDeclaration =
    key("C", "J/K", "heat capacity; may depend on the node's own temperature `T`", "\"500 J/K\"");
pub(super) const MATERIAL_OF: KeyDeclaration = text(
    "material",
    "name of a material",
    "one of the file or of the library (`lptn materials`), instead of the values that it gives",
    "\"steel_8620\"",
);
/// The lubricant of a loss, and its place.
pub(crate) const LUBRICANT_OF: KeyDeclaration = text(
    "lubricant",
    "name of a lubricant",
    "one of the file or of the library, instead of the values that it gives",
    "\"iso_vg_220\"",
);
pub(super) const AT: KeyDeclaration = text(
    "at",
    "name of a node or boundary",
    "with `lubricant`: the place with its temperature; default: the first that is heated",
    "\"name of a node\"",
);
pub(super) const FLUID_OF: KeyDeclaration = text(
    "fluid",
    "name of a fluid",
    "one of the file or of the library (`lptn materials`), instead of the properties that it gives",
    "\"air\"",
);
pub(super) const MASS: KeyDeclaration =
    key("mass", "kg", "with `material`, or `volume`: the capacity is `mass cp`", "\"1.2 kg\"");
pub(super) const VOLUME: KeyDeclaration = key(
    "volume",
    "m^3",
    "with `material`, or `mass`: the capacity is `volume density cp`",
    "\"150 cm^3\"",
);
