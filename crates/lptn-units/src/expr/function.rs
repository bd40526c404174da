//! The functions an expression may call.

/// A built-in function.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Function {
    Abs,
    Min,
    Max,
    Mean,
    Sum,
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    Tanh,
    If,
    Kelvin,
    Absolute,
}

const ALL: [(&str, Function); 14] = [
    ("abs", Function::Abs),
    ("min", Function::Min),
    ("max", Function::Max),
    ("mean", Function::Mean),
    ("sum", Function::Sum),
    ("sqrt", Function::Sqrt),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tanh", Function::Tanh),
    ("if", Function::If),
    ("kelvin", Function::Kelvin),
    ("absolute", Function::Absolute),
];

/// True if this is the name of a built-in function.
pub fn is_function(name: &str) -> bool {
    find(name).is_some()
}

pub(crate) fn find(name: &str) -> Option<Function> {
    ALL.iter().find(|(known, _)| *known == name).map(|(_, function)| *function)
}

pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    ALL.iter().map(|(name, _)| *name)
}

impl Function {
    pub(crate) fn name(self) -> &'static str {
        ALL.iter().find(|(_, function)| *function == self).map_or("", |(name, _)| name)
    }

    /// The right number of arguments in words, if `count` is wrong.
    pub(crate) fn wrong_arity(self, count: usize) -> Option<&'static str> {
        let (right, words) = match self {
            Self::Min | Self::Max | Self::Sum => (count >= 2, "two or more arguments"),
            Self::Mean => (count >= 1, "one or more arguments"),
            Self::If => (count == 3, "three arguments: a comparison and two values"),
            _ => (count == 1, "one argument"),
        };
        (!right).then_some(words)
    }
}
