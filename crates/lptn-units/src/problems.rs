//! One declarative form for the problems of every crate.

use std::error::Error;
use std::fmt;

/// What can be wrong, for who tells it: every error of this workspace that people may meet.
pub trait Problem: Error {
    /// The stable code, as diagnostics print it.
    fn code(&self) -> &'static str;

    /// What to do about it, in words that can be pasted where possible.
    fn help(&self) -> Option<String>;

    /// Whose fault it is.
    fn class(&self) -> Class {
        Class::Input
    }
}

/// Whose fault a problem is, or what it says of the question; programs end with a code for each.
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
    /// Whoever passes the problem on could not compute what was asked for.
    #[must_use]
    pub fn of_numbers(self) -> Self {
        Self::Numbers
    }

    /// What is an answer to one question is a failure of another one that needed it.
    #[must_use]
    pub fn not_an_answer(self) -> Self {
        if self == Self::No { Self::Numbers } else { self }
    }
}

/// Help as a declaration gives it: words, or none.
pub trait Help {
    /// The words.
    fn words(self) -> Option<String>;
}

impl Help for &str {
    fn words(self) -> Option<String> {
        Some(self.to_owned())
    }
}

impl Help for String {
    fn words(self) -> Option<String> {
        Some(self)
    }
}

impl Help for &String {
    fn words(self) -> Option<String> {
        Some(self.clone())
    }
}

impl Help for Option<String> {
    fn words(self) -> Option<String> {
        self
    }
}

/// Declares an enum of errors, each told once: its fields, its stable code, its sentence and, where
/// there is one, the help; its class where it is not that of a wrong input. The expressions see the
/// fields by reference; a sentence is anything that can be displayed. Where another error is a part
/// of it, `source` names that. A variant that only passes an error on says which,
/// `Name => ItsError;`: code, sentence, help, source and class are that error's, and `?` makes one
/// of the other; `Name => ItsError as Class::of_numbers;` makes another class of its class.
///
/// ```
/// lptn_units::errors! {
///     /// What can be wrong with a door.
///     #[derive(Debug)]
///     pub enum DoorError {
///         /// It does not open.
///         Stuck { after: u32 } = "door::stuck", format!("stuck since day {after}"),
///             help "oil its hinges";
///         /// Its sign cannot be written.
///         Sign(error: std::fmt::Error) = "door::sign", format!("no sign: {error}"), source error;
///     }
/// }
///
/// lptn_units::errors! {
///     /// What can be wrong with a house.
///     #[derive(Debug)]
///     pub enum HouseError {
///         /// Its door.
///         Door => DoorError;
///     }
/// }
///
/// use lptn_units::Problem;
/// let stuck = DoorError::Stuck { after: 3 };
/// assert_eq!((stuck.code(), stuck.to_string().as_str()), ("door::stuck", "stuck since day 3"));
/// assert_eq!(stuck.help().as_deref(), Some("oil its hinges"));
/// let house = HouseError::from(stuck);
/// assert_eq!((house.code(), house.help().as_deref()), ("door::stuck", Some("oil its hinges")));
/// assert_eq!(DoorError::Sign(std::fmt::Error).help(), None);
/// ```
#[macro_export]
macro_rules! errors {
    (
        $(#[$meta:meta])*
        pub enum $name:ident {
            $(
                $(#[$doc:meta])*
                $variant:ident $(($($arg:ident: $arg_ty:ty),*))? $({ $($field:ident: $ty:ty),* })?
                    $(=> $inner:ty $(as $own:path)?)?
                    $(= $code:expr, $says:expr $(, source $source:expr)? $(, help $help:expr)?
                        $(, class $class:expr)?)?;
            )*
        }
    ) => {
        $(#[$meta])*
        #[allow(missing_docs, reason = "what each says tells what its fields are; all in SI units")]
        pub enum $name {
            $($(#[$doc])* $variant $(($($arg_ty),*))? $({ $($field: $ty),* })? $(($inner))?,)*
        }

        #[allow(unused_variables, reason = "each takes the fields that it needs")]
        impl $name {
            /// The stable code, as diagnostics print it.
            pub fn code(&self) -> &'static str {
                match self {
                    $(Self::$variant $(($($arg),*))? $({ $($field),* })?
                        $(($crate::bound!(inner $inner)))? => {
                            $($code)?
                            $(<$inner as $crate::Problem>::code(inner))?
                        })*
                }
            }

            /// What to do about it, in words that can be pasted where possible.
            pub fn help(&self) -> Option<String> {
                match self {
                    $(Self::$variant $(($($arg),*))? $({ $($field),* })?
                        $(($crate::bound!(inner $inner)))? => {
                            $($crate::help_of!($($help)?))?
                            $(<$inner as $crate::Problem>::help(inner))?
                        })*
                }
            }
        }

        impl ::std::fmt::Display for $name {
            #[allow(unused_variables, reason = "each takes the fields that it needs")]
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                match self {
                    $(Self::$variant $(($($arg),*))? $({ $($field),* })?
                        $(($crate::bound!(inner $inner)))? => {
                            $(::std::write!(f, "{}", $says))?
                            $(<$inner as ::std::fmt::Display>::fmt(inner, f))?
                        })*
                }
            }
        }

        impl ::std::error::Error for $name {
            #[allow(unused_variables, reason = "each takes the fields that it needs")]
            fn source(&self) -> Option<&(dyn ::std::error::Error + 'static)> {
                match self {
                    $(Self::$variant $(($($arg),*))? $({ $($field),* })?
                        $(($crate::bound!(inner $inner)))? => {
                            $($crate::source_of!($($source)?))?
                            $(<$inner as ::std::error::Error>::source(inner))?
                        })*
                }
            }
        }

        $($(impl From<$inner> for $name {
            fn from(inner: $inner) -> Self {
                Self::$variant(inner)
            }
        })?)*

        impl $crate::Problem for $name {
            fn code(&self) -> &'static str {
                self.code()
            }

            fn help(&self) -> Option<String> {
                self.help()
            }

            #[allow(unused_variables, reason = "each takes the fields that it needs")]
            fn class(&self) -> $crate::Class {
                match self {
                    $(Self::$variant $(($($arg),*))? $({ $($field),* })?
                        $(($crate::bound!(inner $inner)))? => {
                            $($crate::class_of!($($class)?))?
                            $($crate::class_in!(inner $(, $own)?))?
                        })*
                }
            }
        }
    };
}

/// The class of a declaration; where it has none the input is wrong.
#[doc(hidden)]
#[macro_export]
macro_rules! class_of {
    () => {
        $crate::Class::Input
    };
    ($class:expr) => {
        $class
    };
}

/// The class of what a variant passes on, or what it makes of that.
#[doc(hidden)]
#[macro_export]
macro_rules! class_in {
    ($inner:expr) => {
        $crate::Problem::class($inner)
    };
    ($inner:expr, $own:path) => {
        $own($crate::Problem::class($inner))
    };
}

/// A name for what a variant holds.
#[doc(hidden)]
#[macro_export]
macro_rules! bound {
    ($name:ident $inner:ty) => {
        $name
    };
}

/// The source of a declaration, if it has one.
#[doc(hidden)]
#[macro_export]
macro_rules! source_of {
    () => {
        None
    };
    ($source:expr) => {
        Some($source)
    };
}

/// The help of a declaration, if it has one.
#[doc(hidden)]
#[macro_export]
macro_rules! help_of {
    () => {
        None
    };
    ($help:expr) => {
        $crate::Help::words($help)
    };
}

/// Declares an enum of problems, each told once: its fields, its stable code, where it is, what it
/// says and what to do about it. The expressions see the fields by reference, and `$say`, which
/// knows what things are called.
///
/// ```
/// lptn_units::problems! {
///     /// What can be wrong with a door.
///     #[derive(Debug)]
///     pub enum Problem for |name: &str| at u32 {
///         /// It does not open.
///         Stuck { after: u32 } = "door::stuck", at Some(*after),
///             says format!("door `{name}` is stuck since day {after}"),
///             help Some("oil its hinges".to_owned());
///     }
/// }
///
/// let problem = Problem::Stuck { after: 3 };
/// assert_eq!((problem.code(), problem.place()), ("door::stuck", Some(3)));
/// assert_eq!(problem.message("front"), "door `front` is stuck since day 3");
/// assert_eq!(problem.help("front").as_deref(), Some("oil its hinges"));
/// ```
#[macro_export]
macro_rules! problems {
    (
        $(#[$meta:meta])*
        pub enum $name:ident for |$say:ident: $Say:ty| at $Place:ty {
            $(
                $(#[$doc:meta])*
                $variant:ident $({ $($field:ident: $ty:ty),* })? = $code:expr, at $place:expr,
                    says $message:expr, help $help:expr;
            )*
        }
    ) => {
        $(#[$meta])*
        #[allow(missing_docs, reason = "what each says tells what its fields are; all in SI units")]
        pub enum $name { $($(#[$doc])* $variant $({ $($field: $ty),* })?,)* }

        #[allow(unused_variables, reason = "each takes the fields that it needs")]
        impl $name {
            /// The stable code, as diagnostics print it.
            pub fn code(&self) -> &'static str {
                match self { $(Self::$variant $({ $($field),* })? => $code,)* }
            }

            /// Where it is, if it is in one place.
            pub fn place(&self) -> Option<$Place> {
                match self { $(Self::$variant $({ $($field),* })? => $place,)* }
            }

            /// What is wrong, in one sentence.
            pub fn message(&self, $say: $Say) -> String {
                match self { $(Self::$variant $({ $($field),* })? => $message,)* }
            }

            /// What to do about it, in words that can be pasted where possible.
            pub fn help(&self, $say: $Say) -> Option<String> {
                match self { $(Self::$variant $({ $($field),* })? => $help,)* }
            }
        }
    };
}
