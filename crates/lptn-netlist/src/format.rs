//! How a section is declared: its keys with what each takes and means, its examples, and what
//! belongs elsewhere. Help, suggestions, what a template or an included file may hold, and the page
//! of all keys follow from it.

use lptn_data::nearest;
use lptn_units::{Type, Unit};

/// What a section holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Values that expressions name.
    Value,
    /// What elements are made of.
    Substance,
    /// Elements, which share one set of names.
    Element,
    /// What holds unless said otherwise.
    Default,
    /// Elements from other files.
    Import,
    /// Parts that are written once.
    Template,
    /// Where such a part is used.
    Use,
    /// What is asked of a network.
    Study,
    /// A table inside another section.
    Inner,
}

/// A section, or a table inside one.
#[derive(Debug)]
pub struct SectionDeclaration {
    /// Its heading; also what an element of it is called.
    pub name: &'static str,
    /// What it holds, in one sentence.
    pub sentence: &'static str,
    /// What it is to the others.
    pub role: Role,
    /// Its keys, or those of its elements.
    pub keys: &'static [KeyDeclaration],
    /// Keys of which one at least has to be there, in groups.
    pub either: &'static [&'static [&'static str]],
    /// Keys that are decided but not supported yet.
    pub later: &'static [&'static str],
    /// The right side of an element, for help.
    pub example: &'static str,
    /// Help for keys that belong elsewhere.
    pub elsewhere: &'static [(&'static str, &'static str)],
}

impl SectionDeclaration {
    /// Without keys, to begin with.
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

    /// The names of its keys.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        self.keys.iter().map(|key| key.name).collect()
    }

    /// What to do about a key that it does not have.
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
    /// What it takes.
    pub takes: Takes,
    /// What it takes in words, where the type does not say it.
    pub(crate) said: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// What holds where it is left out; empty where it has to be there, or where nothing is meant
    /// without it.
    pub default: &'static str,
    /// Its right side, as an example.
    pub example: &'static str,
    /// Whether it has to be there.
    pub needed: bool,
}

/// What a key takes: its words for people and the schema of a netlist follow.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// A quantity in this unit, or an expression.
    Quantity(&'static str),
    /// The same, or a table over the temperature.
    Property(&'static str),
    /// A number without a unit, or an expression.
    Number,
    /// A quantity or a number: its type follows from something else.
    Like,
    /// A whole number.
    Whole,
    /// `true` or `false`.
    Flag,
    /// One of these words.
    Words(&'static [&'static str]),
    /// A string: a name, a file, an expression.
    Text,
    /// A list of so many at least and at most.
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

/// A key that takes what no other function here declares, in these words.
pub(crate) const fn shaped(
    name: &'static str,
    said: &'static str,
    takes: Takes,
    meaning: &'static str,
    example: &'static str,
) -> KeyDeclaration {
    KeyDeclaration { name, takes, said, meaning, default: "", example, needed: false }
}

/// Functions that declare a key of one type, by what they are given beside meaning and example.
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
    /// A quantity or a number whose type follows from something else.
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
    /// What it takes, in words.
    pub fn takes(&self) -> String {
        match self.takes {
            Takes::Words(all) => {
                all.iter().map(|word| format!("`\"{word}\"`")).collect::<Vec<_>>().join(", ")
            }
            _ => self.said.to_owned(),
        }
    }

    /// The type of its value, where that is a quantity or a number.
    pub(crate) fn ty(&self) -> Type {
        match self.takes {
            Takes::Quantity(ABSOLUTE) => Type::ABSOLUTE_TEMPERATURE,
            Takes::Quantity(unit) => Unit::parse(unit).map_or(Type::SCALAR, |unit| unit.ty),
            _ => Type::SCALAR,
        }
    }

    /// With what holds where it is left out.
    pub(crate) const fn or(self, default: &'static str) -> Self {
        Self { default, ..self }
    }

    /// That has to be there.
    pub(crate) const fn needed(self) -> Self {
        Self { needed: true, ..self }
    }
}

/// What a key of an absolute temperature takes.
pub(crate) const ABSOLUTE: &str = "absolute temperature";

/// All sections, in the order in which they are named to people.
#[derive(Debug)]
pub struct NetlistFormat {
    /// The sections there are.
    pub sections: Vec<&'static SectionDeclaration>,
    /// Sections that the format has for later.
    pub later: &'static [&'static SectionDeclaration],
}

impl NetlistFormat {
    /// Whether there is a section of this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.sections.iter().any(|section| section.name == name)
    }

    /// The headings of the sections.
    pub(crate) fn names(&self) -> Vec<&'static str> {
        self.sections.iter().map(|section| section.name).collect()
    }

    /// What the section of this name is, also one for later.
    pub(crate) fn role(&self, name: &str) -> Option<Role> {
        let all = self.sections.iter().chain(self.later);
        all.copied().find(|section| section.name == name).map(|section| section.role)
    }

    /// The names of the sections of elements.
    pub(crate) fn elements(&self) -> impl Iterator<Item = &'static str> {
        let elements = self.sections.iter().filter(|section| section.role == Role::Element);
        elements.map(|section| section.name)
    }

    /// Whether a template cannot hold a section, which there is.
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
