//! Properties of materials and fluids: constant, an expression in `T`, or a table over it.
//!
//! A field of a law may be a property of a material, a fluid or a lubricant, which is named instead
//! of a value and evaluated at the temperature that the law defines. Properties of lubricants are
//! calls of tables (`NAME.nu`), so that the network needs no notion of oils.

use lptn_network::{Input, Melting};
use lptn_units::{Dimension, Type};

use crate::fields::{Fields, wrong_shape};
use crate::place::{Place, Wanted};
use crate::raw::RawKind;
use crate::work::{Elaboration, stand_in};

/// The keys of a change of phase: all of them or none.
const MELTING: [&str; 3] = ["solidus", "liquidus", "latent_heat"];

impl<'a> Elaboration<'a> {
    /// A property; a stand-in if it is wrong.
    pub(crate) fn property(
        &mut self,
        fields: &Fields<'a>,
        key: &str,
        wanted: Wanted,
    ) -> Option<Input> {
        let raw = fields.get(key)?;
        let ty = wanted.ty.unwrap_or(Type::SCALAR);
        let place = Place { owner: &fields.owner, key, raw };
        match raw.kind {
            RawKind::Table(_) if wanted == Wanted::constant(ty) => {
                let message = format!("{} has to be constant", place.words());
                let help = format!(
                    "give one value, at the temperature of the volume: `{}`",
                    fields.sample(key)
                );
                self.refuse("netlist::constant_property", message, &raw.span, help);
                return Some(stand_in(ty));
            }
            RawKind::Table(_) => {
                return Some(self.property_table(fields, key, ty).unwrap_or_else(|| stand_in(ty)));
            }
            RawKind::Array(_) => {
                let wanted = "a quantity or a table over `T`";
                let table = format!("{key} = {{ x = [\"20 degC\", \"100 degC\"], y = [.., ..] }}");
                self.report(wrong_shape(&place.words(), raw, wanted, &table));
                return Some(stand_in(ty));
            }
            _ => {}
        }
        self.input(fields, key, wanted)
    }

    /// The melting of a material.
    pub(crate) fn melting(&mut self, fields: &Fields<'a>) -> Option<Melting<Input>> {
        let given = MELTING.iter().filter(|key| fields.get(key).is_some()).count();
        if given == 0 {
            return None;
        }
        let missing = MELTING.iter().find(|key| fields.get(key).is_none());
        if let Some(key) = missing.filter(|_| fields.complete) {
            let message = format!("{} melts, but has no `{key}`", fields.owner.words());
            self.report(fields.missing(key, message));
        }
        let mut value = |key: &str, ty: Type| self.input(fields, key, Wanted::constant(ty));
        let solidus = value("solidus", Type::ABSOLUTE_TEMPERATURE);
        let liquidus = value("liquidus", Type::ABSOLUTE_TEMPERATURE);
        let heat = value("latent_heat", Type::of(Dimension::SPECIFIC_ENERGY));
        Some(Melting { solidus: solidus?, liquidus: liquidus?, heat: heat? })
    }
}
