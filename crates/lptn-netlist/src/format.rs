//! Declarations of sections: their keys with types and meanings, their examples, and keys that
//! belong elsewhere. Help, suggestions, the permitted contents of templates and included files, and
//! the page of all keys follow from them.

use lptn_data::nearest;
use lptn_units::{Type, Unit, parse_quantity};

use crate::raw::RawKind;
use crate::toml_text::string;

/// The role of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Values that expressions name.
    Value,
    /// Substances that elements are made of.
    Substance,
    /// Elements, which share one set of names.
    Element,
    /// Defaults.
    Default,
    /// Elements from other files.
    Import,
    /// Parts that are written once.
    Template,
    /// Uses of such parts.
    Use,
    /// Questions about a network.
    Study,
    /// A table inside another section.
    Inner,
}

/// A section, or a table inside one.
#[derive(Debug)]
pub struct SectionDeclaration {
    /// Its heading; also the name of the kind of its elements.
    pub name: &'static str,
    /// Its contents, in one sentence.
    pub sentence: &'static str,
    /// Its role among the sections.
    pub role: Role,
    /// Its keys, or those of its elements.
    pub keys: &'static [KeyDeclaration],
    /// Groups of keys, at least one of which is required.
    pub either: &'static [&'static [&'static str]],
    /// Keys that are reserved but not supported yet.
    pub later: &'static [&'static str],
    /// The right side of an element, for help.
    pub example: &'static str,
    /// Help for keys that belong elsewhere.
    pub elsewhere: &'static [(&'static str, &'static str)],
}

impl SectionDeclaration {
    /// An empty declaration to start from.
    pub const NEW: Self = Self {
        name: "",
        sentence: "",
        role: Role::Inner,
        keys: &[],
        either: &[],
        later: &[],
        example: "",
        elsewhere: &[],
    };

    /// The key of this name.
    pub fn key(&self, name: &str) -> Option<&'static KeyDeclaration> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// A key as it could be written.
    pub(crate) fn sample(&self, key: &str) -> String {
        format!("{key} = {}", self.key(key).map_or("\"..\"", |key| key.example))
    }

    /// The example with this value in the one key of its quantity, and without keys that have
    /// defaults. `None` if no key or several could take the value.
    pub(crate) fn holding(&self, value: &RawKind) -> Option<String> {
        let (text, bare) = match value {
            RawKind::String { text, .. } => (text.as_str(), false),
            RawKind::Integer(text) | RawKind::Float(text) => (text.as_str(), true),
            _ => return None,
        };
        let found = parse_quantity(text, None).ok().map(|quantity| quantity.ty.dimension);
        let shown = |key: &KeyDeclaration| self.example.contains(&format!(" {} = ", key.name));
        let takes = |key: &KeyDeclaration| match (unit_of(key.takes), found) {
            (Some(unit), Some(found)) if !bare => {
                Unit::parse(unit).is_ok_and(|unit| unit.ty.dimension == found)
            }
            (Some(_), _) => shown(key) && key.default.is_empty(),
            (None, _) => false,
        };
        let mut fitting = self.keys.iter().filter(|key| takes(key));
        let (Some(key), None) = (fitting.next(), fitting.next()) else { return None };
        let own = if bare { format!("{text} {}", unit_of(key.takes)?) } else { text.to_owned() };
        let others = self.keys.iter().filter(|other| other.default.is_empty() && shown(other));
        let others = others.filter(|other| other.name != key.name);
        let first = [format!("{} = {}", key.name, string(&own))];
        let all: Vec<String> =
            first.into_iter().chain(others.map(|other| self.sample(other.name))).collect();
        Some(format!("{{ {} }}", all.join(", ")))
    }

    /// The names of its keys.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        self.keys.iter().map(|key| key.name).collect()
    }

    /// Help for a key that it does not have.
    pub(crate) fn help_for(&self, key: &str) -> String {
        if let Some((_, help)) = self.elsewhere.iter().find(|(name, _)| *name == key) {
            return (*help).to_owned();
        }
        nearest(key, self.keys.iter().map(|key| key.name), "the keys here are")
    }
}

/// A key of a section.
#[derive(Clone, Copy, Debug)]
pub struct KeyDeclaration {
    /// Its name.
    pub name: &'static str,
    /// The type of its value.
    pub takes: Takes,
    /// The type of its value in words, if `takes` does not give them.
    pub(crate) said: &'static str,
    /// Its meaning, in a few words.
    pub meaning: &'static str,
    /// The default; empty if the key is required, or if nothing follows when it is left out.
    pub default: &'static str,
    /// Its right side, as an example.
    pub example: &'static str,
    /// True if it is required.
    pub needed: bool,
}

/// The type of the value of a key: its description and the schema of a netlist follow.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// A quantity in this unit, or an expression.
    Quantity(&'static str),
    /// The same, or a table over the temperature.
    Property(&'static str),
    /// A number without a unit, or an expression.
    Number,
    /// A quantity or a number: its type follows from another value.
    Like,
    /// A whole number.
    Whole,
    /// `true` or `false`.
    Flag,
    /// One of these words.
    Words(&'static [&'static str]),
    /// A string: a name, a file, an expression.
    Text,
    /// A list with a least and a greatest length.
    List(&'static Takes, usize, usize),
    /// A table with these keys.
    Table(&'static SectionDeclaration),
    /// A table with some of these keys, which all take the same.
    Members(&'static [&'static str], &'static Takes),
    /// A table of names, each of which takes the same.
    Each(&'static Takes),
    /// A table of elements of this section, which are parts of a gearbox.
    Part(&'static str),
    /// One of several.
    Either(&'static [Takes]),
}

impl Takes {
    /// A list of any length.
    pub(crate) const fn list(of: &'static Self) -> Self {
        Self::List(of, 0, usize::MAX)
    }
}

/// Names: of parameters, cases, ports.
pub(crate) const NAMES: Takes = Takes::list(&Takes::Text);

/// The name of a file, or a list of them.
pub(crate) const FILES: Takes = Takes::Either(&[Takes::Text, NAMES]);

/// A value, or a list of them.
pub(crate) const VALUES: Takes = Takes::Either(&[Takes::Like, Takes::list(&Takes::Like)]);

/// The words of a choice, for its key.
pub(crate) const fn words_of<T: Copy, const N: usize>(
    choice: &[(&'static str, T); N],
) -> [&'static str; N] {
    let (mut words, mut i) = ([""; N], 0);
    while i < N {
        words[i] = choice[i].0;
        i += 1;
    }
    words
}

/// A key of a type that no other function here declares; `said` describes it.
pub(crate) const fn shaped(
    name: &'static str,
    said: &'static str,
    takes: Takes,
    meaning: &'static str,
    example: &'static str,
) -> KeyDeclaration {
    KeyDeclaration { name, takes, said, meaning, default: "", example, needed: false }
}

/// Functions that declare a key of one type from its name, meaning, example and perhaps one more
/// value.
macro_rules! keys {
    ($($(#[$words:meta])* $name:ident($($given:ident: $ty:ty)?) => $takes:expr, $said:expr;)*) => {$(
        $(#[$words])*
        pub(crate) const fn $name(
            name: &'static str,
            $($given: $ty,)?
            meaning: &'static str,
            example: &'static str,
        ) -> KeyDeclaration {
            shaped(name, $said, $takes, meaning, example)
        }
    )*};
}

keys! {
    /// A quantity in a unit.
    key(unit: &'static str) => Takes::Quantity(unit), unit;
    /// A quantity in a unit, or a table over the temperature.
    property(unit: &'static str) => Takes::Property(unit), unit;
    /// A quantity or a number whose type follows from another value.
    akin(said: &'static str) => Takes::Like, said;
    /// A string.
    text(said: &'static str) => Takes::Text, said;
    /// Names, or other strings.
    names(said: &'static str) => NAMES, said;
    /// A number without a unit.
    number() => Takes::Number, "number";
    /// A whole number.
    whole() => Takes::Whole, "whole number";
    /// `true` or `false`.
    flag() => Takes::Flag, "`true`, `false`";
    /// One of several words.
    words(all: &'static [&'static str]) => Takes::Words(all), "";
}

impl KeyDeclaration {
    /// The type of its value, in words.
    pub fn takes(&self) -> String {
        match self.takes {
            Takes::Words(all) => {
                all.iter().map(|word| format!("`\"{word}\"`")).collect::<Vec<_>>().join(", ")
            }
            _ => self.said.to_owned(),
        }
    }

    /// The type of its value, if that is a quantity or a number.
    pub(crate) fn ty(&self) -> Type {
        match self.takes {
            Takes::Quantity(ABSOLUTE) => Type::ABSOLUTE_TEMPERATURE,
            Takes::Quantity(unit) => Unit::parse(unit).map_or(Type::SCALAR, |unit| unit.ty),
            _ => Type::SCALAR,
        }
    }

    /// The same with a default.
    pub(crate) const fn or(self, default: &'static str) -> Self {
        Self { default, ..self }
    }

    /// The same as a required key.
    pub(crate) const fn needed(self) -> Self {
        Self { needed: true, ..self }
    }
}

/// The unit of a key that takes an absolute temperature.
pub(crate) const ABSOLUTE: &str = "absolute temperature";

/// The usual unit of the values of a key.
fn unit_of(takes: Takes) -> Option<&'static str> {
    match takes {
        Takes::Quantity(ABSOLUTE) => Some("degC"),
        Takes::Quantity(unit) | Takes::Property(unit) => Some(unit),
        _ => None,
    }
}

/// All sections, in the order in which messages list them.
#[derive(Debug)]
pub struct NetlistFormat {
    /// The sections there are.
    pub sections: Vec<&'static SectionDeclaration>,
    /// Sections that the format reserves for later.
    pub later: &'static [&'static SectionDeclaration],
}

impl NetlistFormat {
    /// True if there is a section of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.sections.iter().any(|section| section.name == name)
    }

    /// The headings of the sections.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        self.sections.iter().map(|section| section.name).collect()
    }

    /// The role of the section of this name, including sections for later.
    pub(crate) fn role(&self, name: &str) -> Option<Role> {
        let all = self.sections.iter().chain(self.later);
        all.copied().find(|section| section.name == name).map(|section| section.role)
    }

    /// The names of the sections of elements.
    pub(crate) fn elements(&self) -> impl Iterator<Item = &'static str> {
        let elements = self.sections.iter().filter(|section| section.role == Role::Element);
        elements.map(|section| section.name)
    }

    /// True if there is a section of this name that a template cannot contain.
    pub(crate) fn is_outside_templates(&self, name: &str) -> bool {
        use Role::{Default, Import, Study, Substance, Template};
        let role = self.role(name);
        role.is_some_and(|role| matches!(role, Default | Import | Study | Substance | Template))
    }

    /// The right side of a key, by its name alone.
    pub(crate) fn example(&self, name: &str) -> Option<&'static str> {
        self.sections.iter().find_map(|section| section.key(name)).map(|key| key.example)
    }
}

/// Keys at the top of a file.
pub(crate) const TOP_KEYS: [&str; 4] = ["format", "title", "description", "include"];

/// A netlist that runs.
pub(crate) const MINIMAL: &str = "a small netlist that runs:\n\
    \n\
    format = 1\n\
    \n\
    [node]\n\
    block = { T0 = \"25 degC\", C = \"500 J/K\" }\n\
    \n\
    [boundary]\n\
    air = { T = \"25 degC\" }\n\
    \n\
    [resistor]\n\
    cooling = { from = \"block\", to = \"air\", R = \"0.3 K/W\" }\n\
    \n\
    [source]\n\
    loss = { into = \"block\", P = \"100 W\" }\n\
    \n\
    [run]\n\
    stop = \"25 min\"\n";
