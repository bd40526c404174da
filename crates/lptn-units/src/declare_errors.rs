//! The declarative forms of errors.
//!
//! A problem is declared once (`problems!`): variant, fields, code, place, sentence and help are in
//! one place. The reader of a file supplies the names of items (`Naming` of `lptn-network`): a
//! netlist calls a conductor by its section.
//!
//! Errors that need no names are declared by `errors!` and implement the trait `Problem`. An error
//! that is only passed on is a variant `Name => ItsError;`. An error that adds something names its
//! `source`. The class of an error determines the exit code; the command line adds only the place.

/// The help in a declaration: words, or none.
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

/// Declares an enum of errors, each in one place: its fields, its stable code, its sentence, its
/// help if there is one, and its class if that is not a wrong input. The expressions see the fields
/// by reference; a sentence is anything that can be displayed. If another error is a part of it,
/// `source` names that. A variant that only passes an error on names it, `Name => ItsError;`: code,
/// sentence, help, source and class are that error's, and `?` converts it.
/// `Name => ItsError as Class::of_numbers;` changes its class.
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
        #[allow(missing_docs, reason = "the words of each name its fields; all in SI units")]
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

            /// The remedy, in words that can be pasted if possible.
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

/// The class of a declaration; by default the input is wrong.
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

/// The class of the error that a variant passes on, or the class that it makes of that.
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

/// A name for the content of a variant.
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

/// Declares an enum of problems, each in one place: its fields, stable code, place, sentence and
/// help. The expressions see the fields by reference, and `$say`, which knows the names of things.
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
        #[allow(missing_docs, reason = "the words of each name its fields; all in SI units")]
        pub enum $name { $($(#[$doc])* $variant $({ $($field: $ty),* })?,)* }

        #[allow(unused_variables, reason = "each takes the fields that it needs")]
        impl $name {
            /// The stable code, as diagnostics print it.
            pub fn code(&self) -> &'static str {
                match self { $(Self::$variant $({ $($field),* })? => $code,)* }
            }

            /// The place, if it is one.
            pub fn place(&self) -> Option<$Place> {
                match self { $(Self::$variant $({ $($field),* })? => $place,)* }
            }

            /// The problem in one sentence.
            pub fn message(&self, $say: $Say) -> String {
                match self { $(Self::$variant $({ $($field),* })? => $message,)* }
            }

            /// The remedy, in words that can be pasted if possible.
            pub fn help(&self, $say: $Say) -> Option<String> {
                match self { $(Self::$variant $({ $($field),* })? => $help,)* }
            }
        }
    };
}
