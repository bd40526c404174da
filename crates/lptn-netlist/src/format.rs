//! How a section is declared: its keys with what each takes and means, its examples, and what
//! belongs elsewhere. Help, suggestions, what a template or an included file may hold, and the page
//! of all keys follow from it.

use lptn_data::nearest;

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
    /// What it takes: a unit, or what stands in place of a quantity.
    pub takes: &'static str,
    /// What it means, in a few words.
    pub meaning: &'static str,
    /// What holds where it is left out; empty where it has to be there, or where nothing is meant
    /// without it.
    pub default: &'static str,
    /// Its right side, as an example.
    pub example: &'static str,
}

/// A key; see the fields of [`KeyDeclaration`].
pub(crate) const fn key(
    name: &'static str,
    takes: &'static str,
    meaning: &'static str,
    example: &'static str,
) -> KeyDeclaration {
    KeyDeclaration { name, takes, meaning, default: "", example }
}

impl KeyDeclaration {
    /// With what holds where it is left out.
    pub(crate) const fn or(self, default: &'static str) -> Self {
        Self { default, ..self }
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
