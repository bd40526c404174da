//! `direction` of a path and `axis` of a grid: how a material of layers or wires lies in them.
//!
//! Both are always given: no default would be right for half of the uses.

use lptn_data::{Diagnostic, list};
use lptn_network::Input;

use crate::fields::Fields;
use crate::format::{KeyDeclaration, words, words_of};
use crate::texture::{DIRECTIONS, Texture};
use crate::work::{Elaboration, Known};

const DIRECTION_WORDS: [&str; 4] = words_of(&DIRECTIONS);

/// The direction of the heat in a path.
pub(super) const DIRECTION_OF: KeyDeclaration = words(
    "direction",
    &DIRECTION_WORDS,
    "with a `material` of layers or wires: the direction of the heat",
    "\"across_wires\"",
);

/// The axes of a block and of a cylinder.
const AXES: [[&str; 3]; 2] = [["x", "y", "z"], ["r", "phi", "z"]];

/// The axis of the material of a grid.
pub(super) const AXIS_OF: KeyDeclaration = words(
    "axis",
    &["x", "y", "z", "r", "phi"],
    "with a `material` of layers or wires: the direction across the layers, or along the wires",
    "\"z\"",
);

impl<'a> Elaboration<'a> {
    /// The conductivity of a material in the direction of a path.
    pub(super) fn directed(
        &mut self,
        fields: &Fields<'a>,
        (name, known): (&str, Known),
    ) -> Option<Input> {
        let texture = known.texture;
        if texture == Texture::Even {
            let why = format!("has no effect: `{name}` {}", texture.noun());
            self.refuse_keys(fields, &[DIRECTION_OF.name], &why);
            return self.builder.conductivity(known.id);
        }
        let Some((word, raw)) = self.word(fields, DIRECTION_OF.name) else {
            let own = texture.words();
            self.lacks_direction(fields, (name, texture), (DIRECTION_OF.name, &own));
            return None;
        };
        let meaning = DIRECTIONS.iter().find(|(known, _)| *known == word).map(|(_, of)| *of);
        match meaning.filter(|(of, _)| *of == texture) {
            Some((_, true)) => self.builder.axial_conductivity(known.id),
            Some((_, false)) => self.builder.conductivity(known.id),
            None => {
                let message = format!("{} cannot be \"{word}\"", fields.owner.field("direction"));
                let help = format!("`{name}` {}: {}", texture.noun(), choices(&texture.words()));
                self.refuse("netlist::unknown_word", message, &raw.span, help);
                None
            }
        }
    }

    /// The conductivities of a material along the axes of a grid.
    pub(super) fn along_axes(
        &mut self,
        fields: &Fields<'a>,
        (name, known): (&str, Known),
        round: bool,
    ) -> Option<[Input; 3]> {
        let k = self.builder.conductivity(known.id)?;
        let all = [k.clone(), k.clone(), k];
        if known.texture == Texture::Even {
            let why = format!("has no effect: `{name}` {}", known.texture.noun());
            self.refuse_keys(fields, &[AXIS_OF.name], &why);
            return Some(all);
        }
        let axes = &AXES[usize::from(round)];
        let Some((word, raw)) = self.word(fields, AXIS_OF.name) else {
            self.lacks_direction(fields, (name, known.texture), (AXIS_OF.name, axes));
            return None;
        };
        let Some(axis) = axes.iter().position(|axis| *axis == word) else {
            let message = format!("{} cannot be \"{word}\"", fields.owner.field(AXIS_OF.name));
            self.refuse("netlist::unknown_word", message, &raw.span, choices(axes));
            return None;
        };
        let axial = self.builder.axial_conductivity(known.id)?;
        let mut all = all;
        all[axis] = axial;
        Some(all)
    }

    /// Reports a material of layers or wires whose direction is not given.
    fn lacks_direction(
        &mut self,
        fields: &Fields<'a>,
        (name, texture): (&str, Texture),
        (key, words): (&str, &[&str]),
    ) {
        if !fields.complete || fields.get(key).is_some() {
            return;
        }
        let owner = fields.owner.words();
        let message =
            format!("{owner} has no `{key}`, but its material `{name}` {}", texture.noun());
        let meaning = match (key, texture) {
            ("axis", Texture::Wires) => "the direction of the wires",
            ("axis", _) => "the direction across the layers",
            _ => "the direction of the heat",
        };
        let problem = Diagnostic::error("netlist::no_direction", message);
        let place = fields.get("material").map_or(fields.place, |raw| &raw.span);
        let all: Vec<String> = words.iter().map(|word| format!("`{key} = \"{word}\"`")).collect();
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        self.report(
            problem.at(place.clone(), "").help(format!("give {meaning}: {}", all.join(" or "))),
        );
    }
}

fn choices(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    let quoted: Vec<&str> = quoted.iter().map(String::as_str).collect();
    format!("it is one of {}", list(&quoted))
}
