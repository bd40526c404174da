//! Declarations of questions: names, subjects and options.

/// Type of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A text, such as a quantity or a name.
    Text,
    /// One text or several.
    Texts,
    /// Given or not.
    Flag,
    /// A whole number.
    Count,
    /// Given, perhaps with a text.
    FlagOrText,
}

impl Kind {
    /// Words for it in messages.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Text => "a text",
            Self::Texts => "a text or a list of texts",
            Self::Flag => "True or False",
            Self::Count => "a whole number",
            Self::FlagOrText => "True or a text",
        }
    }

    /// Its type in Python.
    pub(crate) fn python(self) -> &'static str {
        match self {
            Self::Text => "Text | None",
            Self::Texts => "Text | Sequence[Text] | None",
            Self::Flag => "bool",
            Self::Count => "int | None",
            Self::FlagOrText => "bool | Text | Sequence[Text]",
        }
    }
}

/// An option of a question.
#[derive(Debug)]
pub(crate) struct Opt {
    /// Its name, that of the command line with `_` for `-`.
    pub(crate) name: &'static str,
    /// Its type.
    pub(crate) kind: Kind,
    /// Its meaning.
    pub(crate) means: &'static str,
}

/// The things that a question is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum About {
    /// One network: a method of it.
    Network,
    /// Netlists: a function, and a method of a network that is the first.
    Netlists,
    /// A record, points, or nothing: a function.
    Nothing,
}

/// The declaration of a question.
#[derive(Debug)]
pub(crate) struct Declaration {
    /// Its words on the command line.
    pub(crate) name: &'static str,
    /// Its purpose.
    pub(crate) purpose: &'static str,
    /// Its subject.
    pub(crate) about: About,
    /// The option that may be given without its name.
    pub(crate) first: Option<&'static str>,
    /// True if it takes parameters.
    pub(crate) sets: bool,
    /// Its options.
    pub(crate) options: &'static [Opt],
}

impl Declaration {
    /// The option of this name; `for_` is `for`, which Python reserves.
    pub(crate) fn option(&self, name: &str) -> Option<&Opt> {
        let name = name.strip_suffix('_').unwrap_or(name);
        self.options.iter().find(|option| option.name == name)
    }
}
