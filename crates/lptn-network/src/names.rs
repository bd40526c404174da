//! Names in messages.

use std::fmt;

use lptn_units::{Problem, suggest};

/// A name that the network does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// The unknown name.
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

impl Problem for UnknownName {
    fn code(&self) -> &'static str {
        "network::unknown_name"
    }

    fn help(&self) -> Option<String> {
        None // the sentence has it
    }
}

/// True if it is a name: letters, digits and `_`, not a digit first.
pub fn is_name(text: &str) -> bool {
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.starts_with(|c: char| word(c) && !c.is_ascii_digit()) && text.chars().all(word)
}

/// True if it is a name, or the name of a part of others: `planet[2].gear`, `wall[1,1,3]`. Indices
/// are whole numbers from 1, written without spaces and without leading zeros.
pub fn is_path(text: &str) -> bool {
    text.split('.').all(|part| match part.split_once('[') {
        None => is_name(part),
        Some((name, indices)) => {
            let index = |i: &str| {
                i.starts_with(|c: char| c.is_ascii_digit() && c != '0')
                    && i.chars().all(|c| c.is_ascii_digit())
            };
            is_name(name)
                && indices.strip_suffix(']').is_some_and(|list| list.split(',').all(index))
        }
    })
}

/// Names of nodes as a message lists them: "`a`", "`a` and `b`", "`a`, `b` and 3 more nodes".
pub fn list_of_names(names: &[String]) -> String {
    list_of(names, "nodes")
}

/// Names as a message lists them: "`a`", "`a` and `b`", "`a`, `b` and 3 more" of these.
pub fn list_of(names: &[String], what: &str) -> String {
    match names {
        [] => String::new(),
        [one] => format!("`{one}`"),
        [one, two] => format!("`{one}` and `{two}`"),
        [one, two, three] => format!("`{one}`, `{two}` and `{three}`"),
        [one, two, rest @ ..] => format!("`{one}`, `{two}` and {} more {what}", rest.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_paths_are_told_from_other_texts() {
        for path in
            ["steel", "_a1", "planet.gear", "planet[2].gear", "wall[1,20,3]", "a[1].b[2,3].c"]
        {
            assert!(is_path(path), "{path}");
        }
        for other in [
            "", ".", "a.", ".a", "1a", "a[0]", "a[01]", "a[]", "a[1", "a[1,]", "a[*]", "a[1]b",
            "a b", "a[ 1]", "[1]",
        ] {
            assert!(!is_path(other), "{other}");
        }
        assert!(is_name("steel") && !is_name("a.b") && !is_name("a[1]") && !is_name("é"));
    }
}
