//! Names in messages.

use std::fmt;

use lptn_units::suggest;

/// A name that the network does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// The name that was asked for.
    pub name: String,
    /// The most similar name there is.
    pub suggestion: Option<String>,
}

impl UnknownName {
    pub(crate) fn new(name: &str, known: &[&str]) -> Self {
        let suggestion = suggest(name, known.iter().copied()).map(str::to_owned);
        Self { name: name.to_owned(), suggestion }
    }
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "nothing is named `{}`", self.name)?;
        match &self.suggestion {
            Some(other) => write!(f, ", did you mean `{other}`?"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for UnknownName {}

/// Names as a message lists them: "`a`", "`a` and `b`", "`a`, `b` and 3 more nodes".
pub fn list_of_names(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => format!("`{one}`"),
        [one, two] => format!("`{one}` and `{two}`"),
        [one, two, three] => format!("`{one}`, `{two}` and `{three}`"),
        [one, two, rest @ ..] => format!("`{one}`, `{two}` and {} more nodes", rest.len()),
    }
}
