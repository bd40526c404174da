//! One declarative form for the problems of every crate.

/// Declares an enum of problems, each told once: its fields, its stable code, where it is, what it says and what to do
/// about it. The expressions see the fields by reference, and `$say`, which knows what things are called.
///
/// ```
/// lptn_units::problems! {
///     /// What can be wrong with a door.
///     #[derive(Debug)]
///     pub enum Problem for |name: &str| at u32 {
///         /// It does not open.
///         Stuck { after: u32 } = "door::stuck", at Some(*after),
///             says format!("door `{name}` is stuck since day {after}"), help Some("oil its hinges".to_owned());
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
