//! One declarative form for the problems of every crate.

use std::error::Error;
use std::fmt;

/// An error that users may meet: its code, help and class.
pub trait Problem: Error {
    /// The stable code, as diagnostics print it.
    fn code(&self) -> &'static str;

    /// The remedy, in words that can be pasted if possible.
    fn help(&self) -> Option<String>;

    /// The class of the problem.
    fn class(&self) -> Class {
        Class::Input
    }
}

/// The class of a problem: its cause, or its meaning for the question; each has an exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// The input is wrong, or the question does not fit it.
    Input,
    /// The numbers cannot be computed with.
    Numbers,
    /// The question has an answer, and that is no.
    No,
    /// It was interrupted.
    Interrupted,
}

impl Problem for std::io::Error {
    fn code(&self) -> &'static str {
        "io::error"
    }

    fn help(&self) -> Option<String> {
        None
    }
}

impl<P: Problem> Problem for Box<P> {
    fn code(&self) -> &'static str {
        self.as_ref().code()
    }

    fn help(&self) -> Option<String> {
        self.as_ref().help()
    }

    fn class(&self) -> Class {
        self.as_ref().class()
    }
}

/// Several problems of one kind, all that were found; never empty. Code and help are those of the
/// first.
#[derive(Clone, Debug, PartialEq)]
pub struct Problems<P>(pub Vec<P>);

impl<P: fmt::Display> fmt::Display for Problems<P> {
    /// One a line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&all.join("\n"))
    }
}

impl<P: Error> Error for Problems<P> {}

impl<P: Problem> Problem for Problems<P> {
    fn code(&self) -> &'static str {
        self.0.first().map_or("problems::none", Problem::code)
    }

    fn help(&self) -> Option<String> {
        self.0.first()?.help()
    }

    fn class(&self) -> Class {
        self.0.first().map_or(Class::Input, Problem::class)
    }
}

impl<P> From<P> for Problems<P> {
    fn from(one: P) -> Self {
        Self(vec![one])
    }
}

impl<P> std::ops::Deref for Problems<P> {
    type Target = [P];

    fn deref(&self) -> &[P] {
        &self.0
    }
}

impl<P> IntoIterator for Problems<P> {
    type Item = P;
    type IntoIter = std::vec::IntoIter<P>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl Class {
    /// The class for a caller that could not compute the answer because of this problem.
    #[must_use]
    pub fn of_numbers(self) -> Self {
        Self::Numbers
    }

    /// The class for another question that needed the answer: a no becomes a failure.
    #[must_use]
    pub fn not_an_answer(self) -> Self {
        if self == Self::No { Self::Numbers } else { self }
    }
}
